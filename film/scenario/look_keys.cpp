#include "film/scenario/look_keys.h"

#include <cstring>

namespace petrichor::film {

using shared::WeatherLook;

#define LOOK(field) #field, sizeof(WeatherLook::field) / sizeof(float)

const std::vector<LookKey>& look_keys()
{
    static const std::vector<LookKey> keys{
        {LOOK(snow_color), 0.0, 4.0, "[0.92, 0.94, 0.97]",
         "linear red, green and blue of snow; above 1 brighter than white",
         offsetof(WeatherLook, snow_color)},
        {LOOK(snow_specular), 0.0, 1.0, "[0.02, 0.02, 0.02]",
         "reflectance of snow seen straight on", offsetof(WeatherLook, snow_specular)},
        {LOOK(snow_tiling), 0.0, 100.0, "[0.35, 1.7, 0.09, 0.83]",
         "repeats per metre: relief of the snow, its detail, where it lies, detail of that",
         offsetof(WeatherLook, snow_tiling)},
        {LOOK(snow_strength), 0.0, 10.0, "[1.0, 0.25]",
         "bumpiness of the snow and of its detail, times the material's",
         offsetof(WeatherLook, snow_strength)},
        {LOOK(snow_scatter_color), 0.0, 4.0, "[0.0, 0.0, 0.0]",
         "linear colour by which snow is brighter towards grazing eyes; black: none",
         offsetof(WeatherLook, snow_scatter_color)},
        {LOOK(snow_scatter_bias), 0.0, 0.5, "0.0", "share of that at any angle",
         offsetof(WeatherLook, snow_scatter_bias)},
        {LOOK(snow_scatter_contraction), 1.0, 10.0, "8.0",
         "how far it is drawn towards the edge of a body", offsetof(WeatherLook, snow_scatter_contraction)},
        {LOOK(snow_line_ragged), 0.0, 10.0, "1.0",
         "how far the snow line (snow_start_height_m) runs up and down the slope, times twice "
         "snow_height_blending_km; 0: level, as Lux 2.02",
         offsetof(WeatherLook, snow_line_ragged)},
        {LOOK(snow_sparkle), 0.0, 1.0, "1.0",
         "how much of what snow mirrors of the sun is gathered on single crystals; 0: an even sheet, as Lux 2.02",
         offsetof(WeatherLook, snow_sparkle)},
        {LOOK(ground_variation), 0.0, 2.0, "1.0",
         "how far the colour of ground of 20 000 m2 and more varies over metres to a kilometre; 0: as its texture has it",
         offsetof(WeatherLook, ground_variation)},
        {LOOK(water_mud), 0.0, 50.0, "1.0",
         "mud in standing water over that of rain water in a street; 0: clear, 5: a dirt road's, 20: a flood's",
         offsetof(WeatherLook, water_mud)},
        {LOOK(ripple_tiling), 0.0, 100.0, "0.8", "repeats of the rings of rain per metre",
         offsetof(WeatherLook, ripple_tiling)},
        {LOOK(ripple_speed), 0.0, 10.0, "1.0", "of the rings; 1 as photographed",
         offsetof(WeatherLook, ripple_speed)},
        {LOOK(ripple_refraction), 0.0, 10.0, "0.05", "how far rings shift what lies below",
         offsetof(WeatherLook, ripple_refraction)},
        {LOOK(ripple_strength), 0.0, 4.0, "0.35", "slope of the rings",
         offsetof(WeatherLook, ripple_strength)},
        {LOOK(detail_distance_m), 0.0, 1e6, "50.0",
         "ripples, flow and the snow's detail are gone from this far on",
         offsetof(WeatherLook, detail_distance_m)},
        {LOOK(detail_fade_m), 0.0, 1e6, "15.0", "and fade over this much before it",
         offsetof(WeatherLook, detail_fade_m)},
    };
    return keys;
}
#undef LOOK

shared::WeatherLook look_at(const ScenarioLook& look, double time_s)
{
    WeatherLook result;
    for (const auto& [name, channels] : look) {
        for (const LookKey& key : look_keys()) {
            if (key.name != name) continue;
            for (std::size_t i = 0; i < key.count; ++i) {
                const auto value = static_cast<float>(value_at(channels[i], time_s));
                std::memcpy(reinterpret_cast<char*>(&result) + key.offset + i * sizeof(float),
                            &value, sizeof value);
            }
        }
    }
    return result;
}

}  // namespace petrichor::film
