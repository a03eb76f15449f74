#include "gpu/passes/surface_resolve/surface_resolve.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "gpu/frame/frame_words_io.h"
#include "gpu/passes/surface/snow_bits.h"
#include "gpu/passes/surface_resolve/surface_resolve_io.h"
#include "gpu/upload/draw.h"

namespace petrichor::gpu {

namespace {

constexpr const char* kResolveShader = "surface_resolve.comp";

glm::uvec4 bits_of(const glm::vec4& v)
{
    return std::bit_cast<glm::uvec4>(v);
}

std::vector<glm::uvec4> draw_table(const GpuScene& scene)
{
    std::vector<glm::uvec4> table;
    table.reserve(scene.draws().size() * RESOLVE_DRAW_TEXELS + 1);
    for (const Draw& draw : scene.draws()) {
        const shared::DrawConstants c = draw_constants(draw);
        for (const glm::vec4& row : c.to_world) table.push_back(bits_of(row));
        for (const glm::vec4& row : c.normal_to_world) table.push_back(bits_of(row));
        const std::uint8_t steep = scene.steep().whole[static_cast<std::size_t>(&draw - scene.draws().data())];
        const std::uint32_t marks = ((steep & SteepTriangles::kDry) != 0 ? DRAW_DRY : 0u) |
                                    ((steep & SteepTriangles::kUpright) != 0 ? DRAW_UPRIGHT : 0u);
        table.emplace_back(draw.first_index, static_cast<std::uint32_t>(draw.vertex_offset),
                           draw.material | marks, draw.instance_id);
        table.emplace_back(draw.mirrored ? 1u : 0u, draw.look, draw.shape >= 0 ? 1u : 0u, 0u);
    }
    if (table.empty()) table.emplace_back(0u);
    return table;
}

VkDeviceSize tiles_across(int pixels)
{
    return static_cast<VkDeviceSize>((pixels + RESOLVE_TILE - 1) / RESOLVE_TILE);
}

// What most materials have is cleared, in place of a store a pixel: no light of its own and the reflectance of glass.
void clear_targets(FrameGraph& graph, FrameTargets& targets, const GBufferParts& parts)
{
    std::vector<std::pair<GpuImage*, VkClearColorValue>> clears{
        {targets.gbuffer.payload.get(), {{0.2f, 0.2f, 0.2f, 0.0f}}}};
    if (parts.emission) clears.push_back({targets.gbuffer.emission.get(), {{0.0f, 0.0f, 0.0f, 1.0f}}});
    std::vector<Transfer> transfers;
    for (const auto& [image, value] : clears) transfers.push_back({.image = image, .use = Use::TransferTarget});
    graph.add(TransferPass{"surface", std::move(transfers), [clears](VkCommandBuffer commands) {
                               for (const auto& [image, value] : clears) {
                                   const VkImageSubresourceRange all{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
                                   vkCmdClearColorImage(commands, image->image.get(),
                                                        VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &value, 1, &all);
                               }
                           }});
}

}  // namespace

ResolveTables make_resolve_tables(const Device& device, MemoryArena& arena, const GpuScene& scene,
                                  int width, int height)
{
    ResolveTables tables;
    ImageInRows ids = arena.image_in_rows({.name = "ids",
                                           .format = VK_FORMAT_R32G32_UINT,
                                           .width = width,
                                           .height = height,
                                           .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
                                                    VK_IMAGE_USAGE_SAMPLED_BIT |
                                                    VK_IMAGE_USAGE_TRANSFER_SRC_BIT},
                                          8);
    tables.ids = std::move(ids.image);
    tables.id_rows = std::move(ids.rows);
    const bool shares = scene.layer_shares();
    tables.shares = arena.image({.name = "layer_shares",
                                 .format = VK_FORMAT_R32G32B32A32_UINT,
                                 .width = shares ? width : 1,
                                 .height = shares ? height : 1,
                                 .usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT});
    const std::vector<glm::uvec4> draws = draw_table(scene);
    tables.draws = arena.buffer(
        {.name = "draw_table",
         .size = draws.size() * sizeof(glm::uvec4),
         .usage = VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
         .texel_format = VK_FORMAT_R32G32B32A32_UINT});
    upload_buffer(device, *tables.draws, std::as_bytes(std::span(draws)));
    tables.poses = scene.poses();
    const VkDeviceSize lists = 2 * std::max<VkDeviceSize>(scene.materials().size(), 1);
    const VkBufferUsageFlags table =
        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;
    tables.counts = arena.buffer({.name = "tile_counts",
                                  .size = lists * 4,
                                  .usage = table | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                  .texel_format = VK_FORMAT_R32_UINT});
    tables.pixels = arena.buffer({.name = "pixel_lists",
                                  .size = static_cast<VkDeviceSize>(width) *
                                          static_cast<VkDeviceSize>(height) * 4,
                                  .usage = table,
                                  .texel_format = VK_FORMAT_R32_UINT});
    tables.asked = arena.buffer({.name = "asked",
                                 .size = tiles_across(width) * tiles_across(height) * 8,
                                 .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT});
    tables.groups = arena.buffer(
        {.name = "tile_groups",
         .size = lists * sizeof(VkDispatchIndirectCommand),
         .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT});
    return tables;
}

void update_draws(const Device& device, ResolveTables& tables, const GpuScene& scene)
{
    if (tables.poses == scene.poses()) return;
    tables.poses = scene.poses();
    const std::vector<glm::uvec4> draws = draw_table(scene);
    upload_buffer(device, *tables.draws, std::as_bytes(std::span(draws)));
}

std::uint8_t listed_steep(const VisibleWeather& weather)
{
    // Snow and frost ask every slope for its bumps; what is left to spare is not worth more pipelines at a first start.
    if (!weather.water || weather.snow || weather.frost) return 0;
    return weather.place ? SteepTriangles::kUpright : SteepTriangles::kDry;
}

void add_surface_resolve(FrameGraph& graph, FrameTargets& targets, ResolveTables& tables,
                         const GpuScene& scene, SurfaceMaps& maps, DepthMaps& depth_maps, GpuPlace& place, const VertexLight& vertex_light,
                         const ConstantsRange& constants, const VisibleWeather& weather, bool asked)
{
    const auto materials = static_cast<std::uint32_t>(scene.materials().size());
    const std::uint8_t kind = listed_steep(weather);
    const std::uint32_t steep = kind == 0 ? 0u : kind == SteepTriangles::kDry ? DRAW_DRY : DRAW_UPRIGHT;
    GpuBuffer& counts = *tables.counts;
    // Read twice to list the pixels and once to shade them: as texels of a buffer in half the time.
    GpuBuffer& id_rows = *tables.id_rows;
    add_rows(graph, "tile_materials", {{tables.ids.get(), &id_rows}});
    graph.add(TransferPass{.name = "tile_materials",
                           .transfers = {{nullptr, &counts, Use::TransferTarget}},
                           .record = [&counts](VkCommandBuffer commands) {
                               vkCmdFillBuffer(commands, counts.buffer.get(), 0, VK_WHOLE_SIZE, 0);
                           }});
    const auto bin = [&](std::uint32_t list) {
        const int across = static_cast<int>(tiles_across(targets.width));
        const int down = static_cast<int>(tiles_across(targets.height));
        graph.add(ComputePass{
            .name = "tile_materials",
            .shader = "tile_materials.comp",
            .constants = {{TILE_MATERIALS_SPEC_LIST, list},
                          {TILE_MATERIALS_SPEC_ASKED, asked}},
            .bindings = {{TILE_MATERIALS_IDS, texels(id_rows)},
                         {TILE_MATERIALS_DRAWS, texels(*tables.draws)},
                         {TILE_MATERIALS_COUNTS, storage_buffer(counts)},
                         {TILE_MATERIALS_PIXELS, storage_buffer(*tables.pixels)},
                         {TILE_MATERIALS_ASKED, storage_buffer(*tables.asked)}},
            .push =
                PushBlock(shared::TileMaterialsParams{{targets.width, targets.height}, steep}),
            .groups = groups_over(across, down, TILE_MATERIALS_GROUP)});
    };
    bin(0);
    graph.add(ComputePass{.name = "tile_materials",
                          .shader = "tile_offsets.comp",
                          .constants = {},
                          .bindings = {{TILE_OFFSETS_COUNTS, storage_buffer(counts)},
                                       {TILE_OFFSETS_GROUPS, storage_buffer(*tables.groups)}},
                          .push = PushBlock(shared::TileOffsetsParams{2 * materials, targets.lanes != 0 ? std::uint32_t{RESOLVE_CPU_GROUP} : std::uint32_t{RESOLVE_GROUP}}),
                          .groups = {}});
    bin(1);

    Bindings bindings{{SURFACE_FRAME, frame_binding(constants)},
                      {SURFACE_RIPPLE, sampled(*maps.ripple, maps.trilinear)},
                      {SURFACE_FLOW, texels(*maps.flow_quads)},
                      {SURFACE_SNOW, sampled(*maps.snow, maps.trilinear)},
                      {SURFACE_TRACKS, sampled(*maps.tracks, maps.clamped)},
                      {SURFACE_INSTANCE_LOOKS, texels(scene.instance_looks())},
                      {SURFACE_SHELTER, texels(*depth_maps.depth_quads)},
                      {RESOLVE_IDS, texels(id_rows)},
                      {RESOLVE_VERTICES, texels(scene.vertex_texels())},
                      {RESOLVE_INDICES, texels(scene.index_texels())},
                      {RESOLVE_DRAWS, texels(*tables.draws)},
                      {RESOLVE_PIXELS, texels(*tables.pixels)},
                      {RESOLVE_COUNTS, texels(counts)}};
    bind_place(bindings, SURFACE_PLACE_TABLE, place);
    bindings.push_back({RESOLVE_SHARES, storage(*tables.shares)});
    bindings.push_back({RESOLVE_DEPTH, scene.shapes().empty() ? sampled(*maps.ripple, maps.trilinear)
                                                              : sampled(*targets.gbuffer.depth, targets.nearest)});
    bindings.push_back({RESOLVE_WET, storage(*targets.wet)});
#define ROW(name, location, format, when, meaning) \
    bindings.push_back({RESOLVE_TARGETS + location, storage(*targets.gbuffer.name)});
    GBUFFER_TABLE(ROW)
#undef ROW
    static_assert(RESOLVE_LIT_VERTICES == RESOLVE_TARGETS + GBUFFER_BINDINGS - 1);
    bindings.push_back({RESOLVE_LIT_VERTICES, texels(vertex_light.light())});
    bindings.push_back({RESOLVE_LIT_FIRSTS, texels(vertex_light.firsts())});
    const GBufferParts parts = gbuffer_parts(scene, weather.any);
    const std::uint32_t shares = scene.layer_shares() ? BESIDES_SHARES : 0u;
    const bool any_emission = parts.emission;
    const auto glows = [any_emission](const GpuMaterial& material) {
        return any_emission && (material.glows || material.own_surface != 0);
    };
    const std::uint32_t lanes = targets.lanes;
    const std::uint32_t kept = parts.weather ? targets.weather_kept() : WEATHER_DRY;
    const auto variant = [parts, kept, lanes, weather, by_vertex = scene.vertex_lamps(), stretch = scene.texture_stretch(), snow = SnowBits(scene, maps), shares,
                          glows](const GpuMaterial& material, bool shedding) {
        const std::uint32_t water = material.water | (shedding && material.sheds ? WATER_STEEP : 0u);
        return std::vector<Specialization>{
            {SURFACE_SPEC_HOLES, 0},
            {SURFACE_SPEC_SLOTS, material.slots},
            {SURFACE_SPEC_WATER, weather.water ? water : 0u},
            {SURFACE_SPEC_SNOW, weather.snow ? snow.of(material) : 0u},
            {SURFACE_SPEC_FROST, weather.frost},
            {SURFACE_SPEC_FALLS, weather.falls},
            {SURFACE_SPEC_PARALLAX, material.parallax},
            {SURFACE_SPEC_SECOND, material.second},
            {SURFACE_SPEC_LOOKS, material.looks},
            {SURFACE_SPEC_OWN, material.own_surface},
            {SURFACE_SPEC_LAYER_ROLES_A, material.layer_roles[0]},
            {SURFACE_SPEC_LAYER_ROLES_B, material.layer_roles[1]},
            {SURFACE_SPEC_LAYER_ROLES_C, material.layer_roles[2]},
            {SURFACE_SPEC_BESIDES, material.besides | shares},
            {SURFACE_SPEC_GROUND_VARIES, weather.ground_varies},
            {SURFACE_SPEC_STRETCH, stretch},
            {SURFACE_SPEC_PLACE, weather.place},
            {SURFACE_SPEC_VERTEX_LIGHT, by_vertex},
            {FRAME_SPEC_LANES, lanes},
            {RESOLVE_SPEC_INVOCATIONS, lanes != 0 ? lanes : RESOLVE_GROUP},
            {RESOLVE_SPEC_WEATHER, kept},
            {RESOLVE_SPEC_EMISSION, glows(material)},
            {RESOLVE_SPEC_PAYLOAD, (material.besides & BESIDES_AS_CLEARED) == 0},
            {RESOLVE_SPEC_BAKED, parts.baked},
            {RESOLVE_SPEC_SHAPES, material.on_shapes},
            {RESOLVE_SPEC_IN_WORLD, material.in_world}};
    };
    clear_targets(graph, targets, parts);
    const char* shader = scene.own_surfaces().any() ? kOwnResolveShader : kResolveShader;
    DispatchListPass pass{.name = "surface",
                          .bindings = std::move(bindings),
                          .arguments = tables.groups.get(),
                          .pipelines = {},
                          .record = {}};
    // Which of the lists may have pixels.
    const auto listed = [&scene, kind](std::uint32_t material, bool shedding) {
        return shedding ? (scene.steep().some[material] & kind) != 0 : kind == 0 || (scene.steep().all[material] & kind) == 0;
    };
    for (std::uint32_t m = 0; m < materials; ++m) {
        const GpuMaterial& material = scene.materials()[m];
        for (const bool shedding : {false, true}) {
            if (!listed(m, shedding)) continue;
            pass.pipelines.push_back({shader, variant(material, shedding),
                                      {types_of(pass.bindings), types_of(material.bindings)}});
        }
    }
    const auto width = static_cast<std::uint32_t>(targets.width);
    pass.record = [=, &scene](DispatchContext& list) {
        for (std::uint32_t m = 0; m < materials; ++m) {
            const GpuMaterial& material = scene.materials()[m];
            for (const bool shedding : {false, true}) {
                if (!listed(m, shedding)) continue;
                const std::uint32_t number = 2 * m + (shedding ? 1 : 0);
                list.bind(shader, variant(material, shedding), types_of(material.bindings));
                list.bind_set1(material.bindings);
                list.push(shared::SurfaceResolveParams{m, number, width});
                list.dispatch_indirect(number);
            }
        }
    };
    graph.add(std::move(pass));
}

}  // namespace petrichor::gpu
