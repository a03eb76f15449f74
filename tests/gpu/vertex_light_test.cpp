// Lamps whose light is worked out at vertices ([lamps] per_vertex).
#include "formulas/light/vertex_light.h"

#include <algorithm>
#include <cmath>
#include <iostream>

#include "gpu/outputs/light_parts.h"
#include "scene/light_shape.h"
#include "tests/gpu/ball.h"
#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

Light lamp(const glm::vec3& at, float candela, const glm::vec3& color = glm::vec3(1.0f))
{
    Light light;
    light.position_m = at;
    light.color = color;
    light.intensity = candela;
    light.range_m = 12.0f;
    light.specular = 0.0f;
    return light;
}

Light spot(const glm::vec3& at, const glm::vec3& target, float candela)
{
    Light light = lamp(at, candela, {0.4f, 1.0f, 0.7f});
    light.kind = LightKind::Spot;
    light.direction = glm::normalize(target - at);
    light.inner_cone_rad = 0.1f;
    light.outer_cone_rad = 0.5f;
    return light;
}

std::vector<Light> by_vertex(std::vector<Light> lights)
{
    for (Light& light : lights) light.per_vertex = true;
    return lights;
}

Frame dark_frame(const Camera& camera, SurfacePath path = SurfacePath::Visibility)
{
    Frame frame;
    frame.camera = camera;
    frame.settings.width = 96;
    frame.settings.height = 64;
    frame.settings.samples = 1;
    frame.settings.surface_path = path;
    frame.settings.image_based_light = false;
    frame.settings.ambient_occlusion = false;
    frame.settings.shadows = false;
    frame.settings.draw_sky = false;
    frame.sky.analytic_sun = false;
    frame.weather.visibility_m = 1e9f;
    return frame;
}

struct Difference {
    float worst = 0.0f;      // of a pixel's, over the brightest pixel
    float brightest = 0.0f;
};

Difference difference(const RenderResult& a, const RenderResult& b)
{
    Difference d;
    for (int y = 0; y < a.height; ++y) {
        for (int x = 0; x < a.width; ++x) {
            for (int c = 0; c < 3; ++c) {
                d.worst = std::max(d.worst, std::abs(pixel(a, x, y)[c] - pixel(b, x, y)[c]));
                d.brightest = std::max(d.brightest, pixel(b, x, y)[c]);
            }
        }
    }
    d.worst /= std::max(d.brightest, 1.0e-9f);
    return d;
}

class VertexLightTest : public GpuTest {
protected:
    RenderResult picture(Scene scene, std::vector<Light> lights, const Frame& frame)
    {
        scene.lights = std::move(lights);
        renderer->load(scene, {});
        return renderer->render(frame);
    }
    // Of lamps by vertex, against the same by pixel.
    Difference difference_of(const Scene& scene, const std::vector<Light>& lights, const Frame& frame)
    {
        const RenderResult pixels = picture(scene, lights, frame);
        return difference(picture(scene, by_vertex(lights), frame), pixels);
    }
};

Scene ball_scene(Material material, int rows = 192)
{
    Scene scene = scene_of({ball(0, {}, 1.0f, rows, 2 * rows)}, {std::move(material)});
    // Turned, and of other width than height.
    scene.instances[0].to_world = glm::rotate(glm::mat4(1.0f), 0.4f, glm::vec3(0.3f, 0.2f, 1.0f)) *
                                  glm::scale(glm::mat4(1.0f), glm::vec3(1.3f, 0.8f, 1.0f));
    return scene;
}

Material matt(const glm::vec3& color)
{
    Material m = plain_material(color, 0.9f);
    m.lighting_model = "lambert";
    return m;
}

std::vector<Light> three_lamps()
{
    return {lamp({2, 2, 2}, 300.0f), lamp({-2.5f, 0.5f, 1}, 200.0f, {1.0f, 0.5f, 0.2f}), spot({0.5f, 2.5f, 3}, {0, 0, 0}, 900.0f)};
}

TEST_F(VertexLightTest, FineMeshesAreLitAsByPixel)
{
    for (const SurfacePath path : {SurfacePath::Visibility, SurfacePath::Fragment}) {
        const Difference d = difference_of(ball_scene(matt({0.7f, 0.5f, 0.3f})), three_lamps(), dark_frame(look({0, 1, 5}, {0, 0, 0}, 0.6f), path));
        EXPECT_GT(d.brightest, 5.0f);
        EXPECT_LT(d.worst, 0.01f);
    }
}

