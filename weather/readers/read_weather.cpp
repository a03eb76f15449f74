#include "weather/readers/read_weather.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/error.h"
#include "weather/physics/constants.h"
#include "weather/physics/solar.h"
#include "weather/readers/air_scale.h"
#include "weather/readers/formats.h"
#include "weather/readers/number_text.h"
#include "weather/readers/refused_kinds.h"
#include "weather/readers/text.h"
#include "weather/text/utf16.h"

namespace petrichor::weather {

namespace {

std::string known_kinds()
{
    std::string names;
    for (const Reader* reader : weather_readers())
        names.append(names.empty() ? "" : ", ").append(reader->name);
    return names;
}

std::string_view without_mark(std::string_view text)
{
    return text.substr(0, 3) == "\xEF\xBB\xBF" ? text.substr(3) : text;
}

// Readers take the first line for what theirs says: empty ones before it are taken away, so many.
std::string_view without_empty_lines(std::string_view text, std::size_t& lines)
{
    lines = 0;
    std::size_t at = 0;
    for (std::size_t i = 0; i < text.size() && is_blank(text[i]); ++i) {
        const bool pair = text[i] == '\r' && i + 1 < text.size() && text[i + 1] == '\n';
        if (pair || (text[i] != '\n' && text[i] != '\r')) continue;
        ++lines;
        at = i + 1;
    }
    return text.substr(at);
}

// Looks at a few samples only, so that a gigabyte of zeros is refused at once.
void refuse_binary(std::string_view text)
{
    const auto count_odd = [](std::string_view part) {
        // Few control characters of any kind is the usual answer, and quickly counted.
        const auto low = static_cast<std::size_t>(std::count_if(
            part.begin(), part.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }));
        if (low * 50 <= part.size()) return std::size_t{0};
        return static_cast<std::size_t>(std::count_if(part.begin(), part.end(), [](char c) {
            return static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\r' && c != '\t' &&
                   c != '\f' && c != 3 && c != 1;
        }));
    };
    constexpr std::size_t kSample = 1 << 16;
    for (std::size_t i = 0; i < 16; ++i) {
        const std::size_t at = text.size() / 16 * i;
        const auto part = text.substr(at, kSample);
        const std::size_t zero = part.find('\0');
        if (zero != std::string_view::npos || count_odd(part) * 50 > part.size()) {
            throw Error(
                "weather: this is a binary file, not text (" +
                    std::string(zero != std::string_view::npos ? "a 0 in byte " : "near byte ") +
                    std::to_string(at + (zero != std::string_view::npos ? zero : 0)) + ")",
                "Give a text file: " + known_kinds() + ".");
        }
        if (text.size() <= kSample) break;
    }
}

// Whether the sun of the file rises when it should at its place: times without a zone may be local, or
// in another than the one that was given.
void check_sun(const ForcingTable& table, bool zoned, double given_h, ReadReport& report)
{
    const Site& site = table.site;
    if (!table.has(Field::Shortwave) || std::isnan(site.latitude_deg) ||
        std::isnan(site.longitude_deg) || table.rows() < 48)
        return;
    // The sun of at most 1500 rows, and how far it agrees when the clock is turned by whole hours.
    const std::size_t stride = std::max<std::size_t>(1, table.rows() / 1500) | 1u;
    double best = -1.0, here = 0.0;
    int turn = 0;
    for (int h = -12; h <= 12; ++h) {
        double product = 0.0, sun2 = 0.0, file2 = 0.0;
        for (std::size_t i = 0; i < table.rows(); i += stride) {
            const double measured = table[Field::Shortwave][i];
            if (std::isnan(measured)) continue;
            const double sun = std::max(0.0, sun_direction(table.time_us[i] + h * 3600000000LL,
                                                           site.latitude_deg, site.longitude_deg)
                                                 .up);
            product += sun * measured;
            sun2 += sun * sun;
            file2 += measured * measured;
        }
        const double agreement = product / std::sqrt(sun2 * file2 + 1e-30);
        if (h == 0) here = agreement;
        if (agreement > best) {
            best = agreement;
            turn = h;
        }
    }
    if (std::abs(turn) < 2 || best < 0.7 || best < here + 0.1) return;
    double zone_h = (std::isnan(given_h) ? 0.0 : given_h) - turn;
    zone_h -= zone_h > 14.0 ? 24.0 : zone_h < -14.0 ? -24.0 : 0.0;
    report.add({ReadNote::Kind::Warning, 0, "time",
                "the sun of the file stands " + std::to_string(std::abs(turn)) + " h " +
                    (turn > 0 ? "ahead of" : "behind") + " that of its place: " +
                    (zoned ? "the zone that its times say, or its place, is wrong"
                           : "if its times are local, give --file-zone " + number_text(zone_h))});
}

// Longwave beside what a black body as warm as the air sends: 0.6 under the driest sky, 0.9 to 1
// where something falls, whatever the climate.
void check_longwave(const ForcingTable& table, ReadReport& report)
{
    constexpr std::size_t kFew = 48, kFewFalling = 20;
    constexpr double kLeast = 0.55, kLeastFalling = 0.8, kMost = 1.2, kFalls_kg_m2_s = 0.1 / 3600.0;
    if (!table.has(Field::Longwave) || !table.has(Field::AirTemp)) return;
    std::vector<double> all, falling;
    for (std::size_t i = 0; i < table.rows(); ++i) {
        const double air_k = table[Field::AirTemp][i];
        const double share =
            table[Field::Longwave][i] / (kStefanBoltzmann * air_k * air_k * air_k * air_k);
        if (std::isnan(share)) continue;
        all.push_back(share);
        for (const Field f : {Field::Precip, Field::Rain, Field::Snow}) {
            if (!table.has(f) || !(table[f][i] >= kFalls_kg_m2_s)) continue;
            falling.push_back(share);
            break;
        }
    }
    const auto odd = [&](std::vector<double>& shares, std::size_t few, double least,
                         const char* when) {
        if (shares.size() < few) return false;
        const auto middle = shares.begin() + static_cast<std::ptrdiff_t>(shares.size() / 2);
        std::nth_element(shares.begin(), middle, shares.end());
        if (*middle >= least && *middle <= kMost) return false;
        char said[200];
        std::snprintf(said, sizeof said,
                      "it is %.2f of what a black body as warm as the air sends%s: it, or the air "
                      "temperature, has another unit than its name says",
                      *middle, when);
        report.add({ReadNote::Kind::Warning, 0, field_info(Field::Longwave).name, said});
        return true;
    };
    if (!odd(falling, kFewFalling, kLeastFalling, " while rain or snow falls"))
        odd(all, kFew, kLeast, "");
}

// Whether values, written with one digit behind the point or none, are multiples of a step: many of them,
// of several sizes.
bool in_steps_of(const std::vector<double>& values, double step)
{
    constexpr std::size_t kFew = 48, kSizes = 6;
    if (values.size() < kFew) return false;
    const auto written = [&](double digit) {
        return std::all_of(values.begin(), values.end(), [&](double v) {
            return std::abs(v / digit - std::round(v / digit)) < 1e-6;
        });
    };
    const double digit = written(1.0) ? 1.0 : 0.1;
    if (!written(digit)) return false;
    std::vector<double> sizes;
    for (const double v : values) {
        const double near = std::round(std::round(v / step) * step / digit) * digit;
        if (std::abs(v - near) > 1e-6) return false;
        sizes.push_back(std::round(v / step));
    }
    std::sort(sizes.begin(), sizes.end());
    return std::unique(sizes.begin(), sizes.end()) - sizes.begin() >=
           static_cast<std::ptrdiff_t>(kSizes);
}

// km/h under a name that says m/s: too much wind for nearly all places, or steps of whole m/s or knots in
// km/h, which no m/s has.
void check_wind(const ForcingTable& table, ReadReport& report)
{
    constexpr double kMost_m_s = 12.0, kFew_h = 120.0;
    if (!table.has(Field::Wind)) return;
    double sum = 0.0, hours = 0.0;
    std::vector<double> winds;
    for (std::size_t i = 0; i < table.rows(); ++i) {
        const double wind = table[Field::Wind][i];
        if (std::isnan(wind)) continue;
        if (wind > 0.05) winds.push_back(wind);
        if (i + 1 == table.rows()) break;
        const double h = static_cast<double>(table.time_us[i + 1] - table.time_us[i]) / 3600e6;
        if (h > 24.0) continue;
        sum += wind * h;
        hours += h;
    }
    char said[240] = "";
    if (hours >= kFew_h && sum / hours > kMost_m_s)
        std::snprintf(said, sizeof said,
                      "%.1f m/s in the mean of %.0f h, as hardly anywhere: if it is km/h, it is %.1f "
                      "m/s, and its name must say so",
                      sum / hours, hours, sum / hours / 3.6);
    for (const auto& [step, what] : {std::pair{3.6, "whole m/s"}, {1.852, "whole knots"}}) {
        if (said[0] == '\0' && in_steps_of(winds, step))
            std::snprintf(said, sizeof said,
                          "all values are multiples of %g, as %s are in km/h: if it is km/h, its name "
                          "must say so",
                          step, what);
    }
    if (said[0] != '\0')
        report.add({ReadNote::Kind::Warning, 0, field_info(Field::Wind).name, said});
}

// Where a file has dew points and humidities too, they tell in which scale its temperatures are. Below
// 0 C humidity may be that over ice, and says nothing.
void refuse_other_scale(const ForcingTable& table, const std::string& format)
{
    constexpr std::size_t kLooked = 1500;
    if (!table.has(Field::AirTemp) || !table.has(Field::DewPoint) || !table.has(Field::RelHumidity))
        return;
    AirScale scale;
    const std::size_t stride = table.rows() / kLooked + 1;
    for (std::size_t i = 0; i < table.rows(); i += stride) {
        const double air_c = table[Field::AirTemp][i] - kZeroCelsiusK;
        if (air_c > 0.0)
            scale.add(air_c, table[Field::DewPoint][i] - kZeroCelsiusK,
                      table[Field::RelHumidity][i]);
    }
    if (scale.scale() != AirScale::Scale::Fahrenheit) return;
    throw Error("weather: " + format +
                    ": temperature, dew point and humidity fit Fahrenheit, not the unit that is "
                    "named or taken",
                "Name the columns air_temp_f and dew_point_f, or correct their unit.");
}

// Light of whole days beside that of a clear sky, whatever the clock of the file is.
void check_light(const ForcingTable& table, ReadReport& report)
{
    constexpr std::size_t kFewDays = 5;
    constexpr double kFewLight_w_m2 = 30.0, kNever = 0.01, kLeast = 0.1, kMost = 1.6;
    constexpr std::int64_t kDay_us = 86400LL * 1000000;
    const Site& site = table.site;
    if (!table.has(Field::Shortwave) || std::isnan(site.latitude_deg) ||
        std::isnan(site.longitude_deg))
        return;
    const Observer observer(site.latitude_deg, site.longitude_deg);
    std::vector<double> share;  // of days
    double light = 0.0, clear = 0.0;
    std::int64_t day = 0, known_us = 0;
    for (std::size_t i = 0; i + 1 < table.rows(); ++i) {
        const std::int64_t us = table.time_us[i], width = table.time_us[i + 1] - us;
        if (i == 0 || us / kDay_us != day) {
            if (known_us > kDay_us * 9 / 10 &&
                clear > kFewLight_w_m2 * static_cast<double>(known_us))
                share.push_back(light / clear);
            day = us / kDay_us;
            light = clear = 0.0;
            known_us = 0;
        }
        const double sw = table[Field::Shortwave][i];
        if (std::isnan(sw) || width > kDay_us / 8) continue;
        light += sw * static_cast<double>(width);
        clear += clear_sky_w_m2(SunNear(us, observer).at(us).up) * static_cast<double>(width);
        known_us += width;
    }
    if (share.empty()) return;
    const bool few = share.size() < kFewDays;
    std::sort(share.begin(), share.end());
    const double most = share.back(), middle = share[share.size() / 2];
    // A week of thick cloud is as dark as a tenth; a month is not, nor is every other day brighter
    // than a clear one. No cloud is as dark as a hundredth all day.
    const bool dark = most < (few ? kNever : kLeast), bright = !few && middle > kMost;
    if (!dark && !bright) return;
    char said[200];
    std::snprintf(said, sizeof said,
                  "%s day has more than %.2g of the light of a clear sky: its unit is another than "
                  "its name says",
                  dark ? "no" : "every other", dark ? most : middle);
    report.add({ReadNote::Kind::Warning, 0, field_info(Field::Shortwave).name, said});
}

// Files that stand beside weather, and pages of servers that had none.
void refuse_what_belongs_elsewhere(const FileHead& head)
{
    const std::string low = lower(head.text.substr(0, 4096));
    const auto has = [&](const char* word) { return low.find(word) != std::string::npos; };
    if (has("<html"))
        throw Error(
            "weather: this is a web page, no weather: " + shown(trimmed(head.lines.front())),
            "Look at it in a browser: the address may need a key, or no longer exist.");
    if (has("<station>"))
        throw Error("weather: this is a METRo station, no weather",
                    "Give METRo's forecast, and the station with --road.");
    if (has("<roadcast>"))
        throw Error("weather: this is a result of METRo, no weather",
                    "Give METRo's forecast, and the station with --road.");
    // Day, albedo, runoff, depth, water, temperatures of surface and ground.
    constexpr std::size_t kObservedColumns = 9;
    const auto w = words(head.lines.front(), 64);
    if (w.size() != kObservedColumns || !all_numbers(w)) return;
    const auto year = to_integer(w[0]), month = to_integer(w[1]), day = to_integer(w[2]);
    if (year && month && day &&
        us_from_civil({*year, static_cast<int>(*month), static_cast<int>(*day), 0, 0, 0.0}))
        throw Error("weather: nine columns that begin with a date are FSM's observations",
                    "Give the weather, and this file with --observed.");
}

}  // namespace

