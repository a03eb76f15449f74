#include "film/jobs/sequence.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "base/error.h"
#include "base/hash.h"
#include "base/words.h"
#include "film/jobs/camera.h"
#include "film/jobs/lens.h"
#include "film/jobs/exposure.h"
#include "film/jobs/night_sky.h"
#include "film/jobs/sun.h"
#include "film/scenario/look_keys.h"
#include "film/scenario/material_keys.h"
#include "film/scenes/shapes.h"
#include "film/tiles/tile_plan.h"
#include "formulas/light/mist.h"

namespace petrichor::film {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kBloom = 0.04;  // of an eye, or a lens that is not quite clean
constexpr double kWhiteShare = 0.8;  // of the cast of the light, by eye
constexpr int kLargestSide = 16384;

std::optional<int> whole_number(std::string_view text)
{
    int value = 0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (problem != std::errc() || end != text.data() + text.size() || value < 0)
        return std::nullopt;
    return value;
}

float narrow(double value)
{
    return static_cast<float>(value);
}

// 1 with the sun low, 0 with it high.
double lamp_scale(const ScenarioLights& lights, double sun_elevation_rad)
{
    if (lights.lamps == Lamps::Off) return 0.0;
    if (lights.lamps == Lamps::On) return lights.scale;
    const double above = sun_elevation_rad * 180.0 / kPi - lights.dusk_degrees;
    if (above <= 0.0) return lights.scale;
    if (above >= lights.dusk_fade_degrees) return 0.0;
    const double u = 1.0 - above / lights.dusk_fade_degrees;
    return lights.scale * u * u * (3.0 - 2.0 * u);
}

void add_camera(Hasher& hasher, const scene::Camera& camera)
{
    hasher.add_numbers(std::span<const float>(&camera.to_world[0][0], 16));
    hasher.add(camera.vertical_fov_rad);
    hasher.add(camera.near_m);
    hasher.add(camera.orthographic_height_m);
    if (camera.shift != glm::vec2(0.0f)) {
        hasher.add(camera.shift.x);
        hasher.add(camera.shift.y);
    }
}

void add_lens(Hasher& hasher, const gpu::Frame& frame)
{
    if (frame.lens.radius_m > 0.0f) {
        hasher.add(frame.lens.radius_m);
        hasher.add(frame.lens.focus_m);
    }
    for (const gpu::ShutterMoment& moment : frame.shutter) {
        add_camera(hasher, moment.camera);
        hasher.add(moment.animation_s);
    }
}

void add_sky(Hasher& hasher, const gpu::Sky& sky)
{
    static_assert(sizeof(gpu::Sky) == 17 * sizeof(float), "hash the new field too");
    for (const float value :
         {sky.sun_elevation_rad, sky.sun_azimuth_rad, sky.sun_illuminance, sky.cloud_cover,
          sky.turbidity, sky.ground_albedo, sky.environment_scale, sky.environment_rotation_rad,
          sky.moon_elevation_rad, sky.moon_azimuth_rad, sky.moon_lux, sky.moon_illuminated,
          sky.latitude_rad, sky.sidereal_rad, sky.north_rad}) {
        hasher.add(value);
    }
    if (sky.sun_shadow_strength != 1.0f) hasher.add(sky.sun_shadow_strength);
    hasher.add(sky.analytic_sun);
    hasher.add(sky.land_as_ground);
}

void add_cookie(Hasher& hasher, const gpu::SunCookie& cookie)
{
    if (cookie.first_texel < 0) return;
    hasher.add(cookie.first_texel);
    hasher.add(cookie.size_m);
}

void add_falling(Hasher& hasher, const gpu::Falling& falling)
{
    hasher.add(falling.air_m.x);
    hasher.add(falling.air_m.y);
    hasher.add(falling.shutter_s);
    hasher.add(falling.density);
    hasher.add(falling.budget);
    hasher.add(falling.seed);
}

void add_light(Hasher& hasher, const scene::Light& light)
{
    hasher.add(light.kind);
    hasher.add(light.both_sides);
    hasher.add(light.shaped);
    hasher.add(light.profile);
    hasher.add(light.in_lantern);
    hasher.add(light.mask_channel);
    for (const glm::vec3& v :
         {light.color, light.position_m, light.direction, light.half_u_m, light.half_v_m,
          light.up}) {
        hasher.add(v.x);
        hasher.add(v.y);
        hasher.add(v.z);
    }
    for (const float value :
         {light.intensity, light.range_m, light.inner_cone_rad, light.outer_cone_rad,
          light.radius_m, light.length_m, light.specular}) {
        hasher.add(value);
    }
    if (light.shadow_strength != 1.0f) hasher.add(light.shadow_strength);
}

void add_settings(Hasher& hasher, const gpu::FrameSettings& settings)
{
    hasher.add(settings.width);
    hasher.add(settings.height);
    hasher.add(settings.samples);
    hasher.add(settings.time_s);
    hasher.add(settings.seed);
    hasher.add(settings.exposure);
    hasher.add(settings.exposure_bias_stops);
    hasher.add(settings.surface_path);
    hasher.add(settings.light_prepass);
    hasher.add(settings.occlusion_direct);
    hasher.add(settings.area_lights);
    hasher.add(settings.least_lux);
    hasher.add(settings.lazarov);
    for (const float value :
         {settings.horizon_fade, settings.specular_aa, settings.specular_aa_limit,
          settings.lod_scale, settings.adaptive, settings.anisotropic_dither,
          settings.anisotropic_dither_distance_m, settings.anisotropic_dither_fade_m}) {
        hasher.add(value);
    }
    hasher.add(settings.gamma);
#define ROW(name, on, meaning) hasher.add(settings.name);
    FRAME_SWITCHES(ROW)
#undef ROW
    hasher.add(settings.patch_light);
    hasher.add(settings.tone_map);
    hasher.add(settings.white_balance_k);
    hasher.add(settings.bloom);
    hasher.add(settings.wet_lens);
    hasher.add(settings.lamp_shadows);
    hasher.add(settings.transparent_layers);
    for (const std::string& aov : settings.aovs) hasher.add(aov);
}

}  // namespace

