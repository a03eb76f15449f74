#include "scene/patches/detail/near_rays.h"

#include "scene/patches/detail/cells.h"
#include "scene/patches/detail/links.h"
#include "scene/patches/detail/near_faces.h"
#include "scene/patches/detail/sampling.h"

namespace petrichor::scene {
namespace {

constexpr int kRedraws = 3;  // of a ray that starts inside something

}  // namespace

NearMeets near_meets(const Patches& patches, const Tracer& tracer, const std::array<glm::vec3, 4>& corners, int r,
                     int rays, std::uint64_t hash)
{
    const Triangles& triangles = tracer.triangles();
    const glm::vec3 n = front_of(corners);
    for (int draw = 0; draw <= kRedraws; ++draw) {
        const std::uint64_t at = mixed(hash, static_cast<std::uint64_t>(r * (kRedraws + 1) + draw));
        const glm::vec3 x = point_in(corners, unit_float(at), unit_float(mixed(at, 5)));
        const Ray ray{x + n * ray_lift_m(x, patches.level_cell_m(1)), row_direction(n, r, rays, hash)};
        const RayHit hit = tracer.nearest(ray);
        if (!hit.hit()) {
            const int bin = shared::sky_bin_left(ray.direction);
            return {patches.count + static_cast<std::uint32_t>(bin), RayHit::kNothing, 0.0f, x, false, draw + 1};
        }
        if (hit.back && !triangles.double_sided(hit.triangle)) continue;
        return {patch_of_hit(patches, triangles, ray, hit), hit.triangle, hit.distance_m, x, false, draw + 1};
    }
    return {patches.black(), RayHit::kNothing, 0.0f, {}, true, kRedraws + 1};
}

float glow_of(const Triangles& triangles, std::uint32_t triangle)
{
    const Material& m = triangles.scene().materials[triangles.material(triangle)];
    return m.emissive_strength * glm::dot(m.emissive, glm::vec3(0.2126f, 0.7152f, 0.0722f));
}

}  // namespace petrichor::scene
