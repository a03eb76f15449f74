#include "film/scenario/rule_tables.h"

#include "film/scenario/taps.h"
#include "film/scenario/tracks.h"

namespace petrichor::film {

std::vector<Rule> ground_rules()
{
    return {
        {{"ground", "patches", "true",
          "weather on every patch of the scene, with its own sun, sky, rain and wind; false: the "
          "same everywhere. Without this key true for weather files, and for presets and keys "
          "where [render] indirect is light of patches"},
         [](Scenario& s, const TomlValue& v) { s.ground.patches = v.boolean(); }},
        {{"ground", "materials", "[\"street*\"]",
          "materials that are ground wherever they lie; without it what lies lowest is"},
         [](Scenario& s, const TomlValue& v) { s.ground.ground = v.texts(); }},
        {{"ground", "not_materials", "[\"leaf*\"]",
          "materials that are neither ground nor stand in the way of water"},
         [](Scenario& s, const TomlValue& v) { s.ground.not_ground = v.texts(); }},
        {{"ground", "drains", "[[2.0, -1.5, 0.2]]",
          "where water leaves the ground: x, z and radius, metres"},
         [](Scenario& s, const TomlValue& v) {
             for (const TomlValue& one : v.elements()) {
                 const std::vector<double> n = one.numbers(3, -1e6, 1e6);
                 if (n[2] < 0.0) one.refuse("x, z and a radius of 0 or more");
                 s.ground.drains.emplace_back(n[0], n[1], n[2]);
             }
         }},
        {{"ground", "drain", "[{ x_z_m = [2.0, -1.5], radius_m = 0.2 }]",
          "the same as tables, [[ground.drain]]; those of both keys count"},
         [](Scenario& s, const TomlValue& v) {
             const std::vector<glm::dvec3> drains = read_drains(v);
             s.ground.drains.insert(s.ground.drains.end(), drains.begin(), drains.end());
         }},
        {{"ground", "tap",
          "[{ x_z_m = [2.0, -1.5], litres_per_min = 20.0, temperature_c = 10.0, from_s = 0.0, to_s = 2.0 }]",
          "water that is let in on the ground, where the weather has places; tables "
          "[[ground.tap]] do as well. It wets what it runs over, keeps it from freezing by its heat "
          "(temperature_c, 10 if not said) and fills the hollow below. A minute is that of a second of the film that is an "
          "hour (or what hours_per_second says), under keys and presets too; from_s and to_s are seconds of the film; "
          "without them it always runs"},
         [](Scenario& s, const TomlValue& v) { s.ground.taps = read_taps(v); }},
        {{"ground", "gutters", "true",
          "eaves more than 2 m up give nine tenths of their water to a gutter"},
         [](Scenario& s, const TomlValue& v) { s.ground.gutters = v.boolean(); }},
        {{"ground", "tracks",
          "[{ kind = \"tyre\", points_m = [[-4.0, 0.0, 1.0], [4.0, 0.0, 1.0]] }]",
          "what went through the snow: kind \"tyre\" or \"feet\", points_m of the way (bent "
          "smoothly), "
          "width_m of one, gauge_m between two tyres (0: one alone), depth 0 to 1; node = \"cart\" (a "
          "name, wildcards, or a list) in place of points_m: where that node of the file has gone near "
          "the ground by then (docs/places.md)"},
         [](Scenario& s, const TomlValue& v) { s.ground.tracks = read_tracks(v); }},

#define ROW(name, on, meaning)                                  \
    {{"render", #name, on ? "true" : "false", meaning},         \
     [](Scenario& s, const TomlValue& v) { s.render.name = v.boolean(); }},
        FRAME_SWITCHES(ROW)
#undef ROW
            {{"render", "lamp_shadows", "4",
              "so many lamps throw shadows, 0 to 16: those that give most light at the camera"},
             [](Scenario& s, const TomlValue& v) { s.render.lamp_shadows = v.integer(0, 16); }},
    };
}

}  // namespace petrichor::film
