#include "gpu/passes/shapes/shapes.h"

#include "formulas/geometry/shapes.h"
#include "gpu/passes/shapes/shapes_io.h"
#include "gpu/upload/draw.h"
#include "scene/shapes.h"

namespace petrichor::gpu {

namespace {

glm::vec3 row_of(const glm::mat4& m, int row)
{
    return {m[0][row], m[1][row], m[2][row]};
}

// Its x runs the other way across the picture: triangles turn the other way.
bool is_mirrored(const ShapeView& view)
{
    const glm::mat4& m = view.clip_from_world;
    const glm::vec3 forward = view.eye.w != 0.0f ? row_of(m, 3) : -glm::vec3(view.eye);
    return glm::dot(glm::cross(row_of(m, 0), row_of(m, 1)), forward) > 0.0f;
}

shared::ShapeDraw shape_draw(const GpuScene& scene, const Draw& draw, const ShapeView& view)
{
    const MarchedShape& shape = scene.shapes()[static_cast<std::size_t>(draw.shape)];
    const glm::mat3 linear(draw.to_world);
    const float scale = glm::length(linear[0]);
    const glm::mat3 to_object = glm::transpose(linear) / (scale * scale);
    shared::ShapeDraw c{};
    c.clip_from_object = view.clip_from_world * draw.to_world;
    if (view.eye.w != 0.0f) {
        c.eye = glm::vec4(to_object * (glm::vec3(view.eye) - glm::vec3(draw.to_world[3])), 1.0f);
        c.footprint = {0.0f, view.pixel};
    } else {
        c.eye = glm::vec4(glm::normalize(to_object * glm::vec3(view.eye)), 0.0f);
        c.footprint = {view.pixel / scale, 0.0f};
    }
    c.half_size = half_of(shape, shape.rest);
    c.power = shape.rest.power;
    c.iterations = shape.iterations;
    c.draw = static_cast<std::uint32_t>(&draw - scene.draws().data());
    return c;
}

void draw_shapes(PassContext& pass, const GpuScene& scene, const ShapeView& view,
                 const std::vector<const Draw*>& shapes, const char* fragment)
{
    GraphicsDesc desc;
    desc.vertex = "shape_box.vert";
    desc.fragment = fragment;
    desc.colors = pass.color_formats();
    set_facing(pass.commands(), VK_CULL_MODE_FRONT_BIT, is_mirrored(view));
    for (const Draw* draw : shapes) {
        const MarchedShape& shape = scene.shapes()[static_cast<std::size_t>(draw->shape)];
        desc.specialization = {{SHAPE_SPEC_KIND, static_cast<std::uint32_t>(shape.kind)},
                               {SHAPE_SPEC_FLATTEN, view.flatten}};
        pass.bind(pass.pipelines().graphics(desc));
        pass.push(shape_draw(scene, *draw, view));
        vkCmdDraw(pass.commands(), 36, 1, 0, 0);
    }
}

}  // namespace

ShapeView picture_view(const shared::FrameConstants& c)
{
    const bool orthographic = (c.flags & FRAME_ORTHOGRAPHIC) != 0u;
    ShapeView view{c.world_to_clip, glm::vec4(c.camera_m, 1.0f), c.pixel_angle, false};
    if (orthographic) {
        view.eye = glm::vec4(-c.forward, 0.0f);
        view.pixel = glm::length(c.ray_dx);
    }
    return view;
}

ShapeView map_view(const glm::mat4& clip_from_world, const glm::vec4& eye, int size, bool flatten)
{
    const float pixel = 2.0f / (static_cast<float>(size) * glm::length(row_of(clip_from_world, 0)));
    return {clip_from_world, eye, pixel, flatten};
}

std::vector<const Draw*> shapes_in(const GpuScene& scene, const glm::mat4& clip_from_world, const AskedPart& asked)
{
    std::vector<const Draw*> found;
    if (scene.shapes().empty()) return found;
    const Frustum frustum(clip_from_world);
    for (const Draw& draw : scene.draws()) {
        if (draw.shape >= 0 && frustum.touches(draw.centre_m, draw.radius_m) &&
            asked_of(asked, clip_from_world, draw.centre_m, draw.radius_m))
            found.push_back(&draw);
    }
    return found;
}

void draw_shape_depths(PassContext& pass, const GpuScene& scene, const ShapeView& view,
                       const std::vector<const Draw*>& shapes)
{
    draw_shapes(pass, scene, view, shapes, "shape_depth.frag");
}

void add_shapes(FrameGraph& graph, GpuImage& ids, GpuImage& depth, const GpuScene& scene,
                const shared::FrameConstants& c)
{
    const ShapeView view = picture_view(c);
    std::vector<const Draw*> shapes = shapes_in(scene, view.clip_from_world);
    if (shapes.empty()) return;
    Attachment over_ids(ids);
    Attachment over_depth(depth);
    over_ids.keep = over_depth.keep = true;
    graph.add(DrawPass{.name = "shapes",
                       .colors = {over_ids},
                       .depth = over_depth,
                       .width = ids.width,
                       .height = ids.height,
                       .bindings = {},
                       .record = [view, shapes = std::move(shapes), &scene](PassContext& pass) {
                           draw_shapes(pass, scene, view, shapes, "shape_visible.frag");
                       }});
}

}  // namespace petrichor::gpu
