#include "film/frames/job.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "base/error.h"
#include "film/jobs/scene_places.h"
#include "film/jobs/sequence.h"
#include "film/scenario/look_keys.h"

namespace petrichor::film {
namespace {

constexpr const char* kParts = R"(
[sun]
elevation_degrees = 40
[look]
snow_color = [0.5, 0.5, 0.5]
[output]
frames = 3
[[variant]]
name = "dry"
[[variant]]
name = "snow"
[variant.weather]
preset = "first-snow"
[variant.sun]
elevation_degrees = 5
[variant.look]
ripple_tiling = [[0, 1.0], [10, 3.0]]
[[view]]
name = "left"
[view.camera]
position_m = [-4, 2, 8]
look_at_m = [0, 1, 0]
[[view]]
name = "right"
[view.camera]
position_m = [4, 2, 8]
look_at_m = [0, 1, 0]
)";

TEST(Job, ItsNamesArePartOfItsFiles)
{
    EXPECT_EQ(file_name({.frame = 3}, "exr"), "frame_0003.exr");
    EXPECT_EQ(file_name({3, "wet", "left"}, "exr"), "frame_0003_wet_left.exr");
    EXPECT_EQ(file_name({12345, "", "left"}, "png"), "frame_12345_left.png");
}

TEST(Job, AShardIsAnEqualPartAndTheyAreAll)
{
    const Sequence sequence = make_sequence(parse_scenario(kParts, "s.toml"));
    const auto all = jobs_of(sequence, {0, 2});
    ASSERT_EQ(all.size(), 12u);
    EXPECT_EQ(all[1], (Job{0, "dry", "right"}));
    EXPECT_EQ(all[2], (Job{0, "snow", "left"}));
    std::vector<Job> joined;
    for (int i = 1; i <= 5; ++i) {
        const auto part = jobs_of(sequence, {0, 2}, {i, 5});
        EXPECT_LE(part.size(), 3u);
        EXPECT_GE(part.size(), 2u);
        joined.insert(joined.end(), part.begin(), part.end());
    }
    EXPECT_EQ(joined, all);
    for (const char* bad : {"", "2", "0/3", "4/3", "a/3", "1/0", "1/2/3"})
        EXPECT_THROW(parse_shard(bad), Error) << bad;
    EXPECT_EQ(parse_shard("2/8").count, 8);
}

TEST(Job, AVariantChangesWhatItSaysAndNothingElse)
{
    const Sequence sequence = make_sequence(parse_scenario(kParts, "s.toml"));
    const auto dry = frame_at(sequence, {1, "dry", "left"}).frame;
    const auto snow = frame_at(sequence, {1, "snow", "left"}).frame;
    EXPECT_NEAR(dry.sky.sun_elevation_rad, 0.698f, 1e-3f);
    EXPECT_NEAR(snow.sky.sun_elevation_rad, 0.0873f, 1e-3f);
    EXPECT_GT(snow.weather.snow_amount + snow.weather.snowfall, 0.0f);
    EXPECT_EQ(dry.weather.snow_amount, 0.0f);
    EXPECT_EQ(dry.look.snow_color.x, 0.5f);
    EXPECT_EQ(snow.look.snow_color.x, 0.5f) << "the scenario's own, where the variant is silent";
    EXPECT_GT(snow.look.ripple_tiling, 1.0f);
    EXPECT_EQ(dry.look.ripple_tiling, 0.8f);
    EXPECT_EQ(dry.camera.to_world, snow.camera.to_world);
    const auto right = frame_at(sequence, {1, "dry", "right"}).frame;
    EXPECT_EQ(right.camera.to_world[3].x, 4.0f);
    EXPECT_EQ(dry.camera.to_world[3].x, -4.0f);
    EXPECT_THROW(frame_at(sequence, {1, "wet", "left"}), Error);
}

// Pictures of places are those of the frame where no place has weather of its own: that is said.
TEST(Job, PicturesOfPlacesWithoutPlacesAreNamed)
{
    const auto notes_of = [](const std::string& aovs) {
        const Sequence sequence = make_sequence(parse_scenario("[output]\naovs = " + aovs + "\n", "s.toml"));
        std::vector<std::string> notes;
        const ScenePlaces places(sequence, 1, {}, {}, notes);
        return notes;
    };
    EXPECT_THAT(notes_of("[\"depth\", \"rain_exposure\", \"ice\"]"),
                testing::Contains(testing::AllOf(testing::StartsWith("ice, rain_exposure: "),
                                                 testing::HasSubstr("[ground] patches = true"))));
    EXPECT_THAT(notes_of("[\"depth\"]"), testing::IsEmpty());
}

// Keys and presets have the weather of places by default, where light is of patches.
TEST(Job, APresetHasPlacesUnlessTheyAreOff)
{
    const auto asks_for_patches = [](const std::string& text) {
        const Sequence sequence = make_sequence(parse_scenario(text, "s.toml"));
        std::vector<std::string> notes;
        const ScenePlaces places(sequence, 1, {}, {}, notes);
        return std::find(notes.begin(), notes.end(),
                         "no surface stops light: the weather is the same everywhere") != notes.end();
    };
    const std::string preset = "[weather]\npreset = \"storm\"\n";
    EXPECT_TRUE(asks_for_patches(preset));
    EXPECT_TRUE(asks_for_patches("[weather]\nkeys = [{ time_s = 0, temperature_c = 9, rainfall = 0.9 }]\n"));
    EXPECT_FALSE(asks_for_patches(preset + "[ground]\npatches = false\n"));
    const std::string ambient = "[render]\nindirect = \"ambient\"\n";
    EXPECT_FALSE(asks_for_patches(preset + ambient)) << "nothing else would trace the scene";
    EXPECT_TRUE(asks_for_patches(preset + ambient + "[ground]\npatches = true\n"));
    EXPECT_FALSE(asks_for_patches("")) << "no weather";
}

TEST(Job, PartsNeedGoodNames)
{
    for (const char* bad :
         {"[[variant]]\n", "[[variant]]\nname = \"a b\"\n", "[[view]]\nname = \"../x\"\n",
          "[[variant]]\nname = \"a\"\n[[variant]]\nname = \"a\"\n", "[variant]\nname = \"a\"\n",
          "[[variant]]\nname = \"a\"\n[variant.output]\nwidth = 3\n",
          "[[view]]\nname = \"a\"\n[view.camera]\nposition_m = [1, 2, 3]\n"}) {
        EXPECT_THROW(parse_scenario(bad, "s.toml"), Error) << bad;
    }
}

// Every key of [look] reaches the renderer's struct, at the time it is keyed for.
TEST(Look, EveryKeyReachesTheFrame)
{
    const shared::WeatherLook plain = look_at({}, 0.0);
    std::size_t bytes = 0;
    for (const LookKey& key : look_keys()) {
        // Two numbers that a float holds exactly, in the key's range.
        const float bottom = static_cast<float>(key.low) + 0.25f;
        const float top = key.high < static_cast<double>(bottom) + 0.5 ? bottom + 0.125f : bottom + 0.5f;
        std::string low, high;
        for (std::size_t i = 0; i < key.count; ++i) {
            low += (i ? ", " : "") + std::to_string(bottom);
            high += (i ? ", " : "") + std::to_string(top);
        }
        if (key.count > 1) {
            low = "[" + low + "]";
            high = "[" + high + "]";
        }
        const auto scenario = parse_scenario(
            "[look]\n" + key.name + " = [[0, " + low + "], [10, " + high + "]]\n", "s.toml");
        shared::WeatherLook looks[] = {look_at(scenario.look, 0.0), look_at(scenario.look, 10.0)};
        for (std::size_t i = 0; i < key.count; ++i) {
            const auto number = [&](shared::WeatherLook& look) {
                return *reinterpret_cast<float*>(reinterpret_cast<char*>(&look) + key.offset +
                                                 i * sizeof(float));
            };
            EXPECT_EQ(number(looks[0]), bottom) << key.name;
            EXPECT_EQ(number(looks[1]), top) << key.name;
        }
        bytes += key.count * sizeof(float);
        const auto written = parse_scenario("[look]\n" + key.name + " = " + key.example, "s.toml");
        const shared::WeatherLook same = look_at(written.look, 0.0);
        EXPECT_EQ(std::memcmp(&same, &plain, sizeof same), 0) << key.name << ": not the default";
    }
    EXPECT_EQ(bytes, sizeof(shared::WeatherLook)) << "a field without a key";
}

TEST(NorthDegrees, TurnsSunAndWind)
{
    const auto frame_of = [](const std::string& north) {
        Sequence sequence = make_sequence(parse_scenario(
            "[scene]\nnorth_degrees = " + north + "\n[sun]\nazimuth_degrees = 180\n", "s.toml"));
        sequence.framing.bounds = {glm::vec3(-1.0f), glm::vec3(1.0f)};
        sequence.variants[0].weather.at = [](double) {
            weather::Moment moment;
            moment.values.wind_m_s = weather::wind_vector_m_s(2.0, 0.0);  // from the north
            return moment;
        };
        return frame_at(sequence, {0}).frame;
    };
    EXPECT_NEAR(frame_of("0").weather.wind_m_s.y, 2.0f, 1e-6f) << "from -z";
    // North is where +x was east: a wind from the north comes from +x.
    EXPECT_NEAR(frame_of("90").weather.wind_m_s.x, -2.0f, 1e-5f);
    EXPECT_NEAR(frame_of("90").sky.sun_azimuth_rad - frame_of("0").sky.sun_azimuth_rad, 1.5708f,
                1e-4f);
}

}  // namespace
}  // namespace petrichor::film
