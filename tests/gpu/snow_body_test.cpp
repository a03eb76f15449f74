// Deep snow is geometry: it is seen, measured and shadowed as such.
#include <algorithm>
#include <cmath>

#include "gpu/snow/snow_body.h"
#include "scene/patches/tracer.h"
#include "scene/snow/snow_caps.h"
#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

constexpr int kSize = 96;

// A post of half a metre on open ground.
Scene post_on_ground()
{
    std::vector<Primitive> faces{quad({-3, 0, 3}, {6, 0, 0}, {0, 0, -6}),
                                 quad({-0.25f, 1, 0.25f}, {0.5f, 0, 0}, {0, 0, -0.5f}),
                                 quad({-0.25f, 0, 0.25f}, {0.5f, 0, 0}, {0, 1, 0}),
                                 quad({0.25f, 0, 0.25f}, {0, 0, -0.5f}, {0, 1, 0}),
                                 quad({0.25f, 0, -0.25f}, {-0.5f, 0, 0}, {0, 1, 0}),
                                 quad({-0.25f, 0, -0.25f}, {0, 0, 0.5f}, {0, 1, 0})};
    return scene_of(std::move(faces), {plain_material(glm::vec3(0.2f))});
}

class SnowBodyTest : public GpuTest {
protected:
    void SetUp() override
    {
        GpuTest::SetUp();
        scene = post_on_ground();
        const scene::Triangles triangles(scene, {});
        const scene::Tracer tracer(triangles);
        caps = std::make_shared<const scene::SnowCaps>(scene::build_snow_caps(tracer, {}));
    }

    // From the side, 2 m across.
    static Frame frame(float depth_m)
    {
        Frame f;
        f.camera = look({0, 1.0f, 4}, {0, 1.0f, 0});
        f.camera.orthographic_height_m = 1.0f;
        f.settings.width = f.settings.height = kSize;
        f.settings.samples = 1;
        f.settings.aovs = {"depth", "snow"};
        f.weather.snow_depth_m = depth_m;
        f.weather.snow_amount = 1.0f - std::exp(-depth_m / 0.05f);
        f.weather.water_to_snow = 1.0f;
        return f;
    }

    // World y of the highest pixel of the post in the middle column.
    static float top_of(const RenderResult& r)
    {
        for (int y = 0; y < kSize; ++y) {
            const float depth = aov(r, "depth", kSize / 2, y);
            if (depth > 3.0f && depth < 4.5f) return 1.5f - static_cast<float>(y) / kSize;
        }
        return 0.0f;
    }

    Scene scene;
    std::shared_ptr<const scene::SnowCaps> caps;
};

TEST_F(SnowBodyTest, APostsSilhouetteRisesByTheDepth)
{
    renderer->load(scene, {}, caps);
    const float bare = top_of(renderer->render(frame(0.0f)));
    EXPECT_NEAR(bare, 1.0f, 0.02f);
    for (const float depth : {0.1f, 0.18f}) {
        const RenderResult r = renderer->render(frame(depth));
        EXPECT_NEAR(top_of(r) - bare, depth, 0.25f * depth + 0.011f);
        // It is white to its top.
        const int y = static_cast<int>((1.5f - (1.0f + 0.6f * depth)) * kSize);
        EXPECT_GT(aov(r, "snow", kSize / 2, y), 0.6f);
    }
}

TEST_F(SnowBodyTest, OffItIsThePictureWithoutIt)
{
    renderer->load(scene, {});
    const RenderResult flat = renderer->render(frame(0.15f));
    const RenderResult thin = renderer->render(frame(0.008f));
    renderer->load(scene, {}, caps);
    Frame off = frame(0.15f);
    off.settings.snow_body = false;
    EXPECT_EQ(renderer->render(off).beauty, flat.beauty);
    EXPECT_NE(renderer->render(frame(0.15f)).beauty, flat.beauty);
    EXPECT_EQ(renderer->render(frame(0.008f)).beauty, thin.beauty) << "too thin for a body";
    EXPECT_EQ(renderer->render(off).beauty, flat.beauty) << "and off again";
}

// A material's mask keeps deep snow away as it does thin snow: by a texture where it is seen, by its vertices in its shape too.
TEST_F(SnowBodyTest, MasksKeepDeepSnowAway)
{
    const auto ground_shown = [&](const Scene& masked, std::uint8_t mask) {
        Texture even;
        even.name = "even";
        even.width = even.height = 1;
        even.mips = {{std::byte{mask}, std::byte{mask}, std::byte{mask}, std::byte{255}}};
        const scene::Triangles triangles(masked, {});
        const scene::Tracer tracer(triangles);
        renderer->load(masked, {even}, std::make_shared<const scene::SnowCaps>(scene::build_snow_caps(tracer, {})));
        Frame f = frame(0.15f);
        f.settings.aovs = {"position", "snow"};
        f.camera = look({1.6f, 2.0f, 1.6f}, {1.6f, 0.0f, 1.59f});
        f.camera.orthographic_height_m = 0.5f;
        const RenderResult r = renderer->render(f);
        return glm::vec2(aov(r, "snow", kSize / 2, kSize / 2), aov(r, "position", kSize / 2, kSize / 2, 1));
    };
    Scene masked = scene;
    masked.materials[0].weather.snow_mask.texture = 0;
    const glm::vec2 white = ground_shown(masked, 255);
    EXPECT_GT(white.x, 0.95f);
    EXPECT_GT(white.y, 0.1f);
    EXPECT_LT(ground_shown(masked, 0).x, 0.02f);
    Scene by_vertices = scene;
    Primitive& floor = by_vertices.meshes[0].primitives[0];
    floor.weather.assign(floor.positions.size(), glm::vec4(1, 1, 0, 1));
    const glm::vec2 bare = ground_shown(by_vertices, 255);
    EXPECT_LT(bare.x, 0.02f);
    EXPECT_NEAR(bare.y, 0.0f, 0.01f);
}

