// The shadow of the sun: flat things do not shadow themselves, and what juts out by little does.
#include <algorithm>
#include <cmath>

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

bool may_ask(const DepthView& view, const glm::vec3& at)
{
    const glm::vec4 clip = view.clip_from_world * glm::vec4(at, 1.0f);
    for (int i = 0; i < view.asked.count; ++i) {
        const glm::vec3& line = view.asked.lines[static_cast<std::size_t>(i)];
        if (line.x * clip.x + line.y * clip.y + line.z < 0.0f) return false;
    }
    return clip.z >= view.asked.least_z;
}

TEST(SunShadow, AMapIsAskedBySliceOfTheViewAndNotBesideIt)
{
    const Bounds bounds{{-80, 0, -80}, {80, 30, 80}};
    const Camera camera = look({3, 1.7f, 10}, {-4, 0.4f, -20}, 0.9f);
    const glm::vec3 ends = cascade_ends_m(camera, bounds);
    const glm::mat4& m = camera.to_world;
    const glm::vec3 ahead = -glm::vec3(m[2]), right(m[0]), up(m[1]);
    const float high = std::tan(0.45f), wide = 1.5f * high;
    for (const glm::vec3& to_sun : {glm::vec3(1, 0.05f, 0.2f), glm::vec3(-0.3f, 0.2f, -1), glm::vec3(0.1f, 1, 0)}) {
        const auto views = cascade_views(camera, 1.5f, glm::normalize(to_sun), bounds);
        int outside = 0;
        for (int k = 0; k < SHADOW_CASCADES; ++k) {
            const DepthView& view = views[static_cast<std::size_t>(k)];
            ASSERT_GE(view.asked.count, 3);
            const float begin = k == 0 ? camera.near_m : ends[k - 1];
            for (int i = 0; i < 1000; ++i) {
                const auto part = [i](int step) { return static_cast<float>(i * step % 1000) / 999.0f; };
                const float away = begin + (ends[k] - begin) * part(1);
                const glm::vec3 seen = glm::vec3(m[3]) + ahead * away + right * (wide * away * (2.0f * part(7) - 1.0f)) +
                                       up * (high * away * (2.0f * part(31) - 1.0f));
                EXPECT_TRUE(may_ask(view, seen)) << k << " " << i;
                // What lies towards the sun from there throws its shadow there.
                const glm::vec4 a = view.clip_from_world * glm::vec4(seen, 1.0f);
                const glm::vec4 b = view.clip_from_world * glm::vec4(seen + glm::normalize(to_sun) * 3.0f, 1.0f);
                EXPECT_NEAR(a.x, b.x, 1e-4f);
                EXPECT_GT(b.z, a.z);
                const glm::vec3 around(160.0f * part(13) - 80.0f, 1.0f, 160.0f * part(57) - 80.0f);
                outside += may_ask(view, around) ? 0 : 1;
            }
        }
        EXPECT_GT(outside, 1500) << "of 3000 anywhere in the scene";
    }
}

TEST_F(SunShadowTest, WhatIsLeftOutOfTheMapsChangesNoPixel)
{
    // Posts all around, in one draw that is sorted out triangle by triangle, and a wall far off towards the sun.
    Primitive posts;
    for (int i = 0; i < 400; ++i) {
        const glm::vec3 at(static_cast<float>(i % 20) * 6.0f - 60.0f, 0.0f, static_cast<float>(i / 20) * 6.0f - 60.0f);
        const float tall = 0.5f + 0.25f * static_cast<float>(i % 7);
        for (const glm::vec3& side : {glm::vec3(0.3f, 0, 0), glm::vec3(0, 0, 0.3f)}) {
            const Primitive face = quad(at - 0.5f * side, side, {0, tall, 0});
            const auto first = static_cast<std::uint32_t>(posts.positions.size());
            posts.positions.insert(posts.positions.end(), face.positions.begin(), face.positions.end());
            posts.normals.insert(posts.normals.end(), face.normals.begin(), face.normals.end());
            posts.uv0.insert(posts.uv0.end(), face.uv0.begin(), face.uv0.end());
            for (const std::uint32_t v : face.indices) posts.indices.push_back(first + v);
        }
    }
    Material both = grey();
    both.double_sided = true;
    renderer->load(scene_of({quad({-90, 0, 90}, {180, 0, 0}, {0, 0, -180}), posts, quad({-80, 0, -85}, {160, 0, 0}, {0, 9, 0})},
                            {both}),
                   {});
    for (const float elevation : {3.0f, 25.0f, 70.0f}) {
        for (const float azimuth : {10.0f, 130.0f, 275.0f}) {
            Frame frame = under_the_sun(elevation, azimuth);
            frame.settings.samples = 1;
            frame.settings.shadows = true;
            frame.camera = look({1, 1.7f, 12}, {-6, 0.4f, -20}, 0.9f);
            const RenderResult part = renderer->render(frame);
            frame.lens = {.radius_m = 1e-9f, .focus_m = 10.0f};  // sees past the view: its maps are whole
            const RenderResult whole = renderer->render(frame);
            EXPECT_EQ(part.beauty, whole.beauty) << elevation << " " << azimuth;
            // A map that is kept while the camera turns holds what it did not look at before.
            frame.lens = {};
            frame.camera = look({1, 1.7f, 12}, {20, 0.4f, 20}, 0.9f);
            const RenderResult turned = renderer->render(frame);
            frame.lens = {.radius_m = 1e-9f, .focus_m = 10.0f};
            EXPECT_EQ(turned.beauty, renderer->render(frame).beauty) << elevation << " " << azimuth;
        }
    }
}

}  // namespace
}  // namespace petrichor::gpu