bool wants_patches(const Sequence& sequence)
{
    const ScenarioRender& render = sequence.scenario.render;
    if (!render.image_based_light || render.indirect == IndirectLight::Ambient) return false;
    return render.indirect == IndirectLight::Patches || sequence.triangles <= kMostAutoTriangles;
}

FrameRange parse_frame_range(std::string_view text, int count)
{
    const std::size_t colon = text.find(':');
    FrameRange range{0, count - 1};
    bool good = !text.empty() && text != ":";
    const std::string_view first = text.substr(0, colon);
    if (!first.empty()) {
        const auto number = whole_number(first);
        good = good && number.has_value();
        range.first = number.value_or(0);
    }
    if (colon == std::string_view::npos) {
        range.last = range.first;
    } else if (const std::string_view last = text.substr(colon + 1); !last.empty()) {
        const auto number = whole_number(last);
        good = good && number.has_value();
        range.last = number.value_or(0);
    }
    if (!good || range.first > range.last) {
        throw Error("frames: expected FIRST:LAST (both are rendered) or one number, got \"" +
                        std::string(text) + "\"",
                    "For example --frames 0:9 for the first ten, --frames 30 for one.");
    }
    if (range.last >= count) {
        throw Error("frames: the sequence has frames 0 to " + std::to_string(count - 1) +
                        ", got \"" + std::string(text) + "\"",
                    "Ask for frames it has, or make it longer with --count or output.frames.");
    }
    return range;
}

void check_size(const ImageSize& size)
{
    const bool sides = size.width >= 1 && size.height >= 1 && size.width <= kLargestSide &&
                       size.height <= kLargestSide;
    if (!sides) {
        throw Error("size: width and height must be 1 to " + std::to_string(kLargestSide) + " pixels, got " +
                        std::to_string(size.width) + "x" + std::to_string(size.height),
                    "For example --size 1280x720.");
    }
}

