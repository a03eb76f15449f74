#include "film/scenes/light_bake.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <set>

#include "base/error.h"
#include "base/output_file.h"
#include "base/words.h"
#include "formulas/light/brdf.h"
#include "gpu/passes/patch_light/patch_albedo.h"
#include "scene/patches/lamps.h"
#include "scene/patches/mask_channels.h"
#include "scene/patches/radiosity.h"
#include "scene/patches/tracer.h"
#include "scene/patches/triangles.h"
#include "texproc/codecs/files/io.h"

namespace petrichor::film {
namespace {

constexpr int kBounces = 16;
constexpr double kGroundAlbedo = 0.2;

// pi x radiance of the sky's bins: E = 7 pi / 9 of the zenith's radiance on open ground.
std::vector<glm::vec3> overcast_sky(double lux)
{
    std::vector<glm::vec3> sky;
    for (int bin = 0; bin < shared::kSkyBins; ++bin) {
        const auto up = static_cast<double>(shared::sky_bin_direction(bin).y);
        const double light =
            up > 0.0 ? lux * 9.0 / 7.0 * (1.0 + 2.0 * up) / 3.0 : lux * kGroundAlbedo;
        sky.emplace_back(static_cast<float>(light));
    }
    return sky;
}

scene::Light sun_of(const BakeConditions& c)
{
    const double degree = std::numbers::pi / 180.0;
    const double azimuth = (c.sun_azimuth_degrees + c.north_degrees) * degree;
    const double up = c.sun_elevation_degrees * degree;
    scene::Light sun;
    sun.kind = scene::LightKind::Directional;
    sun.intensity = static_cast<float>(c.sun_lux);
    sun.direction = -glm::vec3(std::cos(up) * std::sin(azimuth), std::sin(up),
                               -std::cos(up) * std::cos(azimuth));
    return sun;
}

std::string clean(const std::string& name)
{
    std::string text;
    for (const char c : name) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                           c == '-' || c == '_';
        text += plain ? c : '_';
    }
    return text.substr(0, 60);
}

std::string share(double value)
{
    char text[16];
    std::snprintf(text, sizeof text, "%.0f %%", 100.0 * value);
    return text;
}

void tell(const scene::Scene& scene, const scene::LightMaps& baked, std::vector<std::string>& notes)
{
    for (const scene::LightMap& map : baked.maps) {
        if (map.shared <= 0.02) continue;
        notes.push_back("material \"" + scene.materials[map.material].name + "\": " + share(map.shared) +
                        " of its light map's texels lie on several surfaces and hold their mean; give "
                        "meshes second texture coordinates that overlap nowhere, and instances "
                        "materials of their own");
    }
    for (const std::uint32_t m : baked.left_out) {
        notes.push_back("material \"" + scene.materials[m].name +
                        "\" gets no light map: its texture coordinates have no area, or repeat more "
                        "than 4 times; give its meshes second ones");
    }
}

// What a shadow mask is of, and the channels of the scene's lamps.
struct Masked {
    std::vector<scene::Light> lamps;
    std::vector<int> channels;
};

Masked masked_lamps(const scene::Scene& scene, const BakeConditions& conditions, bool sunny,
                    std::vector<std::string>& notes)
{
    std::vector<bool> wanted;
    for (const scene::Light& lamp : scene.lights)
        wanted.push_back(conditions.mask_lamps.empty() || glob_matches(conditions.mask_lamps, lamp.name));
    if (!conditions.mask_lamps.empty() && std::find(wanted.begin(), wanted.end(), true) == wanted.end()) {
        std::vector<std::string> names;
        for (const scene::Light& lamp : scene.lights) {
            if (std::find(names.begin(), names.end(), lamp.name) == names.end()) names.push_back(lamp.name);
        }
        throw Error("light map: no lamp is called \"" + conditions.mask_lamps + "\"." + did_you_mean(conditions.mask_lamps, names),
                    names.empty() ? "The scene has no lamps: leave --mask-lamps out." : "Lamps of the scene: " + join_words(names) + ".");
    }
    Masked masked;
    masked.channels = scene::mask_channels(scene.lights, wanted);
    if (sunny) masked.lamps.push_back(sun_of(conditions));
    std::vector<std::string> without;
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        if (masked.channels[i] > 0) {
            masked.lamps.push_back(scene.lights[i]);
            masked.lamps.back().mask_channel = masked.channels[i];
        } else if (wanted[i] && (without.empty() || without.back() != scene.lights[i].name)) {
            without.push_back(scene.lights[i].name);
        }
    }
    if (masked.lamps.empty()) {
        throw Error("light map: a shadow mask is of sun and lamps, and none shines",
                    "Say how bright and how high the sun is: --sun-lux 60000 --sun-elevation 35.");
    }
    for (const std::string& name : without) {
        notes.push_back("lamp \"" + name +
                        "\" has no channel of the shadow masks: it meets more than " +
                        std::to_string(scene::kMaskChannels) + " lamps, or another of its name; its shadow "
                        "stays as it is drawn");
    }
    return masked;
}

