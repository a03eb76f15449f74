#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "base/error.h"
#include "cli/cmd_texture.h"
#include "cli/texture_files.h"
#include "texproc/pack.h"
#include "texproc/prefilter.h"

namespace petrichor::cli {

namespace {

struct Arguments {
    std::string normal, roughness, smoothness, out, normal_out;
    int bits = 16;
    bool green_down = false;
    texproc::PrefilterOptions options;
    texproc::ReadOptions reading;
};

// One channel of a map: the one chosen, else the only one, else the first of a grey picture.
Image read_single(const std::string& text, const Arguments& a)
{
    const texproc::RawImage raw = read_map(text, a.reading);
    return texproc::to_image(raw.channels == 1 ? raw : texproc::channel_of(raw, 0),
                             ColorSpace::Data);
}

void run(const Arguments& a)
{
    const bool smooth = !a.smoothness.empty();
    level_name(a.out, 0);
    if (!a.normal_out.empty()) level_name(a.normal_out, 0);
    Image normal = texproc::read_image(a.normal, a.reading);
    if (a.green_down && normal.channels >= 2) {
        for (std::size_t i = 1; i < normal.pixels.size(); i += static_cast<std::size_t>(normal.channels)) {
            normal.pixels[i] = 1.0f - normal.pixels[i];
        }
    }
    const Image map = read_single(smooth ? a.smoothness : a.roughness, a);
    texproc::PrefilterOptions options = a.options;
    options.smoothness = smooth;
    texproc::Prefiltered chains = texproc::prefilter(normal, map, options);
    const texproc::WriteOptions writing{.bits = a.bits, .threads = options.threads};
    for (std::size_t k = 0; k < chains.roughness.size(); ++k) {
        const int level = static_cast<int>(k);
        texproc::write_image(level_name(a.out, level), chains.roughness[k], writing);
        if (a.normal_out.empty()) continue;
        Image& n = chains.normal[k];
        if (a.green_down) {
            for (std::size_t i = 1; i < n.pixels.size(); i += 3) n.pixels[i] = 1.0f - n.pixels[i];
        }
        texproc::write_image(level_name(a.normal_out, level), n, writing);
    }
    std::cout << chains.roughness.size() << " levels, " << normal.width << " x " << normal.height
              << ", rule " << options.rule << "\n";
}

}  // namespace

void add_texture_prefilter(CLI::App& texture)
{
    auto a = std::make_shared<Arguments>();
    CLI::App* app = texture.add_subcommand(
        "prefilter", "mip levels whose roughness holds what the normals lose");
    app->add_option("--normal", a->normal, "normal map, x y z in RGB")->required();
    auto* rough = app->add_option("--roughness", a->roughness,
                                  "perceptual roughness map; FILE:g takes the green channel");
    auto* smooth = app->add_option("--smoothness", a->smoothness, "smoothness map (1 - roughness)");
    rough->excludes(smooth);
    app->add_option("--rule", a->options.rule, "how roughness grows")->capture_default_str();
    app->add_option("--bits", a->bits, "8 or 16 bits a channel")
        ->check(CLI::IsMember({8, 16}))
        ->capture_default_str();
    app->add_flag("--green-down", a->green_down, "the normal map has +Y down (DirectX)");
    app->add_option("-o,--out", a->out, "roughness or smoothness of level k: 'out_%d.png'")
        ->required();
    app->add_option("--normal-out", a->normal_out, "normals of level k: 'normal_%d.png'");
    app->add_option("--threads", a->options.threads, "0: all cores; the bytes do not depend on it");
    app->add_option("--max-pixels", a->reading.max_pixels, "refuse larger inputs")
        ->capture_default_str();
    app->footer(
        "Example:\n  petrichor texture prefilter --normal wall_n.png --roughness wall_r.png "
        "-o 'wall_r_%d.png' --normal-out 'wall_n_%d.png'");
    app->callback([a] {
        if (a->roughness.empty() && a->smoothness.empty()) {
            throw Error("texture prefilter: no roughness map",
                        "Give --roughness FILE or --smoothness FILE.");
        }
        run(*a);
    });
}

}  // namespace petrichor::cli
