#include "gpu/passes/lighting/lighting.h"

#include <cstddef>

#include "formulas/light/reflection_probe.h"
#include "gpu/frame/frame_words_io.h"
#include "gpu/frame/pixel_list_io.h"
#include "gpu/lighting/models_io.h"
#include "gpu/passes/lighting/lighting_io.h"
#include "gpu/passes/lights/light_turns.h"
#include "gpu/passes/sky/sky_light_io.h"

namespace petrichor::gpu {

static_assert(LIGHTING_MOST_PROBES == kMostProbes);
// As lighting_words.glsl reads them, word by word.
static_assert(sizeof(shared::SkyLight) == 4 * 62 && offsetof(shared::SkyLight, missed) == 4 * 36 &&
              offsetof(shared::SkyLight, exposure) == 4 * 60);
static_assert(sizeof(shared::ProbeSpread) == 4 * 48 && offsetof(shared::ProbeSpread, low) == 4 * 4 &&
              offsetof(shared::ProbeSpread, high) == 4 * 8 && offsetof(shared::ProbeSpread, bands) == 4 * 12);

namespace {

// Invocations of a group: those of a CPU take its pixels in turns, unless they might walk more lights than its loops can.
std::uint32_t invocations(const FrameTargets& targets, const LightTable& lights, const LightingVariant& variant)
{
    const auto shows = [&](std::size_t model) { return model < variant.models.size() && variant.models[model]; };
    const bool again = variant.split || variant.gathers || shows(LIGHTING_MODEL_UNLIT_SHADOWED);
    const bool in_turns = targets.lanes != 0 && lights.count <= (again ? kLightsInTurnsAgain : kLightsInTurns);
    return in_turns ? targets.lanes : PIXEL_LIST_GROUP;
}

}  // namespace

void add_lighting(FrameGraph& graph, FrameTargets& targets, const GpuScene& scene,
                  LightTable& lights, LightTables& light_tables, SkyMaps& sky,
                  DepthMaps& depth_maps, LampShadows& lamp_shadows, const ProbeTable& probes,
                  const ConstantsRange& constants, const LightingVariant& variant)
{
    const SamplerHandle& nearest = targets.nearest;
    if (variant.image_based_light) add_empty_list(graph, "lighting", *targets.mirror_list);
    ComputePass pass{
        .name = "lighting",
        .shader = variant.shader,
        .constants = {{FRAME_SPEC_LANES, targets.lanes},
                      {PIXEL_LIST_SPEC_INVOCATIONS, invocations(targets, lights, variant)},
                      {LIGHTING_SPEC_WEATHER, variant.weather ? targets.weather_kept() : WEATHER_DRY},
                      {LIGHTING_SPEC_SHADOWS, variant.shadows},
                      {LIGHTING_SPEC_IMAGE_BASED_LIGHT, variant.image_based_light},
                      {LIGHTING_SPEC_AMBIENT_OCCLUSION, variant.bent_normals ? 2u : variant.ambient_occlusion ? 1u : 0u},
                      {LIGHTING_SPEC_EMISSION, variant.emission},
                      {LIGHTING_SPEC_BAKED, variant.baked},
                      {LIGHTING_SPEC_GAMMA, variant.gamma},
                      {LIGHTING_SPEC_ALL_LIGHTS, variant.all_lights},
                      {LIGHTING_SPEC_PATCHES, variant.patch_light},
                      {LIGHTING_SPEC_LAMP_SHADOWS, variant.lamp_shadows},
                      {LIGHTING_SPEC_RECTANGLES, variant.rectangles},
                      {LIGHTING_SPEC_GUSTS, variant.gusts},
                      {LIGHTING_SPEC_FOG, variant.fog},
                      {LIGHTING_SPEC_LAYERS, variant.layers},
                      {LIGHTING_SPEC_SOFT_LAMPS, variant.soft_lamps},
                      {LIGHTING_SPEC_SHARES, variant.shares != nullptr},
                      {LIGHTING_SPEC_SUN, variant.sun},
                      {LIGHTING_SPEC_WAYS, variant.ways},
                      {LIGHTING_SPEC_LAZAROV, variant.lazarov},
                      {LIGHTING_SPEC_HORIZON, variant.horizon},
                      {LIGHTING_SPEC_GRAIN, variant.grain},
                      {LIGHTING_SPEC_SNOW_SCATTER, variant.snow_scatter},
                      {LIGHTING_SPEC_SPARKLE, variant.sparkle},
                      {LIGHTING_SPEC_ICE, variant.ice},
                      {LIGHTING_SPEC_PARTS, variant.split},
                      {LIGHTING_SPEC_FILM, variant.film},
                      {LIGHTING_SPEC_GATHERS, variant.gathers},
                      {LIGHTING_SPEC_PROBES, variant.patch_light ? probes.count() : 0u},
                      {LIGHTING_SPEC_PICTURE, variant.mirrors_picture}},
        .bindings = {{LIGHTING_FRAME, frame_binding(constants)},
                     {LIGHTING_SKY_LIGHT, sky_light_binding(sky)},
                     {LIGHTING_OCCLUSION, texels(*targets.occlusion)},
                     {LIGHTING_SHADOW, sampled(*depth_maps.shadow, depth_maps.plain)},
                     {LIGHTING_LAMP_SHADOWS, sampled(lamp_shadows.map(), depth_maps.plain)},
                     {LIGHTING_SKY_QUADS, texels(*sky.quads)},
                     {LIGHTING_ENV_BRDF, sampled(*sky.env_brdf, sky.linear)},
                     {LIGHTING_LIGHTS, texels(*lights.texels)},
                     {LIGHTING_LIGHT_LISTS, texels(*targets.light_lists)},
                     {LIGHTING_PATCH_POINTS, texels(*targets.patch_points)},
                     {LIGHTING_LAYERS, texels(scene.layers())},
                     {LIGHTING_LTC, texels(light_tables.ltc())},
                     {LIGHTING_PROFILES, texels(light_tables.profiles())},
                     {LIGHTING_SKIN, texels(light_tables.skin())},
                     {LIGHTING_SHARES, sampled(variant.shares ? *variant.shares : light_tables.no_shares(),
                                               nearest)},
                     {LIGHTING_PIXELS, texels(pixels_of(targets, targets.surface_tiles, variant.pixels))},
                     {LIGHTING_MATERIALS, texels(scene.material_looks())},
                     {LIGHTING_ACCUMULATED, storage(*targets.accumulated)},
                     {LIGHTING_SKY_VISIBILITY, sampled(*depth_maps.sky, depth_maps.compare)},
                     {LIGHTING_RADIANCE, storage(*targets.radiance)},
                     {LIGHTING_MIRROR_WEIGHT, storage(*targets.mirror_weight)},
                     {LIGHTING_PROBES, uniform(probes.spread(), 0, kMostProbes * sizeof(shared::ProbeSpread))},
                     {LIGHTING_PROBE_BANDS, texels(probes.bands())},
                     {LIGHTING_PARTS, storage(*variant.parts)},
                     {LIGHTING_MIRROR_SHAPE, storage(*targets.mirror_shape)},
                     {LIGHTING_MIRROR_LIST, storage_buffer(*targets.mirror_list)}},
        .push = {},
        .groups = {}};
    for (std::size_t i = 0; i < variant.models.size(); ++i) {
        const auto id = static_cast<std::uint32_t>(LIGHTING_SPEC_MODEL + i);
        pass.constants.push_back({id, variant.models[i]});
    }
    bind_gbuffer(pass.bindings, LIGHTING_GBUFFER, targets);
    add_over_tiles(graph, targets, std::move(pass), targets.surface_tiles, variant.pixels);
}

}  // namespace petrichor::gpu
