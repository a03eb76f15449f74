#ifndef PETRICHOR_TEXPROC_GENERATE_DETAIL_STROKES_H
#define PETRICHOR_TEXPROC_GENERATE_DETAIL_STROKES_H

#include "base/portable_math.h"
#include "texproc/generate/detail/material_texels.h"

namespace petrichor::texproc::detail {

/// A curved line that narrows to a point, in texels; it wraps round the edges.
struct Stroke {
    float x, y;
    float heading;  ///< radians
    float length;
    float width;    ///< half of it at the root
    float curl;     ///< radians over its whole length, divided by the length
};

/// Calls `paint(texel, t, across)` along a stroke: t is 0 at the root and 1 at the tip, across -1..1. A texel may be met
/// more than once. Serial: the order of the strokes is part of a result.
template <typename Paint>
void draw_stroke(MaterialSurface& surface, const Stroke& stroke, const Paint& paint)
{
    const int size = surface.size;
    const auto n = static_cast<std::size_t>(size);
    const float length = stroke.length;
    const int steps = std::max(2, static_cast<int>(length * 1.2f));
    float x = stroke.x;
    float y = stroke.y;
    float heading = stroke.heading;
    for (int s = 0; s <= steps; ++s) {
        const float t = static_cast<float>(s) / static_cast<float>(steps);
        const float half = std::max(0.5f, stroke.width * (1.0f - t * t));
        const float nx = -portable_sin(heading);
        const float ny = portable_cos(heading);
        const int reach = static_cast<int>(half + 0.5f);
        for (int w = -reach; w <= reach; ++w) {
            const float across = static_cast<float>(w) / (half + 0.5f);
            if (std::abs(across) > 1.0f) continue;
            const float offset = static_cast<float>(w);
            const int px = wrap_index(static_cast<int>(std::floor(x + nx * offset)), size);
            const int py = wrap_index(static_cast<int>(std::floor(y + ny * offset)), size);
            paint(surface.texels[static_cast<std::size_t>(py) * n + static_cast<std::size_t>(px)], t, across);
        }
        heading += stroke.curl * length / static_cast<float>(steps);
        x += portable_cos(heading) * length / static_cast<float>(steps);
        y += portable_sin(heading) * length / static_cast<float>(steps);
    }
}

/// Stalks and roots that lie on a surface.
struct Fibres {
    float count_m2;  ///< how many a square metre
    float length_m, width_m;
    float rise_m;    ///< of one over what it lies on
    glm::vec3 color;
    std::uint32_t salt;
};
void draw_fibres(MaterialSurface& surface, const Fibres& fibres);

}  // namespace petrichor::texproc::detail

#endif
