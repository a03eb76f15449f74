#include "scene/light_profile.h"

#include <algorithm>
#include <cmath>

#include "formulas/light/light_profile.h"
#include "scene/light_shape.h"

namespace petrichor::scene {

static_assert(kLightProfileSide == static_cast<int>(shared::kProfileTexels));

namespace {

glm::vec3 texels_at(const LightProfile& profile, glm::vec2 place, bool wraps)
{
    const glm::ivec2 low(place);
    const glm::vec2 part = place - glm::vec2(low);
    const int last = kLightProfileSide - 1;
    glm::ivec2 high = glm::min(low + 1, glm::ivec2(last));
    if (wraps && low.x == last) high.x = 0;
    const auto texel = [&](int x, int y) { return profile.texels[static_cast<std::size_t>(y * kLightProfileSide + x)]; };
    const glm::vec3 above = glm::mix(texel(low.x, low.y), texel(high.x, low.y), part.x);
    const glm::vec3 below = glm::mix(texel(low.x, high.y), texel(high.x, high.y), part.x);
    return glm::mix(above, below, part.y);
}

}  // namespace

glm::vec3 profile_towards(const Light& light, std::span<const LightProfile> profiles, glm::vec3 away, float far_m)
{
    if (light.profile < 0 || static_cast<std::size_t>(light.profile) >= profiles.size()) return glm::vec3(1.0f);
    const LightProfile& profile = profiles[static_cast<std::size_t>(light.profile)];
    if (profile.lantern) {
        const glm::vec2 seen(texels_at(profile, shared::lantern_place(away), false));
        return glm::vec3(shared::lantern_seen(seen, away, far_m));
    }
    const glm::vec3 up = up_of(light);
    const glm::vec3 right = glm::cross(light.direction, up);
    const glm::vec3 at(glm::dot(away, right), glm::dot(away, up), glm::dot(away, light.direction));
    if (!profile.picture) return texels_at(profile, shared::photometry_place(at), true);
    if (at.z <= 0.0f) return glm::vec3(0.0f);
    return texels_at(profile, shared::cookie_place(at, std::cos(light.outer_cone_rad)), false);
}

}  // namespace petrichor::scene
