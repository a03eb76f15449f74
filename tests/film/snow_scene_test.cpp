// Where snow has a body is worked out once and found again.
#include "film/scenes/snow_scene.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "scene/gltf/gltf.h"
#include "scene/snow/snow_caps_file.h"
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

std::vector<std::filesystem::path> entries_of(const Workplace& place)
{
    std::vector<std::filesystem::path> entries;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(place.path()))
        if (entry.is_regular_file()) entries.push_back(entry.path());
    return entries;
}

TEST(SnowScene, IsFoundAgainBitForBit)
{
    const Workplace place("snow_caps_kept");
    const ContentCache cache(place.path(), 64u << 20);
    scene::Scene scene = tiny_scene();
    std::vector<std::string> notes;
    const auto bytes_of = [&](const ContentCache& from, const gpu::TrackMap& tracks) {
        return scene::snow_caps_to_bytes(*prepare_snow(scene, {{0, 2, 4}}, tracks, from, {}, notes));
    };
    const auto cold = bytes_of(cache, {});
    ASSERT_GT(cold.size(), 1000u);
    ASSERT_EQ(entries_of(place).size(), 1u);
    EXPECT_EQ(bytes_of(cache, {}), cold);
    EXPECT_EQ(entries_of(place).size(), 1u) << "found";
    EXPECT_EQ(bytes_of({}, {}), cold) << "without a cache";
    // What was kept is what is shown: another entry under the same name would be seen.
    {
        std::fstream file(entries_of(place)[0], std::ios::in | std::ios::out | std::ios::binary);
        file.seekp(300);
        file.put('\x5a');
        file.put('\xa5');
    }
    EXPECT_EQ(bytes_of(cache, {}), cold) << "a damaged entry is made again";
    // Tracks and another shape have entries of their own.
    gpu::TrackMap tracks;
    tracks.width = tracks.height = 64;
    tracks.rgba.assign(64 * 64 * 4, std::byte{128});
    tracks.low_m = -1.0f;
    tracks.high_m = 1.0f;
    bytes_of(cache, tracks);
    EXPECT_EQ(entries_of(place).size(), 2u);
    scene.instances[0].to_world[3].y += 0.5f;
    bytes_of(cache, {});
    EXPECT_EQ(entries_of(place).size(), 3u);
}

}  // namespace
}  // namespace petrichor::film
