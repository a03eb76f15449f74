#include "cli/simulate/grid_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <iterator>
#include <span>

#include "base/error.h"
#include "cli/report/drawing.h"
#include "cli/report/table.h"
#include "cli/simulate/depth_lines.h"
#include "texproc/codecs/files/io.h"
#include "weather/models/physical/mapping.h"
#include "weather/readers/text.h"

namespace petrichor::cli {
namespace {

using weather::CellState;
using Rgb = std::array<double, 3>;

struct Layer {
    const char* name;
    std::function<double(const CellState&, const weather::CellDiagnostics&,
                         const weather::WeatherMasks&)>
        value;
};

const std::vector<Layer>& layers()
{
    static const std::vector<Layer> kLayers{
        {"snow_depth.m", [](const auto&, const auto& d, const auto&) { return d.snow_depth_m; }},
        {"swe.kg_m2", [](const auto&, const auto& d, const auto&) { return d.swe_kg_m2; }},
        {"snow_density.kg_m3",
         [](const auto&, const auto& d, const auto&) { return d.snow_density_kg_m3; }},
        {"snow_albedo", [](const auto& c, const auto&, const auto&) { return c.snow_albedo; }},
        {"surface_temp.C",
         [](const auto& c, const auto&, const auto&) { return c.surface_temp_c; }},
        {"film.kg_m2", [](const auto& c, const auto&, const auto&) { return c.film; }},
        {"crack.kg_m2", [](const auto& c, const auto&, const auto&) { return c.crack; }},
        {"puddle.kg_m2", [](const auto& c, const auto&, const auto&) { return c.puddle; }},
        {"ice.kg_m2", [](const auto&, const auto& d, const auto&) { return d.surface_ice_kg_m2; }},
        {"runoff.kg_m2", [](const auto& c, const auto&, const auto&) { return c.total_drainage; }},
        {"mask.wetness", [](const auto&, const auto&, const auto& m) { return m.wetness; }},
        {"mask.cracks", [](const auto&, const auto&, const auto& m) { return m.cracks; }},
        {"mask.puddles", [](const auto&, const auto&, const auto& m) { return m.puddles; }},
        {"mask.snow", [](const auto&, const auto&, const auto& m) { return m.snow; }},
        {"mask.water_to_snow",
         [](const auto&, const auto&, const auto& m) { return m.water_to_snow; }},
    };
    return kLayers;
}

std::vector<weather::Surface> surfaces_of(const Terrain& terrain)
{
    std::vector<weather::Surface> out;
    for (const std::string& name : terrain.surfaces) out.push_back(weather::surface_preset(name));
    return out;
}

void write_layers(const std::filesystem::path& path, const Terrain& terrain, const GridMap& map,
                  double step_s)
{
    std::vector<texproc::ExrChannel> channels{{"elevation.m", {}, terrain.heights_m}};
    for (const Layer& layer : layers())
        channels.push_back({layer.name, {}, std::vector<float>(terrain.cells(), 0.0f)});
    const auto surfaces = surfaces_of(terrain);
    for (std::size_t i = 0; i < terrain.cells(); ++i) {
        if (!terrain.inside[i]) continue;
        const CellState& c = map.states[i];
        const auto d = weather::diagnostics(c);
        const auto masks = weather::weather_masks({}, surfaces[terrain.surface[i]], c, step_s);
        for (std::size_t k = 0; k < layers().size(); ++k)
            channels[k + 1].floats[i] = static_cast<float>(layers()[k].value(c, d, masks));
    }
    texproc::write_exr(path, static_cast<int>(terrain.width), static_cast<int>(terrain.height),
                       channels,
                       {{"time_utc", weather::iso_from_us(map.time_us)},
                        {"cell_size_m", std::to_string(terrain.spacing_m)}});
}

// Colour of dry ground: what an eye expects of the preset.
Rgb ground_color(const std::string& surface)
{
    constexpr std::pair<const char*, Rgb> kColors[] = {
        {"grass", {0.34, 0.42, 0.22}},     {"soil", {0.40, 0.31, 0.22}},
        {"rock", {0.45, 0.43, 0.41}},      {"gravel", {0.52, 0.50, 0.47}},
        {"sand", {0.76, 0.68, 0.50}},      {"wood", {0.47, 0.35, 0.24}},
        {"roof_tile", {0.58, 0.30, 0.22}}, {"brick", {0.55, 0.32, 0.26}}};
    for (const auto& [name, color] : kColors) {
        if (surface == name) return color;
    }
    return {0.38, 0.38, 0.39};
}

Rgb mixed(const Rgb& a, const Rgb& b, double x)
{
    return {a[0] + (b[0] - a[0]) * x, a[1] + (b[1] - a[1]) * x, a[2] + (b[2] - a[2]) * x};
}

// What a cell looks like from above, before light falls on it.
Rgb cell_color(const std::string& surface, const CellState& c)
{
    const auto d = weather::diagnostics(c);
    Rgb color = ground_color(surface);
    color = mixed(color, {color[0] * 0.55, color[1] * 0.55, color[2] * 0.6},
                  weather::wetness_of_film({}, c.film));
    color = mixed(color, {0.72, 0.80, 0.88}, 0.6 * std::min(1.0, d.surface_ice_kg_m2 / 2.0));
    // Deep snow is white, wet snow greyer.
    const double white = 0.45 + 0.58 * std::clamp(c.snow_albedo, 0.4, 0.9);
    return mixed(color, {white * 0.97, white * 0.985, white}, std::tanh(d.snow_depth_m / 0.1));
}

// Light from the north-west, 60 degrees high, as on printed maps.
double hillshade(const Terrain& t, double x, double y)
{
    const auto height = [&](double u, double v) {
        const auto cu =
            static_cast<std::size_t>(std::clamp(u, 0.0, static_cast<double>(t.width) - 1.0));
        const auto cv =
            static_cast<std::size_t>(std::clamp(v, 0.0, static_cast<double>(t.height) - 1.0));
        return static_cast<double>(t.heights_m[cv * t.width + cu]);
    };
    const double east = (height(x + 1, y) - height(x - 1, y)) / (2.0 * t.spacing_m);
    const double south = (height(x, y + 1) - height(x, y - 1)) / (2.0 * t.spacing_m);
    const double length = std::sqrt(1.0 + east * east + south * south);
    return std::max(0.0, (0.35 * east + 0.35 * south + 0.87) / length);
}

// 1, 2 or 5 times a power of ten, at most the length.
double round_length_m(double most_m)
{
    const double power = std::pow(10.0, std::floor(std::log10(most_m)));
    for (const double digit : {5.0, 2.0}) {
        if (digit * power <= most_m) return digit * power;
    }
    return power;
}

std::string length_text(double metres)
{
    char text[40];
    std::snprintf(text, sizeof text, metres >= 1000.0 ? "%.3g km" : "%.3g m",
                  metres >= 1000.0 ? metres / 1000.0 : metres);
    return text;
}

std::string hex_of(const Rgb& color)
{
    char text[8];
    const auto byte = [&](std::size_t k) {
        return static_cast<int>(std::lround(255.0 * std::clamp(color[k], 0.0, 1.0)));
    };
    std::snprintf(text, sizeof text, "#%02x%02x%02x", byte(0), byte(1), byte(2));
    return text;
}

void add_box(Drawing& strip, double x, double y, double width, double height, const Rgb& color)
{
    strip.shapes.push_back(DrawnArea{
        {{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}}, hex_of(color), 1.0});
}

// Colours of the map: bare ground, wet ground and ice as boxes, snow as a scale of depth. The
// colours are those of cells, in plain light.
void add_legend(Drawing& strip, const Terrain& terrain)
{
    constexpr const char* kInk = "#1b2430";
    const auto cell = [&](double snow_m, double film, double ice) {
        CellState state;
        state.snow_thickness[0] = snow_m;
        state.snow_albedo = 0.8;
        state.film = film;
        state.film_ice = ice;
        return cell_color(
            terrain.surfaces.empty() ? std::string("grass") : terrain.surfaces.front(), state);
    };
    double x = 10.0;
    const auto box = [&](const Rgb& color, const char* words) {
        add_box(strip, x, 52.0, 16.0, 12.0, color);
        strip.shapes.push_back(
            DrawnText{{x + 22.0, 62.0}, words, kInk, 12.0, Anchor::Start, false});
        x += 34.0 + text_width(words, 12.0) * 1.1;
    };
    box(cell(0.0, 0.0, 0.0), "dry");
    box(cell(0.0, 2.0, 0.0), "wet");
    box(cell(0.0, 0.0, 2.0), "ice");
    constexpr double kDepths[] = {0.0, 0.01, 0.02, 0.05, 0.1, 0.2, 0.3};
    const double left = 10.0, step = 34.0;
    for (std::size_t i = 0; i < std::size(kDepths); ++i) {
        const double at = left + step * static_cast<double>(i);
        add_box(strip, at, 70.0, step, 8.0, cell(kDepths[i], 0.0, 0.0));
        char words[16];
        std::snprintf(words, sizeof words, "%g", 100.0 * kDepths[i]);
        strip.shapes.push_back(
            DrawnText{{at + 0.5 * step, 90.0}, words, kInk, 11.0, Anchor::Middle, false});
    }
    strip.shapes.push_back(
        DrawnText{{left + step * static_cast<double>(std::size(kDepths)) + 8.0, 90.0},
                  "cm of snow",
                  kInk,
                  11.0,
                  Anchor::Start,
                  false});
}

// Lines of deeper snow, in their colours.
void add_line_legend(Drawing& strip, std::span<const double> levels_m)
{
    constexpr const char* kInk = "#1b2430";
    if (levels_m.empty()) return;
    strip.height += 22.0;
    double x = 10.0;
    const double y = strip.height - 8.0;
    for (std::size_t i = 0; i < levels_m.size(); ++i) {
        char words[24];
        std::snprintf(words, sizeof words, "%g m", levels_m[i]);
        strip.shapes.push_back(DrawnLine{{{x, y - 4.0}, {x + 18.0, y - 4.0}},
                                         hex_of(depth_line_color(i, levels_m.size())),
                                         2.0});
        strip.shapes.push_back(DrawnText{{x + 23.0, y}, words, kInk, 11.0, Anchor::Start, false});
        x += 36.0 + text_width(words, 11.0) * 1.1;
    }
    strip.shapes.push_back(
        DrawnText{{x, y}, "lines of snow depth", kInk, 11.0, Anchor::Start, false});
}

// What the map shows, in two lines below it, with a bar of a round length at the right.
Drawing caption(const Terrain& terrain, const GridMap& map, const PhysicalRun& model,
                std::size_t width, std::size_t zoom, std::span<const double> levels_m)
{
    constexpr const char* kInk = "#1b2430";
    double low_m = 1e9, high_m = -1e9, cover = 0.0, depth_m = 0.0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < terrain.cells(); ++i) {
        if (!terrain.inside[i]) continue;
        const double snow_m = weather::diagnostics(map.states[i]).snow_depth_m;
        low_m = std::min(low_m, static_cast<double>(terrain.heights_m[i]));
        high_m = std::max(high_m, static_cast<double>(terrain.heights_m[i]));
        cover += std::tanh(snow_m / 0.1);
        depth_m += snow_m;
        ++count;
    }
    const double cells = static_cast<double>(std::max<std::size_t>(count, 1));
    Drawing strip{.width = static_cast<double>(width), .height = 94.0, .shapes = {}};
    std::string when =
        weather::iso_from_us(map.time_us + static_cast<std::int64_t>(model.clock_offset_s * 1e6))
            .substr(0, 16);
    when[10] = ' ';
    SimulationTable shown;
    shown.utc_offset_s = model.clock_offset_s;
    const std::string clock = clock_name(shown);
    char snow[120];
    std::snprintf(snow, sizeof snow, "snow on %.0f %%, mean depth %.2f m; ground %.0f to %.0f m",
                  100.0 * cover / cells, depth_m / cells, low_m, high_m);
    strip.shapes.push_back(
        DrawnText{{10, 19}, when + " " + clock + ", north is up", kInk, 13.0, Anchor::Start, true});
    strip.shapes.push_back(DrawnText{{10, 37}, snow, kInk, 12.0, Anchor::Start, false});
    const double pixel_m = terrain.spacing_m / static_cast<double>(zoom);
    const double bar_m = round_length_m(0.22 * strip.width * pixel_m);
    const double right = strip.width - 12.0, left = right - bar_m / pixel_m;
    strip.shapes.push_back(
        DrawnLine{{{left, 10}, {left, 16}, {right, 16}, {right, 10}}, kInk, 1.5});
    strip.shapes.push_back(
        DrawnText{{right, 33}, length_text(bar_m), kInk, 12.0, Anchor::End, false});
    add_legend(strip, terrain);
    add_line_legend(strip, levels_m);
    return strip;
}

void write_preview(const std::filesystem::path& path, const Terrain& terrain, const GridMap& map,
                   const PhysicalRun& model)
{
    const std::size_t zoom = std::max<std::size_t>(1, (512 + terrain.width - 1) / terrain.width);
    std::vector<Rgb> small(terrain.cells(), {0.93, 0.94, 0.95});
    std::vector<double> depth_m(terrain.cells(), 0.0);
    for (std::size_t y = 0; y < terrain.height; ++y) {
        for (std::size_t x = 0; x < terrain.width; ++x) {
            const std::size_t i = y * terrain.width + x;
            if (!terrain.inside[i]) continue;
            depth_m[i] = weather::diagnostics(map.states[i]).snow_depth_m;
            const double light =
                0.30 + 0.72 * hillshade(terrain, static_cast<double>(x), static_cast<double>(y));
            for (std::size_t k = 0; k < 3; ++k)
                small[i][k] =
                    cell_color(terrain.surfaces[terrain.surface[i]], map.states[i])[k] * light;
        }
    }
    // Bilinear between the middles of cells.
    const std::size_t width = terrain.width * zoom, height = terrain.height * zoom;
    std::vector<std::uint8_t> rgb(width * height * 3);
    std::vector<double> depths_m(width * height);
    const auto place = [&](std::size_t pixel, std::size_t cells) {
        const double at =
            std::clamp((static_cast<double>(pixel) + 0.5) / static_cast<double>(zoom) - 0.5, 0.0,
                       static_cast<double>(cells) - 1.0);
        const auto low = static_cast<std::size_t>(at);
        return std::tuple{low, std::min(low + 1, cells - 1), at - static_cast<double>(low)};
    };
    for (std::size_t y = 0; y < height; ++y) {
        const auto [y0, y1, fy] = place(y, terrain.height);
        for (std::size_t x = 0; x < width; ++x) {
            const auto [x0, x1, fx] = place(x, terrain.width);
            const auto depth = [&](std::size_t row) {
                const double a = depth_m[row * terrain.width + x0],
                             b = depth_m[row * terrain.width + x1];
                return a + (b - a) * fx;
            };
            depths_m[y * width + x] = depth(y0) + (depth(y1) - depth(y0)) * fy;
            const Rgb top =
                mixed(small[y0 * terrain.width + x0], small[y0 * terrain.width + x1], fx);
            const Rgb color = mixed(
                top, mixed(small[y1 * terrain.width + x0], small[y1 * terrain.width + x1], fx), fy);
            for (std::size_t k = 0; k < 3; ++k) {
                rgb[(y * width + x) * 3 + k] =
                    static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(color[k], 0.0, 1.0)));
            }
        }
    }
    const std::vector<double> levels_m =
        depth_levels_m(*std::max_element(depth_m.begin(), depth_m.end()));
    draw_depth_lines(depths_m, width, levels_m, rgb);
    const Pixels words = to_pixels(caption(terrain, map, model, width, zoom, levels_m), 1.0);
    rgb.insert(rgb.end(), words.rgb.begin(), words.rgb.end());
    texproc::write_png8(path, static_cast<int>(width), static_cast<int>(height) + words.height, 3,
                        rgb, {{"time_utc", weather::iso_from_us(map.time_us)}});
}

}  // namespace

void write_grid_map(const std::filesystem::path& path, const Terrain& terrain, const GridMap& map,
                    const PhysicalRun& model)
{
    const std::string kind = weather::lower(path.extension().string());
    if (kind == ".exr")
        write_layers(path, terrain, map, model.step_s);
    else if (kind == ".png")
        write_preview(path, terrain, map, model);
    else
        throw Error(
            "grid: cannot write the map " + path.string() + ": unknown kind \"" + kind + "\"",
            "Use .exr (all layers) or .png (to look at).");
}

std::filesystem::path map_path(const std::filesystem::path& path, std::int64_t time_us,
                               bool several)
{
    if (!several) return path;
    std::string stamp = weather::iso_from_us(time_us).substr(0, 16);
    std::erase_if(stamp, [](char c) { return c == '-' || c == ':'; });
    std::filesystem::path out = path.parent_path() / (path.stem().string() + "_" + stamp);
    out += path.extension();
    return out;
}

}  // namespace petrichor::cli