TEST_F(SnowBodyTest, AFrameAloneIsTheFrameOfARun)
{
    renderer->load(scene, {}, caps);
    for (const float depth : {0.02f, 0.05f, 0.1f}) renderer->render(frame(depth));
    const RenderResult run = renderer->render(frame(0.12f));
    renderer->load(scene, {}, caps);
    EXPECT_EQ(renderer->render(frame(0.12f)).beauty, run.beauty);
}

// The maps of the sun leave out what deep snow covers, its caps stand for it; and eyes over it what lies deep below.
TEST_F(SnowBodyTest, WhatItCoversIsMissedNowhere)
{
    // Rough ground in small triangles, cut off at x = 2 m above lower ground.
    Primitive ground;
    constexpr int kCells = 40;
    for (int y = 0; y <= kCells; ++y) {
        for (int x = 0; x <= kCells; ++x) {
            ground.positions.emplace_back(0.125f * static_cast<float>(x) - 3.0f, 0.01f * static_cast<float>((x * 7 + y * 13) % 5),
                                          2.5f - 0.125f * static_cast<float>(y));
            ground.normals.emplace_back(0.0f, 1.0f, 0.0f);
            ground.uv0.emplace_back(0.0f);
            if (x == kCells || y == kCells) continue;
            const auto at = static_cast<std::uint32_t>(y * (kCells + 1) + x);
            ground.indices.insert(ground.indices.end(), {at, at + 1, at + kCells + 2, at, at + kCells + 2, at + kCells + 1});
        }
    }
    const Scene rough = scene_of({quad({-6, -0.5f, 6}, {12, 0, 0}, {0, 0, -12}), ground}, {plain_material(glm::vec3(0.2f))});
    const scene::Triangles triangles(rough, {});
    const scene::Tracer tracer(triangles);
    auto own = std::make_shared<scene::SnowCaps>(scene::build_snow_caps(tracer, {}));
    auto none = std::make_shared<scene::SnowCaps>(*own);
    std::size_t told = 0;
    for (scene::SnowCaps::Part& part : none->parts) {
        for (std::uint32_t& below : part.below) {
            told += below != scene::SnowCaps::kUncovered ? 1 : 0;
            below = scene::SnowCaps::kUncovered;
        }
    }
    ASSERT_GT(told, 3000u);
    std::vector<Frame> frames;
    for (const float elevation : {0.06f, 0.3f, 1.2f}) {
        Frame f = frame(0.2f);
        f.camera = look({0.5f, 1.2f, 5}, {0, -0.2f, 0});
        f.sky.sun_elevation_rad = elevation;
        f.sky.sun_azimuth_rad = 4.5f;
        f.settings.exposure = 1e-5f;
        frames.push_back(f);
    }
    for (const float height : {0.24f, 0.35f, 3.0f, 0.1f, -0.3f}) {  // along the snow, from above, within it, from below
        frames.push_back(frames.front());
        frames.back().camera = look({0.5f, height, 3}, {0, 0, 0});
    }
    SnowBody body(own);
    ASSERT_TRUE(body.lay(frames.front()));
    std::size_t hidden = 0;
    for (const Covered& one : body.laid().covered)
        for (const std::uint8_t from : one.triangles) hidden += (from & Covered::kFromEye) != 0 ? 1 : 0;
    EXPECT_GT(hidden, 2000u);
    EXPECT_TRUE(body.lies_below({0.5f, 0.45f, 0}));
    EXPECT_FALSE(body.lies_below({0.5f, 0.1f, 0}));
    renderer->load(rough, {}, own);
    std::vector<std::vector<std::uint16_t>> without;
    for (const Frame& f : frames) without.push_back(renderer->render(f).beauty);
    renderer->load(rough, {}, none);
    for (std::size_t i = 0; i < frames.size(); ++i) EXPECT_EQ(renderer->render(frames[i]).beauty, without[i]) << i;
}

