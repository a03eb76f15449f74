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
        lit_ = nullptr;
        corners_ = nullptr;
        arena_ = std::make_unique<MemoryArena>(*device_);
        buffer_ = arena_->buffer({.name = "falling_drops",
                                  .size = room_,
                                  .usage = VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT,
                                  .texel_format = VK_FORMAT_R32G32B32A32_SFLOAT,
                                  .host = true});
        const std::size_t sprites = room_ / (SPLASH_TEXELS * sizeof(glm::vec4));  // at most: drops take more
        lit_ = arena_->buffer({.name = "falling_light",
                               .size = sprites * sizeof(glm::vec4),
                               .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT,
                               .texel_format = VK_FORMAT_R32G32B32A32_SFLOAT});
        corners_ = arena_->buffer({.name = "falling_corners",
                                   .size = sprites * 6 * sizeof(std::uint32_t),
                                   .usage = VK_BUFFER_USAGE_INDEX_BUFFER_BIT,
                                   .host = true});
        auto* corner = reinterpret_cast<std::uint32_t*>(corners_->mapped);
        for (std::uint32_t i = 0; i < sprites; ++i)
            for (const std::uint32_t k : {0u, 1u, 2u, 0u, 2u, 3u}) *corner++ = 4 * i + k;
    }
    if (!bytes.empty()) std::memcpy(buffer_->mapped, bytes.data(), bytes.size());
}

namespace {

void add_sprites(FrameGraph& graph, FrameTargets& targets, const FallingTable& table, Bindings bindings, GraphicsDesc desc,
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
        .bindings = std::move(bindings),
        .record =
            [desc = std::move(desc), count = table.count(), corners = table.corners().buffer.get(), hides](PassContext& pass) mutable {
                desc.sets = {pass.set_types()};
                desc.colors = pass.color_formats();
                desc.depth = VK_FORMAT_UNDEFINED;
                (hides ? desc.over_all : desc.over) = true;
                pass.bind(pass.pipelines().graphics(desc));
                vkCmdSetCullMode(pass.commands(), VK_CULL_MODE_NONE);
                vkCmdSetFrontFace(pass.commands(), VK_FRONT_FACE_COUNTER_CLOCKWISE);
                pass.push(0);
                vkCmdBindIndexBuffer(pass.commands(), corners, 0, VK_INDEX_TYPE_UINT32);
                vkCmdDrawIndexed(pass.commands(), count * 6, 1, 0, 0, 0);
            },
    });
}

}  // namespace

void add_falling(FrameGraph& graph, FrameTargets& targets, DepthMaps& maps, SkyMaps& sky,
                 const FallingTable& drops, const FallingTable& splashes,
                 const ConstantsRange& constants, bool shelter, bool sun, bool hides)
{
    if (splashes.count() > 0 && shelter) {
        GraphicsDesc desc;
        desc.vertex = "splash.vert";
        desc.fragment = "splash.frag";
        add_sprites(graph, targets, splashes,
                    {{FALLING_FRAME, frame_binding(constants)},
                     {FALLING_SKY_LIGHT, sky_light_binding(sky)},
                     {FALLING_DROPS, texels(splashes.texels())},
                     {FALLING_DEPTH, sampled(*targets.gbuffer.depth, targets.nearest)},
                     {FALLING_SHELTER, sampled(*maps.shelter, targets.nearest)}},
                    desc, hides);
    }
    if (drops.count() == 0) return;
    graph.add(ComputePass{.name = "falling",
                          .shader = "falling_lit.comp",
                          .constants = {{FALLING_SPEC_SHELTER, shelter}, {FALLING_SPEC_SUN, sun}},
                          .bindings = {{FALLING_LIT_FRAME, frame_binding(constants)},
                                       {FALLING_LIT_SKY_LIGHT, sky_light_binding(sky)},
                                       {FALLING_LIT_DROPS, texels(drops.texels())},
                                       {FALLING_LIT_SHELTER, sampled(*maps.shelter, targets.nearest)},
                                       {FALLING_LIT_SHADOW, sampled(*maps.shadow, maps.compare)},
                                       {FALLING_LIT_LIGHT, storage_buffer(drops.lit())}},
                          .push = PushBlock(shared::FallingLitParams{static_cast<int>(drops.count())}),
                          .groups = {(drops.count() + FALLING_LIT_GROUP - 1) / FALLING_LIT_GROUP}});
    GraphicsDesc desc;
    desc.vertex = "falling.vert";
    desc.fragment = "falling.frag";
    add_sprites(graph, targets, drops,
                {{FALLING_FRAME, frame_binding(constants)},
                 {FALLING_LIGHT, texels(drops.lit())},
                 {FALLING_DROPS, texels(drops.texels())},
                 {FALLING_DEPTH, sampled(*targets.gbuffer.depth, targets.nearest)}},
                desc, hides);
}

}  // namespace petrichor::gpu
