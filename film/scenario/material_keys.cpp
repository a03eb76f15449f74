#include "film/scenario/material_keys.h"

#include "base/words.h"

namespace petrichor::film {
namespace {

using scene::MaterialWeather;
using Values = std::vector<double>;

float f(double value)
{
    return static_cast<float>(value);
}

}  // namespace

const std::vector<MaterialKey>& material_keys()
{
    static const std::vector<MaterialKey> keys{
        {"porosity", 1, 0.0, 1.0, "0.6",
         "0 dense (metal, glaze) .. 1 porous (brick, soil): how much darker when wet",
         [](MaterialWeather& m, const Values& v) { m.porosity = f(v[0]); }},
        {"height_scale_m", 1, 0.0, 10.0, "0.02",
         "height 1 of the height map above height 0, metres",
         [](MaterialWeather& m, const Values& v) { m.height_scale_m = f(v[0]); }},
        {"default_height", 1, 0.0, 1.0, "0.25", "height where the material has no height map",
         [](MaterialWeather& m, const Values& v) { m.default_height = f(v[0]); }},
        {"water_slope_damp", 1, 0.0, 1.0, "0.5",
         "0 water stands on flat ground only .. 1 on slopes too",
         [](MaterialWeather& m, const Values& v) { m.water_slope_damp = f(v[0]); }},
        {"water_accumulation", 4, -10.0, 10.0, "[0.0, 1.0, 0.0, 1.0]",
         "cracks: constant, influence of the weather; puddles: constant, influence",
         [](MaterialWeather& m, const Values& v) {
             m.water_accumulation = {f(v[0]), f(v[1]), f(v[2]), f(v[3])};
         }},
        {"water_color", 4, 0.0, 1.0, "[0.1, 0.08, 0.05, 0.3]",
         "linear red, green, blue and opacity of the water (mud, leaves)",
         [](MaterialWeather& m, const Values& v) {
             m.water_color = {f(v[0]), f(v[1]), f(v[2]), f(v[3])};
         }},
        {"flow_tiling", 1, 0.0, 100.0, "2.0", "repeats of the flowing water per metre",
         [](MaterialWeather& m, const Values& v) { m.flow_tiling = f(v[0]); }},
        {"flow_speed", 1, 0.0, 2.0, "0.05", "speed of water that runs down",
         [](MaterialWeather& m, const Values& v) { m.flow_speed = f(v[0]); }},
        {"flow_interval_s", 1, 0.0, 8.0, "1.0", "seconds between two waves of flow",
         [](MaterialWeather& m, const Values& v) { m.flow_interval_s = f(v[0]); }},
        {"flow_refraction", 1, 0.0, 0.1, "0.02", "how far flowing water shifts what lies below",
         [](MaterialWeather& m, const Values& v) { m.flow_refraction = f(v[0]); }},
        {"flow_normal_strength", 1, 0.0, 2.0, "1.0", "bumpiness of flowing water",
         [](MaterialWeather& m, const Values& v) { m.flow_normal_strength = f(v[0]); }},
        {"snow_slope_damp", 1, 0.0, 8.0, "0.75", "how fast snow thins out on slopes",
         [](MaterialWeather& m, const Values& v) { m.snow_slope_damp = f(v[0]); }},
        {"snow_accumulation", 2, -10.0, 10.0, "[0.0, 1.0]",
         "snow: constant, influence of the weather",
         [](MaterialWeather& m, const Values& v) {
             m.snow_accumulation = {f(v[0]), f(v[1])};
         }},
        {"snow_normal_strength", 1, 0.0, 2.0, "1.0", "bumpiness of the snow",
         [](MaterialWeather& m, const Values& v) { m.snow_normal_strength = f(v[0]); }},
        {"snow_detail_strength", 1, 0.0, 1.0, "0.3",
         "how much of the surface shows through thin snow",
         [](MaterialWeather& m, const Values& v) { m.snow_detail_strength = f(v[0]); }},
        {"snow_opacity", 1, 0.0, 1.0, "0.5", "cover of thin snow",
         [](MaterialWeather& m, const Values& v) { m.snow_opacity = f(v[0]); }},
        {"sheltered", 0, 0.0, 1.0, "true", "an interior: never gets rain or snow",
         [](MaterialWeather& m, const Values& v) { m.sheltered = v[0] != 0.0; }},
    };
    return keys;
}

std::vector<std::string> apply_material_overrides(const std::vector<MaterialOverride>& overrides,
                                                  std::vector<scene::Material>& materials)
{
    std::vector<std::string> unmatched;
    for (const MaterialOverride& one : overrides) {
        bool matched = false;
        for (scene::Material& material : materials) {
            if (!glob_matches(one.glob, material.name)) continue;
            matched = true;
            for (const auto& [name, values] : one.values) {
                for (const MaterialKey& key : material_keys()) {
                    if (key.name == name) key.set(material.weather, values);
                }
            }
        }
        if (matched) continue;
        std::vector<std::string> names;
        for (const scene::Material& material : materials) names.push_back(material.name);
        if (names.size() > 12) {
            names.resize(12);
            names.push_back("...");
        }
        unmatched.push_back(
            one.place + ": [materials.\"" + one.glob +
            "\"] matches no material of the scene; there are: " + join_words(names));
    }
    return unmatched;
}

}  // namespace petrichor::film
