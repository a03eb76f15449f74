#ifndef PETRICHOR_SCENE_PATCHES_LIGHT_MAP_H
#define PETRICHOR_SCENE_PATCHES_LIGHT_MAP_H

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "base/interrupted.h"
#include "scene/patches/patches.h"
#include "scene/patches/tracer.h"

namespace petrichor::scene {

/// What falls on a scene when its light maps are baked. Light: lux by channel.
struct BakeLight {
    std::span<const glm::vec3> radiosity;  ///< of leaves (PatchIrradiance::radiosity): what rays bring
    std::span<const glm::vec3> sky;        ///< pi x mean radiance of a sky bin, kSkyBins entries
    std::span<const Light> lamps;          ///< whose light falls on surfaces directly, with its shadow
    std::span<const LightProfile> profiles = {};  ///< Scene::light_profiles, that lamps shine by
    /// If any: beside the light, how much of these is seen. Light::mask_channel is where: 0 the sun's red, 1
    /// green, 2 blue, 3 alpha. Of several in one channel the one that gives most light there.
    std::span<const Light> masked = {};
};

struct BakeOptions {
    int size = 512;  ///< texels along an edge of a map, 8..8192
    int rays = 256;  ///< of a texel, 16..4096
    int spread = 16; ///< texels by which islands grow into the gaps between them, >= 0
    std::uint32_t seed = 1;
    int threads = 0;  ///< 0: all cores; the result is the same for any number
    PatchProgress progress;
    StopRequest stop;
};

/// The light map of one material: irradiance of its surfaces over their texture coordinates.
struct LightMap {
    std::uint32_t material = 0;
    int size = 0;
    std::vector<glm::vec3> lux;  ///< size * size, row 0 at v = 0; 0 where no island is near
    /// Of shadow masks: by texel and channel how much is seen of what shines there, 0..1; 0
    /// behind its back, 1 in channels that nothing has.
    std::vector<glm::vec4> seen;
    int texcoord = 1;            ///< the coordinates: the second, or the first without them
    double covered = 0.0;        ///< share of texels that a surface lies on
    double shared = 0.0;         ///< share of those that several surfaces lie on: a mean of them
};

struct LightMaps {
    std::vector<LightMap> maps;  ///< by material, ascending
    std::vector<int> channels;  ///< of shadow masks: Light::mask_channel of the scene's lamps
    /// Materials without one: their coordinates are of no area, or lay more than four surfaces over
    /// each texel in the mean.
    std::vector<std::uint32_t> left_out;
};

/// Bakes a map for each material that stops light. Every texel is asked at up to four points of its
/// surface, as the light map's transform of the material lays it (TextureUse of light_map, if it has
/// one): lamps by shadow rays, all else by rays over the cosine, which bring the radiosity of the patch
/// or the sky that they meet. Points inside a body (most rays meet backs) count as gaps.
///
/// Deterministic: the same bits for any number of threads.
///
///   throws   Error for options out of range, Interrupted when `stop` says so.
///   source   final gathering: Reichert 1992, Christensen 1999.
LightMaps bake_light_maps(const Tracer& tracer, const Patches& patches, const BakeLight& light,
                          const BakeOptions& options = {});

}  // namespace petrichor::scene

#endif
