#ifndef PETRICHOR_GPU_SNOW_SNOW_BODY_H
#define PETRICHOR_GPU_SNOW_SNOW_BODY_H

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "gpu/frame/frame.h"
#include "gpu/snow/frame_tracks.h"
#include "gpu/snow/patch_depths.h"
#include "gpu/upload/gpu_scene.h"
#include "scene/snow/snow_caps.h"

namespace petrichor::gpu {

/// Snow that lies on a scene, as geometry of a frame: how deep it is where, and its vertices.
///
/// A vertex of snow is one of the surface below, lifted: its place, normal and tangent are the snow's. The
/// length of its tangent is 1 and the metres that it is lifted, so that a pixel finds the weather of its
/// ground; alpha of its weather is what is not snow of its own (gpu/passes/surface/snow_body.glsl).
class SnowBody {
public:
    explicit SnowBody(std::shared_ptr<const scene::SnowCaps> caps);

    /// What the scene is made with: the caps without snow.
    const Overlay& overlay() const { return overlay_; }

    /// Shapes the snow of a frame, by its depth alone; true when it is another than before.
    /// `tracks` press it down where the caps have not been pressed already.
    bool lay(const Frame& frame, const FrameTracks& tracks = {});
    /// Empty: too thin to have a body. Triangles are fewer where it is deep (scene::SnowLevels), and none where it is not. Of the scene
    /// is covered what lies below it: the same triangles of the caps are seen from above, and throw its shadows.
    LaidOverlay laid() const;
    /// The snow around an eye lies below it: it stands in none, and under none.
    bool lies_below(const glm::vec3& eye_m) const;
    /// The farthest that a vertex stands over its ground; 0 without any.
    float lift_m() const { return lies_ ? lift_m_ : 0.0f; }

private:
    struct Key {
        float depth_m = 0.0f, start_m = 0.0f, blend_m = 0.0f, ragged = 0.0f;
        bool wanted = false;
        std::shared_ptr<const PlaceWeather> place;
        std::uint64_t tracks = 0;
        bool operator==(const Key&) const = default;
    };
    std::vector<float> depths(const Frame& frame, const FrameTracks& tracks);
    std::vector<glm::vec3> base_faces() const;

    std::shared_ptr<const scene::SnowCaps> caps_;
    Overlay overlay_;
    std::vector<glm::vec3> along_;  // of each vertex: its tangent, unit, as it was before any snow
    std::optional<Key> laid_;
    bool lies_ = false;
    float lift_m_ = 0.0f;
    float lowest_m_ = 1.0e30f;  // of the points on the scene
    std::vector<Covered> covered_;
    std::vector<std::uint32_t> covering_;  // which part of the caps says so of each
    void find_covered(const scene::SnowShape& shape);
    std::vector<std::uint8_t> hidden_points(const scene::SnowShape& shape) const;
    std::vector<std::uint32_t> corners_;  // points of the caps' triangles, all of them
    std::vector<std::vector<std::uint32_t>> piece_points_;  // of each piece of the levels
    struct CornerRange {
        std::uint32_t first = 0, end = 0;
    };
    std::vector<std::array<CornerRange, 1 + scene::SnowLevels::kCoarser>> level_corners_;  // of each piece
    std::vector<std::uint32_t> corner_lists_;  // of those ranges: each corner once
    std::vector<std::uint32_t> level_points_;  // points of the indices of the levels
    void list_corners();
    std::vector<glm::vec3> base_m_;            // of each point, beside each other, as loops read them ..
    std::vector<std::array<std::uint32_t, 2>> besides_;  // .. and its `beyond` and `below`
    // By the levels of the pieces:
    std::vector<std::uint8_t> levels_;
    scene::DrawnSnow drawn_;                    // points, and those of the triangles
    std::vector<std::uint32_t> drawn_corners_;  // vertices that are drawn, each once
    std::vector<std::uint32_t> counts_;         // of each part, in the frame
    std::vector<std::uint8_t> hidden_;          // of each triangle of those, from where
    void choose_levels(const std::vector<float>& depth_m);
    void fill_indices(const scene::SnowShape& shape);
    std::vector<std::uint8_t> inner_;     // of each point: 0 on a border
    std::vector<glm::vec3> top_m_;        // of each point, as it lies
    PatchDepths patches_;                 // at each point
};

}  // namespace petrichor::gpu

#endif
