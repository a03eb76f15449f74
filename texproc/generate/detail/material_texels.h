#ifndef PETRICHOR_TEXPROC_GENERATE_DETAIL_MATERIAL_TEXELS_H
#define PETRICHOR_TEXPROC_GENERATE_DETAIL_MATERIAL_TEXELS_H

#include <cassert>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "texproc/generate/generate.h"
#include "texproc/generate/noise.h"

namespace petrichor::texproc::detail {

/// One texel of a material before the maps are derived.
struct MaterialTexel {
    float height_m = 0.0f;  ///< any zero
    glm::vec3 albedo{0.5f};
    float roughness = 0.8f;
    float metallic = 0.0f;
};

/// A material in the making. Positions are metres from the upper left corner, y down, [0, tile_m).
struct MaterialSurface {
    int size = 0;
    float tile_m = 1.0f;
    int threads = 1;
    std::uint32_t seed = 0;
    float occlusion_strength = 1.0f;
    std::map<std::string, float, std::less<>> values;  ///< of every parameter of the kind
    std::vector<MaterialTexel> texels;

    /// What a parameter of the kind is; it exists.
    float value(std::string_view name) const
    {
        const auto found = values.find(name);
        assert(found != values.end());
        return found->second;
    }
    int count(std::string_view name) const { return static_cast<int>(std::lround(value(name))); }

    float texel_m() const { return tile_m / static_cast<float>(size); }
    /// Cells of that size over the tile, at least one.
    int cells(float feature_m) const
    {
        return std::max(1, static_cast<int>(std::lround(tile_m / feature_m)));
    }
};

/// Calls `rows(first, last)` on parts of [0, count). The parts depend on `threads`; what is written
/// for a row must not.
void for_rows(int count, int threads, const std::function<void(int, int)>& rows);

/// Fractal noise over the whole tile, about [-1, 1]; octaves finer than two texels are left out.
struct NoiseLayer {
    float feature_x_m;  ///< size of a cell of the first octave
    float feature_y_m;
    int octaves = 3;
    float gain = 0.5f;  ///< amplitude of an octave over the one before
    std::uint32_t salt = 0;
};
std::vector<float> noise_layer(const MaterialSurface& surface, const NoiseLayer& layer);

/// Mean over a (2 r + 1)^2 window that wraps, r in texels.
std::vector<float> box_blur(const std::vector<float>& values, int size, int radius, int threads);

/// Fills every texel: `shade(x, y, index)` gets the position in metres and the texel's index.
template <typename Shade>
void shade_texels(MaterialSurface& surface, const Shade& shade)
{
    const float step = surface.texel_m();
    for_rows(surface.size, surface.threads, [&](int first, int last) {
        for (int j = first; j < last; ++j) {
            const float y = (static_cast<float>(j) + 0.5f) * step;
            for (int i = 0; i < surface.size; ++i) {
                const float x = (static_cast<float>(i) + 0.5f) * step;
                const std::size_t index =
                    static_cast<std::size_t>(j) * static_cast<std::size_t>(surface.size) +
                    static_cast<std::size_t>(i);
                surface.texels[index] = shade(x, y, index);
            }
        }
    });
}

/// One stone, brick or slab of a wall or floor laid in courses.
struct CourseStone {
    float left_m, right_m, top_m, bottom_m;  ///< its cell, around the asked position
    float slant_left, slant_right;           ///< dx/dy of the side lines about the middle
    std::uint32_t id;
};

/// How stones lie in courses.
struct CourseRule {
    int rows = 8;
    float row_jitter = 0.0f;      ///< 0..0.9 of a row
    float stone_length_m = 0.2f;  ///< mean
    float length_jitter = 0.0f;   ///< 0..0.9 of a length
    float slant = 0.0f;           ///< largest dx/dy of a side
    bool half_bond = false;       ///< every other row shifted by half a stone
};

/// The layout of one tile: finds the stone at a position. Tiles in both directions.
class Courses {
public:
    Courses(float tile_m, const CourseRule& rule, std::uint32_t seed);
    CourseStone find(float x_m, float y_m) const;

private:
    struct Row {
        std::vector<float> edges;  ///< ascending, the last is the first plus the tile
    };
    float tile_m_;
    float slant_;
    std::uint32_t seed_;
    std::vector<float> row_edges_;
    std::vector<Row> rows_;
};

/// Distance to the outline of a stone with rounded corners, positive inside, at most `radius`.
float rounded_inside(float to_side_x, float to_side_y, float radius);

inline float mix(float a, float b, float t)
{
    return a + (b - a) * t;
}
inline glm::vec3 mix(const glm::vec3& a, const glm::vec3& b, float t)
{
    return a + (b - a) * t;
}
inline float saturate(float x)
{
    return std::clamp(x, 0.0f, 1.0f);
}

/// What a kind is: its texels, and the numbers that shape them. `tile_m` is a parameter of each.
struct KindRow {
    MaterialKind kind;
    const char* name;
    const char* meaning;
    float tile_m;                               ///< as usual
    std::vector<MaterialParameter> parameters;  ///< its own
    void (*make)(MaterialSurface& surface);     ///< fills texels (already size * size)
};

// The kinds of a file each.
std::vector<KindRow> stone_kinds();
std::vector<KindRow> masonry_kinds();
std::vector<KindRow> roof_kinds();
std::vector<KindRow> road_kinds();
std::vector<KindRow> ground_kinds();
std::vector<KindRow> wood_and_metal_kinds();
std::vector<KindRow> gravel_kinds();
std::vector<KindRow> soft_kinds();

}  // namespace petrichor::texproc::detail

#endif
