#include <algorithm>
#include <cmath>

#include "gpu/upload/gpu_scene.h"

namespace petrichor::gpu {

namespace {

// Between two levels both are drawn, each at its share of the pixels: this much below and above the
// size where they change.
constexpr float kBand = 0.12f;

// Of the finer level.
float share_at(float coverage, float change)
{
    return std::clamp((coverage / change - (1.0f - kBand)) / (2.0f * kBand), 0.0f, 1.0f);
}

std::uint32_t code_of(float share)
{
    return static_cast<std::uint32_t>(std::lround(share * 65535.0f));
}

// Height of a sphere in the picture, as a share of the picture's.
float coverage_of(const DetailLevel& detail, const Camera& camera)
{
    if (camera.orthographic_height_m > 0.0f)
        return 2.0f * detail.radius_m / camera.orthographic_height_m;
    const float away_m = glm::length(detail.centre_m - glm::vec3(camera.to_world[3]));
    return detail.radius_m / std::max(away_m * std::tan(0.5f * camera.vertical_fov_rad), 1.0e-6f);
}

}  // namespace

bool GpuScene::choose_levels(const Camera& camera, float scale)
{
    if (!levels_) return false;
    bool changed = false;
    const auto choose = [&](Draw& draw) {
        const DetailLevel& detail = draw.detail;
        if (detail.radius_m <= 0.0f) return;
        const float coverage = coverage_of(detail, camera) * scale;
        // Coarser ones take the pixels that finer ones leave.
        const std::uint32_t from = detail.level > 0 ? code_of(share_at(coverage, detail.high)) : 0;
        const std::uint32_t to = detail.low > 0.0f ? code_of(share_at(coverage, detail.low)) : 65535;
        draw.shown = to > from;
        draw.fade = from == 0 && to == 65535 ? 0 : from | to << 16;
        const bool casts = (detail.level == 0 || coverage < detail.high) && coverage >= detail.low;
        changed = changed || casts != draw.casts;
        draw.casts = casts;
    };
    for (Draw& draw : draws_) choose(draw);
    return changed;
}

}  // namespace petrichor::gpu
