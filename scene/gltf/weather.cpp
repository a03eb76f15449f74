#include <algorithm>
#include <array>

#include "scene/gltf/detail/gltf_parts.h"

namespace petrichor::scene {
namespace {

constexpr std::array<std::string_view, 20> kKeys{
    "heightTexture",      "heightScale",        "defaultHeight",  "puddleMaskTexture",
    "snowMaskTexture",    "porosity",           "waterSlopeDamp", "waterAccumulation",
    "waterColor",         "flowTiling",         "flowSpeed",      "flowInterval",
    "flowRefraction",     "flowNormalStrength", "snowSlopeDamp",  "snowAccumulation",
    "snowNormalStrength", "snowDetailStrength", "snowOpacity",    "sheltered"};

void check_keys(const JsonObject& weather)
{
    for (const std::string& key : weather.keys()) {
        if (key == "extensions" || key == "extras") continue;
        if (std::find(kKeys.begin(), kKeys.end(), key) != kKeys.end()) continue;
        const auto nearest = nearest_word(key, kKeys);
        std::string fix = "Remove it; the keys are";
        for (const std::string_view known : kKeys) fix.append(" ").append(known);
        if (nearest) fix = "Did you mean " + *nearest + "?";
        weather.fail("", "unknown key " + in_quotes(key), fix);
    }
}

// Reads numbers and checks each against its own upper limit; all start at 0.
template <std::size_t N>
void read_limited(const JsonObject& weather, std::string_view key, std::array<float, N> limits,
                  float* out)
{
    if (!weather.numbers(key, std::span<float>(out, N))) return;
    for (std::size_t i = 0; i < N; ++i) {
        if (out[i] >= 0.0f && out[i] <= limits[i]) continue;
        weather.fail(key,
                     "number " + std::to_string(i) + " must be in [0, " +
                         number_text(static_cast<double>(limits[i])) + "], got " +
                         number_text(static_cast<double>(out[i])),
                     "Correct the value in the material's weather.");
    }
}

}  // namespace

MaterialWeather read_weather(const JsonObject& weather, TextureCollector& textures)
{
    check_keys(weather);
    MaterialWeather out;
    out.height = textures.use(weather, "heightTexture");
    out.height_scale_m = weather.number("heightScale", out.height_scale_m, 0.0f, 10.0f);
    out.default_height = weather.number("defaultHeight", out.default_height, 0.0f, 1.0f);
    out.puddle_mask = textures.use(weather, "puddleMaskTexture");
    out.snow_mask = textures.use(weather, "snowMaskTexture");
    if (weather.has("porosity")) out.porosity = weather.number("porosity", 0.0f, 0.0f, 1.0f);
    out.water_slope_damp = weather.number("waterSlopeDamp", out.water_slope_damp, 0.0f, 1.0f);
    read_limited<4>(weather, "waterAccumulation", {2.0f, 4.0f, 2.0f, 4.0f},
                    &out.water_accumulation.x);
    read_limited<4>(weather, "waterColor", {1.0f, 1.0f, 1.0f, 1.0f}, &out.water_color.x);
    out.flow_tiling = weather.number("flowTiling", out.flow_tiling, 0.0f, 1000.0f);
    out.flow_speed = weather.number("flowSpeed", out.flow_speed, 0.0f, 2.0f);
    out.flow_interval_s = weather.number("flowInterval", out.flow_interval_s, 0.0f, 8.0f);
    out.flow_refraction = weather.number("flowRefraction", out.flow_refraction, 0.0f, 0.1f);
    out.flow_normal_strength =
        weather.number("flowNormalStrength", out.flow_normal_strength, 0.0f, 2.0f);
    out.snow_slope_damp = weather.number("snowSlopeDamp", out.snow_slope_damp, 0.0f, 8.0f);
    read_limited<2>(weather, "snowAccumulation", {2.0f, 4.0f}, &out.snow_accumulation.x);
    out.snow_normal_strength =
        weather.number("snowNormalStrength", out.snow_normal_strength, 0.0f, 2.0f);
    out.snow_detail_strength =
        weather.number("snowDetailStrength", out.snow_detail_strength, 0.0f, 1.0f);
    out.snow_opacity = weather.number("snowOpacity", out.snow_opacity, 0.0f, 1.0f);
    out.sheltered = weather.flag("sheltered", false);
    return out;
}

}  // namespace petrichor::scene
