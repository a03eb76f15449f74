// What lets light through: blended by closed forms, in any order, without noise at one sample.
#include <cmath>

#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

constexpr int kSize = 48;

// Straight from above; glowing things only, so that what is sent is known.
Frame from_above()
{
    Frame frame;
    frame.camera = look({0, 4, 0}, {0, 0, 0});
    frame.camera.orthographic_height_m = 2.0f;
    frame.settings.width = frame.settings.height = kSize;
    frame.settings.samples = 1;
    frame.settings.image_based_light = false;
    frame.settings.shadows = false;
    frame.settings.exposure = 1.0f;
    frame.sky.sun_elevation_rad = -1.0f;
    frame.emissive_lights = false;
    return frame;
}

Primitive level(float y, std::uint32_t material, float from_x = -2.0f)
{
    return quad({from_x, y, 2}, {2.0f - from_x, 0, 0}, {0, 0, -4}, material);
}

Material glowing(const glm::vec3& radiance, float alpha = 1.0f)
{
    Material m = plain_material(glm::vec3(0.0f));
    m.base_color.a = alpha;
    m.emissive = radiance;
    if (alpha < 1.0f) m.alpha_mode = AlphaMode::Blend;
    return m;
}

void expect_color(const glm::vec3& is, const glm::vec3& wanted, float tolerance = 0.01f)
{
    EXPECT_LT(glm::length(is - wanted), tolerance * (1.0f + glm::length(wanted)))
        << is.r << " " << is.g << " " << is.b << " against " << wanted.r << " " << wanted.g << " "
        << wanted.b;
}

class TransparentTest : public GpuTest {
protected:
    RenderResult shot(const Scene& scene, const Frame& frame)
    {
        renderer->load(scene, {});
        return renderer->render(frame);
    }
};

TEST_F(TransparentTest, LayersBlendInTheirOrderWhateverTheOrderOfTheScene)
{
    const glm::vec3 ground(1, 1, 1), red(1, 0, 0), green(0, 1, 0), blue(0, 0, 1);
    // From below: ground, red at 0.5, green at 0.25, blue at 0.75.
    glm::vec3 wanted = ground;
    for (const auto& [color, alpha] :
         {std::pair{red, 0.5f}, std::pair{green, 0.25f}, std::pair{blue, 0.75f}}) {
        wanted = alpha * color + (1.0f - alpha) * wanted;
    }
    const std::vector<Material> materials{glowing(ground), glowing(red, 0.5f),
                                          glowing(green, 0.25f), glowing(blue, 0.75f)};
    for (const SurfacePath path : {SurfacePath::Fragment, SurfacePath::Visibility}) {
        for (const bool turned : {false, true}) {
            std::vector<Primitive> primitives{level(0, 0), level(1, 1), level(2, 2), level(3, 3)};
            if (turned) std::reverse(primitives.begin(), primitives.end());
            Frame frame = from_above();
            frame.settings.surface_path = path;
            const RenderResult r = shot(scene_of(primitives, materials), frame);
            for (int x = 2; x < kSize; x += 7) {
                for (int y = 2; y < kSize; y += 7) expect_color(pixel(r, x, y), wanted);
            }
        }
    }
}

TEST_F(TransparentTest, WhatLiesDeeperThanTheLayersGoesByChance)
{
    const std::vector<Material> materials{glowing({1, 1, 1}), glowing({1, 0, 0}, 0.5f),
                                          glowing({0, 1, 0}, 0.25f), glowing({0, 0, 1}, 0.75f)};
    // Chance is an instance's own.
    Scene scene = scene_of({level(0, 0)}, materials);
    for (std::uint32_t i = 1; i < 4; ++i) {
        scene.meshes.push_back({"pane", {level(static_cast<float>(i), i)}});
        scene.instances.push_back({"pane", i, glm::mat4(1.0f)});
    }
    Frame exact = from_above();
    const glm::vec3 wanted = pixel(shot(scene, exact), 20, 20);
    for (const int layers : {0, 2}) {
        Frame frame = from_above();
        frame.settings.transparent_layers = layers;
        frame.settings.samples = 64;
        const RenderResult r = shot(scene, frame);
        glm::vec3 mean(0.0f);
        for (int x = 0; x < kSize; ++x) {
            for (int y = 0; y < kSize; ++y) mean += pixel(r, x, y) / float(kSize * kSize);
        }
        expect_color(mean, wanted, 0.02f);
    }
}

