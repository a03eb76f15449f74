#include <cmath>

#include "base/error.h"
#include "base/output_file.h"
#include "cli/simulate/artist.h"
#include "cli/simulate/simulations.h"
#include "film/weather/times.h"
#include "weather/models/artist/csv.h"
#include "weather/models/artist/from_forcing.h"

namespace petrichor::cli {
namespace {

WeatherScript script_of_keys(const Input& input, const std::string& interpolation,
                             std::vector<std::string>& notes)
{
    WeatherScript script;
    const std::string word = interpolation.empty() ? "hold" : interpolation;
    auto reading = weather::parse_timeline_csv(input.text, *weather::interpolation_named(word));
    script.timeline = std::move(reading.timeline);
    script.duration_s = weather::to_seconds(script.timeline.end());
    notes.push_back("read " + std::to_string(script.timeline.temperature_c.times.size()) +
                    " keys of temperature, " +
                    std::to_string(script.timeline.rainfall.times.size()) +
                    " of rainfall, interpolation " + word);
    if (!reading.bridged.empty()) {
        notes.push_back("left out " + std::to_string(reading.bridged.size()) +
                        " bad rows: " + weather::list_problems(reading.bridged));
    }
    return script;
}

// What drives the artist model, and where it came from when that was a weather file.
struct ArtistInput {
    WeatherScript script;
    std::optional<weather::ReadResult> read;
    std::vector<std::string> notes;
};

ArtistInput artist_input(const std::vector<Input>& inputs, const SimulateOptions& options)
{
    const Input& first = inputs.front();
    ArtistInput result;
    if (first.kind != InputKind::Keys && !options.interpolation.empty()) {
        throw Error(
            "simulate: --interp is for CSV keys; " + first.file + " has its own interpolation",
            "Leave --interp out, or change interpolation in the file.");
    }
    if (first.kind == InputKind::Script) {
        result.script = read_weather_script(first.text, first.file);
    } else if (first.kind == InputKind::Keys) {
        result.script = script_of_keys(first, options.interpolation, result.notes);
    } else {
        result.read =
            read_forcing(inputs, with_site_table(options.physical.site, params_text(options)));
        result.script = script_of_forcing(result.read->table, first.name);
        result.notes.emplace_back(
            "an hour of weather is a second of the artist model (time_scale 1/3600); --params "
            "changes that");
    }
    if (result.script.name.empty()) result.script.name = first.name;
    if (!options.params.empty()) {
        const double scale = result.script.params.time_scale;
        const ArtistSettings settings =
            read_artist_settings(params_text(options), options.params, result.read ? scale : 1.0);
        result.script.params = settings.params;
        result.script.initial = settings.initial;
    }
    return result;
}

}  // namespace

SimulationTable simulate_artist(const std::vector<Input>& inputs, const SimulateOptions& options)
{
    const ArtistInput input = artist_input(inputs, options);
    std::optional<std::int64_t> start_us;
    double offset_s = 0.0;  // of the clock of the file
    if (input.read) {
        start_us = input.read->table.time_us.front();
        const double zone_h = input.read->table.site.utc_offset_h;
        if (!options.physical.utc && !std::isnan(zone_h)) offset_s = zone_h * 3600.0;
    }
    ArtistRun run;
    run.stepped = options.mode == "stepped";
    if (!options.step.empty()) run.step_s = parse_duration(options.step, "--dt");
    run.every_s = options.every.empty() ? Fraction{input.read ? 3600 : 1, 1}
                                        : parse_duration(options.every, "--every");
    if (options.every.empty() && run.stepped && run.step_s.value() > run.every_s.value())
        run.every_s = run.step_s;
    run.from_s = time_of(options.from, "--from", start_us, offset_s).value_or(0.0);
    run.to_s = time_of(options.to, "--to", start_us, offset_s);
    std::string checkpoint;
    if (!options.checkpoint.empty()) run.checkpoint = &checkpoint;
    if (!options.resume.empty()) run.resume = read_checkpoint_file(options.resume);
    SimulationTable table = run_artist(input.script, run);
    if (input.read) {
        add_read_report(table, *input.read);
        table.dated = true;
        table.utc_start_us = *start_us;
        table.utc_offset_s = offset_s;
        table.typical_year = input.read->report.typical_year;
    }
    table.notes.insert(table.notes.end(), input.notes.begin(), input.notes.end());
    if (!options.checkpoint.empty()) write_text_file(options.checkpoint, checkpoint);
    return table;
}

}  // namespace petrichor::cli
