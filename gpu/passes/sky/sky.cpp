#include "gpu/passes/sky/sky.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "formulas/light/atmosphere.h"
#include "formulas/light/brdf.h"
#include "formulas/light/cube_quads.h"
#include "formulas/light/fog.h"
#include "formulas/light/rain_curtains.h"
#include "formulas/weather/falling.h"
#include "gpu/frame/frame_constants.h"
#include "gpu/frame/frame_io.h"
#include "gpu/frame/sky_quads_io.h"
#include "gpu/frame/sun.h"
#include "gpu/passes/sky/seen_sky.h"
#include "gpu/passes/sky/sky_io.h"

namespace petrichor::gpu {

namespace {

// Sky over a small town by night, cd/m2: clear, and under clouds that its lamps light.
constexpr float kClearNight = 0.01f;
constexpr float kCloudyNight = 0.05f;

constexpr float kSnowyLand = 0.75f;  // albedo
constexpr int kAirWidth = 64;
constexpr int kAirHeight = 96;
constexpr int kCubeSize = kSkyCubeSide;
constexpr int kCubeMips = 9;
// From here on the cube is light: half as wide a texel as the finest that light reads (sky_specular's first roughness,
// SKY_BINS_MIP). Drawn that coarse, mirrors would show other edges of clouds, by up to 13 codes.
constexpr int kLightMip = 1;
constexpr int kIrradianceMip = 4;  // 24 texels a side
constexpr int kSpecularSize = 1 << SKY_SPECULAR_LOG2;
constexpr int kBrdfSize = 64;

std::unique_ptr<GpuImage> cube_map(MemoryArena& arena, const char* name, int size, int mips)
{
    return arena.image({.name = name,
                        .format = VK_FORMAT_R16G16B16A16_SFLOAT,
                        .width = size,
                        .height = size,
                        .mips = mips,
                        .layers = 6,
                        .cube = true,
                        .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_STORAGE_BIT |
                                 VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                                 VK_IMAGE_USAGE_TRANSFER_DST_BIT});
}

static_assert(kSpecularSize >> (SKY_PREFILTER_MIPS - 1) == 2 && kCubeSize >> SKY_AIR_MIP == SKY_AIR_SIDE);

void add_quads(FrameGraph& graph, SkyMaps& maps, GpuImage& source, int mip, int begin)
{
    const int side = source.width >> mip;
    graph.add(ComputePass{.name = "sky_quads",
                          .shader = "sky_quads.comp",
                          .constants = {},
                          .bindings = {{SKY_SOURCE, storage(source, mip)}, {SKY_TARGET, storage_buffer(*maps.quads)}},
                          .push = PushBlock(shared::SkyQuadsParams{begin}),
                          .groups = groups_over(side + 1, side + 1, SKY_TILE, 6)});
}

// Mips of the cube from one of them, then the lobes that the specular light reads.
void add_filtered(FrameGraph& graph, SkyMaps& maps, int first)
{
    graph.add(TransferPass{
        .name = "sky_mips",
        .transfers = {{maps.cube.get(), nullptr, Use::TransferTarget}},
        .record = [&maps, first](VkCommandBuffer commands) { record_mips(commands, *maps.cube, first); }});
    for (int mip = 0; mip < SKY_PREFILTER_MIPS; ++mip) {
        const float roughness =
            static_cast<float>(mip) / static_cast<float>(SKY_PREFILTER_MIPS - 1);
        const int size = kSpecularSize >> mip;
        graph.add(ComputePass{
            .name = "sky_specular",
            .shader = "sky_specular.comp",
            .constants = {},
            .bindings = {{SKY_SOURCE, sampled(*maps.cube, maps.linear)},
                         {SKY_TARGET, storage(*maps.specular, mip)}},
            .push = PushBlock(shared::PrefilterParams{roughness, static_cast<float>(kCubeSize),
                                                      static_cast<float>(first), static_cast<float>(kCubeMips)}),
            .groups = groups_over(size, size, SKY_TILE, 6)});
        add_quads(graph, maps, *maps.specular, mip, shared::cube_quads_begin(SKY_SPECULAR_LOG2 - mip));
    }
    add_quads(graph, maps, *maps.cube, SKY_AIR_MIP, SKY_AIR_QUADS);
}

constexpr std::size_t kTiles = std::size_t{6} * kSkyTilesAcross * kSkyTilesAcross;

std::size_t tile_number(std::uint32_t tile)
{
    return ((tile >> 16) * kSkyTilesAcross + (tile >> 8 & 255u)) * kSkyTilesAcross + (tile & 255u);
}

// A level of the cube: all of the one that light reads, the tiles that are listed of the first.
void add_sky_cube(FrameGraph& graph, SkyMaps& maps, const shared::SkyParams& params, int level, Groups groups)
{
    graph.add(ComputePass{.name = level == 0 ? "sky_seen" : "sky_cube",
                          .shader = "sky_cube.comp",
                          .constants = {{SKY_SPEC_LISTED, level == 0}},
                          .bindings = {{SKY_SOURCE, sampled(*maps.air, maps.linear)},
                                       {SKY_TARGET, storage(*maps.cube, level)},
                                       {SKY_TILES, storage_buffer(*maps.tiles)}},
                          .push = PushBlock(params),
                          .groups = groups});
}

bool same_air(const shared::SkyParams& a, const shared::SkyParams& b)
{
    return a.sun_direction == b.sun_direction && a.sun_illuminance == b.sun_illuminance &&
           a.turbidity == b.turbidity && a.land_albedo == b.land_albedo;
}

// Brings what the maps know of scattered light to the haze, land and sun of a frame.
void see_clear_sky(SkyMaps& maps, const shared::SkyParams& p)
{
    const glm::vec3 seen(p.turbidity, p.land_albedo, p.sun_direction.y);
    if (seen == maps.level_of) return;
    if (!maps.scattered || maps.scattered->turbidity() != p.turbidity) maps.scattered.emplace(p.turbidity);
    if (seen.x != maps.level_of.x || seen.y != maps.level_of.y) {
        maps.table = maps.scattered->table(p.land_albedo);
        std::memcpy(maps.again->mapped, maps.table.data(), sizeof maps.table);
    }
    maps.clear_level = ClearAir(maps.table).on_level_ground(p.sun_direction.y, p.turbidity);
    maps.level_of = seen;
}

float rain_per_m(const shared::WeatherMoment& weather)
{
    return shared::rain_extinction_per_m(weather.rain_kg_m2_s * 3600.0f, 0.0f, 20.0f);
}

// Light on level ground of a closed layer without its rain, over that with it: rain moves light about the sky, it makes none.
float relief_gain(const shared::SkyParams& p)
{
    if (p.rain <= 0.0f || p.cloud_cover <= 0.0f) return 1.0f;
    constexpr int kRings = 13, kAround = 48;
    const glm::vec2 drift_m = p.time_s * p.wind_m_s, lean = p.wind_m_s * shared::kCurtainLean_per_m_s;
    float even = 0.0f, rains = 0.0f;
    for (int ring = 0; ring < kRings; ++ring) {
        // Rings of as much level ground's light of an even sky.
        const float up = std::sqrt((static_cast<float>(ring) + 0.5f) / kRings);
        const float level = std::sqrt(1.0f - up * up);
        for (int k = 0; k < kAround; ++k) {
            const float angle = 2.0f * shared::kPi * (static_cast<float>(k) + 0.5f * static_cast<float>(ring % 2)) / kAround;
            const glm::vec3 d(level * std::cos(angle), up, level * std::sin(angle));
            const float weight = 1.0f + 2.0f * up;  // CIE overcast
            even += weight * shared::layer_relief_wide(d, drift_m, 0.03f, 0.0f);
            rains += weight * shared::layer_relief_wide(d, drift_m, 0.03f, p.rain) * shared::rain_curtains(d, drift_m, lean, p.rain).x;
        }
    }
    return even / rains;
}

}  // namespace

shared::SkyParams sky_params(const Frame& frame, SkyMaps& maps)
{
    const Sky& sky = frame.sky;
    shared::SkyParams p{};
    p.sun_direction = sun_direction(sky);
    p.turbidity = sky.turbidity;
    p.sun_illuminance = glm::vec3(sky.sun_illuminance);
    p.cloud_cover = std::clamp(sky.cloud_cover, 0.0f, 1.0f);
    p.time_s = static_cast<float>(frame.settings.time_s);
    p.wind_m_s = frame.weather.wind_m_s;
    p.rain = std::clamp(frame.weather.rain, 0.0f, 1.0f);
    p.relief_gain = relief_gain(p);
    p.night_radiance = glm::mix(kClearNight, kCloudyNight, p.cloud_cover);
    p.fog_per_m = fog_per_m(frame);
    if (frame.fog.mode == FogMode::Metres)
        p.fog_per_m = shared::fog_before_clouds(shared::fog_beyond_haze(p.fog_per_m), rain_per_m(frame.weather));
    if (p.fog_per_m > 0.0f) {
        p.fog_mode = static_cast<int>(frame.fog.mode);
        p.fog_start_m = frame.fog.start_m;
        p.fog_end_m = frame.fog.end_m;
        p.fog_height_m = frame.fog.height_m;
    }
    const float white = std::clamp(frame.weather.snow_amount * 1.2f, 0.0f, 1.0f);
    p.land_albedo = glm::mix(sky.ground_albedo, kSnowyLand, white);
    see_clear_sky(maps, p);
    p.clear_level = maps.clear_level * sky.sun_illuminance;
    p.sun_at_ground = shared::air_transmittance(2.0f, std::max(p.sun_direction.y, 0.0f), p.turbidity) *
                      (sky.sun_illuminance * glm::smoothstep(-0.08f, 0.02f, p.sun_direction.y));
    // Kasten and Czeplak 1980 for the light under clouds.
    const glm::vec3 level = sunlight_at_ground(sky) * std::max(p.sun_direction.y, 0.0f) + p.clear_level;
    const float through = 1.0f - 0.75f * std::pow(p.cloud_cover, 3.4f);
    const glm::vec3 albedo =
        glm::mix(glm::vec3(1.0f, 0.97f, 0.9f) * sky.ground_albedo, glm::vec3(kSnowyLand), white);
    const float grey = glm::dot(level, glm::vec3(0.2126f, 0.7152f, 0.0722f));
    p.ground_radiance =
        glm::mix(level, glm::vec3(grey), p.cloud_cover) * through * albedo / shared::kPi;
    return p;
}

SkyMaps::SkyMaps(const Device& device, MemoryArena& arena)
    : air(arena.image({.name = "sky_air",
                       .format = VK_FORMAT_R16G16B16A16_SFLOAT,
                       .width = kAirWidth,
                       .height = kAirHeight,
                       .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_STORAGE_BIT})),
      cube(cube_map(arena, "sky_cube", kCubeSize, kCubeMips)),
      specular(cube_map(arena, "sky_specular", kSpecularSize, SKY_PREFILTER_MIPS)),
      quads(arena.buffer({.name = "sky_quads",
                          .size = SKY_QUADS * sizeof(glm::uvec4),
                          .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT,
                          .texel_format = VK_FORMAT_R32G32B32A32_UINT})),
      env_brdf(arena.image({.name = "env_brdf",
                            .format = VK_FORMAT_R16G16_SFLOAT,
                            .width = kBrdfSize,
                            .height = kBrdfSize,
                            .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_STORAGE_BIT})),
      light(arena.buffer(
          {.name = "sky_light",
           .size = sizeof(shared::SkyLight),
           .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT,
           .host = true})),
      tiles(arena.buffer({.name = "sky_tiles", .size = kTiles * sizeof(std::uint32_t), .host = true})),
      again(arena.buffer({.name = "scattered_again", .size = sizeof(ScatteredAgain::Table), .host = true})),
      linear(make_sampler(device, VK_FILTER_LINEAR, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                          VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE)),
      wrap_u(make_sampler(device, VK_FILTER_LINEAR, VK_SAMPLER_ADDRESS_MODE_REPEAT,
                          VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE))
{
}

Binding sky_light_binding(SkyMaps& maps)
{
    return uniform(*maps.light, 0, sizeof(shared::SkyLight));
}

void add_env_brdf(FrameGraph& graph, SkyMaps& maps)
{
    graph.add(ComputePass{.name = "env_brdf",
                          .shader = "env_brdf.comp",
                          .constants = {},
                          .bindings = {{SKY_ALONE_TARGET, storage(*maps.env_brdf)}},
                          .push = {},
                          .groups = groups_over(kBrdfSize, kBrdfSize, SKY_TILE)});
}

void add_analytic_sky(FrameGraph& graph, SkyMaps& maps, const shared::SkyParams& params)
{
    if (!maps.drawn_valid || !same_air(params, maps.drawn))
        graph.add(ComputePass{.name = "sky_air",
                              .shader = "sky_air.comp",
                              .constants = {},
                              .bindings = {{SKY_ALONE_TARGET, storage(*maps.air)},
                                           {SKY_AGAIN, storage_buffer(*maps.again)}},
                              .push = PushBlock(params),
                              .groups = groups_over(kAirWidth, kAirHeight, SKY_TILE)});
    constexpr int side = kCubeSize >> kLightMip;
    add_sky_cube(graph, maps, params, kLightMip, groups_over(side, side, SKY_TILE, 6));
    add_filtered(graph, maps, kLightMip);
    maps.tiles_drawn.assign(kTiles, false);
}

void add_seen_sky(FrameGraph& graph, SkyMaps& maps, const shared::SkyParams& params,
                  const std::vector<std::uint32_t>& tiles)
{
    std::vector<std::uint32_t> missing;
    for (const std::uint32_t tile : tiles) {
        auto drawn = maps.tiles_drawn[tile_number(tile)];
        if (!drawn) missing.push_back(tile);
        drawn = true;
    }
    if (missing.empty()) return;
    std::memcpy(maps.tiles->mapped, missing.data(), missing.size() * sizeof(missing[0]));
    add_sky_cube(graph, maps, params, 0, {static_cast<std::uint32_t>(missing.size()), 1, 1});
}

void add_environment(FrameGraph& graph, SkyMaps& maps, GpuImage& lat_long, float scale,
                     float rotation_rad)
{
    graph.add(ComputePass{.name = "environment",
                          .shader = "environment_cube.comp",
                          .constants = {},
                          .bindings = {{SKY_SOURCE, sampled(lat_long, maps.wrap_u)},
                                       {SKY_TARGET, storage(*maps.cube, 0)}},
                          .push = PushBlock(shared::EnvironmentParams{rotation_rad, scale}),
                          .groups = groups_over(kCubeSize, kCubeSize, SKY_TILE, 6)});
    add_filtered(graph, maps, 0);
}

void add_sky_light(FrameGraph& graph, SkyMaps& maps, const Metering& metering)
{
    graph.add(ComputePass{
        .name = "sky_light",
        .shader = "sky_light.comp",
        .constants = {},
        .bindings = {{SKY_SOURCE, sampled(*maps.cube, maps.linear)},
                     {SKY_TARGET, storage_buffer(*maps.light)}},
        .push = PushBlock(shared::SkyLightParams{
            metering.sun_illuminance, metering.sun_up, static_cast<float>(kIrradianceMip),
            static_cast<float>(kCubeSize >> kIrradianceMip), metering.exposure, metering.bias,
            metering.ambient_scale, metering.floor_lux}),
        .groups = {}});
}

}  // namespace petrichor::gpu
