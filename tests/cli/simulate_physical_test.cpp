// The physical model behind `petrichor simulate`: columns, times, checkpoints, ensembles, the fit.
#include "cli/simulate/physical.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>

#include "base/error.h"
#include "cli/report/drawing.h"
#include "cli/report/panel_choice.h"
#include "cli/report/plot.h"
#include "cli/report/plot_axes.h"
#include "cli/report/report.h"
#include "cli/report/table.h"
#include "weather/physics/stores.h"
#include "weather/readers/text.h"

namespace petrichor::cli {
namespace {

// Ten days: rain, then frost and snow, then sun.
std::string weather_csv()
{
    std::string text = "time,air_temp_c,rel_humidity_pct,wind_m_s,precip_mm,cloud_fraction\n";
    for (int hour = 0; hour < 240; ++hour) {
        const bool cold = hour >= 96 && hour < 168;
        const bool falls = hour % 24 < 8 && hour < 168;
        char line[120];
        std::snprintf(line, sizeof line, "2024-02-%02dT%02d:00Z,%d,%d,3,%.1f,%.1f\n", 1 + hour / 24,
                      hour % 24, cold ? -6 : 9 + hour % 24 / 4, falls ? 95 : 60, falls ? 2.0 : 0.0,
                      falls ? 1.0 : 0.2);
        text += line;
    }
    return text;
}

PhysicalRun city()
{
    PhysicalRun run;
    run.site.latitude_deg = 47;
    run.site.longitude_deg = 8;
    run.site.elevation_m = 450;
    run.threads = 1;
    return run;
}

// Reads and runs.
SimulationTable simulated(const std::string& csv, const PhysicalRun& run)
{
    return run_physical(read_forcing({{"x", "x.csv", InputKind::Weather, csv}}, run.site), "x",
                        run);
}

std::size_t at(const SimulationTable& t, const char* name)
{
    const std::size_t i = column_index(t, name);
    EXPECT_LT(i, t.columns.size()) << name;
    return i;
}

// Digits of a number from its first that is not 0 to its last.
std::size_t digits_of(const std::string& cell)
{
    std::size_t count = 0;
    for (const char c : cell.substr(0, cell.find('e')))
        if (c >= '0' && c <= '9' && (count > 0 || c != '0')) ++count;
    return count;
}

TEST(SimulatePhysical, ComputedColumnsHaveSixDigitsAtMostAndTimesAllOfTheirs)
{
    SimulationTable t = simulated(weather_csv(), city());
    t.rows[0][0] = 123456789.25;
    std::size_t six = 0;
    const auto check = [&](const std::string& cell) {
        EXPECT_LE(digits_of(cell), 6u) << cell;
        six += digits_of(cell) == 6;
    };
    const std::string csv = csv_text(t);
    for (std::size_t from = csv.find('\n') + 1; from < csv.size();) {
        const std::size_t end = csv.find('\n', from);
        std::string line = csv.substr(from, end - from);
        from = end + 1;
        if (line.empty() || line[0] == '#') continue;
        line = line.substr(line.find(',', line.find(',') + 1) + 1);  // behind both times
        for (std::size_t at = 0; at <= line.size();) {
            const std::size_t comma = std::min(line.find(',', at), line.size());
            check(line.substr(at, comma - at));
            at = comma + 1;
        }
    }
    EXPECT_GT(six, 1000u) << "and not fewer";
    EXPECT_NE(csv.find("\n123456789.25,"), std::string::npos);
    const std::string json = json_text(t);
    EXPECT_NE(json.find("[123456789.25,"), std::string::npos);
    EXPECT_EQ(json.find("99999999"), std::string::npos);
    EXPECT_EQ(json.find("00000000"), std::string::npos);
}

TEST(SimulatePhysical, TheOrderOfDatesIsAsSaid)
{
    std::string csv = "time,air_temp_c,rel_humidity_pct\n";
    for (int hour = 0; hour < 24; ++hour)
        csv += "02/03/2024 " + std::to_string(hour % 12 ? hour % 12 : 12) + ":00 " +
               (hour < 12 ? "AM" : "PM") + ",5,60\n";
    PhysicalRun run = city();
    EXPECT_THROW(simulated(csv, run), Error);
    run.site.date_order = "dmy";
    EXPECT_EQ(weather::iso_from_us(simulated(csv, run).utc_start_us), "2024-03-02T00:00:00Z");
    run.site.date_order = "mdy";
    EXPECT_EQ(weather::iso_from_us(simulated(csv, run).utc_start_us), "2024-02-03T00:00:00Z");
}

TEST(SimulatePhysical, TableHasTheContractedColumns)
{
    const SimulationTable t = simulated(weather_csv(), city());
    EXPECT_EQ(t.rows.size(), 241u);
    const std::string csv = csv_text(t);
    EXPECT_EQ(csv.rfind("time_s,time_utc,air_temp_c,", 0), 0u);
    EXPECT_NE(csv.find("\n0,2024-02-01T00:00:00Z,9,"), std::string::npos) << csv.substr(0, 900);
    EXPECT_NE(csv.find("\n3600,2024-02-01T01:00:00Z,"), std::string::npos);
    for (const char* name :
         {"snow_depth_m", "swe_kg_m2", "snow_albedo", "surface_temp_c", "film_kg_m2", "crack_kg_m2",
          "puddle_kg_m2", "ice_kg_m2", "mass_residual_kg_m2", "energy_residual_w_m2", "wetness",
          "cracks", "puddles", "snow", "water_to_snow"}) {
        at(t, name);
    }
    double wettest = 0, deepest = 0;
    for (const auto& row : t.rows) {
        ASSERT_EQ(row.size(), t.columns.size());
        for (const double v : row) ASSERT_TRUE(std::isfinite(v));
        EXPECT_LE(std::abs(row[at(t, "mass_residual_kg_m2")]), 1e-9);
        wettest = std::max(wettest, row[at(t, "puddles")]);
        deepest = std::max(deepest, row[at(t, "snow_depth_m")]);
    }
    EXPECT_GT(wettest, 0.9);
    EXPECT_GT(deepest, 0.1);
    EXPECT_FALSE(t.events.empty());
    EXPECT_NE(svg_plot(t).find(hash_text(t.state_hash)), std::string::npos);
    EXPECT_NE(html_report(t).find("<html"), std::string::npos);
    bool filled = false;
    for (const auto& note : t.notes) filled = filled || note.find("Haurwitz") != std::string::npos;
    EXPECT_TRUE(filled) << "the notes must say how shortwave was filled";
}

TEST(SimulatePhysical, WindowsAndCheckpointsGiveTheSameRows)
{
    const std::string csv = weather_csv();
    const SimulationTable whole = simulated(csv, city());
    PhysicalRun first = city();
    std::string checkpoint;
    first.to_s = 100 * 3600;
    first.checkpoint = &checkpoint;
    simulated(csv, first);
    PhysicalRun rest = city();
    rest.resume = checkpoint;
    const SimulationTable tail = simulated(csv, rest);
    ASSERT_EQ(tail.rows.size(), 141u);
    EXPECT_EQ(tail.state_hash, whole.state_hash);
    const std::size_t film = at(whole, "film_kg_m2"), depth = at(whole, "snow_depth_m");
    for (std::size_t i = 0; i < tail.rows.size(); ++i) {
        EXPECT_EQ(tail.rows[i][film], whole.rows[i + 100][film]);
        EXPECT_EQ(tail.rows[i][depth], whole.rows[i + 100][depth]);
    }
    PhysicalRun other = rest;
    other.step_s = 1800;
    EXPECT_THROW(simulated(csv, other), Error);
    std::string colder = csv;
    colder.replace(colder.find(",9,95,"), 6, ",8,95,");
    EXPECT_THROW(simulated(colder, rest), Error);
    rest.resume = "nonsense";
    EXPECT_THROW(simulated(csv, rest), Error);
}

TEST(SimulatePhysical, SiteTableAndBadNames)
{
    PhysicalRun run;
    run.site = with_site_table(
        {},
        "[site]\nlatitude = 47\nlongitude = 8\nelevation_m = 450\nsurface = \"grass\"\n[artist]\n");
    EXPECT_EQ(simulated(weather_csv(), run).mode, "grass");
    EXPECT_EQ(with_site_table(city().site, "[site]\nlatitude = 10\n").latitude_deg, 47)
        << "the command line wins";
    EXPECT_THROW(with_site_table({}, "[site]\nlattitude = 47\n"), Error);
    EXPECT_THROW(with_site_table({}, "[site]\nlatitude = 470\n"), Error);
    EXPECT_THROW(with_site_table({}, "[place]\nlatitude = 47\n"), Error);
    run = city();
    run.site.surface = "lava";
    EXPECT_THROW(simulated(weather_csv(), run), Error);
    run = city();
    run.phase = "maybe";
    EXPECT_THROW(simulated(weather_csv(), run), Error);
}

TEST(SimulatePhysical, EnsembleSpreadsAndRepeats)
{
    PhysicalRun run = city();
    run.members = 20;
    run.every_s = 6 * 3600;
    const SimulationTable a = simulated(weather_csv(), run);
    run.threads = 3;
    const SimulationTable b = simulated(weather_csv(), run);
    EXPECT_EQ(a.rows, b.rows);
    EXPECT_EQ(a.state_hash, b.state_hash);
    EXPECT_NE(a.state_hash, 0u);
    const std::size_t low = at(a, "swe_kg_m2_p10"), middle = at(a, "swe_kg_m2_p50"),
                      high = at(a, "swe_kg_m2_p90");
    double widest = 0;
    for (const auto& row : a.rows) {
        EXPECT_LE(row[low], row[middle]);
        EXPECT_LE(row[middle], row[high]);
        widest = std::max(widest, row[high] - row[low]);
    }
    EXPECT_GT(widest, 2.0);
    // The window holds for ensembles too.
    run.from_s = 86400;
    run.to_s = 3 * 86400;
    const SimulationTable window = simulated(weather_csv(), run);
    ASSERT_EQ(window.rows.size(), 9u);
    EXPECT_EQ(window.rows.front(), a.rows[4]);
    EXPECT_NE(svg_plot(a).find("polygon"), std::string::npos) << "a band between the percentiles";
    run = city();
    run.sensitivity = true;
    const SimulationTable s = simulated(weather_csv(), run);
    std::string notes;
    for (const auto& n : s.notes) notes += n + "\n";
    EXPECT_NE(notes.find("precipitation x"), std::string::npos) << notes;
    EXPECT_NE(json_summary(s).find("\"peak_swe_kg_m2\""), std::string::npos);
}

TEST(SimulatePhysical, FittedRatesArePlausible)
{
    const std::string toml = fitted_artist_toml(
        read_forcing({{"x", "x.csv", InputKind::Weather, weather_csv()}}, city().site), city());
    EXPECT_NE(toml.find("time_scale = 0.00027777"), std::string::npos) << toml;
    const auto rate = [&](const std::string& key) {
        return std::stod(toml.substr(toml.find(key) + key.size() + 3));
    };
    EXPECT_GT(rate("accumulation_rate_wetness"), 0.1);
    EXPECT_LT(rate("accumulation_rate_wetness"), 50);
    // The film dries first, puddles after it.
    EXPECT_GT(rate("evaporation_rate_puddles"), 1e-4);
    EXPECT_GT(rate("evaporation_rate_wetness"), rate("evaporation_rate_puddles"));
    EXPECT_NE(toml.find("residual"), std::string::npos);
}

TEST(SimulatePhysical, ReliefOfAHeightMapReplacesTheStores)
{
    PhysicalRun run = city();
    run.puddles = weather::uniform_hypsometry(0.5);
    const SimulationTable shallow = simulated(weather_csv(), run);
    const SimulationTable deep = simulated(weather_csv(), city());
    const std::size_t puddle = at(deep, "puddle_kg_m2");
    const auto most = [&](const SimulationTable& t) {
        double m = 0;
        for (const auto& row : t.rows) m = std::max(m, row[puddle]);
        return m;
    };
    EXPECT_NEAR(most(shallow), 0.25, 0.01) << "half of the depth is the capacity";
    EXPECT_GT(most(deep), 1.0);
}

TEST(SimulatePhysical, TheReadReportIsInNotesAndJson)
{
    std::string csv = weather_csv();
    const std::size_t line = csv.find("2024-02-03T05:00Z");
    csv.replace(line, csv.find('\n', line) - line, "2024-02-03T05:00Z,-99,95,3,NA,1.0");
    csv.insert(csv.find("2024-02-04T00"), "garbage,1,2\n");
    const SimulationTable t = simulated(csv, city());
    std::string notes;
    for (const auto& n : t.notes) notes += n + "\n";
    const std::string json = json_summary(t);
    for (const char* part : {"'-99' means no value", "'NA' means no value", "bad row"}) {
        EXPECT_NE(notes.find(part), std::string::npos) << part << "\n" << notes;
        EXPECT_NE(json.find(part), std::string::npos) << part;
    }
    EXPECT_NE(notes.find("bad row line 74"), std::string::npos) << notes;
    EXPECT_NE(
        notes.find(
            "air_temp: 239 read, 1 missing (first in line 55); filled: line between neighbours"),
        std::string::npos)
        << notes;
    EXPECT_NE(json.find("\"line\": 74"), std::string::npos);
    EXPECT_NE(json.find("\"first_missing_line\": 55"), std::string::npos);
    ASSERT_EQ(t.warnings.size(), 1u);
    EXPECT_NE(t.warnings.front().find("taken as dry"), std::string::npos);
}

TEST(SimulatePhysical, ObservationsAreScoredByTheRules)
{
    // The model's own values come back with no error: depth at 12 h, the surface as the mean of the
    // day.
    const SimulationTable t = simulated(weather_csv(), city());
    const std::size_t depth = at(t, "snow_depth_m"), surface = at(t, "surface_temp_c");
    std::string csv = "date;depth_m;surface_temp_c\n";
    for (std::size_t day = 0; day < 10; ++day) {
        double mean = 0;
        for (std::size_t h = 0; h < 24; ++h) mean += t.rows[day * 24 + h][surface] / 24;
        char line[100];
        std::snprintf(line, sizeof line, "2024-02-%02zu;%.17g;%.17g\n", day + 1,
                      t.rows[day * 24 + 12][depth] + 0.25, mean - 1.0);
        csv += line;
    }
    PhysicalRun run = city();
    run.observed = csv + "2024-02-20;nonsense;-99\n";
    run.observed_file = "obs.csv";
    for (const double every : {3600.0, 86400.0}) {
        run.every_s = every;
        const SimulationTable scored = simulated(weather_csv(), run);
        ASSERT_EQ(scored.scores.size(), 2u);
        EXPECT_EQ(scored.scores[0].column, "snow_depth_m");
        EXPECT_EQ(scored.scores[0].count, 10u);
        EXPECT_NEAR(scored.scores[0].rmse, 0.25, 1e-12);
        EXPECT_NEAR(scored.scores[0].bias, -0.25, 1e-12);
        EXPECT_NEAR(scored.scores[1].rmse, 1.0, 1e-9);
        EXPECT_NE(json_summary(scored).find("\"rmse\""), std::string::npos);
        EXPECT_NE(svg_plot(scored).find("<circle"), std::string::npos);
        EXPECT_NE(html_report(scored).find("model against observation"), std::string::npos);
    }
    for (const char* bad :
         {"", "date,colour\n2024-02-01,3\n", "nothing here\n", "date,swe_kg_m2\nx,1\ny,2\n"}) {
        run.observed = std::string(bad) + "\n";
        EXPECT_THROW(simulated(weather_csv(), run), Error) << bad;
    }
}

// Hours of which the file has no rows are grey in the report, with their sum; an hour or two are not.
TEST(SimulatePhysical, GapsOfTheFileAreShown)
{
    std::string text = "time,air_temp_c,rel_humidity_pct\n";
    for (const int hour : {0, 1, 2, 4, 5, 6, 36, 37, 38, 39}) {
        char row[64];
        std::snprintf(row, sizeof row, "2024-06-%02dT%02d:00Z,15,60\n", 1 + hour / 24, hour % 24);
        text += row;
    }
    const SimulationTable t = simulated(text, city());
    ASSERT_EQ(t.gaps_s.size(), 1u);
    EXPECT_EQ(t.gaps_s[0].first, 7 * 3600.0);
    EXPECT_EQ(t.gaps_s[0].second, 36 * 3600.0);
    const std::string html = html_report(t);
    EXPECT_NE(html.find("\"gaps\":[[25200.0,129600.0]]"), std::string::npos);
    EXPECT_NE(html.find("grey: 1.2 days in 1 gap of which the file has no rows"), std::string::npos);
    EXPECT_EQ(html_report(simulated(weather_csv(), city())).find("grey:"), std::string::npos);

    // A picture shades the same hours in every panel: 29 of the 39 of the axis.
    const Drawing drawing = plot_of(t);
    std::size_t shaded = 0, said = 0;
    for (const DrawnShape& shape : drawing.shapes) {
        if (const auto* words = std::get_if<DrawnText>(&shape)) said += words->text == gaps_text(t);
        const auto* area = std::get_if<DrawnArea>(&shape);
        if (!area || area->points.size() != 4 || area->opacity != 0.22) continue;
        ++shaded;
        const double from = area->points[0].x, to = area->points[1].x;
        EXPECT_NEAR((to - from) / (from - 62.0), 29.0 / 7.0, 0.01);
    }
    EXPECT_EQ(shaded, t.panels.size());
    EXPECT_EQ(said, 1u);
    for (const DrawnShape& shape : plot_of(simulated(weather_csv(), city())).shapes) {
        const auto* words = std::get_if<DrawnText>(&shape);
        EXPECT_FALSE(words && words->text.starts_with("grey:"));
    }
}

// An axis ends at round values and is not twice as long as what is on it.
TEST(SimulatePhysical, AxesAreNotFarLongerThanTheirValues)
{
    SimulationTable t;
    t.columns = {"time_s", "value"};
    for (const auto& [low, high] : {std::pair{-16.3, 63.2}, {-17.0, 64.0}, {0.0, 41.0}, {-1.0, 99.0},
                                    {0.0, 0.034}, {-28.0, 53.0}, {-3.0, 1.0}}) {
        t.rows = {{0.0, low}, {1.0, high}};
        PlotPanel panel;
        panel.series = {{"value", "", "#000000"}};
        panel.high = panel.low;
        const auto [bottom, top] = axis_range(t, panel);
        EXPECT_LE(bottom, low);
        EXPECT_GE(top, high);
        EXPECT_LE(top - bottom, 1.5 * (high - low)) << low << " " << high;
    }
}

TEST(SimulatePhysical, PanelsAreChosen)
{
    SimulationTable t = simulated(weather_csv(), city());
    const auto titles = [&](const std::string& wish) {
        std::string all;
        for (const auto& panel : chosen_panels(t, wish)) all += panel.title + "|";
        return all;
    };
    EXPECT_EQ(titles("masks"),
              "air temperature, \u00b0C|precipitation, mm/h|water masks, 0..1|snow masks, 0..1|");
    EXPECT_NE(titles("snow,water").find("water on the ground"), std::string::npos);
    EXPECT_EQ(titles("all").find("precipitation, mm/h"),
              titles("auto").find("precipitation, mm/h"));
    EXPECT_THROW(chosen_panels(t, "masks,hail"), Error);
    for (auto& row : t.rows) row[at(t, "snow_depth_m")] = 0.0;
    EXPECT_EQ(titles("auto").find("snow depth"), std::string::npos) << "nothing to see";
    EXPECT_EQ(titles("auto").find("snow albedo"), std::string::npos) << "no snow has none";
}

TEST(SimulatePhysical, AlbedoIsDrawnWhereThereIsSnow)
{
    SimulationTable t = simulated(weather_csv(), city());
    const std::size_t depth = at(t, "snow_depth_m"), albedo = at(t, "snow_albedo");
    for (std::size_t i = 0; i < t.rows.size(); ++i) {
        t.rows[i][albedo] = 0.8;
        t.rows[i][depth] = i % 10 < 5 ? 0.2 : 0.0;
    }
    const auto panels = chosen_panels(t, "all");
    const auto panel = std::find_if(panels.begin(), panels.end(),
                                    [](const PlotPanel& p) { return p.group == "albedo"; });
    ASSERT_NE(panel, panels.end());
    const auto values = series_values(t, panel->series.front(), "snow_albedo");
    ASSERT_EQ(values.size(), t.rows.size());
    for (std::size_t i = 0; i < values.size(); ++i)
        EXPECT_EQ(std::isnan(values[i]), t.rows[i][depth] == 0.0) << i;
    t.panels = {*panel};
    // A piece of line for each stretch of snow, in the plot and as nulls in the report.
    const Drawing drawing = plot_of(t);
    const auto pieces =
        std::count_if(drawing.shapes.begin(), drawing.shapes.end(), [&](const DrawnShape& shape) {
            const auto* line = std::get_if<DrawnLine>(&shape);
            return line && line->color == panel->series.front().color && line->width < 3.0;
        });
    EXPECT_EQ(static_cast<std::size_t>(pieces), (t.rows.size() + 9) / 10);
    EXPECT_NE(html_report(t).find(",null,null,null,null,null,"), std::string::npos);
    EXPECT_EQ(html_report(t).find("nan"), std::string::npos);
}

// A slip of a year is asked about, a gap of a month is bridged.
TEST(SimulatePhysical, LongGapsAreAskedAbout)
{
    SiteOptions site = city().site;
    const auto read = [&](const std::string& second) {
        return read_forcing({{"x", "x.csv", InputKind::Weather,
                              "time,air_temp_c\n2020-01-01T00:00,1\n" + second + ",2\n"}},
                            site)
            .table.rows();
    };
    EXPECT_GT(read("2020-02-28T00:00"), 1u);
    try {
        read("2021-01-01T00:00");
        ADD_FAILURE() << "not asked about";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("366 days; at most 60"), std::string::npos)
            << error.what();
        EXPECT_NE(error.fix().find("--max-gap 366"), std::string::npos) << error.fix();
    }
    site.max_gap_days = 366.0;
    EXPECT_GT(read("2021-01-01T00:00"), 1u);
}

TEST(SimulateArtist, TakesAWeatherFileThroughTheMap)
{
    const auto read =
        read_forcing({{"x", "x.csv", InputKind::Weather, weather_csv()}}, city().site);
    const WeatherScript script = script_of_forcing(read.table, "x");
    EXPECT_EQ(script.duration_s, 239 * 3600.0);
    const auto& rain = script.timeline.rainfall;
    EXPECT_NEAR(weather::value_at(rain, 3600e6), std::log(3.0) / std::log(51.0), 1e-12) << "2 mm/h";
    EXPECT_EQ(weather::value_at(rain, 10 * 3600e6), 0.0);
    EXPECT_NEAR(weather::value_at(script.timeline.temperature_c, 4.0 * 3600e6), 10.0, 1e-9);
    const auto wet = script.solve().state_at(weather::to_time_us(8 * 3600));
    EXPECT_GT(wet.wetness, 0.5);
    EXPECT_GT(script.solve().state_at(weather::to_time_us(125 * 3600)).snow, 0.1);
    // The wind turns the short way.
    weather::ForcingTable turning = read.table;
    turning[weather::Field::WindFrom].assign(turning.rows(), 350.0);
    turning[weather::Field::WindFrom][1] = 10.0;
    EXPECT_NEAR(weather::value_at(script_of_forcing(turning, "x").sky.wind_from_deg, 1800e6), 360.0,
                1e-9);
    // A film of it: an hour is a second, the states are the same.
    const WeatherScript film = faster_script(script, 3600.0);
    EXPECT_NEAR(film.duration_s, 239.0, 1e-9);
    EXPECT_NEAR(film.solve().state_at(weather::to_time_us(8)).wetness, wet.wetness, 1e-9);
}

// ---- clocks, and what a reader of a report sees ----

TEST(Report, TimesAreThoseOfTheFilesClock)
{
    PhysicalRun run = city();
    run.clock_offset_s = -7 * 3600.0;
    const SimulationTable t = simulated(weather_csv(), run);
    EXPECT_EQ(clock_name(t), "UTC-7");
    EXPECT_EQ(time_text(t, 0.0), "2024-01-31 17:00");
    const std::string csv = csv_text(t);
    EXPECT_EQ(csv.substr(0, 18), "time_s,time_local,");
    EXPECT_NE(csv.find("\n0,2024-01-31T17:00:00-07:00,9,"), std::string::npos);
    EXPECT_NE(html_report(t).find("UTC-7; "), std::string::npos);
    EXPECT_NE(svg_plot(t).find("UTC-7"), std::string::npos);
    run.clock_offset_s = 5.5 * 3600.0;
    EXPECT_EQ(clock_name(simulated(weather_csv(), run)), "UTC+5:30");
}

TEST(Report, CelsiusOfAFileStayAsTheyAre)
{
    const SimulationTable t = simulated(
        "time,air_temp_c,wind_m_s\n2024-01-01T00:00,-14.9,2\n2024-01-01T01:00,-3.3,2\n", city());
    EXPECT_EQ(t.rows[0][at(t, "air_temp_c")], -14.9);
    EXPECT_EQ(t.rows[1][at(t, "air_temp_c")], -3.3);
}

// Three years of minutes-like rows with one storm.
SimulationTable long_table()
{
    SimulationTable t;
    t.columns = {"time_s", "rain"};
    t.dated = true;
    for (int i = 0; i < 60000; ++i) t.rows.push_back({i * 1800.0, i == 43210 ? 34.0 : 0.1});
    t.panels = {{.title = "rain, mm/h",
                 .series = {{.column = "rain", .label = "", .color = "#000000"}},
                 .low = 0.0,
                 .high = 0.0}};
    return t;
}

TEST(Report, TheStormSurvivesThinning)
{
    const SimulationTable t = long_table();
    const auto rows = rows_to_draw(t, 20000);
    EXPECT_LE(rows.size(), 20000u);
    EXPECT_TRUE(std::binary_search(rows.begin(), rows.end(), 43210u));
    EXPECT_NE(html_report(t).find("34.0"), std::string::npos);
}

TEST(Report, PicturesStayOnesThatCanBeLookedAt)
{
    SimulationTable t = long_table();
    t.panels.assign(12, t.panels.front());
    for (int i = 0; i < 60; ++i) t.events.push_back({i * 1e6, "snow on the ground"});
    EXPECT_LE(plot_of(t).height, 1999.0);
}

TEST(Report, ATypicalYearSaysThatItIsOne)
{
    SimulationTable t = long_table();
    t.typical_year = true;
    EXPECT_NE(html_report(t).find("typical year"), std::string::npos);
    EXPECT_NE(svg_plot(t).find("typical year"), std::string::npos);
}

TEST(Report, WhatTheFileObservedIsDrawn)
{
    const SimulationTable t = simulated(
        "time,air_temp_c,precip_mm,snow_depth_m,surface_temp_c\n2024-01-01T00:00,-5,2,0.10,-6\n"
        "2024-01-01T01:00,-5,2,0.12,-6\n2024-01-01T02:00,-5,0,0.13,-7\n",
        city());
    std::vector<std::string> drawn;
    for (const PlotPanel& panel : t.panels) {
        for (const PlotDots& dots : panel.dots) {
            EXPECT_EQ(dots.label, "in the file");
            drawn.push_back(panel.title.substr(0, 12));
        }
    }
    EXPECT_EQ(drawn, (std::vector<std::string>{"snow depth, ", "surface temp"}));
    EXPECT_EQ(t.scores.size(), 2u);
}

// An hour of rain is an hour of rain in the picture: no slope leads up to it.
TEST(Report, RainIsDrawnInSteps)
{
    std::string text = "time,air_temp_c,rain_mm,snowfall_mm\n";
    for (int hour = 0; hour < 10; ++hour) {
        char line[60];
        std::snprintf(line, sizeof line, "2024-02-01T%02d:00Z,9,%d,0\n", hour, hour == 4 ? 3 : 0);
        text += line;
    }
    SimulationTable t = simulated(text, city());
    std::size_t steps = 0;
    for (const PlotPanel& panel : t.panels)
        for (const PlotSeries& series : panel.series) steps += series.steps;
    EXPECT_EQ(steps, 2u) << "rain and snow alone";
    const std::string stepped = svg_plot(t);
    EXPECT_NE(html_report(t).find("\"steps\":true"), std::string::npos);
    for (PlotPanel& panel : t.panels)
        for (PlotSeries& series : panel.series) series.steps = false;
    EXPECT_EQ(html_report(t).find("\"steps\":true"), std::string::npos);
    EXPECT_GT(stepped.size(), svg_plot(t).size()) << "corners between the rows";
}

// Light that comes back from a meadow says nothing about snow; without a depth its share tells which.
TEST(Report, LightFromBareGroundIsNoSnowsAlbedo)
{
    const auto albedo_scores = [](const char* up) {
        const SimulationTable t = simulated(
            std::string("time,air_temp_c,precip_mm,sw_down_w_m2,sw_up_w_m2\n2024-01-01T10:00,-5,2,400,") +
                up + "\n2024-01-01T11:00,-5,2,420," + up + "\n2024-01-01T12:00,-5,0,430," + up + "\n",
            city());
        return std::count_if(t.scores.begin(), t.scores.end(),
                             [](const auto& s) { return s.column == "snow_albedo"; });
    };
    EXPECT_EQ(albedo_scores("90"), 0);
    EXPECT_EQ(albedo_scores("310"), 1);
}

TEST(Report, RunwaysOfMetarAreCompared)
{
    // A dry runway, then heavy snow that stays: dry, wet and white count as three classes.
    std::string text = "2024-01-10\n";
    const char* const states[] = {"R33/0///70", "R33/0///70", "R33/490230", "R33/490231 R15/0///70"};
    for (int hour = 0; hour < 12; ++hour) {
        const bool snows = hour >= 6;
        char line[160];
        std::snprintf(line, sizeof line,
                      "METAR KABC 10%02d50Z 24010KT 2000 %sOVC010 M06/%s Q1003 %s=\n", hour,
                      snows ? "+SN " : "", snows ? "M07" : "M14", states[hour / 3]);
        text += line;
    }
    const SimulationTable t = simulated(text, city());
    ASSERT_EQ(t.scores.size(), 2u);
    EXPECT_EQ(t.scores[0].column, "road_condition");
    EXPECT_EQ(t.scores[0].count, 12u);
    ASSERT_TRUE(t.scores[0].agreement);
    EXPECT_GT(*t.scores[0].agreement, 0.8);
    EXPECT_EQ(t.scores[1].column, "wheel_friction");
    EXPECT_LT(t.scores[1].rmse, 0.2);
    EXPECT_NE(html_report(t).find("agree</td>"), std::string::npos);

    // The same runway reported the wrong way round agrees with nothing.
    std::string wrong = text;
    for (std::size_t at = 0; (at = wrong.find("R33/", at)) != std::string::npos; at += 4)
        wrong[at + 4] = wrong[at + 4] == '0' ? '7' : '0';
    const SimulationTable other = simulated(wrong, city());
    EXPECT_LT(*other.scores[0].agreement, 0.2);
}

}  // namespace
}  // namespace petrichor::cli
