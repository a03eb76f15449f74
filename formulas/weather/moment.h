// The weather of a moment at a place: all that a picture is told about it, once.
//
// One text for C++ and GLSL. Both weather models fill the whole struct (weather/moment.h), the
// renderer embeds it in its frame constants (`frame.weather.x` in shaders) and frames.jsonl writes
// it by the rows below: a new property is a field here, its row, and a line in what fills it.
#ifndef PETRICHOR_FORMULAS_WEATHER_MOMENT_H
#define PETRICHOR_FORMULAS_WEATHER_MOMENT_H

#include "base/interop.h"

// A member's default in C++; GLSL has none.
#ifdef __cplusplus
#define MOMENT_DEFAULT(value) = value
#else
#define MOMENT_DEFAULT(value)
#endif

SHARED_BEGIN

// An SI quantity that nobody knows here. All that may be unknown are never below 0 when known.
SHARED_CONST float kUnknown = -1.0f;

// Scalar layout, floats only, so that it is hashed and compared as one run of numbers.
struct WeatherMoment {
    // ---- 0..1, as surfaces show it (docs/lux.md, 3; physical/mapping.h) -----------------
    float rain MOMENT_DEFAULT(0.0f);
    float snowfall MOMENT_DEFAULT(0.0f);
    float flood_cracks MOMENT_DEFAULT(0.0f);
    float flood_puddles MOMENT_DEFAULT(0.0f);
    float film_albedo MOMENT_DEFAULT(0.0f);
    float film_smoothness MOMENT_DEFAULT(0.0f);
    float snow_amount MOMENT_DEFAULT(0.0f);
    float water_to_snow MOMENT_DEFAULT(0.0f);
    float freeze_exp MOMENT_DEFAULT(0.0f);
    float melt MOMENT_DEFAULT(0.0f);
    float melt_exp MOMENT_DEFAULT(0.0f);
    float frost MOMENT_DEFAULT(0.0f);
    float snow_start_height_m MOMENT_DEFAULT(-100.0f);
    float snow_height_blend_m MOMENT_DEFAULT(10.0f);

    // ---- SI, on open flat ground of the weather's own surface -----------------------------------
    float air_temperature_k MOMENT_DEFAULT(288.15f);
    float surface_temperature_k MOMENT_DEFAULT(-1.0f);
    float rain_kg_m2_s MOMENT_DEFAULT(0.0f);
    float snowfall_kg_m2_s MOMENT_DEFAULT(0.0f);
    float snow_fraction MOMENT_DEFAULT(0.0f);
    float film_mm MOMENT_DEFAULT(0.0f);
    float crack_water_depth_m MOMENT_DEFAULT(0.0f);
    float puddle_depth_m MOMENT_DEFAULT(0.0f);
    float ice_kg_m2 MOMENT_DEFAULT(0.0f);
    float snow_depth_m MOMENT_DEFAULT(0.0f);
    float swe_kg_m2 MOMENT_DEFAULT(0.0f);
    float snow_liquid_fraction MOMENT_DEFAULT(0.0f);
    float snow_temperature_k MOMENT_DEFAULT(-1.0f);
    float snow_albedo MOMENT_DEFAULT(-1.0f);
    vec2 wind_m_s MOMENT_DEFAULT(splat2(0.0f));
    float relative_humidity MOMENT_DEFAULT(-1.0f);
    float pressure_pa MOMENT_DEFAULT(-1.0f);
    float visibility_m MOMENT_DEFAULT(20000.0f);
    float cloud_fraction MOMENT_DEFAULT(0.0f);
    float direct_normal_w_m2 MOMENT_DEFAULT(-1.0f);
    float diffuse_horizontal_w_m2 MOMENT_DEFAULT(-1.0f);
    float longwave_down_w_m2 MOMENT_DEFAULT(-1.0f);
};