TEST_F(VertexLightTest, ProfilesAreThoseOfPixels)
{
    Scene scene = ball_scene(matt(glm::vec3(0.6f)));
    LightProfile profile;  // brighter to one side
    for (int i = 0; i < kLightProfileSide * kLightProfileSide; ++i) {
        const float turn = static_cast<float>(i % kLightProfileSide) / static_cast<float>(kLightProfileSide);
        profile.texels.emplace_back(0.6f + 0.4f * std::cos(6.2831853f * turn));
    }
    scene.light_profiles.push_back(profile);
    std::vector<Light> lights = three_lamps();
    for (Light& light : lights) {
        if (light.kind == LightKind::Point) light.profile = 0;
    }
    const Frame frame = dark_frame(look({0, 1, 5}, {0, 0, 0}, 0.6f));
    EXPECT_LT(difference_of(scene, lights, frame).worst, 0.01f);
    const RenderResult with = picture(scene, by_vertex(lights), frame);
    for (int k = 0; k < 2; ++k) lights[static_cast<std::size_t>(k)].profile = -1;
    const RenderResult without = picture(scene, by_vertex(lights), frame);
    EXPECT_GT(difference(with, without).worst, 0.05f) << pixel(with, 40, 32).x << ' ' << pixel(without, 40, 32).x;
}

// Between vertices their light is shared out; a triangle's middle has the mean of its corners.
TEST_F(VertexLightTest, CoarseMeshesHaveTheMeanOfTheirCorners)
{
    Primitive triangle = quad({-2, 0, 2}, {4, 0, 0}, {0, 0, -4});
    triangle.indices = {0, 1, 2};
    const Scene scene = scene_of({triangle}, {matt(glm::vec3(0.5f))});
    const Light light = lamp({0.6f, 1.0f, 0.4f}, 50.0f);
    float mean = 0.0f;
    for (int i = 0; i < 3; ++i) {
        const glm::vec3 to = light.position_m - triangle.positions[static_cast<std::size_t>(i)];
        const float falloff = shared::vertex_falloff(to, light.range_m, light.direction, 1.0f, -2.0f);
        mean += shared::lit_sides({0, 1, 0}, to, glm::vec3(light.intensity * falloff)).front.x / 3.0f;
    }
    Frame frame = dark_frame(look(glm::vec3(0.6667f, 6, 0.6667f), {0.6667f, 0, 0.6667f}, 0.05f));
    const RenderResult result = picture(scene, by_vertex({light}), frame);
    EXPECT_NEAR(pixel(result, 48, 32).x, 0.5f * mean, 0.01f * mean);
    EXPECT_GT(pixel(picture(scene, {light}, frame), 48, 32).x, 2.0f * 0.5f * mean);
}

// Water darkens what is lit at vertices as it does what is lit at pixels.
TEST_F(VertexLightTest, WetSurfacesAreDarkerAlike)
{
    Material stone = plain_material({0.5f, 0.45f, 0.4f}, 0.9f);
    stone.weather.porosity = 0.7f;
    Frame frame = dark_frame(look({0, 1, 5}, {0, 0, 0}, 0.6f));
    frame.settings.shelter = false;
    const Scene scene = ball_scene(stone);
    const RenderResult dry = picture(scene, by_vertex(three_lamps()), frame);
    frame.weather.film_albedo = frame.weather.film_smoothness = 1.0f;
    const RenderResult wet = picture(scene, by_vertex(three_lamps()), frame);
    EXPECT_LT(pixel(wet, 48, 24).y, 0.8f * pixel(dry, 48, 24).y);
    // The film lets light in at an angle by pixel, and straight by vertex.
    EXPECT_LT(difference_of(scene, three_lamps(), frame).worst, 0.05f);
}

// A sheet has light on the side that faces the lamp, whichever is seen.
TEST_F(VertexLightTest, BothSidesOfASheet)
{
    Material sheet = matt(glm::vec3(0.8f));
    sheet.double_sided = true;
    Primitive two = quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
    Scene scene = scene_of({two}, {sheet});
    for (const bool mirrored : {false, true}) {
        scene.instances[0].to_world = glm::scale(glm::mat4(1.0f), glm::vec3(mirrored ? -1.0f : 1.0f, 1.0f, 1.0f));
        for (const SurfacePath path : {SurfacePath::Visibility, SurfacePath::Fragment}) {
            for (const float side : {1.0f, -1.0f}) {
                const Light light = lamp({0, 0, side * 2.0f}, 100.0f);
                const RenderResult same = picture(scene, by_vertex({light}), dark_frame(look({0, 0, side * 4.0f}, {0, 0, 0}, 0.3f), path));
                const RenderResult other = picture(scene, by_vertex({light}), dark_frame(look({0, 0, -side * 4.0f}, {0, 0, 0}, 0.3f), path));
                EXPECT_GT(pixel(same, 48, 32).x, 1.0f) << side;
                EXPECT_EQ(pixel(other, 48, 32).x, 0.0f) << side;
            }
        }
    }
}

