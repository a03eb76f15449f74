#include "gpu/passes/surface/surface.h"

#include <algorithm>
#include <cassert>
#include <tuple>
#include <utility>

#include "gpu/frame/frame_io.h"
#include "gpu/frame/frame_words_io.h"
#include "gpu/passes/surface/snow_bits.h"
#include "gpu/passes/surface/surface_draws_io.h"
#include "gpu/passes/surface/surface_io.h"
#include "gpu/upload/draw.h"

namespace petrichor::gpu {

namespace {

static_assert(sizeof(shared::DrawConstants) == SURFACE_DRAW_TEXELS * 16);

// plain: all materials have the payload of a cleared target.
const char* fragment_shader(const GBufferParts& parts, bool plain)
{
    if (plain) return "surface_plain.frag";
    if (parts.baked) return parts.weather ? "surface_baked.frag" : "surface_baked_dry.frag";
    if (parts.weather) return parts.emission ? "surface.frag" : "surface_dark.frag";
    return parts.emission ? "surface_dry.frag" : "surface_lean.frag";
}

// What mirrors as glass does, without grain, has the payload of a cleared target.
bool all_as_cleared(const GpuScene& scene)
{
    const auto& materials = scene.materials();
    return std::all_of(materials.begin(), materials.end(), [](const GpuMaterial& m) { return (m.besides & BESIDES_AS_CLEARED) != 0; });
}

void clear_payload(FrameGraph& graph, GpuImage& payload)
{
    graph.add(TransferPass{"surface", {{.image = &payload}}, [&payload](VkCommandBuffer commands) {
                               const VkClearColorValue value{{0.2f, 0.2f, 0.2f, 0.0f}};
                               const VkImageSubresourceRange all{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
                               vkCmdClearColorImage(commands, payload.image.get(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &value, 1, &all);
                           }});
}

}  // namespace

void add_surface(FrameGraph& graph, FrameTargets& targets, const GpuScene& scene, SurfaceMaps& maps,
                 DepthMaps& depth_maps, GpuPlace& place, const VertexLight& vertex_light, const ConstantsRange& constants,
                 const glm::mat4& world_to_clip, const glm::vec3& camera_m,
                 const VisibleWeather& weather, Draws which, const SurfaceLayer* layer, std::shared_ptr<const SeenDraws> seen)
{
    GBuffer& g = targets.gbuffer;
    const GBufferParts parts =
        layer ? GBufferParts{true, true, scene.baked()} : gbuffer_parts(scene, weather.any);
    const bool plain = !layer && !parts.weather && !parts.emission && all_as_cleared(scene);
    const bool chance = layer ? layer->by_chance : true;
    const std::uint32_t first = layer && layer->first ? 1 : 0;
    const std::string fragment = layer ? (parts.baked ? "transparent_baked.frag" : "transparent.frag") : fragment_shader(parts, plain);
    Bindings bindings{{SURFACE_FRAME, frame_binding(constants)},
                      {SURFACE_RIPPLE, sampled(*maps.ripple, maps.trilinear)},
                      {SURFACE_FLOW, texels(*maps.flow_quads)},
                      {SURFACE_SNOW, sampled(*maps.snow, maps.trilinear)},
                      {SURFACE_TRACKS, sampled(*maps.tracks, maps.clamped)},
                      {SURFACE_INSTANCE_LOOKS, texels(scene.instance_looks())},
                      {SURFACE_SHELTER, texels(*depth_maps.depth_quads)}};
    bind_place(bindings, SURFACE_PLACE_TABLE, place);
    if (layer) {
        bindings.push_back({SURFACE_LAYER_SOLID_DEPTH, sampled(*layer->solid_depth, targets.nearest)});
        bindings.push_back({SURFACE_LAYER_BEFORE, sampled(*layer->before, targets.nearest)});
    } else {
        for (const std::uint32_t unread : {SURFACE_LAYER_SOLID_DEPTH, SURFACE_LAYER_BEFORE})
            bindings.push_back({unread, sampled(*maps.ripple, maps.trilinear)});
    }
    bindings.push_back({SURFACE_DRAWS, texels(scene.draw_rows())});
    bindings.push_back({SURFACE_LIT_VERTICES, texels(vertex_light.light())});
    bindings.push_back({SURFACE_LIT_FIRSTS, texels(vertex_light.firsts())});
    const bool layered = layer != nullptr;
    std::vector<Attachment> colors = gbuffer_attachments(g, parts);
    if (layer) {
        assert(colors.size() == SURFACE_LAYER_THROUGH);
        colors.emplace_back(*layer->through);
    } else if (plain) {
        clear_payload(graph, *g.payload);
        colors[GBUFFER_PAYLOAD] = {};
    }
    const SnowBits snow(scene, maps);
    const std::uint32_t lanes = targets.lanes;
    graph.add(DrawPass{
        .name = layer ? "transparent" : "surface",
        .colors = std::move(colors),
        .depth = Attachment(*g.depth),
        .width = targets.width,
        .height = targets.height,
        .bindings = std::move(bindings),
        .record =
            [=, &scene](PassContext& pass) {
                GraphicsDesc desc;
                desc.vertex = "surface.vert";
                desc.fragment = fragment;
                desc.stride = sizeof(Vertex);
                desc.attributes = vertex_attributes();
                desc.colors = pass.color_formats();
                desc.sets.push_back(pass.set_types());
                BindingTypes material_types{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER};
                material_types.resize(1 + MATERIAL_TEXTURE_SLOTS, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER);
                desc.sets.push_back(material_types);

                const VkCommandBuffer commands = pass.commands();
                const VkDescriptorSetLayout material_layout =
                    pass.pipelines().set_layout(desc.sets[1]);
                bind_geometry(commands, scene);
                const auto runs = visible_runs(scene, world_to_clip, camera_m, which);
                SeenBinder binder(commands, scene, seen.get());
                const Pipeline* bound = nullptr;
                std::uint32_t bound_material = UINT32_MAX;
                const auto record = [&](const GraphicsDesc& wanted, const DrawRun& run, bool shaded) {
                    const Draw& draw = *run.first;
                    const SeenRange range = run.count > 1 ? SeenRange{} : binder.range_of(draw);
                    if (range.index_count == 0) return;
                    const auto number = static_cast<std::uint32_t>(&draw - scene.draws().data());
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
                    set_facing(commands, material.cull, draw.mirrored);
                    pass.push(draw_constants(draw));
                    if (run.count > 1) {
                        binder.draw_run(draw, run.count, number);
                    } else {
                        binder.draw(draw, range, number);
                    }
                };
                // Depth of the opaque things first, where shading is dear: then each pixel is
                // shaded once.
                const bool depth_first = parts.weather && !layered;
                GraphicsDesc depth_only = desc;
                depth_only.vertex = "surface_depth.vert";
                depth_only.fragment.clear();
                depth_only.attributes.resize(1);
                depth_only.color_write = false;
                for (const DrawRun& run : runs) {
                    if (!depth_first || has_holes(scene, *run.first)) continue;
                    depth_only.specialization = {{SURFACE_SPEC_INSTANCED, run.count > 1}};
                    record(depth_only, run, false);
                }
                for (const DrawRun& run : runs) {
                    const Draw* draw = run.first;
                    const bool holes = has_holes(scene, *draw);
                    GraphicsDesc shaded = desc;
                    const std::uint32_t own = scene.materials()[draw->material].own_surface;
                    if (layered && own != 0) shaded.fragment = kOwnTransparentShader;
                    shaded.specialization = {
                        {FRAME_SPEC_LANES, lanes},
                        {SURFACE_SPEC_HOLES, holes && chance},
                        {SURFACE_SPEC_SLOTS, scene.materials()[draw->material].slots},
                        {SURFACE_SPEC_WATER,
                         weather.water ? scene.materials()[draw->material].water : 0u},
                        {SURFACE_SPEC_SNOW,
                         weather.snow ? snow.of(scene.materials()[draw->material]) : 0u},
                        {SURFACE_SPEC_FROST, weather.frost},
                        {SURFACE_SPEC_FALLS, weather.falls},
                        {SURFACE_SPEC_PARALLAX, scene.materials()[draw->material].parallax},
                        {SURFACE_SPEC_SECOND, scene.materials()[draw->material].second},
                        {SURFACE_SPEC_LOOKS, run.count > 1 ? scene.materials()[draw->material].looks : draw->look != 0},
                        {SURFACE_SPEC_INSTANCED, run.count > 1},
                        {SURFACE_SPEC_LAYER_ROLES_A, scene.materials()[draw->material].layer_roles[0]},
                        {SURFACE_SPEC_LAYER_ROLES_B, scene.materials()[draw->material].layer_roles[1]},
                        {SURFACE_SPEC_LAYER_ROLES_C, scene.materials()[draw->material].layer_roles[2]},
                        {SURFACE_SPEC_BESIDES, scene.materials()[draw->material].besides},
                        {SURFACE_SPEC_GROUND_VARIES, weather.ground_varies},
                        {SURFACE_SPEC_FADE, draw->fade != 0},
                        {SURFACE_SPEC_VERTEX_LIGHT, scene.vertex_lamps()},
                        {SURFACE_SPEC_STRETCH, scene.texture_stretch()},
                        {SURFACE_SPEC_PLACE, weather.place}};
                    if (layered) shaded.specialization.push_back({SURFACE_SPEC_LAYER_FIRST, first});
                    if (layered && own != 0) shaded.specialization.push_back({SURFACE_SPEC_OWN, own});
                    shaded.depth_equal = depth_first && !holes;
                    record(shaded, run, true);
                }
            },
    });
}

}  // namespace petrichor::gpu
