// Surfaces of users' own: what their two functions may change, and what is said of wrong ones.
#include <cmath>
#include <filesystem>
#include <fstream>

#include "tests/gpu/own_text_fixture.h"

namespace petrichor::gpu {
namespace {

namespace fs = std::filesystem;

constexpr int kSize = 48;

class OwnSurface : public OwnTextTest {
protected:
    std::string write(const std::string& name, const std::string& text) const
    {
        return OwnTextTest::write(
            name, "#include \"gpu/passes/surface/own_surface.glsl\"\n" + text);
    }
    std::string refusal(const std::string& surface) const
    {
        Material material = plain_material(glm::vec3(0.5f));
        material.surface = surface;
        return refusal_of(material);
    }
    // Two floors side by side, the left of the given surface; 2 m straight from above.
    RenderResult seen(const std::string& surface, const shared::WeatherMoment& weather,
                      std::vector<std::string> aovs, float roughness = 0.8f, float metallic = 0.0f)
    {
        Material own = plain_material(glm::vec3(0.5f), roughness, metallic);
        own.surface = surface;
        own.weather.default_height = 0.0f;
        Material other = own;
        other.surface = "";
        renderer->load(scene_of({quad({-1, 0, 1}, {1, 0, 0}, {0, 0, -2}, 0),
                                 quad({0, 0, 1}, {1, 0, 0}, {0, 0, -2}, 1)},
                                {own, other}),
                       {});
        Frame frame;
        frame.camera = look({0, 2, 0}, {0, 0, 0});
        frame.camera.orthographic_height_m = 2.0f;
        frame.settings.width = frame.settings.height = kSize;
        frame.settings.samples = 1;
        frame.settings.shelter = false;
        frame.settings.aovs = std::move(aovs);
        frame.weather = weather;
        return renderer->render(frame);
    }
    static float half(const RenderResult& r, const std::string& name, bool right, int channel = 0)
    {
        float sum = 0.0f;
        for (int y = 2; y < kSize - 2; ++y) {
            for (int x = right ? 26 : 2; x < (right ? 46 : 22); ++x) sum += aov(r, name, x, y, channel);
        }
        return sum / (20.0f * (kSize - 4));
    }
    static std::string example(const std::string& name)
    {
        return std::string(PETRICHOR_SOURCE_DIR) + "/data/shaders/" + name;
    }

};

TEST_F(OwnSurface, ChangesWhatItsFunctionsSay)
{
    const std::string file = write("half.glsl", R"(
void half_input(inout SurfaceInput at) { at.weather.g = 0.0; }
void half_surface(SurfaceInput at, inout SurfaceData data)
{
    data.texel.base_color = vec3(0.1, 0.2, 0.3);
    data.texel.roughness = 0.25;
})");
    shared::WeatherMoment wet;
    wet.flood_puddles = 1.0f;
    const auto r = seen(file, wet, {"base_color", "roughness", "water"});
    EXPECT_NEAR(half(r, "base_color", false, 2), 0.3f, 0.01f);
    EXPECT_NEAR(half(r, "roughness", false), 0.25f, 0.01f);
    EXPECT_EQ(half(r, "water", false), 0.0f) << "no puddles where the mask says none";
    EXPECT_NEAR(half(r, "base_color", true, 2), 0.5f, 0.01f) << "the other is as it is";
    EXPECT_GT(half(r, "water", true), 0.5f);
}

// No material of the scene glows: what the text sends out is seen all the same.
TEST_F(OwnSurface, MayGlowInASceneWithoutLightOfItsOwn)
{
    const std::string file = write("lit.glsl", R"(
void lit_input(inout SurfaceInput at) {}
void lit_surface(SurfaceInput at, inout SurfaceData data) { data.emission = vec3(0.0, 300.0, 0.0); })");
    const auto r = seen(file, {}, {"emission"});
    EXPECT_NEAR(half(r, "emission", false, 1), 300.0f, 1.0f);
    EXPECT_EQ(half(r, "emission", true, 1), 0.0f);
    EXPECT_GT(pixel(r, 10, 24).g - pixel(r, 10, 24).r, pixel(r, 36, 24).g - pixel(r, 36, 24).r);
}

// A surface that changes nothing gives the picture of the resolve without it, bit by bit.
TEST_F(OwnSurface, OneThatDoesNothingChangesNothing)
{
    const std::string file = write("idle.glsl", R"(
void idle_input(inout SurfaceInput at) {}
void idle_surface(SurfaceInput at, inout SurfaceData data) {})");
    shared::WeatherMoment weather;
    weather.rain = 0.7f;
    weather.film_albedo = weather.film_smoothness = 0.8f;
    weather.flood_puddles = 0.6f;
    const auto own = seen(file, weather, {"base_color"});
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < 20; ++x) {
            EXPECT_EQ(aov(own, "base_color", x, y), aov(own, "base_color", x + 25, y));
        }
    }
}

