// The picture taken apart by the way of its light, and what mirrors show.
#include <algorithm>
#include <cmath>

#include "demo/street.h"
#include "gpu/outputs/light_parts.h"
#include "gpu/outputs/light_parts_io.h"
#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

class LightPartsTest : public GpuTest {};
class ReflectionLabel : public GpuTest {};

constexpr int kWidth = 96;
constexpr int kHeight = 64;

std::vector<std::string> all_parts()
{
    std::vector<std::string> names;
    for (std::size_t row = gbuffer_aov_count(); row < aov_table().size(); ++row) {
        if (aov_table()[row].name != "reflection") names.push_back(aov_table()[row].name);
    }
    return names;
}

glm::vec3 part(const RenderResult& r, const std::string& name, int x, int y)
{
    return {aov(r, name, x, y, 0), aov(r, name, x, y, 1), aov(r, name, x, y, 2)};
}

Light lamp(LightKind kind, const glm::vec3& at, float intensity)
{
    Light light;
    light.kind = kind;
    light.position_m = at;
    light.direction = {0, -1, 0};
    light.intensity = intensity;
    light.range_m = 20.0f;
    return light;
}

// Every way that light takes: a street of several materials, coats, cloth, skin, what glows, lamps, glass
// that is thin, coloured, and a body.
Scene crowded()
{
    Material wet = plain_material({0.2f, 0.18f, 0.16f}, 0.7f);
    wet.weather.porosity = 0.6f;
    Material metal = plain_material({0.9f, 0.7f, 0.4f}, 0.25f, 1.0f);
    Material coat = plain_material({0.6f, 0.1f, 0.1f}, 0.6f);
    coat.clearcoat = 1.0f;
    coat.clearcoat_roughness = 0.5f;
    Material sign = plain_material(glm::vec3(0.1f));
    sign.emissive = {300.0f, 900.0f, 200.0f};
    Material leaf = plain_material({0.2f, 0.5f, 0.1f}, 0.5f);
    leaf.translucency = 0.7f;
    Material pane = plain_material({0.4f, 0.8f, 0.9f}, 0.1f);
    pane.base_color.a = 0.3f;
    pane.alpha_mode = AlphaMode::Blend;
    Material hair = plain_material({0.5f, 0.3f, 0.2f}, 0.4f);
    hair.lighting_model = "hair";
    Scene scene = scene_of({quad({-6, 0, 4}, {12, 0, 0}, {0, 0, -14}, 0),
                            quad({-4, 0, -5}, {2, 0, 0}, {0, 3, 0}, 1),
                            quad({-1.5f, 0, -5}, {2, 0, 0}, {0, 3, 0}, 2),
                            quad({1, 1.5f, -5}, {1, 0, 0}, {0, 1, 0}, 3),
                            quad({2.2f, 0, -5}, {1.5f, 0, 0}, {0, 2, 0}, 4),
                            quad({-3, 0, -2}, {1.6f, 0, 0}, {0, 1.8f, 0}, 5),
                            quad({-2.6f, 0, -1.5f}, {1.6f, 0, 0}, {0, 1.5f, 0}, 5),
                            quad({0.6f, 0, -3}, {0.8f, 0, 0}, {0, 1, 0}, 6)},
                           {wet, metal, coat, sign, leaf, pane, hair});
    scene.lights = {lamp(LightKind::Point, {0, 2.2f, -3}, 400.0f),
                    lamp(LightKind::Spot, {2, 3, -2}, 900.0f)};
    scene.lights[0].radius_m = 0.1f;
    return scene;
}

Frame street()
{
    Frame frame;
    frame.camera = look({0, 1.6f, 4}, {0, 0.9f, -4}, 0.9f);
    frame.settings.width = kWidth;
    frame.settings.height = kHeight;
    frame.settings.samples = 2;
    frame.sky.sun_elevation_rad = 0.5f;
    frame.sky.sun_azimuth_rad = 2.4f;
    frame.sky.sun_illuminance = 3000.0f;
    return frame;
}

// Samples from the third on shade some pixels only.
void calm(Frame& frame)
{
    frame.settings.surface_path = SurfacePath::Visibility;
    frame.settings.samples = 4;
    frame.settings.adaptive = 0.02f;
}

