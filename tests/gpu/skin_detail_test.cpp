// Pores of skin: fine bumps that its highlight has and its diffuse light has not; skin in standard light.
#include <algorithm>
#include <cmath>

#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

constexpr int kSize = 48;

// Ridges that lean left and right, with the levels of their mean.
Texture ridges()
{
    Texture texture;
    texture.name = "ridges";
    texture.width = texture.height = 16;
    for (int side = 16; side >= 1; side /= 2) {
        texture.mips.emplace_back();
        const int lean = side == 16 ? 50 : 0;
        for (int i = 0; i < side * side; ++i) {
            for (const int byte : {128 + ((i % side) / 4 % 2 == 0 ? lean : -lean), 128, 240, 255})
                texture.mips.back().push_back(static_cast<std::byte>(byte));
        }
    }
    return texture;
}

class SkinDetail : public GpuTest {
protected:
    RenderResult shot(const Material& material)
    {
        renderer->load(scene_of({quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0})}, {material}), {ridges()});
        return renderer->render(frame);
    }

    // How far the row in the middle goes up and down, of its mean.
    static float contrast(const RenderResult& r, const std::string& name)
    {
        float low = 1e9f, high = -1e9f;
        for (int x = 4; x < kSize - 4; ++x) {
            const float value = aov(r, name, x, kSize / 2, 1);
            low = std::min(low, value);
            high = std::max(high, value);
        }
        return (high - low) / std::max(high + low, 1e-6f);
    }

    Frame frame = [] {
        Frame f;
        f.camera = look({0, 0, 3}, {0, 0, 0});
        f.camera.orthographic_height_m = 1.0f;
        f.settings.width = f.settings.height = kSize;
        f.settings.samples = 1;
        f.settings.image_based_light = false;
        f.settings.shadows = false;
        f.settings.exposure = 1.0f;
        f.settings.aovs = {"diffuse_direct", "specular_direct", "transmission"};
        f.sky.analytic_sun = false;
        f.sky.sun_illuminance = 0.0f;
        f.weather.visibility_m = 1e9f;
        Light lamp;
        lamp.kind = LightKind::Directional;
        lamp.intensity = 1000.0f;
        lamp.direction = -glm::normalize(glm::vec3(0.7f, 0.1f, 0.8f));
        f.extra_lights = {lamp};
        return f;
    }();
};

Material pored(const char* model)
{
    Material m = plain_material({0.7f, 0.45f, 0.35f}, 0.5f);
    m.lighting_model = model;
    m.skin_curvature = 0.4f;
    m.skin_blur = 1.0f;
    m.second.use = scene::SecondSetUse::Detail;
    m.second.normal_texture.texture = 0;
    m.second.tiling = glm::vec2(2.0f);
    m.second.normal_scale = 0.8f;
    return m;
}

TEST_F(SkinDetail, MicroBumpsAreOfTheHighlightAlone)
{
    const Material skin = pored("skin");
    const RenderResult bumpy = shot(skin);
    EXPECT_GT(contrast(bumpy, "specular_direct"), 0.2f);
    EXPECT_LT(contrast(bumpy, "diffuse_direct"), 0.02f);
    Material sharp = skin;
    sharp.skin_blur = 0.0f;
    EXPECT_GT(contrast(shot(sharp), "diffuse_direct"), 0.1f) << "without blur it has them too";
    Material smooth = skin;
    smooth.second.normal_scale = 0.0f;
    EXPECT_LT(contrast(shot(smooth), "specular_direct"), 0.01f);
    // Over a normal map of its own, which diffuse light has, softened.
    Material both = skin;
    both.normal_texture.texture = 0;
    both.normal_texture.scale = glm::vec2(0.5f);
    Material first = both;
    first.second.use = scene::SecondSetUse::None;
    const RenderResult with = shot(both), without = shot(first);
    float most = 0.0f;
    for (int x = 4; x < kSize - 4; ++x)
        most = std::max(most, std::abs(aov(with, "diffuse_direct", x, kSize / 2) /
                                           aov(without, "diffuse_direct", x, kSize / 2) -
                                       1.0f));
    EXPECT_LT(most, 0.02f);
    EXPECT_NE(with.beauty, without.beauty);
}

TEST_F(SkinDetail, MicroBumpsEndWithTheDetail)
{
    frame.look.detail_distance_m = 2.0f;  // the skin is 3 m away
    EXPECT_LT(contrast(shot(pored("skin")), "specular_direct"), 0.01f);
}

// The same material under the standard model: bumps and glow as they are, and no light past the terminator.
TEST_F(SkinDetail, StandardLightKeepsBumpsAndGlowAndBleedsNothing)
{
    Material standard = pored("standard");
    Material skin = pored("skin");
    const RenderResult lit = shot(standard), soft = shot(skin);
    for (int x = 4; x < kSize - 4; ++x) {
        const float wanted = aov(soft, "specular_direct", x, kSize / 2);
        EXPECT_NEAR(aov(lit, "specular_direct", x, kSize / 2), wanted, 0.02f * wanted);
    }
    EXPECT_GT(contrast(lit, "diffuse_direct"), 0.1f);
    skin.translucency = standard.translucency = 0.6f;
    skin.skin_curvature = standard.skin_curvature = 1.0f;
    const auto green = [&](const Material& m) { return pixel(shot(m), kSize / 2, kSize / 2).g; };
    // Just past its edge.
    frame.extra_lights[0].direction = -glm::normalize(glm::vec3(1.0f, 0.0f, -0.15f));
    Material dark = standard, red = skin;
    dark.second.use = red.second.use = scene::SecondSetUse::None;
    dark.translucency = red.translucency = 0.0f;
    EXPECT_EQ(green(dark), 0.0f);
    EXPECT_GT(green(red), 0.0f);
    // From straight behind both glow.
    frame.extra_lights[0].direction = glm::vec3(0, 0, 1);
    EXPECT_GT(green(standard), 10.0f);
    EXPECT_GT(green(skin), 10.0f);
}

}  // namespace
}  // namespace petrichor::gpu
