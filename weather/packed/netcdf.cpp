#include "weather/packed/netcdf.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

#include "weather/packed/detail/netcdf_place.h"

namespace petrichor::weather::packed {

using namespace detail;

namespace {

struct Clock {
    int dimension = -1;
    std::vector<std::int64_t> time_us;
    bool ends_of_intervals = false;
};

double seconds_of_unit(const std::string& word)
{
    if (word.rfind("sec", 0) == 0 || word == "s") return 1.0;
    if (word.rfind("min", 0) == 0) return 60.0;
    if (word.rfind("h", 0) == 0) return 3600.0;
    if (word.rfind("d", 0) == 0) return 86400.0;
    return kNone;
}

// "2005-9-1 0:0:0.0 -7:00" is what some programs write for 2005-09-01T00:00:00-07:00.
std::optional<std::int64_t> reference_time(std::string_view text)
{
    if (const auto us = us_from_iso(text)) return us;
    long long n[6] = {1970, 1, 1, 0, 0, 0};
    std::size_t at = 0, part = 0;
    while (part < 6 && at < text.size()) {
        std::size_t end = at;
        while (end < text.size() && text[end] >= '0' && text[end] <= '9') ++end;
        if (end == at || end - at > 4) return std::nullopt;
        n[part++] = *to_integer(text.substr(at, end - at));
        if (end < text.size() && text[end] == '.') {  // fractions of a second
            ++end;
            while (end < text.size() && text[end] >= '0' && text[end] <= '9') ++end;
        }
        if (part == 3)
            while (end < text.size() && (text[end] == ' ' || text[end] == 'T')) ++end;
        else if (end < text.size() && (text[end] == '-' || text[end] == ':') && part < 6)
            ++end;
        else if (end < text.size()) {
            at = end;
            break;
        }
        at = end;
    }
    if (part < 3) return std::nullopt;
    std::string rest = lower(trimmed(text.substr(std::min(at, text.size()))));
    double offset_h = 0.0;
    if (!rest.empty() && rest != "z" && rest != "utc" && rest != "gmt") {
        const auto colon = rest.find(':');
        const auto hours = to_number(rest.substr(0, colon));
        if (!hours || std::abs(*hours) > 14.0) return std::nullopt;
        offset_h = *hours;
        if (colon != rest.npos) {
            const auto minutes = to_number(rest.substr(colon + 1));
            if (!minutes) return std::nullopt;
            offset_h += (rest.front() == '-' ? -1.0 : 1.0) * *minutes / 60.0;
        }
    }
    const auto us =
        us_from_civil({n[0], static_cast<int>(n[1]), static_cast<int>(n[2]), static_cast<int>(n[3]),
                       static_cast<int>(n[4]), static_cast<double>(n[5])});
    if (!us) return std::nullopt;
    return *us - static_cast<std::int64_t>(offset_h * 3600e6);
}

void read_cf_time(const File& file, int variable, Clock& clock)
{
    const std::string units = file.text(variable, "units");
    const std::string calendar = lower(file.text(variable, "calendar"));
    if (!calendar.empty() && calendar != "standard" && calendar != "gregorian" &&
        calendar != "proleptic_gregorian") {
        throw Error("weather: NetCDF: the calendar '" + shown(calendar) + "' has no real dates",
                    "Convert the times to the standard calendar.");
    }
    const auto since = units.find(" since ");
    const double unit = seconds_of_unit(lower(trimmed(units.substr(0, since))));
    const auto origin = reference_time(trimmed(std::string_view(units).substr(since + 7)));
    if (std::isnan(unit) || !origin) {
        throw Error("weather: NetCDF: the unit of time '" + shown(units) + "' is not known",
                    "Write it as in: hours since 1900-01-01 00:00:00.");
    }
    for (const double t : file.whole(variable)) {
        if (!(std::abs(t) * unit < 1e12))
            throw Error("weather: NetCDF: a time is missing", "Give a file with all its times.");
        // To the nearest millisecond: days as floating point do not hold hours exactly.
        const auto ms = static_cast<std::int64_t>(std::llround(t * unit * 1e3));
        clock.time_us.push_back(*origin + ms * 1000);
    }
}

// WRF: Times(Time, DateStrLen) as "2024-01-16_00:00:00".
void read_wrf_time(const File& file, int variable, Clock& clock)
{
    const auto dims = file.dimensions(variable);
    if (dims.size() != 2 || dims[1].length < 19 || dims[1].length > 64 || dims[0].length > 100000)
        throw Error("weather: NetCDF: Times is not as WRF writes it", "Give a file of WRF.");
    std::string text(dims[0].length * dims[1].length, ' ');
    check(nc_get_var_text(file.id(), variable, text.data()), "Times");
    for (std::size_t i = 0; i < dims[0].length; ++i) {
        std::string one = text.substr(i * dims[1].length, 19);
        one[10] = 'T';
        const auto us = us_from_iso(one);
        if (!us) throw Error("weather: NetCDF: '" + shown(one) + "' is no time", "Repair Times.");
        clock.time_us.push_back(*us);
    }
}

Clock find_clock(const File& file)
{
    Clock clock;
    int found = -1;
    for (const int v : file.variables()) {
        const std::string name = lower(file.name(v));
        const auto dims = file.dimensions(v);
        if (name == "times" && dims.size() == 2 && file.type(v) == NC_CHAR) {
            clock.dimension = dims[0].id;
            read_wrf_time(file, v, clock);
            return clock;
        }
        if (dims.size() > 1 || file.text(v, "units").find(" since ") == std::string::npos) continue;
        // The coordinate itself before others that also count time (forecast reference times).
        const bool better = found < 0 || name == "time" || name == "valid_time" ||
                            (dims.size() == 1 && lower(dims[0].name) == name);
        if (better && !(dims.empty() && found >= 0)) found = v;
    }
    if (found < 0) {
        throw Error("weather: NetCDF: there is no coordinate of time ('hours since ..')",
                    "Give a file of weather over time.");
    }
    const auto dims = file.dimensions(found);
    clock.dimension = dims.empty() ? -1 : dims[0].id;
    read_cf_time(file, found, clock);
    // Bounds say whether means and sums end or begin at their time.
    const std::string bounds = file.text(found, "bounds");
    int id = -1;
    if (!bounds.empty() && nc_inq_varid(file.id(), bounds.c_str(), &id) == NC_NOERR) {
        const auto b = file.whole(id);
        const auto t = file.whole(found);
        if (b.size() == 2 * t.size() && !t.empty() && b[1] == t[0] && b[0] < t[0])
            clock.ends_of_intervals = true;
    }
    return clock;
}

// The values of a variable at a corner: over time, or one. Nothing when a dimension is left that
// is neither time, place, ERA5's expver nor of length one.
std::optional<std::vector<double>> values_at(const File& file, int variable, const Clock& clock,
                                             const Corner& corner)
{
    const auto dims = file.dimensions(variable);
    std::vector<std::size_t> start(dims.size(), 0), count(dims.size(), 1);
    std::size_t versions = 1, version_dim = dims.size(), time_dim = dims.size();
    for (std::size_t d = 0; d < dims.size(); ++d) {
        if (dims[d].id == clock.dimension) {
            count[d] = dims[d].length;
            time_dim = d;
            continue;
        }
        const auto at = std::find_if(corner.at.begin(), corner.at.end(),
                                     [&](const auto& a) { return a.first == dims[d].id; });
        if (at != corner.at.end()) {
            start[d] = at->second;
        } else if (lower(dims[d].name) == "expver" && dims[d].length <= 4) {
            count[d] = versions = dims[d].length;
            version_dim = d;
        } else if (dims[d].length != 1) {
            return std::nullopt;
        }
    }
    if (dims.empty()) return file.whole(variable);
    const auto all = file.box(variable, start, count);
    if (versions == 1) return all;
    const std::size_t times = all.size() / versions;
    const bool version_first = version_dim < time_dim;
    std::vector<double> out(times, kNone);
    for (std::size_t t = 0; t < times; ++t) {
        for (std::size_t v = 0; v < versions && std::isnan(out[t]); ++v)
            out[t] = all[version_first ? v * times + t : t * versions + v];
    }
    return out;
}

}  // namespace

bool is_netcdf(std::span<const std::byte> bytes)
{
    const auto begins = [&](const char* magic, std::size_t n) {
        return bytes.size() >= n && std::memcmp(bytes.data(), magic, n) == 0;
    };
    return begins("CDF\x01", 4) || begins("CDF\x02", 4) || begins("CDF\x05", 4) ||
           begins("\x89HDF\r\n\x1a\n", 8);
}

PointSeries read_netcdf(std::span<const std::byte> bytes, const Point& point)
{
    const File file(bytes);
    const Clock clock = find_clock(file);
    const Place place = find_place(file, clock.dimension, point);
    PointSeries series;
    series.kind = "NetCDF";
    series.ends_of_intervals = clock.ends_of_intervals;
    series.latitude_deg = place.latitude_deg;
    series.longitude_deg =
        place.longitude_deg > 180.0 ? place.longitude_deg - 360.0 : place.longitude_deg;
    series.elevation_m = kNone;
    if (!place.note.empty()) series.notes.push_back(place.note);

    // Times that go back (files put together) are sorted out by the reader of the table.
    std::vector<std::size_t> order(clock.time_us.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return clock.time_us[a] < clock.time_us[b];
    });
    order.erase(std::unique(order.begin(), order.end(),
                            [&](std::size_t a, std::size_t b) {
                                return clock.time_us[a] == clock.time_us[b];
                            }),
                order.end());
    for (const std::size_t i : order) series.time_us.push_back(clock.time_us[i]);

