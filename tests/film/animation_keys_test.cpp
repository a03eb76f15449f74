// [scene] animation and its keys: the clock of the clips, and what follows it in a frame.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "base/error.h"
#include "film/jobs/scene_source.h"
#include "film/jobs/sequence.h"
#include "tests/support/gltf_builder.h"

namespace petrichor::film {
namespace {

namespace fs = std::filesystem;
using testing_gltf::json;

// A quad that turns in a second and carries a camera and a sun.
class AnimationKeys : public testing::Test {
protected:
    void SetUp() override
    {
        // One for each: tests run beside each other, and each takes its own away.
        folder_ = fs::path(testing::TempDir()) /
                  (std::string("animation_keys_") +
                   testing::UnitTest::GetInstance()->current_test_info()->name());
        fs::create_directories(folder_);
        auto b = testing_gltf::turning_quad();
        b.document["cameras"] = {{{"name", "rider"},
                                  {"type", "perspective"},
                                  {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
        b.document["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "directional"}}};
        b.node({{"camera", 0}, {"translation", {0, 0, 3}},
                {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}}, false);
        b.document["nodes"][0]["children"] = {1};
        const auto bytes = b.glb();
        std::ofstream(folder_ / "turning.glb", std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()),
                   static_cast<std::streamsize>(bytes.size()));
    }
    void TearDown() override { fs::remove_all(folder_); }

    Sequence sequence(const std::string& keys)
    {
        Scenario scenario = parse_scenario(
            "[scene]\nfile = \"turning.glb\"\n" + keys + "\n[output]\nframes = 8\nfps = 4\n",
            "turning.toml");
        scenario.folder = folder_;
        Sequence made = make_sequence(std::move(scenario));
        load_sequence_scene(made, 1);
        return made;
    }

    fs::path folder_;
};

TEST_F(AnimationKeys, SetTheClockOfTheClips)
{
    const Sequence plain = sequence("");
    EXPECT_THAT(plain.notes, testing::ElementsAre(testing::HasSubstr("\"turn\" (1 s)")));
    EXPECT_DOUBLE_EQ(frame_at(plain, {3, "", ""}).frame.animation_s, 0.75);
    const Sequence set = sequence("animation_speed = -2.0\nanimation_start_s = 5.0");
    EXPECT_DOUBLE_EQ(frame_at(set, {3, "", ""}).frame.animation_s, 3.5);
    EXPECT_NE(frame_parts(plain, frame_at(plain, {0, "", ""})).at("animation"),
              frame_parts(plain, frame_at(plain, {1, "", ""})).at("animation"));
    EXPECT_EQ(sequence("animation = \"none\"").scene.rig, nullptr);
    EXPECT_NE(sequence("animation = \"none\"").content, plain.content);
    EXPECT_NE(sequence("animation_loop = false").content, plain.content);
    EXPECT_THROW(sequence("animation = \"walk\""), Error);
    EXPECT_THROW(sequence("variant = \"mossy\""), Error);
}

TEST_F(AnimationKeys, CameraAndSunFollow)
{
    const Sequence s = sequence("");
    const SequenceFrame first = frame_at(s, {0, "", ""}), later = frame_at(s, {2, "", ""});
    EXPECT_EQ(first.frame.camera.name, "rider");
    EXPECT_NEAR(first.frame.camera.to_world[3].z, 3.0f, 1e-5f);
    // Half a second: 45 degrees about +y.
    EXPECT_NEAR(later.frame.camera.to_world[3].x, 2.0f + 3.0f * std::sqrt(0.5f), 1e-4f);
    EXPECT_NEAR(later.frame.camera.to_world[3].z, 3.0f * std::sqrt(0.5f), 1e-4f);
    EXPECT_NEAR(later.frame.sky.sun_azimuth_rad, 0.75 * 3.14159265358979, 1e-4);
    EXPECT_NEAR(first.frame.sky.sun_azimuth_rad, 3.14159265358979, 1e-4);
}

}  // namespace
}  // namespace petrichor::film
