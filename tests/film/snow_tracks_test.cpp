#include "film/scenes/snow_tracks.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"

namespace petrichor::film {
namespace {

int texel(const gpu::TrackMap& map, double x_m, double z_m, std::size_t channel)
{
    const auto at = [&](double p, float corner) {
        return static_cast<std::size_t>((p - static_cast<double>(corner)) / static_cast<double>(map.texel_m));
    };
    const std::size_t i = at(z_m, map.corner_m.y) * static_cast<std::size_t>(map.width) +
                          at(x_m, map.corner_m.x);
    return static_cast<int>(map.rgba[4 * i + channel]);
}

TEST(SnowTracks, TyresAndFeetPressWhereTheyGo)
{
    ScenarioTrack tyres;
    tyres.points_m = {{-3, 1, 0}, {3, 1, 0}};
    const gpu::TrackMap map = draw_tracks({tyres});
    EXPECT_EQ(map.rgba.size(), static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height) * 4);
    EXPECT_EQ(map.width % 64, 0);
    EXPECT_EQ(map.height % 64, 0);
    EXPECT_LT(map.low_m, 1.0f);
    EXPECT_GT(map.high_m, 1.0f);
    for (const double x : {-2.5, 0.1, 2.2}) {
        for (const double z : {-0.8, 0.8}) EXPECT_NEAR(texel(map, x, z, 0), 255.0 * (1 - 100 / 550.0), 2);
        EXPECT_EQ(texel(map, x, 0.0, 0), 0) << "between the tyres";
        EXPECT_EQ(texel(map, x, 1.2, 0), 0) << "beside them";
        // Down into the track and up again: the snow lies lower at 0.8 m.
        EXPECT_LT(texel(map, x, 0.695, 2), 118);
        EXPECT_GT(texel(map, x, 0.905, 2), 138);
    }
    ScenarioTrack feet = tyres;
    feet.tyre = false;
    const gpu::TrackMap steps = draw_tracks({feet});
    int pressed = 0, texels = 0;
    for (std::size_t i = 0; i < steps.rgba.size(); i += 4, ++texels)
        pressed += static_cast<int>(steps.rgba[i]) > 100;
    const double texel_m2 = static_cast<double>(steps.texel_m) * static_cast<double>(steps.texel_m);
    // 8 steps of somewhat less than 28 by 10 cm.
    EXPECT_NEAR(pressed * texel_m2, 8 * 0.022, 8 * 0.006);
}

TEST(SnowTracks, ShallowOnesPressLessAndTheSameListGivesTheSameBytes)
{
    ScenarioTrack track;
    track.points_m = {{0, 0, 0}, {2, 0, 1}, {3, 0, 4}};
    const gpu::TrackMap deep = draw_tracks({track});
    EXPECT_EQ(deep.rgba, draw_tracks({track}).rgba);
    const std::string print = tracks_fingerprint({track});
    track.depth = 0.25;
    EXPECT_NE(tracks_fingerprint({track}), print);
    const auto deepest = [](const gpu::TrackMap& map) {
        int most = 0;
        for (std::size_t i = 0; i < map.rgba.size(); i += 4)
            most = std::max(most, static_cast<int>(map.rgba[i]));
        return most;
    };
    EXPECT_NEAR(deepest(draw_tracks({track})), 0.25 * deepest(deep), 2);
    EXPECT_EQ(draw_tracks({}).width, 0);
    EXPECT_EQ(tracks_fingerprint({}), "");
}

TEST(SnowTracks, LongWaysStayWithinTheMap)
{
    ScenarioTrack track;
    track.points_m = {{0, 0, 0}, {5000, 0, 100}};
    const gpu::TrackMap map = draw_tracks({track});
    EXPECT_LE(map.width, 2560);
    EXPECT_GT(texel(map, 2500, 50.8, 3), 0);
    track.points_m = {{1, 0, 1}, {1, 0, 1}};
    EXPECT_GT(draw_tracks({track}).width, 0) << "a way of no length";
}

TEST(SnowTracks, KeysSayWhatIsWrong)
{
    const auto read = [](const std::string& tracks) {
        return parse_scenario("[ground]\ntracks = " + tracks + "\n", "s.toml").ground.tracks;
    };
    const auto tracks = read("[{ kind = \"feet\", points_m = [[0,0,0],[1,0,0]], depth = 0.5 }]");
    ASSERT_EQ(tracks.size(), 1u);
    EXPECT_FALSE(tracks[0].tyre);
    EXPECT_EQ(tracks[0].depth, 0.5);
    for (const char* wrong :
         {"[{ kind = \"sledge\", points_m = [[0,0,0],[1,0,0]] }]", "[{ kind = \"feet\" }]",
          "[{ points_m = [[0,0,0]] }]", "[{ points_m = [[0,0,0],[1,0,0]], depth = 2.0 }]",
          "[{ points_m = [[0,0,0],[1,0,0]], speed = 2.0 }]"}) {
        EXPECT_THROW(read(wrong), Error) << wrong;
    }
}

}  // namespace
}  // namespace petrichor::film
