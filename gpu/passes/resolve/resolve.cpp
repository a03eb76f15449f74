#include "gpu/passes/resolve/resolve.h"

#include "formulas/color/tone_map.h"
#include "gpu/passes/resolve/resolve_io.h"

namespace petrichor::gpu {

static_assert(static_cast<int>(ToneMap::Linear) == TONE_MAP_LINEAR &&
              static_cast<int>(ToneMap::Filmic) == TONE_MAP_FILMIC &&
              static_cast<int>(ToneMap::Agx) == TONE_MAP_AGX &&
              static_cast<int>(ToneMap::Aces) == TONE_MAP_ACES &&
              static_cast<int>(ToneMap::Neutral) == TONE_MAP_NEUTRAL);

void add_resolve(FrameGraph& graph, FrameTargets& targets, SkyMaps& sky,
                 const ConstantsRange& constants, const FrameSettings& settings)
{
    graph.add(ComputePass{.name = "resolve",
                          .shader = "resolve.comp",
                          .constants = {{RESOLVE_SPEC_TONE_MAP,
                                         static_cast<std::uint32_t>(settings.tone_map)},
                                        {RESOLVE_SPEC_BLOOM, settings.bloom > 0.0f},
                                        {RESOLVE_SPEC_WET_LENS, settings.wet_lens > 0.0f},
                                        {RESOLVE_SPEC_FILTERS, targets.filters},
                                        {RESOLVE_SPEC_EXPOSED_LIGHT, settings.exposed_light}},
                          .bindings = {{RESOLVE_FRAME, frame_binding(constants)},
                                       {RESOLVE_SKY_LIGHT, sky_light_binding(sky)},
                                       {RESOLVE_ACCUMULATED, storage_read(*targets.accumulated)},
                                       {RESOLVE_GLARE, sampled(*targets.glare.front(), targets.between)},
                                       {RESOLVE_BEAUTY, storage_buffer(*targets.beauty)},
                                       {RESOLVE_DISPLAY, storage_buffer(*targets.display)}},
                          .push = {},
                          .groups = groups_over(targets.width, targets.height, RESOLVE_TILE)});
    graph.read_back({targets.beauty.get(), targets.display.get(), sky.light.get()});
}

}  // namespace petrichor::gpu
