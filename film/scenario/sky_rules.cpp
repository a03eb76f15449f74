#include "film/scenario/rule_tables.h"

namespace petrichor::film {

std::vector<Rule> sky_rules()
{
    return {
        {{"sun", "source", "\"sky\"",
          "sky: a sun that matches the sky; scene: the directional lights of the scene instead"},
         [](Scenario& s, const TomlValue& v) {
             s.sun.from_scene = v.choice({"sky", "scene"}) == 1;
         }},
        {{"sun", "elevation_degrees", "35.0",
          "height above the horizon, -90 to 90; without it and a time of day, a weather file's "
          "place and clock decide",
          true, true},
         [](Scenario& s, const TomlValue& v) { s.sun.elevation_degrees = v.keyed(-90.0, 90.0); }},
        {{"sun", "azimuth_degrees", "140.0",
          "clockwise from north (-z, see north_degrees) over east; go past 360 rather than back to "
          "0",
          true, true},
         [](Scenario& s, const TomlValue& v) { s.sun.azimuth_degrees = v.keyed(-3600.0, 3600.0); }},
        {{"sun", "time_of_day_hours", "[[0.0, 14.0], [48.0, 18.5]]",
          "local solar time instead of elevation and azimuth, 0 to 24 (48 is the next midnight)",
          true},
         [](Scenario& s, const TomlValue& v) {
             s.sun.time_of_day_hours = v.keyed(-240.0, 2400.0);
         }},
        {{"sun", "latitude_degrees", "50.0", "with time_of_day_hours: -90 south to 90 north"},
         [](Scenario& s, const TomlValue& v) { s.sun.latitude_degrees = v.number(-90.0, 90.0); }},
        {{"sun", "day_of_year", "80", "with time_of_day_hours: 1 to 366; 80 is the spring equinox"},
         [](Scenario& s, const TomlValue& v) { s.sun.day_of_year = v.number(1.0, 366.0); }},
        {{"sun", "illuminance_lux", "100000.0",
          "of a clear sun on a plane that faces it, 0 to 200000; with source = \"scene\" of the sun of "
          "the sky, which otherwise is as bright as the scene's, up to that"},
         [](Scenario& s, const TomlValue& v) { s.sun.illuminance_lux = v.number(0.0, 200000.0); }},
        {{"sun", "cookie", "\"leaves.png\"",
          "a picture that the sun shines through, repeated: shadows of leaves, bars, clouds; black "
          "keeps it "
          "away, colours tint it"},
         [](Scenario& s, const TomlValue& v) { s.sun.cookie = v.text(); }},
        {{"sun", "cookie_size_m", "8.0",
          "side of that picture on a plane that faces the sun, 0.01 to 100000; its top is towards "
          "the sky",
          true},
         [](Scenario& s, const TomlValue& v) { s.sun.cookie_size_m = v.keyed(0.01, 1e5); }},
        {{"sun", "shadow_strength", "1.0",
          "share of its light that shadows of sun and moon take away: 1 all of it, 0 there are none; 0 to 1",
          true},
         [](Scenario& s, const TomlValue& v) { s.sun.shadow_strength = v.keyed(0.0, 1.0); }},

        {{"sky", "cloud_cover", "[[0.0, 0.9], [24.0, 0.4]]",
          "0 clear to 1 overcast; without it the weather decides", true},
         [](Scenario& s, const TomlValue& v) { s.sky.cloud_cover = v.keyed(0.0, 1.0); }},
        {{"sky", "turbidity", "2.5", "haze: 1.5 very clear to 10", true},
         [](Scenario& s, const TomlValue& v) { s.sky.turbidity = v.keyed(1.0, 10.0); }},
        {{"sky", "environment", "\"sky.hdr\"",
          "a lat-long HDR picture (.hdr, .exr) that lights the scene instead of the analytic sky"},
         [](Scenario& s, const TomlValue& v) { s.sky.environment = v.text(); }},
        {{"sky", "environment_decode", "\"auto\"",
          "how its numbers are meant: auto (float as it is, 8 bits as sRGB), float, rgbm (8 bits, "
          "multiplier in alpha, up to 34.5) or dldr (8 bits, up to 4.6)"},
         [](Scenario& s, const TomlValue& v) {
             s.sky.environment_decode =
                 static_cast<LightCode>(v.choice({"auto", "float", "rgbm", "dldr"}));
         }},
        {{"sky", "environment_scale", "1.0", "multiplies the HDR picture, 0 to 1e6"},
         [](Scenario& s, const TomlValue& v) { s.sky.environment_scale = v.number(0.0, 1e6); }},
        {{"sky", "environment_rotation_degrees", "0.0", "turns the HDR picture about the vertical"},
         [](Scenario& s, const TomlValue& v) {
             s.sky.environment_rotation_degrees = v.number(-3600.0, 3600.0);
         }},
        {{"sky", "ground_albedo", "0.2",
          "of the land beyond the scene, 0 to 1; without it land that is seen beyond the scene's own ground "
          "looks as that ground does at its rim"},
         [](Scenario& s, const TomlValue& v) {
             s.sky.ground_albedo = v.number(0.0, 1.0);
             s.sky.land_as_ground = false;
         }},
        {{"sky", "skyline", "true",
          "trees, woods and low hills stand where the land beyond the scene ends, behind all of the scene; not under "
          "an environment and not around scenes of more than 2.5 km"},
         [](Scenario& s, const TomlValue& v) { s.sky.skyline = v.boolean(); }},

        {{"moon", "elevation_degrees", "40.0",
          "height above the horizon, -90 to 90; without it where a weather file's place and clock "
          "have it",
          true},
         [](Scenario& s, const TomlValue& v) { s.moon.elevation_degrees = v.keyed(-90.0, 90.0); }},
        {{"moon", "azimuth_degrees", "200.0", "clockwise from north; likewise", true},
         [](Scenario& s, const TomlValue& v) {
             s.moon.azimuth_degrees = v.keyed(-3600.0, 3600.0);
         }},
        {{"moon", "illuminated", "1.0", "share of its disc that is lit, 0 to 1; likewise", true},
         [](Scenario& s, const TomlValue& v) { s.moon.illuminated = v.keyed(0.0, 1.0); }},

        {{"fog", "mode", "\"metres\"",
          "metres (2 % contrast left at the visibility), exp, exp2, linear, or off; it veils the "
          "analytic sky too"},
         [](Scenario& s, const TomlValue& v) {
             s.fog.mode =
                 static_cast<gpu::FogMode>(v.choice({"off", "metres", "exp", "exp2", "linear"}));
         }},
        {{"fog", "visibility_m", "400.0", "with metres; without it the weather decides, 1 to 1e6",
          true},
         [](Scenario& s, const TomlValue& v) { s.fog.visibility_m = v.keyed(1.0, 1e6); }},
        {{"fog", "per_m", "0.01", "with exp: extinction, with exp2: density, 0 to 10 a metre",
          true},
         [](Scenario& s, const TomlValue& v) { s.fog.per_m = v.keyed(0.0, 10.0); }},
        {{"fog", "start_m", "0.0", "with linear: where it begins ..", true},
         [](Scenario& s, const TomlValue& v) { s.fog.start_m = v.keyed(0.0, 1e6); }},
        {{"fog", "end_m", "100.0", ".. and where it hides all", true},
         [](Scenario& s, const TomlValue& v) { s.fog.end_m = v.keyed(0.0, 1e6); }},
        {{"fog", "height_m", "120.0",
          "it thins out to 1/e over this height above the scene's lowest point; 0: it has no top",
          true},
         [](Scenario& s, const TomlValue& v) { s.fog.height_m = v.keyed(0.0, 1e5); }},
        {{"fog", "mist_per_m", "0.5",
          "mist that rises from wet ground, a few hands high: its extinction at the ground, 0 to 10 a metre; without it "
          "the physical model decides, by how much warmer than the air the ground is",
          true},
         [](Scenario& s, const TomlValue& v) { s.fog.mist_per_m = v.keyed(0.0, 10.0); }},
    };
}

}  // namespace petrichor::film
