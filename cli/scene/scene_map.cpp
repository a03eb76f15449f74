#include "cli/scene/scene_map.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

#include "base/parallel.h"
#include "cli/scene/lamp_lines.h"
#include "scene/patches/lamps.h"
#include "scene/patches/patches.h"
#include "weather/moment.h"

namespace petrichor::cli {
namespace {

using scene::Patches;

std::vector<float> sky_values(const SceneView& view, const MapConditions&)
{
    return view.patches().sky_view;
}

std::vector<float> rain_values(const SceneView& view, const MapConditions& c)
{
    const Patches& p = view.patches();
    const double from = (c.wind_from_degrees + c.north_degrees) * std::numbers::pi / 180.0;
    // Wind comes from there: it blows the other way.
    const glm::vec3 drops{static_cast<float>(-std::sin(from) * c.wind_m_s),
                          static_cast<float>(-c.drop_m_s),
                          static_cast<float>(std::cos(from) * c.wind_m_s)};
    std::vector<float> values(p.count);
    for (std::uint32_t i = 0; i < p.count; ++i) values[i] = scene::rain_exposure(p, i, drops);
    return values;
}

std::vector<float> sun_values(const SceneView& view, const MapConditions& c)
{
    const Patches& p = view.patches();
    std::vector<float> hours(p.count, 0.0f);
    constexpr int kSteps = 96;  // quarters of an hour
    for (int step = 0; step < kSteps; ++step) {
        const weather::SunAngles sun = weather::sun_angles_by_solar_time(
            c.day_of_year, (step + 0.5) * 24.0 / kSteps, c.latitude_degrees);
        if (!(sun.elevation_rad > 0.0)) continue;
        const double azimuth = sun.azimuth_rad + c.north_degrees * std::numbers::pi / 180.0;
        const double level = std::cos(sun.elevation_rad);
        const glm::vec3 towards{static_cast<float>(level * std::sin(azimuth)),
                                static_cast<float>(std::sin(sun.elevation_rad)),
                                static_cast<float>(-level * std::cos(azimuth))};
        for (std::uint32_t i = 0; i < p.count; ++i)
            hours[i] += scene::visible_share(p, i, towards) * (24.0f / kSteps);
    }
    return hours;
}

std::vector<float> lamp_values(const SceneView& view, const MapConditions&)
{
    const Patches& p = view.patches();
    std::vector<glm::vec3> lux(p.count, glm::vec3(0.0f));
    for (const scene::Light& light : view.scene->lights) {
        if (light.kind != scene::LightKind::Directional) scene::add_lamp(p, light, view.scene->light_profiles, {}, lux);
    }
    std::vector<float> values;
    for (const glm::vec3& l : lux) values.push_back(glm::dot(l, glm::vec3(0.2126f, 0.7152f, 0.0722f)));
    return values;
}

// A patch right below a lamp would leave all others dark.
std::pair<float, float> to_most_of_it(const std::vector<float>& values)
{
    std::vector<float> lit;
    for (const float v : values) {
        if (v > 0.0f) lit.push_back(v);
    }
    if (lit.empty()) return {0.0f, 1.0f};
    std::sort(lit.begin(), lit.end());
    return {0.0f, lit[(lit.size() - 1) * 95 / 100]};
}

// Neighbours look different, whatever their numbers.
std::vector<float> patch_values(const SceneView& view, const MapConditions&)
{
    const Patches& p = view.patches();
    std::vector<float> values(p.count);
    for (std::uint32_t i = 0; i < p.count; ++i)
        values[i] = static_cast<float>(shared::patch_key_hash(p.key[i]) & 1023u) / 1023.0f;
    return values;
}

std::pair<float, float> one(const std::vector<float>&)
{
    return {0.0f, 1.0f};
}

std::pair<float, float> to_largest(const std::vector<float>& values)
{
    float most = 0.0f;
    for (const float v : values) most = std::max(most, v);
    return {0.0f, most > 0.0f ? most : 1.0f};
}

std::string plain(const char* format, double a, double b = 0.0)
{
    char text[160];
    std::snprintf(text, sizeof text, format, a, b);
    return text;
}

using Rgb = glm::vec3;

Rgb from_hex(const std::string& hex)
{
    const auto part = [&](std::size_t at) {
        return static_cast<float>(std::stoi(hex.substr(at, 2), nullptr, 16)) / 255.0f;
    };
    return {part(1), part(3), part(5)};
}

Rgb on_scale(const std::vector<Rgb>& colors, float share)
{
    const float at = std::clamp(share, 0.0f, 1.0f) * static_cast<float>(colors.size() - 1);
    const auto first = std::min(static_cast<std::size_t>(at), colors.size() - 2);
    return glm::mix(colors[first], colors[first + 1], at - static_cast<float>(first));
}

std::string to_hex(Rgb c)
{
    char text[8];
    const auto byte = [](float v) {
        return static_cast<int>(std::lround(255.0f * std::clamp(v, 0.0f, 1.0f)));
    };
    std::snprintf(text, sizeof text, "#%02x%02x%02x", byte(c.x), byte(c.y), byte(c.z));
    return text;
}

constexpr double kLegend = 64.0;

Drawing legend(const SceneView& view, const SceneMap& map, const MapConditions& conditions,
               std::pair<float, float> range, const std::vector<Rgb>& colors, int width)
{
    constexpr const char* kInk = "#1b2430";
    Drawing strip;
    strip.width = width;
    strip.height = kLegend;
    const std::string title = map.help + (map.unit.empty() ? "" : ", " + map.unit);
    strip.shapes.push_back(DrawnText{{12.0, 20.0}, title, kInk, 13.0, Anchor::Start, true});
    strip.shapes.push_back(DrawnText{{static_cast<double>(width) - 12.0, 20.0},
                                     map.caption(view, conditions), kInk, 12.0, Anchor::End,
                                     false});
    if (!map.smooth) return strip;
    constexpr int kBoxes = 60;
    const double left = 12.0, box = std::min(6.0, (width - 24.0) / kBoxes);
    for (int k = 0; k < kBoxes; ++k) {
        const double x = left + box * k;
        strip.shapes.push_back(
            DrawnArea{{{x, 30.0}, {x + box + 0.5, 30.0}, {x + box + 0.5, 42.0}, {x, 42.0}},
                      to_hex(on_scale(colors, static_cast<float>(k) / (kBoxes - 1))),
                      1.0});
    }
    for (int k = 0; k <= 4; ++k) {
        const double value = static_cast<double>(range.first) +
                             static_cast<double>(range.second - range.first) * k / 4.0;
        strip.shapes.push_back(DrawnText{{left + box * kBoxes * k / 4.0, 57.0},
                                         plain(value < 10.0 ? "%.2f" : "%.1f", value), kInk, 11.0,
                                         k == 0 ? Anchor::Start : Anchor::Middle, false});
    }
    return strip;
}

struct Painter {
    const SceneView& view;
    const SceneMap& map;
    const scene::Tracer& tracer;
    const scene::LitPatches& lit;
    const std::vector<float>& values;
    std::pair<float, float> range;
    const std::vector<Rgb>& colors;

