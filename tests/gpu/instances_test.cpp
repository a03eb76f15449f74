// Instances of one mesh and material: one draw of many, the same picture.
#include "gpu/upload/draw.h"
#include "gpu/passes/depth_maps/depth_maps.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

class Instances : public GpuTest {};

// A corner of a box: three sides, so that both facings are seen.
Mesh corner()
{
    return {"corner",
            {quad({0, 0, 0}, {0, 0, 1}, {1, 0, 0}), quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}),
             quad({0, 0, 0}, {0, 1, 0}, {0, 0, 1})}};
}

// Six by six of them, turned and scaled; every fifth is mirrored.
Scene field(const Material& material, bool own_meshes)
{
    Scene scene;
    scene.materials = {material};
    scene.meshes = {corner()};
    for (int i = 0; i < 36; ++i) {
        glm::mat4 m(1.0f);
        m = glm::translate(m, {static_cast<float>(i % 6) - 2.5f, 0.1f * static_cast<float>(i % 4),
                               static_cast<float>(i / 6) - 2.5f});
        m = glm::rotate(m, 0.7f * static_cast<float>(i), glm::vec3(0, 1, 0));
        m = glm::scale(m, glm::vec3(i % 5 == 0 ? -0.8f : 0.8f, 0.6f, 0.9f));
        if (own_meshes && i > 0) scene.meshes.push_back(corner());
        scene.instances.push_back({"corner", own_meshes ? static_cast<std::uint32_t>(i) : 0u, m});
    }
    return scene;
}

Material cut_out()
{
    Material m = plain_material(glm::vec3(0.5f));
    m.base_color.a = 0.6f;
    m.alpha_mode = AlphaMode::Blend;
    m.double_sided = true;
    return m;
}

// Solid, let through by chance, in layers; dry, and in rain, where depth comes first. Some look otherwise.
TEST_F(Instances, OneDrawOfManyShowsWhatManyDrawsShow)
{
    struct Way {
        Material material;
        int layers = 0;
        float rain = 0.0f;
    };
    const Material plain = plain_material(glm::vec3(0.6f, 0.4f, 0.3f));
    for (const Way& way : {Way{plain}, Way{plain, 0, 0.8f}, Way{cut_out()}, Way{cut_out(), 3}}) {
        const auto field_of = [&](bool own_meshes) {
            Scene scene = field(way.material, own_meshes);
            for (std::size_t i = 0; i < scene.instances.size(); i += 3) scene.instances[i].look.color = glm::vec3(0.1f, 0.2f, 0.9f);
            return scene;
        };
        for (const SurfacePath path : {SurfacePath::Fragment, SurfacePath::Visibility}) {
            Frame frame;
            frame.camera = look({3, 5, 6}, {0, 0, 0});
            frame.settings.width = frame.settings.height = 96;
            frame.settings.samples = 2;
            frame.settings.surface_path = path;
            frame.settings.transparent_layers = way.layers;  // 0: let through by chance: each has its own
            frame.weather.rain = way.rain;
            frame.weather.film_smoothness = frame.weather.film_albedo = way.rain;
            frame.settings.aovs = {"normal", "depth"};
            renderer->load(field_of(true), {});
            const RenderResult many = renderer->render(frame);
            renderer->load(field_of(false), {});
            const RenderResult one = renderer->render(frame);
            EXPECT_EQ(one.beauty, many.beauty);
            for (std::size_t i = 0; i < one.aovs.size(); ++i)
                EXPECT_EQ(one.aovs[i].pixels, many.aovs[i].pixels) << one.aovs[i].name;
        }
    }
}

// A corner as modelled, and another one elsewhere: of the same material, or of one that looks the same.
Scene laid_out(bool same_material)
{
    Scene scene;
    const Material plain = plain_material(glm::vec3(0.6f, 0.4f, 0.3f));
    scene.materials = {plain, plain};
    scene.meshes = {corner(), corner()};
    for (Primitive& side : scene.meshes[1].primitives) side.material = same_material ? 0u : 1u;
    scene.instances.push_back({"corner", 0, glm::mat4(1.0f)});
    scene.instances.push_back({"other", 1, glm::translate(glm::mat4(1.0f), {-0.7f, 0.1f, 0.2f})});
    return scene;
}