TEST_F(OwnSurface, MistakesAreToldWithTheirFileAndLine)
{
    EXPECT_NE(refusal("moss.png").find("GLSL"), std::string::npos);
    EXPECT_NE(refusal((folder / "missing.glsl").string()).find("missing.glsl"), std::string::npos);
    EXPECT_NE(refusal(write("lone.glsl", "void lone_input(inout SurfaceInput at) {}\n")).find("lone_surface"),
              std::string::npos);
    EXPECT_NE(refusal(write("2.glsl", "")).find("cannot name"), std::string::npos);
    const std::string wrong = refusal(write("wrong.glsl", R"(
void wrong_input(inout SurfaceInput at) { at.nothing = 1.0; }
void wrong_surface(SurfaceInput at, inout SurfaceData data) {})"));
    EXPECT_NE(wrong.find("wrong.glsl"), std::string::npos) << wrong;
    EXPECT_NE(wrong.find("3"), std::string::npos) << wrong;
}

TEST_F(OwnSurface, MossGrowsWhereItIsDampAndKeepsPuddlesOff)
{
    shared::WeatherMoment wet;
    wet.flood_puddles = 1.0f;
    const auto r = seen(example("moss.glsl"), wet, {"base_color", "water", "roughness"});
    int green = 0;
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < 22; ++x) {
            const bool moss = aov(r, "base_color", x, y, 1) > 1.2f * aov(r, "base_color", x, y, 0);
            green += moss;
            if (aov(r, "base_color", x, y, 0) < 0.12f) {
                EXPECT_LT(aov(r, "water", x, y), 0.2f);
            }
        }
    }
    EXPECT_GT(green, 22 * kSize / 10);
    EXPECT_LT(half(r, "water", false), half(r, "water", true));
}

// The example that uses everything: each of what a surface may change differs from the same one without it.
TEST_F(OwnSurface, EmbersUseEverything)
{
    Material own = plain_material(glm::vec3(0.5f), 0.3f, 0.0f);
    own.emissive = glm::vec3(0.01f, 0.0f, 0.0f);
    own.surface = example("ember.glsl");
    Material other = own;
    other.surface = "";
    renderer->load(scene_of({quad({-1, 0, 1}, {1, 0, 0}, {0, 0, -2}, 0),
                             quad({0, 0, 1}, {1, 0, 0}, {0, 0, -2}, 1)},
                            {own, other}),
                   {});
    Frame frame;
    frame.camera = look({0, 2, 0}, {0, 0, 0});
    frame.camera.orthographic_height_m = 2.0f;
    frame.settings.width = frame.settings.height = kSize;
    frame.settings.samples = 1;
    frame.settings.shelter = false;
    frame.settings.aovs = {"base_color", "normal",   "roughness", "metallic", "porosity",
                           "occlusion",  "emission", "water",     "snow"};
    frame.weather.flood_puddles = 1.5f;
    frame.weather.snow_amount = 0.7f;
    frame.weather.wind_m_s = {6.0f, 0.0f};
    const RenderResult r = renderer->render(frame);
    EXPECT_LT(half(r, "base_color", false), 0.5f * half(r, "base_color", true));
    EXPECT_LT(half(r, "normal", false, 1), 0.999f);
    EXPECT_GT(half(r, "roughness", false), half(r, "roughness", true) + 0.3f);
    EXPECT_GT(half(r, "metallic", false), half(r, "metallic", true) + 0.005f);
    EXPECT_GT(half(r, "porosity", false), half(r, "porosity", true) + 0.1f);
    EXPECT_LT(half(r, "occlusion", false), half(r, "occlusion", true) - 0.02f);
    EXPECT_GT(half(r, "emission", false), half(r, "emission", true) + 50.0f);
    EXPECT_LT(half(r, "water", false), half(r, "water", true));
    EXPECT_LT(half(r, "snow", false), half(r, "snow", true));
    // It pulses with the time and is fanned by the wind.
    frame.settings.time_s = 0.9;
    EXPECT_NE(half(renderer->render(frame), "emission", false), half(r, "emission", false));
    frame.settings.time_s = 0.0;
    frame.weather.wind_m_s = {0.0f, 0.0f};
    EXPECT_LT(half(renderer->render(frame), "emission", false), half(r, "emission", false));
}

