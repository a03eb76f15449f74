#include "weather/packed/grib.h"

#include <eccodes.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>

#include "base/error.h"
#include "weather/readers/text.h"

namespace petrichor::weather::packed {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

struct Close {
    void operator()(codes_handle* h) const { codes_handle_delete(h); }
};
using Handle = std::unique_ptr<codes_handle, Close>;

// Numbers that the sections hold, no names: names are looked up in files.
std::optional<long> whole(codes_handle* h, const char* key)
{
    long value = 0;
    if (codes_get_long(h, key, &value) != CODES_SUCCESS) return std::nullopt;
    return value;
}
double real(codes_handle* h, const char* key)
{
    double value = 0.0;
    return codes_get_double(h, key, &value) == CODES_SUCCESS ? value : kNone;
}

// What a parameter is called in point_series.cpp. Edition 1: ECMWF's table 128 (and 228), or WMO's
// table 2; edition 2: discipline, category, number (WMO code table 4.2).
struct Known1 {
    long number;
    const char* name;
    const char* units;
};
constexpr Known1 kEcmwf[] = {
    {167, "t2m", "K"}, {168, "d2m", "K"},      {165, "u10", "m s-1"},  {166, "v10", "m s-1"},
    {134, "sp", "Pa"}, {169, "ssrd", "J m-2"}, {175, "strd", "J m-2"}, {176, "ssr", "J m-2"},
    {164, "tcc", "1"}, {228, "tp", "m"},       {144, "sf", "m"},       {141, "sd", "m"},
    {235, "skt", "K"}, {129, "z", "m2 s-2"},
};
constexpr Known1 kWmo[] = {
    {11, "t2m", "K"},        {17, "d2m", "K"},        {33, "u10", "m s-1"},
    {34, "v10", "m s-1"},    {1, "sp", "Pa"},         {52, "r2", "%"},
    {51, "q2", "kg kg-1"},   {61, "tp", "kg m-2"},    {59, "prate", "kg m-2 s-1"},
    {204, "dswrf", "W m-2"}, {205, "dlwrf", "W m-2"}, {71, "tcc", "%"},
    {66, "sde", "m"},        {65, "snw", "kg m-2"},   {20, "vis", "m"},
    {7, "hgt", "m"},
};
struct Known2 {
    long discipline, category, number;
    const char* name;
    const char* units;
    long level;  // of its height above ground, m; 0: at the surface or anywhere
};
constexpr Known2 kEdition2[] = {
    {0, 0, 0, "t2m", "K", 2},
    {0, 0, 6, "d2m", "K", 2},
    {0, 0, 17, "skt", "K", 0},
    {0, 1, 1, "r2", "%", 2},
    {0, 1, 0, "q2", "kg kg-1", 2},
    {0, 2, 2, "u10", "m s-1", 10},
    {0, 2, 3, "v10", "m s-1", 10},
    {0, 2, 1, "wind", "m s-1", 10},
    {0, 3, 0, "sp", "Pa", 0},
    {0, 4, 7, "dswrf", "W m-2", 0},
    {0, 4, 192, "dswrf", "W m-2", 0},
    {0, 5, 3, "dlwrf", "W m-2", 0},
    {0, 5, 192, "dlwrf", "W m-2", 0},
    {0, 6, 1, "tcc", "%", 0},
    {0, 1, 8, "tp", "kg m-2", 0},
    {0, 1, 52, "prate", "kg m-2 s-1", 0},
    {0, 1, 7, "prate", "kg m-2 s-1", 0},
    {0, 1, 11, "sde", "m", 0},
    {0, 1, 13, "snw", "kg m-2", 0},
    {0, 1, 60, "snw", "kg m-2", 0},
    {0, 19, 0, "vis", "m", 0},
    {0, 3, 5, "hgt", "m", 0},
    {0, 1, 193, "tp", "m", 0},
};

struct Parameter {
    std::string name, units;
    bool known = false;
};

Parameter parameter_of(codes_handle* h)
{
    const long edition = whole(h, "edition").value_or(0);
    if (edition == 1) {
        const long table = whole(h, "table2Version").value_or(0),
                   number = whole(h, "indicatorOfParameter").value_or(-1);
        const bool ecmwf = table >= 128;
        for (const Known1& k :
             ecmwf ? std::span<const Known1>(kEcmwf) : std::span<const Known1>(kWmo)) {
            if (k.number == number && table != 228) return {k.name, k.units, true};
        }
        return {"parameter " + std::to_string(number) + " of table " + std::to_string(table), "",
                false};
    }
    const long discipline = whole(h, "discipline").value_or(-1),
               category = whole(h, "parameterCategory").value_or(-1),
               number = whole(h, "parameterNumber").value_or(-1),
               surface = whole(h, "typeOfFirstFixedSurface").value_or(-1),
               height = whole(h, "scaledValueOfFirstFixedSurface").value_or(0);
    for (const Known2& k : kEdition2) {
        if (k.discipline != discipline || k.category != category || k.number != number) continue;
        const bool ground =
            surface == 1 || surface == 103 || surface == 10 || surface == 200 || surface == 8;
        if (ground && (k.level == 0 ? surface != 103 : surface == 103 && height == k.level))
            return {k.name, k.units, true};
    }
    return {"parameter " + std::to_string(discipline) + "." + std::to_string(category) + "." +
                std::to_string(number) + " at surface " + std::to_string(surface),
            "", false};
}

// Date, time and the end of its step, in seconds.
std::optional<std::int64_t> valid_time_us(codes_handle* h)
{
    const long date = whole(h, "dataDate").value_or(0), time = whole(h, "dataTime").value_or(-1);
    if (date < 10000101 || time < 0) return std::nullopt;
    const auto us = us_from_civil({date / 10000, static_cast<int>(date / 100 % 100),
                                   static_cast<int>(date % 100), static_cast<int>(time / 100),
                                   static_cast<int>(time % 100), 0.0});
    if (!us) return std::nullopt;
    const long edition = whole(h, "edition").value_or(0);
    double hours = 0.0;
    const auto hours_of_unit = [](long unit) {
        return unit == 0    ? 1.0 / 60
               : unit == 1  ? 1.0
               : unit == 2  ? 24.0
               : unit == 10 ? 3.0
               : unit == 11 ? 6.0
               : unit == 12 ? 12.0
               : unit == 13 ? 1.0 / 3600
                            : 1.0;
    };
    if (edition == 1) {
        const long range = whole(h, "timeRangeIndicator").value_or(0),
                   p1 = whole(h, "P1").value_or(0), p2 = whole(h, "P2").value_or(0);
        const double unit = hours_of_unit(whole(h, "unitOfTimeRange").value_or(1));
        hours = unit * static_cast<double>(range == 10                ? p1 * 256 + p2
                                           : range >= 2 && range <= 5 ? p2
                                                                      : p1);
    } else {
        hours = hours_of_unit(whole(h, "indicatorOfUnitOfTimeRange").value_or(1)) *
                static_cast<double>(whole(h, "forecastTime").value_or(0));
        if (const auto length = whole(h, "lengthOfTimeRange"))
            hours += hours_of_unit(whole(h, "indicatorOfUnitForTimeRange").value_or(1)) *
                     static_cast<double>(*length);
    }
    return *us + static_cast<std::int64_t>(hours * 3600e6);
}

// Some points of the grid and what each counts; the same for all messages of one grid.
struct Weights {
    std::vector<std::pair<int, double>> at;
    double latitude_deg = kNone, longitude_deg = kNone;
    std::string note;
};

std::string number_text(double value)
{
    char text[40];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

Weights weights_of(codes_handle* h, const Point& point)
{
    std::size_t n = 0, m = 0;
    if (codes_get_size(h, "latitudes", &n) != CODES_SUCCESS ||
        codes_get_size(h, "longitudes", &m) != CODES_SUCCESS || n != m || n == 0 || n > 20000000) {
        throw Error("weather: GRIB: the grid of the file is not known",
                    "Give a file on a latitude-longitude, Gaussian or Lambert grid.");
    }
    std::vector<double> lat(n), lon(n);
    if (codes_get_double_array(h, "latitudes", lat.data(), &n) != CODES_SUCCESS ||
        codes_get_double_array(h, "longitudes", lon.data(), &m) != CODES_SUCCESS)
        throw Error("weather: GRIB: the grid of the file cannot be read", "Give another file.");
    if (std::isnan(point.latitude_deg) || std::isnan(point.longitude_deg)) {
        if (n == 1) return {{{0, 1.0}}, lat[0], lon[0], ""};
        const auto [south, north] = std::minmax_element(lat.begin(), lat.end());
        const auto [west, east] = std::minmax_element(lon.begin(), lon.end());
        throw Error("weather: GRIB: the file is a grid from " + number_text(*south) + " to " +
                        number_text(*north) + " N and " + number_text(*west) + " to " +
                        number_text(*east) + " E",
                    "Give --latitude and --longitude of a place inside it.");
    }
    const auto east_of = [&](std::size_t i) {
        return std::remainder(lon[i] - point.longitude_deg, 360.0);
    };
    const double shrink = std::cos(point.latitude_deg * 3.14159265358979 / 180.0);
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < n; ++i) {
        const double d = std::hypot(lat[i] - point.latitude_deg, shrink * east_of(i));
        if (d < least) {
            least = d;
            best = i;
        }
    }
    if (least > 2.0) {
        throw Error("weather: GRIB: " + number_text(point.latitude_deg) + " N " +
                        number_text(point.longitude_deg) + " E is outside the grid of the file",
                    "Give --latitude and --longitude of a place inside it.");
    }
    // Four neighbours with the place between them, on axes.
    if (point.bilinear && least > 1e-9) {
        double up = kNone, down = kNone, left = kNone, right = kNone;
        const double tiny = 1e-6;
        for (std::size_t i = 0; i < n; ++i) {
            const double dy = lat[i] - point.latitude_deg, dx = east_of(i);
            if (std::abs(dy) < 3.0 && std::abs(dx) < 3.0) {
                if (dy >= -tiny && !(dy >= up)) up = dy;
                if (dy <= tiny && !(dy <= down)) down = dy;
                if (dx >= -tiny && !(dx >= right)) right = dx;
                if (dx <= tiny && !(dx <= left)) left = dx;
            }
        }
        Weights w{{}, point.latitude_deg, point.longitude_deg, ""};
        double sum = 0.0;
        for (std::size_t i = 0; i < n && up == up && down == down && left == left && right == right;
             ++i) {
            const double dy = lat[i] - point.latitude_deg, dx = east_of(i);
            const bool row = std::abs(dy - up) < tiny || std::abs(dy - down) < tiny;
            const bool column = std::abs(dx - left) < tiny || std::abs(dx - right) < tiny;
            if (!row || !column) continue;
            const double wy = up - down < tiny ? 1.0 : 1.0 - std::abs(dy) / (up - down);
            const double wx = right - left < tiny ? 1.0 : 1.0 - std::abs(dx) / (right - left);
            if (wy * wx <= 0.0) continue;
            w.at.emplace_back(static_cast<int>(i), wy * wx);
            sum += wy * wx;
        }
        if (std::abs(sum - 1.0) < 1e-3 && w.at.size() <= 4) {
            w.note = "bilinear between " + std::to_string(w.at.size()) + " points of the grid";
            return w;
        }
    }
    return {{{static_cast<int>(best), 1.0}},
            lat[best],
            std::remainder(lon[best], 360.0),
            "nearest point of the grid: " + number_text(lat[best]) + " N " +
                number_text(std::remainder(lon[best], 360.0)) + " E"};
}

// A short word for the grid of a message: messages of one grid share their weights.
std::string grid_of(codes_handle* h)
{
    std::string out;
    for (const char* key : {"numberOfDataPoints", "Ni", "Nj", "jScansPositively"})
        out += std::to_string(whole(h, key).value_or(-1)) + " ";
    for (const char* key :
         {"latitudeOfFirstGridPointInDegrees", "longitudeOfFirstGridPointInDegrees"})
        out += number_text(real(h, key)) + " ";
    return out;
}

// Length of the message that begins at `at`, 0 when there is none.
std::size_t message_length(std::span<const std::byte> bytes, std::size_t at)
{
    if (bytes.size() - at < 16) return 0;
    const auto byte = [&](std::size_t i) { return std::to_integer<std::uint64_t>(bytes[at + i]); };
    std::uint64_t length = 0;
    if (byte(7) == 1) length = byte(4) << 16 | byte(5) << 8 | byte(6);
    if (byte(7) == 2)
        for (std::size_t i = 8; i < 16; ++i) length = length << 8 | byte(i);
    return length >= 16 && length <= bytes.size() - at ? static_cast<std::size_t>(length) : 0;
}

// Everything that read_grib asks of a message.
void touch(codes_handle* h, bool whole_grid)
{
    parameter_of(h);
    valid_time_us(h);
    grid_of(h);
    codes_set_double(h, "missingValue", 9.96921e36);
    if (!whole_grid) return;  // the library does not bear grids that do not fit their values
    std::size_t n = 0;
    codes_get_size(h, "latitudes", &n);
    std::vector<double> values(std::min<std::size_t>(n, 100000) + 1);
    std::size_t m = values.size();
    codes_get_double_array(h, "latitudes", values.data(), &m);
    m = values.size();
    codes_get_double_array(h, "values", values.data(), &m);
}

}  // namespace

