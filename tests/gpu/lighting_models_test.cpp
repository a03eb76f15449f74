// Lighting models: the built-in ones, a user's own, and what is said of a bad one.
#include "gpu/lighting/lighting_models.h"

#include <filesystem>
#include <fstream>

#include "tests/gpu/own_text_fixture.h"

namespace petrichor::gpu {
namespace {

namespace fs = std::filesystem;

const std::string kMinnaert = PETRICHOR_SOURCE_DIR "/data/shaders/minnaert.glsl";

class LightingModelsTest : public OwnTextTest {
protected:
    std::size_t cached_shaders() const
    {
        std::size_t count = 0;
        if (!fs::exists(folder / "cache" / "own_shaders")) return 0;
        for (const auto& entry : fs::directory_iterator(folder / "cache" / "own_shaders")) {
            count += entry.path().extension() == ".bin" ? 1u : 0u;
        }
        return count;
    }
    // What load() says of a model.
    std::string refusal(const std::string& model) const
    {
        Material material = plain_material(glm::vec3(0.5f));
        material.lighting_model = model;
        return refusal_of(material);
    }
};

constexpr float kLux = 1000.0f;

// A plate seen from `eye` under one light of kLux straight from above, and nothing else.
Frame lit_plate(const glm::vec3& eye)
{
    Frame frame;
    frame.camera = look(eye, {0, 0, 0}, 0.1f);
    frame.settings.width = 17;
    frame.settings.height = 17;
    frame.settings.samples = 1;
    frame.settings.image_based_light = false;
    frame.settings.shadows = false;
    frame.sky.analytic_sun = false;
    frame.sky.sun_illuminance = 0.0f;
    frame.weather.visibility_m = 1e9f;
    return frame;
}

Scene plate(const Material& material, const glm::vec3& light_direction)
{
    Scene scene = scene_of({quad({-3, 0, 3}, {6, 0, 0}, {0, 0, -6})}, {material});
    Light light;
    light.kind = LightKind::Directional;
    light.intensity = kLux;
    light.direction = glm::normalize(light_direction);
    scene.lights = {light};
    return scene;
}

TEST(LightingModels, NumbersGoByName)
{
    const LightingModels models({"lambert", "", kMinnaert, "unlit", kMinnaert});
    EXPECT_EQ(models.number_of("standard"), 0u);
    EXPECT_EQ(models.number_of(""), 0u);
    EXPECT_EQ(models.number_of("lambert"), 2u);
    EXPECT_EQ(models.number_of(kMinnaert), built_in_lighting_models().size());
    EXPECT_EQ(models.count(), built_in_lighting_models().size() + 1);
}

// The example of data/shaders against its law, written once more in C++.
TEST_F(LightingModelsTest, AUsersOwnModelFollowsItsLaw)
{
    Material material = plain_material({0.25f, 0.5f, 0.81f}, 0.9f);
    material.lighting_model = kMinnaert;
    const glm::vec3 from_light(0.6f, -0.8f, 0.0f);
    renderer->load(plate(material, from_light), {});
    for (const glm::vec3 eye : {glm::vec3(0, 5, 0.01f), glm::vec3(4, 3, 0), glm::vec3(0, 1, -5)}) {
        const glm::vec3 seen = pixel(renderer->render(lit_plate(eye)), 8, 8);
        const float nl = 0.8f;
        const float nv = glm::normalize(eye).y;
        const float k = 1.5f;
        const glm::vec3 expected = glm::vec3(0.25f, 0.5f, 0.81f) / 3.14159265f * std::pow(nl, k) *
                                   std::pow(nv, k - 1.0f) * kLux;
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], expected[c], 0.015f * expected[c]);
    }
    EXPECT_EQ(cached_shaders(), 1u);
    renderer->load(plate(material, from_light), {});
    EXPECT_EQ(cached_shaders(), 1u) << "a second start is warm";
}

