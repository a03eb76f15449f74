#ifndef PETRICHOR_GPU_PASSES_OWN_MOVES_OWN_MOVES_H
#define PETRICHOR_GPU_PASSES_OWN_MOVES_OWN_MOVES_H

#include <memory>

#include "gpu/device/graph.h"
#include "gpu/frame/frame_io.h"
#include "gpu/upload/gpu_scene.h"

namespace petrichor::gpu {

/// The pass that asks users' own surfaces where vertices go; compiled when one of them moves some.
inline constexpr const char* kOwnMoveShader = "own_move.comp";

/// The vertices of a scene that surfaces of users' own move: NAME_move is asked on the device, once for each
/// moment, and what it says is read back, so that every pass, depth map and list of triangles sees one shape.
class OwnMoves {
public:
    /// scene: at rest.
    OwnMoves(const Device& device, const GpuScene& scene);

    /// Moves them to a moment; true when anything may have moved. Of `now` the time, the weather and the look
    /// are told to the surfaces. posed: the scene stands otherwise than it did, or its materials are others.
    bool move(const Device& device, PipelineCache& pipelines, DescriptorArena& descriptors, GpuScene& scene,
              const shared::FrameConstants& now, bool posed);

private:
    MemoryArena arena_;
    std::unique_ptr<GpuBuffer> constants_, vertices_, points_, moved_, arguments_;
    std::unique_ptr<GpuBuffer> no_words_, no_numbers_;  // stand in for maps of the weather
    std::unique_ptr<GpuImage> no_map_;
    SamplerHandle nearest_;
    shared::FrameConstants told_{};
    bool valid_ = false;
};

}  // namespace petrichor::gpu

#endif
