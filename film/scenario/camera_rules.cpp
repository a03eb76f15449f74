#include "film/scenario/rule_tables.h"

namespace petrichor::film {
namespace {

std::vector<CameraKey> camera_path(const TomlValue& value)
{
    std::vector<CameraKey> path;
    for (const TomlValue& element : value.elements()) {
        CameraKey key;
        bool timed = false;
        for (const auto& [name, entry] :
             element.entries({"time_s", "position_m", "look_at_m", "fov_degrees"})) {
            if (name == "time_s") {
                key.time_s = entry.number(-1e9, 1e9);
                timed = true;
            }
            if (name == "position_m") key.position_m = entry.point();
            if (name == "look_at_m") key.look_at_m = entry.point();
            if (name == "fov_degrees") key.fov_degrees = entry.number(1.0, 170.0);
        }
        if (!timed || !key.position_m || !key.look_at_m) {
            element.refuse("a table with time_s, position_m and look_at_m");
        }
        if (!path.empty() && key.time_s <= path.back().time_s) {
            element.refuse("later than the key before it");
        }
        path.push_back(key);
    }
    if (path.empty()) value.refuse("at least one key");
    return path;
}

// [camera] position_m, look_at_m and fov_degrees without keys make a path of one key.
CameraKey& still_camera(Scenario& s)
{
    if (s.camera.keys.empty()) s.camera.keys.emplace_back();
    return s.camera.keys.front();
}

}  // namespace

std::vector<Rule> camera_rules()
{
    return {
        {{"camera", "name", "\"Camera\"",
          "a camera of the scene; without one the whole scene is framed"},
         [](Scenario& s, const TomlValue& v) { s.camera.name = v.text(); }},
        {{"camera", "position_m", "[6.0, 2.0, 8.0]",
          "where a camera of your own stands: x, y (up), z"},
         [](Scenario& s, const TomlValue& v) { still_camera(s).position_m = v.point(); }},
        {{"camera", "look_at_m", "[0.0, 1.0, 0.0]", "the point it looks at"},
         [](Scenario& s, const TomlValue& v) { still_camera(s).look_at_m = v.point(); }},
        {{"camera", "fov_degrees", "45.0", "vertical field of view, 1 to 170"},
         [](Scenario& s, const TomlValue& v) {
             still_camera(s).fov_degrees = v.number(1.0, 170.0);
         }},
        {{"camera", "keys",
          "[{ time_s = 0.0, position_m = [6.0, 2.0, 8.0], look_at_m = [0.0, 1.0, 0.0], fov_degrees "
          "= 45.0 },\n"
          "    { time_s = 48.0, position_m = [4.0, 1.6, 7.0], look_at_m = [0.0, 1.0, 0.0], "
          "fov_degrees = 40.0 }]",
          "a camera that moves: one entry a point of the path"},
         [](Scenario& s, const TomlValue& v) { s.camera.keys = camera_path(v); }},
        {{"camera", "interpolation", "\"smooth\"", "between keys: hold, linear or smooth"},
         [](Scenario& s, const TomlValue& v) { s.camera.interpolation = v.interpolation(); }},
        {{"camera", "near_m", "0.05", "nothing nearer than this is drawn, metres"},
         [](Scenario& s, const TomlValue& v) { s.camera.near_m = v.number(1e-4, 1e4); }},
        {{"camera", "shift", "[0.0, 0.3]",
          "of the lens, right and up, in halves of the picture's width and height, -4 to 4: a camera that looks level "
          "shows a tower whole and its verticals upright"},
         [](Scenario& s, const TomlValue& v) {
             const auto shift = v.numbers(2, -4.0, 4.0);
             s.camera.shift = {shift[0], shift[1]};
         }},
        {{"camera", "exposure", "1.0e-4",
          "of the PNG: \"auto\" (metered from the picture; as without this key), \"incident\" "
          "(from the "
          "light of sun and sky on the ground), \"fixed\" (by ev100), or a number: its linear "
          "scale",
          true},
         [](Scenario& s, const TomlValue& v) {
             s.camera.exposure = {};
             if (v.is_text()) {
                 s.camera.exposure_mode =
                     static_cast<Exposure>(v.choice({"auto", "incident", "fixed"}));
             } else {
                 s.camera.exposure_mode = Exposure::Fixed;
                 s.camera.exposure = v.keyed(1e-12, 1e12);
             }
         }},
        {{"camera", "ev100", "12.0",
          "fixes the exposure: exposure value at ISO 100; sunlight 15, a lit street 4, full moon "
          "-3; "
          "-20 to 40",
          true},
         [](Scenario& s, const TomlValue& v) { s.camera.ev100 = v.keyed(-20.0, 40.0); }},
        {{"camera", "ev100_limits", "[-6.0, 18.0]",
          "with exposure = \"auto\": it never sets less or more than these"},
         [](Scenario& s, const TomlValue& v) {
             const auto limits = v.numbers(2, -20.0, 40.0);
             if (limits[0] > limits[1]) v.refuse("the lower limit first");
             s.camera.ev100_low = limits[0];
             s.camera.ev100_high = limits[1];
         }},
        {{"camera", "exposure_smoothing_s", "0.25",
          "with exposure = \"auto\": frames up to this far before and after are metered too, "
          "seconds of the film, 0 to 4; at most an eighth of the frames, and half an hour of a weather file"},
         [](Scenario& s, const TomlValue& v) {
             s.camera.exposure_smoothing_s = v.number(0.0, 4.0);
         }},
        {{"camera", "exposure_bias", "0.0", "stops brighter (+) or darker (-), -10 to 10", true},
         [](Scenario& s, const TomlValue& v) { s.camera.exposure_bias = v.keyed(-10.0, 10.0); }},
        {{"camera", "shutter_s", "0.004",
          "how long the shutter is open: rain is seen as streaks as long as its way in this time, "
          "1e-5 "
          "to 1",
          true},
         [](Scenario& s, const TomlValue& v) { s.camera.shutter_s = v.keyed(1e-5, 1.0); }},
        {{"camera", "f_stop", "2.8",
          "aperture of the lens: what is not at focus_m blurs, by as many samples as it is wide in "
          "pixels; "
          "without it all is sharp; 0.1 to 1000",
          true},
         [](Scenario& s, const TomlValue& v) { s.camera.f_stop = v.keyed(0.1, 1000.0); }},
        {{"camera", "focus_m", "5.0",
          "distance of what is sharp with f_stop, along the view, 0.01 to 1e6", true},
         [](Scenario& s, const TomlValue& v) { s.camera.focus_m = v.keyed(0.01, 1e6); }},
        {{"camera", "sensor_mm", "24.0",
          "height of the sensor: with the field of view it gives the lens of f_stop its focal "
          "length, 1 to "
          "1000"},
         [](Scenario& s, const TomlValue& v) { s.camera.sensor_mm = v.number(1.0, 1000.0); }},
        {{"camera", "white_balance_k", "5000.0",
          "of the PNG: light of this colour temperature becomes white, 1667 to 25000 K; 0: as it "
          "is; \"auto\": the light that falls on what is seen, in this frame and those around it",
          true},
         [](Scenario& s, const TomlValue& v) {
             s.camera.white_balance_k = {};
             s.camera.white_balance_auto = v.is_text();
             if (v.is_text()) {
                 v.choice({"auto"});
             } else {
                 s.camera.white_balance_k = v.keyed(0.0, 25000.0);
             }
         }},
        {{"camera", "white_balance_strength", "0.8",
          "with white_balance_k = \"auto\": share of the light's cast that is taken away, 0 to 1; what is left "
          "keeps a dusk blue and a lamp warm",
          true},
         [](Scenario& s, const TomlValue& v) { s.camera.white_balance_strength = v.keyed(0.0, 1.0); }},
        {{"camera", "bloom", "0.04",
          "of the PNG: share of the light that the lens scatters around, so that lamps glow, 0 to "
          "1",
          true},
         [](Scenario& s, const TomlValue& v) { s.camera.bloom = v.keyed(0.0, 1.0); }},
        {{"camera", "wet_lens", "0.8",
          "of the PNG: drops on the glass of the lens while it rains, 0 none to 1", true},
         [](Scenario& s, const TomlValue& v) { s.camera.wet_lens = v.keyed(0.0, 1.0); }},
    };
}

}  // namespace petrichor::film