// What lets light through is lit as a layer of its own.
TEST_F(VertexLightTest, BlendedSurfacesAreLit)
{
    Material pane = matt({0.3f, 0.9f, 0.6f});
    pane.alpha_mode = AlphaMode::Blend;
    pane.base_color.a = 0.6f;
    Scene scene = ball_scene(pane);
    const Difference d = difference_of(scene, three_lamps(), dark_frame(look({0, 1, 5}, {0, 0, 0}, 0.6f)));
    EXPECT_GT(d.brightest, 2.0f);
    EXPECT_LT(d.worst, 0.01f);
}

// They throw no shadows, and leave those to the others.
TEST_F(VertexLightTest, ThrowsNoShadows)
{
    Scene scene = scene_of({quad({-3, 0, 3}, {6, 0, 0}, {0, 0, -6}), quad({-0.5f, 1, 0.5f}, {1, 0, 0}, {0, 0, -1})}, {matt(glm::vec3(0.5f))});
    scene.materials[0].double_sided = true;
    Frame frame = dark_frame(look({0, 3, 6}, {0, 0, 0}, 0.5f));
    frame.settings.shadows = true;
    frame.settings.lamp_shadows = 1;
    const std::vector<Light> bright{lamp({0, 2, 0}, 500.0f)};
    const float shaded = luminance(pixel(picture(scene, bright, frame), 48, 32));
    EXPECT_EQ(shaded, 0.0f);
    EXPECT_GT(luminance(pixel(picture(scene, by_vertex(bright), frame), 48, 32)), 1.0f);
    // The one shadow is of the weaker lamp.
    std::vector<Light> both = by_vertex(bright);
    const Light weak = lamp({0, 2, 0}, 5.0f);
    both.push_back(weak);
    EXPECT_EQ(pixel(picture(scene, both, frame), 48, 32), pixel(picture(scene, by_vertex(bright), frame), 48, 32));
}

TEST_F(VertexLightTest, ManyInstancesAreLitEach)
{
    Scene scene = scene_of({ball(0, {}, 0.3f, 24, 48)}, {matt(glm::vec3(0.6f))});
    scene.instances.clear();
    for (int i = 0; i < 24; ++i)
        scene.instances.push_back({"ball", 0, glm::translate(glm::mat4(1.0f), glm::vec3(static_cast<float>(i % 6) - 2.5f, static_cast<float>(i / 6) - 1.5f, 0))});
    for (const SurfacePath path : {SurfacePath::Visibility, SurfacePath::Fragment}) {
        const Difference d = difference_of(scene, three_lamps(), dark_frame(look({0, 0, 7}, {0, 0, 0}, 0.6f), path));
        EXPECT_GT(d.brightest, 5.0f);
        EXPECT_LT(d.worst, 0.02f);
    }
}

// The parts of the light add up, theirs is direct.
TEST_F(VertexLightTest, IsOfTheDirectPart)
{
    Frame frame = dark_frame(look({0, 1, 5}, {0, 0, 0}, 0.6f));
    frame.settings.aovs = {"diffuse_direct", "specular_direct", "diffuse_indirect", "emitted"};
    const RenderResult r = picture(ball_scene(plain_material({0.7f, 0.5f, 0.3f}, 0.4f)), by_vertex(three_lamps()), frame);
    float most = 0.0f;
    for (int y = 0; y < r.height; ++y) {
        for (int x = 0; x < r.width; ++x) {
            const float red = pixel(r, x, y).x;
            most = std::max(most, red);
            EXPECT_NEAR(aov(r, "diffuse_direct", x, y), red, 2.0e-3f * red + 1.0e-3f);
            EXPECT_EQ(aov(r, "specular_direct", x, y) + aov(r, "diffuse_indirect", x, y) + aov(r, "emitted", x, y), 0.0f);
        }
    }
    EXPECT_GT(most, 5.0f);
}

