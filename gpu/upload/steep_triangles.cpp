#include "gpu/upload/steep_triangles.h"

#include <algorithm>
#include <cmath>

#include "gpu/upload/draw.h"

namespace petrichor::gpu {

namespace {

// Below it no point has water of a hollow (gpu/passes/surface/local_weather.glsl).
constexpr float kPondsFrom = 0.3f;
// What rounding may add to a normal between corners.
constexpr float kSlack = 1.0e-4f;
// A shorter text for less of a material's area than this is not worth its pipeline.
constexpr double kLeastShare = 0.25;

bool stays(const Draw& draw)
{
    return draw.moving < 0 && draw.waving < 0 && draw.shape < 0 && !draw.overlay;
}

}  // namespace

float water_stands_from(const GpuMaterial& material)
{
    const bool mapped = (material.slots & 1u << TEXTURE_HEIGHT) != 0u || material.second != SECOND_NONE;
    // smooth_edge(0.55 ..) and level_ground() of gpu/passes/surface/water.glsl
    return mapped ? 0.55f : 0.994522f;
}

std::uint8_t steep_bits(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, float stands_from)
{
    const float apart = std::min(glm::dot(a, b), std::min(glm::dot(b, c), glm::dot(c, a)));
    // Mixed with any shares, unit vectors stay at least so long: their cosines are `apart` or more.
    const float length_2 = apart + (1.0f - apart) / 3.0f;
    if (!(length_2 > 0.0f) || !std::isfinite(a.y + b.y + c.y)) return 0;
    const float up = std::max(std::abs(a.y), std::max(std::abs(b.y), std::abs(c.y))) / std::sqrt(length_2) + kSlack;
    return static_cast<std::uint8_t>((up <= stands_from ? SteepTriangles::kDry : 0) |
                                     (up <= std::min(stands_from, kPondsFrom) ? SteepTriangles::kUpright : 0));
}

SteepTriangles steep_triangles(std::span<const Draw> draws, std::span<const GpuMaterial> materials,
                               std::span<const Vertex> vertices, std::span<const std::uint32_t> indices)
{
    constexpr std::uint8_t kBoth = SteepTriangles::kDry | SteepTriangles::kUpright;
    SteepTriangles steep;
    steep.whole.assign(draws.size(), 0);
    steep.triangles.resize(draws.size());
    steep.some.assign(materials.size(), 0);
    steep.all.assign(materials.size(), kBoth);
    std::vector<double> area(materials.size(), 0.0), dry(materials.size(), 0.0);
    std::vector<glm::vec3> normals;
    for (std::size_t d = 0; d < draws.size(); ++d) {
        const Draw& draw = draws[d];
        const GpuMaterial& material = materials[draw.material];
        if (!stays(draw) || material.water == 0 || material.own_surface != 0) {
            steep.all[draw.material] = 0;
            continue;
        }
        const glm::mat3 linear(draw.to_world);
        const glm::mat3 turn = glm::transpose(glm::inverse(linear));
        const std::span<const Vertex> own = vertices.subspan(static_cast<std::size_t>(draw.vertex_offset) + draw.first_vertex, draw.vertex_count);
        normals.resize(own.size());
        for (std::size_t v = 0; v < own.size(); ++v) normals[v] = glm::normalize(turn * own[v].normal);
        const float from = water_stands_from(material);
        std::vector<std::uint8_t> bits(draw.most_indices / 3);
        std::uint8_t whole = kBoth;
        for (std::size_t t = 0; t < bits.size(); ++t) {
            std::uint32_t at[3];
            for (std::size_t k = 0; k < 3; ++k) at[k] = indices[draw.first_index + 3 * t + k] - draw.first_vertex;
            bits[t] = steep_bits(normals[at[0]], normals[at[1]], normals[at[2]], from);
            whole &= bits[t];
            const double size = glm::length(glm::cross(linear * (own[at[1]].position - own[at[0]].position),
                                                       linear * (own[at[2]].position - own[at[0]].position)));
            if (!std::isfinite(size)) continue;
            area[draw.material] += size;
            if ((bits[t] & SteepTriangles::kDry) != 0) dry[draw.material] += size;
        }
        steep.whole[d] = whole;
        if (draw.most_indices >= SteepTriangles::kLeastIndices) steep.triangles[d] = std::move(bits);
    }
    for (std::size_t d = 0; d < draws.size(); ++d) {
        const std::uint32_t m = draws[d].material;
        if (dry[m] < kLeastShare * area[m]) {
            steep.whole[d] = 0;
            steep.triangles[d].clear();
        }
        std::uint8_t some = steep.whole[d];
        for (const std::uint8_t bits : steep.triangles[d]) some |= bits;
        steep.some[m] |= some;
        steep.all[m] &= steep.whole[d];
    }
    return steep;
}

}  // namespace petrichor::gpu
