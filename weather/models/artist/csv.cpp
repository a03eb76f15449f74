#include "weather/models/artist/csv.h"

#include <algorithm>

#include "base/error.h"

namespace petrichor::weather {
namespace {

struct Column {
    std::string name;
    std::size_t index = 0;
    double low = 0.0;
    double high = 0.0;
};

[[noreturn]] void refuse(const std::vector<Problem>& problems)
{
    throw Error("timeline: " + std::to_string(problems.size()) +
                    (problems.size() == 1 ? " problem\n" : " problems\n") + list_problems(problems),
                "Give comma-separated columns time_s,temperature_c,rainfall with ascending times.");
}

// The columns of the header that the model knows; problems for the others and for missing ones.
std::vector<Column> columns_of(const CsvTable& table, std::vector<Problem>& problems)
{
    std::vector<Column> known{{"time_s", 0, 0.0, 9e9},
                              {"temperature_c", 0, -100.0, 100.0},
                              {"rainfall", 0, 0.0, 1.0},
                              {"script_controlled", 0, 0.0, 1.0}};
    for (const ArtistParameter& parameter : artist_parameters()) {
        const bool height = parameter.name == "snow_start_height_m";
        known.push_back({std::string(parameter.name), 0, height ? -20000.0 : 0.0,
                         std::max(1000.0, parameter.high)});
    }
    for (const HandSetState& state : hand_set_states())
        known.push_back({std::string(state.name), 0, 0.0, 1.0});
    std::vector<Column> found;
    for (Column& column : known) {
        const auto index = table.column(column.name);
        if (!index) continue;
        column.index = *index;
        found.push_back(column);
    }
    for (const char* needed : {"time_s", "temperature_c", "rainfall"}) {
        if (!table.column(needed)) problems.push_back({0, needed, "this column is missing"});
    }
    for (const std::string& name : table.header) {
        if (std::none_of(known.begin(), known.end(),
                         [&](const Column& c) { return c.name == lower_case(name); })) {
            problems.push_back(
                {0, name, "no input, parameter or state of the model has this name"});
        }
    }
    return found;
}

Channel& channel_of(Timeline& timeline, const std::string& name)
{
    if (name == "temperature_c") return timeline.temperature_c;
    if (name == "rainfall") return timeline.rainfall;
    for (const HandSetState& state : hand_set_states()) {
        if (state.name == name) return timeline.states[name];
    }
    return timeline.parameters[name];
}

}  // namespace

TimelineReading parse_timeline_csv(std::string_view text, Interpolation interpolation)
{
    const CsvTable table = parse_csv(text);
    std::vector<Problem> problems = table.problems;
    if (!table.usable) refuse(problems);
    std::vector<Problem> missing;
    const std::vector<Column> columns = columns_of(table, missing);
    if (!missing.empty()) refuse(missing);

    TimelineReading reading;
    std::vector<Problem> order;  // which of two rows is wrong nobody knows: never bridged
    std::size_t good = 0;
    TimeUs last = -1;
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
        std::vector<double> values(columns.size());
        std::vector<bool> given(columns.size(), false);
        const std::size_t before = problems.size();
        for (std::size_t c = 0; c < columns.size(); ++c) {
            const Column& column = columns[c];
            const std::string& cell = table.rows[r][column.index];
            if (cell.empty() && column.name != "time_s") continue;
            const auto value = parse_number(cell);
            if (!value) {
                problems.push_back({table.lines[r], column.name,
                                    cell.empty() ? "empty" : "not a finite number: " + cell});
            } else if (*value < column.low || *value > column.high) {
                problems.push_back({table.lines[r], column.name,
                                    cell + " is outside " + number_17(column.low) + " .. " +
                                        number_17(column.high)});
            } else {
                values[c] = *value;
                given[c] = true;
            }
        }
        if (problems.size() > before) continue;
        const TimeUs time = to_time_us(values[0]);
        if (time <= last) {
            order.push_back(
                {table.lines[r], "time_s",
                 table.rows[r][columns[0].index] +
                     (time == last ? " appears twice" : " is earlier than the row before")});
            continue;
        }
        last = time;
        ++good;
        for (std::size_t c = 1; c < columns.size(); ++c) {
            if (!given[c]) continue;
            Channel& channel = channel_of(reading.timeline, columns[c].name);
            channel.times.push_back(time);
            channel.values.push_back(values[c]);
            channel.interpolation =
                columns[c].name == "script_controlled" ? Interpolation::Hold : interpolation;
        }
    }
    if (!order.empty() || problems.size() * 20 > good) {
        problems.insert(problems.end(), order.begin(), order.end());
        std::stable_sort(problems.begin(), problems.end(),
                         [](const Problem& a, const Problem& b) { return a.line < b.line; });
        if (!problems.empty()) refuse(problems);
    }
    if (good == 0) refuse({{0, "", "no rows after the header"}});
    for (const char* needed : {"temperature_c", "rainfall"}) {
        if (channel_of(reading.timeline, needed).empty())
            refuse({{0, needed, "no row has a value"}});
    }
    reading.bridged = std::move(problems);
    return reading;
}

std::array<double, kArtistColumns.size()> artist_row(double time_s, const ArtistState& state,
                                                     const ArtistOutputs& out)
{
    const double phase = std::clamp(state.water_to_snow, 0.0, 1.0);
    return {time_s,
            out.temperature_c,
            out.rainfall,
            state.rain,
            state.snowfall,
            state.wetness,
            state.cracks,
            state.puddles,
            state.water,
            state.snow,
            phase,
            out.snow_melt,
            out.freeze_exp,
            out.melt,
            out.melt_exp,
            out.flood_cracks,
            out.flood_puddles,
            out.film_albedo,
            out.film_smoothness,
            out.snow_amount,
            out.rain_particles_s,
            out.snow_particles_s};
}

}  // namespace petrichor::weather
