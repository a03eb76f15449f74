#include "gpu/passes/sky/scattered_again.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/portable_math.h"

namespace petrichor::shared {
namespace {

struct Air {
    const gpu::ScatteredAgain::Table& table;

    vec4 again_entry(int index) const { return table[static_cast<std::size_t>(index)]; }

#include "formulas/light/air_radiance.inc"
};

}  // namespace
}  // namespace petrichor::shared

namespace petrichor::gpu {

namespace {

using glm::vec4;

constexpr float kPi = 3.14159265f;
constexpr int kUps = 8, kSides = 8;  // directions: cosines with the vertical, half turns from the sun
constexpr int kSteps = 16;
constexpr int kHeights = 64, kCosines = 128;  // of the optical depths below
constexpr int kDepthSteps = 16;
constexpr float kLeast = 1e-12f;

vec4 kept(const vec4& depth)
{
    return {portable_exp(-depth.x), portable_exp(-depth.y), portable_exp(-depth.z), portable_exp(-depth.w)};
}

glm::vec3 density_at(float height)
{
    const float h = std::max(height, 0.0f);
    return {portable_exp(-h / 8000.0f), portable_exp(-h / 1200.0f),
            std::max(0.0f, 1.0f - std::abs(h - 25000.0f) / 15000.0f)};
}

// Calls step(distance, length, height) for the parts of a ray, which grow with distance: the air is thin far
// out.
template <typename Step>
void march(float height, float up, float reach, int steps, const Step& step)
{
    const float r = shared::kEarthRadius + height;
    float before = 0.0f;
    for (int i = 1; i <= steps; ++i) {
        const float u = static_cast<float>(i) / static_cast<float>(steps);
        const float after = reach * u * u;
        const float middle = 0.5f * (before + after);
        const float radius = std::sqrt(r * r + middle * middle + 2.0f * r * middle * up);
        step(middle, after - before, radius - shared::kEarthRadius);
        before = after;
    }
}

// Optical depth to space from a height, for directions that miss the ground.
class Depths {
public:
    explicit Depths(float turbidity) : depths_(static_cast<std::size_t>(kHeights) * kCosines)
    {
        for (int row = 0; row < kHeights; ++row) {
            const float x = static_cast<float>(row) / (kHeights - 1);
            const float height = shared::kAirHeight * x * x;
            const float lowest = lowest_up(height);
            for (int column = 0; column < kCosines; ++column) {
                const float y = static_cast<float>(column) / (kCosines - 1);
                at(row, column) = depth(height, lowest + (1.0f - lowest) * y * y, turbidity);
            }
        }
    }

    vec4 transmittance(float height, float up) const
    {
        const float lowest = lowest_up(height);
        if (up < lowest) return vec4(0.0f);
        const float y = std::sqrt((up - lowest) / (1.0f - lowest)) * (kCosines - 1);
        const float x = std::sqrt(std::clamp(height / shared::kAirHeight, 0.0f, 1.0f)) * (kHeights - 1);
        const int row = std::min(static_cast<int>(x), kHeights - 2);
        const int column = std::min(static_cast<int>(y), kCosines - 2);
        const float fx = x - static_cast<float>(row), fy = y - static_cast<float>(column);
        return kept(glm::mix(glm::mix(at(row, column), at(row, column + 1), fy),
                             glm::mix(at(row + 1, column), at(row + 1, column + 1), fy), fx));
    }

private:
    static float lowest_up(float height)
    {
        const float ratio = shared::kEarthRadius / (shared::kEarthRadius + std::max(height, 0.0f));
        return -std::sqrt(std::max(1.0f - ratio * ratio, 0.0f));
    }

    static vec4 depth(float height, float up, float turbidity)
    {
        vec4 sum(0.0f);
        march(height, up, shared::distance_to_space(height, up), kDepthSteps,
              [&](float, float length, float h) {
                  sum += shared::air_extinction(density_at(h), turbidity) * length;
              });
        return sum;
    }

    vec4& at(int row, int column) { return depths_[static_cast<std::size_t>(row * kCosines + column)]; }
    const vec4& at(int row, int column) const
    {
        return depths_[static_cast<std::size_t>(row * kCosines + column)];
    }

