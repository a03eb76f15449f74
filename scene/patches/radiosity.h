#ifndef PETRICHOR_SCENE_PATCHES_RADIOSITY_H
#define PETRICHOR_SCENE_PATCHES_RADIOSITY_H

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "scene/patches/near_light.h"
#include "scene/patches/open_sky.h"
#include "scene/patches/patches.h"

namespace petrichor::scene {

/// Light in units of the caller, by channel: irradiance and radiosity in one (W/m2, lux), radiance
/// in the same over pi steradians.

/// Light of small bright patches, linked pair by pair: rays of a row meet them too seldom.
struct GlowLinks {
    std::vector<std::uint32_t> senders;  ///< patches, ascending; their emission is left out of rows
    /// Receiver i gets from entries first[i] .. first[i + 1]: form factor to senders[sender].
    std::vector<std::uint32_t> first;
    std::vector<std::uint32_t> sender;
    std::vector<float> factor;
    bool empty() const { return senders.empty(); }
};

/// Links between all patches and those of `senders` (ascending, distinct): four pairs of points a
/// pair of patches, cos cos' A / (pi r^2 + A), nothing below 1e-4. At most 4096 senders, the
/// brightest by the caller's choice; more are refused with an assertion.
GlowLinks trace_glow(const Patches& patches, const Tracer& tracer,
                     std::span<const std::uint32_t> senders, int threads = 0);

/// Light that falls on patches from a far away point: visibility by the traced bits, cosine by the
/// mean normal. illuminance: on a plane that faces it. Adds to `direct`, one entry a leaf.
void add_sun(const Patches& patches, glm::vec3 towards_sun, glm::vec3 illuminance,
             std::vector<glm::vec3>& direct);

/// Share of a patch that a point light reaches, 0..255 of 255, one entry a leaf; 0 beyond range_m.
/// Rays to four samples end 0.35 m before the light, since lamps sit inside their lanterns.
std::vector<std::uint8_t> trace_lamp(const Patches& patches, const Tracer& tracer,
                                     glm::vec3 position_m, float range_m, int threads = 0);

/// What no frame changes of what relight() asks of the links.
///
/// Small patches, as a wall beside a lamp, send more or less to wide ones than the rows of those say: of 128 rays one or
/// none meets such a wall, or three do. Its own rays tell the same by reciprocity, A_i F_ij = A_j F_ji, the better the
/// smaller it is: both together, each by its number of rays that are expected, have the least variance. Of cells in the open
/// alone, whose area is all seen (of leaves some is within).
struct StandingLinks {
    std::vector<std::uint16_t> above;   ///< a leaf each: its rays that leave the scene above the horizon
    std::vector<glm::vec2> turn;        ///< a leaf each: cosine and sine of how far its rays were turned about the normal
    std::vector<std::uint32_t> wide;    ///< leaves that stand in the open
    std::vector<std::uint32_t> first;   ///< of each and one more: where its entries begin
    std::vector<std::uint32_t> sender;  ///< of an entry: the smaller patch, once for each ray of one of the two that meets the other
    std::vector<float> weight;          ///< less than 0 of its own rays, more than 0 of those of the smaller one
    std::vector<OpenSky::Front> front;  ///< a leaf each
    std::vector<std::uint8_t> near_above;  ///< of NearLinks, a source each: its rays that leave the scene above the horizon
};
/// near: null: none
StandingLinks standing_links(const Patches& patches, const NearLinks* near = nullptr);

/// PatchIrradiance::near before there is light: what no frame changes of it.
std::vector<glm::vec4> near_texels(const NearLinks& near);

struct Relight {
    std::span<const glm::vec3> albedo;    ///< a leaf, 0..1; held to 0.98
    std::span<const glm::vec3> direct;    ///< irradiance of a leaf from sun and lamps
    std::span<const glm::vec3> emission;  ///< radiosity of a leaf by itself; empty: none
    std::span<const glm::vec3> sky;       ///< pi x mean radiance of a sky bin, kSkyBins entries
    std::span<const SkyTexel> sky_above = {};  ///< the same above the horizon, finer; empty: from the bins
    const GlowLinks* glow = nullptr;
    const NearLinks* near = nullptr;  ///< of these patches; for lookups that know them
    const StandingLinks* standing = nullptr;  ///< of these patches and `near`; none: found each time
    std::span<glm::vec4> near_texels = {};     ///< of `near`, where their light is to be put; empty: PatchIrradiance::near
    std::span<const glm::vec3> near_albedo;    ///< of its sources, as albedo
    std::span<const glm::vec3> near_direct;    ///< irradiance of its sources from sun and lamps
    std::span<const glm::vec3> near_emission;  ///< radiosity of its sources by themselves; empty: none
    int bounces = 3;  ///< between patches, 0..64; the light that then falls on them is gathered
    int threads = 0;
};

/// Light that patches get from each other and from the sky, without what falls on them directly.
struct PatchIrradiance {
    /// A node each: irradiance, w: Patches::open. With Relight::near both are of what is not close: the mean
    /// over the other directions, that a lookup takes for those that its point has left.
    std::vector<glm::vec4> irradiance;
    /// Four texels an entry of Relight::near: corners, w: the share that is seen, then the radiosity of its source
    /// by channel: by its own albedo, of the light that its own rays bring and what falls on it directly. Empty with
    /// Relight::near_texels.
    std::vector<glm::vec4> near;
    /// A node each: shared::irradiance_towards, w: lookup_sizes.
    std::vector<glm::vec4> gradient;
    /// A leaf each: what it sends out after `bounces`.
    std::vector<glm::vec3> radiosity;
};

/// B = emission + albedo (direct + F B), by Jacobi; a bounce loses at most the largest albedo's
/// share of what was left. Sums in the order of the links: the same bits for any number of threads.
///
///   source   Goral et al. 1984, Cohen et al. 1988.
PatchIrradiance relight(const Patches& patches, const Relight& input);

}  // namespace petrichor::scene

#endif
