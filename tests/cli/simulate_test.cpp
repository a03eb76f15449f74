// The tables, plots and reports of `petrichor simulate`, without the program around them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/error.h"
#include "base/output_file.h"
#include "cli/report/plot.h"
#include "cli/report/plot_axes.h"
#include "cli/report/report.h"
#include "cli/report/time_axis.h"
#include "cli/simulate/artist.h"
#include "weather/models/artist/csv.h"
#include "weather/readers/text.h"

namespace petrichor::cli {
namespace {

namespace fs = std::filesystem;

WeatherScript five_parts()
{
    WeatherScript script;
    script.name = "five parts";
    script.timeline = weather::parse_timeline_csv(
                          "time_s,temperature_c,rainfall\n0,15,.6\n2,-8,.6\n"
                          "6,-8,0\n8,6,0\n11,12,.3\n12.5,12,.3\n",
                          weather::Interpolation::Hold)
                          .timeline;
    script.duration_s = weather::to_seconds(script.timeline.end());
    return script;
}

std::vector<std::string> lines_of(const std::string& text)
{
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

TEST(Simulate, CsvKeepsItsContract)
{
    ArtistRun run;
    run.every_s = {1, 2};
    const SimulationTable table = run_artist(five_parts(), run);
    const auto lines = lines_of(csv_text(table));
    ASSERT_EQ(lines.size(), 27u);  // header, 0, 0.5, ... 12.5
    EXPECT_EQ(lines[0],
              "time_s,temperature_c,rainfall,rain,snowfall,wetness,cracks,puddles,water,snow,"
              "water_to_snow,snow_melt,freeze_exp,melt,melt_exp,flood_cracks,flood_puddles,"
              "film_albedo,film_smoothness,snow_amount,rain_particles_s,snow_particles_s");
    EXPECT_EQ(lines[1].substr(0, 11), "0,15,0.6,0,");
    EXPECT_EQ(lines[1].substr(0, lines[1].find(",0.99")), "0,15,0.6,0,0,0,0,0,0,0,0.01");
    // The digits read back as the same bits.
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
        std::istringstream in(lines[r + 1]);
        std::string cell;
        for (double value : table.rows[r]) {
            ASSERT_TRUE(std::getline(in, cell, ','));
            EXPECT_EQ(std::strtod(cell.c_str(), nullptr), value);
        }
    }
    EXPECT_EQ(lines_of(csv_text(table, true)).back().substr(0, 13), "# hash state=");
}

TEST(Simulate, SteppedFollowsTheFrameRate)
{
    const std::pair<Fraction, double> expected[] = {{{1, 240}, .213886},
                                                    {{1, 60}, .213115},
                                                    {{1, 30}, .212080},
                                                    {{1, 10}, .208053},
                                                    {{1, 2}, .185222}};
    for (const auto& [dt, wetness] : expected) {
        ArtistRun run;
        run.stepped = true;
        run.step_s = dt;
        run.every_s = {1, 2};
        EXPECT_NEAR(run_artist(five_parts(), run).rows.back()[5], wetness, 5e-7);
    }
}

// A row holds the inputs of the step that ended there: at the key of 2 s still those before it.
TEST(Simulate, RowsHoldTheInputsOfTheStepThatEnds)
{
    for (bool stepped : {false, true}) {
        ArtistRun run;
        run.stepped = stepped;
        const SimulationTable table = run_artist(five_parts(), run);
        EXPECT_EQ(table.rows[0][1], 15.0);
        EXPECT_EQ(table.rows[2][1], 15.0);
        EXPECT_EQ(table.rows[3][1], -8.0);
        EXPECT_EQ(table.rows[0][3], 0.0);
        for (std::size_t r = 1; r < table.rows.size(); ++r) {
            EXPECT_NEAR(table.rows[r][3] + table.rows[r][4], table.rows[r][2], 1e-15);
        }
    }
}

TEST(Simulate, ExactIsTheLimitOfSteppedInEveryColumn)
{
    ArtistRun run;
    const SimulationTable exact = run_artist(five_parts(), run);
    run.stepped = true;
    run.step_s = {1, 20000};
    const SimulationTable stepped = run_artist(five_parts(), run);
    ASSERT_EQ(exact.rows.size(), stepped.rows.size());
    for (std::size_t r = 0; r < exact.rows.size(); ++r) {
        for (std::size_t c = 0; c < 20; ++c) {
            EXPECT_NEAR(exact.rows[r][c], stepped.rows[r][c], 1e-4) << r << ' ' << exact.columns[c];
        }
    }
}

TEST(Simulate, AWindowGivesTheRowsOfTheWhole)
{
    ArtistRun run;
    run.every_s = {1, 4};
    const SimulationTable whole = run_artist(five_parts(), run);
    run.from_s = 4.1;
    run.to_s = 7.3;
    const SimulationTable part = run_artist(five_parts(), run);
    ASSERT_EQ(part.rows.size(), 13u);
    EXPECT_EQ(part.rows.front()[0], 4.25);
    for (std::size_t r = 0; r < part.rows.size(); ++r) EXPECT_EQ(part.rows[r], whole.rows[r + 17]);
}

TEST(Simulate, ResumesWithIdenticalBits)
{
    for (bool stepped : {false, true}) {
        ArtistRun run;
        run.stepped = stepped;
        run.every_s = {1, 4};
        const SimulationTable whole = run_artist(five_parts(), run);
        std::string checkpoint;
        ArtistRun first = run;
        first.to_s = 7.25;
        first.checkpoint = &checkpoint;
        const SimulationTable start = run_artist(five_parts(), first);
        ArtistRun second = run;
        second.resume = checkpoint;
        const SimulationTable rest = run_artist(five_parts(), second);
        ASSERT_EQ(start.rows.size() + rest.rows.size(), whole.rows.size());
        for (std::size_t r = 0; r < rest.rows.size(); ++r) {
            EXPECT_EQ(rest.rows[r], whole.rows[start.rows.size() + r]);
        }
        EXPECT_EQ(rest.state_hash, whole.state_hash);
        WeatherScript other = five_parts();
        other.params.time_scale = 0.5;
        EXPECT_THROW(run_artist(other, second), Error);
        second.resume = checkpoint.substr(0, checkpoint.size() / 2);
        EXPECT_THROW(run_artist(five_parts(), second), Error);
    }
}

TEST(Simulate, FractionsAreExact)
{
    EXPECT_EQ(parse_fraction("1/60", "--dt").denominator, 60);
    EXPECT_EQ(parse_fraction("0.25", "--dt").value(), 0.25);
    EXPECT_EQ(parse_fraction(".5", "--dt").value(), 0.5);
    EXPECT_EQ(parse_fraction("2", "--dt").value(), 2.0);
    for (const char* bad :
         {"", "0", "-1", "1/0", "/", "1/", "a", "1e-3", "nan", "0.0000000001", ".", "1.-5", "--"}) {
        EXPECT_THROW(parse_fraction(bad, "--dt"), Error) << bad;
    }
}

TEST(Simulate, RefusesEmptyWindowsAndTooManyRows)
{
    ArtistRun run;
    run.from_s = 99.0;
    EXPECT_THROW(run_artist(five_parts(), run), Error);
    run.from_s = 0.0;
    run.to_s = 1e9;
    EXPECT_THROW(run_artist(five_parts(), run), Error);
}

TEST(Plot, TimesOfEventsAreShort)
{
    const SimulationTable table;
    EXPECT_EQ(time_text(table, 20.841999999999999), "20.842 s");
    EXPECT_EQ(time_text(table, 38.5), "38.5 s");
    EXPECT_EQ(time_text(table, 12.0), "12 s");
}

// An axis of hours says its day, one of days or months its year.
TEST(Plot, TheFirstTickOfADatedAxisSaysWhatTheOthersDoNot)
{
    const std::int64_t start_us = weather::us_from_iso("2019-03-17T04:20").value();
    const auto labels = [&](double first_s, double last_s) {
        std::vector<std::string> out;
        for (const TimeTick& tick : calendar_ticks(start_us, first_s, last_s, 12)) out.push_back(tick.label);
        return out;
    };
    EXPECT_EQ(labels(0, 7200).front(), "04:20 17 Mar");
    EXPECT_EQ(labels(0, 7200).at(1), "04:30");
    const auto night = labels(3600 * 18.0, 3600 * 22.0);
    EXPECT_EQ(night.front(), "22:30 17 Mar");
    EXPECT_NE(std::find(night.begin(), night.end(), "18 Mar"), night.end());
    EXPECT_EQ(labels(86400.0, 86400 * 9.0).front(), "19 Mar 2019");
    EXPECT_EQ(labels(0, 86400 * 200.0).front(), "Apr 2019");
}

TEST(Plot, TicksAreRoundAndInside)
{
    EXPECT_EQ(axis_ticks(0, 1, 5, false),
              (std::vector<double>{0, 0.2, 0.4, 0.6000000000000001, 0.8, 1}));
    EXPECT_EQ(axis_ticks(0, 7200, 6, true).at(1), 1800.0);
    EXPECT_EQ(time_label(7200, 3600), "2 h");
    EXPECT_EQ(time_label(0.5, 0.5), "0.5 s");
    EXPECT_EQ(axis_ticks(3, 3, 5, false).size(), 1u);
}

TEST(Plot, SvgIsWholeAndEscapesItsTitle)
{
    WeatherScript script = five_parts();
    script.name = "a <b> & \"c\"";
    ArtistRun run;
    run.every_s = {1, 10};
    const SimulationTable table = run_artist(script, run);
    const std::string svg = svg_plot(table);
    EXPECT_EQ(svg.find("<b>"), std::string::npos);
    EXPECT_NE(svg.find("a &lt;b&gt; &amp; &quot;c&quot;"), std::string::npos);
    EXPECT_EQ(svg.substr(svg.size() - 7), "</svg>\n");
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    std::size_t lines = 0;
    for (std::size_t at = svg.find("<polyline"); at != svg.npos;
         at = svg.find("<polyline", at + 1)) {
        ++lines;
    }
    EXPECT_GE(lines, 9u);
    EXPECT_NE(svg.find("everything frozen"), std::string::npos);
}

TEST(Plot, PixelsShowEveryCurveAndItsText)
{
    const Pixels pixels = to_pixels(plot_of(run_artist(five_parts(), {})), 1.0);
    EXPECT_EQ(pixels.width, 960);
    ASSERT_EQ(pixels.rgb.size(),
              static_cast<std::size_t>(pixels.width) * static_cast<std::size_t>(pixels.height) * 3);
    const auto count = [&](int red, int green, int blue) {
        std::size_t found = 0;
        for (std::size_t i = 0; i < pixels.rgb.size(); i += 3) {
            found +=
                pixels.rgb[i] == red && pixels.rgb[i + 1] == green && pixels.rgb[i + 2] == blue;
        }
        return found;
    };
    EXPECT_GT(count(0xd9, 0x54, 0x1e), 200u);  // temperature
    EXPECT_GT(count(0x0e, 0x9f, 0x8e), 200u);  // film
    EXPECT_GT(count(0xd9, 0x77, 0x06), 200u);  // phase
    EXPECT_GT(count(255, 255, 255), pixels.rgb.size() / 3 / 2);
}

TEST(Plot, AreasAndLinesCoverWhatTheyShould)
{
    Drawing drawing{20, 10, {}};
    drawing.shapes.push_back(DrawnArea{{{2, 2}, {12.5, 2}, {12.5, 8}, {2, 8}}, "#000000", 1.0});
    const Pixels area = to_pixels(drawing, 1.0);
    const auto red = [](const Pixels& p, int x, int y) {
        return p.rgb[static_cast<std::size_t>((y * p.width + x) * 3)];
    };
    EXPECT_EQ(red(area, 5, 5), 0);
    EXPECT_EQ(red(area, 12, 5), 128);  // half covered
    EXPECT_EQ(red(area, 13, 5), 255);
    EXPECT_EQ(red(area, 5, 1), 255);
    drawing.shapes = {DrawnLine{{{0, 5}, {20, 5}}, "#ff0000", 2.0, false}};
    const Pixels line = to_pixels(drawing, 1.0);
    EXPECT_EQ(line.rgb[static_cast<std::size_t>((4 * 20 + 9) * 3 + 1)], 0);
    EXPECT_EQ(line.rgb[static_cast<std::size_t>((7 * 20 + 9) * 3 + 1)], 255);
}

TEST(Report, NeedsNothingFromTheNetwork)
{
    WeatherScript script = five_parts();
    script.name = "</script><b>";
    const std::string html = html_report(run_artist(script, {}));
    EXPECT_EQ(html.find("</script><b>"), std::string::npos);
    for (const char* outside : {"src=", "href=", "@import", "fetch(", "XMLHttpRequest"}) {
        EXPECT_EQ(html.find(outside), std::string::npos) << outside;
    }
}

std::string chromium()
{
    for (const char* name : {"chromium", "chromium-browser", "google-chrome"}) {
        for (const char* folder : {"/usr/bin/", "/usr/local/bin/", "/snap/bin/"}) {
            if (fs::exists(std::string(folder) + name)) return std::string(folder) + name;
        }
    }
    return "";
}

// The page in a browser: its script ran to the end, drew every panel, listed every event, put the
// cursor where the link asks for it, and fits the width of a desktop and of a phone.
TEST(Report, OpensInChromium)
{
    const std::string browser = chromium();
    if (browser.empty())
        GTEST_SKIP() << "no Chromium on this machine (Debian: apt install chromium)";
    ArtistRun run;
    run.every_s = {1, 20};
    const SimulationTable table = run_artist(five_parts(), run);
    const fs::path folder =
        fs::temp_directory_path() / ("petrichor-report-" + std::to_string(::getpid()));
    write_text_file(folder / "report.html", html_report(table));
    for (const char* size : {"1280,900", "500,800"}) {
        const std::string command =
            "timeout 100 " + browser +
            " --headless=new --no-sandbox --disable-gpu --no-first-run --user-data-dir=" +
            (folder / "profile").string() + " --window-size=" + size + " --dump-dom file://" +
            (folder / "report.html").string() + "#t=5 2>/dev/null";
        std::string page;
        FILE* pipe = ::popen(command.c_str(), "r");
        ASSERT_NE(pipe, nullptr);
        std::array<char, 4096> buffer{};
        while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), pipe)) {
            page.append(buffer.data(), count);
        }
        ::pclose(pipe);
        const std::string expected =
            "data-ready=\"true:4:" + std::to_string(table.events.size()) + ":fits\"";
        EXPECT_NE(page.find(expected), std::string::npos) << size << ": " << page.substr(0, 300);
        EXPECT_NE(page.find("everything frozen</span>"), std::string::npos);
        // The cursor of #t=5 stands at 5 s, and the legends read the row's values there.
        EXPECT_NE(page.find("id=\"now\">5.00 s<"), std::string::npos) << size;
        const auto& row = table.rows.at(100);
        ASSERT_EQ(row[0], 5.0);
        for (const char* column : {"rain", "wetness", "puddles", "snow"}) {
            char value[32];
            std::snprintf(value, sizeof value, "<b>%.3f</b>", row[column_index(table, column)]);
            EXPECT_NE(page.find(value), std::string::npos) << column << value;
        }
    }
    fs::remove_all(folder);
}

}  // namespace
}  // namespace petrichor::cli
