// The physical model behind `petrichor simulate`: columns, times, checkpoints, ensembles, the fit.
#include "cli/simulate/physical.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "base/error.h"
#include "cli/simulate/plot.h"
#include "cli/simulate/report.h"

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
        std::snprintf(line, sizeof line, "2024-02-%02dT%02d:00Z,%d,%d,3,%.1f,%.1f\n", 1 + hour / 24, hour % 24, cold ? -6 : 9 + hour % 24 / 4,
                      falls ? 95 : 60, falls ? 2.0 : 0.0, falls ? 1.0 : 0.2);
        text += line;
    }
    return text;
}

PhysicalRun city()
{
    PhysicalRun run;
    run.latitude_deg = 47;
    run.longitude_deg = 8;
    run.elevation_m = 450;
    return run;
}

std::size_t at(const SimulationTable& t, const char* name)
{
    const std::size_t i = column_index(t, name);
    EXPECT_LT(i, t.columns.size()) << name;
    return i;
}

TEST(SimulatePhysical, TableHasTheContractedColumns)
{
    const SimulationTable t = run_physical(weather_csv(), "ten days", city());
    EXPECT_EQ(t.rows.size(), 241u);
    const std::string csv = csv_text(t);
    EXPECT_EQ(csv.rfind("time_s,time_utc,air_temp_c,", 0), 0u);
    EXPECT_NE(csv.find("\n0,2024-02-01T00:00:00Z,9,"), std::string::npos) << csv.substr(0, 900);
    EXPECT_NE(csv.find("\n3600,2024-02-01T01:00:00Z,"), std::string::npos);
    for (const char* name : {"snow_depth_m", "swe_kg_m2", "snow_albedo", "surface_temp_c", "film_kg_m2", "crack_kg_m2", "puddle_kg_m2",
                             "ice_kg_m2", "mass_residual_kg_m2", "energy_residual_w_m2", "wetness", "cracks", "puddles", "snow", "water_to_snow"}) {
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
    EXPECT_FALSE(svg_plot(t).empty());
    EXPECT_NE(html_report(t).find("<html"), std::string::npos);
    bool filled = false;
    for (const auto& note : t.notes) filled = filled || note.find("Haurwitz") != std::string::npos;
    EXPECT_TRUE(filled) << "the notes must say how shortwave was filled";
}

TEST(SimulatePhysical, WindowsAndCheckpointsGiveTheSameRows)
{
    const std::string csv = weather_csv();
    const SimulationTable whole = run_physical(csv, "x", city());
    PhysicalRun first = city();
    std::string checkpoint;
    first.to_s = 100 * 3600;
    first.checkpoint = &checkpoint;
    run_physical(csv, "x", first);
    PhysicalRun rest = city();
    rest.resume = checkpoint;
    const SimulationTable tail = run_physical(csv, "x", rest);
    ASSERT_EQ(tail.rows.size(), 141u);
    EXPECT_EQ(tail.state_hash, whole.state_hash);
    const std::size_t film = at(whole, "film_kg_m2"), depth = at(whole, "snow_depth_m");
    for (std::size_t i = 0; i < tail.rows.size(); ++i) {
        EXPECT_EQ(tail.rows[i][film], whole.rows[i + 100][film]);
        EXPECT_EQ(tail.rows[i][depth], whole.rows[i + 100][depth]);
    }
    rest.resume = "nonsense";
    EXPECT_THROW(run_physical(csv, "x", rest), Error);
}

TEST(SimulatePhysical, SiteTableAndBadNames)
{
    PhysicalRun run;
    run.fetch_params = "[site]\nlatitude = 47\nlongitude = 8\nelevation_m = 450\nsurface = \"grass\"\n";
    EXPECT_EQ(run_physical(weather_csv(), "x", run).mode, "grass");
    run.fetch_params = "[site]\nlattitude = 47\n";
    EXPECT_THROW(run_physical(weather_csv(), "x", run), Error);
    run = city();
    run.surface = "lava";
    EXPECT_THROW(run_physical(weather_csv(), "x", run), Error);
    run = city();
    run.phase = "maybe";
    EXPECT_THROW(run_physical(weather_csv(), "x", run), Error);
}

TEST(SimulatePhysical, EnsembleSpreadsAndRepeats)
{
    PhysicalRun run = city();
    run.members = 20;
    run.every_s = 6 * 3600;
    const SimulationTable a = run_physical(weather_csv(), "x", run);
    run.threads = 3;
    const SimulationTable b = run_physical(weather_csv(), "x", run);
    EXPECT_EQ(a.rows, b.rows);
    const std::size_t low = at(a, "swe_kg_m2_p10"), middle = at(a, "swe_kg_m2_p50"), high = at(a, "swe_kg_m2_p90");
    double widest = 0;
    for (const auto& row : a.rows) {
        EXPECT_LE(row[low], row[middle]);
        EXPECT_LE(row[middle], row[high]);
        widest = std::max(widest, row[high] - row[low]);
    }
    EXPECT_GT(widest, 2.0);
    run.members = 0;
    run.sensitivity = true;
    const SimulationTable s = run_physical(weather_csv(), "x", run);
    std::string notes;
    for (const auto& n : s.notes) notes += n + "\n";
    EXPECT_NE(notes.find("precipitation up"), std::string::npos);
}

TEST(SimulatePhysical, FittedRatesArePlausible)
{
    const std::string toml = fitted_artist_toml(weather_csv(), city());
    EXPECT_NE(toml.find("time_scale = 0.00027777"), std::string::npos) << toml;
    const auto rate = [&](const std::string& key) { return std::stod(toml.substr(toml.find(key) + key.size() + 3)); };
    EXPECT_GT(rate("accumulation_rate_wetness"), 0.3);
    EXPECT_LT(rate("accumulation_rate_wetness"), 50);
    // Puddles keep the film covered here, so it dries slowly.
    EXPECT_GT(rate("evaporation_rate_wetness"), 1e-4);
    EXPECT_GT(rate("evaporation_rate_puddles"), rate("evaporation_rate_wetness"));
    EXPECT_NE(toml.find("residual"), std::string::npos);
}

}  // namespace
}  // namespace petrichor::cli
