// NOAA ISD-Lite: year month day hour, T and dew point (0.1 C), pressure at sea level (0.1 hPa),
// wind direction, wind (0.1 m/s), sky code, precipitation of 1 h and 6 h (0.1 mm). -9999 is
// missing, -1 is a trace. UTC.
#include <algorithm>
#include <cmath>

#include "weather/physics/constants.h"
#include "weather/readers/formats.h"
#include "weather/readers/table_rows.h"
#include "weather/readers/text.h"

namespace petrichor::weather {

namespace {

// Sky condition codes (field 10 of the format's document) to a fraction: oktas, 9 a hidden sky,
// then scattered, broken and overcast, each thin, plain and dark. 10, a partly hidden sky, does not
// say how much.
double cloud_of_code(long long code)
{
    if (code >= 0 && code <= 8) return static_cast<double>(code) / 8.0;
    if (code == 9) return 1.0;
    if (code >= 11 && code <= 13) return 0.44;
    if (code >= 14 && code <= 16) return 0.75;
    if (code >= 17 && code <= 19) return 1.0;
    return kMissing;
}

}  // namespace

static void read_isd_lite(std::string_view text, RowCollector& rows, const ReadOptions& options)
{
    const double z = std::isnan(options.site.elevation_m) ? 0.0 : options.site.elevation_m;
    rows.note(ReadNote::Kind::Info, 0, "pressure",
              "given for sea level, brought to " + std::to_string(static_cast<int>(z)) +
                  " m; the file has no place, give latitude, longitude and elevation");
    std::size_t traces = 0;
    Lines lines(text);
    std::vector<std::string_view> w;
    const auto date_of = [](std::string_view line) -> std::optional<RowDate> {
        const auto parts = words(line, 4);
        RowDate date{};
        for (std::size_t i = 0; i < 4; ++i) {
            const auto n = i < parts.size() ? to_integer(parts[i]) : std::nullopt;
            if (!n) return std::nullopt;
            date[i] = *n;
        }
        return date;
    };
    for (const TimedRow& row : oldest_first(lines, date_of, rows)) {
        words(row.text, w, 32);
        if (w.size() != 12) {
            rows.bad_row(row.line, "",
                         "has " + std::to_string(w.size()) + " columns, 12 are needed");
            continue;
        }
        long long v[12] = {};
        bool good = true;
        for (std::size_t i = 0; i < 12; ++i) {
            const auto n = to_integer(w[i]);
            good = good && n;
            v[i] = n.value_or(0);
        }
        good =
            good && v[1] >= 1 && v[1] <= 12 && v[2] >= 1 && v[2] <= 31 && v[3] >= 0 && v[3] <= 23;
        const auto us = good ? us_from_civil({v[0], static_cast<int>(v[1]), static_cast<int>(v[2]),
                                              static_cast<int>(v[3]), 0, 0.0})
                             : std::nullopt;
        if (!us) {
            rows.bad_row(
                row.line, "time",
                "'" + shown(row.text) + "' is not twelve whole numbers that begin with a date");
            continue;
        }
        if (!rows.begin_row(*us, row.line)) continue;
        const auto put = [&](Field field, long long value, double scale, double offset) {
            if (value == -9999)
                rows.missing(field);
            else
                rows.set(field, static_cast<double>(value) * scale + offset);
        };
        put(Field::AirTemp, v[4], 0.1, kZeroCelsiusK);
        put(Field::DewPoint, v[5], 0.1, kZeroCelsiusK);
        put(Field::WindFrom, v[7], 1.0, 0.0);
        put(Field::Wind, v[8], 0.1, 0.0);
        if (v[6] == -9999)
            rows.missing(Field::Pressure);
        else {
            const double t =
                v[4] == -9999 ? 288.15 : static_cast<double>(v[4]) * 0.1 + kZeroCelsiusK;
            rows.set(Field::Pressure,
                     static_cast<double>(v[6]) * 10.0 *
                         std::exp(-kGravity_m_s2 * z /
                                  (kAirGasConstant * (t + 0.5 * kLapseRate_k_m * z))));
        }
        const double cloud = cloud_of_code(v[9]);
        if (std::isnan(cloud))
            rows.missing(Field::Cloud);
        else
            rows.set(Field::Cloud, cloud);
        if (v[10] == -9999 && v[11] == -9999) rows.missing(Field::Precip);
        for (const auto& [amount, hours] : {std::pair{v[10], 1.0}, {v[11], 6.0}}) {
            if (amount == -9999) continue;
            traces += amount == -1;
            rows.fell_before(Field::Precip, amount == -1 ? 0.0 : static_cast<double>(amount) * 0.1,
                             hours);
        }
    }
    if (traces)
        rows.note(ReadNote::Kind::Info, 0, "precip",
                  std::to_string(traces) + " traces (-1), taken as 0");
}

namespace {

// The first row of twelve numbers has whole ones.
bool recognise(const FileHead& head)
{
    for (const auto line : head.lines) {
        const auto columns = words(line, 64);
        if (columns.size() != 12 || !all_numbers(columns)) continue;
        return std::all_of(columns.begin(), columns.end(),
                           [](std::string_view c) { return to_integer(c).has_value(); });
    }
    return false;
}

}  // namespace

extern const Reader isd_lite_reader;
const Reader isd_lite_reader{"ISD-Lite", "NOAA, hourly", recognise, read_isd_lite};

}  // namespace petrichor::weather
