// Light of the sun and of lamps on the polygons that are close to patches.
#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "scene/light_shape.h"
#include "scene/patches/detail/cells.h"
#include "scene/patches/detail/near_faces.h"
#include "scene/patches/detail/sampling.h"
#include "scene/patches/lamps.h"
#include "scene/patches/near_light.h"
#include "scene/patches/radiosity.h"

namespace petrichor::scene {

glm::vec3 near_normal(const NearLinks& near, std::size_t entry)
{
    return front_of(near.corners[entry]);
}

glm::vec3 near_middle(const NearLinks& near, std::size_t entry)
{
    return point_in(near.corners[entry], 0.5f, 0.5f);
}

std::vector<std::uint8_t> trace_near_lamp(const NearLinks& near, const Tracer& tracer,
                                          float regular_m, glm::vec3 position_m, float range_m,
                                          int threads)
{
    std::vector<std::uint8_t> reached(near.entries(), 0);
    constexpr std::size_t kEntriesAJob = 256;
    parallel_for((reached.size() + kEntriesAJob - 1) / kEntriesAJob, threads, [&](std::size_t job) {
        const std::size_t last = std::min(reached.size(), (job + 1) * kEntriesAJob);
        for (std::size_t e = job * kEntriesAJob; e < last; ++e) {
            const glm::vec3 n = near_normal(near, e);
            const glm::vec3 way = position_m - near.corners[e][0];
            if (!(std::sqrt(glm::dot(way, way)) < range_m + 2.0f * regular_m)) continue;
            for (std::size_t k = 0; k < NearLinks::kSamples; ++k) {
                const glm::vec3 x = lamp_point(near.corners[e], k);
                const glm::vec3 from = x + n * ray_lift_m(x, regular_m);
                const glm::vec3 d = position_m - from;
                const float length = std::sqrt(glm::dot(d, d));
                if (!(glm::dot(d, n) > 0.0f)) continue;
                const bool blocked =
                    length > kLanternRadius_m &&
                    tracer.blocked({from, d / length, length - kLanternRadius_m});
                if (!blocked) reached[e] = static_cast<std::uint8_t>(reached[e] | 1u << k);
            }
        }
    });
    return reached;
}

void add_sun(const NearLinks& near, glm::vec3 towards_sun, glm::vec3 illuminance,
             std::vector<glm::vec3>& direct)
{
    for (std::size_t e = 0; e < near.entries(); ++e) {
        const float cosine = glm::dot(near_normal(near, e), towards_sun);
        if (cosine > 0.0f)
            direct[e] += illuminance * (cosine * visible_share(near.visible[e], towards_sun));
    }
}

void add_lamp(const NearLinks& near, const Light& light, std::span<const std::uint8_t> reach,
              std::vector<glm::vec3>& direct)
{
    if (light.kind == LightKind::Directional) {
        add_sun(near, -light.direction, light.color * light_candela(light), direct);
        return;
    }
    constexpr float kShare = 1.0f / static_cast<float>(NearLinks::kSamples);
    for (std::size_t e = 0; e < near.entries(); ++e) {
        const std::uint32_t bits = reach.empty() ? NearLinks::kAllLit : reach[e];
        if (bits == 0) continue;
        const auto& c = near.corners[e];
        const glm::vec3 n = near_normal(near, e);
        const glm::vec3 d = c[2] - c[0];
        // A quarter of it is no point: nearer than its own size its light does not grow.
        const float least_m = 0.25f * std::sqrt(glm::dot(d, d));
        for (std::size_t k = 0; k < NearLinks::kSamples; ++k) {
            if ((bits >> k & 1u) != 0u) direct[e] += lamp_irradiance(light, lamp_point(c, k), n, least_m) * kShare;
        }
    }
}

}  // namespace petrichor::scene
