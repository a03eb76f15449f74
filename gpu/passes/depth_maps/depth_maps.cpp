#include "gpu/passes/depth_maps/depth_maps.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "gpu/passes/depth_maps/depth_maps_io.h"
#include "gpu/passes/depth_maps/depth_quads_io.h"
#include "gpu/passes/shapes/shapes.h"
#include "gpu/upload/draw.h"

namespace petrichor::gpu {

namespace {

constexpr VkDeviceSize kSkyLayerBytes = VkDeviceSize{kSkyMapSize} * kSkyMapSize * sizeof(glm::uvec2);
static_assert(kSkyMapSize % DEPTH_QUADS_TILE == 0);

}  // namespace

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

namespace {

bool casts(const GpuMaterial& material, Falls falls)
{
    if (material.blended && falls == Falls::Rain) return false;
    if (material.glows && falls == Falls::Lamp) return false;
    return material.casts_shadows || falls == Falls::Rain;
}

bool is_caster(const GpuScene& scene, const Draw& draw, Falls falls)
{
    if (!draw.casts || draw.index_count == 0) return false;
    if (draw.overlay && falls != Falls::Light) return false;
    return casts(scene.materials()[draw.material], falls);
}

bool holes_in_relief(const GpuMaterial& material)
{
    return material.masked && material.parallax != PARALLAX_NONE;
}

// Where a map looks from: what it sees at an infinite depth before it. w 0: a direction.
glm::vec4 eye_of(const glm::mat4& clip_from_world)
{
    const glm::vec4 eye = glm::inverse(clip_from_world) * glm::vec4(0.0f, 0.0f, 1.0f, 0.0f);
    if (std::abs(eye.w) > 1.0e-6f * glm::length(glm::vec3(eye)))
        return glm::vec4(glm::vec3(eye) / eye.w, 1.0f);
    return glm::vec4(glm::normalize(glm::vec3(eye)), 0.0f);
}

}  // namespace

Casters casters_in(SeenTriangles& triangles, const GpuScene& scene, const glm::mat4& clip_from_world,
                   int size, Falls falls, const AskedPart& asked)
{
    const Frustum frustum(clip_from_world);
    const auto wanted = [&](const Draw& draw) {
        return is_caster(scene, draw, falls) && frustum.touches(draw.centre_m, draw.radius_m) &&
               asked_of(asked, clip_from_world, draw.centre_m, draw.radius_m);
    };
    Casters casters;
    casters.seen = triangles.list(scene, {clip_from_world, size, size, {glm::vec2(0.0f)}, falls == Falls::Light ? Covered::kFromSun : std::uint8_t{0}, asked}, true, wanted);
    casters.size = size;
    for (const Draw* shape : shapes_in(scene, clip_from_world, asked)) {
        if (casts(scene.materials()[shape->material], falls)) casters.shapes.push_back(shape);
    }
    InstancePlaces& places = triangles.places();
    casters.places = places.texels();
    const auto listed = [&](const Draw& draw) {
        return casters.seen &&
               !casters.seen->ranges[static_cast<std::size_t>(&draw - scene.draws().data())].whole();
    };
    std::vector<const Draw*> alike;
    std::vector<glm::mat4> at;
    const auto finish = [&] {
        std::optional<std::uint32_t> first;
        if (casters.places && alike.size() >= kLeastRun) {
            at.clear();
            for (const Draw* draw : alike) at.push_back(clip_from_world * draw->to_world);
            if (holes_in_relief(scene.materials()[alike[0]->material])) {
                for (const Draw* draw : alike) at.push_back(draw->to_world);
            }
            first = places.add(at);
        }
        if (first) {
            casters.runs.push_back({alike[0], static_cast<std::uint32_t>(alike.size()), *first});
        } else {
            casters.single.insert(casters.single.end(), alike.begin(), alike.end());
        }
        alike.clear();
    };
    for (const Draw& draw : scene.draws()) {
        if (!wanted(draw)) continue;
        const bool apart = listed(draw);
        if (!alike.empty() && (apart || !same_shape(*alike[0], draw))) finish();
        if (apart) {
            casters.single.push_back(&draw);
        } else {
            alike.push_back(&draw);
        }
    }
    finish();
    return casters;
}

void draw_casters(PassContext& pass, const GpuScene& scene, const glm::mat4& clip_from_world,
                  Falls falls, const Casters& casters)
{
    const VkCommandBuffer commands = pass.commands();
    bind_geometry(commands, scene);

    GraphicsDesc plain;
    plain.vertex = "depth_only.vert";
    plain.stride = sizeof(glm::vec3);
    plain.attributes = {position_attribute()};
    plain.specialization = {{DEPTH_SPEC_FLATTEN, falls != Falls::Lamp}};
    GraphicsDesc masked = plain;
    masked.vertex = "depth_masked.vert";
    masked.fragment = "depth_masked.frag";
    masked.stride = sizeof(Vertex);
    masked.attributes = {vertex_attributes()[0], vertex_attributes()[3], vertex_attributes()[4]};
    masked.sets = {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER}};