// How weather is drawn, whatever the weather: globals of a scenario (`frame.look.x` in shaders).
struct WeatherLook {
    vec3 snow_color MOMENT_DEFAULT(vec3(0.92f, 0.94f, 0.97f));  // linear albedo; may pass 1
    vec3 snow_specular MOMENT_DEFAULT(splat3(0.02f));  // F0
    // Repeats per metre of the snow's relief, its detail, its mask and the mask's detail.
    vec4 snow_tiling MOMENT_DEFAULT(vec4(0.35f, 1.7f, 0.09f, 0.83f));
    // Bumpiness of the snow and of its detail, times that of the material. Fresh snow has little of a hand's width.
    vec2 snow_strength MOMENT_DEFAULT(vec2(1.0f, 0.25f));
    // Light that snow scatters at grazing angles: brightens its albedo. Black: none.
    vec3 snow_scatter_color MOMENT_DEFAULT(splat3(0.0f));
    float snow_scatter_bias MOMENT_DEFAULT(0.0f);
    float snow_scatter_contraction MOMENT_DEFAULT(8.0f);
    // How far the snow line runs up and down the slope, times twice its blend range.
    float snow_line_ragged MOMENT_DEFAULT(1.0f);
    // How much of what snow mirrors of the sun is gathered on single crystals: 0 none, an even sheet.
    float snow_sparkle MOMENT_DEFAULT(1.0f);
    // How far the colour of wide ground varies from place to place: 0 nowhere, 1 as fields do.
    float ground_variation MOMENT_DEFAULT(1.0f);
    // Mud in standing water over that of rain water in a street: 0 none, 20 a flood's.
    float water_mud MOMENT_DEFAULT(1.0f);
    float ripple_tiling MOMENT_DEFAULT(0.8f);  // repeats per metre
    float ripple_speed MOMENT_DEFAULT(1.0f);   // 1 as photographed
    // How far a ring shifts what lies below, in texture coordinates a slope. Lux has 0.5, half a
    // repeat of the texture: more than a puddle does.
    float ripple_refraction MOMENT_DEFAULT(0.05f);
    // A third of the slope in the map, as rings on a real puddle have (Lagarde 2013, 2b).
    float ripple_strength MOMENT_DEFAULT(0.35f);
    // Ripples, flow and snow detail are gone from this far on ...
    float detail_distance_m MOMENT_DEFAULT(50.0f);
    float detail_fade_m MOMENT_DEFAULT(15.0f);  // ... and fade over this much before it
};

SHARED_END

#ifdef __cplusplus

#include <array>
#include <cstddef>

