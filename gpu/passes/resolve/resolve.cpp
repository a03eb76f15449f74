#include "gpu/passes/resolve/resolve.h"

#include <utility>

#include "formulas/color/tone_map.h"
#include "gpu/passes/resolve/resolve_io.h"

namespace petrichor::gpu {

static_assert(static_cast<int>(ToneMap::Linear) == TONE_MAP_LINEAR &&
              static_cast<int>(ToneMap::Filmic) == TONE_MAP_FILMIC &&
              static_cast<int>(ToneMap::Agx) == TONE_MAP_AGX &&
              static_cast<int>(ToneMap::Aces) == TONE_MAP_ACES &&
              static_cast<int>(ToneMap::Neutral) == TONE_MAP_NEUTRAL);

namespace {

void add_drawn(FrameGraph& graph, FrameTargets& targets, std::vector<Specialization> constants, Bindings bindings)
{
    add_rows(graph, "resolve", {{targets.accumulated.get(), targets.accumulated_rows.get()}});
    bindings.push_back({RESOLVE_ACCUMULATED, texels(*targets.accumulated_rows)});
    graph.add(DrawPass{.name = "resolve",
                       .colors = {Attachment(*targets.beauty_drawn), Attachment(*targets.display_drawn)},
                       .depth = {},
                       .width = targets.width,
                       .height = targets.height,
                       .bindings = std::move(bindings),
                       .record = [constants = std::move(constants)](PassContext& pass) {
                           GraphicsDesc desc;
                           desc.vertex = "resolve.vert";
                           desc.fragment = "resolve.frag";
                           desc.specialization = constants;
                           desc.sets = {pass.set_types()};
                           desc.colors = pass.color_formats();
                           desc.depth = VK_FORMAT_UNDEFINED;
                           pass.bind(pass.pipelines().graphics(desc));
                           vkCmdSetCullMode(pass.commands(), VK_CULL_MODE_NONE);
                           vkCmdSetFrontFace(pass.commands(), VK_FRONT_FACE_COUNTER_CLOCKWISE);
                           pass.push(0);
                           vkCmdDraw(pass.commands(), 3, 1, 0, 0);
                       }});
    add_rows(graph, "resolve", {{targets.beauty_drawn.get(), targets.beauty.get()}, {targets.display_drawn.get(), targets.display.get()}});
}

}  // namespace

void add_resolve(FrameGraph& graph, FrameTargets& targets, SkyMaps& sky,
                 const ConstantsRange& constants, const FrameSettings& settings)
{
    std::vector<Specialization> made_for{{RESOLVE_SPEC_TONE_MAP, static_cast<std::uint32_t>(settings.tone_map)},
                                         {RESOLVE_SPEC_BLOOM, settings.bloom > 0.0f},
                                         {RESOLVE_SPEC_WET_LENS, settings.wet_lens > 0.0f},
                                         {RESOLVE_SPEC_FILTERS, targets.filters}};
    Bindings bindings{{RESOLVE_FRAME, frame_binding(constants)},
                      {RESOLVE_SKY_LIGHT, sky_light_binding(sky)},
                      {RESOLVE_GLARE, sampled(*targets.glare.front(), targets.between)}};
    if (targets.accumulated_rows && !settings.exposed_light) {
        add_drawn(graph, targets, std::move(made_for), std::move(bindings));
    } else {
        made_for.push_back({RESOLVE_SPEC_EXPOSED_LIGHT, settings.exposed_light});
        bindings.push_back({RESOLVE_ACCUMULATED, storage_read(*targets.accumulated)});
        bindings.push_back({RESOLVE_BEAUTY, storage_buffer(*targets.beauty)});
        bindings.push_back({RESOLVE_DISPLAY, storage_buffer(*targets.display)});
        graph.add(ComputePass{.name = "resolve",
                              .shader = "resolve.comp",
                              .constants = std::move(made_for),
                              .bindings = std::move(bindings),
                              .push = {},
                              .groups = groups_over(targets.width, targets.height, RESOLVE_TILE)});
    }
    graph.read_back({targets.beauty.get(), targets.display.get(), sky.light.get()});
}

}  // namespace petrichor::gpu