// Roundings to halves stand between the sum and the picture: of a sample, of their mean, and of what
// calm pixels take of the first two.
void expect_sum(const RenderResult& r, const char* what)
{
    float worst = 0.0f;
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            glm::vec3 sum(0.0f);
            for (const std::string& name : all_parts()) sum += part(r, name, x, y);
            const glm::vec3 picture = pixel(r, x, y);
            for (int c = 0; c < 3; ++c) {
                worst = std::max(worst, std::abs(sum[c] - picture[c]) / (picture[c] + 1.0e-3f));
            }
        }
    }
    EXPECT_LT(worst, 0.003f) << what;
}

TEST_F(LightPartsTest, SumUpToThePictureInEveryWeather)
{
    renderer->load(crowded(), {});
    struct Weather {
        const char* name;
        void (*set)(Frame&);
    };
    const Weather cases[] = {
        {"rain and fog",
         [](Frame& f) {
             f.weather.rain = 0.9f;
             f.weather.film_albedo = f.weather.film_smoothness = 1.0f;
             f.weather.flood_puddles = 0.8f;
             f.weather.visibility_m = 60.0f;
             calm(f);
         }},
        {"snow by night, glass by chance",
         [](Frame& f) {
             f.settings.transparent_layers = 0;
             calm(f);
             f.weather.snow_amount = 0.6f;
             f.sky.sun_elevation_rad = -0.3f;
             f.weather.visibility_m = 200.0f;
         }},
        {"no light of the sky", [](Frame& f) { f.settings.image_based_light = false; }},
    };
    for (const Weather& weather : cases) {
        Frame frame = street();
        weather.set(frame);
        const RenderResult alone = renderer->render(frame);
        frame.settings.aovs = all_parts();
        frame.settings.aovs.push_back("reflection");
        const RenderResult split = renderer->render(frame);
        EXPECT_EQ(alone.beauty, split.beauty) << weather.name << ": asking changes nothing";
        expect_sum(split, weather.name);
    }
}

TEST_F(LightPartsTest, SumUpOnTheDemoInTheRain)
{
    const Scene demo = demo::make_demo_street({.texture_size = 16});
    renderer->load(demo, {});
    Frame frame = street();
    frame.camera = demo.cameras.at(0);
    frame.settings.samples = 1;
    frame.weather.rain = 0.9f;
    frame.weather.film_albedo = frame.weather.film_smoothness = 1.0f;
    frame.weather.flood_puddles = 0.8f;
    frame.weather.visibility_m = 2000.0f;
    frame.settings.aovs = all_parts();
    expect_sum(renderer->render(frame), "demo");
}

TEST_F(LightPartsTest, EachHoldsWhatItsNameSays)
{
    renderer->load(crowded(), {});
    Frame frame = street();
    frame.weather.rain = 0.9f;
    frame.weather.visibility_m = 60.0f;
    frame.settings.aovs = all_parts();
    const RenderResult r = renderer->render(frame);
    for (const std::string& name : all_parts()) {
        float most = 0.0f;
        for (int i = 0; i < kWidth * kHeight; ++i) {
            most = std::max(most, luminance(part(r, name, i % kWidth, i / kWidth)));
        }
        EXPECT_GT(most, 0.1f) << name;
    }

    // Alone, in clear air: a matt plate, a mirror, a lamp that glows, the sky.
    frame = street();
    frame.settings.samples = 1;
    frame.weather.visibility_m = 1e9f;
    frame.settings.aovs = all_parts();
    Material matt = plain_material(glm::vec3(0.5f), 1.0f);
    matt.lighting_model = "lambert";
    const Material mirror = plain_material(glm::vec3(0.9f), 0.0f, 1.0f);
    Material glowing = plain_material(glm::vec3(0.0f), 1.0f);
    glowing.emissive = glm::vec3(50.0f);
    renderer->load(scene_of({quad({-3, 0, -3}, {2, 0, 0}, {0, 2, 0}, 0),
                             quad({-1, 0, -3}, {2, 0, 0}, {0, 2, 0}, 1),
                             quad({1, 0, -3}, {2, 0, 0}, {0, 2, 0}, 2)},
                            {matt, mirror, glowing}),
                   {});
    frame.camera = look({0, 1, 3}, {0, 1, -3}, 0.9f);
    const RenderResult apart = renderer->render(frame);
    const auto at = [&](int x, int y, const char* name) { return luminance(part(apart, name, x, y)); };
    const int middle = kHeight / 2, left = kWidth / 2 - 22, right = kWidth / 2 + 22;
    EXPECT_GT(at(left, middle, "diffuse_indirect"), 1.0f);
    EXPECT_EQ(at(left, middle, "specular_indirect"), 0.0f);
    EXPECT_EQ(at(left, middle, "specular_direct"), 0.0f);
    EXPECT_EQ(at(kWidth / 2, middle, "diffuse_direct"), 0.0f);
    EXPECT_GT(at(kWidth / 2, middle, "specular_indirect"), 1.0f);
    EXPECT_NEAR(at(right, middle, "emitted"), 50.0f, 0.1f);
    EXPECT_EQ(at(right, middle, "background"), 0.0f);
    EXPECT_GT(at(left, 1, "background"), 1.0f);
    EXPECT_EQ(at(left, 1, "diffuse_indirect"), 0.0f);
}

