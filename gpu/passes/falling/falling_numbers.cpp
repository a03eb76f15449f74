#include "gpu/passes/falling/falling_numbers.h"

#include <algorithm>

#include "formulas/light/brdf.h"
#include "formulas/weather/falling.h"

namespace petrichor::gpu {

glm::vec3 light_of(const std::vector<Light>& lamps, const glm::vec3& p, const glm::vec3& eye_m,
                   bool flake)
{
    glm::vec3 sum(0.0f);
    const glm::vec3 to_eye = glm::normalize(eye_m - p);
    for (const Light& lamp : lamps) {
        const glm::vec3 way = p - lamp.position_m;
        const float distance = std::max(glm::length(way), 0.05f);
        const glm::vec3 onward = way / distance;
        float strength = lamp.intensity * shared::light_attenuation(distance, lamp.range_m);
        if (lamp.kind == LightKind::Spot) {
            strength *= shared::spot_attenuation(glm::dot(lamp.direction, onward),
                                                 std::cos(lamp.inner_cone_rad),
                                                 std::cos(lamp.outer_cone_rad));
        } else if (lamp.kind == LightKind::Rectangle) {
            const float facing = glm::dot(lamp.direction, onward);
            strength *= 4.0f * glm::length(lamp.half_u_m) * glm::length(lamp.half_v_m) *
                        (lamp.both_sides ? std::abs(facing) : std::max(facing, 0.0f));
        }
        const float cosine = glm::dot(onward, to_eye);
        sum += lamp.color *
               (strength * (flake ? shared::flake_phase(cosine) : shared::drop_phase(cosine)));
    }
    return glm::min(sum, glm::vec3(60000.0f));
}

}  // namespace petrichor::gpu
