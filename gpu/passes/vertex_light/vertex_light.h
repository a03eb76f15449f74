#ifndef PETRICHOR_GPU_PASSES_VERTEX_LIGHT_VERTEX_LIGHT_H
#define PETRICHOR_GPU_PASSES_VERTEX_LIGHT_VERTEX_LIGHT_H

#include <functional>
#include <memory>
#include <span>

#include "gpu/device/graph.h"
#include "gpu/passes/lighting/light_tables.h"
#include "gpu/passes/lights/lights.h"
#include "gpu/upload/gpu_scene.h"

namespace petrichor::gpu {

/// The light of lamps that are marked so, at the vertices that they reach: 8 bytes a vertex of an instance.
class VertexLight {
public:
    explicit VertexLight(const Device& device);

    /// Lists the draws that lamps of the table reach. The device must not be drawing.
    /// Throws Error where there are more lamps than VERTEX_LIGHT_MOST, or more vertices than the device can bind.
    ///
    ///   in_view  whether anything in a ball may be seen; empty: everything may be
    void prepare(std::span<const Draw> draws, const LightTable& lights,
                 const std::function<bool(const glm::vec3& centre_m, float radius_m)>& in_view);

    // Lights them, once for all that look from this moment.
    //
    //   reads    the vertices, the light table, profiles of lamps
    //   writes   light()
    void add(FrameGraph& graph, const GpuScene& scene, LightTable& lights, LightTables& light_tables) const;

    GpuBuffer& light() const { return *light_; }    ///< by vertex; vertex_light.glsl reads it
    GpuBuffer& firsts() const { return *firsts_; }  ///< by draw

private:
    const Device* device_;
    std::unique_ptr<MemoryArena> arena_, light_arena_;
    std::unique_ptr<GpuBuffer> firsts_, jobs_, draws_, light_;
    std::uint32_t groups_ = 0;
};

}  // namespace petrichor::gpu

#endif
