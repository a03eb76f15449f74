// The lamps of a frame, and how bright its picture is shown.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "gpu/lighting/models_io.h"
#include "gpu/renderer_impl.h"
#include "gpu/upload/draw.h"
#include "scene/light_shape.h"

namespace petrichor::gpu {

namespace {

// How often a pixel of the frame may go over its lights, whatever of the scene is in view.
std::size_t light_walks(const FrameSettings& settings, const GpuScene& scene)
{
    const bool split = std::any_of(settings.aovs.begin(), settings.aovs.end(), [](const std::string& name) { return takes_light_apart(aov_row(name)); });
    bool gathers = false, left_alone = false;
    for (const GpuMaterial& material : scene.materials()) {
        gathers = gathers || (settings.light_prepass && scene.lighting_models().gathers(material.lighting_model));
        left_alone = left_alone || material.lighting_model == LIGHTING_MODEL_UNLIT_SHADOWED;
    }
    return 1u + (split ? 1u : 0u) + (gathers ? 2u : 0u) + (left_alone ? 2u : 0u);
}

}  // namespace

LightFacts Renderer::Impl::prepare_lights(const Frame& frame, const Frame& whole, const Sun& by_day, const Light* sun, float exposure)
{
    LightFacts facts{.direct = by_day.kind, .towards = by_day.direction, .lux = by_day.illuminance};
    std::vector<Light> lights;
    lights.reserve(scene->lights().size() + scene->glows().size() + frame.extra_lights.size());
    for (const Light& light : scene->lights()) {
        if (&light == sun || (light.kind == LightKind::Directional && frame.sky.analytic_sun)) {
            continue;
        }
        lights.push_back(light);
        if (light.kind != LightKind::Directional) {
            lights.back().intensity *= frame.scene_light_scale;
        }
        if (lights.back().intensity <= 0.0f) lights.pop_back();
    }
    for (const Light& glow : scene->glows()) {
        if (!frame.emissive_lights || frame.emissive_scale <= 0.0f) break;
        lights.push_back(glow);
        lights.back().intensity *= frame.emissive_scale;
        ++facts.glowing;
    }
    lights.insert(lights.end(), frame.extra_lights.begin(), frame.extra_lights.end());
    facts.lamps = lights.size();
    // Where vertices do not wait for them such lamps light pixels, and are mirrored as little.
    for (Light& light : lights) {
        if (!scene::lit_by_vertex(light) || scene->vertex_lamps()) continue;
        light.per_vertex = false;
        light.specular = 0.0f;
    }
    light_table = {};
    light_arena = std::make_unique<MemoryArena>(device);
    LightTableParams params{.shadows = frame.settings.shadows ? frame.settings.lamp_shadows : 0,
                            .eye_m = glm::vec3(frame.camera.to_world[3]),
                            .area = frame.settings.area_lights,
                            .least_lux = least_lux(frame.settings, exposure)};
    // Other eyes of a lens or a shutter see more.
    if (frame.lens.radius_m <= 0.0f && frame.shutter.empty()) {
        const shared::FrameConstants c = frame_constants(whole, by_day, scene->bounds(), 0);
        params.in_view = [frustum = Frustum(c.world_to_clip), eye_m = c.camera_m,
                          angle = c.pixel_angle](const glm::vec3& centre_m, float radius_m) {
            // Samples are moved by less than a pixel.
            const float pixel_m = angle * std::max(1.0f, glm::length(centre_m - eye_m));
            return frustum.touches(centre_m, radius_m + pixel_m);
        };
    }
    light_table = make_light_table(device, *light_arena, lights, params);
    vertex_light.prepare(scene->draws(), light_table, params.in_view);
    check_light_lists(device.limits(), light_table.count, frame.settings.width, frame.settings.height);
    const std::size_t walks = light_walks(frame.settings, *scene);
    if (light_table.count * walks > kLightsAnywhere) {
        std::vector<shared::FrameConstants> views;
        const bool one = params.in_view != nullptr;
        for (int i = 0; i < (one ? 1 : frame.settings.samples); ++i)
            views.push_back(frame_constants(frame, by_day, scene->bounds(), static_cast<std::uint32_t>(i)));
        check_light_crowd(light_table, frame.settings, views, walks);
    }
    return facts;
}

float Renderer::Impl::exposure_of(const Frame& frame) const
{
    const FrameSettings& s = frame.settings;
    if (s.exposure > 0.0f) return s.exposure * std::exp2(s.exposure_bias_stops);
    shared::SkyLight light{};
    std::memcpy(&light, sky.light->mapped, sizeof(light));
    return light.exposure;
}

}  // namespace petrichor::gpu
