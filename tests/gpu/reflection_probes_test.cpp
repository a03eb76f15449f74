// Mirrors see what the picture does not show.
#include "scene/probes/probes.h"
#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

// A mirror on the floor below a ceiling that glows, red towards -x, green towards +x; the eye between the
// two looks down, so the ceiling is never in the picture.
struct Hall {
    Hall()
    {
        Material mirror = plain_material(glm::vec3(1.0f), 0.0f);
        mirror.metallic = 1.0f;
        Material red = plain_material(glm::vec3(0.0f), 1.0f), green = red;
        red.emissive = {2, 0, 0};
        green.emissive = {0, 2, 0};
        scene = scene_of({quad({-8, 0, 8}, {16, 0, 0}, {0, 0, -16}, 0),
                          quad({-8, 4, -8}, {8, 0, 0}, {0, 0, 16}, 1),
                          quad({0, 4, -8}, {8, 0, 0}, {0, 0, 16}, 2)},
                         {mirror, red, green});
        patches = std::make_shared<PatchScene>();
        const scene::Triangles triangles(scene, {});
        const scene::Tracer tracer(triangles);
        scene::PatchOptions options;
        options.cell_m = 0.5f;
        patches->patches = scene::build_patches(tracer, options);
        patches->surfaces = scene::patch_surfaces(patches->patches, triangles, {});
        patches->materials = scene.materials;
        scene::ProbePlace place;
        place.position_m = {2.0f, 1.6f, 0.0f};
        place.low_m = {-8, 0, -8};
        place.high_m = {8, 4, 8};
        patches->probes.push_back(
            scene::trace_probe(patches->patches, tracer, patches->surfaces, {}, place));
    }
    Scene scene;
    std::shared_ptr<PatchScene> patches;
};

class ReflectionProbesTest : public GpuTest {
protected:
    // Floor at x metres beside the eye.
    glm::vec3 mirrored(const RenderResult& r, float x)
    {
        return pixel(r, 32 + static_cast<int>(std::lround(32.0f * x / 1.5f)), 32);
    }
    RenderResult shot(const Hall& hall)
    {
        renderer->load(hall.scene, {});
        renderer->set_patches(hall.patches);
        renderer->set_environment(constant_environment(1.0f));
        Frame frame;
        frame.camera = look({0, 3, 0.001f}, {0, 0, 0}, 2.0f * std::atan(0.5f));
        frame.sky.sun_illuminance = 0.0f;
        frame.settings.width = frame.settings.height = 64;
        frame.settings.samples = 1;
        frame.settings.ambient_occlusion = false;
        frame.weather.visibility_m = 1e9f;
        return renderer->render(frame);
    }
};

TEST_F(ReflectionProbesTest, AMirrorSeesTheCeilingBehindTheEye)
{
    Hall hall;
    const RenderResult with = shot(hall);
    // From the probe, 2 m towards +x, all of this would be green: the walls of the box decide.
    for (const float x : {-1.2f, -0.8f, -0.4f}) {
        EXPECT_NEAR(mirrored(with, x).r, 2.0f, 0.1f) << x;
        EXPECT_NEAR(mirrored(with, x).g, 0.0f, 0.1f) << x;
    }
    for (const float x : {0.4f, 0.8f, 1.2f}) {
        EXPECT_NEAR(mirrored(with, x).g, 2.0f, 0.1f) << x;
        EXPECT_NEAR(mirrored(with, x).r, 0.0f, 0.1f) << x;
    }
    hall.patches->probes.clear();
    const glm::vec3 without = mirrored(shot(hall), 0.8f);
    EXPECT_NEAR(without.r, without.g, 1e-3f) << "the sky alone";
}

TEST_F(ReflectionProbesTest, OutsideItsBoxAProbeDoesNotCount)
{
    Hall hall;
    const glm::vec3 without = [&] {
        Hall bare;
        bare.patches->probes.clear();
        return mirrored(shot(bare), 0.8f);
    }();
    scene::ProbePlace& place = hall.patches->probes[0].place;
    place.low_m = {3, 0, -8};
    place.position_m.x = 4.0f;
    place.blend_m = 1.0f;
    const glm::vec3 far = mirrored(shot(hall), 0.8f);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(far[c], without[c], 1e-4f);
}

TEST_F(ReflectionProbesTest, TheMoreImportantOneCounts)
{
    Hall hall;
    scene::TracedProbe bright = hall.patches->probes[0];
    bright.place.intensity = 3.0f;
    bright.place.importance = 2.0f;
    hall.patches->probes.push_back(bright);
    EXPECT_NEAR(mirrored(shot(hall), 0.8f).g, 6.0f, 0.3f);
    std::swap(hall.patches->probes[0], hall.patches->probes[1]);
    EXPECT_NEAR(mirrored(shot(hall), 0.8f).g, 6.0f, 0.3f);
    hall.patches->probes[0].place.importance = hall.patches->probes[1].place.importance;
    EXPECT_NEAR(mirrored(shot(hall), 0.8f).g, 4.0f, 0.2f) << "as much as each other";
}

