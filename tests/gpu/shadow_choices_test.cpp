// Shadows that take a part of the light, and materials that receive none.
#include <algorithm>
#include <cmath>

#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

using ShadowChoices = GpuTest;

// A floor under a plate, whose shadow is seen from between them.
Scene floor_and_plate(const Material& floor, bool plate = true, bool plate_receives = true)
{
    Material above = plain_material(glm::vec3(0.5f), 1.0f);
    above.double_sided = true;
    above.receives_shadows = plate_receives;
    std::vector<Primitive> all{quad({-4, 0, 4}, {8, 0, 0}, {0, 0, -8})};
    if (plate) all.push_back(quad({-0.5f, 1, 0.5f}, {1, 0, 0}, {0, 0, -1}, 1));
    return scene_of(std::move(all), {floor, above});
}

Frame below_the_plate()
{
    Frame frame;
    frame.camera = look({0, 8, 0}, {0, 0, 0});
    frame.camera.to_world[3] = glm::vec4(0, 0.9f, 0, 1);
    frame.camera.orthographic_height_m = 4.8f;
    frame.settings.width = frame.settings.height = 48;
    frame.settings.samples = 1;
    frame.settings.image_based_light = false;
    frame.settings.draw_sky = false;
    frame.settings.exposure = 1.0f;
    frame.sky.sun_illuminance = 0.0f;
    frame.weather.visibility_m = 1e9f;
    return frame;
}

enum class Lit { BySun, ByPoint, BySpot, ByBall, ByRectangle };
constexpr Lit kAll[] = {Lit::BySun, Lit::ByPoint, Lit::BySpot, Lit::ByBall, Lit::ByRectangle};

Frame lit_by(Lit by, float strength)
{
    Frame frame = below_the_plate();
    if (by == Lit::BySun) {
        frame.sky.sun_illuminance = 100.0f;
        frame.sky.sun_elevation_rad = 1.3f;
        frame.sky.sun_shadow_strength = strength;
        return frame;
    }
    Light lamp;
    lamp.position_m = {0.2f, 2, 0};
    lamp.intensity = 100.0f;
    lamp.shadow_strength = strength;
    lamp.direction = {0, -1, 0};
    if (by == Lit::BySpot) lamp.kind = LightKind::Spot;
    if (by == Lit::ByBall) lamp.radius_m = 0.2f;
    if (by == Lit::ByRectangle) {
        lamp.kind = LightKind::Rectangle;
        lamp.half_u_m = {0.2f, 0, 0};
        lamp.half_v_m = {0, 0, 0.2f};
        lamp.shaped = true;
    }
    frame.extra_lights = {lamp};
    return frame;
}

std::vector<float> picture(const RenderResult& r)
{
    std::vector<float> all;
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 48; ++x) all.push_back(luminance(pixel(r, x, y)));
    return all;
}

// Largest difference, in shares of the brightest value: what is stored is rounded to halfs.
float apart(const std::vector<float>& a, const std::vector<float>& b)
{
    float most = 0.0f;
    for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
    return most / *std::max_element(b.begin(), b.end());
}

TEST_F(ShadowChoices, AStrengthIsTheShareOfTheLightThatTheyTake)
{
    Material matt = plain_material(glm::vec3(0.5f), 1.0f);
    renderer->load(floor_and_plate(matt), {});
    for (const Lit by : kAll) {
        const auto full = picture(renderer->render(lit_by(by, 1.0f)));
        const auto half = picture(renderer->render(lit_by(by, 0.5f)));
        const auto none = picture(renderer->render(lit_by(by, 0.0f)));
        Frame open = lit_by(by, 1.0f);
        open.settings.shadows = false;
        const auto lit = picture(renderer->render(open));
        EXPECT_GT(apart(full, lit), 0.5f) << static_cast<int>(by) << ": there is a shadow";
        EXPECT_LE(apart(none, lit), 1e-3f) << static_cast<int>(by);
        std::vector<float> between;
        for (std::size_t i = 0; i < lit.size(); ++i) between.push_back(0.5f * (full[i] + lit[i]));
        EXPECT_LE(apart(half, between), 1e-3f) << static_cast<int>(by);
    }
}

