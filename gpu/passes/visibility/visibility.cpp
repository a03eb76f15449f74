#include "gpu/passes/visibility/visibility.h"

#include <glm/gtc/matrix_access.hpp>

#include "gpu/passes/surface/surface_io.h"
#include "gpu/passes/visibility/visibility_io.h"
#include "gpu/upload/draw.h"

namespace petrichor::gpu {

namespace {

shared::VisibilityDraw draw_constants(const GpuScene& scene, const Draw& draw)
{
    shared::VisibilityDraw c{};
    for (int row = 0; row < 3; ++row) c.to_world[row] = glm::row(draw.to_world, row);
    c.draw = static_cast<std::uint32_t>(&draw - scene.draws().data());
    c.instance_id = draw.instance_id;
    c.fade = draw.fade;
    return c;
}

}  // namespace

void add_visibility(FrameGraph& graph, GpuImage& ids, GpuImage& depth, const GpuScene& scene,
                    const ConstantsRange& constants, const glm::mat4& world_to_clip,
                    const glm::vec3& camera_m, const VisibleWeather& weather,
                    GpuBuffer& draw_table, std::shared_ptr<const SeenDraws> seen, Draws draws)
{
    graph.add(DrawPass{
        .name = "visibility",
        .colors = {Attachment(ids)},
        .depth = Attachment(depth),
        .width = ids.width,
        .height = ids.height,
        .bindings = {{VISIBILITY_FRAME, frame_binding(constants)},
                     {VISIBILITY_DRAWS, texels(draw_table)},
                     {VISIBILITY_NUMBERS, texels(seen ? *seen->numbers : draw_table)}},
        .record =
            [=, &scene](PassContext& pass) {
                GraphicsDesc opaque;
                opaque.vertex = "visibility.vert";
                opaque.fragment = "visibility.frag";
                opaque.stride = sizeof(glm::vec3);
                opaque.attributes = {position_attribute()};
                opaque.colors = pass.color_formats();
                opaque.sets = {pass.set_types()};
                GraphicsDesc masked = opaque;
                masked.vertex = "visibility_masked.vert";
                masked.fragment = "visibility_masked.frag";
                masked.stride = sizeof(Vertex);
                masked.attributes = {vertex_attributes()[0], vertex_attributes()[3],
                                     vertex_attributes()[4], vertex_attributes()[5]};
                bind_geometry(pass.commands(), scene);
                SeenBinder binder(pass.commands(), scene, seen.get());
                VertexBinder vertices(pass.commands(), scene);
                for (const DrawRun& run : visible_runs(scene, world_to_clip, camera_m, draws)) {
                    const Draw* draw = run.first;
                    const SeenRange range = run.count > 1 ? SeenRange{} : binder.range_of(*draw);
                    if (range.index_count == 0) continue;
                    const Specialization instanced{VISIBILITY_SPEC_INSTANCED, run.count > 1};
                    const Specialization listed{VISIBILITY_SPEC_LISTED, !range.whole()};
                    const GpuMaterial& material = scene.materials()[draw->material];
                    const bool holes = has_holes(scene, *draw);
                    vertices.bind(!holes);
                    if (holes) {
                        GraphicsDesc desc = masked;
                        desc.specialization = {{SURFACE_SPEC_SLOTS, material.slots},
                                               {SURFACE_SPEC_PARALLAX, material.parallax},
                                               {SURFACE_SPEC_SECOND, material.second},
                                               {SURFACE_SPEC_WATER, weather.water ? material.water : 0u},
                                               {SURFACE_SPEC_SNOW, weather.snow ? material.snow : 0u},
                                               {SURFACE_SPEC_FADE, draw->fade != 0},
                                               {SURFACE_SPEC_STRETCH, scene.texture_stretch()},
                                               instanced,
                                               listed};
                        desc.sets.push_back(types_of(material.bindings));
                        pass.bind(pass.pipelines().graphics(desc));
                        pass.bind_set(
                            1, pass.descriptors().set(pass.pipelines().set_layout(desc.sets[1]),
                                                      material.bindings));
                    } else {
                        opaque.specialization = {instanced, listed};
                        pass.bind(pass.pipelines().graphics(opaque));
                    }
                    set_facing(pass.commands(), material.cull, draw->mirrored);
                    shared::VisibilityDraw push = draw_constants(scene, *draw);
                    push.first_number = range.first_index / 3;
                    pass.push(push);
                    if (run.count > 1) {
                        binder.draw_run(*draw, run.count, push.draw);
                    } else {
                        binder.draw(*draw, range);
                    }
                }
            },
    });
}

}  // namespace petrichor::gpu
