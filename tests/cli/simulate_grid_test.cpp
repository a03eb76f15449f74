// Landscapes: terrain files, the model on every cell, maps, the snow line; and stores from a height
// map.
#include "cli/simulate/grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "base/error.h"
#include "cli/report/plot_axes.h"
#include "cli/simulate/depth_lines.h"
#include "cli/simulate/grid_map.h"
#include "cli/simulate/relief.h"
#include "tests/support/program.h"
#include "texproc/codecs/files/io.h"
#include "weather/readers/text.h"

namespace petrichor::cli {
namespace {

using testing_program::Workplace;
using testing_program::write_file;

// A ridge from west to east, 1000 to 2200 m: its north side faces north, its south side south.
std::string ridge_asc(int side = 16, double cell_m = 150.0)
{
    std::string text = "ncols " + std::to_string(side) + "\nNROWS " + std::to_string(side) +
                       "\nxllcorner 0\nyllcorner 0\ncellsize " + std::to_string(cell_m) +
                       "\nNODATA_value -9999\n";
    for (int y = 0; y < side; ++y) {
        const double h = 1000.0 + 1200.0 * (1.0 - std::abs(2.0 * (y + 0.5) / side - 1.0));
        for (int x = 0; x < side; ++x)
            text += (x == 0 && y == 0 ? std::string("-9999") : std::to_string(h + 3.0 * x)) +
                    (x + 1 < side ? " " : "\n");
    }
    return text;
}

// March in the mountains: a week of snow, then clear and calm.
weather::ReadResult mountain_weather()
{
    std::string text = "time,air_temp_c,rel_humidity_pct,wind_m_s,precip_mm,cloud_fraction\n";
    for (int hour = 0; hour < 480; ++hour) {
        const bool snows = hour < 168;
        char line[120];
        std::snprintf(line, sizeof line, "2024-03-%02dT%02d:00Z,%.1f,%d,%.1f,%.1f,%.1f\n",
                      1 + hour / 24, hour % 24,
                      (snows ? 0.0 : 6.0) + 4.0 * std::sin((hour % 24 - 9) * 0.2618),
                      snows ? 95 : 55, snows ? 2.0 : 0.3, snows ? 0.4 : 0.0, snows ? 1.0 : 0.0);
        text += line;
    }
    SiteOptions site;
    site.latitude_deg = 46.0;
    site.longitude_deg = 8.0;
    site.elevation_m = 1200.0;
    return read_forcing({{"march", "march.csv", InputKind::Weather, text}}, site);
}

GridRun daily_run()
{
    GridRun run;
    run.model.site.surface = "grass";
    run.model.threads = 2;
    run.model.every_s = 86400.0;
    return run;
}

Terrain ridge(const std::string& surface = "grass")
{
    Workplace work("ridge");
    write_file(work / "ridge.asc", ridge_asc());
    TerrainOptions options;
    options.file = (work / "ridge.asc").string();
    return read_terrain(options, surface);
}

TEST(Terrain, AsciiGridsAreRead)
{
    const Terrain t = parse_ascii_grid(ridge_asc(8), "ridge.asc");
    EXPECT_EQ(t.width, 8u);
    EXPECT_EQ(t.height, 8u);
    EXPECT_EQ(t.spacing_m, 150.0);
    EXPECT_FALSE(t.inside[0]);
    EXPECT_TRUE(t.inside[1]);
    EXPECT_FLOAT_EQ(t.heights_m[8 * 3 + 2], 2056.0f);
}

TEST(Terrain, BadGridsAreNamedWithTheirLine)
{
    const std::string good = ridge_asc(4);
    const auto why = [](const std::string& text) {
        try {
            parse_ascii_grid(text, "bad.asc");
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string("accepted");
    };
    EXPECT_NE(why("").find("ends after 0"), std::string::npos) << why("");
    EXPECT_NE(why(good.substr(0, good.size() - 30)).find("of 16 heights"), std::string::npos);
    EXPECT_NE(why(good + "1 2 3\n").find("more heights"), std::string::npos);
    std::string word = good;
    word.replace(word.rfind(' ') + 1, 1, "x");
    EXPECT_NE(why(word).find("line 10"), std::string::npos) << why(word);
    EXPECT_NE(why("ncols 99999999\nnrows 9\ncellsize 1\n1 2\n").find("1..16384"),
              std::string::npos);
    EXPECT_NE(why("ncols 16384\nnrows 16384\ncellsize 1\n1 2\n").find("too short"),
              std::string::npos)
        << "no gigabyte for three numbers";
    EXPECT_NE(why("ncols 2\nnrows nan\ncellsize 1\n1 2\n").find("line"), std::string::npos);
    EXPECT_NE(why("colour 2\n").find("no key"), std::string::npos);
}

TEST(Terrain, OptionsThatDoNotFitAreRefused)
{
    Workplace work("terrain");
    write_file(work / "ridge.asc", ridge_asc());
    Image grey(8, 8, 1, ColorSpace::Data, 0.5f);
    grey.at(3, 3, 0) = 1.0f;
    texproc::write_image(work / "grey.png", grey);
    TerrainOptions options;
    options.file = (work / "grey.png").string();
    EXPECT_THROW(read_terrain(options, "grass"), Error) << "no size of a texel";
    options.cell_size_m = 100.0;
    EXPECT_THROW(read_terrain(options, "grass"), Error) << "no heights";
    options.height_range_m = "2000:1000";
    EXPECT_THROW(read_terrain(options, "grass"), Error);
    options.height_range_m = "1000:2000";
    const Terrain t = read_terrain(options, "grass");
    EXPECT_NEAR(t.heights_m[0], 1500.0, 3.0);
    EXPECT_NEAR(t.heights_m[8 * 3 + 3], 2000.0, 1e-3);
    options.mask = options.file;
    EXPECT_THROW(read_terrain(options, "grass"), Error) << "no names for the mask";
    options.surfaces = "grass,rock,asphalt";
    EXPECT_EQ(read_terrain(options, "grass").surface[0], 1u);
    EXPECT_EQ(read_terrain(options, "grass").surface[8 * 3 + 3], 2u);
    // Floats are metres, and large terrains are averaged.
    Image metres(64, 32, 1, ColorSpace::Data);
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 64; ++x) metres.at(x, y, 0) = static_cast<float>(1000 + 10 * x);
    }
    texproc::write_image(work / "dem.exr", metres, {.bits = 32});
    TerrainOptions dem;
    dem.file = (work / "dem.exr").string();
    dem.cell_size_m = 20.0;
    dem.longest_side = 16;
    const Terrain small = read_terrain(dem, "grass");
    EXPECT_EQ(small.width, 16u);
    EXPECT_EQ(small.height, 8u);
    EXPECT_DOUBLE_EQ(small.spacing_m, 80.0);
    EXPECT_FLOAT_EQ(small.heights_m[0], 1015.0f);
    write_file(work / "degrees.asc", ridge_asc(4, 0.001));
    options = {};
    options.file = (work / "degrees.asc").string();
    EXPECT_THROW(read_terrain(options, "grass"), Error);
}

TEST(Grid, SnowLiesLongerHighUpAndOnNorthSlopes)
{
    const Terrain terrain = ridge();
    GridRun run = daily_run();
    std::vector<GridMap> maps;
    run.on_map = [&](const GridMap& map) { maps.push_back(map); };
    const auto read = mountain_weather();
    run.map_times_us = {read.table.time_us.front() + 15LL * 86400 * 1000000};
    const SimulationTable t = run_grid(read, "march", terrain, run);
    ASSERT_EQ(maps.size(), 1u);
    EXPECT_EQ(t.rows.size(), 21u);
    const auto swe = [&](std::size_t row, std::size_t column) {
        return weather::diagnostics(maps[0].states[row * 16 + column]).swe_kg_m2;
    };
    EXPECT_GT(swe(5, 8), swe(10, 8) + 5.0) << "rows 5 and 10 are equally high; 5 faces north";
    EXPECT_GT(swe(6, 8), swe(1, 8)) << "higher on the same side";
    const std::size_t line = column_index(t, "snow_line_m"),
                      cover = column_index(t, "snow_cover_fraction");
    EXPECT_GE(t.rows.back()[line], t.rows[7][line]) << "the snow line does not fall while it melts";
    EXPECT_GT(t.rows[7][line], 1000.0);
    EXPECT_LT(t.rows.back()[cover], t.rows[7][cover]);
    for (const auto& row : t.rows) {
        for (const double v : row) ASSERT_TRUE(std::isfinite(v));
        EXPECT_LE(row.back(), 1e-9) << "mass closes in every cell";
    }
    run.model.threads = 1;
    EXPECT_EQ(run_grid(read, "march", terrain, run).state_hash, t.state_hash);
    run.map_times_us = {read.table.time_us.front() - 1};
    EXPECT_THROW(run_grid(read, "march", terrain, run), Error);
    auto nowhere = read;
    nowhere.table.site.elevation_m = weather::kMissing;
    EXPECT_THROW(run_grid(nowhere, "march", terrain, daily_run()), Error);
}

// Thin snow on steep ground that faces a strong sun in calm air once threw the surface solver out
// of its range.
TEST(Grid, SteepSlopesInCalmSunStayFinite)
{
    Workplace work("steep");
    write_file(work / "steep.asc", ridge_asc(16, 50.0));  // 72 degrees steep
    TerrainOptions options;
    options.file = (work / "steep.asc").string();
    for (const char* surface : {"rock", "asphalt", "roof_metal"}) {
        const SimulationTable t =
            run_grid(mountain_weather(), "march", read_terrain(options, surface), daily_run());
        const std::size_t warm = column_index(t, "surface_temp_c"),
                          deepest = column_index(t, "snow_depth_max_m");
        for (const auto& row : t.rows) {
            EXPECT_GT(row[warm], -40.0) << surface;
            EXPECT_LT(row[warm], 60.0) << surface;
            EXPECT_LT(row[deepest], 2.0) << surface;
        }
    }
}

TEST(DepthLines, StandAtRoundDepthsWhereColourTellsNoMore)
{
    EXPECT_TRUE(depth_levels_m(0.0).empty());
    EXPECT_TRUE(depth_levels_m(0.3).empty());
    for (const double deepest_m : {0.42, 0.9, 1.3, 2.7, 8.0, 30.0}) {
        const auto levels = depth_levels_m(deepest_m);
        ASSERT_FALSE(levels.empty()) << deepest_m;
        EXPECT_LE(levels.size(), 6u);
        EXPECT_GT(levels.front(), 0.3);
        EXPECT_LT(levels.back(), deepest_m);
    }
    const auto deep = depth_levels_m(2.7);
    ASSERT_EQ(deep.size(), 5u);
    EXPECT_NEAR(deep[0], 0.5, 1e-12);
    EXPECT_NEAR(deep[4], 2.5, 1e-12);
}

TEST(DepthLines, RunBetweenTheirSides)
{
    // 4 x 2 pixels: 0.2, 0.4, 0.6, 0.6 m over the same and a deeper last one.
    const std::vector<double> depth_m{0.2, 0.4, 0.6, 0.6, 0.2, 0.4, 0.6, 1.2};
    const std::vector<double> levels{0.5, 1.0};
    std::vector<std::uint8_t> rgb(24, 200);
    draw_depth_lines(depth_m, 4, levels, rgb);
    const auto drawn = [&](std::size_t pixel) { return rgb[3 * pixel] != 200; };
    EXPECT_FALSE(drawn(0));
    EXPECT_TRUE(drawn(1)) << "0.5 m lies between it and the next";
    EXPECT_FALSE(drawn(2));
    EXPECT_TRUE(drawn(3)) << "1 m lies between it and the one below";
    EXPECT_TRUE(drawn(6));
    EXPECT_FALSE(drawn(7)) << "the end of a row is no neighbour of the next";
    EXPECT_LT(rgb[3 * 6], rgb[3 * 1]) << "the deeper the darker";
}

TEST(Grid, MapsHoldEveryStateAndShowTheSnow)
{
    Workplace work("maps");
    const Terrain terrain = ridge();
    GridRun run = daily_run();
    const auto read = mountain_weather();
    run.map_times_us = {read.table.time_us.front() + 7LL * 86400 * 1000000,
                        read.table.time_us.front() + 19LL * 86400 * 1000000};
    run.on_map = [&](const GridMap& map) {
        write_grid_map(map_path(work / "map.exr", map.time_us, true), terrain, map, run.model);
        write_grid_map(map_path(work / "map.png", map.time_us, true), terrain, map, run.model);
    };
    run_grid(read, "march", terrain, run);
    const texproc::RawImage exr = texproc::read_raw(work / "map_20240308T0000.exr");
    EXPECT_EQ(exr.width, 16);
    EXPECT_EQ(exr.channels, 16);
    const auto& names = exr.channel_names;
    for (const char* name :
         {"snow_depth.m", "swe.kg_m2", "surface_temp.C", "mask.snow", "elevation.m"}) {
        EXPECT_NE(std::find(names.begin(), names.end(), name), names.end()) << name;
    }
    const auto brightness = [&](const char* file, bool deep) {
        const Image image = texproc::read_image(work / file);
        EXPECT_GE(image.width, 512);
        EXPECT_EQ(image.height, image.width + (deep ? 116 : 94))
            << "a square, two lines of words, a legend, and one of deep snow";
        double sum = 0;
        for (const float v : image.pixels) sum += static_cast<double>(v);
        return sum / static_cast<double>(image.pixels.size());
    };
    EXPECT_GT(brightness("map_20240308T0000.png", true), brightness("map_20240320T0000.png", false) + 0.05)
        << "white, then less so";
    EXPECT_THROW(write_grid_map(work / "map.gif", terrain, {}, run.model), Error);
}

TEST(Grid, TheSnowLinePartsSnowFromGround)
{
    std::vector<double> heights, depths;
    for (int i = 0; i < 100; ++i) {
        heights.push_back(1000.0 + 10.0 * i);
        depths.push_back(i >= 40 ? 0.5 : 0.0);
    }
    EXPECT_DOUBLE_EQ(snow_line_m(heights, depths), 1400.0);
    depths[10] = 0.5;  // a drift in a hollow
    EXPECT_DOUBLE_EQ(snow_line_m(heights, depths), 1400.0);
    EXPECT_DOUBLE_EQ(snow_line_m(heights, std::vector<double>(100, 0.0)), 1990.0);
    EXPECT_DOUBLE_EQ(snow_line_m(heights, std::vector<double>(100, 1.0)), 1000.0);
}

TEST(Relief, StoresFollowTheHeightMap)
{
    Workplace work("relief");
    // A flat map with one square hollow: 16 x 16 of 256 x 256 texels, too wide for a crack, half of
    // the range deep.
    Image height(256, 256, 1, ColorSpace::Data, 1.0f);
    for (int y = 100; y < 116; ++y) {
        for (int x = 100; x < 116; ++x) height.at(x, y, 0) = 0.5f;
    }
    texproc::write_image(work / "hollow.exr", height, {.bits = 32});
    const Relief relief = read_relief(work / "hollow.exr", 0.02);
    EXPECT_NEAR(relief.puddles.depth_mm, 10.0, 1e-3);
    EXPECT_NEAR(relief.puddles.capacity_kg_m2(), 10.0 * 256.0 / 65536.0,
                0.02 * 10.0 * 256.0 / 65536.0);
    EXPECT_LT(relief.cracks.capacity_kg_m2(), 1e-3);
    EXPECT_NEAR(weather::wet_area(relief.puddles, 10.0), 256.0 / 65536.0, 4.1 / 65536.0)
        << "a disc does not reach into the corners";
    texproc::write_image(work / "flat.exr", Image(64, 64, 1, ColorSpace::Data, 0.3f), {.bits = 32});
    EXPECT_LT(read_relief(work / "flat.exr", 0.02).puddles.capacity_kg_m2(), 1e-3);
    EXPECT_THROW(read_relief(work / "hollow.exr", 0.0), Error);
    EXPECT_THROW(read_relief(work / "missing.png", 0.02), Error);
}

}  // namespace
}  // namespace petrichor::cli