ImageSize parse_size(std::string_view text)
{
    const std::size_t x = text.find_first_of("xX");
    if (x != std::string_view::npos) {
        const auto width = whole_number(text.substr(0, x));
        const auto height = whole_number(text.substr(x + 1));
        if (width && height) {
            const ImageSize size{*width, *height};
            check_size(size);
            return size;
        }
    }
    throw Error("size: expected WIDTHxHEIGHT in pixels, got \"" + std::string(text) + "\"",
                "For example --size 1280x720.");
}

double frame_time_s(const Sequence& sequence, int frame)
{
    const ScenarioOutput& output = sequence.scenario.output;
    return output.start_s + sequence.duration_s * frame / output.frames;
}

namespace {

// The part of that name; the message of its absence is for programs that make jobs by hand.
template <class Part>
const Part& named_part(const std::vector<Part>& parts, const std::string& name, const char* kind)
{
    std::vector<std::string> names;
    for (const Part& part : parts) {
        if (part.name == name) return part;
        names.push_back(part.name);
    }
    throw Error(
        std::string("job: there is no ") + kind + " \"" + name + "\"." + did_you_mean(name, names),
        "Use one of: " + join_words(names) + ".");
}

// From directions about true north to the scene's axes.
glm::dvec2 turned(const glm::dvec2& v, double north_rad)
{
    if (north_rad == 0.0) return v;
    const double c = std::cos(north_rad), s = std::sin(north_rad);
    return {v.x * c - v.y * s, v.x * s + v.y * c};
}

// Of the ground as the weather has it; where that is not known there is none.
float mist_per_m(const shared::WeatherMoment& w)
{
    if (w.surface_temperature_k < 0.0f || w.relative_humidity < 0.0f || w.film_mm <= 0.0f) return 0.0f;
    return shared::mist_extinction_per_m(w.surface_temperature_k, w.air_temperature_k, w.relative_humidity,
                                         glm::length(w.wind_m_s));
}

// What falls, as far as the picture shows that.
bool something_falls(const shared::WeatherMoment& w)
{
    return w.rain_kg_m2_s > 0.0f || w.snowfall_kg_m2_s > 0.0f;
}

}  // namespace

Sequence make_sequence(Scenario scenario)
{
    Sequence sequence;
    sequence.scenario = std::move(scenario);
    const Scenario& s = sequence.scenario;
    const ScenarioOutput& output = s.output;
    std::vector<ScenarioVariant> variants = s.variants;
    if (variants.empty()) variants.push_back({"", s});
    // Weather that loops is made as long as the film.
    const double end_s = output.start_s + output.duration_s.value_or(0.0);
    for (ScenarioVariant& variant : variants) {
        WeatherSource weather = weather_source(variant.conditions.weather, s.folder, s.name, end_s);
        sequence.duration_s = std::max(sequence.duration_s, weather.duration_s);
        sequence.variants.push_back(
            {variant.name, std::move(variant.conditions), std::move(weather)});
    }
    if (output.duration_s) sequence.duration_s = *output.duration_s;
    if (!(sequence.duration_s > 0.0)) sequence.duration_s = output.frames / output.fps;
    for (SequenceVariant& variant : sequence.variants) {
        const auto wind = [at = variant.weather.at](double clock_s) {
            return glm::dvec2(at(clock_s).values.wind_m_s);
        };
        variant.air =
            AirTravel(wind, output.start_s, sequence.duration_s, output.frames / output.fps);
    }
    if (!s.render.color.config.empty())
        sequence.display = std::make_shared<DisplayTransform>(s.render.color, s.folder);
    sequence.views = s.views;
    if (sequence.views.empty()) sequence.views.push_back({"", s.camera});
    return sequence;
}

std::vector<Job> jobs_of(const Sequence& sequence, const FrameRange& range, const Shard& shard)
{
    std::vector<Job> jobs;
    for (int frame = range.first; frame <= range.last; ++frame) {
        for (const SequenceVariant& variant : sequence.variants) {
            for (const ScenarioView& view : sequence.views)
                jobs.push_back({frame, variant.name, view.name});
        }
    }
    const auto cut = [&](int part) {
        return static_cast<std::ptrdiff_t>(static_cast<std::int64_t>(jobs.size()) * part /
                                           shard.count);
    };
    return {jobs.begin() + cut(shard.index - 1), jobs.begin() + cut(shard.index)};
}

