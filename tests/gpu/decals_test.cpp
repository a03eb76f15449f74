// Decals: what is laid over the surfaces, by triangles and by boxes.
#include <cmath>
#include <functional>

#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

class Decals : public GpuTest {
protected:
    RenderResult shot(const Scene& scene, const Frame& frame,
                      const std::vector<Texture>& textures = {})
    {
        renderer->load(scene, textures);
        return renderer->render(frame);
    }
};

constexpr int kSize = 64;
constexpr int kMiddle = kSize / 2;

// Straight from above, 2 m of the ground.
Frame from_above()
{
    Frame frame;
    frame.camera = look({0, 2, 0}, {0, 0, 0});
    frame.camera.orthographic_height_m = 2.0f;
    frame.settings.width = frame.settings.height = kSize;
    frame.settings.samples = 1;
    frame.settings.aovs = {"base_color", "normal", "roughness", "occlusion", "porosity",
                           "water",      "snow",   "emission",  "depth",     "lighting_model"};
    return frame;
}

Primitive ground()
{
    return quad({-4, 0, 4}, {8, 0, 0}, {0, 0, -8});
}

Material laid(const glm::vec3& color, float alpha, float roughness = 0.2f)
{
    Material m = plain_material(color, roughness);
    m.base_color.a = alpha;
    m.alpha_mode = AlphaMode::Blend;
    m.decal.on = true;
    return m;
}

// A square of 1 m in the middle, so high above the ground.
Primitive square(float height_m, std::uint32_t material)
{
    return quad({-0.5f, height_m, 0.5f}, {1, 0, 0}, {0, 0, -1}, material);
}

ProjectedDecal box(std::uint32_t material, const glm::vec3& size = glm::vec3(1.0f))
{
    ProjectedDecal decal;
    decal.material = material;
    // Its z is up, its y to the north.
    decal.to_world = glm::mat4(glm::vec4(size.x, 0, 0, 0), glm::vec4(0, 0, -size.y, 0),
                               glm::vec4(0, size.z, 0, 0), glm::vec4(0, 0, 0, 1));
    return decal;
}

Texture texture_of(const std::function<glm::ivec4(int, int)>& texel)
{
    Texture texture;
    texture.name = "made up";
    texture.format = TexelFormat::Rgba8Unorm;
    texture.width = texture.height = 64;
    texture.mips.emplace_back();
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            for (int c = 0; c < 4; ++c)
                texture.mips[0].push_back(static_cast<std::byte>(texel(x, y)[c]));
        }
    }
    return texture;
}

double largest_difference(const RenderResult& a, const RenderResult& b, const std::string& name)
{
    double largest = 0.0;
    for (int y = 0; y < a.height; ++y) {
        for (int x = 0; x < a.width; ++x)
            largest = std::max(
                largest, static_cast<double>(std::abs(aov(a, name, x, y) - aov(b, name, x, y))));
    }
    return largest;
}

TEST_F(Decals, MixTheMaterialBelowInLinearLight)
{
    Material below = plain_material(glm::vec3(0.1f, 0.5f, 0.9f), 0.8f);
    Material above = laid(glm::vec3(0.9f, 0.1f, 0.5f), 0.5f);
    const RenderResult r =
        shot(scene_of({ground(), square(0.002f, 1)}, {below, above}), from_above());
    EXPECT_NEAR(aov(r, "base_color", kMiddle, kMiddle, 0), 0.5f, 0.005f);
    EXPECT_NEAR(aov(r, "base_color", kMiddle, kMiddle, 1), 0.3f, 0.005f);
    EXPECT_NEAR(aov(r, "base_color", kMiddle, kMiddle, 2), 0.7f, 0.005f);
    EXPECT_NEAR(aov(r, "roughness", kMiddle, kMiddle), 0.5f, 0.005f);
    // It is no surface: the ground stays the nearest thing, with its own lighting model.
    EXPECT_NEAR(aov(r, "depth", kMiddle, kMiddle), 2.0f, 1e-4f);
    EXPECT_EQ(aov(r, "lighting_model", kMiddle, kMiddle), aov(r, "lighting_model", 2, 2));
    EXPECT_NEAR(aov(r, "base_color", 2, 2), 0.1f, 0.003f);
    EXPECT_NEAR(aov(r, "roughness", 2, 2), 0.8f, 0.003f);
}

