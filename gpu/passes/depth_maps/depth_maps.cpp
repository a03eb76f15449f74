#include "gpu/passes/depth_maps/depth_maps.h"

#include <algorithm>
#include <cmath>

#include "gpu/upload/draw.h"

namespace petrichor::gpu {

namespace {

ImageViewHandle layer_view(const Device& device, const GpuImage& image, std::uint32_t layer)
{
    VkImageViewCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
    info.image = image.image.get();
    info.viewType = VK_IMAGE_VIEW_TYPE_2D;
    info.format = image.format;
    info.subresourceRange = {image.aspect(), 0, 1, layer, 1};
    VkImageView view = VK_NULL_HANDLE;
    check(vkCreateImageView(device.handle(), &info, nullptr, &view), "creating an image view");
    return {device.handle(), view};
}

// Draws every caster that the view can see into one depth image.
void draw_depth(PassContext& pass, const GpuScene& scene, const glm::mat4& clip_from_world,
                VkImageView view, int size)
{
    VkRenderingAttachmentInfo depth{};
    depth.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
    depth.imageView = view;
    depth.imageLayout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
    depth.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    depth.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    VkRenderingInfo rendering{};
    rendering.sType = VK_STRUCTURE_TYPE_RENDERING_INFO;
    rendering.renderArea.extent = {static_cast<std::uint32_t>(size),
                                   static_cast<std::uint32_t>(size)};
    rendering.layerCount = 1;
    rendering.pDepthAttachment = &depth;
    const VkCommandBuffer commands = pass.commands();
    vkCmdBeginRendering(commands, &rendering);
    set_viewport(commands, size, size);
    bind_geometry(commands, scene);

    GraphicsDesc plain;
    plain.vertex = "depth_only.vert";
    plain.stride = sizeof(Vertex);
    plain.attributes = {vertex_attributes()[0]};
    GraphicsDesc masked = plain;
    masked.vertex = "depth_masked.vert";
    masked.fragment = "depth_masked.frag";
    masked.attributes = {vertex_attributes()[0], vertex_attributes()[3], vertex_attributes()[4]};
    masked.sets = {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER}};

    const Frustum frustum(clip_from_world);
    const Pipeline* bound = nullptr;
    std::uint32_t bound_material = UINT32_MAX;
    for (const Draw& draw : scene.draws()) {
        const GpuMaterial& material = scene.materials()[draw.material];
        if (material.blended) continue;
        if (!frustum.touches(draw.centre_m, draw.radius_m)) continue;
        const Pipeline& wanted = pass.pipelines().graphics(material.masked ? masked : plain);
        if (bound != &wanted) {
            vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, wanted.pipeline.get());
            pass.use_layout(wanted.layout);
            bound = &wanted;
            bound_material = UINT32_MAX;
        }
        if (material.masked && bound_material != draw.material) {
            const VkDescriptorSet set = pass.descriptors().set(
                wanted.set_layouts[0], {material.bindings[0], material.bindings[1]});
            vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, wanted.layout, 0, 1,
                                    &set, 0, nullptr);
            bound_material = draw.material;
        }
        // Thin things such as leaves and roofs of one polygon cast from both sides.
        set_facing(commands, true, draw.mirrored);
        pass.push(clip_from_world * draw.to_world);
        vkCmdDrawIndexed(commands, draw.index_count, 1, draw.first_index, draw.vertex_offset, 0);
    }
    vkCmdEndRendering(commands);
}

}  // namespace

DepthMaps::DepthMaps(const Device& device, MemoryArena& arena)
    : shadow(arena.image(
          {.name = "shadow",
           .format = VK_FORMAT_D32_SFLOAT,
           .width = kShadowMapSize,
           .height = kShadowMapSize,
           .layers = SHADOW_CASCADES,
           .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT})),
      shelter(arena.image(
          {.name = "shelter",
           .format = VK_FORMAT_D32_SFLOAT,
           .width = kShelterMapSize,
           .height = kShelterMapSize,
           .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT})),
      sky(arena.image(
          {.name = "sky_visibility",
           .format = VK_FORMAT_D32_SFLOAT,
           .width = kSkyMapSize,
           .height = kSkyMapSize,
           .layers = SKY_DIRECTIONS,
           .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT})),
      compare(make_sampler(device, VK_FILTER_LINEAR, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                           VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE, true))
{
    for (std::uint32_t i = 0; i < SHADOW_CASCADES; ++i) {
        shadow_layers.push_back(layer_view(device, *shadow, i));
    }
    for (std::uint32_t i = 0; i < SKY_DIRECTIONS; ++i) {
        sky_layers.push_back(layer_view(device, *sky, i));
    }
}

void add_shadow(FrameGraph& graph, DepthMaps& maps, const GpuScene& scene)
{
    graph.add({.name = "shadow",
               .uses = {{maps.shadow, Use::DepthTarget}},
               .record = [&maps, &scene](PassContext& pass) {
                   for (std::size_t i = 0; i < SHADOW_CASCADES; ++i) {
                       draw_depth(pass, scene, maps.shadow_views[i].clip_from_world,
                                  maps.shadow_layers[i].get(), kShadowMapSize);
                   }
               }});
}

void add_sky_visibility(FrameGraph& graph, DepthMaps& maps, const GpuScene& scene)
{
    graph.add({.name = "sky_visibility",
               .uses = {{maps.sky, Use::DepthTarget}},
               .record = [&maps, &scene](PassContext& pass) {
                   for (std::size_t i = 0; i < SKY_DIRECTIONS; ++i) {
                       draw_depth(pass, scene, maps.sky_views[i].clip_from_world,
                                  maps.sky_layers[i].get(), kSkyMapSize);
                   }
               }});
}

void add_shelter(FrameGraph& graph, DepthMaps& maps, const GpuScene& scene)
{
    graph.add({.name = "shelter",
               .uses = {{maps.shelter, Use::DepthTarget}},
               .record = [&maps, &scene](PassContext& pass) {
                   draw_depth(pass, scene, maps.shelter_view.clip_from_world,
                              maps.shelter->view.get(), kShelterMapSize);
               }});
}

}  // namespace petrichor::gpu
