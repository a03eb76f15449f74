// The skill board: every shared data set keeps its stated score; the board itself on made-up data.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>

#include "base/error.h"
#include "cli/bench/skill/board.h"
#include "cli/bench/skill/find_sets.h"
#include "cli/bench/skill/longwave.h"
#include "cli/bench/skill/snow_maps.h"
#include "cli/bench/skill/urban.h"
#include "tests/support/assets.h"
#include "tests/support/program.h"
#include "weather/physics/solar.h"
#include "weather/readers/text.h"

namespace petrichor::cli {
namespace {

// Scored once for all tests.
const Board& board_of(const std::filesystem::path& assets)
{
    static const Board board = skill_board({.data = (assets / "weather").string()});
    return board;
}

TEST(Skill, SharedDataKeepTheirStatedScores)
{
    NEED_ASSETS(assets);
    const Board& board = board_of(assets);
    int stated = 0;
    for (const BoardRow& row : board.rows) {
        if (!row.stated) continue;
        ++stated;
        EXPECT_FALSE(row.worse()) << row.ours.set << ", " << row.ours.quantity << ": "
                                  << row.ours.score << ", stated " << row.stated->stated << " + "
                                  << row.stated->margin;
    }
    EXPECT_GE(stated, 94);
    std::printf("%s", board_text(board).c_str());
}

// What the release promises over all shared winters and roads.
TEST(Skill, MeansOverTheSharedData)
{
    NEED_ASSETS(assets);
    const Board& board = board_of(assets);
    const auto mean = [&](const std::string& quantity, const char* but_not) {
        ErrorSum sum;
        for (const BoardRow& row : board.rows) {
            const bool broken = row.ours.set == "case040" || row.ours.set == "case044";
            if (row.ours.quantity == quantity && row.ours.set.rfind("mean", 0) != 0 &&
                !(broken && *but_not))
                sum.add(row.ours.score);
        }
        return sum.bias();
    };
    EXPECT_LE(mean("snow depth", ""), 0.115);
    EXPECT_LE(mean("SWE", ""), 43.0);
    EXPECT_LE(mean("snow depth without longwave", ""), 1.5 * mean("snow depth", ""));
    // Two cases hold what never fell (70 mm/h of snow, 10 m/h of rain).
    EXPECT_LE(mean("road beside METRo", "but not the broken"), 1.0);
    EXPECT_LE(mean("road beside METRo", "but not the broken"),
              0.5 * mean("air beside METRo", "but not the broken"));
    EXPECT_LE(mean("road started, all ahead", ""), 0.5 * mean("air, all ahead", ""));
    // Half a cover in place of what the air tells: 37 and 140 W/m2.
    EXPECT_LE(mean("longwave by air alone", ""), 26.0);
    EXPECT_LE(mean("sun by air alone", ""), 105.0);
    // Of each station, at Col de Porte over ten winters.
    std::size_t stations = 0;
    for (const BoardRow& row : board.rows) {
        if (row.ours.quantity != "under cloud, all sets" || row.ours.set.rfind("mean", 0) == 0) continue;
        ++stations;
        EXPECT_LE(row.ours.score, 5.0) << row.ours.set;
    }
    EXPECT_EQ(stations, 2u);
}

// Of the 17 roads whose files are not broken on purpose, all.
TEST(Skill, RoadsAreWithinAKelvinOfMetro)
{
    NEED_ASSETS(assets);
    int roads = 0;
    for (const BoardRow& row : board_of(assets).rows) {
        const std::string& set = row.ours.set;
        if (row.ours.quantity != "road beside METRo" || set.rfind("mean", 0) == 0) continue;
        if (set == "case040" || set == "case044") continue;
        ++roads;
        EXPECT_LE(row.ours.score, 1.0) << set;
    }
    EXPECT_EQ(roads, 17);
}

// Forecasts that could have been made while a road was measured: nearer than the air on all roads
// but case034, whose forecast begins when its two days of measurements end and knows no cloud of
// theirs.
TEST(Skill, CoupledRoadsAreNearerThanTheAir)
{
    NEED_ASSETS(assets);
    const Board& board = board_of(assets);
    const auto score = [&](const std::string& set, const std::string& quantity) {
        for (const BoardRow& row : board.rows)
            if (row.ours.set == set && row.ours.quantity == quantity) return row.ours.score;
        return kNoScore;
    };
    for (const std::string ahead : {", half ahead", ", 6 h ahead"}) {
        int roads = 0, farther = 0;
        ErrorSum coupled, started, air, kept;
        for (const BoardRow& row : board.rows) {
            const std::string& set = row.ours.set;
            if (row.ours.quantity != "road coupled" + ahead || set.rfind("mean", 0) == 0) continue;
            ++roads;
            if (!(row.ours.score < score(set, "air" + ahead))) {
                ++farther;
                EXPECT_EQ(set, "case034") << ahead;
            }
            coupled.add(row.ours.score);
            started.add(score(set, "road started" + ahead));
            air.add(score(set, "air" + ahead));
            kept.add(score(set, "road kept" + ahead));
        }
        EXPECT_EQ(roads, 15) << ahead;
        EXPECT_LE(farther, 1) << ahead;
        EXPECT_LT(coupled.bias(), 0.9 * started.bias()) << ahead;
        EXPECT_LT(coupled.bias(), 0.75 * kept.bias()) << ahead;
        EXPECT_LT(coupled.bias(), 0.6 * air.bias()) << ahead;
    }
}

// From one measured value alone, too, on all roads.
TEST(Skill, RoadsFromOneStartAreNearerThanTheAir)
{
    NEED_ASSETS(assets);
    int roads = 0;
    for (const BoardRow& road : board_of(assets).rows) {
        const std::string& set = road.ours.set;
        if (road.ours.quantity != "road started, all ahead" || set.rfind("mean", 0) == 0) continue;
        ++roads;
        for (const BoardRow& air : board_of(assets).rows) {
            if (air.ours.set == set && air.ours.quantity == "air, all ahead") {
                EXPECT_LT(road.ours.score, air.ours.score) << set;
            }
        }
    }
    EXPECT_EQ(roads, 18);
}

// What SOLWEIG reaches at these stations (Lindberg et al. 2008): 51, 13 W/m2 in the courtyard, 177 in
// the square, and 61 for the longwave there.
TEST(Skill, RadiationInATownIsNearerThanSolweigs)
{
    NEED_ASSETS(assets);
    const auto score = [&](const char* set, const char* quantity) {
        for (const BoardRow& row : board_of(assets).rows)
            if (row.ours.set == set && row.ours.quantity == quantity) return row.ours.score;
        return kNoScore;
    };
    EXPECT_LT(score("kronenhuset", "K down"), 45.0);
    EXPECT_LT(score("kronenhuset", "L up"), 13.0);
    EXPECT_LT(score("kronenhuset", "L down"), 20.0);
    EXPECT_LT(score("gustav_adolfs", "K down"), 150.0);
    EXPECT_LT(score("gustav_adolfs", "L down"), 26.0);
    EXPECT_LT(score("champaign_1998_half_hourly", "wetness, 1 - kappa"), 0.5);
    // What is left is for the most part not the model's: a winter's air with a third of the vapour has .70.
    EXPECT_LT(score("kronenhuset", "clear sky over black"), 0.70);
    EXPECT_LT(score("gustav_adolfs", "clear sky over black"), 0.73);
}

// A winter of rain under a black sky, whose instrument reads 5 % less from a day on.
TEST(Skill, AnInstrumentThatChangesIsTold)
{
    const auto table_of = [](double less) {
        weather::ForcingTable raw;
        raw.site = {.latitude_deg = 45.3, .longitude_deg = 5.77, .elevation_m = 1325.0};
        const std::int64_t begin = *weather::us_from_iso("2010-11-01T00:00Z"),
                           change = *weather::us_from_iso("2010-12-16T00:00Z");
        for (int h = 0; h < 24 * 90; ++h) {
            const std::int64_t us = begin + h * 3600000000LL;
            const double air_k = 272.0 + h % 5, black = 5.670374419e-8 * std::pow(air_k, 4.0);
            raw.time_us.push_back(us);
            raw[weather::Field::AirTemp].push_back(air_k);
            raw[weather::Field::RelHumidity].push_back(97.0);
            raw[weather::Field::Wind].push_back(2.0);
            raw[weather::Field::Rain].push_back(1.0 / 3600.0);
            raw[weather::Field::Longwave].push_back(black * (1.0 + 0.002 * (h % 7 - 3) -
                                                             (us >= change ? less : 0.0)));
        }
        return raw;
    };
    const auto row = [](const std::vector<SkillRow>& rows, const std::string& quantity) {
        for (const SkillRow& r : rows)
            if (r.quantity == quantity) return r;
        return SkillRow{};
    };
    const auto rows = longwave_rows("made up", table_of(0.05));
    EXPECT_NEAR(row(rows, "sky step on 2010-12-16").bias, -0.05, 1e-3);
    const SkillRow before = row(rows, "under cloud to 2010-12-16"),
                   from = row(rows, "under cloud from 2010-12-16");
    EXPECT_EQ(before.count, 45u * 24u);
    EXPECT_EQ(from.count, 45u * 24u);
    EXPECT_NEAR(from.bias - before.bias, 0.05 * 318.0, 2.0);
    for (const SkillRow& r : longwave_rows("made up", table_of(0.01)))
        EXPECT_EQ(r.quantity.find("step"), std::string::npos) << r.quantity;
}

// Of the shared stations one changed in its winter: the second half of 2010-11.
TEST(Skill, TheWinterOf2010ChangedItsInstrument)
{
    NEED_ASSETS(assets);
    const Board& board = board_of(assets);
    double before = kNoScore, from = kNoScore;
    for (const BoardRow& row : board.rows) {
        if (row.ours.set != "2010_11") continue;
        if (row.ours.quantity == "under cloud to 2010-12-16") before = row.ours.bias;
        if (row.ours.quantity == "under cloud from 2010-12-16") from = row.ours.bias;
    }
    EXPECT_LT(std::abs(before), 7.0);
    EXPECT_GT(from, 20.0);
}

TEST(Skill, AFolderWithoutDataIsNamed)
{
    const auto folder = std::filesystem::temp_directory_path() / "petrichor_skill_empty";
    std::filesystem::create_directories(folder);
    EXPECT_THROW(find_skill_sets(folder.string()), Error);
    EXPECT_THROW(find_skill_sets((folder / "none").string()), Error);
}

// A perfect model has no error, one that is 0.2 m too deep has 0.2 m.
TEST(Skill, ErrorsAreThoseOfTheModel)
{
    Winter winter;
    winter.name = "made up";
    winter.observed.daily = true;
    SnowHours model;
    for (int day = 0; day < 10; ++day) {
        const double depth = day < 6 ? 1.0 : 0.0;
        if (winter.observed.columns.empty())
            winter.observed.columns.push_back({"snow_depth_m", {}, {}});
        winter.observed.columns[0].time_us.push_back(day * 86400000000LL);
        winter.observed.columns[0].values.push_back(depth);
        for (int h = 0; h < 24; ++h)
            model.hours.push_back({day < 7 ? depth + 0.2 : 0.0, 0, 0, 0, 0});
    }
    const auto rows = winter_rows(winter, model);
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[0].quantity, "snow depth");
    EXPECT_NEAR(rows[0].score, std::sqrt(7 * 0.04 / 10), 1e-12);
    EXPECT_NEAR(rows[0].bias, 0.14, 1e-12);
    EXPECT_EQ(rows[1].quantity, "snow off");
    EXPECT_NEAR(rows[1].bias, 1.0, 1e-12);
}

// A slope from 1000 to 2000 m, the warmer below; four weeks of snow, then of thaw.
constexpr int kSlope = 12;
std::string slope_grid(const std::function<std::string(int row)>& cell)
{
    std::string text =
        "ncols 12\nnrows 12\nxllcorner 0\nyllcorner 0\ncellsize 100\nNODATA_value -9999\n";
    for (int y = 0; y < kSlope; ++y)
        for (int x = 0; x < kSlope; ++x) text += cell(y) + (x + 1 < kSlope ? " " : "\n");
    return text;
}
void write_landscape(const testing_program::Workplace& work, double line_m)
{
    using testing_program::write_file;
    const auto height = [](int row) { return 1000 + 90 * row; };
    write_file(work / "dem.asc", slope_grid([&](int y) { return std::to_string(height(y)); }));
    write_file(work / "site.toml",
               "[site]\nlatitude = 46.0\nlongitude = 7.5\nelevation_m = 1500.0\n");
    std::string text = "time,air_temp_c,rel_humidity_pct,wind_m_s,precip_mm,cloud_fraction\n";
    for (int h = 0; h < 720; ++h) {
        char row[120];
        std::snprintf(row, sizeof row, "2024-0%d-%02dT%02d:00Z,%.1f,90,2,%.1f,1\n", 3, 1 + h / 24,
                      h % 24, 0.0, h < 240 ? 1.0 : 0.0);
        text += row;
    }
    write_file(work / "weather.csv", text);
    // Snow above a line; the highest rows are under cloud, one is not known.
    write_file(work / "snow_2024-03-12.asc", slope_grid([&](int y) {
                   return std::string(y == 11              ? "205"
                                      : y == 10            ? "-9999"
                                      : height(y) > line_m ? "100"
                                                           : "0");
               }));
}

// Snow lies where it is cold: maps of about that line agree, maps of another do not.
TEST(SnowMaps, AgreeWithALandscapeThatHasTheirLine)
{
    testing_program::Workplace work("snow-maps");
    const auto rows_of = [&](double line_m) {
        write_landscape(work, line_m);
        const SkillSets sets = find_skill_sets(work.path().string());
        EXPECT_EQ(sets.landscapes.size(), 1u);
        EXPECT_TRUE(sets.notes.empty()) << sets.notes.front();
        EXPECT_EQ(sets.landscapes[0].maps[0].time_us,
                  weather::us_from_iso("2024-03-12T10:00Z").value())
            << "10:30 by the sun of 7.5 degrees east";
        return snow_map_rows(sets.landscapes[0]);
    };
    double best = 2.0, best_line_m = 0.0;
    for (const double line_m : {1050.0, 1230.0, 1410.0, 1590.0, 1770.0}) {
        const auto rows = rows_of(line_m);
        ASSERT_EQ(rows.size(), 2u) << line_m;
        EXPECT_EQ(rows[0].quantity, "snow maps");
        EXPECT_EQ(rows[0].count, 120u) << "ten rows of cells were seen";
        EXPECT_EQ(rows[1].quantity, "snow line of maps");
        if (rows[0].score >= best) continue;
        best = rows[0].score;
        best_line_m = line_m;
    }
    EXPECT_LT(best, 0.3) << best_line_m;
    const double off = rows_of(best_line_m)[1].score;
    EXPECT_LE(off, 180.0);
    EXPECT_NEAR(rows_of(best_line_m < 1400.0 ? best_line_m + 360.0 : best_line_m - 360.0)[1].score,
                360.0, off + 1.0);
}

TEST(SnowMaps, WhatDoesNotFitIsToldAndNotScored)
{
    testing_program::Workplace work("snow-maps-bad");
    const auto note = [&](const char* file, const std::string& text) {
        write_landscape(work, 1400.0);
        testing_program::write_file(work / file, text);
        try {
            read_snow_map_set(work.path(), {});
        } catch (const Error& e) {
            std::filesystem::remove(work / file);
            return std::string(e.what());
        }
        return std::string("accepted");
    };
    const auto plain = [](const char* code) { return slope_grid([=](int) { return code; }); };
    EXPECT_NE(note("snow_2024-03-13.asc", plain("7")).find("no code 7"), std::string::npos);
    EXPECT_NE(note("snow_2024-02-30.asc", plain("0")).find("has no day"), std::string::npos);
    EXPECT_NE(note("snow_2025-03-13.asc", plain("0")).find("outside the weather"),
              std::string::npos);
    EXPECT_NE(note("snow_2024-03-13.asc", "ncols 2\nnrows 1\ncellsize 100\n0 0\n")
                  .find("other cells than dem.asc"),
              std::string::npos);
    EXPECT_NE(note("weather.epw", "x").find("two files weather"), std::string::npos);
}

// A plain of 80 x 80 m with a station in its middle, and a clear day; a house may stand south of it.
UrbanSite plain(bool house, float high_m = 20.0f)
{
    UrbanSite site;
    site.name = "plain";
    site.width = site.depth = 80;
    site.ground_m.assign(6400, 0.0f);
    site.top_m = site.tree_m = site.ground_m;
    site.cover.assign(6400, 1.0f);
    site.station = 40 * 80 + 40;
    site.station_m = {40.5f, 1.0f, 40.5f};
    for (std::size_t z = 46; house && z < 60; ++z)
        for (std::size_t x = 20; x < 60; ++x) site.top_m[z * 80 + x] = high_m;
    UrbanDay day;
    weather::ForcingTable& t = day.table;
    t.site = {.latitude_deg = 50.0, .longitude_deg = 0.0, .elevation_m = 10.0};
    const std::int64_t hour_us = 3600000000LL;
    const std::int64_t begin = weather::days_from_civil(2005, 9, 20) * 24 * hour_us;
    for (int h = 0; h <= 48; ++h) {
        const std::int64_t us = begin + h * hour_us;
        const auto sun = weather::sun_direction(us, 50.0, 0.0);
        t.time_us.push_back(us);
        t[weather::Field::AirTemp].push_back(290.0);
        t[weather::Field::RelHumidity].push_back(60.0);
        t[weather::Field::Wind].push_back(2.0);
        t[weather::Field::Precip].push_back(0.0);
        t[weather::Field::Shortwave].push_back(weather::clear_sky_w_m2(sun.up));
        t[weather::Field::Diffuse].push_back(0.2 * weather::clear_sky_w_m2(sun.up));
    }
    weather::ReadReport report;
    weather::fill_forcing(t, report);
    day.begin_us = begin + 24 * hour_us;
    for (const int h : {11, 12}) {
        UrbanHour hour;
        hour.begin_us = day.begin_us + h * hour_us;
        day.measured.push_back(hour);
    }
    site.days.push_back(std::move(day));
    return site;
}

// A station on a plain measures the open; one behind a house, its shade and the warmth of a wall.
TEST(UrbanRadiation, OfAPlainIsThatOfTheOpen)
{
    const UrbanSite open = plain(false), shaded = plain(true);
    const auto hours = urban_radiation(open, open.days[0]);
    const UrbanRadiation &before_noon = hours.front(), &r = hours.back();
    const auto now = [&](weather::Field f) {
        return weather::value_at(open.days[0].table, f, r.begin_us + 1800000000LL);
    };
    EXPECT_NEAR(r.shortwave[kFaceDown] / now(weather::Field::Shortwave), 1.0, 0.01);
    EXPECT_NEAR(r.shortwave[kFaceUp] / now(weather::Field::Shortwave), 0.18, 0.01);
    // Its flat window leaves out the rim of the sky, which is the warmest of it.
    const double rim_w_m2 = now(weather::Field::Longwave) - r.longwave[kFaceDown];
    EXPECT_GT(rim_w_m2, 2.0);
    EXPECT_LT(rim_w_m2, 5.0);
    EXPECT_GT(r.longwave[kFaceUp], 420.0) << "warmer than the air at noon";
    EXPECT_GT(r.shortwave[kFaceSouth], 4.0 * r.shortwave[kFaceNorth]);
    EXPECT_NEAR(before_noon.shortwave[kFaceEast] / r.shortwave[kFaceWest], 1.0, 0.2);
    const auto s = urban_radiation(shaded, shaded.days[0]).back();
    EXPECT_LT(s.shortwave[kFaceDown], 0.2 * r.shortwave[kFaceDown]);
    EXPECT_LT(s.shortwave[kFaceUp], 0.3 * r.shortwave[kFaceUp]);
    EXPECT_LT(s.longwave[kFaceUp], r.longwave[kFaceUp] - 30.0) << "ground in the shade is cool";
    EXPECT_GT(s.longwave[kFaceDown], r.longwave[kFaceDown] + 5.0);
}

// A pane keeps nothing: what it takes of the sun, sky and room it gives to the air.
TEST(UrbanRadiation, AWindowBalancesWhatItTakesAndGives)
{
    const auto left_w_m2 = [](const WindowAir& w) {
        const double k = window_k(w), out = 5.670374419e-8 * std::pow(k, 4.0);
        return 0.15 * w.sun_w_m2 + 0.84 * (w.heat_w_m2 - out) + (4.0 + 4.0 * w.wind_m_s) * (w.air_k - k) +
               3.2 * (w.room_k - k);
    };
    const WindowAir noon{.sun_w_m2 = 750.0, .heat_w_m2 = 350.0, .wind_m_s = 1.0, .air_k = 292.0},
        night{.heat_w_m2 = 280.0, .wind_m_s = 0.5, .air_k = 278.0};
    EXPECT_NEAR(left_w_m2(noon), 0.0, 1.0);
    EXPECT_NEAR(left_w_m2(night), 0.0, 1.0);
    EXPECT_GT(window_k(noon), 292.0 + 2.0);
    EXPECT_LT(window_k(noon), 292.0 + 8.0) << "brick there is 25 K warmer than the air";
    EXPECT_GT(window_k({.heat_w_m2 = 280.0, .air_k = 278.0, .room_k = 293.0}),
              window_k({.heat_w_m2 = 280.0, .air_k = 278.0, .room_k = 278.0}));
    EXPECT_NEAR(window_w_m2(noon), 0.84 * 5.670374419e-8 * std::pow(window_k(noon), 4.0) + 0.16 * 350.0,
                1e-9);
}

// A window that sees 75 degrees from the zenith sees nothing of a house that is 14 degrees high; the
// sunlight's sensor does.
TEST(UrbanRadiation, LowHousesAreOutsideTheWindowOfLongwave)
{
    const auto of = [](bool house, float high_m) {
        const UrbanSite site = plain(house, high_m);
        return urban_radiation(site, site.days[0]).back();
    };
    const UrbanRadiation open = of(false, 0.0f), low = of(true, 2.35f), high = of(true, 8.0f);
    EXPECT_NEAR(low.longwave[kFaceDown], open.longwave[kFaceDown], 1e-6);
    EXPECT_GT(high.longwave[kFaceDown], open.longwave[kFaceDown] + 3.0);
    EXPECT_GT(std::abs(low.shortwave[kFaceDown] - open.shortwave[kFaceDown]), 0.1);
}

// Of sensors that measure what we send them the sky is ours, whatever the walls around are.
TEST(UrbanRadiation, TheSkyIsFoundBesideTheWallsThatTheSidesMeasure)
{
    UrbanSite shaded = plain(true);
    UrbanDay& day = shaded.days[0];
    const auto ours = urban_radiation(shaded, day);
    ASSERT_TRUE(std::isfinite(ours.back().ours_sky_w_m2)) << "a clear day";
    for (std::size_t i = 0; i < ours.size(); ++i) day.measured[i] = ours[i];
    const auto same = urban_radiation(shaded, day).back();
    EXPECT_NEAR(same.measured_sky_w_m2, same.ours_sky_w_m2, 4.0);
    // A sensor that reads too low by itself makes a colder sky.
    for (UrbanHour& hour : day.measured) hour.longwave[kFaceDown] -= 25.0;
    const auto low = urban_radiation(shaded, day).back();
    EXPECT_LT(low.measured_sky_w_m2, same.measured_sky_w_m2 - 25.0);
}

}  // namespace
}  // namespace petrichor::cli
