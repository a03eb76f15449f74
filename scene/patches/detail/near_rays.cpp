#include "scene/patches/detail/near_rays.h"

#include <numeric>
#include <vector>

#include "scene/patches/detail/cells.h"
#include "scene/patches/detail/links.h"
#include "scene/patches/detail/near_faces.h"
#include "scene/patches/detail/sampling.h"

namespace petrichor::scene {
namespace {

constexpr int kRedraws = 3;  // of a ray that starts inside something

}  // namespace

void near_meets(const Patches& patches, const Tracer& tracer, const std::array<glm::vec3, 4>& corners, int every,
                int rays, std::uint64_t hash, std::span<NearMeets> met)
{
    const Triangles& triangles = tracer.triangles();
    const glm::vec3 n = front_of(corners);
    const Tangents frame = tangents_of(n);
    std::vector<Ray> asked(met.size());
    std::vector<RayHit> hits(met.size());
    std::vector<glm::vec3> from(met.size()), towards(met.size());
    std::vector<std::size_t> left(met.size()), again;
    std::iota(left.begin(), left.end(), std::size_t{0});
    for (std::size_t k = 0; k < met.size(); ++k)
        towards[k] = turned(frame, n, local_row_direction(static_cast<int>(k) * every, rays, hash));
    for (int draw = 0; draw <= kRedraws && !left.empty(); ++draw) {
        for (std::size_t i = 0; i < left.size(); ++i) {
            const std::size_t k = left[i];
            const std::size_t r = k * static_cast<std::size_t>(every);
            const std::uint64_t at = mixed(hash, r * (kRedraws + 1) + static_cast<std::size_t>(draw));
            from[k] = point_in(corners, unit_float(at), unit_float(mixed(at, 5)));
            asked[i] = {from[k] + n * ray_lift_m(from[k], patches.level_cell_m(1)), towards[k]};
        }
        tracer.nearest({asked.data(), left.size()}, hits);
        again.clear();
        for (std::size_t i = 0; i < left.size(); ++i) {
            const std::size_t k = left[i];
            const RayHit& hit = hits[i];
            if (!hit.hit()) {
                const int bin = shared::sky_bin_left(towards[k]);
                met[k] = {patches.count + static_cast<std::uint32_t>(bin), RayHit::kNothing, 0.0f, from[k], false, draw + 1};
            } else if (hit.back && !triangles.double_sided(hit.triangle)) {
                again.push_back(k);
            } else {
                met[k] = {patch_of_hit(patches, triangles, asked[i], hit), hit.triangle, hit.distance_m, from[k], false, draw + 1};
            }
        }
        left.swap(again);
    }
    for (const std::size_t k : left)
        met[k] = {patches.black(), RayHit::kNothing, 0.0f, {}, true, kRedraws + 1};
}

float glow_of(const Triangles& triangles, std::uint32_t triangle)
{
    const Material& m = triangles.scene().materials[triangles.material(triangle)];
    return m.emissive_strength * glm::dot(m.emissive, glm::vec3(0.2126f, 0.7152f, 0.0722f));
}

}  // namespace petrichor::scene