TEST_F(TransparentTest, PremultipliedGlassKeepsItsReflection)
{
    Material glass = plain_material(glm::vec3(0.0f), 0.1f);
    glass.base_color.a = 0.0f;
    glass.alpha_mode = AlphaMode::Blend;
    const Material dark = plain_material(glm::vec3(0.0f), 1.0f);
    Frame frame = from_above();
    frame.settings.image_based_light = true;
    renderer->set_environment(constant_environment(1.0f));
    const auto light = [&](bool premultiplied) {
        glass.premultiplied_alpha = premultiplied;
        return luminance(
            pixel(shot(scene_of({level(0, 0), level(1, 1)}, {dark, glass}), frame), 24, 24));
    };
    const float bare =
        luminance(pixel(shot(scene_of({level(0, 0)}, {dark}), frame), 24, 24));
    // Faded to nothing it is not there; as glass it mirrors 4 % of all around.
    EXPECT_NEAR(light(false), bare, 0.003f);
    EXPECT_NEAR(light(true) - bare * 0.96f, 0.04f, 0.012f);
    renderer->set_environment({});
}

TEST_F(TransparentTest, ABodyTintsByBeersLaw)
{
    Material body = plain_material({0.5f, 1.0f, 1.0f}, 0.0f);
    body.transmission = 1.0f;
    body.thickness = 0.2f;
    body.attenuation_distance_m = 0.1f;
    body.attenuation_color = {1.0f, 0.5f, 0.8f};
    const Scene scene = scene_of({level(0, 0), level(1, 1)}, {glowing({1, 1, 1}), body});
    expect_color(pixel(shot(scene, from_above()), 24, 24),
                 0.96f * glm::vec3(0.5f, 0.25f, 0.64f), 0.01f);
}

// A step of light below a plate, seen aslant: a thick one shifts it by Snell's law, a rough one blurs it.
TEST_F(TransparentTest, AThickPlateShiftsAndARoughOneBlurs)
{
    Material plate = plain_material(glm::vec3(1.0f), 0.0f);
    plate.transmission = 1.0f;
    plate.ior = 1.5f;
    Frame frame = from_above();
    frame.camera = look({-3, 3, 0}, {0, 0, 0});
    frame.camera.orthographic_height_m = 1.0f;
    frame.settings.width = 96;
    const auto row = [&](float thickness, float roughness) {
        plate.thickness = thickness;
        plate.roughness = roughness;
        const RenderResult r = shot(scene_of({level(0, 0), quad({-2, 0.002f, 0}, {4, 0, 0}, {0, 0, -2}, 1),
                                              level(0.4f, 2)},
                                             {glowing({0, 0, 0}), glowing({1, 1, 1}), plate}),
                                    frame);
        std::vector<float> values;
        for (int x = 0; x < r.width; ++x) values.push_back(luminance(pixel(r, x, 24)));
        return values;
    };
    // Left and right of the step at z = 0, which stands upright in the picture.
    const auto bright = [](const std::vector<float>& v) {
        float sum = 0.0f;
        for (const float x : v) sum += x;
        return sum;
    };
    const auto between = [](const std::vector<float>& v) {
        return std::count_if(v.begin(), v.end(), [](float x) { return x > 0.1f && x < 0.75f; });
    };
    const auto thin = row(0.0f, 0.0f);
    const auto rough = row(0.0f, 0.6f);
    EXPECT_LE(between(thin), 2);
    // Of a disc of 5.8 pixels the step has 1.1 radii between these values.
    EXPECT_GE(between(rough), 6);
    EXPECT_NEAR(bright(rough), bright(thin), 0.1f * bright(thin));
}