TEST_F(Instances, WhatIsLaidOutInTheWorldIsShadedWithoutATransform)
{
    Frame frame;
    frame.camera = look({2, 3, 4}, {0.4f, 0.3f, 0.4f});
    frame.settings.width = frame.settings.height = 96;
    frame.settings.samples = 2;
    frame.settings.surface_path = SurfacePath::Visibility;
    frame.settings.aovs = {"normal", "depth"};
    renderer->load(laid_out(false), {});
    const RenderResult alone = renderer->render(frame);
    renderer->load(laid_out(true), {});
    const RenderResult with_another = renderer->render(frame);
    EXPECT_EQ(alone.beauty, with_another.beauty);
    for (std::size_t i = 0; i < alone.aovs.size(); ++i)
        EXPECT_EQ(alone.aovs[i].pixels, with_another.aovs[i].pixels) << alone.aovs[i].name;
}

TEST_F(Instances, OneThatIsElsewhereIsNotLaidOutInTheWorld)
{
    if (!renderer) return;
    renderer.reset();  // its device is not needed
    const Device device(RendererOptions{.device = "", .validation = true});
    const GpuScene apart(device, laid_out(false), {});
    EXPECT_TRUE(apart.materials()[0].in_world);
    EXPECT_FALSE(apart.materials()[1].in_world);
    EXPECT_FALSE(GpuScene(device, laid_out(true), {}).materials()[0].in_world);
}

TEST_F(Instances, OfOneShapeAreOneRun)
{
    if (!renderer) return;
    renderer.reset();  // its device is not needed
    const Device device(RendererOptions{.device = "", .validation = true});
    const glm::mat4 all = glm::scale(glm::mat4(1.0f), glm::vec3(0.05f));
    const auto runs = [&](const Scene& scene) {
        const GpuScene on_device(device, scene, {});
        return visible_runs(on_device, all, glm::vec3(0.0f, 5.0f, 0.0f));
    };
    const Material plain = plain_material(glm::vec3(0.5f));
    // Three primitives; 28 are as modelled, 8 are mirrored.
    const std::vector<DrawRun> one = runs(field(plain, false));
    ASSERT_EQ(one.size(), 6u);
    std::uint32_t instances = 0;
    for (const DrawRun& run : one) {
        EXPECT_TRUE(run.count == 28 || run.count == 8) << run.count;
        instances += run.count;
    }
    EXPECT_EQ(instances, 108u);
    EXPECT_EQ(runs(field(plain, true)).size(), 108u);
}

// Ground that goes round the eye would be shaded where boxes cover it, were it drawn before them.
TEST_F(Instances, WhatGoesRoundTheEyeIsDrawnBehindWhatStandsInIt)
{
    if (!renderer) return;
    renderer.reset();  // its device is not needed
    const Device device(RendererOptions{.device = "", .validation = true});
    const Material plain = plain_material(glm::vec3(0.5f));
    Scene scene;
    scene.materials = {plain, plain};
    scene.meshes = {{"ground", {quad({-40, 0, 40}, {80, 0, 0}, {0, 0, -80})}}, corner()};
    for (Primitive& side : scene.meshes[1].primitives) side.material = 1;
    scene.instances.push_back({"ground", 0, glm::mat4(1.0f)});
    for (const float away_m : {5.0f, 20.0f, 45.0f})
        scene.instances.push_back({"box", 1, glm::translate(glm::mat4(1.0f), {0.0f, 0.0f, -away_m})});
    const GpuScene on_device(device, scene, {});
    const glm::mat4 all = glm::scale(glm::mat4(1.0f), glm::vec3(0.01f));
    const std::vector<DrawRun> runs = visible_runs(on_device, all, glm::vec3(0.0f, 2.0f, 0.0f));
    ASSERT_EQ(runs.size(), 10u);
    // All of the boxes' sides are nearer than the ground is wide, and come near to far.
    for (std::size_t i = 0; i < runs.size(); ++i) EXPECT_EQ(runs[i].first->material, i < 9 ? 1u : 0u) << i;
    for (std::size_t i = 3; i < 9; ++i) EXPECT_LT(runs[i].first->centre_m.z, runs[i - 3].first->centre_m.z + 0.6f) << i;
}

