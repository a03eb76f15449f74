#include "gpu/passes/falling/falling_view.h"

#include <algorithm>
#include <cmath>

#include "formulas/weather/falling.h"

namespace petrichor::gpu {
namespace {

// A camera without an aperture shows all of the scene sharp, but the drop before its front glass is a
// blur to anyone who has been out: 35 mm at f/13, focused on the street.
constexpr float kUsualLens_m = 0.0013f;
constexpr float kUsualFocus_m = 6.0f;

}  // namespace

float FallingView::blur_px(float distance_m) const
{
    return focal_px * lens.radius_m * std::abs(1.0f / lens.focus_m - 1.0f / distance_m);
}

glm::vec2 FallingView::on_screen(const glm::vec3& from_eye) const
{
    const glm::vec2 half_px = glm::vec2(size) * 0.5f;
    const float scale = focal_px / std::max(glm::dot(from_eye, forward), 0.1f);
    return {half_px.x * (1.0f - shift.x) + glm::dot(from_eye, right) * scale,
            half_px.y * (1.0f + shift.y) - glm::dot(from_eye, up) * scale};
}

FallingView falling_view(const shared::FrameConstants& c, const Lens& lens, const glm::vec2& shift)
{
    FallingView view;
    view.eye_m = c.camera_m;
    view.forward = c.forward;
    view.right = glm::normalize(c.ray_dx);
    view.up = -glm::normalize(c.ray_dy);
    view.focal_px = 1.0f / std::max(glm::length(c.ray_dx), 1e-9f);
    view.size = c.size;
    view.shift = shift;
    view.lens = lens.radius_m > 0.0f ? lens : Lens{.radius_m = kUsualLens_m, .focus_m = kUsualFocus_m};
    return view;
}

bool see_drop(const FallingView& view, const glm::vec3& from_eye, const glm::vec3& half_way_m, float seen_px,
              float reach_m, shared::FallingDrop& drop)
{
    const float z = glm::dot(from_eye, view.forward);
    if (z <= kNear_m || z >= reach_m) return false;
    drop.from_px = view.on_screen(from_eye - half_way_m);
    drop.to_px = view.on_screen(from_eye + half_way_m);
    drop.view_m = z;
    drop.half_px = shared::spot_radius_px(seen_px, view.blur_px(z));
    const glm::vec2 middle = view.on_screen(from_eye);
    const glm::vec2 low = glm::max(glm::min(drop.from_px, drop.to_px), middle - kLongest_px) - drop.half_px;
    const glm::vec2 high = glm::min(glm::max(drop.from_px, drop.to_px), middle + kLongest_px) + drop.half_px;
    const glm::vec2 size(view.size);
    if (high.x < 0.0f || high.y < 0.0f || low.x > size.x || low.y > size.y) return false;
    const float there = glm::smoothstep(kNear_m, kWhole_m, z) *
                        (1.0f - glm::smoothstep(kFadeFrom * reach_m, reach_m, z));
    drop.opacity = shared::spot_opacity(seen_px, drop.half_px) * there;
    drop.position_m = view.eye_m + from_eye;
    return drop.opacity > 0.0f;
}

}  // namespace petrichor::gpu