TEST_F(TransparentTest, ARoundBodyBendsWhatIsBehind)
{
    // Level glass seen straight on bends nothing; tilted, it shifts the step.
    Material plate = plain_material(glm::vec3(1.0f), 0.0f);
    plate.transmission = 1.0f;
    plate.double_sided = true;
    const auto at = [&](float thickness) {
        plate.thickness = thickness;
        const Scene scene =
            scene_of({level(0, 0), quad({0, 0.002f, 2}, {2, 0, 0}, {0, 0, -4}, 1),
                      quad({-0.8f, 0.2f, 1}, {1.6f, 1.6f, 0}, {0, 0, -2}, 2)},
                     {glowing({0, 0, 0}), glowing({1, 1, 1}), plate});
        const RenderResult r = shot(scene, from_above());
        int lit = 0;
        for (int x = 0; x < kSize; ++x) lit += luminance(pixel(r, x, 24)) > 0.4f ? 1 : 0;
        return lit;
    };
    // 45 degrees, ior 1.5: the ray in the glass is 28.1 degrees off the normal, 16.9 off the vertical;
    // over 0.6 m that is 0.175 m aside, 4.2 pixels of 48 for 2 m.
    EXPECT_NEAR(std::abs(at(0.6f) - at(0.0f)), 4, 1);
}

// A pane that glows at half its strength below one that blurs: no edge in view, so the blur changes nothing.
TEST_F(TransparentTest, ARoughPaneShowsThePaneBehindIt)
{
    Material rough = plain_material(glm::vec3(1.0f), 0.5f);
    rough.transmission = 1.0f;
    rough.ior = 1.5f;
    const glm::vec3 ground(0.2f, 0.4f, 0.1f), green(0, 2, 0);
    const std::vector<Material> materials{glowing(ground), glowing(green, 0.5f), rough};
    Frame frame = from_above();
    expect_color(pixel(shot(scene_of({level(0, 0), level(1, 2)}, materials), frame), 24, 24), 0.96f * ground);
    expect_color(pixel(shot(scene_of({level(0, 0), level(0.5f, 1), level(1, 2)}, materials), frame), 24, 24),
                 0.96f * (0.5f * green + 0.5f * ground));
    // One that lies before it is not seen twice.
    expect_color(pixel(shot(scene_of({level(0, 0), level(1.5f, 1), level(1, 2)}, materials), frame), 24, 24),
                 0.5f * green + 0.5f * 0.96f * ground);
    // With one layer alone it is the solid picture.
    frame.settings.transparent_layers = 1;
    const glm::vec3 one = pixel(shot(scene_of({level(0, 0), level(0.5f, 1), level(1, 2)}, materials), frame), 24, 24);
    EXPECT_LT(one.r, 0.96f * (ground.r + 0.05f));
}

// Bodies behind bodies tint by Beer's law, one after the other; the far sides of two-sided ones count with their near sides.
TEST_F(TransparentTest, ABodyShowsTheBodyBehindIt)
{
    Material body = plain_material(glm::vec3(1.0f), 0.0f);
    body.transmission = 1.0f;
    body.double_sided = true;
    body.thickness = 0.2f;
    body.attenuation_distance_m = 0.2f;
    body.attenuation_color = {1.0f, 0.5f, 0.8f};
    Material other = body;
    other.attenuation_color = {0.25f, 1.0f, 0.8f};
    const auto through = [&](const std::vector<Primitive>& primitives) {
        return pixel(shot(scene_of(primitives, {glowing({1, 1, 1}), body, other}), from_above()), 24, 24);
    };
    const float passes = 0.96f;
    const glm::vec3 once = passes * body.attenuation_color;
    expect_color(through({level(0, 0), level(1, 1)}), once);
    expect_color(through({level(0, 0), level(0.5f, 2), level(1, 1)}), passes * once * other.attenuation_color);
    const Primitive far_side = quad({-2.0f, 0.8f, -2}, {4, 0, 0}, {0, 0, 4}, 1);
    expect_color(through({level(0, 0), far_side, level(1, 1)}), once);
}

