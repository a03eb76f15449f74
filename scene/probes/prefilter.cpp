// Light of a probe from the light of its patches, one level for each roughness.
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/portable_math.h"
#include "formulas/codec/octahedral.h"
#include "formulas/light/brdf.h"
#include "formulas/light/reflection_probe.h"
#include "scene/probes/probes.h"

namespace petrichor::scene {
namespace {

using shared::kProbeLevels;
using shared::kProbeSide;

// A map without its border.
struct Map {
    int side = 0;
    std::vector<glm::vec4> texels;
};

glm::vec3 direction_of(int x, int y, int side)
{
    const float step = 2.0f / static_cast<float>(side);
    return shared::octahedral_decode({(static_cast<float>(x) + 0.5f) * step - 1.0f,
                                      (static_cast<float>(y) + 0.5f) * step - 1.0f});
}

// Solid angle of a texel, up to a factor: the octahedron is stretched least in its corners.
float solid_angle(int x, int y, int side)
{
    const float step = 2.0f / static_cast<float>(side);
    const float u = (static_cast<float>(x) + 0.5f) * step - 1.0f;
    const float v = (static_cast<float>(y) + 0.5f) * step - 1.0f;
    const glm::vec3 n(u, 1.0f - std::abs(u) - std::abs(v), v);
    const float fold = std::max(-n.y, 0.0f);
    const glm::vec3 p(n.x + (n.x >= 0.0f ? -fold : fold), n.y, n.z + (n.z >= 0.0f ? -fold : fold));
    const float length = std::sqrt(glm::dot(p, p));
    return 1.0f / (length * length * length);
}

struct Share {
    std::uint32_t texel;
    float weight;
};

// What each texel of a level takes of the map that it is made from; the same for all probes.
struct Lobes {
    int source = 0;  // side
    std::vector<std::uint32_t> first;
    std::vector<Share> shares;
};

// GGX seen along the normal, where the half vector is half way to the light; times the cosine.
float lobe(float nl, float alpha)
{
    const float nh2 = 0.5f + 0.5f * nl;
    const float d = nh2 * (alpha * alpha - 1.0f) + 1.0f;
    return nl / (d * d);
}

Lobes lobes_of(int level)
{
    Lobes lobes;
    const int side = shared::reflection_probe_side(level);
    // Twice as fine as the level, so that wide lobes are not made of steps.
    lobes.source = level == 1 ? side : 2 * side;
    const float roughness = static_cast<float>(level) * shared::kProbeRoughness;
    const float alpha = roughness * roughness;
    // Where the lobe has fallen to 1/250 of its height.
    float least = 1.0f;
    while (least > 0.0f && lobe(least, alpha) > 0.004f * lobe(1.0f, alpha)) least -= 1.0f / 4096.0f;
    least = std::max(least, 1e-6f);
    const int from = lobes.source;
    std::vector<glm::vec4> light(static_cast<std::size_t>(from) * static_cast<std::size_t>(from));
    for (int y = 0; y < from; ++y) {
        for (int x = 0; x < from; ++x) {
            light[static_cast<std::size_t>(y * from + x)] =
                glm::vec4(direction_of(x, y, from), solid_angle(x, y, from));
        }
    }
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            lobes.first.push_back(static_cast<std::uint32_t>(lobes.shares.size()));
            const glm::vec3 n = direction_of(x, y, side);
            const std::size_t begin = lobes.shares.size();
            float sum = 0.0f;
            for (std::size_t i = 0; i < light.size(); ++i) {
                const float nl = glm::dot(n, glm::vec3(light[i]));
                if (nl < least) continue;
                const float weight = lobe(nl, alpha) * light[i].w;
                lobes.shares.push_back({static_cast<std::uint32_t>(i), weight});
                sum += weight;
            }
            for (std::size_t i = begin; i < lobes.shares.size(); ++i)
                lobes.shares[i].weight /= sum;
        }
    }
    lobes.first.push_back(static_cast<std::uint32_t>(lobes.shares.size()));
    lobes.shares.shrink_to_fit();  // kept as long as the program runs
    return lobes;
}

const std::array<Lobes, kProbeLevels>& all_lobes()
{
    static const std::array<Lobes, kProbeLevels> made = [] {
        std::array<Lobes, kProbeLevels> lobes;
        for (int level = 1; level < kProbeLevels; ++level)
            lobes[static_cast<std::size_t>(level)] = lobes_of(level);
        return lobes;
    }();
    return made;
}

Map halved(const Map& map)
{
    Map half{map.side / 2, {}};
    half.texels.resize(map.texels.size() / 4);
    for (int y = 0; y < half.side; ++y) {
        for (int x = 0; x < half.side; ++x) {
            glm::vec4 sum(0.0f);
            float weight = 0.0f;
            for (int k = 0; k < 4; ++k) {
                const int sx = 2 * x + k % 2, sy = 2 * y + k / 2;
                const float w = solid_angle(sx, sy, map.side);
                sum += map.texels[static_cast<std::size_t>(sy * map.side + sx)] * w;
                weight += w;
            }
            half.texels[static_cast<std::size_t>(y * half.side + x)] = sum / weight;
        }
    }
    return half;
}

// The map with a border, which lies on the other half of the same edge.
void put(const Map& map, std::vector<glm::vec4>& all)
{
    const int side = map.side;
    for (int y = -1; y <= side; ++y) {
        for (int x = -1; x <= side; ++x) {
            const bool beside = x < 0 || x >= side;
            const bool beyond = y < 0 || y >= side;
            int sx = std::clamp(x, 0, side - 1), sy = std::clamp(y, 0, side - 1);
            if (beside != beyond) (beside ? sy : sx) = side - 1 - (beside ? y : x);
            if (beside && beyond) {
                sx = side - 1 - sx;
                sy = side - 1 - sy;
            }
            all.push_back(map.texels[static_cast<std::size_t>(sy * side + sx)]);
        }
    }
}

}  // namespace

