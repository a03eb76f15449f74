// Patches of a scene are made once and found again.
#include "film/scenes/transport.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>

#include "film/jobs/sequence.h"
#include "scene/gltf/gltf.h"
#include "scene/patches/patch_file.h"
#include "tests/support/program.h"

namespace petrichor::film {
namespace {

using testing_program::Workplace;

scene::Scene tiny_scene()
{
    const std::string glb = testing_program::tiny_scene_glb();
    return scene::load_gltf(std::as_bytes(std::span(glb)), "tiny.glb",
                            [](const std::string&) { return std::vector<std::byte>(); });
}

TransportOptions options_in(const Workplace& place)
{
    TransportOptions options;
    options.cache = ContentCache(place.path(), 64u << 20);
    return options;
}

bool same_bytes(const SceneTransport& a, const SceneTransport& b)
{
    return scene::patches_to_bytes(a.patches) == scene::patches_to_bytes(b.patches) &&
           a.surfaces.size() == b.surfaces.size() &&
           std::memcmp(a.surfaces.data(), b.surfaces.data(),
                       a.surfaces.size() * sizeof(scene::PatchSurface)) == 0;
}

TEST(Transport, IsFoundAgainBitForBit)
{
    const Workplace place("transport_kept");
    const scene::Scene scene = tiny_scene();
    const SceneTransport cold = prepare_transport(scene, options_in(place));
    EXPECT_FALSE(cold.kept);
    ASSERT_GT(cold.patches.count, 0u);
    const SceneTransport warm = prepare_transport(scene, options_in(place));
    EXPECT_TRUE(warm.kept);
    EXPECT_TRUE(same_bytes(cold, warm));
    EXPECT_TRUE(same_bytes(cold, prepare_transport(scene, {}))) << "without a cache";
}

TEST(Transport, ShapeAndColourHaveKeysOfTheirOwn)
{
    const Workplace place("transport_keys");
    scene::Scene scene = tiny_scene();
    const SceneTransport first = prepare_transport(scene, options_in(place));
    // A new colour: the same patches, other surfaces.
    scene.materials[0].base_color = {0.1f, 0.2f, 0.3f, 1.0f};
    const SceneTransport painted = prepare_transport(scene, options_in(place));
    EXPECT_FALSE(painted.kept);
    EXPECT_EQ(scene::patches_to_bytes(first.patches), scene::patches_to_bytes(painted.patches));
    EXPECT_NE(first.surfaces[0].base_color, painted.surfaces[0].base_color);
    // Another shape.
    scene.instances[0].to_world[3].y += 0.5f;
    EXPECT_FALSE(prepare_transport(scene, options_in(place)).kept);
}

TEST(Transport, HugeScenesAreLitByPatchesWhenAsked)
{
    Sequence sequence;
    sequence.triangles = 200'000;
    EXPECT_TRUE(wants_patches(sequence));
    sequence.triangles = 10'000'000;
    EXPECT_FALSE(wants_patches(sequence));
    sequence.scenario.render.indirect = IndirectLight::Patches;
    EXPECT_TRUE(wants_patches(sequence));
    sequence.scenario.render.image_based_light = false;
    EXPECT_FALSE(wants_patches(sequence));
}

TEST(Transport, ADamagedEntryIsMadeAgain)
{
    const Workplace place("transport_damaged");
    const scene::Scene scene = tiny_scene();
    const SceneTransport cold = prepare_transport(scene, options_in(place));
    int spoiled = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(place.path())) {
        if (!entry.is_regular_file()) continue;
        std::fstream file(entry.path(), std::ios::in | std::ios::out | std::ios::binary);
        file.seekp(200);
        file.put('\x5a');
        file.put('\xa5');
        ++spoiled;
    }
    ASSERT_GE(spoiled, 2);
    const SceneTransport again = prepare_transport(scene, options_in(place));
    EXPECT_FALSE(again.kept);
    EXPECT_TRUE(same_bytes(cold, again));
}

}  // namespace
}  // namespace petrichor::film
