#ifndef PETRICHOR_SCENE_SNOW_DETAIL_CAP_GROUND_H
#define PETRICHOR_SCENE_SNOW_DETAIL_CAP_GROUND_H

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <utility>
#include <vector>

#include "scene/snow/snow_caps.h"
#include "scene/subdivide/subdivide.h"

namespace petrichor::scene::detail {

/// Share of the sky that is none.
inline constexpr float kHidden = 0.1f;

/// 0 where caps are as if near everywhere.
float nearest_eye_m(const SnowCapOptions& options, const glm::vec3& p);

/// What faces up, in the world: a primitive for each of the scene's, with the exposure in w of _WEATHER.
struct Ground {
    std::vector<Primitive> primitives;
    std::vector<std::uint32_t> instances;
    std::vector<std::uint32_t> numbers;             ///< of the primitives in their meshes
    std::vector<std::vector<std::uint32_t>> below;  ///< of each primitive, by its triangles: which of the mesh's it was
};

/// Keeps those triangles of a primitive that are wanted, and forgets which the others were a part of.
class Keeper {
public:
    explicit Keeper(Ground& ground) : ground_(&ground) {}

    template <class Wanted>
    void keep(CutMesh& mesh, std::size_t i, const Wanted& wanted)
    {
        Primitive& p = mesh.primitives[i];
        std::vector<std::uint32_t> kept, origins;
        for (std::size_t k = 0; k + 2 < p.indices.size(); k += 3) {
            const std::uint32_t origin = mesh.origins[i][k / 3];
            if (!wanted(k)) {
                ground_->below[i][origin] = SnowCaps::kUncovered;
                continue;
            }
            kept.insert(kept.end(), {p.indices[k], p.indices[k + 1], p.indices[k + 2]});
            origins.push_back(origin);
        }
        p.indices = std::move(kept);
        mesh.origins[i] = std::move(origins);
    }

private:
    Ground* ground_;
};

Ground ground_of(const Scene& scene, const SnowCapOptions& options);

/// What sees none of the sky, within houses and under eaves, has no cap.
void leave_out_hidden(CutMesh& mesh, Keeper keeper);

/// Pieces that hang together and are narrower than 4 cm hold none.
void leave_out_ledges(CutMesh& mesh, const Tracer& tracer, Keeper keeper);

/// Which triangle of the first mesh each is a part of, after a second cut.
std::vector<std::vector<std::uint32_t>> composed(const std::vector<std::vector<std::uint32_t>>& first,
                                                 std::vector<std::vector<std::uint32_t>> second);

}  // namespace petrichor::scene::detail

#endif
