// What decides a picture, hashed part by part.
#include <cstdint>
#include <span>
#include <type_traits>

#include "base/hash.h"
#include "film/jobs/exposure.h"
#include "film/jobs/film_tracks.h"
#include "film/jobs/sequence.h"
#include "film/tiles/tile_plan.h"

namespace petrichor::film {
namespace {

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
    static_assert(sizeof(gpu::Sky) == 18 * sizeof(float), "hash the new field too");
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
    if (sky.skyline_from_m >= 0.0f) hasher.add(sky.skyline_from_m);
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
            for (const double v : {scenario.weather.hours_per_second, sequence.duration_s}) hasher.add(v);
            for (const double v : {tap.x_z_m.x, tap.x_z_m.y, tap.litres_per_min, tap.temperature_c}) hasher.add(v);
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
    if (frame.settings.icicles && frame.icicles.any()) {
        parts["icicles"] = part([&](Hasher& hasher) {
            hasher.add_numbers(std::span<const float>(frame.icicles.length_m));
            for (const glm::vec3& eye : sequence.eyes_m)
                hasher.add_numbers(std::span<const float>(&eye[0], 3));
        });
    }
    if (const std::string tracks = tracks_at(sequence, what.job.variant, frame.settings.time_s); !tracks.empty())
        parts["tracks"] = tracks;
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
