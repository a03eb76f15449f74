#include "film/jobs/weather_source.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/words.h"
#include "film/data/folders.h"
#include "film/scenario/weather_script.h"
#include "film/toml/toml_value.h"
#include "film/weather/artist_ice.h"
#include "film/weather/inputs.h"
#include "film/weather/times.h"
#include "film/weather/weather_input.h"
#include "weather/readers/text.h"

namespace petrichor::film {
namespace {

namespace fs = std::filesystem;

constexpr double kHour_us = 3600e6;
// Ground and stores forget their start in about this long where no snow lies (scene-weather 1).
constexpr double kEnoughSpinUp_days = 14.0;

WeatherSource from_script(WeatherScript script, std::string name, double end_s)
{
    WeatherSource source;
    source.name = std::move(name);
    source.duration_s = script.duration_s;
    script = looped_script(std::move(script), end_s);
    const auto weather = std::make_shared<const weather::ArtistTimeline>(script.solve());
    const auto shared = std::make_shared<const WeatherScript>(std::move(script));
    source.script = shared;
    const auto ice = std::make_shared<const ArtistIceTimeline>(*weather);
    source.at = [shared, weather, ice](double time_s) {
        weather::Moment moment =
            weather::artist_moment(*weather, shared->timeline, shared->sky, time_s);
        moment.values = with_ice(moment.values, ice->at(time_s));
        if (!shared->sun_elevation_deg.empty()) {
            const auto degrees = [&](const weather::Channel& channel, double otherwise) {
                return channel.empty() ? otherwise : weather::value_at(channel, time_s * 1e6);
            };
            const double radians = 3.14159265358979323846 / 180.0;
            moment.sun = weather::SunAngles{degrees(shared->sun_elevation_deg, 0.0) * radians,
                                            degrees(shared->sun_azimuth_deg, 140.0) * radians};
        }
        return moment;
    };
    return source;
}

// A place in a weather file and the clock of the film over it.
struct FileClock {
    std::int64_t start_us = 0, end_us = 0;
    double us_per_second = kHour_us;
    double offset_s = 0.0;  // ahead of UTC: the clock of the file's place, in which people name times

