#include "cli/scene/bake_light.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <vector>

#include "base/error.h"
#include "base/words.h"
#include "cli/progress.h"
#include "cli/rooms.h"

namespace petrichor::cli {
namespace {

const std::vector<std::string>& kinds()
{
    static const std::vector<std::string> names{"light_map", "indirect", "shadow_mask"};
    return names;
}

std::string line_of(const SceneView& view, const scene::LightMap& map, const std::string& file)
{
    double sum = 0.0, most = 0.0;
    for (const glm::vec3& lux : map.lux) {
        const double y = 0.2126 * static_cast<double>(lux.x) + 0.7152 * static_cast<double>(lux.y) +
                         0.0722 * static_cast<double>(lux.z);
        sum += y;
        most = std::max(most, y);
    }
    char text[200];
    std::snprintf(text, sizeof text, "%d x %d, %.0f %% covered, mean %.0f lx, brightest %.0f lx",
                  map.size, map.size, 100.0 * map.covered, sum / static_cast<double>(map.lux.size()),
                  most);
    return "light map   " + file + ": \"" + view.scene->materials[map.material].name + "\" over its " +
           (map.texcoord == 1 ? "second" : "first") + " coordinates, " + text + "\n";
}

}  // namespace

void add_bake_options(CLI::App& command, BakeArguments& a)
{
    const auto number = [&](const char* name, double& value, double low, double high, const char* help) {
        command.add_option(name, value, help)->check(CLI::Range(low, high))->each([&a, name](const std::string&) {
            if (a.named.empty()) a.named = name;
        });
    };
    command.add_option("--bake", a.what,
                       "light maps over the second texture coordinates, an EXR a material, and the keys "
                       "that lay them on, into the folder -o. light_map: all light; indirect: without "
                       "what sun and lamps send straight, which stays real-time; shadow_mask: that, and beside it "
                       "how much of the sun and of lamps is seen");
    number("--sky-lux", a.light.sky_lux, 0.0, 200000.0, "bake: of an overcast sky, on open ground (10000)");
    number("--sun-lux", a.light.sun_lux, 0.0, 200000.0, "bake: of the sun, on a plane that faces it (0)");
    number("--sun-elevation", a.light.sun_elevation_degrees, -90.0, 90.0, "bake: degrees (45)");
    number("--sun-azimuth", a.light.sun_azimuth_degrees, -360.0, 360.0,
           "bake: degrees clockwise from north (180)");
    number("--snow", a.light.snow, 0.0, 1.0, "bake: snow on all that lies open, 0..1 (0)");
    command.add_option("--mask-lamps", a.light.mask_lamps,
                       "bake shadow_mask: only lamps of such names have channels (*)")
        ->each([&a](const std::string&) {
            if (a.named.empty()) a.named = "--mask-lamps";
        });
    const auto whole = [&](const char* name, int& value, int low, int high, const char* help) {
        command.add_option(name, value, help)->check(CLI::Range(low, high))->each([&a, name](const std::string&) {
            if (a.named.empty()) a.named = name;
        });
    };
    whole("--map-size", a.size, 8, 8192, "bake: texels along an edge of a map (512)");
    whole("--gather", a.rays, 16, 4096, "bake: rays of a texel (256)");
}

void check_bake(const BakeArguments& a, const std::string& output)
{
    if (a.what.empty()) {
        if (a.named.empty()) return;
        throw Error("scene: " + a.named + " is of --bake", "Add --bake light_map, or leave it out.");
    }
    if (std::find(kinds().begin(), kinds().end(), a.what) == kinds().end()) {
        throw Error("scene: nothing to bake is called \"" + a.what + "\"." + did_you_mean(a.what, kinds()),
                    "Use: " + join_words(kinds()) + ".");
    }
    if (output.empty() || std::filesystem::is_regular_file(output)) {
        throw Error("scene: light maps go into a folder, got \"" + output + "\"",
                    "Add -o light_maps.");
    }
}

std::string bake_light_maps(const SceneView& view, const SceneViewOptions& options,
                            const BakeArguments& arguments, const std::string& folder)
{
    film::TransportOptions transport;
    transport.patches.cell_m = static_cast<float>(options.cell_m);
    transport.patches.rays = options.rays;
    transport.patches.threads = options.threads;
    if (!options.fresh) transport.cache = user_cache();
    scene::BakeOptions bake;
    bake.size = arguments.size;
    bake.rays = arguments.rays;
    bake.threads = options.threads;
    std::optional<Progress> progress;
    if (!options.quiet) {
        bake.progress = [&](std::string_view, float share) {
            if (!progress) progress.emplace("light maps", 100);
            progress->update(static_cast<int>(share * 100.0f));
        };
    }
    film::BakeConditions light = arguments.light;
    light.shadow_mask = arguments.what == "shadow_mask";
    light.indirect = light.shadow_mask || arguments.what == "indirect";
    std::vector<std::string> notes;
    const scene::LightMaps baked = film::bake_light(*view.scene, light, transport, bake, notes);
    const auto files = film::write_light_maps(folder, *view.scene, baked);
    progress.reset();
    std::string report;
    for (std::size_t i = 0; i < baked.maps.size(); ++i) report += line_of(view, baked.maps[i], files[i]);
    for (std::size_t i = 0; i < baked.channels.size(); ++i) {
        if (baked.channels[i] == 0) continue;
        report += "lamp        \"" + view.scene->lights[i].name + "\" in channel " +
                  std::to_string(baked.channels[i]) + " of the shadow masks\n";
    }
    for (const std::string& note : notes) report += "note        " + note + "\n";
    report += "keys        " + (std::filesystem::path(folder) / files.back()).string() + "\n";
    return report;
}

}  // namespace petrichor::cli
