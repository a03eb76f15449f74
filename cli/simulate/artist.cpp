#include "cli/simulate/artist.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <sstream>
#include <vector>

#include "base/error.h"
#include "weather/models/artist/csv.h"

namespace petrichor::cli {
namespace {

using weather::ArtistState;
using weather::ArtistTimeline;
using weather::TimeUs;

__extension__ typedef __int128 Wide;

constexpr double kMostRows = 2.0e7;

// floor(index * a / b) of two fractions, without rounding.
std::int64_t whole_steps(std::int64_t index, const Fraction& a, const Fraction& b)
{
    return static_cast<std::int64_t>(Wide{index} * a.numerator * b.denominator /
                                     (Wide{a.denominator} * b.numerator));
}

double time_us_of(std::int64_t index, const Fraction& step)
{
    return static_cast<double>(index * step.numerator) * 1e6 /
           static_cast<double>(step.denominator);
}

double time_s_of(std::int64_t index, const Fraction& step)
{
    return static_cast<double>(index * step.numerator) / static_cast<double>(step.denominator);
}

const std::vector<double ArtistState::*>& state_members()
{
    using S = ArtistState;
    static const std::vector<double S::*> kMembers{&S::water_to_snow, &S::wetness, &S::cracks,
                                                   &S::puddles,       &S::water,   &S::snow,
                                                   &S::rain,          &S::snowfall};
    return kMembers;
}

// What must be the same for a checkpoint to fit: the script, the parameters, the mode and the step.
std::uint64_t fingerprint(const WeatherScript& script, const ArtistRun& run)
{
    std::uint64_t hash = run.stepped ? 2 : 1;
    const auto add = [&](double value) {
        hash = weather::state_hash({.water_to_snow = value}, hash);
    };
    const auto add_channel = [&](const weather::Channel& channel) {
        add(static_cast<double>(channel.interpolation));
        for (std::size_t i = 0; i < channel.times.size(); ++i) {
            add(static_cast<double>(channel.times[i]));
            add(channel.values[i]);
        }
    };
    add_channel(script.timeline.temperature_c);
    add_channel(script.timeline.rainfall);
    for (const auto& [name, channel] : script.timeline.parameters) {
        for (char c : name) add(c);
        add_channel(channel);
    }
    for (const auto& [name, channel] : script.timeline.states) {
        for (char c : name) add(c);
        add_channel(channel);
    }
    for (const auto& parameter : weather::artist_parameters()) add(script.params.*parameter.member);
    add(script.params.script_controlled ? 1.0 : 0.0);
    hash = weather::state_hash(script.initial, hash);
    if (run.stepped) {
        add(static_cast<double>(run.step_s.numerator));
        add(static_cast<double>(run.step_s.denominator));
    }
    return hash;
}

// A checkpoint: where the run stood, by bits. `position` counts steps, or microseconds when exact;
// `anchor` is where the exact solution is taken up.
struct Checkpoint {
    std::uint64_t fingerprint = 0;
    std::int64_t position = 0;
    TimeUs anchor = 0;
    ArtistState state;
};

constexpr const char* kCheckpointTitle = "petrichor-artist-checkpoint-1";

std::string to_text(const Checkpoint& checkpoint)
{
    std::ostringstream out;
    out << kCheckpointTitle << '\n'
        << "run " << hash_text(checkpoint.fingerprint) << "\nposition " << checkpoint.position
        << "\nanchor " << checkpoint.anchor << "\nstate";
    for (auto member : state_members()) {
        out << ' ' << hash_text(std::bit_cast<std::uint64_t>(checkpoint.state.*member));
    }
    out << '\n';
    return out.str();
}

Checkpoint checkpoint_from(const std::string& text)
{
    Checkpoint checkpoint;
    std::istringstream in(text);
    std::string title, word;
    in >> title;
    if (title == kCheckpointTitle) {
        in >> word >> std::hex >> checkpoint.fingerprint >> std::dec >> word >>
            checkpoint.position >> word >> checkpoint.anchor >> word >> std::hex;
        for (auto member : state_members()) {
            std::uint64_t bits = 0;
            in >> bits;
            checkpoint.state.*member = std::bit_cast<double>(bits);
        }
    }
    if (title != kCheckpointTitle || !in) {
        throw Error("checkpoint: this is not a whole checkpoint of the artist model",
                    "Use a file that --checkpoint wrote.");
    }
    return checkpoint;
}

// Collects rows.
struct Tabulation {
    SimulationTable table;