namespace {

// Readers of commas; another separator between the same cells is a spreadsheet's.
bool wants_commas(const Reader& reader)
{
    for (const char* name : {"NSRDB CSV", "EPW", "PVGIS CSV", "MIDC", "TMY3 CSV", "Open-Meteo CSV",
                             "NOAA global hourly", "LCD", "Environment Canada", "Meteostat", "IEM",
                             "Visual Crossing CSV", "OpenWeather CSV", "NASA POWER CSV", "FLUXNET",
                             "WeatherLink CSV", "GSOD"})
        if (reader.name == std::string_view(name)) return true;
    return false;
}

// The line with commas between its cells, points in its numbers (unless groups such as +0012,1 are
// no numbers), and quotes around other cells with commas.
void add_with_commas(std::string_view line, char separator, bool points, std::string& out)
{
    bool quoted = false;
    std::size_t begin = 0;
    for (std::size_t i = 0; i <= line.size(); ++i) {
        if (i < line.size()) quoted ^= line[i] == '"';
        if (i < line.size() && (line[i] != separator || quoted)) continue;
        const std::string_view cell = line.substr(begin, i - begin);
        if (begin > 0) out += ',';
        begin = i + 1;
        if (cell.find(',') == std::string_view::npos || cell.front() == '"') {
            out += cell;
            continue;
        }
        std::string point(cell);
        std::replace(point.begin(), point.end(), ',', '.');
        const bool number =
            points && std::count(cell.begin(), cell.end(), ',') == 1 && to_number(point);
        out += number ? point : "\"" + std::string(cell) + "\"";
    }
}

// Of a table that a spreadsheet has saved with semicolons or tabs: as it was before. Empty where it
// is none.
std::string with_commas(std::string_view text)
{
    const FileHead head(without_mark(text));
    // Its names may stand below lines of the place.
    char separator = ';';
    std::ptrdiff_t many = 0, commas = 0;
    for (const std::string_view line : head.lines) {
        for (const char c : {';', '\t'}) {
            const auto n = std::count(line.begin(), line.end(), c);
            if (n <= many) continue;
            many = n;
            separator = c;
            commas = std::count(line.begin(), line.end(), ',');
        }
    }
    if (many < 3 || many < commas) return {};
    // What is somebody's own kind with this separator (DWD) stays so.
    for (const Reader* reader : weather_readers())
        if (reader->recognise(head) && !wants_commas(*reader) &&
            reader->name != std::string_view("forcing CSV"))
            return {};
    const auto converted = [&](std::string_view part, bool points) {
        std::string out;
        Lines lines(part);
        while (const auto line = lines.next()) {
            add_with_commas(*line, separator, points, out);
            out += '\n';
        }
        return out;
    };
    const std::string beginning = converted(head.text, true);
    const FileHead as_commas(beginning);
    for (const Reader* reader : weather_readers()) {
        if (!reader->recognise(as_commas)) continue;
        if (!wants_commas(*reader)) break;
        return converted(without_mark(text),
                         reader->name != std::string_view("NOAA global hourly"));
    }
    return {};
}

}  // namespace

