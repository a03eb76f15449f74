#include "gpu/passes/falling/falling.h"

#include <algorithm>
#include <cstring>

#include "gpu/passes/falling/falling_io.h"

namespace petrichor::gpu {

static_assert(sizeof(shared::FallingDrop) == FALLING_TEXELS * sizeof(glm::vec4));

void FallingTable::fill(const std::vector<shared::FallingDrop>& drops)
{
    count_ = static_cast<std::uint32_t>(drops.size());
    if (!buffer_ || drops.size() > room_) {
        room_ = std::max<std::size_t>(drops.size() + drops.size() / 4, 1024);
        buffer_ = nullptr;
        arena_ = std::make_unique<MemoryArena>(*device_);
        buffer_ = arena_->buffer({.name = "falling_drops",
                                  .size = room_ * sizeof(shared::FallingDrop),
                                  .usage = VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT,
                                  .texel_format = VK_FORMAT_R32G32B32A32_SFLOAT,
                                  .host = true});
    }
    if (!drops.empty())
        std::memcpy(buffer_->mapped, drops.data(), drops.size() * sizeof(shared::FallingDrop));
}

void add_falling(FrameGraph& graph, FrameTargets& targets, DepthMaps& maps, SkyMaps& sky,
                 FallingTable& table, const ConstantsRange& constants, bool shelter, bool sun)
{
    Attachment picture(*targets.accumulated);
    picture.keep = true;
    graph.add(DrawPass{
        .name = "falling",
        .colors = {picture},
        .depth = {},
        .width = targets.width,
        .height = targets.height,
        .bindings = {{FALLING_FRAME, frame_binding(constants)},
                     {FALLING_SKY_LIGHT, sky_light_binding(sky)},
                     {FALLING_DROPS, texels(table.texels())},
                     {FALLING_DEPTH, sampled(*targets.gbuffer.depth, targets.nearest)},
                     {FALLING_SHELTER, sampled(*maps.shelter, targets.nearest)},
                     {FALLING_SHADOW, sampled(*maps.shadow, maps.compare)}},
        .record =
            [shelter, sun, count = table.count()](PassContext& pass) {
                GraphicsDesc desc;
                desc.vertex = "falling.vert";
                desc.fragment = "falling.frag";
                desc.specialization = {{FALLING_SPEC_SHELTER, shelter}, {FALLING_SPEC_SUN, sun}};
                desc.sets = {pass.set_types()};
                desc.colors = pass.color_formats();
                desc.depth = VK_FORMAT_UNDEFINED;
                desc.over = true;
                pass.bind(pass.pipelines().graphics(desc));
                vkCmdSetCullMode(pass.commands(), VK_CULL_MODE_NONE);
                vkCmdSetFrontFace(pass.commands(), VK_FRONT_FACE_COUNTER_CLOCKWISE);
                pass.push(0);
                vkCmdDraw(pass.commands(), count * 6, 1, 0, 0);
            },
    });
}

}  // namespace petrichor::gpu