TEST_F(LightingModelsTest, APerfectDiffuserMirrorsNothing)
{
    Material material = plain_material(glm::vec3(0.5f), 0.05f);
    material.lighting_model = "lambert";
    renderer->load(plate(material, {0, -1, 0}), {});
    const float above = pixel(renderer->render(lit_plate({0, 5, 0.01f})), 8, 8).g;
    const float aside = pixel(renderer->render(lit_plate({4, 1, 0})), 8, 8).g;
    EXPECT_NEAR(above, kLux * 0.5f / 3.14159265f, 1.0f);
    EXPECT_NEAR(aside, above, 0.5f) << "the same from everywhere";
    // In a constant sky too: E = pi L.
    Scene dark = plate(material, {0, -1, 0});
    dark.lights.clear();
    renderer->load(dark, {});
    renderer->set_environment(constant_environment(2.0f));
    Frame frame = lit_plate({4, 1, 0});
    frame.settings.image_based_light = true;
    frame.settings.ambient_occlusion = false;
    EXPECT_NEAR(pixel(renderer->render(frame), 8, 8).g, 1.0f, 0.02f);
}

TEST_F(LightingModelsTest, UnlitIsTheSameByDayAndByNight)
{
    Material material = plain_material(glm::vec3(0.5f));
    material.unlit = true;
    renderer->load(scene_of({quad({-3, 0, 3}, {6, 0, 0}, {0, 0, -6})}, {material}), {});
    for (const float elevation : {1.0f, 0.05f, -0.4f}) {
        Frame frame = lit_plate({0, 5, 0.01f});
        frame.sky = {};
        frame.sky.sun_elevation_rad = elevation;
        frame.settings.image_based_light = true;
        frame.settings.tone_map = ToneMap::Linear;
        const RenderResult result = renderer->render(frame);
        EXPECT_NEAR(pixel(result, 8, 8).g * result.exposure, 0.5f, 0.01f) << elevation;
        EXPECT_NEAR(result.display[(8 * 17 + 8) * 4], 188, 2) << "sRGB of one half";
    }
}

// Models side by side are what they are alone, and only those in view are compiled.
TEST_F(LightingModelsTest, ModelsStandSideBySide)
{
    std::vector<Material> materials;
    std::vector<Primitive> plates;
    for (const std::string& model : {std::string(), std::string("lambert"), kMinnaert}) {
        Material material = plain_material(glm::vec3(0.5f), 0.3f);
        material.lighting_model = model;
        const auto index = static_cast<std::uint32_t>(materials.size());
        plates.push_back(
            quad({-1.5f + static_cast<float>(index), 0, 1}, {1, 0, 0}, {0, 0, -2}, index));
        materials.push_back(material);
    }
    Scene together = scene_of(plates, materials);
    together.lights = plate(materials[0], {0.3f, -1, 0.2f}).lights;
    Frame frame = lit_plate({0, 4, 0.01f});
    frame.camera = look({0, 4, 0.01f}, {0, 0, 0}, 0.6f);
    frame.settings.width = 48;
    frame.settings.aovs = {"lighting_model"};
    renderer->load(together, {});
    const RenderResult all = renderer->render(frame);
    for (std::size_t i = 0; i < materials.size(); ++i) {
        Scene alone = together;
        alone.meshes[0].primitives = {plates[i]};
        renderer->load(alone, {});
        const RenderResult one = renderer->render(frame);
        int seen = 0;
        for (int x = 0; x < 48; ++x) {
            if (aov(all, "lighting_model", x, 8) != static_cast<float>(i < 1   ? 0u
                                                                           : i < 2 ? 2u
                                                                                   : built_in_lighting_models().size())) {
                continue;
            }
            ++seen;
            EXPECT_EQ(pixel(all, x, 8), pixel(one, x, 8)) << "model " << i << " at " << x;
        }
        EXPECT_GT(seen, 4);
    }
}

TEST_F(LightingModelsTest, ABadModelIsRefusedByFileAndLine)
{
    EXPECT_NE(refusal("lambet").find("standard, unlit, lambert"), std::string::npos);
    EXPECT_NE(refusal((folder / "none.glsl").string()).find("none.glsl"), std::string::npos);
    EXPECT_NE(refusal(write("empty.glsl", "")).find("empty_light"), std::string::npos);
    EXPECT_NE(refusal(write("2d.glsl", "")).find("2d"), std::string::npos);
    EXPECT_NE(refusal(write("half.glsl", "half_gather half_surround half_own")).find("half_compose"), std::string::npos);
    const std::string bad = write("bad.glsl",
                                  "#include \"gpu/lighting/models/lighting_model.glsl\"\n"
                                  "vec3 bad_light(LitPoint p, vec3 l) { return wrong; }\n"
                                  "vec3 bad_own(LitPoint p) { return vec3(0); }\n"
                                  "Reflected bad_surround(LitPoint p, Surroundings s)\n"
                                  "{ return Reflected(vec3(0), vec3(0)); }\n");
    const std::string said = refusal(bad);
    EXPECT_NE(said.find("bad.glsl:2"), std::string::npos) << said;
    EXPECT_NE(said.find("wrong"), std::string::npos) << said;
    EXPECT_EQ(cached_shaders(), 0u);
}