bool is_grib(std::span<const std::byte> bytes)
{
    return bytes.size() > 8 && std::memcmp(bytes.data(), "GRIB", 4) == 0;
}

void load_grib_tables()
{
    codes_context_set_logging_proc(nullptr, [](const grib_context*, int, const char*) {});
    for (const char* sample :
         {"GRIB1", "GRIB2", "regular_ll_sfc_grib1", "regular_ll_sfc_grib2", "regular_gg_sfc_grib1",
          "regular_gg_sfc_grib2", "reduced_gg_sfc_grib1", "reduced_gg_sfc_grib2"}) {
        const Handle h(codes_grib_handle_new_from_samples(nullptr, sample));
        if (h) touch(h.get(), true);
    }
    // Other grids, packings and statistics of edition 2, as HRRR and new ERA5 have them.
    const auto with = [](const char* key, long value) {
        const Handle h(codes_grib_handle_new_from_samples(nullptr, "GRIB2"));
        if (!h) return;
        codes_set_long(h.get(), key, value);
        touch(h.get(), false);
    };
    for (const long product : {0, 1, 8, 11}) with("productDefinitionTemplateNumber", product);
    for (const long grid : {0, 1, 20, 30, 40}) with("gridDefinitionTemplateNumber", grid);
    for (const long packing : {0, 2, 3, 40, 41, 42})
        with("dataRepresentationTemplateNumber", packing);
    for (const long centre : {7, 98}) with("centre", centre);
}