    GraphicsDesc relief = masked;
    relief.vertex = "depth_relief.vert";
    relief.fragment = "depth_relief.frag";
    relief.sets[0].push_back(VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER);
    relief.specialization.push_back({DEPTH_SPEC_PARALLAX, 0});
    const glm::vec4 eye = eye_of(clip_from_world);

    SeenBinder binder(commands, scene, casters.seen.get());
    VertexBinder vertices(commands, scene);
    const Pipeline* bound = nullptr;
    std::uint32_t bound_material = UINT32_MAX;
    for (const Draw* single : casters.single) {
        const Draw& draw = *single;
        const GpuMaterial& material = scene.materials()[draw.material];
        const bool holes = material.masked || material.blended;
        const SeenRange range = binder.range_of(draw);
        if (range.index_count == 0) continue;
        const bool deep = holes_in_relief(material);
        vertices.bind(!holes);
        if (deep) relief.specialization.back().value = material.parallax;
        const Pipeline& wanted = pass.pipelines().graphics(deep ? relief : holes ? masked : plain);
        if (bound != &wanted) {
            pass.bind(wanted);
            bound = &wanted;
            bound_material = UINT32_MAX;
        }
        if (holes && bound_material != draw.material) {
            std::vector<Binding> bindings{material.bindings[0], material.bindings[1 + TEXTURE_BASE_COLOR]};
            if (deep) bindings.push_back(material.bindings[1 + TEXTURE_HEIGHT]);
            pass.bind_set(0, pass.descriptors().set(wanted.set_layouts[0], bindings));
            bound_material = draw.material;
        }
        // Thin things such as leaves and roofs of one polygon cast from both sides.
        set_facing(commands, VK_CULL_MODE_NONE, draw.mirrored);
        const glm::mat4 clip_from_object = clip_from_world * draw.to_world;
        if (deep) {
            const glm::mat4 rows = glm::transpose(draw.to_world);
            pass.push(shared::ReliefDraw{clip_from_object, {rows[0], rows[1], rows[2]}, eye});
        } else {
            pass.push(clip_from_object);
        }
        binder.draw(draw, range);
    }

    plain.vertex = "depth_only_run.vert";
    plain.sets = {{VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER}};
    masked.vertex = "depth_masked_run.vert";
    masked.sets.push_back({VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER});
    relief.vertex = "depth_relief_run.vert";
    relief.sets.push_back({VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER});
    for (const Casters::Run& run : casters.runs) {
        const GpuMaterial& material = scene.materials()[run.first->material];
        const bool holes = material.masked || material.blended;
        vertices.bind(!holes);
        const bool deep = holes_in_relief(material);
        if (deep) relief.specialization.back().value = material.parallax;
        const Pipeline& wanted = pass.pipelines().graphics(deep ? relief : holes ? masked : plain);
        pass.bind(wanted);
        if (deep) pass.push(shared::ReliefRun{eye, run.count});
        if (holes) {
            std::vector<Binding> bindings{material.bindings[0], material.bindings[1 + TEXTURE_BASE_COLOR]};
            if (deep) bindings.push_back(material.bindings[1 + TEXTURE_HEIGHT]);
            pass.bind_set(0, pass.descriptors().set(wanted.set_layouts[0], bindings));
        }
        const std::vector<Binding> places{texels(*casters.places)};
        const std::uint32_t set = holes ? 1 : 0;
        pass.bind_set(set, pass.descriptors().set(wanted.set_layouts[set], places));
        set_facing(commands, VK_CULL_MODE_NONE, run.first->mirrored);
        binder.draw_run(*run.first, run.count, run.first_place);
    }
    if (!casters.shapes.empty())
        draw_shape_depths(pass, scene, map_view(clip_from_world, eye, casters.size, falls != Falls::Lamp), casters.shapes);
}

