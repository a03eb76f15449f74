#ifndef PETRICHOR_GPU_PASSES_FALLING_FALLING_VIEW_H
#define PETRICHOR_GPU_PASSES_FALLING_FALLING_VIEW_H

#include "gpu/frame/frame.h"
#include "gpu/frame/frame_io.h"
#include "gpu/passes/falling/falling_io.h"

namespace petrichor::gpu {

inline constexpr float kNear_m = 0.3f;        ///< nearer drops are a blur on the lens
inline constexpr float kWhole_m = 0.7f;       ///< they come in until here
inline constexpr float kFadeFrom = 0.75f;     ///< and go from this share of the reach on
inline constexpr float kLongest_px = 200.0f;  ///< of a streak that begins outside of the picture

/// How the camera sees what falls.
struct FallingView {
    glm::vec3 eye_m{0.0f};
    glm::vec3 right{1.0f, 0.0f, 0.0f}, up{0.0f, 1.0f, 0.0f}, forward{0.0f, 0.0f, -1.0f};
    float focal_px = 1000.0f;
    glm::ivec2 size{1280, 720};
    glm::vec2 shift{0.0f};  ///< of the lens, as scene::Camera's
    Lens lens;

    /// Radius of the disc that a point at a distance becomes.
    float blur_px(float distance_m) const;
    /// Pixel of a point beside the eye.
    glm::vec2 on_screen(const glm::vec3& from_eye) const;
};
/// lens: without an aperture, near drops are as blurred as in a usual camera.
FallingView falling_view(const shared::FrameConstants& constants, const Lens& lens,
                         const glm::vec2& shift = glm::vec2(0.0f));

/// Fills in where a drop is seen and how much it hides: its way while the shutter is open goes half_way_m to both
/// sides of a place beside the eye; seen_px wide; none beyond reach_m. False: the view does not see it.
bool see_drop(const FallingView& view, const glm::vec3& from_eye, const glm::vec3& half_way_m, float seen_px,
              float reach_m, shared::FallingDrop& drop);

}  // namespace petrichor::gpu

#endif
