#include "scene/patches/open_sky.h"

#include <cassert>
#include <cmath>

namespace petrichor::scene {
namespace {

float luminance_of(const glm::vec3& c)
{
    return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z;
}

// Directions of a texel, evenly by solid angle.
struct Texel {
    glm::vec3 even{0.0f};    // their mean
    glm::mat3 square{0.0f};  // mean of their products
    float solid_angle = 0.0f;
};

template <class Body>
Texel over_texel(int index, const Body& body)
{
    Texel texel;
    for (int s = 0; s < shared::kSkySubsamples; ++s) {
        const glm::vec4 sample = shared::visibility_subsample(index, s);
        const glm::vec3 d(sample);
        texel.even += d * sample.w;
        texel.square += glm::outerProduct(d, d) * sample.w;
        texel.solid_angle += sample.w;
        body(d, sample.w);
    }
    texel.even /= texel.solid_angle;
    texel.square /= texel.solid_angle;
    const float step = 2.0f / static_cast<float>(shared::kVisibilityAcross);
    texel.solid_angle *= 0.5f * step * step / static_cast<float>(shared::kSkySubsamples);
    return texel;
}

const std::vector<Texel>& even_texels()
{
    static const std::vector<Texel> texels = [] {
        std::vector<Texel> all;
        for (int t = 0; t < shared::kVisibilityTexels; ++t) all.push_back(over_texel(t, [](const glm::vec3&, float) {}));
        return all;
    }();
    return texels;
}

}  // namespace

std::vector<SkyTexel> sky_texels(std::span<const glm::vec3> sky)
{
    assert(sky.size() == static_cast<std::size_t>(shared::kSkyBins));
    std::vector<SkyTexel> texels(shared::kVisibilityTexels);
    for (int t = 0; t < shared::kVisibilityTexels; ++t) {
        glm::vec3 light(0.0f), way(0.0f);
        float weights = 0.0f, lights = 0.0f;
        const Texel texel = over_texel(t, [&](const glm::vec3& d, float weight) {
            const glm::vec3 here = sky[static_cast<std::size_t>(shared::sky_bin(d))];
            light += here * weight;
            way += d * (luminance_of(here) * weight);
            weights += weight;
            lights += luminance_of(here) * weight;
        });
        texels[static_cast<std::size_t>(t)] = {light / weights, lights > 0.0f ? way / lights : texel.even};
    }
    return texels;
}

OpenSky::OpenSky(std::span<const SkyTexel> texels)
{
    assert(texels.size() == static_cast<std::size_t>(shared::kVisibilityTexels));
    for (int t = 0; t < shared::kVisibilityTexels; ++t) {
        const Texel& texel = even_texels()[static_cast<std::size_t>(t)];
        const SkyTexel& from = texels[static_cast<std::size_t>(t)];
        const glm::vec3 way = from.way * texel.solid_angle;
        // About the way of the light they vary as in the whole texel.
        const glm::mat3 square = (texel.square - glm::outerProduct(texel.even, texel.even) +
                                  glm::outerProduct(from.way, from.way)) *
                                 (luminance_of(from.light) * texel.solid_angle);
        const float row[kRows] = {way.x, way.y, way.z, from.light.x, from.light.y, from.light.z,
                                  square[0][0], square[0][1], square[0][2], square[1][1], square[1][2], square[2][2]};
        for (std::size_t r = 0; r < kRows; ++r) fours_[static_cast<std::size_t>(t) / 4][r][t % 4] = row[r];
    }
}

OpenSky::Front OpenSky::front_of(const Patches& patches, std::uint32_t patch)
{
    const std::vector<Texel>& texels = even_texels();
    Front front;
    for (std::size_t t = 0; t < texels.size(); ++t) {
        if ((patches.visible[patch][t / 32] >> t % 32 & 1u) == 0) continue;
        const Texel& texel = texels[t];
        const float cosine = glm::dot(texel.even, patches.normal[patch]);
        if (!(cosine > 0.0f)) continue;
        front.bits[t / 32] |= 1u << t % 32;
        front.all += cosine * texel.solid_angle;
    }
    return front;
}

OpenSky::Mean OpenSky::seen_by(const Front& front, glm::vec3 normal) const
{
    Mean mean;
    if (!(front.all > 1.0e-6f)) return mean;
    using Mask = std::int32_t __attribute__((vector_size(16)));
    static constexpr auto kMasks = [] {
        std::array<Mask, 16> masks{};
        for (int m = 0; m < 16; ++m)
            masks[static_cast<std::size_t>(m)] = Mask{-(m & 1), -(m >> 1 & 1), -(m >> 2 & 1), -(m >> 3 & 1)};
        return masks;
    }();
    const glm::vec3 n = normal;
    const Four x{n.x, n.x, n.x, n.x}, y{n.y, n.y, n.y, n.y}, z{n.z, n.z, n.z, n.z};
    const Four none{};
    Four red = none, green = none, blue = none, xx = none, xy = none, xz = none, yy = none, yz = none, zz = none;
    for (std::size_t k = 0; k < kFours; ++k) {
        const std::uint32_t four = front.bits[k / 8] >> (4 * (k % 8)) & 15u;
        if (four == 0) continue;
        const Mask seen = kMasks[four];
        const std::array<Four, kRows>& row = fours_[k];
        const auto where = [&](const Four& v, const Mask& mask) {
            return reinterpret_cast<Four>(reinterpret_cast<Mask>(v) & mask);
        };
        const Four c_way = row[WayX] * x + row[WayY] * y + row[WayZ] * z;
        const Four c = where(c_way, seen & (c_way > none));
        red += c * row[Red];
        green += c * row[Green];
        blue += c * row[Blue];
        xx += where(row[XX], seen);
        xy += where(row[XY], seen);
        xz += where(row[XZ], seen);
        yy += where(row[YY], seen);
        yz += where(row[YZ], seen);
        zz += where(row[ZZ], seen);
    }
    const auto total = [](const Four& v) { return (v[0] + v[1]) + (v[2] + v[3]); };
    const glm::vec3 light = glm::vec3(total(red), total(green), total(blue)) / front.all;
    mean.light = glm::vec4(light, luminance_of(light));
    const float mixed_xy = total(xy), mixed_xz = total(xz), mixed_yz = total(yz);
    mean.moment = glm::vec3(total(xx) * n.x + mixed_xy * n.y + mixed_xz * n.z,
                            mixed_xy * n.x + total(yy) * n.y + mixed_yz * n.z,
                            mixed_xz * n.x + mixed_yz * n.y + total(zz) * n.z) /
                  front.all;
    mean.known = true;
    return mean;
}

}  // namespace petrichor::scene
