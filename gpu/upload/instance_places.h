#ifndef PETRICHOR_GPU_UPLOAD_INSTANCE_PLACES_H
#define PETRICHOR_GPU_UPLOAD_INSTANCE_PLACES_H

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "gpu/upload/gpu_scene.h"

namespace petrichor::gpu {

/// They have one shape and one material: a depth map may draw both at once.
bool same_shape(const Draw& a, const Draw& b);

/// Where the instances stand that one draw call has, as one map sees them: what is read there are the
/// matrices that each of them alone would be pushed, so that the map is the same to the bit.
class InstancePlaces {
public:
    explicit InstancePlaces(const Device& device) : device_(&device) {}

    /// Of a scene that goes away.
    void forget() { scene_ = nullptr; }
    /// Forgets what was written before: no device may be drawing it.
    void reset(const GpuScene& scene);
    /// Number of the first; none: there is no room for them.
    std::optional<std::uint32_t> add(std::span<const glm::mat4> clip_from_objects);
    /// RGBA32F, four texels a place: columns. Null: the scene has no such instances.
    GpuBuffer* texels() const { return places_.get(); }

private:
    const Device* device_;
    std::unique_ptr<MemoryArena> arena_;
    std::unique_ptr<GpuBuffer> places_;
    std::size_t capacity_ = 0;
    std::size_t used_ = 0;
    const GpuScene* scene_ = nullptr;  // that the buffer is made for
};

}  // namespace petrichor::gpu

#endif