    std::int64_t at(double time_s) const
    {
        return start_us + static_cast<std::int64_t>(std::llround(time_s * us_per_second));
    }
    double duration_s() const { return static_cast<double>(end_us - start_us) / us_per_second; }
};

FileClock clock_of(const ScenarioWeather& options, const weather::ForcingTable& table)
{
    const std::int64_t first = table.time_us.front();
    // A file of one row holds for an hour.
    const std::int64_t last = table.time_us.size() > 1 ? table.time_us.back() : first + static_cast<std::int64_t>(kHour_us);
    FileClock clock;
    if (std::isfinite(table.site.utc_offset_h)) clock.offset_s = table.site.utc_offset_h * 3600.0;
    const auto time = [&](const std::string& text, const char* what, std::int64_t otherwise) {
        if (text.empty()) return otherwise;
        return first + static_cast<std::int64_t>(
                           std::llround(parse_time(text, what, first, clock.offset_s) * 1e6));
    };
    clock.start_us = time(options.start, "weather start", first);
    clock.end_us = time(options.end, "weather end", last);
    // A month and day that come before the start are those of the next year only if it is there.
    if (clock.start_us < first || clock.start_us >= last || clock.end_us <= clock.start_us ||
        clock.end_us > last) {
        throw Error("weather: the film goes from " + weather::iso_from_us(clock.start_us, clock.offset_s) + " to " +
                        weather::iso_from_us(clock.end_us, clock.offset_s) + ", the file from " +
                        weather::iso_from_us(first, clock.offset_s) + " to " + weather::iso_from_us(last, clock.offset_s),
                    "Give a start (--from) and a later end (--to) inside the file.");
    }
    clock.us_per_second = kHour_us * options.hours_per_second;
    return clock;
}

std::string short_number(double value)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", value);
    return text;
}

// What the reader had to fill in, a line a field.
void add_read_notes(const weather::ReadReport& report, std::vector<std::string>& notes)
{
    for (const weather::FieldReport& field : report.fields) {
        if (field.filled == 0) continue;
        notes.push_back(field.name + ": " + std::to_string(field.filled) + " of " +
                        std::to_string(report.rows) + " rows filled, " + field.filled_by);
    }
    for (const weather::ReadNote& note : report.notes) {
        if (note.kind == weather::ReadNote::Kind::Warning)
            notes.push_back((note.field.empty() ? "" : note.field + ": ") + note.text);
    }
}

void add_clock_notes(const FileClock& clock, const ScenarioWeather& options,
                     const weather::Site& site, std::vector<std::string>& notes)
{
    notes.push_back("0 s is " + weather::iso_from_us(clock.start_us, clock.offset_s) + ", a second is " +
                    short_number(options.hours_per_second) + " h, until " +
                    weather::iso_from_us(clock.end_us, clock.offset_s));
    if (!std::isfinite(site.latitude_deg) || !std::isfinite(site.longitude_deg)) {
        notes.emplace_back(
            "the file does not say where it was measured, so the sun does not follow it; give "
            "latitude_degrees and longitude_degrees in [weather], or --latitude and --longitude");
    }
}

// Rows from a time on; the row in force then is the first.
weather::ForcingTable rows_from(weather::ForcingTable table, std::int64_t us)
{
    const auto& t = table.time_us;
    const auto upper = std::upper_bound(t.begin(), t.end(), us);
    const auto skip = upper == t.begin() ? std::ptrdiff_t{0} : upper - t.begin() - 1;
    for (auto& column : table.columns) {
        if (!column.empty()) column.erase(column.begin(), column.begin() + skip);
    }
    table.time_us.erase(table.time_us.begin(), table.time_us.begin() + skip);
    return table;
}

void make_physical(WeatherSource& source, weather::ForcingTable table,
                   const ScenarioWeather& options, const FileClock& clock)
{
    weather::PhysicalParams params;
    params.surface = weather::surface_preset(options.site.surface);
    params.sky_view = options.site.sky_view.value_or(params.sky_view);
    params.canopy_vai = options.site.canopy_vai.value_or(params.canopy_vai);
    if (options.spin_up_days) {
        // The ground far below follows the whole file, not the piece that is kept.
        double sum = 0.0;
        for (const double kelvin : table[weather::Field::AirTemp]) sum += kelvin;
        params.deep_temp_k = sum / static_cast<double>(table.rows());
        table = rows_from(std::move(table),
                          clock.start_us - static_cast<std::int64_t>(std::llround(
                                               *options.spin_up_days * 24.0 * kHour_us)));
    }
    const weather::Site site = table.site;
    source.table = std::make_shared<const weather::ForcingTable>(table);
    source.physical = params;
    source.utc_us = [clock](double time_s) { return clock.at(time_s); };
    const weather::PhysicalMoments moments(std::move(table), params);
    const double spun_days =
        static_cast<double>(clock.start_us - moments.begin_us()) / (24.0 * kHour_us);
    std::string note = "physical model on " + params.surface.name + ", spin-up " +
                       short_number(spun_days) + " days of the file before 0 s";
    if (spun_days < kEnoughSpinUp_days)
        note += "; the ground begins dry, bare and as warm as the season, which takes 14 to forget";
    source.notes.push_back(note);
    for (const std::string& guess : moments.guesses()) source.notes.push_back(guess);
    source.at = [moments, clock, site](double time_s) {
        const std::int64_t us = clock.at(time_s);
        weather::Moment moment = moments.at(std::clamp(us, moments.begin_us(), moments.end_us()));
        weather::set_clock(moment, us, site);
        return moment;
    };
}

void make_artist(WeatherSource& source, weather::ForcingTable table, const ScenarioWeather& options,
                 const FileClock& clock, double end_s)
{
    WeatherScript script = script_of_forcing(table, source.name);
    if (options.artist) {
        const double scale = script.params.time_scale;
        script.params = options.artist->params;
        script.params.time_scale *= scale;
        script.initial = options.artist->initial;
    }
    script = faster_script(std::move(script), clock.us_per_second * 1e-6);
    const double offset_s =
        static_cast<double>(clock.start_us - table.time_us.front()) / clock.us_per_second;
    source.notes.emplace_back(
        "artist model: its rates are of the film's clock, an hour of the file a second");
    const WeatherSource on_file = from_script(std::move(script), source.name, end_s + offset_s);
    source.script = on_file.script;
    source.script_offset_s = offset_s;
    const auto inner = on_file.at;
    const auto shared = std::make_shared<const weather::ForcingTable>(std::move(table));
    source.at = [inner, clock, offset_s, shared](double time_s) {
        const std::int64_t us = clock.at(time_s);
        weather::Moment moment = inner(std::max(0.0, time_s + offset_s));
        weather::set_measured(moment.values, *shared, us);
        weather::set_clock(moment, us, shared->site);
        return moment;
    };
}

WeatherSource from_weather_file(const fs::path& file, const ScenarioWeather& options, double end_s)
{
    // A grid is read at the place that is asked for.
    const GridPlace place{options.site.latitude_deg, options.site.longitude_deg};
    weather::ReadResult read = read_forcing(read_inputs({file.string()}, place), options.site);
    const FileClock clock = clock_of(options, read.table);
    WeatherSource source;
    source.name = printable(file.stem().string());
    source.duration_s = clock.duration_s();
    add_clock_notes(clock, options, read.table.site, source.notes);
    if (options.model == WeatherModel::Artist) {
        make_artist(source, std::move(read.table), options, clock, end_s);
    } else {
        if (options.artist) {
            throw Error(
                "weather: [weather.artist] is of the artist model, the file runs under the "
                "physical one",
                "Add model = \"artist\" (--model artist), or leave [weather.artist] out.");
        }
        make_physical(source, std::move(read.table), options, clock);
    }
    add_read_notes(read.report, source.notes);
    return source;
}

bool is_preset(const std::string& name)
{
    const auto presets = preset_names("weather");
    return std::find(presets.begin(), presets.end(), name) != presets.end();
}

// Beside the scenario, or as given.
std::optional<fs::path> existing(const std::string& name, const fs::path& folder)
{
    for (const fs::path& file : {folder / name, fs::path(name)}) {
        std::error_code ignored;
        if (fs::is_regular_file(file, ignored)) return file;
    }
    return std::nullopt;
}

[[noreturn]] void refuse_weather(const std::string& asked)
{
    const auto presets = preset_names("weather");
    throw Error(
        "weather: \"" + asked + "\" is neither a preset nor a file." + did_you_mean(asked, presets),
        presets.empty() ? "Name a .toml file with a [weather] table, or a weather file."
                        : "Presets: " + join_words(presets) + ".");
}

WeatherSource from_preset(const std::string& name, const fs::path& folder, double end_s)
{
    if (is_preset(name)) {
        const fs::path file = data_folder() / "weather" / (name + ".toml");
        return from_script(
            read_weather_script(read_toml_text(file, "weather"), file.filename().string()), name,
            end_s);
    }
    const auto file = existing(name, folder);
    if (!file) refuse_weather(name);
    return from_script(read_weather_script(read_toml_text(*file, "weather"), printable(name)),
                       printable(fs::path(name).stem().string()), end_s);
}

void refuse_physical(const ScenarioWeather& weather)
{
    if (weather.model != WeatherModel::Physical) return;
    throw Error("weather: the physical model needs a weather file, not keys of the artist model",
                "Name one: --weather denver.epw, or [weather] file = \"denver.epw\".");
}

}  // namespace

