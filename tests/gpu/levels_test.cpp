// Levels of detail: by size in the picture, with a band where two share the pixels.
#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

class LevelsTest : public GpuTest {};

// A red square and a green one that stands in for it below half of the picture's height.
Scene two_levels()
{
    Material red = plain_material(glm::vec3(0.9f, 0.05f, 0.05f));
    Material green = plain_material(glm::vec3(0.05f, 0.9f, 0.05f));
    Scene scene = scene_of({quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0})}, {red, green});
    scene.meshes.push_back({"coarse", {quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, 1)}});
    scene.instances.push_back(scene.instances[0]);
    scene.instances[1].mesh = 1;
    for (Instance& instance : scene.instances) {
        instance.detail.centre_m = glm::vec3(0.0f);
        instance.detail.radius_m = 1.0f;
    }
    scene.instances[0].detail.low = 0.5f;
    scene.instances[1].detail.level = 1;
    scene.instances[1].detail.high = 0.5f;
    scene.instances[1].detail.low = 0.1f;
    return scene;
}

// So that the sphere of 1 m has this share of the picture's height.
Frame at_coverage(float coverage)
{
    Frame frame;
    const float away_m = 1.0f / (coverage * std::tan(0.4f));
    frame.camera = look({0, 0, away_m}, {0, 0, 0}, 0.8f);
    frame.settings.width = frame.settings.height = 64;
    frame.settings.samples = 1;
    frame.settings.aovs = {"base_color", "depth"};
    return frame;
}

struct Seen {
    int red = 0, green = 0, nothing = 0;  // of the middle 16 x 16 pixels
};

Seen seen(const RenderResult& r)
{
    Seen counted;
    for (int y = 24; y < 40; ++y) {
        for (int x = 24; x < 40; ++x) {
            const float a = aov(r, "base_color", x, y, 0), b = aov(r, "base_color", x, y, 1);
            ++(a > 0.5f ? counted.red : b > 0.5f ? counted.green : counted.nothing);
        }
    }
    return counted;
}

TEST_F(LevelsTest, TheSizeInThePictureChooses)
{
    renderer->load(two_levels(), {});
    EXPECT_EQ(seen(renderer->render(at_coverage(0.8f))).red, 256);
    EXPECT_EQ(seen(renderer->render(at_coverage(0.41f))).green, 256);
    Frame frame = at_coverage(0.41f);
    frame.settings.lod_scale = 2.0f;
    EXPECT_EQ(seen(renderer->render(frame)).red, 256);
    frame = at_coverage(0.8f);
    frame.settings.lod_scale = 0.1f;  // too small for any level
    EXPECT_EQ(seen(renderer->render(frame)).nothing, 256);
    frame = at_coverage(0.8f);
    frame.camera.orthographic_height_m = 2.5f;
    EXPECT_EQ(seen(renderer->render(frame)).red, 256);
    frame.camera.orthographic_height_m = 5.0f;
    EXPECT_EQ(seen(renderer->render(frame)).green, 256);
}

// Where they change, every pixel has one of the two, and their shares follow the size.
TEST_F(LevelsTest, NeighboursShareThePixels)
{
    for (const SurfacePath path : {SurfacePath::Fragment, SurfacePath::Visibility}) {
        renderer->load(two_levels(), {});
        int before = 0;
        for (const float coverage : {0.455f, 0.48f, 0.50f, 0.52f, 0.545f}) {
            Frame frame = at_coverage(coverage);
            frame.settings.surface_path = path;
            const Seen s = seen(renderer->render(frame));
            EXPECT_EQ(s.nothing, 0) << coverage;
            EXPECT_GT(s.red, before) << coverage;
            EXPECT_NEAR(s.red / 256.0, 0.5 + (static_cast<double>(coverage) / 0.5 - 1.0) / 0.24, 0.06) << coverage;
            before = s.red;
        }
    }
}

TEST_F(LevelsTest, AFrameDoesNotDependOnThoseBefore)
{
    renderer->load(two_levels(), {});
    renderer->render(at_coverage(0.9f));
    renderer->render(at_coverage(0.2f));
    const RenderResult run = renderer->render(at_coverage(0.49f));
    renderer->load(two_levels(), {});
    EXPECT_EQ(renderer->render(at_coverage(0.49f)).beauty, run.beauty);
}

// Without levels no draw is another.
TEST_F(LevelsTest, OneLevelIsAlwaysThere)
{
    Scene scene = two_levels();
    scene.instances.resize(1);
    scene.instances[0].detail = {};
    renderer->load(scene, {});
    EXPECT_EQ(seen(renderer->render(at_coverage(0.41f))).red, 256);
}

}  // namespace
}  // namespace petrichor::gpu
