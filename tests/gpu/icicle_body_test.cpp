// Icicles in pictures: seen, measured, named and shadowed as what hangs there; nothing without any.
#include "gpu/icicles/icicle_body.h"

#include <algorithm>
#include <cmath>

#include "gpu/passes/falling/drips.h"
#include "scene/icicles/icicles.h"
#include "scene/patches/tracer.h"
#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

constexpr int kSize = 96;

// A sheet that comes down to an edge 2 m above the ground, 1 m wide.
Scene awning()
{
    Material cloth = plain_material(glm::vec3(0.1f));
    cloth.double_sided = true;
    std::vector<Primitive> faces{quad({-3, 0, 3}, {6, 0, 0}, {0, 0, -6}), quad({-0.5f, 2, 0}, {1, 0, 0}, {0, 0.5f, -1.5f})};
    faces[1].material = 1;
    return scene_of(std::move(faces), {plain_material(glm::vec3(0.2f)), cloth});
}

class IcicleBodyTest : public GpuTest {
protected:
    void SetUp() override
    {
        GpuTest::SetUp();
        bare = awning();
        scene = bare;
        scene::add_icicle_material(scene);
        const scene::Triangles triangles(scene, {});
        points = scene::drip_points(scene::Tracer(triangles));
        icicles = std::make_shared<scene::Icicles>(scene::hang_icicles(points, std::vector<glm::vec3>{{0, 2, 4}}));
        ASSERT_TRUE(scene::find_icicle_material(scene, *icicles));
        ASSERT_GT(icicles->icicles.size(), 10u);
    }

    // From the front, 1 m across below the edge.
    static Frame frame(float length_m)
    {
        Frame f;
        f.camera = look({0, 1.7f, 4}, {0, 1.7f, 0});
        f.camera.orthographic_height_m = 1.0f;
        f.settings.width = f.settings.height = kSize;
        f.settings.samples = 1;
        f.settings.aovs = {"depth", "material"};
        f.sky.sun_azimuth_rad = 2.8f;
        f.icicles.length_m.fill(length_m);
        return f;
    }

    // Pixels that are named icicles, and the lowest row of them.
    struct Hanging {
        int pixels = 0, lowest = 0;
    };
    Hanging hanging(const RenderResult& r) const
    {
        Hanging h;
        for (int y = 0; y < kSize; ++y) {
            for (int x = 0; x < kSize; ++x) {
                if (std::lround(aov(r, "material", x, y)) != static_cast<long>(icicles->material)) continue;
                EXPECT_NEAR(aov(r, "depth", x, y), 4.0f, 0.1f);
                ++h.pixels;
                h.lowest = y;
            }
        }
        return h;
    }

    Scene bare, scene;
    std::vector<scene::DripPoint> points;
    std::shared_ptr<scene::Icicles> icicles;
};

TEST_F(IcicleBodyTest, HangAsLongAsTheyAre)
{
    renderer->load(scene, {}, nullptr, icicles);
    const Hanging none = hanging(renderer->render(frame(0.0f)));
    EXPECT_EQ(none.pixels, 0);
    int before = 0;
    for (const float length_m : {0.1f, 0.3f, 0.6f}) {
        float longest_m = 0.0f;
        for (const scene::Icicle& one : icicles->icicles) longest_m = std::max(longest_m, scene::icicle_length_m(one, frame(length_m).icicles));
        const Hanging h = hanging(renderer->render(frame(length_m)));
        EXPECT_GT(h.pixels, before);
        before = h.pixels;
        // The edge is 20 % of the picture below its upper border; a tip is half a pixel wide.
        EXPECT_NEAR(static_cast<float>(h.lowest) / kSize, 0.2f + longest_m, 0.045f) << length_m;
    }
}

TEST_F(IcicleBodyTest, OffOrWithoutIceItIsThePictureWithoutThem)
{
    renderer->load(bare, {});
    Frame f = frame(0.3f);
    f.settings.aovs.clear();
    const auto without = renderer->render(f).beauty;
    renderer->load(scene, {}, nullptr, icicles);
    EXPECT_NE(renderer->render(f).beauty, without);
    Frame off = f;
    off.settings.icicles = false;
    EXPECT_EQ(renderer->render(off).beauty, without);
    Frame melted = frame(0.0f);
    melted.settings.aovs.clear();
    EXPECT_EQ(renderer->render(melted).beauty, without);
}

TEST_F(IcicleBodyTest, AFrameAloneIsTheFrameOfARun)
{
    renderer->load(scene, {}, nullptr, icicles);
    const auto alone = renderer->render(frame(0.25f)).beauty;
    for (const float length_m : {0.1f, 0.5f, 0.0f, 0.31f}) renderer->render(frame(length_m));
    EXPECT_EQ(renderer->render(frame(0.25f)).beauty, alone);
}