void name_weather(ScenarioWeather& weather, const std::string& name, const fs::path& folder)
{
    weather.preset.clear();
    weather.file.clear();
    weather.script.reset();
    if (is_preset(name) || fs::path(name).extension() == ".toml") {
        weather.preset = name;
        return;
    }
    const auto file = existing(name, folder);
    if (!file) refuse_weather(name);
    weather.file = fs::absolute(*file).string();
}

WeatherSource weather_source(const ScenarioWeather& weather, const fs::path& folder,
                             const std::string& scenario_name, double end_s)
{
    if (!weather.file.empty()) {
        const auto file = existing(weather.file, folder);
        if (!file) {
            throw Error("weather: cannot read " + weather.file,
                        "Give a weather file that exists, relative to the scenario.");
        }
        return from_weather_file(*file, weather, end_s);
    }
    if (!weather.preset.empty()) {
        // A preset may also be the name of a weather file, as on the command line.
        ScenarioWeather named = weather;
        name_weather(named, weather.preset, folder);
        if (!named.file.empty()) return from_weather_file(named.file, named, end_s);
    }
    refuse_physical(weather);
    if (!weather.preset.empty()) {
        return from_preset(weather.preset, folder, end_s);
    }
    if (weather.script)
        return from_script(*weather.script, fs::path(scenario_name).stem().string(), end_s);
    WeatherSource dry;
    dry.name = "none";
    dry.at = [](double) { return weather::Moment{}; };
    return dry;
}

}  // namespace petrichor::film
