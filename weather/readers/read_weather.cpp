#include "weather/readers/read_weather.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "weather/readers/formats.h"
#include "weather/readers/report_lines.h"
#include "weather/readers/text.h"

namespace petrichor::weather {

namespace {

constexpr const char* kKinds =
    "EPW, TMY3 CSV, PVGIS CSV, NSRDB CSV, Open-Meteo JSON or CSV, METAR/TAF, SMET, ISD-Lite, "
    "GHCN-daily, "
    "SURFRAD, 12-column "
    "FSM text, or CSV with a `time` column and units in its header";

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
        if (part.find('\0') != std::string_view::npos || count_odd(part) * 50 > part.size()) {
            throw Error(
                "weather: this is a binary file, not text (near byte " + std::to_string(at) + ")",
                std::string("Give a text file: ") + kKinds + ".");
        }
        if (text.size() <= kSample) break;
    }
}

bool all_numbers(const std::vector<std::string_view>& fields)
{
    return std::all_of(fields.begin(), fields.end(),
                       [](std::string_view f) { return to_number(f).has_value(); });
}

bool starts_with(std::string_view text, std::string_view prefix)
{
    return text.substr(0, prefix.size()) == prefix;
}

bool is_station_code(std::string_view w)
{
    if (w.size() != 4 || w[0] < 'A' || w[0] > 'Z') return false;
    return std::all_of(w.begin(), w.end(),
                       [](char c) { return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'); });
}
bool is_day_time(std::string_view w)
{
    return w.size() == 7 && w.back() == 'Z' && to_integer(w.substr(0, 6)).has_value();
}

bool looks_like_metar(std::string_view line)
{
    const auto w = words(line, 8);
    for (std::size_t i = 0; i + 1 < w.size(); ++i) {
        if (is_station_code(w[i]) &&
            (is_day_time(w[i + 1]) || w[i + 1] == "NIL=" || w[i + 1] == "NIL"))
            return true;
    }
    return false;
}

}  // namespace

void TypicalYear::watch(long long row_year, int row_month)
{
    if (first_ == 0)
        first_ = row_year;
    else if (row_year != last_ && !(row_year == last_ + 1 && row_month == 1 && last_month_ == 12))
        typical = true;
    last_ = row_year;
    last_month_ = row_month;
}

void TypicalYear::decide(RowCollector& rows)
{
    year = is_leap_year(first_) ? first_ + 1 : first_;
    if (typical) {
        rows.note(ReadNote::Kind::Time, 0, "time",
                  std::string("typical year: months of different years, placed in ")
                      .append(std::to_string(year)));
    }
}

const char* format_name(WeatherFormat format)
{
    switch (format) {
        case WeatherFormat::Fsm:
            return "FSM 12 columns";
        case WeatherFormat::ForcingCsv:
            return "forcing CSV";
        case WeatherFormat::Epw:
            return "EPW";
        case WeatherFormat::Tmy3:
            return "TMY3 CSV";
        case WeatherFormat::Pvgis:
            return "PVGIS CSV";
        case WeatherFormat::OpenMeteoJson:
            return "Open-Meteo JSON";
        case WeatherFormat::OpenMeteoCsv:
            return "Open-Meteo CSV";
        case WeatherFormat::Metar:
            return "METAR";
        case WeatherFormat::Smet:
            return "SMET";
        case WeatherFormat::IsdLite:
            return "ISD-Lite";
        case WeatherFormat::GhcnDaily:
            return "GHCN-daily";
        case WeatherFormat::Surfrad:
            return "SURFRAD";
        case WeatherFormat::Nsrdb:
            return "NSRDB CSV";
    }
    return "unknown";
}

WeatherFormat recognise_weather(std::string_view text)
{
    if (trimmed(text.substr(0, 1 << 16)).empty()) {
        throw Error("weather: the file is empty", std::string("Give a text file: ") + kKinds + ".");
    }
    refuse_binary(text);
    if (starts_with(text, "\xEF\xBB\xBF")) text.remove_prefix(3);
    const auto first = trimmed(text.substr(0, 4096));
    if (starts_with(first, "{") || starts_with(first, "[")) return WeatherFormat::OpenMeteoJson;
    if (starts_with(first, "SMET")) return WeatherFormat::Smet;
    if (starts_with(first, "Source,Location ID,")) return WeatherFormat::Nsrdb;
    if (starts_with(first, "LOCATION,")) return WeatherFormat::Epw;
    if (starts_with(first, "Latitude (decimal degrees)")) return WeatherFormat::Pvgis;

    Lines lines(text.substr(0, 1 << 16));
    std::vector<std::string_view> head;
    while (head.size() < 40) {
        const auto line = lines.next();
        if (!line) break;
        if (!trimmed(*line).empty()) head.push_back(*line);
    }
    if (head.size() >= 2 && starts_with(head[1], "Date (MM/DD/YYYY)")) return WeatherFormat::Tmy3;
    const std::string top = lower(head.front());
    if (starts_with(top, "latitude,longitude,elevation") || starts_with(top, "\"latitude\","))
        return WeatherFormat::OpenMeteoCsv;
    if (std::any_of(head.begin(), head.end(), looks_like_metar) ||
        std::any_of(head.begin(), head.end(), is_ogimet_row) || ReportLines(text).is_table())
        return WeatherFormat::Metar;
    if (head.front().size() >= 21 && head.front().find(',') == std::string_view::npos &&
        to_integer(head.front().substr(11, 4)) && to_integer(head.front().substr(15, 2)) &&
        !to_number(head.front().substr(0, 3))) {
        return WeatherFormat::GhcnDaily;
    }
    {
        const auto f = split(head.front(), ',', 8);
        if (f.size() >= 4 && f[0].size() == 11 && f[1].size() == 8 && to_integer(f[1]) &&
            f[2].size() == 4) {
            return WeatherFormat::GhcnDaily;
        }
        if (top.find("station") != std::string::npos && top.find("tmax") != std::string::npos)
            return WeatherFormat::GhcnDaily;
    }
    if (head.size() >= 3) {
        const auto data = words(head[2], 64);
        const auto place = words(head[1], 8);
        if (data.size() >= 40 && all_numbers(data) && place.size() >= 3 && to_number(place[0]) &&
            !all_numbers(words(head[0], 8))) {
            return WeatherFormat::Surfrad;
        }
    }
    for (const auto line : head) {  // the first rows may be the bad ones
        const auto columns = words(line, 64);
        if (!all_numbers(columns) || columns.size() != 12) continue;
        // Both have twelve numbers a row; ISD-Lite has whole numbers and -9999.
        const bool whole = std::all_of(columns.begin(), columns.end(), [](std::string_view c) {
            return to_integer(c).has_value();
        });
        return whole ? WeatherFormat::IsdLite : WeatherFormat::Fsm;
    }
    for (const auto line : head) {
        const std::string low = lower(line);
        if (starts_with(low, "#")) continue;
        // A table with unnamed times: its header begins with a separator.
        const auto next = std::find(head.begin(), head.end(), line) + 1;
        if (next != head.end() && low.find_first_of(",;\t") == 0 &&
            next->find_first_of("0123456789") == 0) {
            return WeatherFormat::ForcingCsv;
        }
        const bool dated = low.find("time") != std::string::npos ||
                           low.find("date") != std::string::npos || starts_with(low, "year");
        if (dated && low.find_first_of(",;\t") != std::string::npos) {
            return WeatherFormat::ForcingCsv;
        }
        break;
    }
    throw Error(
        "weather: the kind of this file is not known; it begins with '" + shown(head.front()) + "'",
        std::string("Give one of: ") + kKinds + ".");
}

ReadResult read_weather(std::string_view text, const ReadOptions& options)
{
    if (text.size() > options.most_bytes) {
        refuse_binary(text);
        throw Error("weather: the file has " + std::to_string(text.size()) +
                        " bytes, more than the " + std::to_string(options.most_bytes) + " accepted",
                    "Cut the file into shorter periods.");
    }
    const WeatherFormat format = recognise_weather(text);
    if (starts_with(text, "\xEF\xBB\xBF")) text.remove_prefix(3);
    RowCollector rows(format_name(format));
    switch (format) {
        case WeatherFormat::Fsm:
            read_fsm(text, rows, options);
            break;
        case WeatherFormat::ForcingCsv:
            read_forcing_csv(text, rows, options);
            break;
        case WeatherFormat::Epw:
            read_epw(text, rows, options);
            break;
        case WeatherFormat::Tmy3:
            read_tmy3(text, rows, options);
            break;
        case WeatherFormat::Pvgis:
            read_pvgis(text, rows, options);
            break;
        case WeatherFormat::OpenMeteoJson:
            read_open_meteo_json(text, rows, options);
            break;
        case WeatherFormat::OpenMeteoCsv:
            read_open_meteo_csv(text, rows, options);
            break;
        case WeatherFormat::Metar:
            read_metar(text, rows, options);
            break;
        case WeatherFormat::Smet:
            read_smet(text, rows, options);
            break;
        case WeatherFormat::IsdLite:
            read_isd_lite(text, rows, options);
            break;
        case WeatherFormat::GhcnDaily:
            read_ghcn_daily(text, rows, options);
            break;
        case WeatherFormat::Surfrad:
            read_surfrad(text, rows, options);
            break;
        case WeatherFormat::Nsrdb:
            read_nsrdb(text, rows, options);
            break;
    }
    Site& site = rows.site();
    if (!std::isnan(options.site.latitude_deg)) site.latitude_deg = options.site.latitude_deg;
    if (!std::isnan(options.site.longitude_deg)) site.longitude_deg = options.site.longitude_deg;
    if (!std::isnan(options.site.elevation_m)) site.elevation_m = options.site.elevation_m;
    if (options.heights_given) {
        site.temp_height_m = options.site.temp_height_m;
        site.wind_height_m = options.site.wind_height_m;
    }
    const auto drop_odd = [&](double& value, double low, double high, const char* name) {
        if (std::isnan(value) || (value >= low && value <= high)) return;
        rows.note(ReadNote::Kind::OutOfRange, 0, name,
                  std::to_string(value) + " is not possible, ignored");
        value = kMissing;
    };
    drop_odd(site.latitude_deg, -90, 90, "latitude");
    drop_odd(site.longitude_deg, -180, 360, "longitude");
    drop_odd(site.elevation_m, -450, 9000, "elevation");
    ReadResult result;
    result.table = rows.finish();
    result.report = std::move(rows.report());
    if (options.fill) fill_forcing(result.table, result.report, options.filling);
    return result;
}

}  // namespace petrichor::weather