TEST_F(OwnSurface, RustIsNoMetal)
{
    const auto r = seen(example("rust.glsl"), {}, {"metallic", "roughness"}, 0.3f, 1.0f);
    EXPECT_LT(half(r, "metallic", false), 0.95f);
    EXPECT_GT(half(r, "roughness", false), 0.32f);
    EXPECT_NEAR(half(r, "metallic", true), 1.0f, 0.01f);
}

TEST_F(OwnSurface, TheWindSweepsSnowOff)
{
    shared::WeatherMoment snow;
    snow.snow_amount = 0.6f;
    const auto still = seen(example("windswept.glsl"), snow, {"snow"});
    EXPECT_NEAR(half(still, "snow", false), half(still, "snow", true), 0.15f);
    snow.wind_m_s = {9.0f, 0.0f};
    const auto windy = seen(example("windswept.glsl"), snow, {"snow"});
    EXPECT_LT(half(windy, "snow", false), 0.8f * half(windy, "snow", true));
}

// Four strips side by side: foam, shallow, still and deep water. The mask is told by vertices.
TEST_F(OwnSurface, ShoreWaterHasFoamShallowsAndWaves)
{
    Material sea = plain_material(glm::vec3(0.5f));
    sea.surface = example("shore_water.glsl");
    const glm::vec4 masks[] = {{1, 1, 1, 0}, {0, 1, 1, 0}, {0, 1, 0, 0}, {0, 1, 1, 1}};
    std::vector<Primitive> strips;
    for (int i = 0; i < 4; ++i) {
        strips.push_back(quad({2.0f * static_cast<float>(i) - 4.0f, 0, 4}, {2, 0, 0}, {0, 0, -8}));
        strips.back().colors.assign(4, masks[i]);
    }
    renderer->load(scene_of(strips, {sea}), {});
    Frame frame;
    frame.camera = look({0, 5, 0}, {0, 0, 0});
    frame.camera.orthographic_height_m = 8.0f;
    frame.settings.width = frame.settings.height = 96;
    frame.settings.samples = 1;
    frame.settings.aovs = {"base_color", "roughness", "normal", "water", "snow"};
    frame.weather.flood_puddles = 1.0f;
    frame.weather.snow_amount = 1.0f;
    frame.weather.wind_m_s = {4.0f, 1.0f};
    struct Strip {
        float color = 0.0f, roughness = 0.0f, leaning = 0.0f, cover = 0.0f;
    };
    const auto strip = [&](const RenderResult& r, int number) {
        Strip sum;
        for (int y = 2; y < 94; ++y) {
            for (int x = 24 * number + 2; x < 24 * number + 22; ++x) {
                sum.color += aov(r, "base_color", x, y, 1) / 1840.0f;
                sum.roughness += aov(r, "roughness", x, y) / 1840.0f;
                sum.leaning += std::hypot(aov(r, "normal", x, y, 0), aov(r, "normal", x, y, 2)) / 1840.0f;
                sum.cover += aov(r, "water", x, y) + aov(r, "snow", x, y);
            }
        }
        return sum;
    };
    const RenderResult r = renderer->render(frame);
    const Strip foam = strip(r, 0), shallow = strip(r, 1), still = strip(r, 2), deep = strip(r, 3);
    EXPECT_GT(foam.color, 1.3f * shallow.color);
    EXPECT_GT(foam.roughness, 1.2f * shallow.roughness);
    EXPECT_GT(shallow.color, 3.0f * deep.color);
    EXPECT_GT(shallow.leaning, 0.02f);
    EXPECT_LT(still.leaning, 0.002f);
    EXPECT_EQ(foam.cover + shallow.cover + still.cover + deep.cover, 0.0f);

    frame.settings.time_s = 0.5;
    const RenderResult later = renderer->render(frame);
    EXPECT_NE(aov(later, "normal", 36, 48), aov(r, "normal", 36, 48));
    EXPECT_NEAR(strip(later, 1).leaning, shallow.leaning, 0.3f * shallow.leaning);
    frame.weather.wind_m_s = {14.0f, 3.0f};
    EXPECT_GT(strip(renderer->render(frame), 3).leaning, 1.5f * deep.leaning);
}

