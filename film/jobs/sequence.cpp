#include "film/jobs/sequence.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/words.h"
#include "film/jobs/camera.h"
#include "film/jobs/lens.h"
#include "film/jobs/exposure.h"
#include "film/jobs/night_sky.h"
#include "film/jobs/sun.h"
#include "film/scenario/look_keys.h"
#include "film/scenario/material_keys.h"
#include "film/scenes/shapes.h"
#include "formulas/light/mist.h"

namespace petrichor::film {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kBloom = 0.04;  // of an eye, or a lens that is not quite clean
constexpr double kWhiteShare = 0.8;  // of the cast of the light, by eye

float narrow(double value)
{
    return static_cast<float>(value);
}

// Where what stands at the horizon begins: behind all of the scene. Scenes that are a landscape themselves have none around them.
float skyline_from_m(const scene::Bounds& scene)
{
    constexpr float kLandscape_m = 2500.0f;
    const float reach_m = 0.5f * glm::length(glm::vec2(scene.high.x - scene.low.x, scene.high.z - scene.low.z));
    return reach_m < kLandscape_m ? 1.2f * reach_m : -1.0f;
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

}  // namespace

bool wants_patches(const Sequence& sequence)
{
    const ScenarioRender& render = sequence.scenario.render;
    if (!render.image_based_light || render.indirect == IndirectLight::Ambient) return false;
    return render.indirect == IndirectLight::Patches || sequence.triangles <= kMostAutoTriangles;
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

// From 20 days before the film on, as far as a file goes back; keys from their first.
IcicleHistory icicles_of(const SequenceVariant& variant, double start_s, double duration_s)
{
    const WeatherSource& weather = variant.weather;
    if (!weather.table && !weather.script) return {};
    constexpr double kBefore_us = 20.0 * 86400e6;
    IcicleHistory::Clock clock{std::min(-weather.script_offset_s, start_s), start_s + duration_s,
                               3600.0 * variant.conditions.weather.hours_per_second};
    if (weather.table) {
        const auto there_us = static_cast<double>(weather.utc_us(start_s) - weather.table->time_us.front());
        clock.begin_s = start_s - std::clamp(there_us, 0.0, kBefore_us) * 1e-6 / clock.weather_s_per_s;
    }
    return {[at = weather.at](double clock_s) { return at(clock_s).values; }, clock};
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
        const double film_s = output.frames / output.fps;
        const auto snow_m = [at = variant.weather.at, output, duration_s = sequence.duration_s, film_s](double film_time_s) {
            const shared::WeatherMoment& w = at(output.start_s + duration_s * film_time_s / film_s).values;
            return w.snow_amount > 0.0f ? static_cast<double>(w.snow_depth_m) : 0.0;
        };
        if (s.render.icicles) variant.icicles = icicles_of(variant, output.start_s, sequence.duration_s);
        variant.snow = SnowHistory(snow_m, film_s, std::clamp(4 * output.frames, 64, 4096));
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
    out.icicles = variant.icicles.at(time_s);
    out.sky.turbidity = narrow(value_at(here.sky.turbidity, time_s, 2.5));
    out.sky.sun_illuminance = narrow(here.sun.illuminance_lux.value_or(100000.0));
    if (here.sun.from_scene && !here.sun.illuminance_lux)
        out.sky.sun_illuminance =
            illuminance_of_scene(sequence.scene, out.sky).value_or(out.sky.sun_illuminance);
    out.sky.ground_albedo = narrow(here.sky.ground_albedo);
    out.sky.land_as_ground = here.sky.land_as_ground;
    if (here.sky.skyline) out.sky.skyline_from_m = skyline_from_m(sequence.framing.bounds);
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
    out.fog.mist_per_m = fog.mist_per_m.given()        ? narrow(value_at(fog.mist_per_m, time_s))
                         : fog.mode == gpu::FogMode::Off ? 0.0f
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

}  // namespace petrichor::film
