#ifndef PETRICHOR_SCENE_PATCHES_NEAR_LIGHT_H
#define PETRICHOR_SCENE_PATCHES_NEAR_LIGHT_H

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "scene/patches/patches.h"
#include "scene/scene.h"

namespace petrichor::scene {

/// Surfaces that stand closer to a patch than it is wide, as polygons: what a point of the patch gets from
/// them goes by the point's own form factor, not by the patch's mean. A sunlit sill a finger's breadth
/// below a wall lights that breadth alone.
struct NearLinks {
    static constexpr std::uint32_t kMostAPatch = 7;

    /// Of leaf i: entries first[i] .. first[i + 1]; empty: of no patches.
    std::vector<std::uint32_t> first;
    /// Corners in turn, seen from the front; of a triangle the last one twice.
    std::vector<std::array<glm::vec3, 4>> corners;
    std::vector<float> seen;  ///< 0..1 of it, by the patch's rays
    /// The patch that stands for it: colour and light from other surfaces. It may face another way; what
    /// falls on the entry directly is its own.
    std::vector<std::uint32_t> sender;
    std::vector<std::array<std::uint32_t, 8>> visible;  ///< as Patches::visible
    /// Of leaf i: rays of its row that met its entries, rays[ray_first[i] .. ray_first[i + 1]].
    std::vector<std::uint32_t> ray_first;
    std::vector<std::uint16_t> rays;
    /// The entry that each of those rays met, counted from first[i].
    std::vector<std::uint8_t> ray_entry;

    bool empty() const { return first.empty(); }
    std::uint32_t rays_of(std::uint32_t leaf) const { return ray_first[leaf + 1] - ray_first[leaf]; }
};

/// Traces the rows again and keeps what they meet within a cell's edge: the triangles that most rays meet,
/// cut to that distance around the cell and to what lies above the patch. Same bits for any number of
/// threads. Costs what the links cost.
///
///   source   Lambert 1760 (form factor of a polygon from a point); Baum et al. 1989 (closed form for what is
///            close, rays for the rest).
NearLinks trace_near(const Patches& patches, const Tracer& tracer, int threads = 0);

/// The front of an entry, unit.
glm::vec3 near_normal(const NearLinks& near, std::size_t entry);

/// Share of an entry that a lamp reaches, 0..255 of 255, as trace_lamp of patches.
std::vector<std::uint8_t> trace_near_lamp(const NearLinks& near, const Tracer& tracer,
                                          float regular_m, glm::vec3 position_m, float range_m,
                                          int threads = 0);

/// What falls directly on the entries, as add_sun and add_lamp of patches. direct: one number an entry.
void add_sun(const NearLinks& near, glm::vec3 towards_sun, glm::vec3 illuminance,
             std::vector<glm::vec3>& direct);
void add_lamp(const NearLinks& near, const Light& light, std::span<const std::uint8_t> reach,
              std::vector<glm::vec3>& direct);

}  // namespace petrichor::scene

#endif