// What is blended has a surface of its own, too: so much of what glows behind comes through, in this colour.
TEST_F(OwnSurface, OfWhatIsBlendedSaysWhatItLetsThrough)
{
    Material glow = plain_material(glm::vec3(1.0f));
    glow.unlit = true;
    Material sheet = plain_material(glm::vec3(0.0f));
    sheet.alpha_mode = AlphaMode::Blend;
    sheet.base_color.a = 0.9f;
    const std::string text = R"(
#include "gpu/passes/surface/own_surface.glsl"
void sheet_input(inout SurfaceInput at) {}
void sheet_surface(SurfaceInput at, inout SurfaceData data)
{
    data.opacity = at.position.x < 0.0 ? -1.0 : 0.25;
    data.filtered = vec3(1.0, 0.5, 0.0);
    data.texel.f0 = vec3(0.0);
    data.texel.base_color = vec3(0.0);
}
)";
    sheet.surface = write("sheet.glsl", text);
    renderer->load(scene_of({quad({-3, 0, 3}, {6, 0, 0}, {0, 0, -6}, 0), quad({-3, 1, 3}, {6, 0, 0}, {0, 0, -6}, 1)},
                            {glow, sheet}),
                   {});
    Frame frame;
    frame.camera = look({0, 5, 0}, {0, 0, 0});
    frame.camera.orthographic_height_m = 2.0f;
    frame.settings.width = frame.settings.height = 32;
    frame.settings.samples = 1;
    frame.settings.image_based_light = false;
    frame.settings.exposure = 1.0f;
    frame.sky.analytic_sun = false;
    frame.weather.visibility_m = 1e9f;
    const RenderResult r = renderer->render(frame);
    const glm::vec3 by_alpha = pixel(r, 8, 16), by_itself = pixel(r, 24, 16);
    EXPECT_NEAR(by_alpha.r, 0.1f, 0.002f);
    EXPECT_NEAR(by_itself.r, 0.75f, 0.005f);
    EXPECT_NEAR(by_itself.g, 0.375f, 0.005f);
    EXPECT_NEAR(by_itself.b, 0.0f, 0.001f);
}

// Over sand: clear at the shore, blue where it is deeper, and foam hides it.
TEST_F(OwnSurface, ShoreWaterOverTheGroundShowsIt)
{
    Material sand = plain_material(glm::vec3(0.6f));
    Material sea = plain_material(glm::vec3(0.5f));
    sea.surface = example("shore_water.glsl");
    sea.alpha_mode = AlphaMode::Blend;
    const glm::vec4 masks[] = {{0, 1, 0, 0}, {0, 1, 0, 0.2f}, {0, 1, 0, 1}, {1, 1, 0, 0}};
    std::vector<Primitive> quads{quad({-8, -1, 8}, {16, 0, 0}, {0, 0, -16}, 0)};
    for (int i = 0; i < 4; ++i) {
        quads.push_back(quad({2.0f * static_cast<float>(i) - 4.0f, 0, 4}, {2, 0, 0}, {0, 0, -8}, 1));
        quads.back().colors.assign(4, masks[i]);
    }
    renderer->load(scene_of(quads, {sand, sea}), {});
    renderer->set_environment(constant_environment(1.0f));
    Frame frame;
    frame.camera = look({0, 5, 0}, {0, 0, 0});
    frame.camera.orthographic_height_m = 8.0f;
    frame.settings.width = frame.settings.height = 64;
    frame.settings.samples = 1;
    frame.settings.ambient_occlusion = false;
    frame.sky.analytic_sun = false;
    frame.weather.visibility_m = 1e9f;
    const RenderResult r = renderer->render(frame);
    const auto strip = [&](int i) { return pixel(r, 16 * i + 8, 32); };
    EXPECT_NEAR(strip(0).r, 0.6f, 0.04f) << "the sand alone";
    EXPECT_LT(strip(1).r, 0.6f * strip(0).r);
    EXPECT_GT(strip(1).b, 1.3f * strip(1).r) << "red is gone first";
    EXPECT_LT(strip(2).g, 0.25f * strip(1).g) << "deep";
    EXPECT_GT(strip(3).r + strip(3).g, 0.5f) << "foam";
}

}  // namespace
}  // namespace petrichor::gpu