// Normals of no length, vertices at the lamp itself: dark or bright, but numbers.
TEST_F(VertexLightTest, BadMeshesGiveNumbers)
{
    Primitive bad = quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
    bad.normals[0] = glm::vec3(0.0f);
    const RenderResult r = picture(scene_of({bad}, {matt(glm::vec3(0.5f))}), by_vertex({lamp(bad.positions[1], 1.0e6f), lamp({0, 0, 1}, 10.0f)}),
                                   dark_frame(look({0, 0, 3}, {0, 0, 0}, 0.8f)));
    for (int y = 0; y < r.height; ++y)
        for (int x = 0; x < r.width; ++x) EXPECT_TRUE(std::isfinite(luminance(pixel(r, x, y))));
    EXPECT_GT(luminance(pixel(r, 48, 32)), 0.1f);
}

TEST_F(VertexLightTest, TooManyAreRefused)
{
    const Scene scene = scene_of({quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0})}, {matt(glm::vec3(0.5f))});
    const std::vector<Light> lights(16385, lamp({0, 0, 1}, 10.0f));
    try {
        picture(scene, by_vertex(lights), dark_frame(look({0, 0, 3}, {0, 0, 0}, 0.8f)));
        ADD_FAILURE() << "was drawn";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("16385 lamps light by vertex"), std::string::npos) << error.what();
    }
}

// Where the renderer was not told before it draws, lamps of a frame light pixels.
TEST_F(VertexLightTest, LampsOfAFrameLightPixels)
{
    const Scene scene = ball_scene(matt(glm::vec3(0.5f)), 8);
    Frame frame = dark_frame(look({0, 1, 5}, {0, 0, 0}, 0.6f));
    frame.extra_lights = three_lamps();
    const RenderResult pixels = picture(scene, {}, frame);
    frame.extra_lights = by_vertex(three_lamps());
    EXPECT_EQ(picture(scene, {}, frame).beauty, pixels.beauty);
}

// A town of lamps by pixel and by vertex; what they cost is printed.
TEST_F(VertexLightTest, AThousandLampsLookAlike)
{
    Scene scene;
    scene.materials = {matt(glm::vec3(0.5f))};
    Primitive ground;
    constexpr int kSide = 160;
    for (int i = 0; i <= kSide; ++i) {
        for (int j = 0; j <= kSide; ++j) {
            ground.positions.emplace_back(0.5f * static_cast<float>(j) - 40.0f, 0.0f, 0.5f * static_cast<float>(i) - 40.0f);
            ground.normals.emplace_back(0, 1, 0);
            ground.tangents.emplace_back(1, 0, 0, 1);
            ground.uv0.emplace_back(0, 0);
        }
    }
    for (std::uint32_t i = 0; i < kSide; ++i) {
        for (std::uint32_t j = 0; j < kSide; ++j) {
            const std::uint32_t a = i * (kSide + 1) + j, b = a + kSide + 1;
            for (const std::uint32_t k : {a, b, a + 1, a + 1, b, b + 1}) ground.indices.push_back(k);
        }
    }
    scene.meshes.push_back({"ground", {ground}});
    scene.instances.push_back({"ground", 0, glm::mat4(1.0f)});
    std::vector<Light> lights;
    for (int i = 0; i < 1000; ++i) {
        Light one = lamp({0.37f * static_cast<float>(i * 61 % 211) - 39.0f, 2.0f, 0.37f * static_cast<float>(i * 37 % 213) - 39.0f}, 40.0f);
        one.range_m = 8.0f;
        lights.push_back(one);
    }
    Frame frame = dark_frame(look({0, 30, 45}, {0, 0, 0}, 1.0f));
    frame.settings.width = 640;
    frame.settings.height = 360;
    Renderer apart(RendererOptions{.device = "", .passes_apart = true});
    const auto costs = [&](const std::vector<Light>& shining, const char* name) {
        scene.lights = shining;
        apart.load(scene, {});
        apart.render(frame);
        const RenderResult r = apart.render(frame);
        double all = 0.0;
        std::string each;
        for (const PassTime& pass : r.passes) {
            all += pass.cpu_milliseconds;
            if (pass.name == "lighting" || pass.name == "surface" || pass.name == "vertex_light" || pass.name == "light_lists")
                each += " " + pass.name + " " + std::to_string(pass.cpu_milliseconds);
        }
        std::cout << "1000 lamps, 640 x 360, " << name << ": " << all << " CPU-ms;" << each << "\n";
        return r;
    };
    const RenderResult pixels = costs(lights, "by pixel");
    const RenderResult vertices = costs(by_vertex(lights), "by vertex");
    EXPECT_LT(difference(vertices, pixels).worst, 0.06f);
}

}  // namespace
}  // namespace petrichor::gpu