namespace petrichor::shared {

/// What files and documents say about a field of WeatherMoment.
struct MomentRow {
    const char* name;  ///< of the field, the key in frames.jsonl
    const char* unit;  ///< "1" for shares
    const char* meaning;
    double precision;     ///< a difference below this means nothing
    std::size_t offset;   ///< in bytes
    std::size_t numbers;  ///< 1, or 2 for a vector
    bool may_be_unknown;  ///< kUnknown stands for "not known", null in files
};

constexpr MomentRow moment_row(const char* name, std::size_t offset, std::size_t bytes,
                               const char* unit, double precision, bool may_be_unknown,
                               const char* meaning)
{
    return {name, unit, meaning, precision, offset, bytes / sizeof(float), may_be_unknown};
}
#define MOMENT_ROW(field, ...) \
    moment_row(#field, offsetof(WeatherMoment, field), sizeof(WeatherMoment::field), __VA_ARGS__)

/// One row a field, in the order of the struct.
inline constexpr std::array kMomentRows{
    MOMENT_ROW(rain, "1", 0.01, false, "intensity of rain; 1 is 50 mm/h"),
    MOMENT_ROW(snowfall, "1", 0.01, false, "intensity of snowfall; 1 is 50 mm/h of water"),
    MOMENT_ROW(flood_cracks, "1", 0.01, false, "level of water in cracks over their depth"),
    MOMENT_ROW(flood_puddles, "1", 0.01, false, "level of water in puddles over their depth"),
    MOMENT_ROW(film_albedo, "1", 0.01, false, "wet film, as far as it darkens"),
    MOMENT_ROW(film_smoothness, "1", 0.01, false, "wet film, as far as it smooths"),
    MOMENT_ROW(snow_amount, "1", 0.01, false, "snow on flat open ground, 1 all white"),
    MOMENT_ROW(water_to_snow, "1", 0.01, false, "frozen share of the water on surfaces"),
    MOMENT_ROW(freeze_exp, "1", 0.01, false, "1 - 2^(-10 water_to_snow): stills ripples and flow"),
    MOMENT_ROW(melt, "1", 0.01, false, "how far snow has begun to melt"),
    MOMENT_ROW(melt_exp, "1", 0.01, false, "1 - 2^(-10 melt): wets the ground around snow"),
    MOMENT_ROW(frost, "1", 0.01, false, "hoar frost on cold, dry, open surfaces"),
    MOMENT_ROW(snow_start_height_m, "m", 1.0, false, "no snow lies below this height of the scene"),
    MOMENT_ROW(snow_height_blend_m, "m", 1.0, false, "height over which snow comes in above that"),
    MOMENT_ROW(air_temperature_k, "K", 0.1, false, "air, at the height of a thermometer"),
    MOMENT_ROW(surface_temperature_k, "K", 0.1, true, "skin of the ground, or of the snow on it"),
    MOMENT_ROW(rain_kg_m2_s, "kg m-2 s-1", 1e-6, false, "rain; times 3600 is mm/h"),
    MOMENT_ROW(snowfall_kg_m2_s, "kg m-2 s-1", 1e-6, false, "snowfall, as water"),
    MOMENT_ROW(snow_fraction, "1", 0.01, false, "precipitation phase: snow in what falls, by mass"),
    MOMENT_ROW(film_mm, "mm", 0.01, false, "liquid film; 1 mm is 1 kg/m2"),
    MOMENT_ROW(crack_water_depth_m, "m", 1e-5, false, "water and ice in cracks, where deepest"),
    MOMENT_ROW(puddle_depth_m, "m", 1e-4, false, "water and ice in puddles, where deepest"),
    MOMENT_ROW(ice_kg_m2, "kg m-2", 0.01, false, "ice on the ground: film, cracks and puddles"),
    MOMENT_ROW(snow_depth_m, "m", 1e-3, false, "snow on the ground"),
    MOMENT_ROW(swe_kg_m2, "kg m-2", 0.1, false, "snow water equivalent, its liquid included"),
    MOMENT_ROW(snow_liquid_fraction, "1", 0.01, false, "liquid water in the snow, by mass"),
    MOMENT_ROW(snow_temperature_k, "K", 0.1, true, "mean of the pack"),
    MOMENT_ROW(snow_albedo, "1", 0.01, true, "of the snow, broadband"),
    MOMENT_ROW(wind_m_s, "m s-1", 0.1, false, "where the air goes, world x and z"),
    MOMENT_ROW(relative_humidity, "1", 0.01, true, "over water"),
    MOMENT_ROW(pressure_pa, "Pa", 10.0, true, "at the place"),
    MOMENT_ROW(visibility_m, "m", 10.0, false, "where 2 % of the contrast is left"),
    MOMENT_ROW(cloud_fraction, "1", 0.05, false, "share of the sky that is covered"),
    MOMENT_ROW(direct_normal_w_m2, "W m-2", 1.0, true, "sun on a plane that faces it"),
    MOMENT_ROW(diffuse_horizontal_w_m2, "W m-2", 1.0, true, "sky on flat ground"),
    MOMENT_ROW(longwave_down_w_m2, "W m-2", 1.0, true, "heat radiation of the sky"),
};
#undef MOMENT_ROW

/// The numbers of a row, in order.
inline const float* numbers_of(const WeatherMoment& moment, const MomentRow& row)
{
    return reinterpret_cast<const float*>(reinterpret_cast<const char*>(&moment) + row.offset);
}

namespace moment_check {
constexpr bool every_field_has_its_row()
{
    std::size_t next = 0;
    for (const MomentRow& row : kMomentRows) {
        if (row.offset != next) return false;
        next += row.numbers * sizeof(float);
    }
    return next == sizeof(WeatherMoment);
}
static_assert(every_field_has_its_row(), "give the new field its row, in the order of the struct");
}  // namespace moment_check

}  // namespace petrichor::shared

#endif

#endif
