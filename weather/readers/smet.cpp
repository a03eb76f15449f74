// SMET: key = value lines after [HEADER], a table after [DATA]. Sums are of the interval before
// their time.
#include <cmath>

#include "base/error.h"
#include "weather/physics/constants.h"
#include "weather/readers/formats.h"
#include "weather/readers/table_rows.h"
#include "weather/readers/text.h"

namespace petrichor::weather {

namespace {

struct Column {
    const char* name;
    Field field;
    bool sum;
};
// The format is SI: kelvin, relative humidity 0..1, Pa, m/s, W/m2, metres; PSUM in kg/m2.
constexpr Column kColumns[] = {
    {"ta", Field::AirTemp, false},     {"rh", Field::RelHumidity, false},
    {"vw", Field::Wind, false},        {"dw", Field::WindFrom, false},
    {"iswr", Field::Shortwave, false}, {"ilwr", Field::Longwave, false},
    {"p", Field::Pressure, false},     {"psum", Field::Precip, true},
    {"hnw", Field::Precip, true},      {"hs", Field::SnowDepth, false},
    {"td", Field::DewPoint, false},    {"psum_s", Field::Snow, true},
    {"psum_l", Field::Rain, true},     {"tss", Field::SurfaceTemp, false},
    {"rswr", Field::Reflected, false}, {"swe", Field::SnowWater, false},
};

// Parameters of MeteoIO that no model here uses: ground and snow temperatures, gusts, set values.
bool is_known_unused(std::string_view name)
{
    for (const char* start : {"tsg", "vw_max", "vw_drift", "tsoil", "ts", "julian", "tau_cld",
                              "theor", "iswr_dir", "iswr_diff", "ndir", "psum_ph", "hw", "rho"}) {
        if (name.rfind(start, 0) == 0) return true;
    }
    return false;
}

}  // namespace

static void read_smet(std::string_view text, RowCollector& rows, const ReadOptions& options)
{
    Lines lines(text);
    double nodata = -999.0, zone_h = 0.0;
    std::vector<const Column*> meaning;
    std::vector<double> scale, offset;
    std::size_t time_at = 0, julian_at = 0;
    bool data = false, has_time = false;
    const auto numbers = [](std::string_view v) {
        std::vector<double> out;
        for (const auto w : words(v)) out.push_back(to_number(w).value_or(kMissing));
        return out;
    };
    while (const auto line = lines.next()) {
        const auto t = trimmed(*line);
        if (lower(t) == "[data]") {
            data = true;
            break;
        }
        const auto equals = t.find('=');
        if (equals == std::string_view::npos || t.front() == '#') continue;
        const std::string key = lower(trimmed(t.substr(0, equals)));
        const auto value = trimmed(t.substr(equals + 1));
        if (key == "latitude")
            rows.site().latitude_deg = to_number(value).value_or(kMissing);
        else if (key == "longitude")
            rows.site().longitude_deg = to_number(value).value_or(kMissing);
        else if (key == "altitude")
            rows.site().elevation_m = to_number(value).value_or(kMissing);
        else if (key == "station_name")
            rows.site().name = std::string(value);
        else if (key == "nodata")
            nodata = to_number(value).value_or(-999.0);
        else if (key == "tz")
            zone_h = to_number(value).value_or(0.0);
        else if (key == "units_multiplier")
            scale = numbers(value);
        else if (key == "units_offset")
            offset = numbers(value);
        else if (key == "fields") {
            const auto names = words(value, 256);
            meaning.assign(names.size(), nullptr);
            has_time = false;  // of two such lines the last counts
            julian_at = 0;
            for (std::size_t i = 0; i < names.size(); ++i) {
                const std::string name = lower(names[i]);
                if (name == "timestamp") {
                    time_at = i;
                    has_time = true;
                }
                if (name == "julian") julian_at = i + 1;
                for (const Column& c : kColumns) {
                    if (name == c.name) meaning[i] = &c;
                }
                if (!meaning[i] && name != "timestamp" && !is_known_unused(name))
                    rows.unknown_column(names[i], options.ignore);
            }
        }
    }
    rows.check_columns();
    if (!data || !has_time) {
        throw Error(
            std::string("weather: SMET: ") + (!data       ? "there is no [DATA]"
                                              : julian_at ? "times as julian days are not supported"
                                                          : "fields has no timestamp"),
            "Give an ASCII SMET file with a timestamp column and a [DATA] part.");
    }
    if (!(std::abs(zone_h) <= 14.0)) zone_h = 0.0;
    rows.site().utc_offset_h = zone_h;
    std::int64_t last = 0;
    bool have_last = false;
    std::vector<std::string_view> f;
    const auto date_of = [&](std::string_view line) -> std::optional<RowDate> {
        words(line, f, 256);
        const auto us = time_at < f.size() ? us_from_iso(f[time_at], zone_h * 3600.0) : std::nullopt;
        if (!us) return std::nullopt;
        const CivilTime t = civil_from_us(*us);
        return RowDate{t.year, t.month, t.day, t.hour, t.minute};
    };
    for (const TimedRow& row : oldest_first(lines, date_of, rows)) {
        if (trimmed(row.text).front() == '#') continue;
        words(row.text, f, 256);
        if (f.size() != meaning.size()) {
            rows.bad_row(row.line, "",
                         "has " + std::to_string(f.size()) + " columns, fields names " +
                             std::to_string(meaning.size()));
            continue;
        }
        const auto us = us_from_iso(f[time_at], zone_h * 3600.0);
        if (!us) {
            rows.bad_row(row.line, "time", "'" + shown(f[time_at]) + "' is not a time");
            continue;
        }
        if (!rows.begin_row(*us, row.line)) continue;
        const double hours = have_last ? static_cast<double>(*us - last) / 3600e6 : 1.0;
        have_last = true;
        last = *us;
        for (std::size_t i = 0; i < f.size(); ++i) {
            if (!meaning[i]) continue;
            const auto value = to_number(f[i]);
            if (!value) {
                rows.unreadable(meaning[i]->field, f[i]);
                continue;
            }
            if (*value == nodata) {
                rows.missing(meaning[i]->field);
                continue;
            }
            double si = *value;
            if (i < scale.size() && !std::isnan(scale[i])) si *= scale[i];
            if (i < offset.size() && !std::isnan(offset[i])) si += offset[i];
            if (meaning[i]->field == Field::RelHumidity) si *= 100.0;
            if (meaning[i]->sum)
                rows.fell_before(meaning[i]->field, si, hours);
            else
                rows.set(meaning[i]->field, si);
        }
    }
}

namespace {

bool recognise(const FileHead& head)
{
    return head.begins("SMET");
}

}  // namespace

extern const Reader smet_reader;
const Reader smet_reader{"SMET", "WSL, MeteoIO", recognise, read_smet};

}  // namespace petrichor::weather