// A mirror for a floor; walls of two materials and the sky behind it.
TEST_F(ReflectionLabel, AThingInAPuddleIsThatThing)
{
    Material water = plain_material(glm::vec3(0.02f), 0.0f);
    Scene scene = scene_of({quad({-6, 0, 3}, {12, 0, 0}, {0, 0, -12}, 0),
                            quad({-6, 0, -8}, {5, 0, 0}, {0, 2, 0}, 1),
                            quad({1, 0, -8}, {5, 0, 0}, {0, 2, 0}, 2)},
                           {water, plain_material({0.7f, 0.2f, 0.1f}, 1.0f),
                            plain_material({0.1f, 0.3f, 0.6f}, 1.0f)});
    for (const bool wet : {false, true}) {
        // Dry it is a floor of polished stone, in the rain a puddle on it.
        scene.materials[0].roughness = wet ? 0.9f : 0.0f;
        scene.materials[0].weather.water_accumulation = {1.5f, 0.0f, 2.0f, 0.0f};
        renderer->load(scene, {});
        Frame frame = street();
        frame.settings.samples = 1;
        frame.settings.shelter = false;
        frame.camera = look({0, 1.2f, 3}, {0, 0.2f, -8}, 0.8f);
        if (wet) frame.weather.film_albedo = 0.85f;
        const RenderResult alone = renderer->render(frame);
        frame.settings.aovs = {"reflection", "material", "position", "water"};
        const RenderResult r = renderer->render(frame);
        EXPECT_EQ(alone.beauty, r.beauty) << "asking changes nothing";
        const glm::vec3 eye(frame.camera.to_world[3]);
        int asked = 0, right = 0, walls[3] = {};
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                const float material = aov(r, "material", x, y);
                const float label = aov(r, "reflection", x, y);
                if (material != 0.0f) {
                    EXPECT_EQ(label, -1.0f) << "the sky and what is matt mirror nothing";
                    EXPECT_EQ(aov(r, "reflection", x, y, 1), 0.0f);
                }
                if (material != 0.0f || (wet && aov(r, "water", x, y) < 0.95f)) continue;
                const glm::vec3 at(aov(r, "position", x, y, 0), 0.0f, aov(r, "position", x, y, 2));
                glm::vec3 ray = glm::normalize(at - eye);
                ray.y = -ray.y;
                const glm::vec3 met = at + ray * ((-8.0f - at.z) / ray.z);
                if (std::abs(met.x) > 5.0f || std::abs(std::abs(met.x) - 1.0f) < 0.4f ||
                    std::abs(met.y - 2.0f) < 0.3f || met.y < 0.2f) {
                    continue;  // at an edge
                }
                const float wanted = met.y > 2.0f || std::abs(met.x) < 1.0f ? -2.0f
                                     : met.x < 0.0f                        ? 1.0f
                                                                           : 2.0f;
                ++asked;
                right += label == wanted ? 1 : 0;
                walls[wanted < 0.0f ? 0 : static_cast<int>(wanted)] += 1;
                // Fresnel's share of a level surface.
                const float share = 0.02f + 0.98f * std::pow(1.0f + glm::normalize(at - eye).y, 5.0f);
                if (wet) {
                    EXPECT_NEAR(aov(r, "reflection", x, y, 1), share, 0.3f * share + 0.02f);
                }
            }
        }
        ASSERT_GT(std::min({walls[0], walls[1], walls[2]}), 20) << wet;
        EXPECT_GT(right, asked * 95 / 100) << wet << ": " << right << " of " << asked;
    }
}

}  // namespace
}  // namespace petrichor::gpu