std::vector<glm::vec3> probe_picture(int width, int height, std::span<const float> rgb)
{
    assert(width > 0 && height > 0);
    const auto texel_at = [&](int x, int y) {
        const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                       static_cast<std::size_t>(x);
        return glm::vec3(rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2]);
    };
    constexpr double kTurn = 2.0 * std::numbers::pi;
    std::vector<glm::dvec4> sums(std::size_t{kProbeSide} * kProbeSide, glm::dvec4(0.0));
    for (int y = 0; y < height; ++y) {
        const auto down = portable_sin_cos(0.5 * kTurn * (y + 0.5) / height);  // from the zenith
        for (int x = 0; x < width; ++x) {
            const auto turn = portable_sin_cos(kTurn * ((x + 0.5) / width - 0.5));
            const glm::vec2 at = shared::octahedral_encode(
                glm::vec3(glm::dvec3(down.sine * turn.sine, down.cosine, -down.sine * turn.cosine)));
            const auto cell = [](float v) {
                return std::clamp(static_cast<int>((v * 0.5f + 0.5f) * kProbeSide), 0, kProbeSide - 1);
            };
            sums[static_cast<std::size_t>(cell(at.y) * kProbeSide + cell(at.x))] +=
                glm::dvec4(glm::dvec3(texel_at(x, y)), 1.0) * down.sine;
        }
    }
    std::vector<glm::vec3> picture;
    picture.reserve(sums.size());
    for (int y = 0; y < kProbeSide; ++y) {
        for (int x = 0; x < kProbeSide; ++x) {
            const glm::dvec4 sum = sums[static_cast<std::size_t>(y * kProbeSide + x)];
            if (sum.w > 0.0) {
                picture.emplace_back(glm::dvec3(sum) / sum.w);
                continue;
            }
            // Coarser than the probe: the pixel that the texel lies in.
            const glm::vec3 d = direction_of(x, y, kProbeSide);
            const double u = std::atan2(static_cast<double>(d.x), static_cast<double>(-d.z)) / kTurn + 0.5;
            const double v =
                std::acos(std::clamp(static_cast<double>(d.y), -1.0, 1.0)) / (0.5 * kTurn);
            picture.push_back(texel_at(std::clamp(static_cast<int>(u * width), 0, width - 1),
                                       std::clamp(static_cast<int>(v * height), 0, height - 1)));
        }
    }
    return picture;
}

namespace {

// What each texel sees.
Map lit_map(const TracedProbe& probe, std::span<const glm::vec3> radiosity)
{
    Map map{kProbeSide, {}};
    map.texels.reserve(probe.texels.size());
    for (const glm::vec3& radiance : probe.picture)
        map.texels.emplace_back(radiance * probe.place.intensity, 0.0f);
    for (const ProbeTexel& texel : probe.texels) {
        if (!probe.picture.empty()) break;
        glm::vec4 light(0.0f);
        if (texel.patch == ProbeTexel::kSky) {
            light.a = 1.0f;
        } else if (texel.patch < radiosity.size()) {
            const glm::vec3 tint(texel.tint[0], texel.tint[1], texel.tint[2]);
            light = glm::vec4(radiosity[texel.patch] * tint *
                                  (probe.place.intensity / (ProbeTexel::kTintScale * shared::kPi)),
                              0.0f);
        }
        map.texels.push_back(light);
    }
    return map;
}

}  // namespace

std::vector<glm::vec4> lit_probe(const TracedProbe& probe, std::span<const glm::vec3> radiosity,
                                 std::span<const glm::vec3> rough)
{
    Map sharp = lit_map(probe, radiosity);
    std::vector<glm::vec4> all;
    all.reserve(static_cast<std::size_t>(shared::reflection_probe_offset(kProbeLevels)));
    put(sharp, all);
    if (!rough.empty()) sharp = lit_map(probe, rough);
    for (int level = 1; level < kProbeLevels; ++level) {
        const Lobes& lobes = all_lobes()[static_cast<std::size_t>(level)];
        while (sharp.side > lobes.source) sharp = halved(sharp);
        Map map{shared::reflection_probe_side(level), {}};
        for (std::size_t i = 0; i + 1 < lobes.first.size(); ++i) {
            glm::vec4 sum(0.0f);
            for (std::uint32_t k = lobes.first[i]; k < lobes.first[i + 1]; ++k)
                sum += sharp.texels[lobes.shares[k].texel] * lobes.shares[k].weight;
            map.texels.push_back(sum);
        }
        put(map, all);
    }
    return all;
}

std::array<glm::vec4, shared::kHarmonics> probe_bands(std::span<const glm::vec4> light)
{
    // Behind the first level, which has what glows; a mirror for lobes as wide as these.
    constexpr int kLevel = 1;
    const int side = shared::reflection_probe_side(kLevel);
    const auto first = static_cast<std::size_t>(shared::reflection_probe_offset(kLevel));
    std::array<glm::vec4, shared::kHarmonics> bands{};
    float all = 0.0f;
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const float angle = solid_angle(x, y, side);
            const glm::vec3 d = direction_of(x, y, side);
            const glm::vec4 here = light[first + static_cast<std::size_t>((y + 1) * (side + 2) + x + 1)] * angle;
            for (int i = 0; i < shared::kHarmonics; ++i) bands[static_cast<std::size_t>(i)] += here * shared::harmonic(i, d);
            all += angle;
        }
    }
    for (glm::vec4& band : bands) band *= 4.0f * shared::kPi / all;
    return bands;
}

}  // namespace petrichor::scene