const Reader& recognise_weather(std::string_view text)
{
    if (is_utf16(text)) return recognise_weather(utf8_of_utf16(text));
    if (trimmed(without_mark(text).substr(0, 1 << 16)).empty()) {
        throw Error("weather: the file is empty", "Give a text file: " + known_kinds() + ".");
    }
    refuse_binary(text);
    const std::string commas = with_commas(text.substr(0, 1 << 16));
    const FileHead head(commas.empty() ? without_mark(text) : std::string_view(commas));
    refuse_known_kinds(head);
    for (const Reader* reader : weather_readers()) {
        if (reader->recognise(head)) return *reader;
    }
    refuse_what_belongs_elsewhere(head);
    throw Error(
        "weather: the kind of this file is not known; it begins with '" +
            shown(head.lines.front()) + "'",
        "Give one of: " + known_kinds() + "; or CSV with a `time` column and units in its header.");
}

ReadResult read_weather(std::string_view text, const ReadOptions& options)
{
    if (text.size() > options.most_bytes) {
        refuse_binary(text);
        throw Error("weather: the file has " + std::to_string(text.size()) +
                        " bytes, more than the " + std::to_string(options.most_bytes) + " accepted",
                    "Cut the file into shorter periods.");
    }
    if (is_utf16(text)) {
        ReadResult result = read_weather(utf8_of_utf16(text), options);
        result.report.add({ReadNote::Kind::Info, 0, "text", "UTF-16, read as such"});
        return result;
    }
    refuse_binary(text);
    const std::string commas = with_commas(text);
    if (!commas.empty()) text = commas;
    const Reader& reader = recognise_weather(text);
    RowCollector rows(reader.name);
    if (!commas.empty())
        rows.note(ReadNote::Kind::Info, 0, "text",
                  "cells apart as a spreadsheet saves them, read as with commas");
    std::size_t empty_lines = 0;
    const std::string_view filled = without_empty_lines(without_mark(text), empty_lines);
    if (empty_lines > 0)
        rows.note(ReadNote::Kind::Info, 0, "lines",
                  "counted without the " + std::to_string(empty_lines) +
                      " empty ones at the beginning of the file");
    reader.read(filled, rows, options);
    Site& site = rows.site();
    if (!std::isnan(options.site.latitude_deg)) site.latitude_deg = options.site.latitude_deg;
    if (!std::isnan(options.site.longitude_deg)) site.longitude_deg = options.site.longitude_deg;
    if (!std::isnan(options.site.elevation_m)) site.elevation_m = options.site.elevation_m;
    if (options.heights_given) {
        site.temp_height_m = options.site.temp_height_m;
        site.wind_height_m = options.site.wind_height_m;
    }
    const auto check = [&](double value, double given, double low, double high, const char* name,
                           const char* option) {
        if (std::isnan(value) || (value >= low && value <= high)) return;
        char said[160];
        if (!std::isnan(given)) {
            std::snprintf(said, sizeof said, "weather: the %s that was given, %g, is outside %g..%g",
                          name, value, low, high);
            throw Error(said, std::string("Mend ") + option + ".");
        }
        std::snprintf(said, sizeof said, "weather: %s: %s %g is outside %g..%g", reader.name, name,
                      value, low, high);
        throw Error(said, std::string("Mend the file, or give the place with ") + option + ".");
    };
    check(site.latitude_deg, options.site.latitude_deg, -90, 90, "latitude", "--latitude");
    check(site.longitude_deg, options.site.longitude_deg, -180, 360, "longitude", "--longitude");
    check(site.elevation_m, options.site.elevation_m, -450, 9000, "elevation", "--elevation-m");
    ReadResult result;
    result.table = rows.finish();
    result.report = std::move(rows.report());
    Site& placed = result.table.site;
    const bool zoned = rows.zone_named() || !std::isnan(placed.utc_offset_h);
    if (!std::isnan(options.utc_offset_h) && zoned) {
        result.report.add({ReadNote::Kind::Warning, 0, "time",
                           "--file-zone is not used: the file says in which zone its times are"});
    } else if (!std::isnan(options.utc_offset_h)) {
        placed.utc_offset_h = options.utc_offset_h;
        for (std::int64_t& us : result.table.time_us)
            us -= static_cast<std::int64_t>(options.utc_offset_h * 3600e6);
    }
    refuse_other_scale(result.table, result.report.format);
    check_sun(result.table, zoned, options.utc_offset_h, result.report);
    check_wind(result.table, result.report);
    check_light(result.table, result.report);
    check_longwave(result.table, result.report);
    if (options.fill) fill_forcing(result.table, result.report, options.filling);
    return result;
}

}  // namespace petrichor::weather
