#include "texproc/prefilter/detail/map_surface.h"

#include <Imath/half.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "texproc/prefilter/detail/lobe_kernel.h"

namespace petrichor::texproc::detail {

namespace {

float half_value(const std::byte* p)
{
    std::uint16_t bits;
    std::memcpy(&bits, p, 2);
    return imath_half_to_float(bits);
}

}  // namespace

void plane_values(const MapPlane& plane, std::size_t first, std::size_t count, float* to)
{
    const std::size_t size = size_of(plane.type);
    const std::size_t step = size * static_cast<std::size_t>(plane.channels);
    const std::byte* from =
        plane.data + first * step + size * static_cast<std::size_t>(plane.channel);
    switch (plane.type) {
        case PixelType::U8:
            for (std::size_t i = 0; i < count; ++i) {
                to[i] = static_cast<float>(from[i * step]) / 255.0f;
            }
            break;
        case PixelType::U16:
            for (std::size_t i = 0; i < count; ++i) {
                std::uint16_t code;
                std::memcpy(&code, from + i * step, 2);
                to[i] = static_cast<float>(code) / 65535.0f;
            }
            break;
        case PixelType::F16:
            for (std::size_t i = 0; i < count; ++i) to[i] = half_value(from + i * step);
            break;
        case PixelType::F32:
            for (std::size_t i = 0; i < count; ++i) std::memcpy(to + i, from + i * step, 4);
            break;
    }
}

void fetch(const MapSurface& s, int y, SurfaceRow& row)
{
    const std::size_t width = static_cast<std::size_t>(s.width);
    for (auto* v : {&row.nx, &row.ny, &row.nz, &row.p, &row.alpha2}) v->resize(width);
    const std::size_t first = static_cast<std::size_t>(y) * width;
    plane_values(s.x, first, width, row.nx.data());
    plane_values(s.y, first, width, row.ny.data());
    if (s.z.data) plane_values(s.z, first, width, row.nz.data());
    plane_values(s.rough, first, width, row.p.data());
    const float flip = s.green_down ? -1.0f : 1.0f;
    for (std::size_t i = 0; i < width; ++i) {
        const float nx = 2.0f * row.nx[i] - 1.0f;
        const float ny = flip * (2.0f * row.ny[i] - 1.0f);
        const float nz = s.z.data ? 2.0f * row.nz[i] - 1.0f
                                  : std::sqrt(std::max(0.0f, 1.0f - nx * nx - ny * ny));
        const float length = std::sqrt(nx * nx + ny * ny + nz * nz);
        const bool fine = length > 1e-6f;
        row.nx[i] = fine ? nx / length : 0.0f;
        row.ny[i] = fine ? ny / length : 0.0f;
        row.nz[i] = fine ? nz / length : 1.0f;
        const float r = std::min(1.0f, std::max(0.0f, row.p[i]));
        const float p = s.smoothness ? 1.0f - r : r;
        const float perceptual = s.alpha ? std::sqrt(p) : p;
        row.p[i] = perceptual;
        row.alpha2[i] = std::max((perceptual * perceptual) * (perceptual * perceptual), kMinAlpha2);
    }
}

bool all_finite(const MapPlane& plane, std::size_t texels)
{
    if (!plane.data || plane.type == PixelType::U8 || plane.type == PixelType::U16) return true;
    constexpr std::size_t kPart = 4096;
    float values[kPart];
    for (std::size_t at = 0; at < texels; at += kPart) {
        const std::size_t count = std::min(kPart, texels - at);
        plane_values(plane, at, count, values);
        for (std::size_t i = 0; i < count; ++i) {
            if (!std::isfinite(values[i])) return false;
        }
    }
    return true;
}

}  // namespace petrichor::texproc::detail