// The step of ARoundBodyBendsWhatIsBehind, of a pane that lets light through.
TEST_F(TransparentTest, ARoundBodyBendsThePaneBehindIt)
{
    Material plate = plain_material(glm::vec3(1.0f), 0.0f);
    plate.transmission = 1.0f;
    const auto at = [&](float thickness, float alpha) {
        plate.thickness = thickness;
        const Scene scene =
            scene_of({level(0, 0), quad({0, 0.002f, 2}, {2, 0, 0}, {0, 0, -4}, 1),
                      quad({-0.8f, 0.2f, 1}, {1.6f, 1.6f, 0}, {0, 0, -2}, 2)},
                     {glowing({0, 0, 0}), glowing(glm::vec3(1.0f) / alpha, alpha), plate});
        const RenderResult r = shot(scene, from_above());
        int lit = 0;
        for (int x = 0; x < kSize; ++x) lit += luminance(pixel(r, x, 24)) > 0.4f ? 1 : 0;
        return lit;
    };
    EXPECT_NEAR(std::abs(at(0.6f, 0.5f) - at(0.0f, 0.5f)), 4, 1);
    EXPECT_EQ(at(0.6f, 0.5f), at(0.6f, 1.0f));
}

// A wall that glows behind a level pane, which mirrors it as a dark floor of the same smoothness does.
TEST_F(TransparentTest, ASmoothPaneMirrorsTheSolidPicture)
{
    Frame frame = from_above();
    frame.camera = look({0, 1.0f, 3}, {0, 0.4f, 0});
    frame.settings.image_based_light = true;
    frame.settings.reflections = true;
    const Material dark = plain_material(glm::vec3(0.0f), 0.05f);
    Material pane = dark;
    pane.alpha_mode = AlphaMode::Blend;
    pane.base_color.a = 0.0f;
    pane.premultiplied_alpha = true;
    const Primitive wall = quad({-3, 0, -1}, {6, 0, 0}, {0, 3, 0}, 0);
    const Primitive floor = quad({-3, 0.2f, 2}, {6, 0, 0}, {0, 0, -2.9f}, 1);
    const Primitive ground = quad({-3, 0, 2}, {6, 0, 0}, {0, 0, -3}, 2);
    const auto shown = [&](const Material& second, bool reflections) {
        frame.settings.reflections = reflections;
        return pixel(shot(scene_of({wall, ground, floor}, {glowing({4, 0.2f, 0.2f}), second, plain_material(glm::vec3(0.0f), 1.0f)}), frame), 24, 34);
    };
    const glm::vec3 solid = shown(dark, true);
    EXPECT_GT(solid.r, 0.1f);
    expect_color(shown(pane, true), solid, 0.02f);
    EXPECT_LT(shown(pane, false).r, 0.2f * solid.r);
}

TEST_F(TransparentTest, CastersCanBeSwitchedOff)
{
    Material pane = plain_material(glm::vec3(0.5f));
    pane.alpha_mode = AlphaMode::Blend;
    pane.base_color.a = 0.5f;
    Frame frame = from_above();
    frame.settings.shadows = true;
    frame.sky.sun_elevation_rad = 0.7854f;
    frame.sky.sun_azimuth_rad = 1.5708f;  // from +x: the shadow lies on the -x side
    const auto ground = [&](bool casts) {
        pane.casts_shadows = casts;
        const Scene scene = scene_of({level(0, 0), quad({0, 1, 1}, {1, 0, 0}, {0, 0, -2}, 1)},
                                     {plain_material(glm::vec3(0.8f)), pane});
        const RenderResult r = shot(scene, frame);
        float sum = 0.0f;
        for (int y = 16; y < 32; ++y) sum += luminance(pixel(r, 10, y)) / 16.0f;
        return sum;
    };
    const float open = ground(false);
    EXPECT_NEAR(ground(true), 0.5f * open, 0.12f * open);
}

}  // namespace
}  // namespace petrichor::gpu
