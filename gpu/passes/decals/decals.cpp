#include "gpu/passes/decals/decals.h"

#include <cmath>
#include <iterator>

#include "gpu/passes/surface/surface_draws_io.h"
#include "gpu/passes/surface/surface_io.h"
#include "gpu/passes/surface_resolve/surface_resolve_io.h"
#include "gpu/upload/draw.h"

namespace petrichor::gpu {

namespace {

// No two specialization constants of a surface have one number.
constexpr int kSpecialized[] = {
    SURFACE_SPEC_HOLES,    SURFACE_SPEC_SLOTS,         SURFACE_SPEC_WATER,
    SURFACE_SPEC_SNOW,     SURFACE_SPEC_FROST,         SURFACE_SPEC_PARALLAX,
    SURFACE_SPEC_SECOND,   SURFACE_SPEC_LOOKS,         SURFACE_SPEC_FADE,
    SURFACE_SPEC_OWN,      SURFACE_SPEC_LAYER_ROLES_A, SURFACE_SPEC_LAYER_ROLES_B,
    SURFACE_SPEC_BESIDES,  SURFACE_SPEC_PLACE,         SURFACE_SPEC_LAYER_FIRST,
    SURFACE_SPEC_LAYER_ROLES_C,                        SURFACE_SPEC_FALLS,
    DECAL_SPEC_WEATHER,    DECAL_SPEC_EMISSION,        RESOLVE_SPEC_WEATHER,
    RESOLVE_SPEC_EMISSION, RESOLVE_SPEC_BAKED,         RESOLVE_SPEC_PAYLOAD,
    RESOLVE_SPEC_SHAPES,   RESOLVE_SPEC_IN_WORLD,      SURFACE_SPEC_INSTANCED,
    SURFACE_SPEC_STRETCH,  SURFACE_SPEC_GROUND_VARIES, SURFACE_SPEC_VERTEX_LIGHT};
constexpr bool all_differ()
{
    for (std::size_t i = 0; i < std::size(kSpecialized); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            if (kSpecialized[i] == kSpecialized[k]) return false;
        }
    }
    return true;
}
static_assert(all_differ());

constexpr VkFormat kFormat = VK_FORMAT_R16G16B16A16_SFLOAT;

shared::DecalBoxDraw box_draw(const Decal& decal)
{
    shared::DecalBoxDraw draw{};
    const glm::mat4 to_world = decal.box->to_world;
    const glm::mat4 to_box = glm::inverse(to_world);
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 4; ++column) {
            draw.to_world[row][column] = to_world[column][row];
            draw.to_box[row][column] = to_box[column][row];
        }
    }
    draw.full_cos = std::cos(decal.box->full_angle_rad);
    draw.none_cos = std::min(std::cos(decal.box->none_angle_rad), draw.full_cos - 1.0e-4f);
    draw.edge_fade = decal.box->edge_fade;
    draw.material_id = decal.draw.material;
    return draw;
}

// One after the other, lower ones first: blending mixes them in this order.
void draw_decals(PassContext& pass, const GpuScene& scene, const Frustum& frustum,
                 const VisibleWeather& weather, const GBufferParts& parts, std::uint32_t tracks)
{
    GraphicsDesc desc;
    desc.colors = pass.color_formats();
    desc.depth = VK_FORMAT_UNDEFINED;
    desc.over_all = true;
    BindingTypes material_types{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER};
    material_types.resize(1 + MATERIAL_TEXTURE_SLOTS, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER);
    desc.sets = {pass.set_types(), material_types};
    const VkDescriptorSetLayout material_layout = pass.pipelines().set_layout(material_types);
    bind_geometry(pass.commands(), scene);
    for (const Decal& decal : scene.decals()) {
        const Draw& draw = decal.draw;
        if (!frustum.touches(draw.centre_m, draw.radius_m)) continue;
        if (!decal.box && draw.index_count == 0) continue;
        const GpuMaterial& material = scene.materials()[draw.material];
        desc.vertex = decal.box ? "decal_box.vert" : "surface.vert";
        desc.fragment = decal.box ? "decal_box.frag" : "decal.frag";
        desc.stride = sizeof(Vertex);
        desc.attributes = decal.box ? std::vector<VertexAttribute>{} : vertex_attributes();
        const bool own_weather = parts.weather && material.decal_weather;
        desc.specialization = {
            {SURFACE_SPEC_HOLES, 0u},
            {SURFACE_SPEC_SLOTS, material.slots},
            {SURFACE_SPEC_WATER, weather.water && own_weather ? material.water : 0u},
            {SURFACE_SPEC_SNOW, weather.snow && own_weather ? material.snow | tracks : 0u},
            {SURFACE_SPEC_FROST, 0u},
            {SURFACE_SPEC_FALLS, own_weather ? weather.falls : 0u},
            {SURFACE_SPEC_PARALLAX, material.parallax},
            {SURFACE_SPEC_SECOND, material.second},
            {SURFACE_SPEC_LOOKS, draw.look != 0},
            {SURFACE_SPEC_LAYER_ROLES_A, material.layer_roles[0]},
            {SURFACE_SPEC_LAYER_ROLES_B, material.layer_roles[1]},
            {SURFACE_SPEC_LAYER_ROLES_C, material.layer_roles[2]},
            {SURFACE_SPEC_BESIDES, material.besides},
            {SURFACE_SPEC_STRETCH, scene.texture_stretch()},
            {SURFACE_SPEC_PLACE, weather.place},
            {DECAL_SPEC_WEATHER, own_weather},
            {DECAL_SPEC_EMISSION, parts.emission}};
        pass.bind(pass.pipelines().graphics(desc));
        pass.bind_set(1, pass.descriptors().set(material_layout, material.bindings));
        if (decal.box) {
            const bool mirrored = glm::determinant(glm::mat3(draw.to_world)) < 0.0f;
            set_facing(pass.commands(), VK_CULL_MODE_FRONT_BIT, mirrored);
            pass.push(box_draw(decal));
            vkCmdDraw(pass.commands(), 36, 1, 0, 0);
        } else {
            set_facing(pass.commands(), material.cull, draw.mirrored);
            pass.push(draw_constants(draw));
            vkCmdDrawIndexed(pass.commands(), draw.index_count, 1, draw.first_index,
                             draw.vertex_offset, 0);
        }
    }
}

}  // namespace