// Macros that unfold without end are stopped by the compiler's limits, not by ours running out.
TEST_F(LightingModelsTest, ATextThatUnfoldsWithoutEndIsStopped)
{
    std::string text = "#define A0 1.0+1.0\n";
    for (int i = 1; i < 40; ++i) {
        const std::string before = "A" + std::to_string(i - 1);
        text += "#define A" + std::to_string(i) + " " + before + "+" + before + "\n";
    }
    text += "float bomb_light_surround_own_bomb_surround_bomb_own = A39;\n";
    EXPECT_NE(refusal(write("bomb.glsl", text)), "");
}

// What a model that gathers makes of the sum is plain to see: its root.
constexpr const char* kRoot = R"(
#include "gpu/lighting/models/lighting_model.glsl"
LightSum NAME_gather(LitPoint p, vec3 to_light)
{
    const float nl = clamp(dot(p.normal, to_light), 0.0, 1.0);
    return LightSum(vec3(nl), vec3(nl > 0.0 ? 2.0 : 0.0));
}
vec3 NAME_compose(LitPoint p, LightSum sum) { return p.albedo * sqrt(sum.diffuse) + sqrt(sum.specular); }
Reflected NAME_surround(LitPoint p, Surroundings s) { return Reflected(vec3(0.0), vec3(0.0)); }
vec3 NAME_own(LitPoint p) { return vec3(0.0); }
)";

std::string named(std::string text, const std::string& name)
{
    for (std::size_t at = 0; (at = text.find("NAME", at)) != std::string::npos;) text.replace(at, 4, name);
    return text;
}

Light from_above(float lux, float slant)
{
    Light light;
    light.kind = LightKind::Directional;
    light.intensity = lux;
    light.direction = glm::normalize(glm::vec3(slant, -1.0f, 0.0f));
    return light;
}

// The light of a sun (the stronger one) and of a lamp is gathered before the material is asked; by the other path
// each is answered alone.
// data/shaders/blinn_phong.glsl against its law, gathered first and light by light.
TEST_F(LightingModelsTest, BlinnPhongFollowsItsLaw)
{
    for (const float roughness : {0.3f, 0.8f}) {
        Material material = plain_material({0.25f, 0.5f, 0.81f}, roughness, 0.0f);
        material.lighting_model = PETRICHOR_SOURCE_DIR "/data/shaders/blinn_phong.glsl";
        const glm::vec3 from_light(0.6f, -0.8f, 0.0f);
        renderer->load(plate(material, from_light), {});
        for (const glm::vec3 eye : {glm::vec3(3.2f, 4, 0), glm::vec3(4, 3, 0), glm::vec3(0, 1, -5)}) {
            Frame frame = lit_plate(eye);
            frame.settings.aovs = {"lighting_path"};
            const float nh = glm::normalize(glm::normalize(eye) - from_light).y;
            const float shine = 0.04f * std::pow(nh, 128.0f * (1.0f - roughness));
            const glm::vec3 expected = (glm::vec3(0.25f, 0.5f, 0.81f) * 0.8f + shine) / 3.14159265f * kLux;
            for (const bool prepass : {true, false}) {
                frame.settings.light_prepass = prepass;
                const RenderResult result = renderer->render(frame);
                const glm::vec3 seen = pixel(result, 8, 8);
                for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], expected[c], 0.015f * expected[c]) << roughness << " " << prepass;
                EXPECT_EQ(aov(result, "lighting_path", 8, 8), prepass ? 1.0f : 2.0f);
            }
        }
    }
}

