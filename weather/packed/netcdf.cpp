#include "weather/packed/netcdf.h"

#include <netcdf.h>
#include <netcdf_mem.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

#include "base/error.h"
#include "weather/readers/text.h"

namespace petrichor::weather::packed {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kMostValues = 64u << 20;  // of one variable at once

void check(int status, const char* what)
{
    if (status != NC_NOERR) {
        throw Error(std::string("weather: NetCDF: ") + what + ": " + nc_strerror(status),
                    "Give a whole, undamaged file.");
    }
}

struct Dimension {
    int id = -1;
    std::string name;
    std::size_t length = 0;
};

// One open file; closes itself.
class File {
public:
    explicit File(std::span<const std::byte> bytes)
    {
        // The library does not write to memory opened for reading.
        auto* memory = const_cast<void*>(static_cast<const void*>(bytes.data()));
        check(nc_open_mem("input", NC_NOWRITE, bytes.size(), memory, &id_), "cannot be opened");
    }
    ~File() { nc_close(id_); }
    File(const File&) = delete;
    File& operator=(const File&) = delete;

    int id() const { return id_; }
    std::vector<int> variables() const
    {
        int count = 0;
        check(nc_inq_nvars(id_, &count), "variables");
        std::vector<int> ids(static_cast<std::size_t>(std::clamp(count, 0, 4096)));
        for (std::size_t i = 0; i < ids.size(); ++i) ids[i] = static_cast<int>(i);
        return ids;
    }
    std::string name(int variable) const
    {
        char text[NC_MAX_NAME + 1] = {};
        check(nc_inq_varname(id_, variable, text), "name");
        return text;
    }
    std::vector<Dimension> dimensions(int variable) const
    {
        int count = 0;
        check(nc_inq_varndims(id_, variable, &count), "dimensions");
        if (count < 0 || count > 16)
            throw Error("weather: NetCDF: too many dimensions", "Reduce it.");
        std::vector<int> ids(static_cast<std::size_t>(count));
        if (count) check(nc_inq_vardimid(id_, variable, ids.data()), "dimensions");
        std::vector<Dimension> out;
        for (const int id : ids) {
            char text[NC_MAX_NAME + 1] = {};
            Dimension d{id, {}, 0};
            check(nc_inq_dim(id_, id, text, &d.length), "dimension");
            d.name = text;
            out.push_back(std::move(d));
        }
        return out;
    }
    std::string text(int variable, const char* attribute) const
    {
        nc_type type = NC_NAT;
        std::size_t length = 0;
        if (nc_inq_att(id_, variable, attribute, &type, &length) != NC_NOERR || length > 4096)
            return {};
        if (type == NC_CHAR) {
            std::string out(length, '\0');
            if (length && nc_get_att_text(id_, variable, attribute, out.data()) != NC_NOERR)
                return {};
            while (!out.empty() && out.back() == '\0') out.pop_back();
            return out;
        }
        if (type == NC_STRING && length == 1) {
            char* string = nullptr;
            if (nc_get_att_string(id_, variable, attribute, &string) != NC_NOERR) return {};
            std::string out = string ? string : "";
            nc_free_string(1, &string);
            return out;
        }
        return {};
    }
    double number(int variable, const char* attribute, double otherwise) const
    {
        nc_type type = NC_NAT;
        std::size_t length = 0;
        double value = otherwise;
        if (nc_inq_att(id_, variable, attribute, &type, &length) != NC_NOERR || length != 1 ||
            type == NC_CHAR || type == NC_STRING)
            return otherwise;
        return nc_get_att_double(id_, variable, attribute, &value) == NC_NOERR ? value : otherwise;
    }
    nc_type type(int variable) const
    {
        nc_type type = NC_NAT;
        check(nc_inq_vartype(id_, variable, &type), "type");
        return type;
    }
    // A box of a variable, unpacked; NaN where the file has no value.
    std::vector<double> box(int variable, const std::vector<std::size_t>& start,
                            const std::vector<std::size_t>& count) const
    {
        std::size_t total = 1;
        for (const std::size_t c : count) {
            if (c == 0 || total > kMostValues / c)
                throw Error("weather: NetCDF: '" + shown(name(variable)) + "' is too large",
                            "Cut the file into shorter periods.");
            total *= c;
        }
        std::vector<double> values(total);
        check(nc_get_vara_double(id_, variable, start.data(), count.data(), values.data()),
              name(variable).c_str());
        const double fill = number(variable, "_FillValue", kNone),
                     missing = number(variable, "missing_value", kNone),
                     scale = number(variable, "scale_factor", 1.0),
                     offset = number(variable, "add_offset", 0.0);
        for (double& v : values) {
            const bool none = v == fill || v == missing || !(std::abs(v) < 1e30);
            v = none ? kNone : v * scale + offset;
        }
        return values;
    }
    std::vector<double> whole(int variable) const
    {
        std::vector<std::size_t> start, count;
        for (const Dimension& d : dimensions(variable)) {
            start.push_back(0);
            count.push_back(d.length);
        }
        if (start.empty()) {  // a scalar
            const std::size_t zero = 0;
            double value = 0.0;
            check(nc_get_var1_double(id_, variable, &zero, &value), "scalar");
            return {value};
        }
        return box(variable, start, count);
    }

private:
    int id_ = -1;
};

// ---- time ----

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

// ---- place ----

struct Coordinate {
    int variable = -1;
    std::vector<Dimension> dimensions;
    std::vector<double> values;
};

Coordinate find_coordinate(const File& file, const char* standard, const char* unit,
                           std::initializer_list<const char*> names, int time_dimension)
{
    int by_unit = -1, by_name = -1;
    for (const int v : file.variables()) {
        if (file.type(v) == NC_CHAR || file.type(v) == NC_STRING) continue;
        const std::string name = lower(file.name(v));
        if (lower(file.text(v, "standard_name")) == standard ||
            lower(file.text(v, "units")).rfind(unit, 0) == 0) {
            if (by_unit < 0) by_unit = v;
        }
        for (const char* n : names) {
            if (name == n && by_name < 0) by_name = v;
        }
    }
    Coordinate c;
    c.variable = by_name >= 0 ? by_name : by_unit;
    if (c.variable < 0) return c;
    c.dimensions = file.dimensions(c.variable);
    // WRF repeats its grid for every time.
    if (!c.dimensions.empty() && c.dimensions[0].id == time_dimension && c.dimensions.size() > 1) {
        std::vector<std::size_t> start(c.dimensions.size(), 0), count;
        for (const Dimension& d : c.dimensions) count.push_back(d.length);
        count[0] = 1;
        c.values = file.box(c.variable, start, count);
        c.dimensions.erase(c.dimensions.begin());
    } else {
        c.values = file.whole(c.variable);
    }
    return c;
}

double longitude_difference(double a, double b)
{
    return std::remainder(a - b, 360.0);
}

// Some cells of the horizontal dimensions and what each counts.
struct Corner {
    std::vector<std::pair<int, std::size_t>> at;  // dimension and index
    double weight = 1.0;
};
struct Place {
    std::vector<Corner> corners;
    double latitude_deg = kNone, longitude_deg = kNone;
    std::string note;
};

std::string number_text(double value)
{
    char text[40];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

[[noreturn]] void want_place(const Coordinate& lat, const Coordinate& lon)
{
    const auto [south, north] = std::minmax_element(lat.values.begin(), lat.values.end());
    const auto [west, east] = std::minmax_element(lon.values.begin(), lon.values.end());
    throw Error("weather: NetCDF: the file is a grid from " + number_text(*south) + " to " +
                    number_text(*north) + " N and " + number_text(*west) + " to " +
                    number_text(*east) + " E",
                "Give --latitude and --longitude of a place inside it.");
}

// Index below and share above it along an axis that may fall; nothing outside (half a cell is
// allowed).
struct Along {
    std::size_t below = 0, above = 0;
    double share = 0.0;
};
std::optional<Along> along(const std::vector<double>& axis, double wanted, bool longitude)
{
    const auto from_wanted = [&](double v) {
        return longitude ? longitude_difference(v, wanted) : v - wanted;
    };
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < axis.size(); ++i) {
        if (std::abs(from_wanted(axis[i])) < std::abs(from_wanted(axis[nearest]))) nearest = i;
    }
    if (axis.size() == 1) {
        if (std::abs(from_wanted(axis[0])) > 1.0) return std::nullopt;
        return Along{0, 0, 0.0};
    }
    const double off = from_wanted(axis[nearest]);
    const auto other_of = [&](std::size_t i) -> std::optional<std::size_t> {
        // The neighbour on the other side of the wanted value; a globe goes round.
        const std::size_t n = axis.size();
        for (const std::size_t k : {i + 1, i + n - 1}) {
            const bool inside = (k == i + 1 && i + 1 < n) || (k == i + n - 1 && i > 0);
            if (!inside && !longitude) continue;
            const std::size_t j = k % n;
            const double theirs = from_wanted(axis[j]);
            const double spacing = std::abs(axis[1] - axis[0]);
            if (off * theirs <= 0.0 && std::abs(theirs - off) < 1.5 * spacing) return j;
        }
        return std::nullopt;
    };
    if (off == 0.0) return Along{nearest, nearest, 0.0};
    if (const auto other = other_of(nearest)) {
        const double theirs = from_wanted(axis[*other]);
        return Along{nearest, *other, std::abs(off) / (std::abs(off) + std::abs(theirs))};
    }
    const double spacing = std::abs(axis[1] - axis[0]);
    if (std::abs(off) <= 0.5 * spacing + 1e-9) return Along{nearest, nearest, 0.0};
    return std::nullopt;
}

Place place_on_axes(const Coordinate& lat, const Coordinate& lon, const Point& point)
{
    if (std::isnan(point.latitude_deg) || std::isnan(point.longitude_deg)) want_place(lat, lon);
    const auto y = along(lat.values, point.latitude_deg, false);
    const auto x = along(lon.values, point.longitude_deg, true);
    if (!x || !y) {
        try {
            want_place(lat, lon);
        } catch (const Error& error) {
            throw Error(std::string(error.what()) + "; " + number_text(point.latitude_deg) + " N " +
                            number_text(point.longitude_deg) + " E is outside",
                        error.fix());
        }
    }
    Place place;
    place.latitude_deg = point.latitude_deg;
    place.longitude_deg = point.longitude_deg;
    const int ydim = lat.dimensions[0].id, xdim = lon.dimensions[0].id;
    const auto corner = [&](std::size_t i, std::size_t j, double weight) {
        if (weight > 0.0) place.corners.push_back({{{ydim, i}, {xdim, j}}, weight});
    };
    if (point.bilinear) {
        corner(y->below, x->below, (1.0 - y->share) * (1.0 - x->share));
        corner(y->below, x->above, (1.0 - y->share) * x->share);
        corner(y->above, x->below, y->share * (1.0 - x->share));
        corner(y->above, x->above, y->share * x->share);
        place.note =
            "bilinear between " + std::to_string(place.corners.size()) + " points of the grid";
    } else {
        corner(y->below, x->below, 1.0);
        place.latitude_deg = lat.values[y->below];
        place.longitude_deg = lon.values[x->below];
        place.note = "nearest point of the grid: " + number_text(place.latitude_deg) + " N " +
                     number_text(place.longitude_deg) + " E";
    }
    return place;
}

// Stations along one dimension, or a field of places: the nearest.
Place nearest_place(const Coordinate& lat, const Coordinate& lon, const Point& point)
{
    if (lat.values.size() != lon.values.size())
        throw Error("weather: NetCDF: latitude and longitude differ in size", "Repair the file.");
    std::size_t best = 0;
    if (lat.values.size() > 1) {
        if (std::isnan(point.latitude_deg) || std::isnan(point.longitude_deg)) want_place(lat, lon);
        double least = std::numeric_limits<double>::infinity();
        const double shrink = std::cos(point.latitude_deg * 3.14159265358979 / 180.0);
        for (std::size_t i = 0; i < lat.values.size(); ++i) {
            const double d =
                std::hypot(lat.values[i] - point.latitude_deg,
                           shrink * longitude_difference(lon.values[i], point.longitude_deg));
            if (d < least) {
                least = d;
                best = i;
            }
        }
        if (least > 2.0) want_place(lat, lon);
    }
    Place place;
    place.latitude_deg = lat.values[best];
    place.longitude_deg = lon.values[best];
    Corner corner;
    if (lat.dimensions.size() == 2) {
        const std::size_t width = lat.dimensions[1].length;
        corner.at = {{lat.dimensions[0].id, best / width}, {lat.dimensions[1].id, best % width}};
    } else if (lat.dimensions.size() == 1) {
        corner.at = {{lat.dimensions[0].id, best}};
    }
    place.corners = {corner};
    if (lat.values.size() > 1)
        place.note = "nearest of " + std::to_string(lat.values.size()) +
                     " points: " + number_text(place.latitude_deg) + " N " +
                     number_text(place.longitude_deg) + " E";
    return place;
}

Place find_place(const File& file, const Clock& clock, const Point& point)
{
    const Coordinate lat =
        find_coordinate(file, "latitude", "degrees_north",
                        {"latitude", "lat", "xlat", "nav_lat", "gridlat_0"}, clock.dimension);
    const Coordinate lon =
        find_coordinate(file, "longitude", "degrees_east",
                        {"longitude", "lon", "xlong", "nav_lon", "gridlon_0"}, clock.dimension);
    Place place;
    if (lat.variable < 0 || lon.variable < 0) {
        place.corners = {Corner{}};
        place.note = "the file has no latitude and longitude";
        return place;
    }
    const bool axes = lat.dimensions.size() == 1 && lon.dimensions.size() == 1 &&
                      lat.dimensions[0].id != lon.dimensions[0].id;
    if (axes && (lat.values.size() > 1 || lon.values.size() > 1))
        return place_on_axes(lat, lon, point);
    if (axes) {
        place.corners = {Corner{{{lat.dimensions[0].id, 0}, {lon.dimensions[0].id, 0}}, 1.0}};
        place.latitude_deg = lat.values[0];
        place.longitude_deg = lon.values[0];
        return place;
    }
    return nearest_place(lat, lon, point);
}

// ---- values ----

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
    const Place place = find_place(file, clock, point);
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