    void add(double time_s, const ArtistState& state, const weather::ArtistOutputs& outputs)
    {
        const auto row = weather::artist_row(time_s, state, outputs);
        table.rows.emplace_back(row.begin(), row.end());
        table.state_hash = weather::state_hash(state);
        table.table_hash = weather::state_hash(state, table.table_hash);
    }
};

std::vector<PlotPanel> artist_panels()
{
    return {
        {.title = "temperature, \u00b0C",
         .forcing = true,
         .series = {{.column = "temperature_c", .label = "", .color = "#d9541e"}},
         .low = 0.0,
         .high = 0.0,
         .group = "weather"},
        {.title = "precipitation, 0..1",
         .forcing = true,
         .series =
             {{.column = "rain", .label = "rain", .color = "#1d5fc1", .filled = true},
              {.column = "snowfall", .label = "snowfall", .color = "#56b4e9", .filled = true}},
         .group = "weather"},
        {.title = "water, 0..1",
         .series = {{.column = "wetness", .label = "film", .color = "#0e9f8e"},
                    {.column = "cracks", .label = "cracks", .color = "#d55e00"},
                    {.column = "puddles", .label = "puddles", .color = "#2456c4"}},
         .group = "water"},
        {.title = "snow and phase, 0..1",
         .series =
             {{.column = "snow_amount", .label = "snow shown", .color = "#8fb3d9", .filled = true},
              {.column = "snow", .label = "snow on the ground", .color = "#4a80bd"},
              {.column = "water_to_snow", .label = "frozen", .color = "#d97706"}},
         .group = "snow"},
    };
}

struct Window {
    std::int64_t first = 0;
    std::int64_t last = 0;  // inclusive, in units of every_s
};

Window window_of(const ArtistRun& run, double to_s)
{
    const double every = run.every_s.value();
    Window window{static_cast<std::int64_t>(std::ceil(run.from_s / every - 1e-9)),
                  static_cast<std::int64_t>(std::floor(to_s / every + 1e-9))};
    if (window.last < window.first) {
        throw Error("simulate: no row lies between " + std::to_string(run.from_s) + " s and " +
                        std::to_string(to_s) + " s at every " + std::to_string(every) + " s",
                    "Choose another --from, --to or --every.");
    }
    if (static_cast<double>(window.last - window.first) > kMostRows) {
        throw Error("simulate: " + std::to_string(window.last - window.first) +
                        " rows, at most 20000000 are written",
                    "Give a larger --every.");
    }
    return window;
}

void run_exact(const WeatherScript& script, const ArtistRun& run, Window window, Tabulation& out)
{
    Checkpoint start{fingerprint(script, run), -1, 0, script.initial};
    if (!run.resume.empty()) start = checkpoint_from(run.resume);
    const ArtistTimeline solution(script.timeline, script.params, start.state, start.anchor);
    for (std::int64_t m = window.first; m <= window.last; ++m) {
        const double time_us = time_us_of(m, run.every_s);
        const auto time = static_cast<TimeUs>(std::llround(time_us));
        if (time <= start.position) continue;
        ArtistState state = solution.state_at(time);
        if (m == 0) state.rain = state.snowfall = 0.0;
        out.add(time_s_of(m, run.every_s), state,
                weather::outputs(state, solution.params_at(time), solution.temperature_c_at(time),
                                 solution.rainfall_at(time)));
    }
    if (run.checkpoint) {
        const auto end = static_cast<TimeUs>(std::llround(time_us_of(window.last, run.every_s)));
        const auto anchor = solution.checkpoint_at(end);
        *run.checkpoint =
            to_text({fingerprint(script, run), end, anchor.anchor, anchor.anchor_state});
    }
}

void run_stepped(const WeatherScript& script, const ArtistRun& run, Window window, Tabulation& out)
{
    Checkpoint start{fingerprint(script, run), 0, 0, script.initial};
    const bool resumed = !run.resume.empty();
    if (resumed) start = checkpoint_from(run.resume);
    const weather::Timeline& timeline = script.timeline;
    const double dt_s = run.step_s.value();
    ArtistState state = start.state;
    std::int64_t done = start.position;
    // The inputs of the last step, for the row; before the first step those that are in force.
    double input_us = time_us_of(std::max<std::int64_t>(0, done - 1), run.step_s);
    for (std::int64_t m = window.first; m <= window.last; ++m) {
        const std::int64_t wanted = whole_steps(m, run.every_s, run.step_s);
        if (resumed && wanted <= start.position) continue;
        for (; done < wanted; ++done) {
            input_us = time_us_of(done, run.step_s);
            const auto params = weather::params_at(timeline, script.params, input_us);
            if (!params.script_controlled) state = weather::hand_set(timeline, state, input_us);
            state =
                weather::step(state, params, weather::value_at(timeline.temperature_c, input_us),
                              weather::value_at(timeline.rainfall, input_us), dt_s);
        }
        out.add(time_s_of(m, run.every_s), state,
                weather::outputs(state, weather::params_at(timeline, script.params, input_us),
                                 weather::value_at(timeline.temperature_c, input_us),
                                 weather::value_at(timeline.rainfall, input_us)));
    }
    if (run.checkpoint) *run.checkpoint = to_text({fingerprint(script, run), done, 0, state});
}

}  // namespace

SimulationTable run_artist(const WeatherScript& script, const ArtistRun& run)
{
    weather::check_timeline(script.timeline);
    const Window window = window_of(run, run.to_s.value_or(script.duration_s));
    if (!run.resume.empty() &&
        checkpoint_from(run.resume).fingerprint != fingerprint(script, run)) {
        throw Error("checkpoint: it belongs to another run (input, parameters, --mode or --dt)",
                    "Resume with the same input and options as the run that wrote it.");
    }
    Tabulation out;
    out.table.title = script.name;
    out.table.model = "artist";
    out.table.mode = run.stepped ? "stepped" : "exact";
    out.table.columns.assign(weather::kArtistColumns.begin(), weather::kArtistColumns.end());
    out.table.panels = artist_panels();
    if (run.stepped) {
        run_stepped(script, run, window, out);
    } else {
        run_exact(script, run, window, out);
    }
    const double from_s = time_s_of(window.first, run.every_s);
    const double to_s = time_s_of(window.last, run.every_s);
    for (const auto& event : script.solve().events()) {
        const double time_s = weather::to_seconds(event.time);
        if (time_s < from_s || time_s > to_s) continue;
        out.table.events.push_back({time_s, std::string(weather::name_of(event.kind))});
    }
    return std::move(out.table);
}

}  // namespace petrichor::cli