TEST_F(IcicleBodyTest, ThrowShadows)
{
    renderer->load(scene, {}, nullptr, icicles);
    const auto ground = [&](float length_m) {
        Frame f = frame(length_m);
        f.camera = look({0, 1.5f, 2.5f}, {0, 0.0f, 0.8f});
        f.camera.orthographic_height_m = 1.6f;
        f.settings.aovs = {"diffuse_direct"};
        f.sky.sun_elevation_rad = 1.0f;
        f.sky.sun_azimuth_rad = 0.0f;
        const RenderResult r = renderer->render(f);
        double sum = 0.0;
        for (int y = kSize / 4; y < kSize; ++y)
            for (int x = 0; x < kSize; ++x) sum += static_cast<double>(aov(r, "diffuse_direct", x, y));
        return sum;
    };
    EXPECT_LT(ground(0.8f), 0.995 * ground(0.0f));
}

// A hand's width before a wall that glows red on the left and green on the right, and nothing else.
TEST_F(IcicleBodyTest, ShowTheirSurroundingsTheOtherWayRound)
{
    constexpr float kGlow = 2.0e4f;
    std::vector<Material> materials{plain_material(glm::vec3(0.2f))};
    std::vector<Primitive> faces{quad({-3, 0, 3}, {6, 0, 0}, {0, 0, -6}), quad({-6, -2, -0.06f}, {6, 0, 0}, {0, 8, 0}),
                                 quad({0, -2, -0.06f}, {6, 0, 0}, {0, 8, 0})};
    for (std::uint32_t k = 1; k < 3; ++k) {
        faces[k].material = k;
        materials.push_back(plain_material(glm::vec3(0.0f)));
        materials.back().emissive = k == 1 ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
        materials.back().emissive_strength = kGlow;
    }
    Scene walls = scene_of(std::move(faces), materials);
    scene::add_icicle_material(walls);
    std::vector<scene::DripPoint> one(points.begin(), points.begin() + 1);  // before the seam of both
    one[0].from_m = {0.0f, 1.985f, 0.015f};
    one[0].drained_m2 = 1.0f;
    auto hung = std::make_shared<scene::Icicles>(scene::hang_icicles(one, std::vector<glm::vec3>{{0, 1.9f, 1}}));
    ASSERT_TRUE(scene::find_icicle_material(walls, *hung));
    renderer->load(walls, {}, nullptr, hung);
    Frame f = frame(1.5f);
    f.camera = look({0, 1.9f, 0.45f}, {0, 1.9f, 0});
    f.camera.vertical_fov_rad = 0.25f;
    f.settings.aovs = {"material", "transmission"};
    const RenderResult r = renderer->render(f);
    const auto ice = [&](int x, int y) { return std::lround(aov(r, "material", x, y)) == static_cast<long>(hung->material); };
    int width = 0;
    for (int x = 0; x < kSize; ++x) width += ice(x, kSize / 2) ? 1 : 0;
    ASSERT_GT(width, 16);
    // Of half of its width, beside the seam.
    const auto mean = [&](int from, int to) {
        glm::dvec3 sum(0.0);
        int pixels = 0;
        for (int y = kSize / 2 - 4; y < kSize / 2 + 4; ++y) {
            for (int x = kSize / 2 + from; x < kSize / 2 + to; ++x) {
                EXPECT_TRUE(ice(x, y));
                for (int c = 0; c < 3; ++c) sum[c] += static_cast<double>(aov(r, "transmission", x, y, c)) / static_cast<double>(kGlow);
                ++pixels;
            }
        }
        return sum / static_cast<double>(pixels);
    };
    const glm::dvec3 left = mean(-width / 4, -2), right = mean(2, width / 4);
    EXPECT_GT(left.y, 10.0 * left.x);
    EXPECT_GT(right.x, 10.0 * right.y);
    // Most of what the walls send out comes through.
    EXPECT_NEAR(left.y, 0.68, 0.04);
    EXPECT_NEAR(right.x, 0.68, 0.04);
}

TEST_F(IcicleBodyTest, WaterDripsFromTheirTips)
{
    IcicleBody body(icicles);
    EXPECT_FALSE(body.lay(frame(0.0f)));
    EXPECT_TRUE(body.laid().vertices.empty());
    EXPECT_TRUE(body.lay(frame(0.4f)));
    EXPECT_FALSE(body.lay(frame(0.4f))) << "the same again";
    const auto tips = body.tips(points);
    ASSERT_EQ(tips.size(), points.size());
    for (const scene::Icicle& one : icicles->icicles) {
        const float length_m = scene::icicle_length_m(one, frame(0.4f).icicles);
        EXPECT_NEAR(tips[one.drip].from_m.y, points[one.drip].from_m.y - length_m, 0.01f);
    }
    EXPECT_TRUE(body.lay(frame(0.0f)));
    EXPECT_EQ(body.tips(points)[3].from_m, points[3].from_m);
}

}  // namespace
}  // namespace petrichor::gpu
