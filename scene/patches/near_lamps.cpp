// Light of the sun and of lamps on the sources of polygons that are close to patches.
#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "scene/light_shape.h"
#include "scene/patches/detail/cells.h"
#include "scene/patches/lamps.h"
#include "scene/patches/near_light.h"
#include "scene/patches/radiosity.h"
#include "scene/patches/visible_way.h"

namespace petrichor::scene {

glm::vec3 near_middle(const NearLinks& near, std::size_t source)
{
    glm::vec3 sum(0.0f);
    for (std::size_t k = 0; k < NearLinks::kSamples; ++k) sum += near.points[source * NearLinks::kSamples + k];
    return sum / static_cast<float>(NearLinks::kSamples);
}

std::vector<std::uint8_t> trace_near_lamp(const NearLinks& near, const Tracer& tracer,
                                          float regular_m, glm::vec3 position_m, float range_m,
                                          int threads)
{
    std::vector<std::uint8_t> reached(near.sources(), 0);
    constexpr std::size_t kSourcesAJob = 256;
    parallel_for((reached.size() + kSourcesAJob - 1) / kSourcesAJob, threads, [&](std::size_t job) {
        const std::size_t last = std::min(reached.size(), (job + 1) * kSourcesAJob);
        for (std::size_t s = job * kSourcesAJob; s < last; ++s) {
            const glm::vec3 n = near.normal[s];
            const glm::vec3 way = position_m - near.points[s * NearLinks::kSamples];
            if (!(std::sqrt(glm::dot(way, way)) < range_m + 2.0f * regular_m)) continue;
            Tracer::Blocker blocker;
            for (std::size_t k = 0; k < NearLinks::kSamples; ++k) {
                const glm::vec3 x = near.points[s * NearLinks::kSamples + k];
                const glm::vec3 from = x + n * ray_lift_m(x, regular_m);
                const glm::vec3 d = position_m - from;
                const float length = std::sqrt(glm::dot(d, d));
                if (!(glm::dot(d, n) > 0.0f)) continue;
                const bool blocked =
                    length > kLanternRadius_m &&
                    tracer.blocked({from, d / length, length - kLanternRadius_m}, &blocker);
                if (!blocked) reached[s] = static_cast<std::uint8_t>(reached[s] | 1u << k);
            }
        }
    });
    return reached;
}

void add_sun(const NearLinks& near, glm::vec3 towards_sun, glm::vec3 illuminance,
             std::vector<glm::vec3>& direct)
{
    const VisibleWay way(towards_sun);
    for (std::size_t s = 0; s < near.sources(); ++s) {
        const float cosine = glm::dot(near.normal[s], towards_sun);
        if (cosine > 0.0f) direct[s] += illuminance * (cosine * way.share(near.visible[s]));
    }
}

void add_lamp(const NearLinks& near, const Light& light, std::span<const LightProfile> profiles,
              std::span<const std::uint8_t> reach, std::vector<glm::vec3>& direct)
{
    if (light.kind == LightKind::Directional) {
        add_sun(near, -light.direction, light.color * light_candela(light), direct);
        return;
    }
    constexpr float kShare = 1.0f / static_cast<float>(NearLinks::kSamples);
    for (std::size_t s = 0; s < near.sources(); ++s) {
        const std::uint32_t bits = reach.empty() ? NearLinks::kAllLit : reach[s];
        if (bits == 0) continue;
        const glm::vec3* points = &near.points[s * NearLinks::kSamples];
        // No point is one: nearer than half the way between two its light does not grow.
        const glm::vec3 d = points[NearLinks::kSamples - 1] - points[0];
        const float least_m = 0.5f * std::sqrt(glm::dot(d, d));
        for (std::size_t k = 0; k < NearLinks::kSamples; ++k) {
            if ((bits >> k & 1u) != 0u)
                direct[s] += lamp_irradiance(light, profiles, points[k], near.normal[s], least_m) * kShare;
        }
    }
}

}  // namespace petrichor::scene