const ScenarioCamera& camera_of(const Sequence& sequence, const Job& job)
{
    return named_part(sequence.views, job.view, "view").camera;
}

SequenceFrame frame_at(const Sequence& sequence, const Job& job)
{
    const Scenario& scenario = sequence.scenario;
    const SequenceVariant& variant = named_part(sequence.variants, job.variant, "variant");
    const ScenarioCamera& camera = camera_of(sequence, job);
    const Conditions& here = variant.conditions;
    SequenceFrame result;
    result.job = job;
    result.time_s = frame_time_s(sequence, job.frame);
    const double time_s = result.time_s;
    result.moment = variant.weather.at(time_s);
    result.weather_name = variant.weather.name;
    result.environment = variant.environment;

    gpu::Frame& out = result.frame;
    const double aspect = static_cast<double>(scenario.output.width) / scenario.output.height;
    out.camera = camera_at(camera, sequence.scene, sequence.framing, aspect, time_s);
    std::optional<scene::Posture> posture;
    if (sequence.scene.rig) {
        out.animation_s = scenario.scene.animation_start_s +
                          scenario.scene.animation_speed * job.frame / scenario.output.fps;
        posture = scene::posture_at(*sequence.scene.rig, out.animation_s);
        out.camera = scene::carried(out.camera, *posture);
    }
    out.lens = lens_at(camera, out.camera, time_s);
    if (scenario.render.motion_blur && scenario.output.samples > 1)
        open_shutter(out, sequence, camera, aspect, time_s);
    out.weather = result.moment.values;
    out.look = look_at(here.look, time_s);

    const double north_rad = scenario.scene.north_degrees * kPi / 180.0;
    out.weather.wind_m_s = glm::vec2(turned(glm::dvec2(out.weather.wind_m_s), north_rad));
    const weather::SunAngles sun =
        sun_at(here.sun, sequence.scene, result.moment, north_rad, time_s,
               posture ? &*posture : nullptr);
    result.moment.sun = sun;
    out.sky.sun_elevation_rad = narrow(sun.elevation_rad);
    out.sky.sun_azimuth_rad = narrow(sun.azimuth_rad + north_rad);
    if (const auto cookie = sequence.sun_cookies.find(here.sun.cookie);
        cookie != sequence.sun_cookies.end()) {
        out.sun_cookie = cookie->second;
        out.sun_cookie.size_m = narrow(value_at(here.sun.cookie_size_m, time_s, 8.0));
    }
    const double clouds = static_cast<double>(out.weather.cloud_fraction);
    out.sky.cloud_cover = narrow(value_at(here.sky.cloud_cover, time_s, clouds));
    out.weather.cloud_fraction = out.sky.cloud_cover;
    if (here.fog.visibility_m.given())
        out.weather.visibility_m = narrow(value_at(here.fog.visibility_m, time_s));
    result.moment.values = out.weather;
    out.sky.turbidity = narrow(value_at(here.sky.turbidity, time_s, 2.5));
    out.sky.sun_illuminance = narrow(here.sun.illuminance_lux.value_or(100000.0));
    if (here.sun.from_scene && !here.sun.illuminance_lux)
        out.sky.sun_illuminance =
            illuminance_of_scene(sequence.scene, out.sky).value_or(out.sky.sun_illuminance);
    out.sky.ground_albedo = narrow(here.sky.ground_albedo);
    out.sky.land_as_ground = here.sky.land_as_ground;
    out.sky.environment_scale = narrow(here.sky.environment_scale);
    out.sky.environment_rotation_rad = narrow(here.sky.environment_rotation_degrees * kPi / 180.0);
    out.sky.analytic_sun = !here.sun.from_scene;
    out.sky.sun_shadow_strength = narrow(value_at(here.sun.shadow_strength, time_s, 1.0));
    const NightSky night = night_sky_at(here.moon, here.sun, result.moment, sun, time_s);
    if (night.moon) {
        out.sky.moon_elevation_rad = narrow(night.moon->angles.elevation_rad);
        out.sky.moon_azimuth_rad = narrow(night.moon->angles.azimuth_rad + north_rad);
        out.sky.moon_lux = narrow(night.moon->lux);
        out.sky.moon_illuminated = narrow(night.moon->illuminated);
    }
    out.sky.latitude_rad = narrow(night.latitude_rad);
    out.sky.sidereal_rad = narrow(night.sidereal_rad);
    out.sky.north_rad = narrow(north_rad);

    const ScenarioFog& fog = here.fog;
    out.fog.mode = fog.mode;
    out.fog.per_m = narrow(value_at(fog.per_m, time_s, 0.01));
    out.fog.start_m = narrow(value_at(fog.start_m, time_s, 0.0));
    out.fog.end_m = narrow(value_at(fog.end_m, time_s, 100.0));
    out.fog.height_m = narrow(value_at(fog.height_m, time_s, 120.0));
    out.fog.mist_per_m = fog.mode == gpu::FogMode::Off ? 0.0f
                         : fog.mist_per_m.given()      ? narrow(value_at(fog.mist_per_m, time_s))
                                                       : mist_per_m(out.weather);

    out.falling.shutter_s = narrow(value_at(camera.shutter_s, time_s, kShutter_s));
    out.falling.density = narrow(scenario.render.falling_density);
    out.falling.budget = scenario.render.falling_budget;
    out.falling.seed = scenario.output.seed;
    if (scenario.render.falling && something_falls(out.weather))
        out.falling.air_m = turned(variant.air.at(time_s), north_rad);

    const double lamps = lamp_scale(here.lights, sun.elevation_rad);
    out.scene_light_scale = narrow(lamps);
    out.emissive_scale = narrow(lamps);
    out.materials = material_changes(scenario.materials, sequence.scene.materials, time_s);
    out.shapes = shape_moments(scenario.shapes, sequence.scene, time_s);
    out.emissive_lights = here.lights.emissive;

    gpu::FrameSettings& settings = out.settings;
    settings.width = scenario.output.width;
    settings.height = scenario.output.height;
    settings.samples = scenario.output.samples;
    settings.time_s = job.frame / scenario.output.fps;
    settings.seed = scenario.output.seed;
    settings.exposure = narrow(fixed_exposure(camera, time_s));
    settings.exposure_bias_stops = narrow(value_at(camera.exposure_bias, time_s, 0.0));
    static_cast<gpu::FrameSwitches&>(settings) = scenario.render;
    settings.occlusion_direct = narrow(scenario.render.occlusion_direct);
    settings.area_lights = here.lights.area;
    settings.least_lux = narrow(here.lights.least_lux);
    settings.lazarov = scenario.render.lazarov;
    settings.horizon_fade = narrow(scenario.render.horizon_fade);
    settings.specular_aa = narrow(scenario.render.specular_aa);
    settings.specular_aa_limit = narrow(scenario.render.specular_aa_limit);
    settings.anisotropic_dither = narrow(scenario.render.anisotropic_dither);
    settings.anisotropic_dither_distance_m = narrow(scenario.render.anisotropic_dither_distance_m);
    settings.anisotropic_dither_fade_m = narrow(scenario.render.anisotropic_dither_fade_m);
    settings.adaptive = narrow(scenario.render.adaptive);
    settings.lod_scale = narrow(scenario.render.lod_scale);
    settings.gamma = scenario.render.gamma;
    settings.lamp_shadows = scenario.render.lamp_shadows;
    settings.transparent_layers = scenario.render.transparent_layers;
    settings.tone_map = scenario.render.tone_map;
    settings.exposed_light = sequence.display != nullptr;
    settings.white_balance_k = narrow(value_at(camera.white_balance_k, time_s, 0.0));
    settings.white_share = narrow(value_at(camera.white_balance_strength, time_s, kWhiteShare));
    settings.bloom = narrow(value_at(camera.bloom, time_s, kBloom));
    settings.wet_lens = narrow(value_at(camera.wet_lens, time_s, 0.0));
    settings.surface_path = scenario.render.surface_path;
    settings.light_prepass = scenario.render.light_prepass;
    settings.patch_light = wants_patches(sequence);
    settings.aovs = scenario.output.aovs;
    return result;
}

