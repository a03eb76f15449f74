// Instances with values of their own.
#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

class InstanceLooks : public GpuTest {};

// Three squares of one mesh and material, side by side; the middle one is as the material is.
Scene three()
{
    Material m = plain_material(glm::vec3(0.5f), 0.8f);
    m.emissive = glm::vec3(1.0f);
    m.emissive_strength = 10.0f;
    Scene scene = scene_of({quad({-0.3f, 0, 0.3f}, {0.6f, 0, 0}, {0, 0, -0.6f})}, {m});
    for (const float x : {-0.65f, 0.65f}) {
        scene.instances.push_back(scene.instances[0]);
        scene.instances.back().to_world[3].x = x;
    }
    scene.instances[1].look.color = glm::vec3(0.9f, 0.1f, 0.2f);
    scene.instances[1].look.roughness = 0.25f;
    scene.instances[2].look.metallic = 1.0f;
    scene.instances[2].look.emission = 3.0f;
    return scene;
}

Frame from_above(SurfacePath path)
{
    Frame frame;
    frame.camera = look({0, 2, 0}, {0, 0, 0});
    frame.camera.orthographic_height_m = 2.0f;
    frame.settings.width = frame.settings.height = 64;
    frame.settings.samples = 1;
    frame.settings.surface_path = path;
    frame.settings.aovs = {"base_color", "roughness", "metallic", "emission"};
    return frame;
}

TEST_F(InstanceLooks, ReplaceTheFactorsOfTheMaterial)
{
    renderer->load(three(), {});
    for (const SurfacePath path : {SurfacePath::Fragment, SurfacePath::Visibility}) {
        const RenderResult r = renderer->render(from_above(path));
        const int left = 11, middle = 32, right = 53, y = 32;
        EXPECT_NEAR(aov(r, "base_color", left, y, 0), 0.9f, 0.005f);
        EXPECT_NEAR(aov(r, "base_color", left, y, 1), 0.1f, 0.005f);
        EXPECT_NEAR(aov(r, "roughness", left, y), 0.25f, 0.005f);
        EXPECT_NEAR(aov(r, "metallic", left, y), 0.0f, 0.005f);
        EXPECT_NEAR(aov(r, "emission", left, y), 10.0f, 0.05f);
        EXPECT_NEAR(aov(r, "base_color", middle, y), 0.5f, 0.005f);
        EXPECT_NEAR(aov(r, "roughness", middle, y), 0.8f, 0.005f);
        EXPECT_NEAR(aov(r, "emission", middle, y), 10.0f, 0.05f);
        EXPECT_NEAR(aov(r, "base_color", right, y), 0.5f, 0.005f);
        EXPECT_NEAR(aov(r, "metallic", right, y), 1.0f, 0.005f);
        EXPECT_NEAR(aov(r, "emission", right, y), 30.0f, 0.1f);
    }
}

TEST_F(InstanceLooks, ThatSayNothingChangeNoBit)
{
    Scene scene = three();
    for (scene::Instance& instance : scene.instances) instance.look = {};
    renderer->load(scene, {});
    const RenderResult plain = renderer->render(from_above(SurfacePath::Fragment));
    for (scene::Instance& instance : scene.instances) {
        instance.look.color = glm::vec3(0.5f);
        instance.look.roughness = 0.8f;
        instance.look.emission = 1.0f;
    }
    renderer->load(scene, {});
    EXPECT_EQ(renderer->render(from_above(SurfacePath::Fragment)).beauty, plain.beauty);
}

}  // namespace
}  // namespace petrichor::gpu