    std::string deep;
    for (const int v : file.variables()) {
        const nc_type type = file.type(v);
        if (type == NC_CHAR || type == NC_STRING || type > NC_UINT64) continue;
        const auto dims = file.dimensions(v);
        const bool timed = std::any_of(dims.begin(), dims.end(),
                                       [&](const Dimension& d) { return d.id == clock.dimension; });
        const std::string name = file.name(v), low = lower(name);
        const bool height = low == "z" || low == "orog" || low == "hgt" || low == "elevation" ||
                            low == "altitude" || low == "elev" ||
                            file.text(v, "standard_name") == "surface_altitude";
        if (!timed && !height && clock.dimension >= 0) continue;
        if (file.text(v, "units").find(" since ") != std::string::npos || low == "xlat" ||
            low == "xlong" || low == "expver" || low == "number" || low.ends_with("_bnds") ||
            low.ends_with("_bounds"))
            continue;
        PointVariable variable{name, file.text(v, "standard_name"), file.text(v, "units"), {}};
        bool read = true;
        std::vector<double> sums;
        for (const Corner& corner : place.corners) {
            const auto values = values_at(file, v, clock, corner);
            if (!values) {
                read = false;
                break;
            }
            if (sums.empty()) sums.assign(values->size(), 0.0);
            for (std::size_t i = 0; i < sums.size() && i < values->size(); ++i)
                sums[i] += corner.weight * (*values)[i];
        }
        if (!read) {
            deep.append(deep.empty() ? "" : ", ").append(shown(name));
            continue;
        }
        if (timed && clock.dimension >= 0 && sums.size() == clock.time_us.size()) {
            for (const std::size_t i : order) variable.values.push_back(sums[i]);
        } else {
            variable.values = std::move(sums);
        }
        series.variables.push_back(std::move(variable));
    }
    if (!deep.empty()) series.notes.push_back("not read, as they have levels: " + deep);
    return series;
}

}  // namespace petrichor::weather::packed
