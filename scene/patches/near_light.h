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

struct GlowLinks;

/// Under one light, a leaf each, by luminance: what patches send and what they get. Which polygons count is judged by it.
struct NearHint {
    std::vector<float> radiosity;
    std::vector<float> irradiance;
};

/// Surfaces that stand closer to a patch than it is wide, as polygons: what a point of the patch gets from
/// them goes by the point's own form factor, not by the patch's mean. A sunlit sill a finger's breadth
/// below a wall lights that breadth alone. Each polygon has a material and light of its own: what a patch is
/// there is often the mean of a frame, a sheet of zinc and the wall behind.
struct NearLinks {
    static constexpr std::uint32_t kMostAPatch = 7;
    static constexpr std::size_t kLinks = 32;      ///< rays of a source
    static constexpr std::size_t kSamples = 4;     ///< points of a source: its colour, its lamps
    static constexpr std::uint8_t kAllLit = 15;    ///< bits of kSamples

    /// Of leaf i: entries first[i] .. first[i + 1]; empty: of no patches.
    std::vector<std::uint32_t> first;
    // Of entries.
    /// Corners in turn, seen from the front; of a triangle the last one twice.
    std::vector<std::array<glm::vec3, 4>> corners;
    std::vector<float> seen;            ///< of it, from the patch: shared::near_seen, its reach a regular cell
    std::vector<std::uint32_t> source;  ///< what it sends

    // Of sources: pieces of faces, as long as a cell, that entries of all patches around share.
    std::vector<glm::vec3> normal;   ///< the front, unit
    std::vector<glm::vec3> points;   ///< kSamples each, metres: where it shows
    /// The patch on whose surface it lies, of a mean of surfaces: weather of places, light of what glows far away.
    std::vector<std::uint32_t> sender;
    std::vector<std::uint32_t> material;  ///< index into Scene::materials
    std::vector<PatchSample> samples;     ///< kSamples each, of `points`
    std::vector<std::array<std::uint32_t, 8>> visible;  ///< as Patches::visible
    std::vector<std::uint16_t> links;                   ///< kLinks each, as Patches::links
    /// Of source s, glow_first[s] .. glow_first[s + 1]: glowing patches that are close to it, and how much more of them
    /// its own rays meet than its sender's pairs say. Empty without GlowLinks.
    std::vector<std::uint32_t> glow_first;
    std::vector<std::uint32_t> glow_patch;
    std::vector<float> glow_more;
    /// Of each of GlowLinks::factor: share of 255 that the receiver's entries stand for.
    std::vector<std::uint8_t> glow_taken;
    /// Of leaf i: rays of its row that met its entries, rays[ray_first[i] .. ray_first[i + 1]].
    std::vector<std::uint32_t> ray_first;
    std::vector<std::uint16_t> rays;

    bool empty() const { return first.empty(); }
    std::size_t entries() const { return source.size(); }
    std::size_t sources() const { return sender.size(); }
    std::uint32_t rays_of(std::uint32_t leaf) const { return ray_first[leaf + 1] - ray_first[leaf]; }
};

/// Looks up all faces within a cell's edge of the points that ask a patch for them, whether a ray of its row meets them
/// or not, cuts them to that distance around, and keeps those without which the squares of the error would be largest:
/// form factor squared over the patch, times the light that the patch there sends under each hint, over that which
/// arrives. Same bits for any number of threads.
///
///   glow    of these patches; null: none
///   hints   lights of the scene; besides them everything counts as equally bright
///   source  Lambert 1760 (form factor of a polygon from a point); Baum et al. 1989 (closed form for what is
///           close, rays for the rest).
NearLinks trace_near(const Patches& patches, const Tracer& tracer, const GlowLinks* glow = nullptr,
                     std::span<const NearHint> hints = {}, int threads = 0);

/// The middle of a source where it shows, metres.
glm::vec3 near_middle(const NearLinks& near, std::size_t source);

/// Which of a source's kSamples points a lamp reaches, a bit each, as trace_lamp of patches.
std::vector<std::uint8_t> trace_near_lamp(const NearLinks& near, const Tracer& tracer,
                                          float regular_m, glm::vec3 position_m, float range_m,
                                          int threads = 0);

/// What falls directly on the sources, as add_sun and add_lamp of patches: the mean over the points that a lamp
/// reaches. reach: trace_near_lamp; empty: all. direct: one number a source.
void add_sun(const NearLinks& near, glm::vec3 towards_sun, glm::vec3 illuminance,
             std::vector<glm::vec3>& direct);
void add_lamp(const NearLinks& near, const Light& light, std::span<const LightProfile> profiles,
              std::span<const std::uint8_t> reach, std::vector<glm::vec3>& direct);

}  // namespace petrichor::scene

#endif