namespace {

void add_depth_map(FrameGraph& graph, const char* name, const GpuScene& scene,
                   SeenTriangles& triangles, const DepthView& view, GpuImage& map, VkImageView layer,
                   Falls falls)
{
    const Casters casters = casters_in(triangles, scene, view.clip_from_world, map.width, falls, view.asked);
    graph.add(DrawPass{.name = name,
                       .colors = {},
                       .depth = Attachment(map, layer),
                       .width = map.width,
                       .height = map.height,
                       .bindings = {},
                       .record = [&scene, view, falls, casters](PassContext& pass) {
                           draw_casters(pass, scene, view.clip_from_world, falls, casters);
                       }});
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
      depth_quads(arena.buffer({.name = "depth_quads",
                                .size = SKY_DIRECTIONS * kSkyLayerBytes,
                                .usage = VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                .texel_format = VK_FORMAT_R32G32_UINT})),
      compare(make_sampler(device, VK_FILTER_LINEAR, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                           VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE, true)),
      plain(make_sampler(device, VK_FILTER_NEAREST, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                         VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE, false, 0.0f, true))
{
    for (std::uint32_t i = 0; i < SHADOW_CASCADES; ++i) {
        shadow_layers.push_back(layer_view(device, *shadow, i));
    }
    for (std::uint32_t i = 0; i < SKY_DIRECTIONS; ++i) {
        sky_layers.push_back(layer_view(device, *sky, i));
    }
}

void add_shadow(FrameGraph& graph, DepthMaps& maps, const GpuScene& scene, SeenTriangles& triangles,
                const std::array<DepthView, SHADOW_CASCADES>& views, std::size_t first)
{
    // Where one map is enough, for the small frame that is metered, what lies on the scene is flatter than its texels.
    const Falls falls = first == 0 ? Falls::Light : Falls::Sky;
    for (std::size_t i = first; i < SHADOW_CASCADES; ++i) {
        DepthView& held = maps.shadow_views[i];
        const bool kept = maps.shadow_valid[i] && views[i] == held;
        if (kept && (held.asked.count == 0 || held.asked == views[i].asked)) continue;
        held = views[i];
        // The camera moves and its map does not: whole, the map lasts.
        if (kept) held.asked = {};
        maps.shadow_valid[i] = true;
        add_depth_map(graph, "shadow", scene, triangles, maps.shadow_views[i], *maps.shadow,
                      maps.shadow_layers[i].get(), falls);
    }
}

void add_sky_visibility(FrameGraph& graph, DepthMaps& maps, const GpuScene& scene,
                        SeenTriangles& triangles)
{
    maps.depth_quads_valid.fill(false);
    for (std::size_t i = 0; i < SKY_DIRECTIONS; ++i) {
        add_depth_map(graph, "sky_visibility", scene, triangles, maps.sky_views[i], *maps.sky,
                      maps.sky_layers[i].get(), Falls::Sky);
    }
}

void add_depth_quads(FrameGraph& graph, DepthMaps& maps, const std::vector<int>& directions)
{
    for (const int i : directions) {
        const auto layer = static_cast<std::size_t>(i);
        if (maps.depth_quads_valid[layer]) continue;
        maps.depth_quads_valid[layer] = true;
        graph.add(ComputePass{.name = "sky_visibility",
                              .shader = "depth_quads.comp",
                              .constants = {},
                              .bindings = {{DEPTH_QUADS_MAPS, sampled(*maps.sky, maps.plain)},
                                           {DEPTH_QUADS_QUADS, storage_buffer(*maps.depth_quads)}},
                              .push = PushBlock(shared::DepthQuadsParams{i}),
                              .groups = groups_over(kSkyMapSize, kSkyMapSize, DEPTH_QUADS_TILE)});
    }
}

void add_shelter(FrameGraph& graph, DepthMaps& maps, const GpuScene& scene,
                 SeenTriangles& triangles)
{
    add_depth_map(graph, "shelter", scene, triangles, maps.shelter_view, *maps.shelter,
                  maps.shelter->view.get(), Falls::Rain);
}

}  // namespace petrichor::gpu
