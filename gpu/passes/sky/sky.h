#ifndef PETRICHOR_GPU_PASSES_SKY_SKY_H
#define PETRICHOR_GPU_PASSES_SKY_SKY_H

#include <optional>
#include <vector>

#include "gpu/device/graph.h"
#include "gpu/frame/frame.h"
#include "gpu/passes/sky/scattered_again.h"
#include "gpu/passes/sky/sky_light_io.h"

namespace petrichor::gpu {

/// The light that comes from all around, in the forms that lighting needs.
struct SkyMaps {
    SkyMaps(const Device& device, MemoryArena& arena);

    std::unique_ptr<GpuImage> air;       ///< clear air by direction
    std::unique_ptr<GpuImage> cube;      ///< the sky or the environment, with mips
    std::unique_ptr<GpuImage> specular;  ///< as GGX lobes see it, one roughness a mip
    std::unique_ptr<GpuBuffer> quads;    ///< of specular and of the air's level of cube (gpu/frame/sky_quads_io.h)
    std::unique_ptr<GpuImage> env_brdf;  ///< scale and offset of F0
    std::unique_ptr<GpuBuffer> light;    ///< shared::SkyLight
    std::unique_ptr<GpuBuffer> tiles;    ///< of the cube that are drawn next
    std::unique_ptr<GpuBuffer> again;    ///< ScatteredAgain::Table of the sky that is drawn
    SamplerHandle linear;                ///< clamped, trilinear
    SamplerHandle wrap_u;                ///< lat-long maps
    bool env_brdf_valid = false;
    // What the cube holds now; equal skies are not drawn again.
    shared::SkyParams drawn{};
    float environment_scale = 0.0f;
    float environment_rotation_rad = 0.0f;
    bool drawn_valid = false;
    std::vector<bool> tiles_drawn;  ///< of the first level of the cube

    // Of the haze and sun of the last frame.
    std::optional<ScatteredAgain> scattered;
    ScatteredAgain::Table table{};
    glm::vec3 level_of{-2.0f};       ///< turbidity, albedo of the land, cosine of the sun
    glm::vec3 clear_level{0.0f};  ///< on level ground, for a sun of illuminance 1
};

/// The light of the sky as the uniform block that shaders read.
Binding sky_light_binding(SkyMaps& maps);

// Split-sum table of GGX; once.
void add_env_brdf(FrameGraph& graph, SkyMaps& maps);

/// Analytic sky of the frame, with the land lit by it (snow brightens the land). Writes the table of
/// scattered light where haze or land are others than those of the frame before.
shared::SkyParams sky_params(const Frame& frame, SkyMaps& maps);

// The analytic sky as light: clear air, clouds, land. What is seen of it is drawn by add_seen_sky.
//
//   writes   air where it is not that of maps.drawn, cube from the level on that light reads, specular, quads
void add_analytic_sky(FrameGraph& graph, SkyMaps& maps, const shared::SkyParams& params);

// The same sky as the background shows it.
//
//   tiles    that a picture may show (seen_sky())
//   writes   those of the first level of the cube that are not drawn yet
void add_seen_sky(FrameGraph& graph, SkyMaps& maps, const shared::SkyParams& params,
                  const std::vector<std::uint32_t>& tiles);

// A lat-long map as the sky.
void add_environment(FrameGraph& graph, SkyMaps& maps, GpuImage& lat_long, float scale,
                     float rotation_rad);

/// For sky_light: irradiance and exposure.
struct Metering {
    glm::vec3 sun_illuminance{0.0f};
    float sun_up = 0.0f;
    float exposure = 0.0f;  ///< > 0: given
    float bias = 1.0f;
    float ambient_scale = 1.0f;
    float floor_lux = 1.0f;
};

// Irradiance of the sky, and the exposure.
//
//   reads    cube
//   writes   light
void add_sky_light(FrameGraph& graph, SkyMaps& maps, const Metering& metering);

}  // namespace petrichor::gpu

#endif
