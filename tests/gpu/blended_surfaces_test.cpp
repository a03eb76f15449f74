// Surfaces that are blended have every model, layer, light and weather that solid ones have: a layer that hides all is
// the solid surface.
#include <algorithm>
#include <cmath>

#include "gpu/lighting/lighting_models.h"
#include "tests/gpu/ball.h"
#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

struct Look {
    std::string name;
    Material material;
};

// Every lighting model, every layer that a material may have.
std::vector<Look> looks()
{
    const Material painted = plain_material({0.5f, 0.3f, 0.2f}, 0.45f);
    std::vector<Look> all;
    for (const std::string& model : built_in_lighting_models()) {
        Material m = painted;
        m.lighting_model = model;
        m.translucency = 0.5f;
        m.skin_curvature = 0.6f;
        m.scatter_color = {0.2f, 0.1f, 0.05f};
        all.push_back({model, m});
    }
    const auto with = [&](const char* of, const auto& change) {
        Material m = painted;
        change(m);
        all.push_back({of, m});
    };
    with("metal", [](Material& m) { m.metallic = 1.0f; });
    with("specular and gloss", [](Material& m) {
        m.specular_workflow = true;
        m.workflow_specular = {0.3f, 0.2f, 0.1f};
        m.glossiness = 0.6f;
    });
    with("clear coat", [](Material& m) { m.clearcoat = 1.0f; });
    with("sheen", [](Material& m) { m.sheen_color = glm::vec3(0.8f), m.sheen_roughness = 0.4f; });
    with("anisotropy", [](Material& m) { m.anisotropy = 0.8f, m.anisotropy_rotation_rad = 0.5f; });
    with("iridescence", [](Material& m) { m.iridescence = 1.0f; });
    with("thin sheet", [](Material& m) { m.diffuse_transmission = 0.6f; });
    with("glow", [](Material& m) { m.emissive = {100.0f, 2000.0f, 900.0f}; });
    return all;
}

// Sun, sky and three kinds of lamps.
Frame lit_by_all()
{
    Frame frame;
    frame.camera = look({0.0f, 0.0f, 4.0f}, {0.0f, 0.0f, 0.0f});
    frame.settings.samples = 1;
    frame.settings.surface_path = SurfacePath::Fragment;  // as layers are drawn
    frame.settings.shadows = false;
    frame.settings.ambient_occlusion = false;  // of what is solid
    frame.settings.draw_sky = false;
    frame.settings.exposure = 1e-4f;
    frame.sky.sun_elevation_rad = 0.7f;
    frame.sky.sun_azimuth_rad = 2.4f;
    Light point, disc, panel;
    point.kind = LightKind::Point;
    point.position_m = {-2.0f, 1.0f, 2.0f};
    point.color = {1.0f, 0.5f, 0.3f};
    point.intensity = 60000.0f;
    point.radius_m = 0.3f;
    disc.kind = LightKind::Spot;
    disc.position_m = {2.0f, 0.5f, 2.0f};
    disc.direction = glm::normalize(-disc.position_m);
    disc.color = {0.3f, 0.6f, 1.0f};
    disc.intensity = 90000.0f;
    panel.kind = LightKind::Rectangle;
    panel.shaped = true;
    panel.position_m = {0.0f, -1.2f, 2.0f};
    panel.direction = glm::normalize(-panel.position_m);
    panel.half_u_m = {0.5f, 0.0f, 0.0f};
    panel.half_v_m = glm::cross(panel.direction, glm::vec3(0.3f, 0.0f, 0.0f));
    panel.color = {0.4f, 1.0f, 0.5f};
    panel.intensity = 40000.0f;
    frame.extra_lights = {point, disc, panel};
    return frame;
}

struct Weather {
    const char* name;
    shared::WeatherMoment moment;
};

std::vector<Weather> weathers()
{
    Weather dry{"dry", {}}, wet{"wet", {}}, snow{"snow", {}};
    wet.moment.film_albedo = wet.moment.film_smoothness = 1.0f;
    wet.moment.film_mm = 0.4f;
    wet.moment.flood_cracks = 0.8f;
    snow.moment.snow_amount = 0.6f;
    snow.moment.snow_depth_m = 0.02f;
    snow.moment.frost = 0.5f;
    snow.moment.air_temperature_k = 268.0f;
    return {dry, wet, snow};
}

constexpr int kBall = 48;  // pixels a ball's square

using BlendedSurfaces = GpuTest;

TEST_F(BlendedSurfaces, HaveEveryModelLayerLightAndWeather)
{
    const std::vector<Look> all = looks();
    Frame frame = lit_by_all();
    frame.camera.orthographic_height_m = 2.0f;
    frame.settings.width = kBall * static_cast<int>(all.size());
    frame.settings.height = kBall;
    const auto scene = [&](float alpha) {
        std::vector<Primitive> balls;
        std::vector<Material> materials;
        for (std::size_t i = 0; i < all.size(); ++i) {
            // Side by side: a solid one keeps rain and snow off what is below it.
            const float x = 2.0f * static_cast<float>(i) - static_cast<float>(all.size() - 1);
            balls.push_back(ball(static_cast<std::uint32_t>(i), {x, 0.0f, 0.0f}, 0.9f));
            materials.push_back(all[i].material);
            materials.back().base_color.a = alpha;
            if (alpha < 1.0f) materials.back().alpha_mode = AlphaMode::Blend;
        }
        return scene_of(balls, materials);
    };
    constexpr float kAlpha = 0.98f;
    std::vector<std::uint16_t> before;
    for (const Weather& weather : weathers()) {
        frame.weather = weather.moment;
        renderer->load(scene(1.0f), {});
        const RenderResult solid = renderer->render(frame);
        renderer->load(scene(kAlpha), {});
        const RenderResult layer = renderer->render(frame);
        EXPECT_NE(layer.beauty, before) << weather.name;
        before = layer.beauty;
        for (std::size_t i = 0; i < all.size(); ++i) {
            const int left = kBall * static_cast<int>(i);
            double off = 0.0, light = 0.0;
            int worse = 0, there = 0;
            for (int y = 0; y < kBall; ++y) {
                for (int x = left; x < left + kBall; ++x) {
                    const glm::vec3 a = kAlpha * pixel(solid, x, y), b = pixel(layer, x, y);
                    const double d = static_cast<double>(glm::length(a - b)), l = static_cast<double>(glm::length(a));
                    off += d;
                    light += l;
                    if (!(l > 0.0)) continue;
                    ++there;
                    if (d > 0.02 * l) ++worse;
                }
            }
            const std::string of = all[i].name + ", " + weather.name;
            ASSERT_GT(there, kBall * kBall / 2) << of;
            EXPECT_LT(off, 0.002 * light) << of << ": " << off / light;
            EXPECT_EQ(worse, 0) << of;
        }
    }
}

}  // namespace
}  // namespace petrichor::gpu
