#ifndef PETRICHOR_GPU_PASSES_SHAPES_SHAPES_H
#define PETRICHOR_GPU_PASSES_SHAPES_SHAPES_H

#include <vector>

#include "gpu/device/graph.h"
#include "gpu/frame/frame_io.h"
#include "gpu/upload/asked_part.h"
#include "gpu/upload/gpu_scene.h"

namespace petrichor::gpu {

/// How a picture or a map looks at shapes.
struct ShapeView {
    glm::mat4 clip_from_world{1.0f};
    glm::vec4 eye{0.0f};   ///< in the world: a point, or with w 0 the unit direction towards it
    float pixel = 0.0f;    ///< metres across a pixel; of a point: at a distance of 1 m
    bool flatten = false;  ///< what lies before the near plane is laid onto it
};

/// The view of a picture.
ShapeView picture_view(const shared::FrameConstants& c);

/// What a map of `size` texels a side looks at; `eye` as above.
ShapeView map_view(const glm::mat4& clip_from_world, const glm::vec4& eye, int size, bool flatten);

/// Shapes in the view, where a map is asked.
std::vector<const Draw*> shapes_in(const GpuScene& scene, const glm::mat4& clip_from_world, const AskedPart& asked = {});

/// Draws their depth into a map.
void draw_shape_depths(PassContext& pass, const GpuScene& scene, const ShapeView& view,
                       const std::vector<const Draw*>& shapes);

// Marches to the shapes that a picture sees, over what the visibility buffer holds.
//
//   edits    ids (normal and openness, shape_code, stand where others have their triangle), depth
void add_shapes(FrameGraph& graph, GpuImage& ids, GpuImage& depth, const GpuScene& scene,
                const shared::FrameConstants& c);

}  // namespace petrichor::gpu

#endif
