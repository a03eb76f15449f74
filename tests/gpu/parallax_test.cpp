// The relief of a height map as seen: below the geometry, where its rays meet it.
#include <cmath>
#include <functional>

#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

class ParallaxTest : public GpuTest {};

constexpr int kSize = 72;

Texture texture_of(const char* name, const std::function<int(int)>& code)
{
    Texture texture;
    texture.name = name;
    texture.format = TexelFormat::Rgba8Unorm;
    texture.width = texture.height = 128;
    texture.mips.emplace_back();
    for (int y = 0; y < 128; ++y) {
        for (int x = 0; x < 128; ++x) {
            for (const int byte : {code(x), code(x), code(x), 255})
                texture.mips[0].push_back(static_cast<std::byte>(byte));
        }
    }
    return texture;
}

// A ramp of grey over half a metre, again and again; the height is `height` everywhere.
Scene floor(float y, scene::Parallax parallax, float scale_m)
{
    Material m = plain_material(glm::vec3(1.0f));
    m.base_color_texture.texture = 0;
    m.base_color_texture.scale = glm::vec2(8.0f);
    m.weather.height.texture = 1;
    m.weather.parallax = parallax;
    m.weather.height_scale_m = scale_m;
    return scene_of({quad({-2, y, 2}, {4, 0, 0}, {0, 0, -4})}, {m});
}

RenderResult seen(Renderer& renderer, const Scene& scene, int height_code,
                  float detail_distance_m = 50.0f)
{
    renderer.load(scene, {texture_of("ramp", [](int x) { return 2 * x; }),
                          texture_of("height", [=](int) { return height_code; })});
    Frame frame;
    // From the side, so that depth moves the ramp along its slope; steep, where nothing is shortened.
    frame.camera = look({0.9f, 2.6f, 0.0f}, {0, 0, 0}, 0.35f);
    frame.settings.width = frame.settings.height = kSize;
    frame.settings.samples = 1;
    frame.settings.aovs = {"base_color"};
    frame.look.detail_distance_m = detail_distance_m;
    frame.look.detail_fade_m = 2.0f;
    return renderer.render(frame);
}

double share_alike(const RenderResult& a, const RenderResult& b)
{
    int alike = 0;
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            alike += std::abs(aov(a, "base_color", x, y) - aov(b, "base_color", x, y)) < 0.03f ? 1 : 0;
        }
    }
    return static_cast<double>(alike) / (kSize * kSize);
}

TEST_F(ParallaxTest, AnEvenHeightLooksLikeLoweredGround)
{
    const float scale_m = 0.3f;
    for (const int code : {0, 128, 200}) {
        const float depth_m = (1.0f - static_cast<float>(code) / 255.0f) * scale_m;
        const RenderResult lowered =
            seen(*renderer, floor(-depth_m, scene::Parallax::None, scale_m), code);
        const RenderResult flat = seen(*renderer, floor(0.0f, scene::Parallax::None, scale_m), code);
        for (const auto parallax : {scene::Parallax::Simple, scene::Parallax::Occlusion}) {
            const RenderResult sunk = seen(*renderer, floor(0.0f, parallax, scale_m), code);
            EXPECT_GT(share_alike(sunk, lowered), 0.9) << code;
        }
        EXPECT_LT(share_alike(flat, lowered), 0.7) << "and is not what the flat one looks like";
    }
}

TEST_F(ParallaxTest, NothingMovesAtFullHeightOrWithoutDepth)
{
    const RenderResult flat = seen(*renderer, floor(0.0f, scene::Parallax::None, 0.3f), 255);
    for (const auto parallax : {scene::Parallax::Simple, scene::Parallax::Occlusion}) {
        EXPECT_EQ(share_alike(seen(*renderer, floor(0.0f, parallax, 0.3f), 255), flat), 1.0);
        EXPECT_EQ(share_alike(seen(*renderer, floor(0.0f, parallax, 0.0f), 10), flat), 1.0);
    }
}

// Beyond the distance of detail a surface is flat; before it the relief comes up little by little.
TEST_F(ParallaxTest, FadesWithDistance)
{
    const RenderResult flat = seen(*renderer, floor(0.0f, scene::Parallax::None, 0.3f), 0);
    const Scene deep = floor(0.0f, scene::Parallax::Occlusion, 0.3f);
    const RenderResult near = seen(*renderer, deep, 0);
    const RenderResult between = seen(*renderer, deep, 0, 4.1f);  // the floor is 2.75 m away
    EXPECT_EQ(share_alike(seen(*renderer, deep, 0, 2.5f), flat), 1.0);
    EXPECT_LT(share_alike(between, flat), 0.8);
    EXPECT_LT(share_alike(between, near), 0.8);
}

TEST_F(ParallaxTest, WaterFillsTheRelief)
{
    Scene deep = floor(0.0f, scene::Parallax::Occlusion, 0.3f);
    deep.materials[0].weather.water_accumulation = {2.0f, 0.0f, 2.0f, 0.0f};
    const RenderResult flat = seen(*renderer, floor(0.0f, scene::Parallax::None, 0.3f), 0);
    EXPECT_GT(share_alike(seen(*renderer, deep, 0), flat), 0.99);
}

// Water half way up the relief: its rings are seen where it stands, as on ground that lies so deep.
TEST_F(ParallaxTest, RingsLieOnTheWaterInTheRelief)
{
    const auto rings_on = [&](const Scene& scene) {
        renderer->load(scene, {texture_of("ramp", [](int x) { return 2 * x; }),
                               texture_of("height", [](int) { return 0; })});
        Frame frame;
        frame.camera = look({0.7f, 2.0f, 0.0f}, {0, 0, 0}, 0.35f);
        frame.settings.width = frame.settings.height = kSize;
        frame.settings.samples = 1;
        frame.settings.aovs = {"cover_normal"};
        frame.settings.time_s = 0.4;
        frame.look.detail_distance_m = 50.0f;
        frame.look.detail_fade_m = 2.0f;
        frame.weather.flood_cracks = frame.weather.flood_puddles = 0.5f;
        frame.weather.rain = 1.0f;
        return renderer->render(frame);
    };
    const auto puddle = [](float y, scene::Parallax parallax) {
        Scene scene = floor(y, parallax, 0.3f);
        scene.materials[0].weather.wetness = scene::Wetness::Ripples;
        return scene;
    };
    const RenderResult sunk = rings_on(puddle(0.0f, scene::Parallax::Occlusion));
    const RenderResult lowered = rings_on(puddle(-0.15f, scene::Parallax::None));
    const RenderResult flat = rings_on(puddle(0.0f, scene::Parallax::None));
    const auto difference = [](const RenderResult& a, const RenderResult& b) {
        double sum = 0.0;
        for (int y = 0; y < kSize; ++y) {
            for (int x = 0; x < kSize; ++x) {
                for (const int c : {0, 2}) {
                    sum += std::abs(static_cast<double>(aov(a, "cover_normal", x, y, c) -
                                                        aov(b, "cover_normal", x, y, c)));
                }
            }
        }
        return sum;
    };
    ASSERT_GT(difference(flat, lowered), 0.01 * kSize * kSize) << "there are rings";
    EXPECT_LT(difference(sunk, lowered), 0.35 * difference(flat, lowered));
}

}  // namespace
}  // namespace petrichor::gpu
