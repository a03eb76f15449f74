#ifndef PETRICHOR_GPU_PASSES_LIGHTS_LIGHTS_H
#define PETRICHOR_GPU_PASSES_LIGHTS_LIGHTS_H

#include <functional>
#include <memory>
#include <vector>

#include "gpu/device/graph.h"
#include "gpu/frame/constants_range.h"
#include "gpu/frame/frame.h"
#include "gpu/frame/targets.h"
#include "gpu/passes/lights/light_turns.h"
#include "gpu/upload/scene_names.h"

namespace petrichor::gpu {

/// Lights as the shaders read them: LIGHT_TEXELS texels each (lights_io.h). Directional lights come
/// first, then with a shadow points and spots, what is lit by its shape, then both without one: a device without
/// branches of its own does for all lights of a loop what any of them needs, so each kind has a loop.
struct LightTable {
    std::unique_ptr<GpuBuffer> texels;
    std::uint32_t count = 0;
    std::uint32_t directional = 0;
    std::uint32_t shaped_shadows = 0;  ///< number of the first with a shadow that is lit by its shape
    std::uint32_t plain = 0;   ///< number of the first point or spot without a shadow
    std::uint32_t shaped = 0;  ///< number of the first of what is left
    bool rectangles = false;         ///< some are surfaces that glow, without the lobes of those with a size
    bool glows = false;              ///< some are surfaces that glow
    std::uint32_t ways = 0;          ///< LIGHTS_... that some need
    std::vector<glm::vec4> balls;    ///< centre and reach of each, where so many walked so often may be more than kLightsAnywhere
    std::vector<glm::vec4> vertex_balls;  ///< of lamps by vertex, whose rows stand behind those counted here
    std::uint32_t vertex_ways = 0;        ///< LIGHTS_... that those need
    std::vector<Light> shadowed;     ///< that own a shadow, in the order of its maps
    std::vector<Light> brightest;    ///< at most kBrightestLamps, as the eye sees them

    std::uint32_t words() const { return (count + 31) / 32; }
};

/// So many lamps light what floats in the air.
inline constexpr int kBrightestLamps = 16;

/// Lamps of unlimited range end where they give so little, lux, or farther in, where the exposure shows less.
inline constexpr float kFaintestLux = 0.01f;

/// What a lamp may give where its light ends, lux, kFaintestLux at least: so much that white paper in the dark
/// comes out brighter by kUnseenCodes, where the curve to the display is steepest. All that is left out within
/// the reach, by its window, is less. Depends on this frame alone; falls as the exposure rises.
///
///   exposure  linear scale of radiance, with its bias; 0: not known, kFaintestLux
///   settings  the curve; its least_lux, if given, is what is returned
float least_lux(const FrameSettings& settings, float exposure);
inline constexpr float kUnseenCodes = 1.0f / 16.0f;  // of 255

/// Distance at which a light is taken to have faded to so many lux, metres. Ranges that a scene gives are kept,
/// but not beyond where more than kFaintestLux is asked for.
float light_radius_m(const Light& light, float least_lux = kFaintestLux);

/// Throws Error when the lists of so many lights at that size are more than the device can bind.
void check_light_lists(const VkPhysicalDeviceLimits& limits, std::size_t lights, int width,
                       int height);

/// Throws Error when so many lights may reach one part of the picture that loops over them could end early.
///
///   views  of all samples
///   walks  times that a pixel goes over its lights, 1..kMostLightWalks
void check_light_crowd(const LightTable& table, const FrameSettings& settings,
                       const std::vector<shared::FrameConstants>& views, std::size_t walks);

struct LightTableParams {
    int shadows = 0;  ///< so many lamps own a shadow: those that give most light at the eye, by intensity over
                      ///< squared distance (at least a metre), the earlier of equals
    glm::vec3 eye_m{0.0f};
    AreaLights area = AreaLights::Ltc;  ///< how their size is lit
    float least_lux = kFaintestLux;     ///< where they end
    /// Whether anything in a ball may be seen: lamps whose reach is not are left out, with their shadows.
    std::function<bool(const glm::vec3& centre_m, float radius_m)> in_view = {};
};

LightTable make_light_table(const Device& device, MemoryArena& arena,
                            const std::vector<Light>& lights, const LightTableParams& params);

// Finds, for each tile of 16 x 16 pixels, the lights that can reach what is seen there.
//
//   reads    depth, the light table
//   writes   coarse_lights, light_lists (ordered by light: sums are bit-exact)
void add_light_lists(FrameGraph& graph, FrameTargets& targets, LightTable& lights,
                     const ConstantsRange& constants);

}  // namespace petrichor::gpu

#endif
