#include "scene/basins/height_field.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "scene/basins/detail/columns.h"

namespace petrichor::scene {

namespace {

using detail::GroundTriangle;
using detail::Layer;

constexpr double kWideScene_m = 32.0;  // wider ones are cut to where their triangles are
constexpr double kKeptShare = 0.98, kMargin_m = 5.0;
constexpr std::size_t kBandRows = 64;  // of columns held at a time

void check(const GroundOptions& o)
{
    const auto require = [](bool good, const char* name, double found, const char* accepted) {
        if (good) return;
        throw Error(std::string("ground: ") + name + " must be " + accepted + ", got " +
                        std::to_string(found),
                    std::string("Set ") + name + " to a value in the accepted range.");
    };
    require(o.most_cells >= 2 && o.most_cells <= 8192, "most_cells",
            static_cast<double>(o.most_cells), "in 2..8192");
    require(o.least_cell_m > 0.0 && std::isfinite(o.least_cell_m), "least_cell_m", o.least_cell_m,
            "above 0");
    require(o.solid_above_m >= 0.0, "solid_above_m", o.solid_above_m, "0 or more");
    require(o.least_air_m >= 0.0, "least_air_m", o.least_air_m, "0 or more");
    require(o.sheet_gap_m >= 0.0, "sheet_gap_m", o.sheet_gap_m, "0 or more");
}

struct Span {
    double low = 0.0, high = 0.0;
};
// Along one axis: where the triangles are. Of a wide scene, where 98 % of them have their middle.
Span extent(const std::vector<GroundTriangle>& triangles, glm::length_t axis, bool& cut)
{
    Span all{1e300, -1e300};
    std::vector<double> middle;
    middle.reserve(triangles.size());
    for (const GroundTriangle& t : triangles) {
        double sum = 0.0;
        for (const glm::dvec3& p : t.corner) {
            all.low = std::min(all.low, p[axis]);
            all.high = std::max(all.high, p[axis]);
            sum += p[axis];
        }
        middle.push_back(sum / 3.0);
    }
    if (all.high - all.low <= kWideScene_m) return all;
    const auto skip = static_cast<std::ptrdiff_t>(
        std::ceil(0.5 * (1.0 - kKeptShare) * static_cast<double>(middle.size())));
    if (2 * skip >= static_cast<std::ptrdiff_t>(middle.size())) return all;
    std::nth_element(middle.begin(), middle.begin() + skip, middle.end());
    const double low = middle[static_cast<std::size_t>(skip)];
    std::nth_element(middle.begin(), middle.end() - 1 - skip, middle.end());
    const double high = middle[middle.size() - 1 - static_cast<std::size_t>(skip)];
    const Span kept{std::max(all.low, low - kMargin_m), std::min(all.high, high + kMargin_m)};
    // A terrain whose triangles are everywhere stays whole.
    if (kept.high - kept.low > 0.8 * (all.high - all.low)) return all;
    cut = true;
    return kept;
}

// Height of a triangle over a point, or NaN when the point is outside. Points on an edge are
// inside: two neighbours both give their height there.
double height_over(const GroundTriangle& t, double x, double z)
{
    const auto& [a, b, c] = t.corner;
    const double area = (b.x - a.x) * (c.z - a.z) - (c.x - a.x) * (b.z - a.z);
    const double u = (b.x - x) * (c.z - z) - (c.x - x) * (b.z - z);
    const double v = (c.x - x) * (a.z - z) - (a.x - x) * (c.z - z);
    const double w = (a.x - x) * (b.z - z) - (b.x - x) * (a.z - z);
    const bool inside =
        area > 0.0 ? u >= 0.0 && v >= 0.0 && w >= 0.0 : u <= 0.0 && v <= 0.0 && w <= 0.0;
    if (!inside || area == 0.0) return std::nan("");
    return (u * a.y + v * b.y + w * c.y) / area;
}

struct CellRange {
    std::size_t first = 1, last = 0;
    bool empty() const { return first > last; }
};
// Cells whose centres lie between two coordinates.
CellRange cells_between(double low, double high, double corner, double cell_m, std::size_t count)
{
    const double from = std::ceil((low - corner) / cell_m - 0.5);
    const double to = std::floor((high - corner) / cell_m - 0.5);
    const double last = static_cast<double>(count) - 1.0;
    if (to < 0.0 || from > last || from > to) return {};
    return {static_cast<std::size_t>(std::max(from, 0.0)),
            static_cast<std::size_t>(std::min(to, last))};
}

// Fills rows [first, last) of the field. columns: room for them, whatever stands in it.
void fill_band(HeightField& field, std::size_t first, std::size_t last,
               const std::vector<GroundTriangle>& triangles, const GroundOptions& options,
               std::vector<std::vector<Layer>>& columns)
{
    columns.resize((last - first) * field.width);
    for (std::vector<Layer>& column : columns) column.clear();
    const double corner_z = field.corner_m.y + static_cast<double>(first) * field.cell_m;
    for (const GroundTriangle& t : triangles) {
        const auto [low_z, high_z] = std::minmax({t.corner[0].z, t.corner[1].z, t.corner[2].z});
        const auto rows = cells_between(low_z, high_z, corner_z, field.cell_m, last - first);
        if (rows.empty()) continue;
        const auto [low_x, high_x] = std::minmax({t.corner[0].x, t.corner[1].x, t.corner[2].x});
        const auto across =
            cells_between(low_x, high_x, field.corner_m.x, field.cell_m, field.width);
        if (across.empty()) continue;
        for (std::size_t z = rows.first; z <= rows.last; ++z) {
            for (std::size_t x = across.first; x <= across.last; ++x) {
                const double y =
                    height_over(t, field.corner_m.x + (static_cast<double>(x) + 0.5) * field.cell_m,
                                corner_z + (static_cast<double>(z) + 0.5) * field.cell_m);
                if (std::isnan(y)) continue;
                columns[z * field.width + x].push_back(
                    {static_cast<float>(y), static_cast<std::uint8_t>(t.up),
                     static_cast<std::uint8_t>(t.down), static_cast<std::uint8_t>(t.closed),
                     static_cast<std::uint8_t>(t.use == GroundUse::Ground)});
            }
        }
    }
    for (std::size_t i = 0; i < columns.size(); ++i)
        field.height_m[first * field.width + i] = detail::ground_of_column(columns[i], options);
}

}  // namespace

std::size_t cell_at(const HeightField& field, double x_m, double z_m)
{
    const double x = std::floor((x_m - field.corner_m.x) / field.cell_m);
    const double z = std::floor((z_m - field.corner_m.y) / field.cell_m);
    const bool inside = x >= 0.0 && z >= 0.0 && x < static_cast<double>(field.width) &&
                        z < static_cast<double>(field.depth);  // false for NaN
    if (!inside) return field.cells();
    return field.cell_of(static_cast<std::size_t>(x), static_cast<std::size_t>(z));
}

HeightField ground_height_field(const Scene& scene, const GroundOptions& options)
{
    check(options);
    HeightField field;
    const detail::GroundTriangles triangles = detail::ground_triangles(scene, options);
    if (triangles.not_finite > 0) {
        field.notes.push_back(std::to_string(triangles.not_finite) +
                              " triangles with positions that are not finite were left out");
    }
    if (triangles.turned > 0) {
        field.notes.push_back(std::to_string(triangles.turned) +
                              " closed meshes were inside-out and were turned");
    }
    if (triangles.upside_down)
        field.notes.emplace_back("nothing faces up: what faces down was taken as ground");
    if (triangles.all.empty()) {
        field.notes.emplace_back("no surface faces up: the scene has no ground");
        return field;
    }
    bool cut = false;
    const Span x = extent(triangles.all, 0, cut), z = extent(triangles.all, 2, cut);
    const double longer = std::max({x.high - x.low, z.high - z.low, options.least_cell_m});
    field.cell_m = std::max(options.least_cell_m, longer / static_cast<double>(options.most_cells));
    const auto count = [&](const Span& s) {
        return std::clamp<std::size_t>(
            static_cast<std::size_t>(std::ceil((s.high - s.low) / field.cell_m - 1e-9)), 1,
            options.most_cells);
    };
    field.width = count(x);
    field.depth = count(z);
    field.corner_m = {x.low, z.low};
    if (cut) {
        field.notes.emplace_back(
            "the scene is wider than 32 m: hollows are looked for around most of its triangles");
    }
    field.height_m.resize(field.cells());
    std::vector<std::vector<Layer>> columns;
    for (std::size_t row = 0; row < field.depth; row += kBandRows)
        fill_band(field, row, std::min(field.depth, row + kBandRows), triangles.all, options, columns);
    return field;
}

}  // namespace petrichor::scene
