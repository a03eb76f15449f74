// Lists of lights: nothing is dropped, however many there are and wherever they stand.
#include <random>

#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

Primitive ground(float half_m)
{
    return quad({-half_m, 0, half_m}, {2 * half_m, 0, 0}, {0, 0, -2 * half_m});
}

// Lit by its lamps alone.
Frame dark_frame(const Camera& camera, int width, int height)
{
    Frame frame;
    frame.camera = camera;
    frame.settings.width = width;
    frame.settings.height = height;
    frame.settings.samples = 1;
    frame.settings.image_based_light = false;
    frame.settings.ambient_occlusion = false;
    frame.settings.shadows = false;
    frame.sky.analytic_sun = false;
    frame.weather.visibility_m = 1e9f;
    return frame;
}

class ManyLights : public GpuTest {
protected:
    std::mt19937 random_{7};
    float unit() { return static_cast<float>(random_() >> 8) / 16777216.0f; }
    float between(float low, float high) { return low + (high - low) * unit(); }
    glm::vec3 within(float half_m) { return {between(-half_m, half_m), between(-half_m, half_m), between(-half_m, half_m)}; }

    Light any_light()
    {
        Light light;
        light.kind = unit() < 0.3f ? LightKind::Spot : LightKind::Point;
        light.color = {unit(), unit(), unit()};
        light.intensity = between(0.1f, 20.0f);
        light.range_m = unit() < 0.2f ? 0.0f : between(0.05f, 4.0f);
        light.position_m = within(5.0f);
        light.direction = glm::normalize(within(1.0f) + glm::vec3(0, -0.01f, 0));
        light.outer_cone_rad = between(0.1f, 1.5f);
        light.inner_cone_rad = light.outer_cone_rad * unit();
        return light;
    }
};

// Lamps, eyes and sizes of pictures at random: what lists leave out would have added nothing, to the bit.
TEST_F(ManyLights, ListsAreWhatAllLightsGiveInAThousandScenes)
{
    renderer->load(scene_of({ground(6.0f), quad({-6, -1, -3}, {12, 0, 0}, {0, 5, 0}), quad({1, 0, 0}, {1, 0, 1}, {0, 2, 0})},
                            {plain_material(glm::vec3(0.6f), 0.3f)}),
                   {});
    int lit = 0;
    for (int scene = 0; scene < 1000; ++scene) {
        const glm::vec3 eye = within(6.0f);
        Frame frame = dark_frame(look(eye, within(3.0f) * glm::vec3(1, 0.3f, 1), between(0.2f, 2.2f)),
                                 static_cast<int>(between(1, 60)), static_cast<int>(between(1, 60)));
        if (scene % 5 == 0) frame.camera.orthographic_height_m = between(0.5f, 12.0f);
        const int lights = static_cast<int>(std::exp(between(0.0f, std::log(300.0f))));
        for (int i = 0; i < lights; ++i) frame.extra_lights.push_back(any_light());
        const RenderResult listed = renderer->render(frame);
        frame.settings.all_lights = true;
        const RenderResult all = renderer->render(frame);
        ASSERT_EQ(listed.beauty, all.beauty) << "scene " << scene << ", " << lights << " lights";
        for (int x = 0; x < listed.width; ++x) lit += luminance(pixel(listed, x, listed.height / 2)) > 0.0f;
    }
    EXPECT_GT(lit, 10000) << "of some 30 000 pixels asked";
}

