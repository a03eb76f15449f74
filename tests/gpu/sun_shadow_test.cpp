// The shadow of the sun: flat things do not shadow themselves, and what juts out by little does.
#include <algorithm>

#include "gpu/frame/view.h"
#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

using SunShadowTest = GpuTest;

constexpr int kSize = 96;

Frame under_the_sun(float elevation_degrees, float azimuth_degrees)
{
    Frame frame;
    frame.settings.width = frame.settings.height = kSize;
    frame.settings.samples = 4;
    frame.settings.image_based_light = false;
    frame.settings.ambient_occlusion = false;
    frame.settings.draw_sky = false;
    frame.settings.exposure = 1e-5f;
    frame.sky.sun_elevation_rad = glm::radians(elevation_degrees);
    frame.sky.sun_azimuth_rad = glm::radians(azimuth_degrees);
    frame.weather.visibility_m = 1e9f;
    return frame;
}

Material grey()
{
    Material m = plain_material(glm::vec3(0.5f), 1.0f);
    m.specular = 0.0f;
    return m;
}

// Light with shadows over light without them.
struct Shares {
    std::vector<float> of;  ///< 1 where there is no light anyway
    int darker = 0;
    float darkest = 1.0f;
};

Shares shares(Renderer& renderer, Frame frame)
{
    frame.settings.shadows = true;
    const RenderResult shadowed = renderer.render(frame);
    frame.settings.shadows = false;
    const RenderResult lit = renderer.render(frame);
    Shares s;
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            const float light = luminance(pixel(lit, x, y));
            const float share = light > 1e-4f ? luminance(pixel(shadowed, x, y)) / light : 1.0f;
            s.of.push_back(share);
            if (share < 0.97f) ++s.darker;
            s.darkest = std::min(s.darkest, share);
        }
    }
    return s;
}

TEST_F(SunShadowTest, FlatGroundHasNoAcneUnderASunOfAnyHeight)
{
    renderer->load(scene_of({quad({-60, 0, 60}, {120, 0, 0}, {0, 0, -120})}, {grey()}), {});
    for (const float elevation : {2.0f, 5.0f, 12.0f, 30.0f, 60.0f, 89.0f}) {
        for (const float azimuth : {0.0f, 70.0f, 200.0f}) {
            Frame frame = under_the_sun(elevation, azimuth);
            frame.camera = look({0, 1.7f, 8}, {0, 0.4f, 0}, 0.9f);
            const Shares s = shares(*renderer, frame);
            EXPECT_EQ(s.darker, 0) << s.darkest << " at " << elevation << " " << azimuth;
        }
    }
}

TEST_F(SunShadowTest, ALedgeOfTwoTexelsThrowsAShadow)
{
    // Seen from 30 m, in the last of the maps, whose texels are the largest.
    Frame frame = under_the_sun(45.0f, 180.0f);
    frame.camera = look({0, 2, 30}, {0, 2, 0}, 0.05f);
    const Bounds bounds{{-20, 0, -20}, {20, 4, 31}};
    const auto views = cascade_views(frame.camera, 1.0f, glm::normalize(glm::vec3(0, 1, 1)), bounds);
    const float juts_m = 2.0f * views[SHADOW_CASCADES - 1].texel_m;
    ASSERT_GT(juts_m, 0.005f);
    std::vector<Primitive> all{quad({-20, 0, 31}, {40, 0, 0}, {0, 0, -51}), quad({-20, 0, 0}, {40, 0, 0}, {0, 4, 0})};
    all.push_back(quad({-20, 2, 0}, {40, 0, 0}, {0, 0, juts_m}));                        // from below
    all.push_back(quad({-20, 2.01f, juts_m}, {40, 0, 0}, {0, 0, -juts_m}));              // from above
    all.push_back(quad({-20, 2, juts_m}, {40, 0, 0}, {0, 0.01f, 0}));                    // its edge
    renderer->load(scene_of(all, {grey()}), {});
    // A camera that sees 16 times what juts out.
    frame.camera.vertical_fov_rad = 16.0f * juts_m / 30.0f;
    frame.settings.aovs = {"position"};
    const RenderResult where = renderer->render(frame);
    const Shares s = shares(*renderer, frame);
    float below = 0.0f, far = 0.0f;
    int n_below = 0, n_far = 0;
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            const float height = aov(where, "position", x, y, 1);
            const float share = s.of[static_cast<std::size_t>(y * kSize + x)];
            if (height < 2.0f - 0.2f * juts_m && height > 2.0f - 0.8f * juts_m) {
                below += share;
                ++n_below;
            } else if (height < 2.0f - 4.0f * juts_m) {
                far += share;
                ++n_far;
            }
        }
    }
    ASSERT_GT(n_below, 100);
    ASSERT_GT(n_far, 100);
    EXPECT_LT(below / static_cast<float>(n_below), 0.4f) << "in its shadow, which is as high as it juts out";
    EXPECT_GT(far / static_cast<float>(n_far), 0.99f);
}

TEST_F(SunShadowTest, TheFootOfAWallInTheSunIsHardlyDarker)
{
    renderer->load(scene_of({quad({-10, 0, 10}, {20, 0, 0}, {0, 0, -10}), quad({-10, 0, 0}, {20, 0, 0}, {0, 3, 0})}, {grey()}), {});
    Frame frame = under_the_sun(40.0f, 150.0f);
    frame.camera = look({1, 1.5f, 6}, {0, 0.3f, 0}, 0.6f);
    const Shares s = shares(*renderer, frame);
    EXPECT_GT(s.darkest, 0.5f);
    EXPECT_LT(s.darker, 4 * kSize) << "a line of few pixels";
}

}  // namespace
}  // namespace petrichor::gpu
