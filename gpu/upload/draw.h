#ifndef PETRICHOR_GPU_UPLOAD_DRAW_H
#define PETRICHOR_GPU_UPLOAD_DRAW_H

#include "gpu/upload/gpu_scene.h"

namespace petrichor::gpu {

/// The six half spaces of a clip matrix (reversed infinite depth: five count).
struct Frustum {
    glm::vec4 planes[5];

    explicit Frustum(const glm::mat4& world_to_clip);
    bool touches(const glm::vec3& centre_m, float radius_m) const;
};

/// Transforms of a draw; normals stay right under any scale.
shared::DrawConstants draw_constants(const Draw& draw);

/// Cut out by the alpha test, let through by chance, or a level of detail that comes or goes.
bool has_holes(const GpuScene& scene, const Draw& draw);

/// Which draws a pass wants.
enum class Draws { All, Solid, LetLightThrough };

/// Draws of one shape and material that stand one after the other in the scene's list: one draw call, whose
/// instances begin with the number of the first.
struct DrawRun {
    const Draw* first = nullptr;
    std::uint32_t count = 1;
};
/// Fewer are drawn one by one, near to far.
inline constexpr std::uint32_t kLeastRun = 8;

/// Draws inside the view: opaque ones first and near to far, so that early depth tests save shading; what goes round the
/// eye among the far ones. Alike ones that are seen side by side are one run, as near as the nearest of them.
std::vector<DrawRun> visible_runs(const GpuScene& scene, const glm::mat4& world_to_clip,
                                  const glm::vec3& camera_m, Draws which = Draws::All);

/// Sorts by state and by shape; those of one shape along a curve that keeps neighbours together, so that
/// views see long runs of them.
void sort_draws(std::vector<Draw>& draws, const std::vector<GpuMaterial>& materials);

void bind_geometry(VkCommandBuffer commands, const GpuScene& scene);

/// Binds the vertices that a draw reads, whole ones or their positions alone, where others are bound.
class VertexBinder {
public:
    VertexBinder(VkCommandBuffer commands, const GpuScene& scene) : commands_(commands), scene_(&scene) {}
    void bind(bool positions);

private:
    VkCommandBuffer commands_;
    const GpuScene* scene_;
    bool positions_ = false;  // bind_geometry() binds whole ones
};
void set_facing(VkCommandBuffer commands, VkCullModeFlags cull, bool mirrored);

}  // namespace petrichor::gpu

#endif