    Rgb operator()(const scene::Ray& ray) const
    {
        const scene::RayHit hit = tracer.nearest(ray);
        if (!hit.hit()) return Rgb(0.93f, 0.95f, 0.97f);
        const scene::Triangles& triangles = tracer.triangles();
        glm::vec3 face = triangles.normal(hit.triangle);
        glm::vec3 shading = triangles.shading_normal(hit.triangle, hit.at);
        if (hit.back) {
            face = -face;
            shading = -shading;
        }
        const glm::vec3 x = ray.origin + ray.direction * hit.distance_m;
        const float facing = std::max(-glm::dot(shading, ray.direction), 0.0f);
        const float shade = 0.62f + 0.38f * facing;
        float value = std::numeric_limits<float>::quiet_NaN();
        if (map.smooth) {
            const shared::PatchLight found = scene::light_at(lit, x, face);
            // Where nothing has a value, w says so.
            if (found.weight > 0.0f && found.irradiance.y > 0.5f)
                value = found.irradiance.x / found.irradiance.y;
        } else if (const auto patch = scene::patch_at(view.patches(), x, face)) {
            value = values[*patch];
        }
        if (!std::isfinite(value)) return Rgb(0.55f) * shade;
        const float share = (value - range.first) / (range.second - range.first);
        return on_scale(colors, share) * shade;
    }
};

}  // namespace

const std::vector<SceneMap>& scene_maps()
{
    static const std::vector<SceneMap> kMaps{
        {"sky",
         "share of the sky that is seen, weighed by its cosine",
         "",
         {"#10102c", "#2b3f8c", "#3f8fc4", "#9fd6d8", "#fdfbe4"},
         sky_values,
         one,
         [](const SceneView&, const MapConditions&) { return std::string(); }},
        {"rain",
         "rain that arrives, over what open ground gets",
         "",
         {"#7a4a1e", "#d2a46a", "#e9e3cf", "#6fb0d6", "#0b3d91"},
         rain_values,
         [](const std::vector<float>& values) {
             return std::pair(0.0f, std::max(1.0f, to_largest(values).second));
         },
         [](const SceneView&, const MapConditions& c) {
             return c.wind_m_s > 0.0
                        ? plain("wind %.1f m/s from %.0f degrees", c.wind_m_s, c.wind_from_degrees)
                        : std::string("no wind");
         }},
        {"sun",
         "hours of direct sun on a clear day",
         "h",
         {"#17132b", "#5b2a6e", "#c4483d", "#f6a13a", "#fff6b8"},
         sun_values,
         to_largest,
         [](const SceneView&, const MapConditions& c) {
             return plain("day %.0f at %.1f degrees north", c.day_of_year, c.latitude_degrees);
         }},
        {"patches",
         "patches, each in a colour of its own",
         "",
         {"#c1443c", "#e0a030", "#8fb84a", "#3f9e94", "#4a6fb8", "#8a5aa8", "#d0d0d0"},
         patch_values,
         one,
         [](const SceneView& view, const MapConditions&) {
             return plain("%.0f patches, finest cell %.3f m", view.patches().count,
                          static_cast<double>(view.patches().cell_m));
         },
         false},
        {"lights",
         "light of all lamps, unshadowed, and their shapes",
         "lx",
         {"#15181f", "#3a3f4c", "#6d6a66", "#b29a6b", "#fff0c8"},
         lamp_values,
         to_most_of_it,
         [](const SceneView& view, const MapConditions&) {
             const auto& all = view.scene->lights;
             const auto lamps = std::count_if(all.begin(), all.end(), [](const scene::Light& light) {
                 return light.kind != scene::LightKind::Directional;
             });
             return plain("%.0f lamps", static_cast<double>(lamps));
         },
         true, true},
    };
    return kMaps;
}

Pixels draw_scene_map(const SceneView& view, const SceneMap& map, const MapConditions& conditions,
                      const scene::Camera& camera, const MapPicture& picture)
{
    const Patches& patches = view.patches();
    const std::vector<float> values = map.values(view, conditions);
    const auto range = map.range(values);
    std::vector<Rgb> colors;
    for (const std::string& hex : map.colors) colors.push_back(from_hex(hex));
    // Values are looked up as light is; y carries where there is one.
    std::vector<glm::vec4> leaves(patches.count);
    for (std::uint32_t i = 0; i < patches.count; ++i) {
        leaves[i] = std::isfinite(values[i]) ? glm::vec4(values[i], 1.0f, 0.0f, 1.0f)
                                             : glm::vec4(0.0f);
    }
    const auto nodes = scene::with_interior(patches, leaves);
    std::vector<glm::vec4> gradient;
    for (const float size : scene::lookup_sizes(patches))
        gradient.emplace_back(0.0f, 0.0f, 0.0f, size);
    const auto planes = scene::lookup_planes(patches);
    const scene::LookupWays ways = scene::lookup_ways(patches);
    const scene::LitPatches lit{ways.table, ways.ways, planes, nodes, gradient, ways.grid};
    const scene::Tracer tracer(*view.triangles);
    const Painter paint{view, map, tracer, lit, values, range, colors};

    const glm::vec2 half = scene::half_extent_m(camera, picture.width, picture.height);
    const glm::mat4& m = camera.to_world;
    const glm::vec3 right(m[0]), up(m[1]), forward(-m[2]), eye(m[3]);
    const bool orthographic = camera.orthographic_height_m > 0.0f;
    const auto strip = to_pixels(
        legend(view, map, conditions, range, colors, picture.width), 1.0);
    Pixels pixels;
    pixels.width = picture.width;
    pixels.height = picture.height + strip.height;
    pixels.rgb.resize(static_cast<std::size_t>(pixels.width) *
                      static_cast<std::size_t>(pixels.height) * 3);
    parallel_for(static_cast<std::size_t>(picture.height), picture.threads, [&](std::size_t row) {
        for (int column = 0; column < picture.width; ++column) {
            Rgb sum(0.0f);
            for (int k = 0; k < 4; ++k) {  // a turned square
                const float dx = (k & 1 ? 0.625f : 0.125f) + (k & 2 ? 0.25f : 0.0f);
                const float dy = (k & 2 ? 0.625f : 0.125f) + (k & 1 ? 0.0f : 0.25f);
                const float x = (static_cast<float>(column) + dx) /
                                    static_cast<float>(picture.width) * 2.0f - 1.0f;
                const float y = 1.0f - (static_cast<float>(row) + dy) /
                                           static_cast<float>(picture.height) * 2.0f;
                const glm::vec3 offset = right * ((x + camera.shift.x) * half.x) + up * ((y + camera.shift.y) * half.y);
                scene::Ray ray;
                ray.origin = orthographic ? eye + offset : eye;
                ray.direction = glm::normalize(orthographic ? forward : forward + offset);
                sum += paint(ray);
            }
            std::uint8_t* out = pixels.rgb.data() +
                                3 * (row * static_cast<std::size_t>(pixels.width) +
                                     static_cast<std::size_t>(column));
            for (int c = 0; c < 3; ++c)
                out[c] = static_cast<std::uint8_t>(std::clamp(sum[c] * 0.25f, 0.0f, 1.0f) * 255.0f +
                                                   0.5f);
        }
    });
    if (map.lamps) draw_lamps(pixels, picture.height, *view.scene, camera);
    std::copy(strip.rgb.begin(), strip.rgb.end(),
              pixels.rgb.begin() + static_cast<std::ptrdiff_t>(pixels.width) * picture.height * 3);
    return pixels;
}

}  // namespace petrichor::cli
