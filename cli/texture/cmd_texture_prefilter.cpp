#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "cli/texture/cmd_texture.h"
#include "cli/texture/files.h"
#include "cli/texture/prefilter_options.h"
#include "texproc/pack.h"
#include "texproc/prefilter/prefilter.h"
#include "texproc/prefilter/rules.h"
#include "texproc/prefilter/score.h"

namespace petrichor::cli {

namespace {

struct Arguments {
    PrefilterInput input;
    std::string out, normal_out, anisotropy_out, quality = "full";
    int bits = 16;
    bool roughness_only = false, score = false;
};

// Level 0 is the input in the depth that was asked for.
texproc::RawImage recoded(const texproc::RawImage& image, int bits)
{
    const texproc::PixelType type = bits == 8 ? texproc::PixelType::U8 : texproc::PixelType::U16;
    if (image.type == type) return image;
    return texproc::to_raw(texproc::to_image(image, ColorSpace::Data), type);
}

void run(Arguments& a)
{
    level_name(a.out, 0);
    if (!a.normal_out.empty()) level_name(a.normal_out, 0);
    texproc::PrefilterOptions& o = a.input.options;
    o.joint = !a.roughness_only;
    o.quick = a.quality == "quick";
    o.anisotropic = !a.anisotropy_out.empty();
    // Re-aimed normals are of use only where they are written.
    if (a.normal_out.empty()) {
        o.joint = false;
    } else {
        o.bits = a.bits;
    }
    PrefilterMaps maps = read_prefilter_maps(a.input);
    texproc::Prefiltered chains = texproc::prefilter_raw(maps.normal, maps.map, o);
    if (a.score) {
        texproc::Prefiltered shipped = chains;
        texproc::quantize(shipped, a.bits);
        if (a.normal_out.empty()) shipped.normal.clear();
        texproc::ScoreOptions scoring;
        scoring.light = o.design_light;
        std::cout << to_text(texproc::score(maps.normal, maps.map, shipped, o, scoring));
    }
    const texproc::WriteOptions writing{.bits = a.bits, .threads = o.threads};
    texproc::write_raw(level_name(a.out, 0),
                       recoded(texproc::channel_of(maps.map, o.channel), a.bits), writing);
    if (!a.normal_out.empty()) {
        texproc::write_raw(level_name(a.normal_out, 0), recoded(maps.normal, a.bits), writing);
    }
    for (std::size_t k = 1; k < chains.roughness.size(); ++k) {
        const int level = static_cast<int>(k);
        texproc::write_image(level_name(a.out, level), chains.roughness[k], writing);
        if (!a.normal_out.empty()) {
            texproc::write_image(level_name(a.normal_out, level), chains.normal[k], writing);
        }
        if (!a.anisotropy_out.empty()) {
            texproc::write_image(level_name(a.anisotropy_out, level), chains.anisotropy[k], writing);
        }
    }
    std::cout << chains.roughness.size() << " levels, " << maps.normal.width << " x "
              << maps.normal.height << ", rule " << o.rule << "\n";
}

}  // namespace

void add_texture_prefilter(CLI::App& texture)
{
    auto a = std::make_shared<Arguments>();
    a->input.options.rule = "overlap";
    CLI::App* app = texture.add_subcommand(
        "prefilter", "mip levels whose roughness holds what the normals lose");
    add_prefilter_input(*app, a->input);
    app->add_option("--rule", a->input.options.rule, "how the lobe of a texel is found; see below")
        ->capture_default_str();
    app->add_option("--design-light", a->input.options.design_light,
                    "alpha of the light to fit for: 0 the sun, 0.1 a window")
        ->capture_default_str();
    app->add_option("--quality", a->quality, "overlap: full or quick")
        ->check(CLI::IsMember({"full", "quick"}))
        ->capture_default_str();
    app->add_flag("--roughness-only", a->roughness_only, "overlap: keep the mean normals");
    app->add_option("--bits", a->bits, "8 or 16 bits a channel")
        ->check(CLI::IsMember({8, 16}))
        ->capture_default_str();
    app->add_flag("--score", a->score, "print the lobe error of the files as written");
    app->add_option("-o,--out", a->out, "roughness or smoothness of level k: 'out_%d.png'")
        ->required();
    app->add_option("--normal-out", a->normal_out,
                    "normals of level k: 'normal_%d.png'; without it only roughness changes");
    app->add_option("--anisotropy-out", a->anisotropy_out,
                    "direction (RG) and strength (B) as in glTF: 'aniso_%d.png'");
    std::string notes = "Rules:\n";
    for (const texproc::Rule& rule : texproc::rules()) {
        notes += "  " + rule.name + std::string(14 - std::min<std::size_t>(13, rule.name.size()), ' ') +
                 rule.note + "\n";
    }
    app->footer(notes +
                "\nExample:\n  petrichor texture prefilter --normal wall_n.png --roughness wall_r.png "
                "-o 'wall_r_%d.png' --normal-out 'wall_n_%d.png'");
    app->callback([a] { run(*a); });
}

}  // namespace petrichor::cli
