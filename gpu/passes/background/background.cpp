#include "gpu/passes/background/background.h"

#include <utility>

#include "gpu/passes/background/background_io.h"

namespace petrichor::gpu {

void add_background(FrameGraph& graph, FrameTargets& targets, SkyMaps& sky, const ConstantsRange& constants,
                    const LightingVariant& variant)
{
    ComputePass pass{.name = "background",
                     .shader = "background.comp",
                     .constants = {{BACKGROUND_SPEC_SKY, variant.background},
                                   {BACKGROUND_SPEC_NIGHT, variant.night},
                                   {BACKGROUND_SPEC_FOG, variant.fog},
                                   {BACKGROUND_SPEC_PARTS, variant.split},
                                   {BACKGROUND_SPEC_MIRRORED, variant.image_based_light},
                                   {BACKGROUND_SPEC_SKYLINE, variant.skyline_from_m.has_value()}},
                     .bindings = {{BACKGROUND_FRAME, frame_binding(constants)},
                                  {BACKGROUND_DEPTH_ROWS, texels(*targets.rows.depth)},
                                  {BACKGROUND_SKY, sampled(*sky.cube, sky.linear)},
                                  {BACKGROUND_PIXELS, texels(pixels_of(targets, targets.open_tiles, variant.pixels))},
                                  {BACKGROUND_ACCUMULATED, storage(*targets.accumulated)},
                                  {BACKGROUND_RADIANCE, storage(*targets.radiance)},
                                  {BACKGROUND_PARTS, storage(*variant.parts)},
                                  {BACKGROUND_SKY_LIGHT, sky_light_binding(sky)}},
                     .push = PushBlock(shared::BackgroundParams{variant.skyline_from_m.value_or(0.0f)}),
                     .groups = {}};
    add_over_tiles(graph, targets, std::move(pass), targets.open_tiles, variant.pixels);
}

}  // namespace petrichor::gpu
