#ifndef PETRICHOR_GPU_PASSES_LAMP_SHADOWS_LAMP_SHADOWS_H
#define PETRICHOR_GPU_PASSES_LAMP_SHADOWS_LAMP_SHADOWS_H

#include <array>
#include <memory>
#include <vector>

#include "gpu/passes/depth_maps/depth_maps.h"

namespace petrichor::gpu {

inline constexpr int kMostLampShadows = 16;

/// The depth around lamps, six layers each. Made for as many lamps as were asked for so far.
class LampShadows {
public:
    explicit LampShadows(const Device& device);

    /// Room for so many lamps, at least one (a shader's binding needs an image).
    void reserve(int lamps);
    void forget() { drawn_.clear(); }  ///< the scene has changed

    GpuImage& map() { return *map_; }

    // Draws the maps of these lamps, where they do not hold them already.
    //
    //   writes   map
    void add(FrameGraph& graph, const GpuScene& scene, SeenTriangles& triangles,
             const std::vector<Light>& lamps);

private:
    struct Drawn {
        glm::vec3 position_m{0.0f};
        glm::vec3 direction{0.0f};
        float cone_rad = 0.0f;
        float near_m = 0.0f;
        bool operator==(const Drawn&) const = default;
    };

    const Device* device_;
    std::unique_ptr<MemoryArena> arena_;
    std::unique_ptr<GpuImage> map_;
    std::vector<ImageViewHandle> layers_;
    std::vector<Drawn> drawn_;
};

/// Clip space of one face of the cube around a place: depth is reversed, near over distance.
glm::mat4 lamp_face_view(const glm::vec3& position_m, int face, float near_m);

}  // namespace petrichor::gpu

#endif
