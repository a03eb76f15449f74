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
        const Texel texel = over_texel(t, [](const glm::vec3&, float) {});
        const SkyTexel& from = texels[static_cast<std::size_t>(t)];
        const glm::vec3 way = from.way * texel.solid_angle;
        const glm::vec3 even = texel.even * texel.solid_angle;
        // About the way of the light they vary as in the whole texel.
        const glm::mat3 square = (texel.square - glm::outerProduct(texel.even, texel.even) +
                                  glm::outerProduct(from.way, from.way)) *
                                 (luminance_of(from.light) * texel.solid_angle);
        const float row[kRows] = {way.x, way.y, way.z, even.x, even.y, even.z, from.light.x, from.light.y, from.light.z,
                                  square[0][0], square[0][1], square[0][2], square[1][1], square[1][2], square[2][2]};
        for (std::size_t r = 0; r < kRows; ++r) rows_[r][static_cast<std::size_t>(t) / 4][t % 4] = row[r];
    }
}

OpenSky::Mean OpenSky::seen_by(const Patches& patches, std::uint32_t patch) const
{
    using Mask = std::int32_t __attribute__((vector_size(16)));
    const glm::vec3 n = patches.normal[patch];
    const Four x{n.x, n.x, n.x, n.x}, y{n.y, n.y, n.y, n.y}, z{n.z, n.z, n.z, n.z};
    const Four none{};
    Four even = none, red = none, green = none, blue = none, to_x = none, to_y = none, to_z = none;
    const std::array<std::uint32_t, 8>& bits = patches.visible[patch];
    for (std::size_t k = 0; k < kFours; ++k) {
        const std::uint32_t four = bits[k / 8] >> (4 * (k % 8)) & 15u;
        if (four == 0) continue;
        const Mask seen{-static_cast<std::int32_t>(four & 1u), -static_cast<std::int32_t>(four >> 1 & 1u),
                        -static_cast<std::int32_t>(four >> 2 & 1u), -static_cast<std::int32_t>(four >> 3)};
        const auto where = [&](const Four& v, const Mask& mask) {
            return reinterpret_cast<Four>(reinterpret_cast<Mask>(v) & mask);
        };
        const auto cosine = [&](Row first) {
            return rows_[first][k] * x + rows_[static_cast<std::size_t>(first) + 1][k] * y +
                   rows_[static_cast<std::size_t>(first) + 2][k] * z;
        };
        const Four c_even = cosine(EvenX);
        const Mask facing = seen & (c_even > none);
        const Four c_way = cosine(WayX);
        const Four c = where(c_way, facing & (c_way > none));
        even += where(c_even, facing);
        red += c * rows_[Red][k];
        green += c * rows_[Green][k];
        blue += c * rows_[Blue][k];
        to_x += where(rows_[XX][k] * x + rows_[XY][k] * y + rows_[XZ][k] * z, facing);
        to_y += where(rows_[XY][k] * x + rows_[YY][k] * y + rows_[YZ][k] * z, facing);
        to_z += where(rows_[XZ][k] * x + rows_[YZ][k] * y + rows_[ZZ][k] * z, facing);
    }
    const auto total = [](const Four& v) { return (v[0] + v[1]) + (v[2] + v[3]); };
    Mean mean;
    const float all = total(even);
    if (!(all > 1.0e-6f)) return mean;
    const glm::vec3 light = glm::vec3(total(red), total(green), total(blue)) / all;
    mean.light = glm::vec4(light, luminance_of(light));
    mean.moment = glm::vec3(total(to_x), total(to_y), total(to_z)) / all;
    mean.known = true;
    return mean;
}

}  // namespace petrichor::scene
