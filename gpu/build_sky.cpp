// What a frame needs of its sky before its passes: maps of it, drawn when they would come out otherwise, and its light.
#include <cmath>
#include <cstring>

#include "gpu/build_frame.h"
#include "gpu/passes/sky/seen_sky.h"

namespace petrichor::gpu {
namespace {

bool same_sky(const shared::SkyParams& a, const shared::SkyParams& b)
{
    return std::memcmp(&a, &b, sizeof(a)) == 0;
}

// The cameras that may see other parts of the sky than the first.
std::vector<shared::FrameConstants> sky_views_of(const Frame& frame, const Sun& sun, const FrameResources& r)
{
    const bool many = !frame.shutter.empty() || frame.lens.radius_m > 0.0f;
    std::vector<shared::FrameConstants> views;
    for (int i = 0; i < (many ? frame.settings.samples : 1); ++i)
        views.push_back(frame_constants(frame, sun, r.scene->bounds(), static_cast<std::uint32_t>(i)));
    return views;
}

// Draws the sky's maps when they would come out otherwise.
void add_sky_maps(FrameGraph& graph, const Frame& frame, const Sun& sun, FrameResources& r)
{
    SkyMaps& sky = *r.sky;
    if (!sky.env_brdf_valid) {
        add_env_brdf(graph, sky);
        sky.env_brdf_valid = true;
    }
    if (r.environment) {
        const float scale = frame.sky.environment_scale;
        const float rotation = frame.sky.environment_rotation_rad;
        if (!sky.drawn_valid || scale != sky.environment_scale ||
            rotation != sky.environment_rotation_rad) {
            add_environment(graph, sky, *r.environment, scale, rotation);
            sky.environment_scale = scale;
            sky.environment_rotation_rad = rotation;
            sky.drawn_valid = true;
        }
    } else {
        shared::SkyParams params = sky_params(frame, sky);
        // Without clouds, time, wind and rain change nothing.
        if (params.cloud_cover <= 0.0f) {
            params.rain = 0.0f;
            params.time_s = 0.0f;
            params.wind_m_s = glm::vec2(0.0f);
        }
        if (!sky.drawn_valid || !same_sky(params, sky.drawn)) {
            add_analytic_sky(graph, sky, params);
            sky.drawn = params;
            sky.drawn_valid = true;
        }
        if (frame.settings.draw_sky)
            add_seen_sky(graph, sky, params, seen_sky(sky_views_of(frame, sun, r), fog_per_m(frame) > 0.0f));
    }
}

void add_light_of_sky(FrameGraph& graph, const Frame& frame, const Sun& sun, FrameResources& r)
{
    Metering metering;
    metering.sun_illuminance = sun.illuminance;
    metering.sun_up = sun.direction.y;
    metering.exposure = frame.settings.exposure;
    metering.bias = std::exp2(frame.settings.exposure_bias_stops);
    metering.ambient_scale = frame.settings.image_based_light ? 1.0f : 0.0f;
    add_sky_light(graph, *r.sky, metering);
}

}  // namespace

FrameGraph build_sky(const Frame& frame, const Sun& sun, FrameResources& r)
{
    FrameGraph graph;
    add_sky_maps(graph, frame, sun, r);
    add_light_of_sky(graph, frame, sun, r);
    if (uses_patches(frame, r)) add_sky_bins(graph, *r.sky, *r.patches);
    return graph;
}

}  // namespace petrichor::gpu