// A picture that tells who is lit from the G-buffer, who gathers light first, who is asked light by light.
TEST_F(LightingModelsTest, AnOutputTellsThePathsOfLightApart)
{
    Material ours = plain_material(glm::vec3(0.5f)), own = ours, gathers = ours;
    own.lighting_model = kMinnaert;
    gathers.lighting_model = PETRICHOR_SOURCE_DIR "/data/shaders/toon.glsl";
    Scene scene = scene_of({quad({-3, 0, 1}, {2, 0, 0}, {0, 0, -2}, 0), quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, 1),
                            quad({1, 0, 1}, {2, 0, 0}, {0, 0, -2}, 2)},
                           {ours, own, gathers});
    renderer->load(scene, {});
    Frame frame = lit_plate({0, 5, 0.01f});
    frame.camera = look({0, 5, 0.01f}, {0, 0, 0}, 0.9f);
    frame.settings.width = 60;
    frame.settings.height = 30;
    frame.settings.aovs = {"lighting_path", "lighting_model"};
    const RenderResult result = renderer->render(frame);
    EXPECT_EQ(aov(result, "lighting_path", 12, 15), 0.0f);
    EXPECT_EQ(aov(result, "lighting_path", 30, 15), 2.0f);
    EXPECT_EQ(aov(result, "lighting_path", 48, 15), 1.0f);
    EXPECT_EQ(aov(result, "lighting_path", 30, 1), -1.0f) << "nothing there";
}

TEST_F(LightingModelsTest, AModelThatGathersIsComposedOnce)
{
    Material material = plain_material(glm::vec3(0.25f), 0.9f);
    material.lighting_model = write("root.glsl", named(kRoot, "root"));
    Scene scene = plate(material, {0, -1, 0});
    scene.lights = {from_above(300.0f, 0.5f), from_above(500.0f, -0.2f)};
    renderer->load(scene, {});
    Frame frame = lit_plate({0, 5, 0.01f});
    const auto answer = [](float diffuse, float specular) {
        return 0.25f * std::sqrt(diffuse) + std::sqrt(specular);
    };
    const float one = 300.0f / std::sqrt(1.25f), other = 500.0f / std::sqrt(1.04f);
    const float lamps = pixel(renderer->render(frame), 8, 8).g;
    EXPECT_NEAR(lamps, answer(one + other, 1600.0f), 0.01f * lamps);
    frame.settings.light_prepass = false;
    const float apart = pixel(renderer->render(frame), 8, 8).g;
    const float expected = 300.0f * answer(one / 300.0f, 2.0f) + 500.0f * answer(other / 500.0f, 2.0f);
    EXPECT_NEAR(apart, expected, 0.01f * expected) << "light by light";
}

// A model without that form answers light by light, beside one that has it and whatever the path.
TEST_F(LightingModelsTest, AModelThatCannotGatherAnswersLightByLight)
{
    Material plain = plain_material(glm::vec3(0.5f), 0.3f), root = plain, standard = plain;
    plain.lighting_model = kMinnaert;
    root.lighting_model = write("root.glsl", named(kRoot, "root"));
    Scene scene = scene_of({quad({-1.5f, 0, 1}, {1, 0, 0}, {0, 0, -2}, 0), quad({-0.5f, 0, 1}, {1, 0, 0}, {0, 0, -2}, 1),
                            quad({0.5f, 0, 1}, {1, 0, 0}, {0, 0, -2}, 2)},
                           {plain, root, standard});
    scene.lights = {from_above(300.0f, 0.5f), from_above(500.0f, -0.2f)};
    Light lamp;
    lamp.position_m = {0.0f, 1.5f, 0.3f};
    lamp.intensity = 200.0f;
    scene.lights.push_back(lamp);
    renderer->load(scene, {});
    Frame frame = lit_plate({0, 4, 0.01f});
    frame.camera = look({0, 4, 0.01f}, {0, 0, 0}, 0.6f);
    frame.settings.width = 48;
    frame.weather.film_albedo = frame.weather.film_smoothness = 0.8f;
    const RenderResult gathered = renderer->render(frame);
    frame.settings.light_prepass = false;
    const RenderResult apart = renderer->render(frame);
    int same = 0, other = 0;
    for (int x = 2; x < 46; ++x) {
        if (x > 17 && x < 30) {
            other += pixel(gathered, x, 8) != pixel(apart, x, 8);
        } else if (x < 14 || x > 33) {
            EXPECT_EQ(pixel(gathered, x, 8), pixel(apart, x, 8)) << x;
            ++same;
        }
    }
    EXPECT_GT(same, 15);
    EXPECT_GT(other, 4);
}