// One lamp's strength is no other's: beside one without shadows another throws its own.
TEST_F(ShadowChoices, AStrengthIsOfOneLamp)
{
    renderer->load(floor_and_plate(plain_material(glm::vec3(0.5f), 1.0f)), {});
    Frame both = lit_by(Lit::ByPoint, 0.3f);
    const Frame other = lit_by(Lit::BySpot, 1.0f);
    const auto one = picture(renderer->render(both));
    const auto two = picture(renderer->render(other));
    both.extra_lights.push_back(other.extra_lights[0]);
    std::vector<float> sum;
    for (std::size_t i = 0; i < one.size(); ++i) sum.push_back(one[i] + two[i]);
    EXPECT_LE(apart(picture(renderer->render(both)), sum), 1e-3f);
}

// A lamp that throws no shadow keeps none from a fainter one.
TEST_F(ShadowChoices, WithoutAShadowALampOwnsNoMap)
{
    renderer->load(floor_and_plate(plain_material(glm::vec3(0.5f), 1.0f)), {});
    Frame frame = lit_by(Lit::ByPoint, 1.0f);
    frame.settings.lamp_shadows = 1;
    Light bright = frame.extra_lights[0];
    bright.position_m = {0.2f, 2, 0.1f};
    bright.intensity = 1000.0f;
    bright.shadow_strength = 0.0f;
    const auto alone = picture(renderer->render(frame));
    frame.extra_lights.push_back(bright);
    const auto with = picture(renderer->render(frame));
    frame.extra_lights = {bright};
    const auto fill = picture(renderer->render(frame));
    std::vector<float> sum;
    for (std::size_t i = 0; i < alone.size(); ++i) sum.push_back(alone[i] + fill[i]);
    EXPECT_LE(apart(with, sum), 1e-3f);
}

TEST_F(ShadowChoices, AFloorThatReceivesNoneIsLitAsWithoutTheCaster)
{
    for (const SurfacePath path : {SurfacePath::Fragment, SurfacePath::Visibility}) {
        for (const bool wet : {false, true}) {
            for (const bool blended : {false, true}) {
                for (const Lit by : {Lit::BySun, Lit::ByPoint, Lit::ByBall}) {
                    Material floor = plain_material(glm::vec3(0.5f), 0.9f);
                    if (blended) {
                        floor.alpha_mode = AlphaMode::Blend;
                        floor.base_color.a = 0.6f;
                    }
                    Frame frame = lit_by(by, 1.0f);
                    frame.settings.surface_path = path;
                    frame.settings.shelter = false;  // the plate keeps rain off, too
                    if (wet) frame.weather.film_albedo = frame.weather.film_smoothness = 0.4f;
                    const auto seen = [&](bool receives, bool plate) {
                        floor.receives_shadows = receives;
                        renderer->load(floor_and_plate(floor, plate), {});
                        return picture(renderer->render(frame));
                    };
                    const auto open = seen(true, false);
                    EXPECT_LE(apart(seen(false, true), open), 1e-3f) << static_cast<int>(by) << wet << blended;
                    EXPECT_GT(apart(seen(true, true), open), 0.5f) << static_cast<int>(by) << wet << blended;
                }
            }
        }
    }
}

TEST_F(ShadowChoices, WhatOtherMaterialsReceiveIsTheirOwn)
{
    const Material floor = plain_material(glm::vec3(0.5f), 0.9f);
    for (const Lit by : kAll) {
        const auto seen = [&](bool plate_receives) {
            renderer->load(floor_and_plate(floor, true, plate_receives), {});
            return picture(renderer->render(lit_by(by, 1.0f)));
        };
        EXPECT_LE(apart(seen(false), seen(true)), 1e-3f);
    }
}

TEST_F(ShadowChoices, PaintedGroundWithoutShadowsIsAsItIs)
{
    Material painted = plain_material(glm::vec3(0.5f), 1.0f);
    painted.lighting_model = "unlit_shadowed";
    const auto darkest = [&](bool receives) {
        painted.receives_shadows = receives;
        renderer->load(floor_and_plate(painted), {});
        const auto p = picture(renderer->render(lit_by(Lit::BySun, 1.0f)));
        return *std::min_element(p.begin(), p.end()) / *std::max_element(p.begin(), p.end());
    };
    EXPECT_NEAR(darkest(true), 0.3f, 0.01f);
    EXPECT_NEAR(darkest(false), 1.0f, 1e-3f);
}

}  // namespace
}  // namespace petrichor::gpu
