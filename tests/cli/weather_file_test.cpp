#include "cli/rooms.h"
#include "film/scenario/weather_script.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "base/error.h"

namespace petrichor::cli {
namespace {

namespace fs = std::filesystem;

std::string message_of(const std::string& text)
{
    try {
        read_weather_script(text, "w.toml");
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(WeatherFile, ReadsKeysParametersAndSky)
{
    const WeatherScript script = read_weather_script(R"(
name = "test"
description = "a test"
[scene]
file = "ignored.glb"
[weather]
interpolation = "hold"
keys = [
  { time_s = 0, temperature_c = 12, rainfall = 0.5, cloud_cover = 0.25 },
  { time_s = 4.5, rainfall = 0 },
  { time_s = 9, temperature_c = -3, time_scale = 2 },
]
[weather.artist]
evaporation_rate_puddles = 0.3
script_controlled = true
water_to_snow_curve = [[0, 0, 2, 2], [1, 1, 0, 0]]
[weather.artist.initial]
water_to_snow = 0
cracks = 0.4
)",
                                                     "w.toml");
    EXPECT_EQ(script.name, "test");
    EXPECT_EQ(script.duration_s, 9.0);
    EXPECT_EQ(script.timeline.rainfall.times, (std::vector<weather::TimeUs>{0, 4500000}));
    EXPECT_EQ(script.timeline.temperature_c.values, (std::vector<double>{12, -3}));
    EXPECT_EQ(script.timeline.parameters.at("time_scale").values, std::vector<double>{2});
    EXPECT_EQ(script.params.evaporation_rate_puddles, 0.3);
    EXPECT_EQ(script.params.water_to_snow_curve[0].slope_out, 2.0);
    EXPECT_EQ(script.initial.water, 0.4);
    EXPECT_EQ(weather::value_at(script.sky.cloud_cover, 0), 0.25);
    EXPECT_TRUE(script.sky.visibility_m.empty()) << "derived from what falls";
    EXPECT_GT(script.solve().state_at(weather::to_time_us(3)).wetness, 0.3);
}

TEST(WeatherFile, MessagesNameLineKeyAndTheNearestName)
{
    const std::string head = "[weather]\nkeys = [{time_s = 0, temperature_c = 1, rainfall = 0}]\n";
    EXPECT_NE(message_of("[weather]\nkeys = [{time_s = 0, temprature_c = 1, rainfall = 0}]")
                  .find("Did you mean \"temperature_c\""),
              std::string::npos);
    EXPECT_NE(message_of(head + "[weather.artist]\ntime_scal = 1").find("time_scale"),
              std::string::npos);
    EXPECT_NE(message_of(head + "[weather.artist]\ntime_scale = -1").find("w.toml:4"),
              std::string::npos);
    EXPECT_NE(message_of(head + "[weather.artist.initial]\nsnow = 2").find("from 0 to 1"),
              std::string::npos);
    EXPECT_NE(message_of("[weather]\nkeys = [{time_s = 0, temperature_c = 1}]").find("rainfall"),
              std::string::npos);
    EXPECT_NE(message_of("[weather]\nkeys = [{time_s=1, temperature_c=1, rainfall=0}, {time_s=1}]")
                  .find("later"),
              std::string::npos);
    EXPECT_NE(message_of("[weather]\nmodel = \"fancy\"").find("artist"), std::string::npos);
    EXPECT_NE(message_of("[scene]\n").find("no [weather] table"), std::string::npos);
    EXPECT_NE(message_of("[weather\n").find("w.toml:1"), std::string::npos);
    EXPECT_NE(message_of("[weather]\nkeys = []").find("keys"), std::string::npos);
    EXPECT_NE(message_of("[weather]\nkeys = [{time_s = 0, temperature_c = nan, rainfall = 0}]")
                  .find("number"),
              std::string::npos);
}

TEST(WeatherFile, ParameterFilesHoldOnlyArtist)
{
    const ArtistSettings settings = read_artist_settings(
        "[artist]\ntime_scale = 0.5\n[artist.initial]\nsnow = 0.7\n", "p.toml");
    EXPECT_EQ(settings.params.time_scale, 0.5);
    EXPECT_EQ(settings.initial.snow, 0.7);
    EXPECT_THROW(read_artist_settings("[artists]\n", "p.toml"), Error);
    EXPECT_THROW(read_artist_settings("time_scale = 1\n", "p.toml"), Error);
}

// What the presets promise by their names.
class Presets : public testing::Test {
protected:
    static WeatherScript script_of(const fs::path& path)
    {
        std::ifstream in(path);
        const std::string text(std::istreambuf_iterator<char>(in), {});
        return read_weather_script(text, path.string());
    }
    static WeatherScript preset(const std::string& name)
    {
        return script_of(fs::path(PETRICHOR_SOURCE_DIR) / "data" / "weather" / (name + ".toml"));
    }
    static weather::ArtistState at(const weather::ArtistTimeline& timeline, double time_s)
    {
        return timeline.state_at(weather::to_time_us(time_s));
    }
};

TEST_F(Presets, AllReadSolveAndChange)
{
    int count = 0;
    for (const auto& entry :
         fs::directory_iterator(fs::path(PETRICHOR_SOURCE_DIR) / "data/weather")) {
        if (entry.path().extension() != ".toml") continue;
        SCOPED_TRACE(entry.path().string());
        const WeatherScript script = script_of(entry.path());
        EXPECT_EQ(script.name, entry.path().stem().string());
        EXPECT_FALSE(script.description.empty());
        EXPECT_GE(script.duration_s, 20.0);
        const auto timeline = script.solve();
        double change = 0.0;
        for (double t = 1.0; t <= script.duration_s; t += 1.0) {
            const auto a = at(timeline, t - 1.0);
            const auto b = at(timeline, t);
            change += std::abs(b.wetness - a.wetness) + std::abs(b.snow - a.snow) +
                      std::abs(b.puddles - a.puddles);
        }
        EXPECT_GT(change, 0.5);
        ++count;
    }
    EXPECT_GE(count, 10);
}

TEST_F(Presets, RainThenSnowPassesThroughTheWholeYear)
{
    const auto timeline = preset("rain-then-snow").solve();
    EXPECT_EQ(at(timeline, 1).wetness, 0.0);
    EXPECT_GT(at(timeline, 11).wetness, 0.95);
    EXPECT_GT(at(timeline, 11).puddles, 0.95);
    EXPECT_LT(at(timeline, 19).wetness, 0.05);
    EXPECT_GT(at(timeline, 19).puddles, 0.4);
    EXPECT_LT(at(timeline, 26).puddles, 0.05);
    EXPECT_GT(at(timeline, 36).snow * at(timeline, 36).water_to_snow, 0.85);
    EXPECT_LT(at(timeline, 46).snow, 0.05);
    EXPECT_GT(at(timeline, 44).wetness, 0.4);
    // Snow does not vanish between two frames.
    for (int t = 36; t < 48; ++t) {
        const double gone = at(timeline, t).snow * at(timeline, t).water_to_snow -
                            at(timeline, t + 1).snow * at(timeline, t + 1).water_to_snow;
        EXPECT_LT(gone, 0.15) << t;
    }
}

}  // namespace
}  // namespace petrichor::cli