// Water over such a model keeps its own highlight, which is not composed; parts of light add up to the picture.
TEST_F(LightingModelsTest, WhatLiesOverAModelThatGathersIsNoPartOfIt)
{
    Material black = plain_material(glm::vec3(0.0f), 0.5f);
    std::string text = named(kRoot, "dark");
    text.replace(text.find("p.albedo * sqrt(sum.diffuse) + sqrt(sum.specular)"), 49, "vec3(0.0) * sum.diffuse");
    black.lighting_model = write("dark.glsl", text);
    Scene scene = plate(black, {0, -1, 0});
    Light lamp;
    lamp.position_m = {0.0f, 3.0f, 0.0f};
    lamp.intensity = 500.0f;
    scene.lights = {lamp};
    renderer->load(scene, {});
    Frame frame = lit_plate({0, 5, 0.01f});
    const float dry = pixel(renderer->render(frame), 8, 8).g;
    EXPECT_NEAR(dry, 0.0f, 1.0e-4f);
    frame.weather.film_albedo = frame.weather.film_smoothness = 0.8f;
    frame.settings.aovs = {"diffuse_direct", "specular_direct"};
    const RenderResult wet = renderer->render(frame);
    frame.settings.light_prepass = false;
    const RenderResult apart = renderer->render(frame);
    const float seen = pixel(wet, 8, 8).g;
    EXPECT_GT(seen, 0.1f) << "the water's";
    EXPECT_NEAR(seen, pixel(apart, 8, 8).g, 0.002f * seen) << "which is added light by light";
    EXPECT_NEAR(aov(wet, "diffuse_direct", 8, 8) + aov(wet, "specular_direct", 8, 8), seen, 0.002f * seen);
}

// The example of data/shaders: two lamps that are too dim for the first band each reach it together.
TEST_F(LightingModelsTest, TheToonStepsUpWithTheSum)
{
    Material material = plain_material(glm::vec3(0.8f), 1.0f);
    material.lighting_model = PETRICHOR_SOURCE_DIR "/data/shaders/toon.glsl";
    Scene scene = plate(material, {0, -1, 0});
    const float dim = 0.15f * 3.14159265f;
    Frame frame = lit_plate({0, 5, 0.01f});
    frame.settings.exposure = 1.0f;
    for (int lamps = 1; lamps <= 4; ++lamps) {
        scene.lights.assign(static_cast<std::size_t>(lamps), from_above(dim, 0.0f));
        renderer->load(scene, {});
        const float bands = std::floor(0.15f * static_cast<float>(lamps) * 4.0f);
        EXPECT_NEAR(pixel(renderer->render(frame), 8, 8).g, 0.8f * bands / 4.0f, 0.005f) << lamps;
    }
}

// A leaf between the eye and a lamp: black with an opaque leaf, lit with one that lets light through.
TEST_F(LightingModelsTest, ALeafBeforeALampIsLitFromBehind)
{
    Material leaf = plain_material(glm::vec3(0.5f), 1.0f);
    leaf.double_sided = true;
    Frame frame;
    frame.camera = look({0, 0, 3}, {0, 0, 0});
    frame.settings.width = frame.settings.height = 16;
    frame.settings.image_based_light = false;
    frame.settings.exposure = 1.0f;
    frame.sky.analytic_sun = false;
    Light lamp;
    lamp.position_m = {0, 0, -2};
    lamp.intensity = 40.0f;
    frame.extra_lights.push_back(lamp);
    const auto seen = [&](const Material& material) {
        renderer->load(scene_of({quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0})}, {material}), {});
        return pixel(renderer->render(frame), 8, 8).g;
    };
    EXPECT_EQ(seen(leaf), 0.0f);
    leaf.diffuse_transmission = 0.4f;
    // 10 lux; 0.04 of it are mirrored at the front. White, whatever the base colour, as the extension has it.
    const float through = 0.96f * 0.4f / 3.14159f * 10.0f;
    EXPECT_NEAR(seen(leaf), through, 0.01f);
    leaf.diffuse_transmission_color = {0.0f, 0.3f, 0.0f};
    EXPECT_NEAR(seen(leaf), 0.3f * through, 0.005f);
    leaf.diffuse_transmission_of_base = true;
    EXPECT_NEAR(seen(leaf), 0.5f * through, 0.01f) << "in eight bits";
    leaf.metallic = 1.0f;
    EXPECT_NEAR(seen(leaf), 0.0f, 1e-4f) << "metal lets none through";
    leaf.metallic = 0.0f;
    leaf.lighting_model = "standard";
    EXPECT_EQ(seen(leaf), 0.0f) << "who names a model gets it";
}

}  // namespace
}  // namespace petrichor::gpu