TEST_F(Decals, BothSurfacePathsTakeThem)
{
    const Scene scene = [&] {
        Scene s = scene_of({ground(), square(0.002f, 1)},
                           {plain_material(glm::vec3(0.5f)), laid(glm::vec3(0.9f, 0.1f, 0.1f), 0.7f)});
        s.decals.push_back(box(1, {0.4f, 1.8f, 1.0f}));
        return s;
    }();
    Frame frame = from_above();
    frame.settings.surface_path = SurfacePath::Fragment;
    const RenderResult fragment = shot(scene, frame);
    frame.settings.surface_path = SurfacePath::Visibility;
    const RenderResult visibility = shot(scene, frame);
    EXPECT_GT(aov(fragment, "base_color", kMiddle, kMiddle), 0.8f);
    for (const char* name : {"base_color", "roughness", "normal"})
        EXPECT_LT(largest_difference(fragment, visibility, name), 0.005) << name;
}

TEST_F(Decals, LieInTheOrderThatTheirMaterialsSay)
{
    Material red = laid(glm::vec3(0.9f, 0.1f, 0.1f), 1.0f);
    Material green = laid(glm::vec3(0.1f, 0.9f, 0.1f), 1.0f);
    const auto seen = [&] {
        return shot(scene_of({ground(), square(0.002f, 1), square(0.002f, 2)},
                             {plain_material(glm::vec3(0.5f)), red, green}),
                    from_above());
    };
    EXPECT_GT(aov(seen(), "base_color", kMiddle, kMiddle, 1), 0.8f);
    red.decal.order = 1.0f;
    EXPECT_GT(aov(seen(), "base_color", kMiddle, kMiddle, 0), 0.8f);
}

TEST_F(Decals, WeightsChooseWhatIsCovered)
{
    Material above = laid(glm::vec3(0.9f, 0.1f, 0.1f), 1.0f);
    above.decal.weights = {0.0f, 0.0f, 1.0f, 0.0f};
    const RenderResult r =
        shot(scene_of({ground(), square(0.002f, 1)}, {plain_material(glm::vec3(0.5f)), above}),
             from_above());
    EXPECT_NEAR(aov(r, "base_color", kMiddle, kMiddle), 0.5f, 0.005f);
    EXPECT_NEAR(aov(r, "roughness", kMiddle, kMiddle), 0.2f, 0.005f);
}

TEST_F(Decals, BringNormalsAndGlow)
{
    Material above = laid(glm::vec3(0.9f), 1.0f);
    above.normal_texture.texture = 0;
    above.emissive = glm::vec3(1.0f, 0.5f, 0.0f);
    above.emissive_strength = 100.0f;
    const auto bump = texture_of([](int, int) { return glm::ivec4(191, 128, 230, 255); });
    const RenderResult r =
        shot(scene_of({ground(), square(0.002f, 1)}, {plain_material(glm::vec3(0.5f)), above}),
             from_above(), {bump});
    EXPECT_NEAR(aov(r, "normal", kMiddle, kMiddle, 0), 0.498f, 0.01f);
    EXPECT_NEAR(aov(r, "normal", 2, 2, 0), 0.0f, 0.001f);
    EXPECT_NEAR(aov(r, "emission", kMiddle, kMiddle, 0), 100.0f, 0.5f);
    EXPECT_NEAR(aov(r, "emission", kMiddle, kMiddle, 1), 50.0f, 0.5f);
    EXPECT_EQ(aov(r, "emission", 2, 2), 0.0f);
}

TEST_F(Decals, AreCutOutByMask)
{
    Material above = laid(glm::vec3(0.9f, 0.1f, 0.1f), 1.0f);
    above.alpha_mode = AlphaMode::Mask;
    above.base_color_texture.texture = 0;
    const auto half = texture_of([](int x, int) { return glm::ivec4(255, 255, 255, x < 32 ? 0 : 255); });
    const RenderResult r =
        shot(scene_of({ground(), square(0.002f, 1)}, {plain_material(glm::vec3(0.5f)), above}),
             from_above(), {half});
    EXPECT_NEAR(aov(r, "base_color", kMiddle - 8, kMiddle, 1), 0.5f, 0.005f);
    EXPECT_NEAR(aov(r, "base_color", kMiddle + 8, kMiddle, 1), 0.1f, 0.005f);
}

