#include "scene/patches/lamps.h"

#include <algorithm>
#include <cmath>

#include "formulas/light/brdf.h"
#include "scene/light_profile.h"
#include "scene/light_shape.h"
#include "scene/patches/radiosity.h"

namespace petrichor::scene {

glm::vec3 lamp_irradiance(const Light& light, std::span<const LightProfile> profiles, glm::vec3 position_m,
                          glm::vec3 normal, float least_m)
{
    const glm::vec3 color = light.color * light_candela(light);
    if (light.kind == LightKind::Directional)
        return color * std::max(glm::dot(normal, -light.direction), 0.0f);
    const glm::vec3 way = light.position_m - position_m;
    const float distance = std::sqrt(glm::dot(way, way));
    if (!(distance > 0.0f)) return glm::vec3(0.0f);
    const glm::vec3 towards = way / distance;
    const float cosine = glm::dot(normal, towards);
    if (cosine <= 0.0f) return glm::vec3(0.0f);
    float falloff = shared::light_attenuation(std::max(distance, least_m), light.range_m);
    if (light.kind == LightKind::Spot) {
        falloff *= shared::spot_attenuation(glm::dot(light.direction, -towards),
                                            std::cos(light.inner_cone_rad),
                                            std::cos(light.outer_cone_rad));
    }
    if (!(falloff > 0.0f)) return glm::vec3(0.0f);
    return color * profile_towards(light, profiles, -towards, distance) * (cosine * falloff);
}

std::vector<glm::vec3> lamps_that_cut(const Scene& scene)
{
    constexpr std::size_t kMostLamps = 64;
    std::vector<glm::vec3> lamps_m;
    for (const Light& light : scene.lights) {
        const glm::vec3 at = light.position_m;
        if (light.kind != LightKind::Directional && light.intensity > 0.0f && std::isfinite(at.x + at.y + at.z)) lamps_m.push_back(at);
    }
    if (lamps_m.size() > kMostLamps) lamps_m.clear();
    return lamps_m;
}

bool lamp_seen(const Tracer& tracer, const Light& light, glm::vec3 from)
{
    if (light.kind == LightKind::Directional) {
        Ray ray;
        ray.origin = from;
        ray.direction = -light.direction;
        return !tracer.blocked(ray);
    }
    const glm::vec3 way = light.position_m - from;
    const float length = std::sqrt(glm::dot(way, way));
    return length <= kLanternRadius_m ||
           !tracer.blocked({from, way / length, length - kLanternRadius_m});
}

void add_lamp(const Patches& patches, const Light& light, std::span<const LightProfile> profiles,
              std::span<const std::uint8_t> reach, std::vector<glm::vec3>& direct)
{
    if (light.kind == LightKind::Directional) {
        add_sun(patches, -light.direction, light.color * light_candela(light), direct);
        return;
    }
    for (std::uint32_t i = 0; i < patches.count; ++i) {
        const float seen = reach.empty() ? 1.0f : static_cast<float>(reach[i]) / 255.0f;
        if (seen <= 0.0f) continue;
        // A patch is no point: nearer than its own size its light does not grow.
        direct[i] += lamp_irradiance(light, profiles, patches.position_m[i], patches.normal[i],
                                     0.5f * std::sqrt(patches.area_m2[i])) *
                     seen;
    }
}

}  // namespace petrichor::scene
