#include "weather/packed/detail/netcdf_place.h"

#include <cstdio>
#include <initializer_list>
#include <optional>

namespace petrichor::weather::packed::detail {

namespace {

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

}  // namespace

Place find_place(const File& file, int time_dimension, const Point& point)
{
    const Coordinate lat =
        find_coordinate(file, "latitude", "degrees_north",
                        {"latitude", "lat", "xlat", "nav_lat", "gridlat_0"}, time_dimension);
    const Coordinate lon =
        find_coordinate(file, "longitude", "degrees_east",
                        {"longitude", "lon", "xlong", "nav_lon", "gridlon_0"}, time_dimension);
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

}  // namespace petrichor::weather::packed::detail
