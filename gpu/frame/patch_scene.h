#ifndef PETRICHOR_GPU_FRAME_PATCH_SCENE_H
#define PETRICHOR_GPU_FRAME_PATCH_SCENE_H

#include <cstdint>
#include <vector>

#include "scene/patches/patches.h"
#include "scene/patches/radiosity.h"
#include "scene/patches/surfaces.h"
#include "scene/probes/probes.h"

namespace petrichor::gpu {

/// Probes that a scene may have.
inline constexpr std::size_t kMostProbes = 8;

/// What light between the surfaces of a scene needs: its patches, what they are made of, and what
/// was traced to its lamps.
struct PatchScene {
    scene::Patches patches;
    std::vector<scene::PatchSurface> surfaces;  ///< a leaf each
    std::vector<scene::Material> materials;     ///< of the scene, for their weather
    scene::GlowLinks glow;                      ///< of the patches that glow
    scene::NearLinks near;                      ///< what stands close to patches; empty: not asked
    std::vector<scene::PatchSurface> near_surfaces;     ///< a source of it each
    std::vector<std::vector<std::uint8_t>> near_reach;  ///< a light each: trace_near_lamp of its sources
    /// A light of Scene::lights each: share of 255 of a leaf that it reaches; empty where it reaches
    /// all that it faces (directional lights go by the visibility bits).
    std::vector<std::vector<std::uint8_t>> lamp_reach;
    std::vector<scene::LightProfile> light_profiles;  ///< Scene::light_profiles, that its lamps shine by
    std::vector<scene::TracedProbe> probes;  ///< what mirrors see of the scene; at most kMostProbes
};

}  // namespace petrichor::gpu

#endif