DecalTargets make_decal_targets(MemoryArena& arena, int width, int height)
{
    DecalTargets own;
    const auto image = [&](const char* name) {
        return arena.image({.name = name,
                            .format = kFormat,
                            .width = width,
                            .height = height,
                            .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT});
    };
    own.color = image("decal_color");
    own.normal = image("decal_normal");
    own.matter = image("decal_matter");
    own.weather = image("decal_weather");
    own.cover = image("decal_cover");
    return own;
}

bool decals_in_view(const GpuScene& scene, const glm::mat4& world_to_clip)
{
    const Frustum frustum(world_to_clip);
    for (const Decal& decal : scene.decals()) {
        if (frustum.touches(decal.draw.centre_m, decal.draw.radius_m)) return true;
    }
    return false;
}

void add_decals(FrameGraph& graph, FrameTargets& targets, DecalTargets& own, const GpuScene& scene,
                SurfaceMaps& maps, DepthMaps& depth_maps, GpuPlace& place,
                const ConstantsRange& constants, const glm::mat4& world_to_clip,
                const VisibleWeather& weather)
{
    GBuffer& g = targets.gbuffer;
    const GBufferParts parts = gbuffer_parts(scene, weather.any);
    Bindings bindings{{SURFACE_FRAME, frame_binding(constants)},
                      {SURFACE_RIPPLE, sampled(*maps.ripple, maps.trilinear)},
                      {SURFACE_FLOW, texels(*maps.flow_quads)},
                      {SURFACE_SNOW, sampled(*maps.snow, maps.trilinear)},
                      {SURFACE_TRACKS, sampled(*maps.tracks, maps.clamped)},
                      {SURFACE_INSTANCE_LOOKS, texels(scene.instance_looks())},
                      {SURFACE_SHELTER, texels(*depth_maps.depth_quads)},
                      {DECAL_DEPTH, sampled(*g.depth, targets.nearest)},
                      {DECAL_NORMALS, sampled(*g.normals, targets.nearest)},
                      {SURFACE_DRAWS, texels(scene.draw_rows())}};
    bind_place(bindings, SURFACE_PLACE_TABLE, place);
    Attachment emission(*g.emission);
    emission.keep = parts.emission;
    const std::uint32_t tracks = maps.track_area.width > 0 ? SNOW_TRACKS : 0u;
    const Frustum frustum(world_to_clip);
    graph.add(DrawPass{.name = "decals",
                       .colors = {Attachment(*own.color), Attachment(*own.normal),
                                  Attachment(*own.matter), Attachment(*own.weather),
                                  Attachment(*own.cover), emission},
                       .depth = {},
                       .width = targets.width,
                       .height = targets.height,
                       .bindings = std::move(bindings),
                       .record = [=, &scene](PassContext& pass) {
                           draw_decals(pass, scene, frustum, weather, parts, tracks);
                       }});
    const SamplerHandle& nearest = targets.nearest;
    graph.add(ComputePass{
        .name = "decals",
        .shader = "decals_over.comp",
        .constants = {{DECALS_OVER_SPEC_WEATHER, parts.weather},
                      {DECALS_OVER_SPEC_REFUSED, parts.weather && scene.decals_refused()}},
        .bindings = {{DECALS_OVER_FRAME, frame_binding(constants)},
                     {DECALS_OVER_LAID, sampled(*own.color, nearest)},
                     {DECALS_OVER_LAID + 1, sampled(*own.normal, nearest)},
                     {DECALS_OVER_LAID + 2, sampled(*own.matter, nearest)},
                     {DECALS_OVER_LAID + 3, sampled(*own.weather, nearest)},
                     {DECALS_OVER_LAID + 4, sampled(*own.cover, nearest)},
                     {DECALS_OVER_LOOKS, texels(scene.material_looks())},
                     {DECALS_OVER_COLOR, storage(*g.color)},
                     {DECALS_OVER_NORMALS, storage(*g.normals)},
                     {DECALS_OVER_MATERIAL, storage(*g.material)},
                     {DECALS_OVER_WEATHER, storage(*g.weather)}},
        .push = {},
        .groups = groups_over(targets.width, targets.height, DECALS_OVER_TILE)});
}

}  // namespace petrichor::gpu
