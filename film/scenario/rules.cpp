#include "film/scenario/rules.h"

#include <array>
#include "film/scenario/probe_keys.h"
#include "film/scenario/tracks.h"
#include "texproc/prefilter/rules.h"

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

// Keys of [weather] that weather_script_from reads and checks.
void read_by_the_script(Scenario&, const TomlValue&)
{
}

}  // namespace

const std::vector<Rule>& rules()
{
    static const std::vector<Rule> table{
        {{"scene", "file", "\"scene.glb\"",
          "glTF scene (.glb, .gltf), relative to this file; \"demo:street\" is the generated demo, "
          "\"demo:stage\" a stage for materials and lamps",
          false, true},
         [](Scenario& s, const TomlValue& v) { s.scene.file = v.text(); }},
        {{"scene", "demo_seed", "1", "which street the demo generator builds"},
         [](Scenario& s, const TomlValue& v) {
             s.scene.demo_seed = static_cast<std::uint32_t>(v.integer(0, 1 << 30));
         }},
        {{"scene", "max_texture", "4096",
          "larger textures are reduced to this many texels a side, 16 to 16384"},
         [](Scenario& s, const TomlValue& v) { s.scene.max_texture = v.integer(16, 16384); }},
        {{"scene", "texture_rule", "\"picture\"",
          "how small levels of normals and roughness are made together, as `texture build --rule`: "
          "picture, median, lean, .., or none, plain mips; textures with levels of their own keep "
          "them"},
         [](Scenario& s, const TomlValue& v) {
             std::vector<std::string> words;
             for (const texproc::Rule& rule : texproc::rules()) words.push_back(rule.name);
             s.scene.texture_rule = words[static_cast<std::size_t>(v.choice(words))];
         }},
        {{"scene", "ground", "\"auto\"",
          "what the scene stands on: plane, level ground out to the horizon (material \"default "
          "ground\"); none; or auto, a plane where the scene brings no ground"},
         [](Scenario& s, const TomlValue& v) {
             s.scene.ground = static_cast<StandsOn>(v.choice({"auto", "plane", "none"}));
         }},
        {{"scene", "north_degrees", "0.0",
          "where north lies in the scene: clockwise from -z towards +x; turns sun and wind"},
         [](Scenario& s, const TomlValue& v) { s.scene.north_degrees = v.number(-360.0, 360.0); }},
        {{"scene", "variant", "\"\"",
          "a variant of the scene's materials (KHR_materials_variants); \"\": as the file has "
          "them"},
         [](Scenario& s, const TomlValue& v) { s.scene.variant = v.text(); }},
        {{"scene", "animation", "\"all\"",
          "which of the scene's animations play over the film: all, none, or the name of one"},
         [](Scenario& s, const TomlValue& v) {
             s.scene.animation = v.text();
             if (s.scene.animation.empty()) v.refuse("all, none, or the name of an animation");
         }},
        {{"scene", "animation_speed", "1.0",
          "seconds of the animation for a second of the film, -1000 to 1000; 0: it stands still"},
         [](Scenario& s, const TomlValue& v) {
             s.scene.animation_speed = v.number(-1000.0, 1000.0);
         }},
        {{"scene", "animation_start_s", "0.0", "moment of the animation that frame 0 shows"},
         [](Scenario& s, const TomlValue& v) { s.scene.animation_start_s = v.number(-1e6, 1e6); }},
        {{"scene", "animation_loop", "true",
          "each begins again when it ends; false: it stays as it ended"},
         [](Scenario& s, const TomlValue& v) { s.scene.animation_loop = v.boolean(); }},

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

        {{"weather", "preset", "\"rain-then-snow\"",
          "a name that `petrichor doctor` lists, or a .toml file with a [weather] table", false,
          true},
         [](Scenario& s, const TomlValue& v) {
             s.weather.preset = v.text();
             if (s.weather.preset.empty()) v.refuse("the name of a preset or a file");
         }},
        {{"weather", "file", "\"denver.epw\"",
          "or a weather file (EPW, METAR, CSV, .. as `petrichor simulate` reads): sun, clouds, "
          "wind "
          "and sight follow it"},
         [](Scenario& s, const TomlValue& v) {
             s.weather.file = v.text();
             if (s.weather.file.empty()) v.refuse("the name of a weather file");
         }},
        {{"weather", "model", "\"auto\"",
          "physical (SI: energy and water balance), artist (0..1), or auto: physical for a file"},
         [](Scenario& s, const TomlValue& v) {
             s.weather.model = static_cast<WeatherModel>(v.choice({"auto", "artist", "physical"}));
         }},
        {{"weather", "start", "\"01-10\"",
          "when in the file the clock's 0 s is: ISO 8601 (without a zone by the clock of its place), month and "
          "day, or seconds; else its first row"},
         [](Scenario& s, const TomlValue& v) { s.weather.start = v.text(); }},
        {{"weather", "end", "\"01-12\"", "and when the film ends, unless output.duration_s says"},
         [](Scenario& s, const TomlValue& v) { s.weather.end = v.text(); }},
        {{"weather", "hours_per_second", "1.0",
          "hours of the file for a second of the clock, 0.0001 to 10000"},
         [](Scenario& s, const TomlValue& v) { s.weather.hours_per_second = v.number(1e-4, 1e4); }},
        {{"weather", "surface", "\"asphalt\"",
          "of the physical model: concrete, paving_stones, cobblestone, brick, soil, grass, .."},
         [](Scenario& s, const TomlValue& v) { s.weather.site.surface = v.text(); }},
        {{"weather", "spin_up_days", "30.0",
          "the physical model begins this long before `start`; else with the file's first row"},
         [](Scenario& s, const TomlValue& v) { s.weather.spin_up_days = v.number(0.0, 36500.0); }},
        {{"weather", "max_gap_days", "60.0",
          "longest time between two rows of the file; longer ones are refused"},
         [](Scenario& s, const TomlValue& v) { s.weather.site.max_gap_days = v.number(0.0, 1e6); }},
        {{"weather", "date_order", "\"dmy\"",
          "or mdy: of dates such as 01/02/2024 where no row of the file shows which"},
         [](Scenario& s, const TomlValue& v) {
             constexpr const char* kOrders[] = {"dmy", "mdy"};
             s.weather.site.date_order = kOrders[v.choice({"dmy", "mdy"})];
         }},
        {{"weather", "latitude_degrees", "45.3", "north; where the file does not say"},
         [](Scenario& s, const TomlValue& v) {
             s.weather.site.latitude_deg = v.number(-90.0, 90.0);
         }},
        {{"weather", "longitude_degrees", "5.77", "east; likewise"},
         [](Scenario& s, const TomlValue& v) {
             s.weather.site.longitude_deg = v.number(-180.0, 360.0);
         }},
        {{"weather", "elevation_m", "1325.0", "above the sea; likewise"},
         [](Scenario& s, const TomlValue& v) {
             s.weather.site.elevation_m = v.number(-450.0, 9000.0);
         }},
        {{"weather", "station", "\"EGLL\"", "of a METAR file; else the one with most reports"},
         [](Scenario& s, const TomlValue& v) { s.weather.site.station = v.text(); }},
        {{"weather", "month", "\"2024-02\"", "of METAR reports, which say only the day"},
         [](Scenario& s, const TomlValue& v) { s.weather.site.month = v.text(); }},
        {{"weather", "keys",
          "[\n"
          "    { time_s = 0.0, temperature_c = 12.0, rainfall = 0.0, cloud_cover = 0.3 },\n"
          "    { time_s = 10.0, rainfall = 0.8, cloud_cover = 0.9, wind_m_s = 6.0, wind_from_deg = "
          "240.0 },\n"
          "    { time_s = 30.0, temperature_c = -6.0, visibility_m = 2000.0 },\n"
          "]",
          "or keys of your own (rainfall 0 to 1, or rain_mm_h; snow below 0 C)"},
         read_by_the_script},
        {{"weather", "interpolation", "\"linear\"", "between these keys: hold, linear or smooth"},
         read_by_the_script},
        {{"weather", "duration_s", "48.0", "of these keys; else to the last"}, read_by_the_script},
        {{"weather", "loop", "false", "begin these keys again when they end, for ever"},
         read_by_the_script},

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

        {{"ground", "patches", "true",
          "weather on every patch of the scene, with its own sun, sky, rain and wind; false: the "
          "same everywhere. Without this key true for weather files"},
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
             s.ground.drains.clear();
             for (const TomlValue& one : v.elements()) {
                 const std::vector<double> n = one.numbers(3, -1e6, 1e6);
                 if (n[2] < 0.0) one.refuse("x, z and a radius of 0 or more");
                 s.ground.drains.emplace_back(n[0], n[1], n[2]);
             }
         }},
        {{"ground", "gutters", "true",
          "eaves more than 2 m up give nine tenths of their water to a gutter"},
         [](Scenario& s, const TomlValue& v) { s.ground.gutters = v.boolean(); }},
        {{"ground", "tracks",
          "[{ kind = \"tyre\", points_m = [[-4.0, 0.0, 1.0], [4.0, 0.0, 1.0]] }]",
          "what went through the snow: kind \"tyre\" or \"feet\", points_m of the way (bent "
          "smoothly), "
          "width_m of one, gauge_m between two tyres (0: one alone), depth 0 to 1"},
         [](Scenario& s, const TomlValue& v) { s.ground.tracks = read_tracks(v); }},

#define ROW(name, on, meaning)                                  \
    {{"render", #name, on ? "true" : "false", meaning},         \
     [](Scenario& s, const TomlValue& v) { s.render.name = v.boolean(); }},
        FRAME_SWITCHES(ROW)
#undef ROW
            {{"render", "lamp_shadows", "4",
              "so many lamps throw shadows, 0 to 16: those that give most light at the camera"},
             [](Scenario& s, const TomlValue& v) { s.render.lamp_shadows = v.integer(0, 16); }},
        {{"render", "transparent_layers", "4",
          "so many surfaces behind each other that let light through are blended, 0 to 8; what "
          "lies "
          "deeper, with 0 all of it, is seen or not by chance, a sample at a time"},
         [](Scenario& s, const TomlValue& v) { s.render.transparent_layers = v.integer(0, 8); }},
        {{"render", "falling_budget", "20000",
          "about so many drops and flakes are drawn one by one, those that hide most, 0 to "
          "1000000; "
          "the others dim what lies behind them"},
         [](Scenario& s, const TomlValue& v) { s.render.falling_budget = v.integer(0, 1000000); }},
        {{"render", "falling_density", "1.0",
          "multiplies how many there are in the air, 0 to 10; 1: as the weather says"},
         [](Scenario& s, const TomlValue& v) { s.render.falling_density = v.number(0.0, 10.0); }},
        {{"render", "tone_map", "\"filmic\"",
          "of the PNG: filmic, agx, aces, neutral (Khronos), linear (plain sRGB); true is filmic, "
          "false linear. The EXR is never tone mapped"},
         [](Scenario& s, const TomlValue& v) {
             s.render.tone_map = v.is_text()
                                     ? static_cast<gpu::ToneMap>(v.choice(
                                           {"linear", "filmic", "agx", "aces", "neutral"}))
                                 : v.boolean() ? gpu::ToneMap::Filmic
                                               : gpu::ToneMap::Linear;
         }},
        {{"render", "ripple_texture_size", "512",
          "texels a side of the map of rings that rain draws: 64, 128 .. 4096"},
         [](Scenario& s, const TomlValue& v) {
             s.render.ripple_texture_size = v.integer(64, 4096);
             if ((s.render.ripple_texture_size & (s.render.ripple_texture_size - 1)) != 0)
                 v.refuse("a power of two from 64 to 4096");
         }},
        {{"render", "ripple_texture", "\"ripple.png\"",
          "drops of rain to use instead of drawn ones, laid out as `texture generate ripple`"},
         [](Scenario& s, const TomlValue& v) { s.render.weather_textures.ripple = v.text(); }},
        {{"render", "snow_mask_texture", "\"snow_mask.png\"",
          "where snow lies first: its blue, or a grey picture (`texture generate snow_mask`)"},
         [](Scenario& s, const TomlValue& v) { s.render.weather_textures.snow_mask = v.text(); }},
        {{"render", "snow_water_bump_texture", "\"snow_water_bump.png\"",
          "relief of snow and waves of moving water: alpha and green a normal, blue the smoothness "
          "of snow (`texture generate snow_water_bump`)"},
         [](Scenario& s, const TomlValue& v) {
             s.render.weather_textures.snow_water_bump = v.text();
         }},
        {{"render", "occlusion_direct", "0.0",
          "how much occlusion maps darken sun and lamps too, 0 to 1; they always darken the sky"},
         [](Scenario& s, const TomlValue& v) { s.render.occlusion_direct = v.number(0.0, 1.0); }},
        {{"render", "ambient_fit", "\"table\"",
          "how strongly surroundings are mirrored: table (GGX, integrated) or lazarov (the fit of "
          "Lux "
          "2.02)"},
         [](Scenario& s, const TomlValue& v) {
             s.render.lazarov = v.choice({"table", "lazarov"}) == 1;
         }},
        {{"render", "horizon_fade", "0.0",
          "mirrors darken where their ray would enter the mesh below a normal map, so fast: 0 off, "
          "1.3 "
          "as Lux 2.02, to 8"},
         [](Scenario& s, const TomlValue& v) { s.render.horizon_fade = v.number(0.0, 8.0); }},
        {{"render", "specular_aa", "1.0",
          "times the variance of normals inside a pixel, which widens highlights: 0 off to 4"},
         [](Scenario& s, const TomlValue& v) { s.render.specular_aa = v.number(0.0, 4.0); }},
        {{"render", "specular_aa_limit", "0.18", "and at most so much of it, 0 to 1"},
         [](Scenario& s, const TomlValue& v) { s.render.specular_aa_limit = v.number(0.0, 1.0); }},
        {{"render", "anisotropic_dither", "0.0",
          "anisotropic materials mirror their surroundings drawn out along their grain, each "
          "sample "
          "another part of it: 0 not (one bent normal) to 1 as far as their highlights; grainy at "
          "few "
          "samples"},
         [](Scenario& s, const TomlValue& v) { s.render.anisotropic_dither = v.number(0.0, 1.0); }},
        {{"render", "anisotropic_dither_distance_m", "50.0", "up to so far from the camera"},
         [](Scenario& s, const TomlValue& v) {
             s.render.anisotropic_dither_distance_m = v.number(0.0, 10000.0);
         }},
        {{"render", "anisotropic_dither_fade_m", "15.0", "over the last of which it fades"},
         [](Scenario& s, const TomlValue& v) {
             s.render.anisotropic_dither_fade_m = v.number(0.0, 10000.0);
         }},
        {{"render", "adaptive", "0.02",
          "pixels whose first two samples differ by less, of the display's range, take no further "
          "ones: "
          "0 (all samples everywhere) to 1"},
         [](Scenario& s, const TomlValue& v) { s.render.adaptive = v.number(0.0, 1.0); }},
        {{"render", "lod_scale", "1.0",
          "levels of detail (glTF MSFT_lod) are chosen as if things were so much larger, 0.01 to "
          "100"},
         [](Scenario& s, const TomlValue& v) { s.render.lod_scale = v.number(0.01, 100.0); }},
        {{"render", "color_space", "\"linear\"",
          "gamma: lights colours as the sRGB codes that they are stored as and shows the sums as "
          "codes, without tone mapping; to compare with engines that work so. The EXR holds codes"},
         [](Scenario& s, const TomlValue& v) {
             s.render.gamma = v.choice({"linear", "gamma"}) == 1;
         }},
        {{"render", "indirect", "\"auto\"",
          "light from other surfaces: patches (traced once, solved each frame), ambient (skylight "
          "and "
          "a constant), or auto: patches for scenes of up to a million triangles"},
         [](Scenario& s, const TomlValue& v) {
             s.render.indirect =
                 static_cast<IndirectLight>(v.choice({"auto", "patches", "ambient"}));
         }},
        {{"render", "probes", "\"auto\"",
          "what smooth surfaces mirror of the scene beyond the picture, with light of patches: "
          "auto (up "
          "to 4 reflection probes, placed over the ground), off (the sky), or up to 8 of your own: "
          "[{ position_m = [0.0, 1.6, 0.0], low_m = [-4.0, 0.0, -3.0], high_m = [4.0, 3.0, 3.0], "
          "blend_m = 1.0, importance = 0.0, intensity = 1.0 }]; low_m and high_m are the walls "
          "around; "
          "picture = \"room.hdr\" (lat-long, cd/m2; decode as of [sky] environment_decode) stands "
          "for "
          "what would be traced"},
         [](Scenario& s, const TomlValue& v) { s.render.probes = read_probes(v); }},
        {{"render", "surface_path", "\"auto\"",
          "how surfaces are shaded: fragment, visibility (a buffer of triangle numbers, resolved), "
          "or auto, the faster on this device"},
         [](Scenario& s, const TomlValue& v) {
             s.render.surface_path =
                 static_cast<gpu::SurfacePath>(v.choice({"auto", "fragment", "visibility"}));
         }},
        {{"render", "lighting_path", "\"prepass\"",
          "of lighting models of your own: prepass (light is gathered first and composed with the material "
          "once, by models that have NAME_gather and NAME_compose; others answer light by light), or "
          "forward (all answer light by light)"},
         [](Scenario& s, const TomlValue& v) {
             s.render.light_prepass = v.choice({"prepass", "forward"}) == 0;
         }},

        {{"output", "width", "640", "pixels, 1 to 16384", false, true},
         [](Scenario& s, const TomlValue& v) { s.output.width = v.integer(1, 16384); }},
        {{"output", "height", "360", "pixels, 1 to 16384", false, true},
         [](Scenario& s, const TomlValue& v) { s.output.height = v.integer(1, 16384); }},
        {{"output", "samples", "8", "a pixel, for smooth edges, 1 to 256", false, true},
         [](Scenario& s, const TomlValue& v) { s.output.samples = v.integer(1, 256); }},
        {{"output", "seed", "1", "of the sample pattern"},
         [](Scenario& s, const TomlValue& v) {
             s.output.seed = static_cast<std::uint32_t>(v.integer(0, 1 << 30));
         }},
        {{"output", "frames", "48", "number of frames, 1 to 1000000", false, true},
         [](Scenario& s, const TomlValue& v) { s.output.frames = v.integer(1, 1000000); }},
        {{"output", "fps", "12.0", "frames a second of the film; also the clock of ripples", false,
          true},
         [](Scenario& s, const TomlValue& v) { s.output.fps = v.number(0.01, 1000.0); }},
        {{"output", "start_s", "0.0", "time of frame 0 on the clock of weather, sun and camera"},
         [](Scenario& s, const TomlValue& v) { s.output.start_s = v.number(-1e9, 1e9); }},
        {{"output", "duration_s", "48.0",
          "from frame 0 to one frame after the last on that clock; without it as long as the "
          "weather"},
         [](Scenario& s, const TomlValue& v) { s.output.duration_s = v.number(0.0, 1e9); }},
        {{"output", "exr", "true", "write frame_0000.exr: linear light, half float, all AOVs"},
         [](Scenario& s, const TomlValue& v) { s.output.exr = v.boolean(); }},
        {{"output", "png", "true", "write frame_0000.png: as seen, 8 bits"},
         [](Scenario& s, const TomlValue& v) { s.output.png = v.boolean(); }},
        {{"output", "film", "true", "write film.mp4 where ffmpeg is installed (needs the PNGs)"},
         [](Scenario& s, const TomlValue& v) { s.output.film = v.boolean(); }},
        {{"output", "aovs", "[]",
          "images beside the picture in the EXR; `petrichor render --list-aovs` names them"},
         [](Scenario& s, const TomlValue& v) { s.output.aovs = v.texts(); }},
    };
    return table;
}

}  // namespace petrichor::film