TEST_F(SnowBodyTest, BothWaysToShadeShowIt)
{
    renderer->load(scene, {}, caps);
    Frame one = frame(0.15f), other = frame(0.15f);
    one.settings.surface_path = SurfacePath::Fragment;
    other.settings.surface_path = SurfacePath::Visibility;
    const RenderResult a = renderer->render(one), b = renderer->render(other);
    EXPECT_EQ(top_of(a), top_of(b));
    double sum = 0.0;
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x)
            sum += std::abs(static_cast<double>(luminance(pixel(a, x, y)) - luminance(pixel(b, x, y)))) /
                   (0.01 + static_cast<double>(luminance(pixel(a, x, y))));
    }
    EXPECT_LT(sum / (kSize * kSize), 0.01);
}

// A bank has the name of what it lies on, and covers none of it; the caps beside it do.
TEST(SnowBodyCovers, WhatABankLiesOnToo)
{
    std::vector<Primitive> faces{quad({-3, 0, 3}, {3, 0, 0}, {0, 0, -6}), quad({0, 0.12f, 3}, {3, 0, 0}, {0, 0, -6}),
                                 quad({0, 0, 3}, {0, 0, -6}, {0, 0.12f, 0})};
    const Scene step = scene_of(std::move(faces), {plain_material(glm::vec3(0.2f))});
    const scene::Triangles triangles(step, {});
    const scene::Tracer tracer(triangles);
    scene::SnowCapOptions options;
    options.eyes_m = {{-1, 1.6f, 0}};
    const auto caps = std::make_shared<const scene::SnowCaps>(scene::build_snow_caps(tracer, options));
    const auto is_bank = [&](const scene::SnowCaps::Part& part) {
        return caps->points[caps->corner_points[caps->indices[part.first_index]]].bank > 0.0f;
    };
    ASSERT_TRUE(std::any_of(caps->parts.begin(), caps->parts.end(), is_bank));
    SnowBody body(caps);
    Frame f;
    f.weather.snow_depth_m = 0.2f;
    f.weather.snow_amount = 0.98f;
    ASSERT_TRUE(body.lay(f));
    for (const scene::SnowCaps::Part& part : caps->parts) {
        if (!is_bank(part)) continue;
        const auto named = [&](const Covered& one) { return one.instance_id == part.instance && one.primitive == part.primitive; };
        EXPECT_EQ(std::count_if(body.laid().covered.begin(), body.laid().covered.end(), named), 1);
    }
}

// Pictures that are rendered at a time share out the frames of a film as it happens: what was laid before leaves nothing.
TEST(SnowBodyVertices, AreAsIfNothingHadLainBefore)
{
    Scene turned = scene_of({quad({-3, 0, 3}, {6, 0, 0}, {0, 0, -6})}, {plain_material(glm::vec3(0.2f))});
    turned.instances[0].to_world = glm::rotate(glm::mat4(1.0f), 0.7f, glm::vec3(0, 1, 0));
    const scene::Triangles triangles(turned, {});
    const scene::Tracer tracer(triangles);
    const auto caps = std::make_shared<const scene::SnowCaps>(scene::build_snow_caps(tracer, {}));
    SnowBody run(caps), alone(caps);
    Frame f;
    f.weather.snow_amount = 0.98f;
    for (int k = 1; k <= 20; ++k) {
        f.weather.snow_depth_m = 0.017f * static_cast<float>(k);
        run.lay(f);
    }
    f.weather.snow_depth_m = 0.2f;
    ASSERT_TRUE(run.lay(f) && alone.lay(f));
    ASSERT_FALSE(run.laid().vertices.empty());
    std::size_t compared = 0;
    for (std::size_t p = 0; p < caps->parts.size(); ++p) {
        ASSERT_EQ(run.laid().counts[p], alone.laid().counts[p]);
        for (std::uint32_t k = caps->parts[p].first_index; k < caps->parts[p].first_index + alone.laid().counts[p]; ++k, ++compared) {
            const std::uint32_t corner = alone.laid().indices[k];
            ASSERT_EQ(run.laid().indices[k], corner);
            EXPECT_EQ(run.laid().vertices[corner].tangent, alone.laid().vertices[corner].tangent);
            EXPECT_EQ(run.laid().vertices[corner].position, alone.laid().vertices[corner].position);
        }
    }
    EXPECT_GT(compared, 100u);
}

// Snow that stands on the ground throws the shadow of its body: seen from above, with a low sun.
TEST_F(SnowBodyTest, ItThrowsShadows)
{
    const auto lit = [&](float depth, bool body) {
        Frame f = frame(depth);
        f.camera = look({0, 5, 0}, {0, 0, 0});
        f.camera.orthographic_height_m = 5.0f;
        f.sky.sun_elevation_rad = 0.5f;
        f.sky.sun_azimuth_rad = 1.5707963f;  // in the east: shadows go to -x
        f.settings.snow_body = body;
        f.settings.exposure = 1e-5f;
        const RenderResult r = renderer->render(f);
        int dark = 0;
        for (int x = 0; x < kSize / 2 - 6; ++x)
            dark += luminance(pixel(r, x, kSize / 2)) < 0.5f * luminance(pixel(r, 3, 6)) ? 1 : 0;
        return dark;
    };
    renderer->load(scene, {}, caps);
    EXPECT_GT(lit(0.18f, false), 10);
    EXPECT_GE(lit(0.18f, true), 10);
}

}  // namespace
}  // namespace petrichor::gpu
