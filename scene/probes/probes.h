#ifndef PETRICHOR_SCENE_PROBES_PROBES_H
#define PETRICHOR_SCENE_PROBES_PROBES_H

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "formulas/light/spherical_harmonics.h"
#include "scene/patches/patches.h"
#include "scene/patches/surfaces.h"

namespace petrichor::scene {

/// Where a reflection probe stands and whom it serves.
struct ProbePlace {
    glm::vec3 position_m{0.0f};
    /// The walls that its light is taken to come from, and within which it counts, metres in the world.
    glm::vec3 low_m{-1e4f}, high_m{1e4f};
    float blend_m = 1.0f;     ///< outside the box it fades over so much
    float importance = 0.0f;  ///< of two at a place the higher counts; 0..5
    float intensity = 1.0f;   ///< times its light
    bool operator==(const ProbePlace&) const = default;
};

/// What a ray from a probe met.
struct ProbeTexel {
    static constexpr std::uint32_t kSky = 0xffffffffu;
    static constexpr std::uint32_t kBlack = 0xfffffffeu;  ///< a surface without a patch
    static constexpr float kTintScale = 64.0f;
    std::uint32_t patch = kSky;
    /// Base colour of the point over that of its patch, times the colours of the mirrors before it and kTintScale.
    std::uint8_t tint[4] = {64, 64, 64, 0};
};

struct TracedProbe {
    ProbePlace place;
    /// kProbeSide x kProbeSide, directions by octahedral_decode, row 0 at -1.
    std::vector<ProbeTexel> texels;
    /// Radiance of as many texels, in place of what was met; empty: none.
    std::vector<glm::vec3> picture;
};

/// A lat-long picture (three floats a pixel, row 0 is up, its middle -z) as a probe holds it: each texel
/// the mean of its solid angle.
std::vector<glm::vec3> probe_picture(int width, int height, std::span<const float> rgb);

/// One ray a texel, on from smooth metal as from a mirror, up to four times. Deterministic for any number of threads.
TracedProbe trace_probe(const Patches& patches, const Tracer& tracer,
                        std::span<const PatchSurface> surfaces, std::span<const ColorImage> images,
                        const ProbePlace& place, int threads = 0);

/// A few places from which the scene is well seen, at most `most`: 1.6 m above ground that has room over
/// it, as far from each other as can be. Their boxes are the walls around them. None for a scene without
/// such ground, and none of a scene that is smaller than a step.
std::vector<ProbePlace> place_probes(const Patches& patches, const Tracer& tracer, std::size_t most);

/// Light of a probe: rgb radiance of surfaces, a: share of sky, which is left to who looks.
/// `radiosity` of the patches; levels as formulas/light/reflection_probe.h has them, borders included.
/// Each level is the light as a GGX lobe of its roughness about the direction gathers it.
///   rough  radiosity for the levels behind the first, where what glows is a light of its own; empty: the same
std::vector<glm::vec4> lit_probe(const TracedProbe& probe, std::span<const glm::vec3> radiosity,
                                 std::span<const glm::vec3> rough = {});

/// The same of what rough surfaces see, as harmonics (formulas/light/spherical_harmonics.h): the sum over them times
/// shared::ggx_band is what a lobe gathers. light: as lit_probe() gives it.
std::array<glm::vec4, shared::kHarmonics> probe_bands(std::span<const glm::vec4> light);

}  // namespace petrichor::scene

#endif
