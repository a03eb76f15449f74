#include "gpu/passes/falling/falling.h"

#include <algorithm>
#include <cstring>

#include "gpu/passes/falling/falling_io.h"

namespace petrichor::gpu {

static_assert(sizeof(shared::FallingDrop) == FALLING_TEXELS * sizeof(glm::vec4));
static_assert(sizeof(shared::FallingSplash) == SPLASH_TEXELS * sizeof(glm::vec4));

void FallingTable::fill_bytes(std::span<const std::byte> bytes)
{
    if (!buffer_ || bytes.size() > room_) {
        room_ = std::max<std::size_t>(bytes.size() + bytes.size() / 4, 65536) / 16 * 16;
        buffer_ = nullptr;
        arena_ = std::make_unique<MemoryArena>(*device_);
        buffer_ = arena_->buffer({.name = "falling_drops",
                                  .size = room_,
                                  .usage = VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT,
                                  .texel_format = VK_FORMAT_R32G32B32A32_SFLOAT,
                                  .host = true});
    }
    if (!bytes.empty()) std::memcpy(buffer_->mapped, bytes.data(), bytes.size());
}

namespace {

void add_sprites(FrameGraph& graph, FrameTargets& targets, DepthMaps& maps, SkyMaps& sky,
                 const FallingTable& table, const ConstantsRange& constants, GraphicsDesc desc,
                 bool hides)
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
            [desc = std::move(desc), count = table.count(), hides](PassContext& pass) mutable {
                desc.sets = {pass.set_types()};
                desc.colors = pass.color_formats();
                desc.depth = VK_FORMAT_UNDEFINED;
                (hides ? desc.over_all : desc.over) = true;
                pass.bind(pass.pipelines().graphics(desc));
                vkCmdSetCullMode(pass.commands(), VK_CULL_MODE_NONE);
                vkCmdSetFrontFace(pass.commands(), VK_FRONT_FACE_COUNTER_CLOCKWISE);
                pass.push(0);
                vkCmdDraw(pass.commands(), count * 6, 1, 0, 0);
            },
    });
}

}  // namespace

void add_falling(FrameGraph& graph, FrameTargets& targets, DepthMaps& maps, SkyMaps& sky,
                 const FallingTable& drops, const FallingTable& splashes,
                 const ConstantsRange& constants, bool shelter, bool sun, bool hides)
{
    GraphicsDesc desc;
    if (splashes.count() > 0 && shelter) {
        desc.vertex = "splash.vert";
        desc.fragment = "splash.frag";
        add_sprites(graph, targets, maps, sky, splashes, constants, desc, hides);
    }
    if (drops.count() == 0) return;
    desc.vertex = "falling.vert";
    desc.fragment = "falling.frag";
    desc.specialization = {{FALLING_SPEC_SHELTER, shelter}, {FALLING_SPEC_SUN, sun}};
    add_sprites(graph, targets, maps, sky, drops, constants, desc, hides);
}

}  // namespace petrichor::gpu
