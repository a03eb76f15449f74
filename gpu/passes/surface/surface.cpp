#include "gpu/passes/surface/surface.h"

#include <algorithm>
#include <tuple>

#include "gpu/frame/frame_io.h"
#include "gpu/passes/surface/surface_io.h"
#include "gpu/upload/draw.h"

namespace petrichor::gpu {

namespace {

shared::DrawConstants draw_constants(const Draw& draw)
{
    shared::DrawConstants c{};
    const glm::mat4& m = draw.to_world;
    const glm::mat3 linear(m);
    // Cofactors: the inverse transpose times the determinant; keeps normals right under any scale.
    glm::mat3 cofactor(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                       glm::cross(linear[0], linear[1]));
    if (draw.mirrored) cofactor = -cofactor;
    for (int row = 0; row < 3; ++row) {
        c.to_world[row] = glm::vec4(m[0][row], m[1][row], m[2][row], m[3][row]);
        c.normal_to_world[row] =
            glm::vec4(cofactor[0][row], cofactor[1][row], cofactor[2][row], 0.0f);
    }
    c.instance_id = draw.instance_id;
    c.material_id = draw.material;
    return c;
}

bool has_holes(const GpuScene& scene, const Draw& draw)
{
    const GpuMaterial& material = scene.materials()[draw.material];
    return material.masked || material.blended;
}

// Draws inside the view: opaque ones first and near to far, so that early depth tests save shading.
std::vector<const Draw*> visible_draws(const GpuScene& scene, const glm::mat4& world_to_clip,
                                       const glm::vec3& camera_m)
{
    const Frustum frustum(world_to_clip);
    std::vector<std::tuple<bool, float, const Draw*>> keyed;
    for (const Draw& draw : scene.draws()) {
        if (!frustum.touches(draw.centre_m, draw.radius_m)) continue;
        const float nearest = glm::length(draw.centre_m - camera_m) - draw.radius_m;
        keyed.emplace_back(has_holes(scene, draw), nearest, &draw);
    }
    std::stable_sort(keyed.begin(), keyed.end(), [](const auto& a, const auto& b) {
        return std::make_pair(std::get<0>(a), std::get<1>(a)) <
               std::make_pair(std::get<0>(b), std::get<1>(b));
    });
    std::vector<const Draw*> draws;
    for (const auto& entry : keyed) draws.push_back(std::get<2>(entry));
    return draws;
}

}  // namespace

void add_surface(FrameGraph& graph, FrameTargets& targets, const GpuScene& scene, SurfaceMaps& maps,
                 DepthMaps& depth_maps, const ConstantsRange& constants,
                 const glm::mat4& world_to_clip, const glm::vec3& camera_m,
                 const VisibleWeather& weather)
{
    GBuffer& g = targets.gbuffer;
    const bool emission = scene.emissive();
    const bool any_weather = weather.any;
    graph.add(DrawPass{
        .name = "surface",
        .colors = gbuffer_attachments(g, {weather.any, emission}),
        .depth = Attachment(*g.depth),
        .width = targets.width,
        .height = targets.height,
        .bindings = {{SURFACE_FRAME, frame_binding(constants)},
                     {SURFACE_RIPPLE, sampled(*maps.ripple, maps.trilinear)},
                     {SURFACE_FLOW, sampled(*maps.flow, maps.trilinear)},
                     {SURFACE_SNOW, sampled(*maps.snow, maps.trilinear)},
                     {SURFACE_SHELTER, sampled(*depth_maps.shelter, depth_maps.compare)}},
        .record =
            [=, &scene](PassContext& pass) {
                GraphicsDesc desc;
                desc.vertex = "surface.vert";
                desc.fragment = any_weather ? (emission ? "surface.frag" : "surface_dark.frag")
                                            : (emission ? "surface_dry.frag" : "surface_lean.frag");
                desc.stride = sizeof(Vertex);
                desc.attributes = vertex_attributes();
                desc.colors = pass.color_formats();
                desc.sets.push_back(pass.set_types());
                BindingTypes material_types{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER};
                material_types.resize(1 + TEXTURE_SLOTS, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER);
                desc.sets.push_back(material_types);

                const VkCommandBuffer commands = pass.commands();
                const VkDescriptorSetLayout material_layout =
                    pass.pipelines().set_layout(desc.sets[1]);
                bind_geometry(commands, scene);
                const auto draws = visible_draws(scene, world_to_clip, camera_m);
                const Pipeline* bound = nullptr;
                std::uint32_t bound_material = UINT32_MAX;
                const auto record = [&](const GraphicsDesc& wanted, const Draw& draw, bool shaded) {
                    const GpuMaterial& material = scene.materials()[draw.material];
                    const Pipeline& pipeline = pass.pipelines().graphics(wanted);
                    if (&pipeline != bound) {
                        pass.bind(pipeline);
                        bound = &pipeline;
                    }
                    if (shaded && draw.material != bound_material) {
                        pass.bind_set(1,
                                      pass.descriptors().set(material_layout, material.bindings));
                        bound_material = draw.material;
                    }
                    set_facing(commands, material.double_sided, draw.mirrored);
                    pass.push(draw_constants(draw));
                    vkCmdDrawIndexed(commands, draw.index_count, 1, draw.first_index,
                                     draw.vertex_offset, 0);
                };
                // Depth of the opaque things first, where shading is dear: then each pixel is
                // shaded once.
                const bool depth_first = any_weather;
                GraphicsDesc depth_only = desc;
                depth_only.vertex = "surface_depth.vert";
                depth_only.fragment.clear();
                depth_only.attributes.resize(1);
                depth_only.color_write = false;
                for (const Draw* draw : draws) {
                    if (depth_first && !has_holes(scene, *draw)) record(depth_only, *draw, false);
                }
                for (const Draw* draw : draws) {
                    const bool holes = has_holes(scene, *draw);
                    GraphicsDesc shaded = desc;
                    shaded.specialization = {
                        {SURFACE_SPEC_HOLES, holes},
                        {SURFACE_SPEC_SLOTS, scene.materials()[draw->material].slots},
                        {SURFACE_SPEC_WATER, weather.water},
                        {SURFACE_SPEC_SNOW, weather.snow}};
                    shaded.depth_equal = depth_first && !holes;
                    record(shaded, *draw, true);
                }
            },
    });
}

}  // namespace petrichor::gpu