// As many on one spot as a frame takes: each counts.
TEST_F(ManyLights, OnOneSpotTheySumUp)
{
    renderer->load(scene_of({ground(1.0f)}, {plain_material(glm::vec3(0.6f), 0.8f)}), {});
    Frame frame = dark_frame(look({0, 3, 0.1f}, {0, 0, 0}, 0.3f), 16, 8);
    Light light;
    light.range_m = 20.0f;
    light.position_m = {0, 2, 0};
    light.intensity = 1.0f;
    frame.extra_lights = {light};
    // The last row of a group of pixels: what shades them in turns comes there with all loops of the others behind it.
    const float one = pixel(renderer->render(frame), 8, 7).g;
    for (const std::size_t many : {1000, 4000, 20000, 40000}) {
        frame.extra_lights.assign(many, light);
        const float sum = pixel(renderer->render(frame), 8, 7).g;
        EXPECT_NEAR(sum / (one * static_cast<float>(many)), 1.0f, 0.01f) << many;
    }
    // Taken apart they are walked once more.
    frame.settings.aovs = {"diffuse_direct"};
    for (const std::size_t many : {500, 4000, 20000}) {
        frame.extra_lights.assign(many, light);
        const RenderResult parts = renderer->render(frame);
        const float whole = pixel(parts, 8, 7).g;
        EXPECT_NEAR(whole / (one * static_cast<float>(many)), 1.0f, 0.01f) << many;
        const std::vector<float>& scattered = parts.aovs.front().pixels;
        EXPECT_GT(scattered[(7 * 16 + 8) * 3 + 1], 0.5f * whole) << many;
        EXPECT_LE(scattered[(7 * 16 + 8) * 3 + 1], whole) << many;
    }
    // Walked twice, so many are not all there (a driver on a CPU ends the loops of the second walk), and that is said.
    frame.extra_lights.assign(30000, light);
    EXPECT_THROW(renderer->render(frame), Error);
    frame.settings.aovs = {"reflection"};  // takes nothing apart
    EXPECT_NEAR(pixel(renderer->render(frame), 8, 7).g / (one * 30000.0f), 1.0f, 0.01f);
    frame.settings.aovs.clear();
    frame.extra_lights.assign(59000, light);
    EXPECT_THROW(renderer->render(frame), Error) << "drivers cut longer loops short";
}

// What keeps the shadows alone walks its lights three times.
TEST_F(ManyLights, AreCountedByEachWalk)
{
    Material ground_material = plain_material(glm::vec3(0.6f), 0.8f);
    ground_material.lighting_model = "unlit_shadowed";
    renderer->load(scene_of({ground(1.0f)}, {ground_material}), {});
    Frame frame = dark_frame(look({0, 3, 0.1f}, {0, 0, 0}, 0.3f), 16, 8);
    Light light;
    light.range_m = 20.0f;
    light.position_m = {0, 2, 0};
    frame.extra_lights.assign(10000, light);
    EXPECT_GT(pixel(renderer->render(frame), 8, 7).g, 0.0f);
    frame.extra_lights.assign(20000, light);
    EXPECT_THROW(renderer->render(frame), Error);
}

// A street of a city: each pixel sees few of them, and none is left out.
TEST_F(ManyLights, AHundredThousandAreAllThere)
{
    constexpr int kLights = 100000, kParts = 10;
    renderer->load(scene_of({ground(100.0f)}, {plain_material(glm::vec3(0.6f), 0.8f)}), {});
    Frame frame = dark_frame(look({0, 40, 0.1f}, {0, 0, 0}, 1.2f), 640, 384);
    std::vector<Light> lights(kLights);
    for (Light& light : lights) {
        light.position_m = {between(-30, 30), between(0.1f, 0.5f), between(-30, 30)};
        light.range_m = 0.6f;
        light.intensity = 1.0f;
        light.color = {unit(), unit(), unit()};
    }
    std::vector<glm::vec3> sum(static_cast<std::size_t>(frame.settings.width));
    const auto row = [&](const RenderResult& r, int x) { return pixel(r, x, 200); };
    for (int part = 0; part < kParts; ++part) {
        frame.extra_lights.clear();
        for (int i = part; i < kLights; i += kParts) frame.extra_lights.push_back(lights[static_cast<std::size_t>(i)]);
        const RenderResult some = renderer->render(frame);
        for (int x = 0; x < frame.settings.width; ++x) sum[static_cast<std::size_t>(x)] += row(some, x);
    }
    frame.extra_lights = lights;
    const RenderResult all = renderer->render(frame);
    float most = 0.0f;
    for (int x = 0; x < frame.settings.width; ++x) {
        const glm::vec3 expected = sum[static_cast<std::size_t>(x)];
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(row(all, x)[c], expected[c], 2e-3f * expected[c] + 1e-4f) << x;
        most = std::max(most, luminance(expected));
    }
    EXPECT_GT(most, 1.0f);
}

}  // namespace
}  // namespace petrichor::gpu