// A poster over the edge of a table does not lie on the floor as well.
TEST_F(Decals, ReachOnlyWhatIsNear)
{
    const auto on_floor = [&](float height_m) {
        const RenderResult r = shot(scene_of({ground(), square(height_m, 1)},
                                             {plain_material(glm::vec3(0.5f)),
                                              laid(glm::vec3(0.9f, 0.1f, 0.1f), 1.0f)}),
                                    from_above());
        return aov(r, "base_color", kMiddle, kMiddle, 0) > 0.8f;
    };
    EXPECT_TRUE(on_floor(0.04f));
    EXPECT_TRUE(on_floor(-0.04f));
    EXPECT_FALSE(on_floor(0.06f));
    EXPECT_FALSE(on_floor(-0.06f));
}

TEST_F(Decals, ABoxCoversWhatLooksItsWay)
{
    // A slope of 60 degrees beside the ground, both in the box.
    Primitive slope = quad({0, 0, 0.5f}, {0.5f, 0.866f, 0}, {0, 0, -1});
    Scene scene = scene_of({ground(), slope}, {plain_material(glm::vec3(0.5f)),
                                               laid(glm::vec3(0.9f, 0.1f, 0.1f), 1.0f)});
    scene.decals.push_back(box(1, {1.0f, 1.0f, 2.0f}));
    const auto red = [&](const RenderResult& r, int x, int y) {
        return (aov(r, "base_color", x, y) - 0.5f) / 0.4f;
    };
    scene.decals[0].full_angle_rad = 0.5f;
    scene.decals[0].none_angle_rad = 0.9f;
    RenderResult r = shot(scene, from_above());
    EXPECT_NEAR(red(r, kMiddle - 8, kMiddle), 1.0f, 0.02f);
    EXPECT_NEAR(red(r, kMiddle + 8, kMiddle), 0.0f, 0.02f);
    EXPECT_NEAR(red(r, 8, kMiddle), 0.0f, 0.02f);  // outside of it
    scene.decals[0].none_angle_rad = 1.5f;
    r = shot(scene, from_above());
    EXPECT_GT(red(r, kMiddle + 8, kMiddle), 0.2f);
    // Fading at its sides.
    scene.decals[0].edge_fade = 1.0f;
    r = shot(scene, from_above());
    EXPECT_NEAR(red(r, kMiddle - 8, kMiddle), 0.5f, 0.06f);
    EXPECT_GT(red(r, kMiddle - 2, kMiddle), 0.85f);
}

// Its picture stands upright: u along x, v down y.
TEST_F(Decals, ABoxShowsItsPictureUpright)
{
    Material above = laid(glm::vec3(1.0f), 1.0f);
    above.base_color_texture.texture = 0;
    Scene scene = scene_of({ground()}, {plain_material(glm::vec3(0.5f)), above});
    scene.decals.push_back(box(1));
    const auto ramps =
        texture_of([](int x, int y) { return glm::ivec4(4 * x + 2, 4 * y + 2, 0, 255); });
    const RenderResult r = shot(scene, from_above(), {ramps});
    for (const int offset : {-12, -5, 3, 11}) {
        const float at = 0.5f + static_cast<float>(offset) / 32.0f + 0.5f / 32.0f;
        EXPECT_NEAR(aov(r, "base_color", kMiddle + offset, kMiddle, 0), at, 0.03f);
        EXPECT_NEAR(aov(r, "base_color", kMiddle, kMiddle + offset, 1), at, 0.03f);
    }
}

// From within the box as from outside.
TEST_F(Decals, ABoxMayHoldTheEye)
{
    Scene scene = scene_of({ground()}, {plain_material(glm::vec3(0.5f)),
                                        laid(glm::vec3(0.9f, 0.1f, 0.1f), 1.0f)});
    scene.decals.push_back(box(1, {1.0f, 1.0f, 8.0f}));
    Frame frame = from_above();
    frame.camera = look({0, 1.0f, 0}, {0, 0, 0});
    EXPECT_GT(aov(shot(scene, frame), "base_color", kMiddle, kMiddle), 0.8f);
}

TEST_F(Decals, AMaterialMayTakeNone)
{
    Material below = plain_material(glm::vec3(0.5f));
    Scene scene = scene_of({ground(), square(0.002f, 1)},
                           {below, laid(glm::vec3(0.9f, 0.1f, 0.1f), 1.0f)});
    scene.decals.push_back(box(1));
    scene.materials[0].decal.received = false;
    EXPECT_NEAR(aov(shot(scene, from_above()), "base_color", kMiddle, kMiddle), 0.5f, 0.005f);
}