    std::vector<vec4> depths_;
};

}  // namespace

ScatteredAgain::ScatteredAgain(float turbidity) : turbidity_(turbidity), by_air_{}, by_ground_{}
{
    const Depths depths(turbidity);
    std::array<float, kSides> sides{};
    for (int s = 0; s < kSides; ++s)
        sides[static_cast<std::size_t>(s)] = portable_cos(kPi * (static_cast<float>(s) + 0.5f) / kSides);
    for (int row = 0; row < shared::kAgainHeights; ++row) {
        const float height = std::max(shared::again_height(row), 1.0f);
        const float r = shared::kEarthRadius + height;
        vec4* by_air = &by_air_[static_cast<std::size_t>(row * shared::kAgainSuns)];
        vec4* by_ground = &by_ground_[static_cast<std::size_t>(row * shared::kAgainSuns)];
        vec4 again(0.0f);  // share of light from all sides that this air sends on to the same place
        for (int k = 0; k < kUps; ++k) {
            const float slant = 2.0f * (static_cast<float>(k) + 0.5f) / kUps - 1.0f;
            const float up = slant * std::abs(slant);
            const float share = 2.0f * std::abs(slant) / kUps;  // of all directions
            const float level = std::sqrt(1.0f - up * up);
            // Mean over the sides of what `light` says at a distance, for each sun.
            const auto add = [&](float distance, const vec4& weight, vec4* sums, const auto& light) {
                const float radius = std::sqrt(r * r + distance * distance + 2.0f * r * distance * up);
                for (int column = 0; column < shared::kAgainSuns; ++column) {
                    const float sun = shared::again_sun_up(column);
                    const float sun_level = std::sqrt(std::max(0.0f, 1.0f - sun * sun));
                    vec4 sum(0.0f);
                    for (const float side : sides)
                        sum += light(radius - shared::kEarthRadius,
                                     (r * sun + distance * (up * sun + level * sun_level * side)) / radius);
                    sums[column] += weight * sum * (share / kSides);
                }
            };
            const float ground = shared::distance_to_ground(height, up);
            const float reach = ground > 0.0f ? ground : shared::distance_to_space(height, up);
            vec4 left(1.0f);
            march(height, up, reach, kSteps, [&](float distance, float length, float h) {
                const glm::vec3 density = density_at(h);
                const vec4 extinction = shared::air_extinction(density, turbidity);
                const vec4 passed = kept(extinction * length);
                const vec4 scattered = left * shared::air_scattering(density, turbidity) *
                                       (1.0f - passed) / glm::max(extinction, vec4(1e-12f));
                again += scattered * share;
                add(distance, scattered * (0.25f / kPi), by_air,
                    [&](float there, float sun_up) { return depths.transmittance(there, sun_up); });
                left *= passed;
            });
            if (ground > 0.0f)
                add(ground, left / kPi, by_ground, [&](float, float sun_up) {
                    return depths.transmittance(0.0f, sun_up) * std::max(sun_up, 0.0f);
                });
        }
        for (int column = 0; column < shared::kAgainSuns; ++column) {
            by_air[column] /= 1.0f - again;
            by_ground[column] /= 1.0f - again;
        }
    }
}

ScatteredAgain::Table ScatteredAgain::table(float ground_albedo) const
{
    Table table{};
    for (std::size_t i = 0; i < kEntries; ++i) {
        for (int band = 0; band < 4; ++band)
            table[i][band] =
                portable_log(std::max(by_air_[i][band] + ground_albedo * by_ground_[i][band], kLeast));
    }
    return table;
}

glm::vec3 ClearAir::radiance(float up, float sun_up, float sun_angle, const glm::vec3& sun_illuminance,
                             float turbidity) const
{
    return shared::Air{table_}.air_radiance(up, sun_up, sun_angle, sun_illuminance, turbidity);
}

glm::vec3 ClearAir::on_level_ground(float sun_up, float turbidity) const
{
    constexpr int kRows = 10, kColumns = 8;
    const float sun_level = std::sqrt(std::max(0.0f, 1.0f - sun_up * sun_up));
    glm::vec3 sum(0.0f);
    for (int i = 0; i < kRows; ++i) {
        const float v = (static_cast<float>(i) + 0.5f) / kRows;  // denser near the horizon
        const float up = v * v;
        const float level = std::sqrt(1.0f - up * up);
        for (int j = 0; j < kColumns; ++j) {
            const float side = portable_cos(kPi * (static_cast<float>(j) + 0.5f) / kColumns);
            sum += radiance(up, sun_up, up * sun_up + level * sun_level * side, glm::vec3(1.0f), turbidity) *
                   (up * 2.0f * v);
        }
    }
    return sum * (2.0f * kPi / (kRows * kColumns));
}

}  // namespace petrichor::gpu
