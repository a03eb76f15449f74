#include "film/weather/weather_input.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <sstream>

#include "base/error.h"
#include "base/words.h"
#include "film/toml/toml_value.h"
#include "weather/models/artist/from_forcing.h"
#include "weather/readers/join.h"
#include "weather/readers/text.h"

namespace petrichor::film {
namespace {

using weather::Field;

weather::ReadOptions read_options(const SiteOptions& options)
{
    weather::ReadOptions read;
    read.site.latitude_deg = options.latitude_deg.value_or(weather::kMissing);
    read.site.longitude_deg = options.longitude_deg.value_or(weather::kMissing);
    read.site.elevation_m = options.elevation_m.value_or(weather::kMissing);
    read.station = options.station;
    read.filling.missing_precip = options.missing_precip == "estimate"
                                      ? weather::MissingPrecip::Estimate
                                      : weather::MissingPrecip::Dry;
    if (options.file_zone_h) {
        if (!(std::abs(*options.file_zone_h) <= 14.0))
            throw Error("simulate: --file-zone must be in -14..14 hours",
                        "Give hours ahead of UTC: -7 for Mountain Standard Time.");
        read.utc_offset_h = *options.file_zone_h;
    }
    if (options.date_order == "dmy") read.date_order = weather::DateOrder::DayFirst;
    if (options.date_order == "mdy") read.date_order = weather::DateOrder::MonthFirst;
    for (std::size_t at = 0; at < options.ignore.size();) {
        const std::size_t end = std::min(options.ignore.find(',', at), options.ignore.size());
        const auto name = weather::trimmed(std::string_view(options.ignore).substr(at, end - at));
        if (!name.empty()) read.ignore.emplace_back(name);
        at = end + 1;
    }
    read.taf = options.taf == "prevailing" ? weather::TafUse::Prevailing
               : options.taf == "worst"    ? weather::TafUse::Worst
                                           : weather::TafUse::Expected;
    if (options.month.empty()) return read;
    const auto day = weather::us_from_iso(options.month + "-01");
    if (!day)
        throw Error("simulate: --month must be like 2024-02, got '" + options.month + "'",
                    "Give year and month.");
    const auto civil = weather::civil_from_us(*day);
    read.year = static_cast<int>(civil.year);
    read.month = civil.month;
    return read;
}

// Degrees that may pass 360, so that from 350 to 10 is a turn of 20 and not of 340.
weather::Channel unwound(weather::Channel degrees)
{
    for (std::size_t i = 1; i < degrees.values.size(); ++i) {
        double& now = degrees.values[i];
        now += 360.0 * std::round((degrees.values[i - 1] - now) / 360.0);
    }
    return degrees;
}

void check_gaps(const weather::ForcingTable& table, const std::string& file, double max_days)
{
    constexpr double kDayUs = 86400e6;
    for (std::size_t i = 1; i < table.time_us.size(); ++i) {
        const double days = static_cast<double>(table.time_us[i] - table.time_us[i - 1]) / kDayUs;
        if (days <= max_days) continue;
        throw Error("weather " + file + ": nothing is known between " +
                        weather::iso_from_us(table.time_us[i - 1]) + " and " +
                        weather::iso_from_us(table.time_us[i]) + ", " +
                        number_text(std::round(days * 10.0) / 10.0) + " days; at most " +
                        number_text(max_days) + " are bridged",
                    "Correct the date, add a file for the time between, or say --max-gap " +
                        number_text(std::ceil(days)) + " (days).");
    }
}

}  // namespace

SiteOptions with_site_table(SiteOptions options, const std::string& toml_text)
{
    if (toml_text.empty()) return options;
    const toml::table root = parse_toml(toml_text, "--params");
    for (const auto& [key, node] : root) {
        const std::string name(key.str());
        if (name == "artist") continue;
        const TomlValue value(node, "--params", name);
        if (name != "site") refuse_name(value.place(), "table", name, {"site", "artist"});
        const auto put = [](std::optional<double>& option, double number) {
            option = option.value_or(number);
        };
        for (const auto& [k, v] :
             value.entries({"latitude", "longitude", "elevation_m", "temp_height_m",
                            "wind_height_m", "sky_view", "canopy_vai", "surface"})) {
            if (k == "latitude")
                put(options.latitude_deg, v.number(-90.0, 90.0));
            else if (k == "longitude")
                put(options.longitude_deg, v.number(-180.0, 360.0));
            else if (k == "elevation_m")
                put(options.elevation_m, v.number(-450.0, 9000.0));
            else if (k == "temp_height_m")
                put(options.temp_height_m, v.number(0.3, 200.0));
            else if (k == "wind_height_m")
                put(options.wind_height_m, v.number(0.6, 500.0));
            else if (k == "sky_view")
                put(options.sky_view, v.number(0.0, 1.0));
            else if (k == "canopy_vai")
                put(options.canopy_vai, v.number(0.0, 20.0));
            else
                options.surface = v.text();
        }
    }
    return options;
}

weather::ReadResult read_forcing(const std::vector<Input>& files, const SiteOptions& options)
{
    std::vector<weather::NamedText> texts;
    for (const Input& file : files) texts.push_back({file.file, file.text});
    weather::ReadResult read = weather::read_weather_files(texts, read_options(options));
    check_gaps(read.table, files.front().file, options.max_gap_days);
    weather::Site& site = read.table.site;
    site.temp_height_m = options.temp_height_m.value_or(site.temp_height_m);
    site.wind_height_m = options.wind_height_m.value_or(site.wind_height_m);
    if (!(site.temp_height_m >= 0.3 && site.temp_height_m <= 200.0) ||
        !(site.wind_height_m >= 0.6 && site.wind_height_m <= 500.0)) {
        throw Error(
            "simulate: sensor heights must be 0.3..200 m (temperature) and 0.6..500 m (wind)",
            "Set --temp-height-m and --wind-height-m.");
    }
    const bool no_sun = weather::field_report(read.report, "sw_down").present == 0;
    if (no_sun && (std::isnan(site.latitude_deg) || std::isnan(site.longitude_deg))) {
        throw Error("simulate: " + files.front().file + " (" + read.report.format +
                        ") has no sunshine and does not say where it is",
                    "Give --latitude and --longitude of the station, degrees north and east.");
    }
    return read;
}

WeatherScript script_of_forcing(const weather::ForcingTable& table, const std::string& name)
{
    WeatherScript script;
    script.name = name;
    script.timeline = weather::artist_keys(table);
    script.duration_s = static_cast<double>(table.time_us.back() - table.time_us.front()) * 1e-6;
    script.params.time_scale = weather::kFileTimeScale;
    script.sky.cloud_cover = weather::channel_of_field(table, Field::Cloud);
    script.sky.wind_m_s = weather::channel_of_field(table, Field::Wind);
    const auto complete = [&](Field field) {
        for (const double v : table[field]) {
            if (std::isnan(v)) return false;
        }
        return table.has(field);
    };
    if (complete(Field::WindFrom))
        script.sky.wind_from_deg = unwound(weather::channel_of_field(table, Field::WindFrom));
    if (complete(Field::Visibility))
        script.sky.visibility_m = weather::channel_of_field(table, Field::Visibility);
    return script;
}

WeatherScript faster_script(WeatherScript script, double factor)
{
    const auto quicken = [&](weather::Channel& channel) {
        for (weather::TimeUs& time : channel.times)
            time = static_cast<weather::TimeUs>(std::llround(static_cast<double>(time) / factor));
    };
    for (weather::Channel* channel :
         {&script.timeline.temperature_c, &script.timeline.rainfall, &script.sky.cloud_cover,
          &script.sky.wind_m_s, &script.sky.wind_from_deg, &script.sky.visibility_m}) {
        quicken(*channel);
    }
    for (auto& [name, channel] : script.timeline.parameters) quicken(channel);
    for (auto& [name, channel] : script.timeline.states) quicken(channel);
    script.duration_s /= factor;
    script.params.time_scale *= factor;
    return script;
}

WeatherScript looped_script(WeatherScript script, double end_s)
{
    const weather::TimeUs period = weather::to_time_us(script.duration_s);
    if (!script.loop || period <= 0 || end_s <= script.duration_s) return script;
    const auto loops = static_cast<std::int64_t>(std::ceil(end_s / script.duration_s));
    constexpr std::int64_t kMostKeys = 1000000;
    const auto repeat = [&](weather::Channel& channel) {
        weather::Channel once;
        once.interpolation = channel.interpolation;
        for (std::size_t i = 0; i < channel.times.size(); ++i) {
            if (channel.times[i] > period) break;
            once.times.push_back(channel.times[i]);
            once.values.push_back(channel.values[i]);
        }
        if (once.empty()) return;
        // Both ends have a key, so that nothing is drawn from one loop into the next.
        const double first = weather::value_at(channel, 0.0);
        const double last = weather::value_at(channel, static_cast<double>(period));
        if (once.times.front() != 0) {
            once.times.insert(once.times.begin(), 0);
            once.values.insert(once.values.begin(), first);
        }
        if (once.times.back() != period) {
            once.times.push_back(period);
            once.values.push_back(last);
        }
        if (loops * static_cast<std::int64_t>(once.times.size()) > kMostKeys) {
            throw Error("weather: a loop of " + std::to_string(script.duration_s) +
                            " s is repeated " + std::to_string(loops) +
                            " times, more than a million keys",
                        "Make weather.duration_s longer, or the film shorter.");
        }
        weather::Channel all;
        all.interpolation = once.interpolation;
        for (std::int64_t loop = 0; loop < loops; ++loop) {
            for (std::size_t i = 0; i < once.times.size(); ++i) {
                // A microsecond after the end of the loop before.
                const weather::TimeUs after = loop > 0 && i == 0 ? 1 : 0;
                all.times.push_back(loop * period + once.times[i] + after);
                all.values.push_back(once.values[i]);
            }
        }
        channel = std::move(all);
    };
    for (weather::Channel* channel :
         {&script.timeline.temperature_c, &script.timeline.rainfall, &script.sky.cloud_cover,
          &script.sky.wind_m_s, &script.sky.wind_from_deg, &script.sky.visibility_m}) {
        repeat(*channel);
    }
    for (auto& [name, channel] : script.timeline.parameters) repeat(channel);
    for (auto& [name, channel] : script.timeline.states) repeat(channel);
    return script;
}

std::vector<std::string> lines_of(const std::string& text)
{
    std::vector<std::string> out;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) out.push_back(line);
    return out;
}

}  // namespace petrichor::film