namespace {

void add_fog(Hasher& hasher, const gpu::Fog& fog)
{
    hasher.add(fog.mode);
    for (const float value : {fog.per_m, fog.start_m, fog.end_m, fog.height_m, fog.mist_per_m}) hasher.add(value);
}

void add_materials(Hasher& hasher, const gpu::Frame& frame)
{
    for (const scene::MaterialChange& change : frame.materials) {
        hasher.add(change.material);
        hasher.add(change.property);
        hasher.add_numbers(std::span<const float>(&change.value[0], 4));
    }
}

void add_shapes(Hasher& hasher, const gpu::Frame& frame)
{
    for (const scene::ShapeMoment& moment : frame.shapes) {
        hasher.add_numbers(std::span<const float>(&moment.to_world[0][0], 16));
        hasher.add(moment.power);
    }
}

void add_frame(Hasher& hasher, const gpu::Frame& frame)
{
    add_camera(hasher, frame.camera);
    add_sky(hasher, frame.sky);
    add_cookie(hasher, frame.sun_cookie);
    add_fog(hasher, frame.fog);
    add_falling(hasher, frame.falling);
    hasher.add_bytes(std::as_bytes(std::span(&frame.weather, 1)));
    hasher.add_bytes(std::as_bytes(std::span(&frame.look, 1)));
    for (const scene::Light& light : frame.extra_lights) add_light(hasher, light);
    hasher.add(frame.scene_light_scale);
    hasher.add(frame.emissive_scale);
    hasher.add(frame.emissive_lights);
    hasher.add(frame.animation_s);
    add_lens(hasher, frame);
    add_materials(hasher, frame);
    add_shapes(hasher, frame);
    add_settings(hasher, frame.settings);
}

}  // namespace