TEST_F(Decals, SnowAndWaterLieOnThem)
{
    Frame frame = from_above();
    frame.weather.snow_amount = 1.0f;
    frame.weather.flood_cracks = frame.weather.flood_puddles = 2.0f;
    const Material below = plain_material(glm::vec3(0.5f));
    const RenderResult bare = shot(scene_of({ground()}, {below}), frame);
    const RenderResult r = shot(
        scene_of({ground(), square(0.002f, 1)}, {below, laid(glm::vec3(0.9f, 0.1f, 0.1f), 1.0f)}),
        frame);
    for (const char* name : {"snow", "water"})
        EXPECT_EQ(largest_difference(bare, r, name), 0.0) << name;
    EXPECT_GT(aov(r, "snow", kMiddle, kMiddle), 0.5f);
    // The same snow is seen: what it hides makes no difference.
    EXPECT_NEAR(luminance(pixel(r, kMiddle, kMiddle)) / luminance(pixel(bare, kMiddle, kMiddle)),
                1.0f, 0.1f);
}

// With weights for the weather, puddles keep to the decal's own hollows.
TEST_F(Decals, MayBringTheirOwnWeather)
{
    Frame frame = from_above();
    frame.weather.flood_cracks = frame.weather.flood_puddles = 0.5f;
    Material below = plain_material(glm::vec3(0.5f));
    below.weather.default_height = 1.0f;  // no water stands
    Material above = laid(glm::vec3(0.5f), 1.0f);
    above.weather.height.texture = 0;
    const auto low = texture_of([](int x, int) { return glm::ivec4(x < 32 ? 0 : 255); });
    const auto water = [&](int x) {
        const RenderResult r =
            shot(scene_of({ground(), square(0.002f, 1)}, {below, above}), frame, {low});
        return aov(r, "water", x, kMiddle);
    };
    const float nothing = water(kMiddle - 8);
    above.decal.weights.w = 1.0f;
    EXPECT_GT(water(kMiddle - 8), nothing + 0.3f);
    EXPECT_LT(water(kMiddle + 8), 0.3f);
}

// Seen from the side, the bottom of a relief is seen farther away.
TEST_F(Decals, HaveParallax)
{
    Frame frame = from_above();
    frame.camera = look({0.0f, 2.0f, 1.2f}, {0, 0, 0}, 0.6f);
    Material above = laid(glm::vec3(1.0f), 1.0f);
    above.base_color_texture.texture = 0;
    above.weather.height.texture = 1;
    above.weather.height_scale_m = 0.2f;
    const auto ramp = texture_of([](int, int y) { return glm::ivec4(4 * y, 4 * y, 4 * y, 255); });
    const auto bottom = texture_of([](int, int) { return glm::ivec4(0); });
    const auto seen = [&](scene::Parallax parallax, bool boxed) {
        above.weather.parallax = parallax;
        Scene scene = boxed ? scene_of({ground()}, {plain_material(glm::vec3(0.5f)), above})
                            : scene_of({ground(), square(0.0f, 1)},
                                       {plain_material(glm::vec3(0.5f)), above});
        if (boxed) scene.decals.push_back(box(1));
        const RenderResult r = shot(scene, frame, {ramp, bottom});
        return aov(r, "base_color", kMiddle, kMiddle);
    };
    // 0.2 m deep at a slope of 1.2 in 2 moves the look-up by 0.12 m of the 1 m that the ramp has; v runs
    // away from the eye on the quad, towards it in the box.
    for (const bool boxed : {false, true}) {
        for (const auto parallax : {scene::Parallax::Simple, scene::Parallax::Occlusion}) {
            EXPECT_NEAR(std::abs(seen(scene::Parallax::None, boxed) - seen(parallax, boxed)), 0.12f,
                        0.02f)
                << boxed;
        }
    }
}

TEST_F(Decals, OutOfViewCostNothing)
{
    Scene scene = scene_of({ground()}, {plain_material(glm::vec3(0.5f)),
                                        laid(glm::vec3(0.9f, 0.1f, 0.1f), 1.0f)});
    const RenderResult without = shot(scene, from_above());
    ProjectedDecal far = box(1);
    far.to_world[3] = glm::vec4(3.5f, 0, 0, 1);
    scene.decals.push_back(far);
    const RenderResult with = shot(scene, from_above());
    EXPECT_EQ(without.beauty, with.beauty);
    EXPECT_EQ(renderer->describe_graph().find("decals"), std::string::npos);
}

}  // namespace
}  // namespace petrichor::gpu