std::string in_quotes(const std::string& name)
{
    std::string text = "\"";
    for (const char c : name) {
        if (c == '"' || c == '\\') text += '\\';
        text += c;
    }
    return text + "\"";
}

}  // namespace

scene::LightMaps bake_light(const scene::Scene& scene, const BakeConditions& conditions,
                            const TransportOptions& transport, const scene::BakeOptions& options,
                            std::vector<std::string>& notes)
{
    const bool sunny = conditions.sun_lux > 0.0 && conditions.sun_elevation_degrees > 0.0;
    const Masked masked = conditions.shadow_mask ? masked_lamps(scene, conditions, sunny, notes) : Masked{};
    const auto patches = prepare_patch_scene(scene, transport, notes);
    const scene::Patches& p = patches->patches;
    shared::WeatherMoment weather;
    weather.snow_amount = static_cast<float>(conditions.snow);
    const gpu::PatchLook look = gpu::patch_look(*patches, weather, shared::WeatherLook{}, true);

    std::vector<scene::Light> lamps = scene.lights;
    std::vector<glm::vec3> direct(p.count, glm::vec3(0.0f)), emission;
    for (std::size_t i = 0; i < lamps.size(); ++i)
        scene::add_lamp(p, lamps[i], scene.light_profiles, patches->lamp_reach[i], direct);
    if (sunny) {
        lamps.push_back(sun_of(conditions));
        scene::add_lamp(p, lamps.back(), {}, {}, direct);
    }
    for (const glm::vec3& radiance : look.emission) emission.push_back(radiance * shared::kPi);
    const std::vector<glm::vec3> sky = overcast_sky(conditions.sky_lux);
    scene::Relight relight;
    relight.albedo = look.albedo;
    relight.direct = direct;
    relight.emission = emission;
    relight.sky = sky;
    relight.glow = &patches->glow;
    relight.bounces = kBounces;
    relight.threads = options.threads;
    const scene::PatchIrradiance lit = scene::relight(p, relight);

    const scene::Triangles triangles(scene, alpha_images(scene, notes));
    const scene::Tracer tracer(triangles);
    scene::BakeLight light{lit.radiosity, sky, lamps, scene.light_profiles};
    if (conditions.indirect) light.lamps = {};
    light.masked = masked.lamps;
    scene::LightMaps baked = scene::bake_light_maps(tracer, p, light, options);
    baked.channels = masked.channels;
    tell(scene, baked, notes);
    return baked;
}

std::vector<std::string> write_light_maps(const std::filesystem::path& folder,
                                          const scene::Scene& scene, const scene::LightMaps& baked)
{
    std::filesystem::create_directories(folder);
    std::vector<std::string> names;
    std::string keys = "# Light maps: irradiance in lux. They hold the sky, so none comes on top.\n";
    const bool masks = !baked.maps.empty() && !baked.maps[0].seen.empty();
    if (masks) {
        keys += "# On the right of each, how much is seen of the sun (red) and of lamps by their channels:\n"
                "# data/shaders/shadow_mask.glsl reads it.\n";
        std::set<std::string> told;
        for (std::size_t i = 0; i < baked.channels.size(); ++i) {
            const std::string& lamp = scene.lights[i].name;
            if (baked.channels[i] == 0 || !told.insert(lamp).second) continue;
            keys += "\n[lamps." + in_quotes(lamp) + "]\nmask_channel = " + std::to_string(baked.channels[i]) + "\n";
        }
    }
    for (const scene::LightMap& map : baked.maps) {
        const std::string& material = scene.materials[map.material].name;
        names.push_back("light_" + std::to_string(map.material) +
                        (material.empty() ? "" : "_" + clean(material)) + ".exr");
        std::vector<texproc::ExrChannel> channels(masks ? 4 : 3);
        for (int c = 0; c < (masks ? 4 : 3); ++c) {
            auto& channel = channels[static_cast<std::size_t>(c)];
            channel.name = std::string(1, "RGBA"[c]);
            for (int y = 0; y < map.size; ++y) {
                const auto row = static_cast<std::size_t>(y) * static_cast<std::size_t>(map.size);
                const auto end = row + static_cast<std::size_t>(map.size);
                for (std::size_t i = row; i < end; ++i)
                    channel.floats.push_back(c < 3 ? map.lux[i][c] : 1.0f);
                for (std::size_t i = row; masks && i < end; ++i) channel.floats.push_back(map.seen[i][c]);
            }
        }
        texproc::write_exr(folder / names.back(), (masks ? 2 : 1) * map.size, map.size, channels,
                           {{"material", material}, {"unit", "lx"}});
        keys += "\n[materials." + in_quotes(material) + "]\nlight_map_texture = " + in_quotes(names.back()) +
                "\nlight_map_sky = 0.0\n";
        if (masks) keys += "surface = \"shadow_mask.glsl\"\n";
    }
    names.emplace_back("light_maps.toml");
    write_text_file(folder / names.back(), keys);
    return names;
}

}  // namespace petrichor::film
