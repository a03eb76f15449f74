#include "cli/texture/prefilter_options.h"

#include <CLI/CLI.hpp>
#include <future>
#include <utility>

#include "base/error.h"
#include "cli/texture/naming.h"

namespace petrichor::cli {

void add_prefilter_input(CLI::App& app, PrefilterInput& input)
{
    app.add_option("--normal", input.normal,
                   "normal map, x y z in RGB; default: the one whose name fits the other map");
    auto* rough = app.add_option("--roughness", input.roughness,
                                 "perceptual roughness map; FILE:g takes the green channel");
    app.add_option("--smoothness", input.smoothness, "smoothness map (1 - roughness)")
        ->excludes(rough);
    app.add_flag("--alpha", input.options.alpha,
                 "the map holds alpha (roughness squared), not roughness");
    app.add_option(
           "--normal-layout", input.layout,
           "rgb, rg (z rebuilt, as BC5), ag (x in A, y in G, z rebuilt) or rxgb (x in A, y in G, z "
           "in B)")
        ->check(CLI::IsMember({"rgb", "rg", "ag", "rxgb"}))
        ->capture_default_str();
    app.add_flag("--green-down", input.options.green_down, "the normal map has +Y down (DirectX)");
    app.add_option("--threads", input.options.threads,
                   "0: all cores; the bytes do not depend on it");
    app.add_option("--max-pixels", input.reading.max_pixels, "refuse larger inputs")
        ->capture_default_str();
}

PrefilterMaps read_prefilter_maps(PrefilterInput& input)
{
    texproc::PrefilterOptions& o = input.options;
    const bool smooth = !input.smoothness.empty();
    if (!smooth && input.roughness.empty()) {
        throw Error("texture: no roughness map", "Give --roughness FILE or --smoothness FILE.");
    }
    const MapFile map = parse_map_file(smooth ? input.smoothness : input.roughness);
    o.smoothness = smooth;
    o.channel = map.channel >= 0 ? map.channel : named_channel(map.path);
    if (input.normal.empty()) {
        const NormalPartner partner = find_normal(map.path);
        input.normal = partner.path.string();
        o.green_down |= partner.green_down;
    }
    o.rebuild_z = input.layout == "rg" || input.layout == "ag";
    if (input.layout == "ag" || input.layout == "rxgb") o.normal_x = 3;
    PrefilterMaps maps;
    auto normal = std::async(std::launch::async,
                             [&] { return texproc::read_raw(input.normal, input.reading); });
    maps.map_path = map.path;
    maps.map = texproc::read_raw(map.path, input.reading);
    maps.normal = normal.get();
    // A grey map under the name of a packed one has its values in its only channel.
    if (map.channel < 0 && maps.map.channels <= 2) o.channel = 0;
    if (map.channel < 0 && o.channel == 0)
        tell_red_taken(map.path.string(), maps.map, smooth ? "smoothness" : "roughness");
    if (input.layout == "rgb") tell_if_no_normals(input.normal, maps.normal);
    return maps;
}

}  // namespace petrichor::cli
