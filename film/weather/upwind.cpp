#include "film/weather/upwind.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "weather/physics/constants.h"

namespace petrichor::film {
namespace {

constexpr float kReach_m = 100.0f;
constexpr std::array<float, 8> kHeights_m{0.1f, 0.2f, 0.4f, 0.8f, 1.6f, 3.2f, 6.4f, 12.8f};
// The upper part of an obstacle may lean back so far and by so much of its distance.
constexpr float kLeansBack_m = 1.0f, kLeansBack = 0.25f;
constexpr double kUp = 0.5;              // snow lies on what faces up
constexpr float kLeastBlocked = 0.05f;   // of the low sky upwind: else nothing stands there
constexpr double kColdest_k = 275.15, kLeastWind_m_s = 5.0;  // Li & Pomeroy: 7 m/s at 10 m

weather::Upwind upwind_of(const scene::Tracer& tracer, const glm::vec3& at, const glm::vec3& way)
{
    weather::Upwind found;
    float reach_m = kReach_m;
    for (const float height_m : kHeights_m) {
        const scene::RayHit hit = tracer.nearest({at + glm::vec3(0.0f, height_m, 0.0f), way, reach_m});
        if (!hit.hit()) break;
        if (height_m == kHeights_m.front()) {
            found.distance_m = hit.distance_m;
            reach_m = std::min(kReach_m, hit.distance_m * (1.0f + kLeansBack) + kLeansBack_m);
        }
        // Between this height and the next one.
        found.height_m = height_m == kHeights_m.back() ? height_m : 1.4142136f * height_m;
    }
    return found;
}

}  // namespace

bool wind_may_carry_snow(const weather::ForcingTable& table)
{
    const auto& wind = table[weather::Field::Wind];
    const auto& air = table[weather::Field::AirTemp];
    for (std::size_t i = 0; i < std::min(wind.size(), air.size()); ++i)
        if (air[i] < kColdest_k && wind[i] > kLeastWind_m_s) return true;
    return false;
}

void find_upwind(weather::PatchSet& set, std::span<const glm::vec3> position_m, const scene::Tracer& tracer)
{
    set.upwind.assign(set.patches.size(), {});
    for (std::size_t i = 0; i < set.patches.size(); ++i) {
        const weather::WeatherPatch& patch = set.patches[i];
        if (patch.normal.y < kUp || !(patch.sky_share > 0.0) || !set.kinds[patch.kind].holds_by_tilt) continue;
        const std::array<float, weather::kWindClasses> blocked = weather::wind_blocking(patch.visible);
        for (std::size_t from = 0; from < blocked.size(); ++from) {
            if (blocked[from] < kLeastBlocked) continue;
            const weather::Direction way = weather::direction_of(
                2.0 * weather::kPi * static_cast<double>(from) / static_cast<double>(weather::kWindClasses), 0.0);
            set.upwind[i][from] = upwind_of(tracer, position_m[i],
                                            glm::vec3(glm::dvec3(way.x, 0.0, way.z)));
        }
    }
}

}  // namespace petrichor::film
