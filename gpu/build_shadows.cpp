// What of a frame's passes draws depth: the shadows of the sun and of lamps, the sky that places see, roofs over drops.
#include "gpu/build_shadows.h"

#include <algorithm>
#include <vector>

#include "gpu/upload/draw.h"

namespace petrichor::gpu {

namespace {

// Other points of a lens see past the view.
void ask_everywhere(std::array<DepthView, SHADOW_CASCADES>& views, const Frame& frame)
{
    if (frame.lens.radius_m <= 0.0f) return;
    for (DepthView& view : views) view.asked = {};
}

}  // namespace

bool soft_sun(const Frame& frame, const Sun& sun)
{
    const FrameSettings& s = frame.settings;
    return s.soft_shadows && s.shadows && s.samples > 1 && sun.illuminance != glm::vec3(0.0f);
}

void add_depth_maps(FrameGraph& graph, const Frame& frame, const Sun& sun, FrameResources& r,
                    bool weather, const FallingPlan& plan)
{
    DepthMaps& maps = *r.depth_maps;
    const Frame& whole = whole_of(frame, r);
    const float aspect =
        static_cast<float>(whole.settings.width) / static_cast<float>(whole.settings.height);
    if (frame.settings.shadows && !soft_sun(frame, sun)) {
        const bool coarse = frame.settings.coarse_shadows;
        auto views = coarse
                               ? coarse_views(whole.camera, aspect, sun.direction, r.scene->bounds())
                               : cascade_views(whole.camera, aspect, sun.direction, r.scene->bounds());
        ask_everywhere(views, frame);
        add_shadow(graph, maps, *r.scene, *r.triangles, views, coarse ? kCoarseCascade : 0);
    }
    // They shadow skylight, and keep rain and snow off.
    const bool skylight = frame.settings.image_based_light && frame.settings.ambient_occlusion &&
                          !uses_patches(frame, r);
    if (skylight || (frame.settings.shelter && weather)) {
        const auto views = sky_views(frame.camera, r.scene->bounds());
        if (!maps.sky_valid || views != maps.sky_views) {
            maps.sky_views = views;
            maps.sky_valid = true;
            add_sky_visibility(graph, maps, *r.scene, *r.triangles);
        }
    }
    // Roofs keep drops off that are drawn one by one; what lies goes by the maps of the sky.
    if (frame.settings.shelter && !plan.classes.empty()) {
        const DepthView view = rain_view(frame.camera, plan.shelter_fall_m_s, r.scene->bounds());
        if (!maps.shelter_valid || !(view == maps.shelter_view)) {
            maps.shelter_view = view;
            maps.shelter_valid = true;
            add_shelter(graph, maps, *r.scene, *r.triangles);
        }
    }
}

bool soft_shadows(const Frame& frame, const FrameResources& r)
{
    const std::vector<Light>& lamps = r.lights->shadowed;
    return frame.settings.soft_shadows && frame.settings.samples > 1 &&
           std::any_of(lamps.begin(), lamps.end(), [](const Light& lamp) {
               return lamp.radius_m > 0.0f || lamp.length_m > 0.0f || lamp.kind == LightKind::Rectangle;
           });
}

void look_from_sun(FrameGraph& graph, const Frame& frame, const Sun& sun, std::uint32_t sample,
                   FrameResources& r)
{
    const Frame& whole = whole_of(frame, r);
    const FrameSettings& s = whole.settings;
    const float aspect = static_cast<float>(s.width) / static_cast<float>(s.height);
    DepthMaps& maps = *r.depth_maps;
    auto views = cascade_views(whole.camera, aspect, toward_sun_disc(sun.direction, sample, s.samples, s.seed),
                                     r.scene->bounds());
    ask_everywhere(views, frame);
    add_shadow(graph, maps, *r.scene, *r.triangles, views);
}

void look_from_lamps(FrameGraph& graph, const Frame& frame, shared::FrameConstants& c,
                     std::uint32_t sample, FrameResources& r)
{
    std::vector<Light> lamps = r.lights->shadowed;
    for (std::size_t k = 0; k < lamps.size(); ++k) {
        // Lamps do not look from the same point of their surfaces.
        const glm::vec3 offset = lamp_offset_m(lamps[k], sample, frame.settings.samples,
                                               frame.settings.seed + 17u * static_cast<std::uint32_t>(k));
        lamps[k].position_m += offset;
        c.arrays.lamp_offset_m[k] = glm::vec4(offset, 0.0f);
    }
    r.lamp_shadows->add(graph, *r.scene, *r.triangles, lamps);
}

}  // namespace petrichor::gpu
