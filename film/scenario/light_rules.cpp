#include "film/scenario/rule_tables.h"

#include <array>

namespace petrichor::film {

std::vector<Rule> light_rules()
{
    return {
        {{"lights", "lamps", "\"dusk\"",
          "point and spot lights and glowing materials: on, off, or on at dusk"},
         [](Scenario& s, const TomlValue& v) {
             s.lights.lamps = static_cast<Lamps>(v.choice({"on", "off", "dusk"}));
         }},
        {{"lights", "dusk_degrees", "4.0",
          "lamps are fully lit with the sun at this elevation or lower"},
         [](Scenario& s, const TomlValue& v) { s.lights.dusk_degrees = v.number(-90.0, 90.0); }},
        {{"lights", "dusk_fade_degrees", "4.0", "and dark this far above it, 0 to 90"},
         [](Scenario& s, const TomlValue& v) { s.lights.dusk_fade_degrees = v.number(0.0, 90.0); }},
        {{"lights", "emissive", "true", "glowing materials light what is around them"},
         [](Scenario& s, const TomlValue& v) { s.lights.emissive = v.boolean(); }},
        {{"lights", "lanterns", "true",
          "what stands within 0.35 m of a point lamp shades as softly as a lamp that fills its lantern; false: "
          "with the hard edges of a point"},
         [](Scenario& s, const TomlValue& v) { s.lights.lanterns = v.boolean(); }},
        {{"lights", "area", "\"ltc\"",
          "lamps with a size: ltc (linearly transformed cosines), nearest (the point nearest to "
          "what is "
          "mirrored, as Lux 2.02), or off (points)"},
         [](Scenario& s, const TomlValue& v) {
             s.lights.area = std::array{gpu::AreaLights::Ltc, gpu::AreaLights::Nearest,
                                        gpu::AreaLights::Off}[static_cast<std::size_t>(
                 v.choice({"ltc", "nearest", "off"}))];
         }},
        {{"lights", "scale", "1.0", "multiplies the lamps, 0 to 1e6"},
         [](Scenario& s, const TomlValue& v) { s.lights.scale = v.number(0.0, 1e6); }},
        {{"lights", "least_lux", "0.0",
          "lamps end where they give so many lux, 0.0001 to 1000; 0: by the exposure, where white paper "
          "would show a sixteenth of a code of them, never below 0.01"},
         [](Scenario& s, const TomlValue& v) {
             s.lights.least_lux = v.number(0.0, 1000.0);
             if (s.lights.least_lux > 0.0 && s.lights.least_lux < 1e-4) v.refuse("0, or 0.0001 to 1000");
         }},
    };
}

}  // namespace petrichor::film