TEST_F(Instances, OfOneShapeAreOneRunInDepthMaps)
{
    if (!renderer) return;
    renderer.reset();  // its device is not needed
    const Device device(RendererOptions{.device = "", .validation = true});
    const glm::mat4 all = glm::scale(glm::mat4(1.0f), glm::vec3(0.05f));
    for (const Material& material : {plain_material(glm::vec3(0.5f)), cut_out()}) {
        SeenTriangles triangles(device);
        const GpuScene one(device, field(material, false), {});
        triangles.reset(one);
        const Casters together = casters_in(triangles, one, all, 256, Falls::Light);
        EXPECT_TRUE(together.single.empty());
        ASSERT_EQ(together.runs.size(), 6u);
        std::uint32_t instances = 0;
        for (const Casters::Run& run : together.runs) {
            EXPECT_EQ(run.first_place, instances);
            instances += run.count;
        }
        EXPECT_EQ(instances, 108u);

        const GpuScene many(device, field(material, true), {});
        triangles.reset(many);
        const Casters apart = casters_in(triangles, many, all, 256, Falls::Light);
        EXPECT_EQ(apart.single.size(), 108u);
        EXPECT_TRUE(apart.runs.empty());
    }
}

// A lattice with holes that lie in a relief, as its casters are asked: many draws of one, one draw of many.
TEST_F(Instances, HolesInAReliefThrowTheSameShadows)
{
    Material m = plain_material(glm::vec3(0.6f, 0.4f, 0.3f));
    m.base_color_texture.texture = 0;
    m.alpha_mode = AlphaMode::Mask;
    m.double_sided = true;
    m.weather.height.texture = 1;
    m.weather.height_scale_m = 0.2f;
    m.weather.parallax = scene::Parallax::Occlusion;
    const auto texture = [](auto texel) {
        Texture t;
        t.name = "made up";
        t.format = TexelFormat::Rgba8Unorm;
        t.width = t.height = 16;
        t.mips.emplace_back();
        for (int y = 0; y < 16; ++y) {
            for (int x = 0; x < 16; ++x) {
                for (int c = 0; c < 4; ++c) t.mips[0].push_back(static_cast<std::byte>(texel(x, y, c)));
            }
        }
        return t;
    };
    const std::vector<Texture> textures{
        texture([](int x, int y, int c) { return c == 3 && (x / 4 + y / 4) % 2 == 0 ? 0 : 255; }),
        texture([](int x, int, int) { return x < 8 ? 0 : 255; })};
    const auto lit = [&](bool own_meshes, bool lamp) {
        Scene scene = field(m, own_meshes);
        scene.materials.push_back(plain_material(glm::vec3(0.8f)));
        scene.meshes.push_back({"floor", {quad({-5, -0.5f, 5}, {10, 0, 0}, {0, 0, -10}, 1)}});
        scene.instances.push_back({"floor", static_cast<std::uint32_t>(scene.meshes.size() - 1), glm::mat4(1.0f)});
        renderer->load(scene, textures);
        Frame frame;
        frame.camera = look({3, 5, 6}, {0, 0, 0});
        frame.settings.width = frame.settings.height = 128;
        frame.settings.samples = 1;
        frame.sky.sun_elevation_rad = lamp ? -1.0f : 0.7f;
        if (lamp) {
            Light light;
            light.position_m = {2, 4, 1};
            light.intensity = 1.0e5f;
            frame.extra_lights = {light};
        }
        return renderer->render(frame).beauty;
    };
    for (const bool lamp : {false, true}) EXPECT_EQ(lit(false, lamp), lit(true, lamp)) << lamp;

    renderer.reset();  // its device is not needed
    const Device device(RendererOptions{.device = "", .validation = true});
    SeenTriangles triangles(device);
    const GpuScene one(device, field(m, false), textures);
    triangles.reset(one);
    const Casters together =
        casters_in(triangles, one, glm::scale(glm::mat4(1.0f), glm::vec3(0.05f)), 256, Falls::Light);
    EXPECT_TRUE(together.single.empty());
    EXPECT_EQ(together.runs.size(), 6u);
}

}  // namespace
}  // namespace petrichor::gpu