// Too rough for a mirror of its own: seen along, the middle of the floor has the light of the half that it is seen
// towards. Patches alone know how much light there is, not from where.
TEST_F(ReflectionProbesTest, RoughMetalHasTheLightOfTheSideItIsSeenTowards)
{
    Hall hall;
    hall.scene.materials[0].roughness = 0.5f;
    hall.patches->probes[0].place.position_m.x = 0.0f;
    scene::Triangles triangles(hall.scene, {});
    const scene::Tracer tracer(triangles);
    hall.patches->probes[0] = scene::trace_probe(hall.patches->patches, tracer, hall.patches->surfaces, {}, hall.patches->probes[0].place);
    const auto seen = [&](float from) {
        renderer->load(hall.scene, {});
        renderer->set_patches(hall.patches);
        renderer->set_environment(constant_environment(0.0f));
        Frame frame;
        frame.camera = look({from, 1.2f, 0.001f}, {0, 0, 0}, 0.2f);
        frame.sky.sun_illuminance = 0.0f;
        frame.settings.width = frame.settings.height = 16;
        frame.settings.samples = 1;
        frame.emissive_lights = false;  // no highlights of the ceiling
        frame.settings.ambient_occlusion = false;
        frame.weather.visibility_m = 1e9f;
        return pixel(renderer->render(frame), 8, 8);
    };
    const glm::vec3 towards_green = seen(-2.0f), towards_red = seen(2.0f);
    EXPECT_GT(towards_green.g, 2.0f * towards_green.r);
    EXPECT_GT(towards_red.r, 2.0f * towards_red.g);
    hall.patches->probes.clear();
    const glm::vec3 without = seen(-2.0f), other = seen(2.0f);
    EXPECT_NEAR(without.g, other.g, 0.05f * other.g);
    EXPECT_NEAR(without.r, other.r, 0.05f * other.r);
}

// A long rough floor with three probes along it, alike in what they send down, not in where it comes from: high above
// or low around. The floor mirrors what is low, so it is bright below the outer two, dark below the one between
// them, and nowhere does it step.
TEST_F(ReflectionProbesTest, ARoughFloorPassesFromProbeToProbeWithoutAStep)
{
    Hall hall;
    hall.scene.materials[0].roughness = 0.5f;
    const float above[] = {1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    const float around[] = {0, 0, 0, 1, 1, 1, 0, 0, 0, 0, 0, 0};
    const scene::TracedProbe model = hall.patches->probes[0];
    hall.patches->probes.clear();
    for (const float x : {-4.0f, 0.0f, 4.0f}) {
        scene::TracedProbe probe = model;
        probe.place.position_m.x = x;
        probe.picture = scene::probe_picture(1, 4, x == 0.0f ? above : around);
        hall.patches->probes.push_back(probe);
    }
    renderer->load(hall.scene, {});
    renderer->set_patches(hall.patches);
    renderer->set_environment(constant_environment(0.0f));
    Frame frame;
    frame.camera = look({0, 1.5f, 5.0f}, {0, 0, 0}, 0.4f);
    frame.sky.sun_illuminance = 0.0f;
    frame.settings.width = 512;
    frame.settings.height = 64;
    frame.settings.samples = 1;
    frame.emissive_lights = false;
    frame.settings.ambient_occlusion = false;
    frame.weather.visibility_m = 1e9f;
    const RenderResult r = renderer->render(frame);
    float most = 0.0f, least = 1e9f, step = 0.0f, before = -1.0f;
    for (int x = 32; x < 480; ++x) {  // the floor goes on beyond
        const glm::vec3 seen = pixel(r, x, 32);
        const float here = seen.r + seen.g;
        most = std::max(most, here);
        least = std::min(least, here);
        if (before >= 0.0f) step = std::max(step, std::abs(here - before));
        before = here;
    }
    EXPECT_GT(most, 1.25f * least);
    EXPECT_LT(step, 0.02f * most);
}

// A picture of the place stands for what would be traced, whatever the light of the frame.
TEST_F(ReflectionProbesTest, APictureStandsInForWhatWasTraced)
{
    Hall hall;
    scene::TracedProbe& probe = hall.patches->probes[0];
    const float blue[] = {0.0f, 0.0f, 0.5f};
    probe.picture = scene::probe_picture(1, 1, blue);
    probe.place.intensity = 6.0f;
    for (const float x : {-0.8f, 0.8f}) {
        const glm::vec3 seen = mirrored(shot(hall), x);
        EXPECT_NEAR(seen.b, 3.0f, 0.1f) << x;
        EXPECT_NEAR(seen.r + seen.g, 0.0f, 0.05f) << x;
    }
}

TEST_F(ReflectionProbesTest, AProbeIsLitByTheLightOfItsFrame)
{
    const Hall hall;
    const float lit = mirrored(shot(hall), 0.8f).g;
    renderer->load(hall.scene, {});
    renderer->set_patches(hall.patches);
    Frame frame;
    frame.camera = look({0, 3, 0.001f}, {0, 0, 0}, 2.0f * std::atan(0.5f));
    frame.sky.sun_illuminance = 0.0f;
    frame.settings.width = frame.settings.height = 64;
    frame.settings.samples = 1;
    frame.emissive_scale = 0.25f;
    renderer->set_environment(constant_environment(0.0f));
    EXPECT_NEAR(mirrored(renderer->render(frame), 0.8f).g, 0.25f * lit, 0.05f * lit);
}

}  // namespace
}  // namespace petrichor::gpu