PointSeries read_grib(std::span<const std::byte> bytes, const Point& point)
{
    PointSeries series;
    series.kind = "GRIB";
    series.latitude_deg = series.longitude_deg = series.elevation_m = kNone;
    struct Series {
        std::string units;
        std::map<std::int64_t, double> values;
    };
    std::map<std::string, Series> found;
    std::map<std::string, Weights> grids;
    std::set<std::string> unread;
    std::vector<double> values;
    std::size_t at = 0, messages = 0;
    while (at + 16 <= bytes.size()) {
        if (std::memcmp(bytes.data() + at, "GRIB", 4) != 0) {
            ++at;
            continue;
        }
        const std::size_t length = message_length(bytes, at);
        if (length == 0) {
            throw Error("weather: GRIB: message " + std::to_string(messages + 1) +
                            " is cut short or damaged",
                        "Download the file again.");
        }
        const Handle h(codes_handle_new_from_message(nullptr, bytes.data() + at, length));
        at += length;
        ++messages;
        if (!h) throw Error("weather: GRIB: a message cannot be read", "Give another file.");
        const Parameter parameter = parameter_of(h.get());
        if (!parameter.known) {
            if (unread.size() < 30) unread.insert(parameter.name);
            continue;
        }
        const auto us = valid_time_us(h.get());
        if (!us) throw Error("weather: GRIB: a message has no date", "Give another file.");
        const std::string grid = grid_of(h.get());
        auto weights = grids.find(grid);
        if (weights == grids.end()) {
            if (grids.size() > 16) throw Error("weather: GRIB: too many grids", "Split the file.");
            weights = grids.emplace(grid, weights_of(h.get(), point)).first;
        }
        codes_set_double(h.get(), "missingValue", 9.96921e36);
        std::size_t n = 0;
        if (codes_get_size(h.get(), "values", &n) != CODES_SUCCESS || n > 20000000)
            throw Error("weather: GRIB: a message has no values", "Give another file.");
        values.resize(n);
        if (const int status = codes_get_double_array(h.get(), "values", values.data(), &n)) {
            throw Error(std::string("weather: GRIB: the values of ") + parameter.name +
                            " cannot be unpacked: " + codes_get_error_message(status),
                        "Convert the file to simple packing (grib_set -r -w packingType=..).");
        }
        double sum = 0.0;
        for (const auto& [i, weight] : weights->second.at) {
            const auto k = static_cast<std::size_t>(i);
            sum += k < n && values[k] < 9e36 ? weight * values[k] : kNone;
        }
        Series& s = found[parameter.name];
        s.units = parameter.units;
        s.values.emplace(*us, sum);
    }
    if (found.empty()) {
        std::string names;
        for (const std::string& name : unread) names += (names.empty() ? "" : ", ") + name;
        throw Error("weather: GRIB: no field of the weather at the ground in " +
                        std::to_string(messages) + " messages" +
                        (names.empty() ? "" : "; it has " + names),
                    "Give a file with 2 m temperature.");
    }
    std::set<std::int64_t> times;
    for (const auto& [name, s] : found) {
        if (name == "z" || name == "hgt") continue;
        for (const auto& [us, value] : s.values) times.insert(us);
    }
    series.time_us.assign(times.begin(), times.end());
    for (const auto& [name, s] : found) {
        PointVariable v{name, "", s.units, {}};
        if (name == "z" || name == "hgt") {
            v.values.push_back(s.values.begin()->second);
        } else {
            for (const std::int64_t us : series.time_us) {
                const auto value = s.values.find(us);
                v.values.push_back(value == s.values.end() ? kNone : value->second);
            }
        }
        series.variables.push_back(std::move(v));
    }
    const Weights& first = grids.begin()->second;
    series.latitude_deg = first.latitude_deg;
    series.longitude_deg = first.longitude_deg;
    if (!first.note.empty()) series.notes.push_back(first.note);
    for (const std::string& name : unread) {
        series.notes.push_back("not read: " + name);
        if (series.notes.size() > 12) break;
    }
    return series;
}

}  // namespace petrichor::weather::packed