FrameParts frame_parts(const Sequence& sequence, const SequenceFrame& what)
{
    const gpu::Frame& frame = what.frame;
    const Scenario& scenario = sequence.scenario;
    const auto part = [](const auto& add) {
        Hasher hasher;
        add(hasher);
        return hasher.text();
    };
    FrameParts parts;
    parts["program"] = "petrichor " PETRICHOR_VERSION;
    parts["scene files"] = sequence.content;
    if (!sequence.lighting_models.empty()) parts["lighting models"] = sequence.lighting_models;
    if (!what.environment.empty()) parts["sky picture"] = what.environment;
    if (sequence.display) parts["color management"] = sequence.display->fingerprint();
    if (!sequence.weather_textures.empty()) parts["weather textures"] = sequence.weather_textures;
    if (!scenario.materials.empty()) {
        parts["materials"] = part([&](Hasher& hasher) {
            for (const MaterialOverride& one : scenario.materials) {
                hasher.add(one.glob);
                hasher.add(one.lighting_model);
                if (!one.surface.empty()) hasher.add(one.surface);
                if (one.tiling != glm::vec2(1.0f)) {
                    hasher.add(one.tiling.x);
                    hasher.add(one.tiling.y);
                }
                for (const auto& [name, channels] : one.values) {
                    hasher.add(name);
                    // What is loaded: the first key, and whether others follow.
                    for (const KeyedNumber& channel : channels) {
                        hasher.add(channel.keys.size() > 1);
                        hasher.add(channel.keys.front().value);
                    }
                }
                for (const auto& [slot, file] : one.textures) {
                    hasher.add(slot);
                    hasher.add(file);
                }
            }
            add_materials(hasher, frame);
        });
    }
    if (!frame.shapes.empty()) parts["shapes"] = part([&](Hasher& hasher) { add_shapes(hasher, frame); });
    if (sequence.scene.rig)
        parts["animation"] = part([&](Hasher& hasher) { hasher.add(frame.animation_s); });
    parts["camera"] = part([&](Hasher& hasher) {
        add_camera(hasher, frame.camera);
        add_lens(hasher, frame);
    });
    parts["sun and sky"] = part([&](Hasher& hasher) {
        add_sky(hasher, frame.sky);
        add_cookie(hasher, frame.sun_cookie);
    });
    parts["fog"] = part([&](Hasher& hasher) { add_fog(hasher, frame.fog); });
    parts["falling"] = part([&](Hasher& hasher) { add_falling(hasher, frame.falling); });
    parts["weather"] = part(
        [&](Hasher& hasher) { hasher.add_bytes(std::as_bytes(std::span(&frame.weather, 1))); });
    parts["places"] = part([&](Hasher& hasher) {
        const ScenarioGround& ground = scenario.ground;
        hasher.add(ground.patches ? (*ground.patches ? 1 : 0) : 2);
        hasher.add(ground.gutters);
        for (const std::string& glob : ground.ground) hasher.add(glob);
        hasher.add("not");
        for (const std::string& glob : ground.not_ground) hasher.add(glob);
        for (const glm::dvec3& drain : ground.drains)
            for (const double v : {drain.x, drain.y, drain.z}) hasher.add(v);
        for (const ScenarioTap& tap : ground.taps) {
            hasher.add("tap");
            for (const double v : {tap.x_z_m.x, tap.x_z_m.y, tap.litres_per_min}) hasher.add(v);
            for (const auto& at : {tap.from_s, tap.to_s}) {
                hasher.add(at.has_value());
                hasher.add(at.value_or(0.0));
            }
        }
        hasher.add(scenario.scene.north_degrees);
        hasher.add(what.moment.utc_us.value_or(0));
    });
    if (frame.settings.snow_body && frame.weather.snow_amount > 0.0f) {
        // Finer where a camera stands at some time of the film.
        parts["snow"] = part([&](Hasher& hasher) {
            for (const glm::vec3& eye : sequence.eyes_m)
                hasher.add_numbers(std::span<const float>(&eye[0], 3));
        });
    }
    static_assert(std::is_trivially_copyable_v<shared::WeatherLook> &&
                      sizeof(shared::WeatherLook) % sizeof(float) == 0,
                  "all floats: hashed as one run");
    parts["look"] =
        part([&](Hasher& hasher) { hasher.add_bytes(std::as_bytes(std::span(&frame.look, 1))); });
    parts["lights"] = part([&](Hasher& hasher) {
        // As the scenario has them: the file's own are part of its content.
        if (!scenario.lamps.empty()) {
            for (const scene::Light& light : sequence.scene.lights) add_light(hasher, light);
        }
        for (const scene::Light& light : frame.extra_lights) add_light(hasher, light);
        hasher.add(frame.scene_light_scale);
        hasher.add(frame.emissive_scale);
        hasher.add(frame.emissive_lights);
    });
    parts["output settings"] = part([&](Hasher& hasher) {
        add_settings(hasher, frame.settings);
        hasher.add(scenario.scene.max_texture);
        hasher.add(scenario.scene.texture_rule);
        hasher.add(scenario.render.ripple_texture_size);
        if (is_tiled(scenario.output.width, scenario.output.height, scenario.render.tile))
            hasher.add(plan_tiles(scenario.output.width, scenario.output.height, scenario.render.tile).tile);
    });
    // The frames around it say how it is exposed.
    const auto metered = metered_jobs(sequence, what.job);
    if (!metered.empty()) {
        parts["exposure"] = part([&](Hasher& hasher) {
            const ScenarioCamera& camera = camera_of(sequence, what.job);
            hasher.add(camera.ev100_low);
            hasher.add(camera.ev100_high);
            if (camera.white_balance_auto) {
                hasher.add(std::string("light"));
                hasher.add(what.frame.settings.white_share);
            }
            for (const MeteredJob& one : metered) {
                hasher.add(one.weight);
                if (one.job != what.job) add_frame(hasher, frame_at(sequence, one.job).frame);
            }
        });
    }
    return parts;
}

}  // namespace petrichor::film
