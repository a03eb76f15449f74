#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>
#include <utility>

#include "cli/texture/block_fit.h"
#include "cli/texture/chain_output.h"
#include "base/error.h"
#include "cli/texture/cmd_texture.h"
#include "cli/texture/maps/files.h"
#include "cli/texture/prefilter_options.h"
#include "cli/texture/prefilter_timings.h"
#include "texproc/codecs/files/texture.h"
#include "texproc/filter/normal_codes.h"
#include "texproc/material/normal_channels.h"
#include "texproc/material/pack.h"
#include "texproc/prefilter/prefilter.h"
#include "texproc/prefilter/rules.h"
#include "texproc/study/score.h"

namespace petrichor::cli {

namespace {

struct Arguments {
    PrefilterInput input;
    std::string out, normal_out, anisotropy_out, base_share_out, metal_share_out, second_lobe_out;
    std::string quality = "full", surface = "both";
    std::string format, normal_format;
    int bits = 16;
    bool roughness_only = false, score = false, timings = false;
};

std::optional<texproc::Block> block_of(const std::string& format)
{
    if (format.empty()) return {};
    return texproc::texture_format(format).block;
}

// What will be read from the files decides codes and score.
StoredFormats stored_formats(const Arguments& a, const PrefilterMaps& maps)
{
    const bool normals = !a.normal_out.empty();
    return {.normal = normals ? block_of(a.normal_format) : std::nullopt,
            .roughness = block_of(a.format),
            .bits = a.bits,
            .normal_channels = maps.normal.channels,
            .keeps_normals = normals};
}

// What a reader of the files will see.
void print_score(const Arguments& a, const PrefilterMaps& maps, const BlockFit& fit)
{
    texproc::ScoreOptions scoring;
    scoring.light = a.input.options.design_light;
    std::cout << to_text(texproc::score(maps.normal, maps.map, fit.read, a.input.options, scoring));
}

void take_options(Arguments& a)
{
    for (const std::string& name : {a.out, a.normal_out, a.anisotropy_out, a.base_share_out,
                                    a.metal_share_out, a.second_lobe_out}) {
        if (!name.empty()) check_chain_name(name);
    }
    texproc::PrefilterOptions& o = a.input.options;
    o.joint = !a.roughness_only;
    o.quick = a.quality == "quick";
    o.anisotropic = !a.anisotropy_out.empty();
    if (!a.base_share_out.empty() && o.rule != "picture") {
        throw Error("prefilter: the rule '" + o.rule + "' makes no base share",
                    "Use the rule picture, or leave --base-share-out out.");
    }
    o.surface = a.surface == "metal"   ? texproc::SurfaceClass::Metal
                : a.surface == "paint" ? texproc::SurfaceClass::Paint
                                       : texproc::SurfaceClass::Both;
    if (a.surface != "both" && (o.rule != "picture" || o.quick)) {
        throw Error("prefilter: --surface changes the rule picture in full quality only",
                    "Leave --surface out.");
    }
    const bool metal = o.rule == "picture" && !o.quick && a.surface != "paint";
    if (!a.metal_share_out.empty() && (!metal || a.normal_out.empty() || a.roughness_only)) {
        throw Error("prefilter: there is no metal share without the rule picture in full quality, "
                    "normals and metal",
                    "Add --normal-out, or leave --metal-share-out out.");
    }
    if (!a.second_lobe_out.empty()) o.lobes = 2;
    // Re-aimed normals are of use only where they are written. Blocks choose their own codes.
    if (a.normal_out.empty()) {
        o.joint = false;
    } else if (!block_of(a.normal_format) && !block_of(a.format)) {
        o.bits = a.bits;
    }
}

// RG normal, B roughness, A share (formulas/light/second_lobe.h); of level 0 both lobes are the same.
Image second_lobe(const Image& normal, const Image& roughness, const Image* share)
{
    Image to(normal.width, normal.height, 4, ColorSpace::Data, 0.5f);
    for (std::size_t i = 0; i < roughness.pixels.size(); ++i) {
        std::copy_n(&normal.pixels[3 * i], 2, &to.pixels[4 * i]);
        to.pixels[4 * i + 2] = roughness.pixels[i];
        if (share) to.pixels[4 * i + 3] = share->pixels[i];
    }
    return to;
}

void write_second_lobe(const Arguments& a, const PrefilterMaps& maps, const texproc::Prefiltered& chains)
{
    const texproc::PrefilterOptions& o = a.input.options;
    const Image normal = texproc::to_image(maps.normal, ColorSpace::Data),
                map = texproc::to_image(maps.map, ColorSpace::Data);
    Image xy(normal.width, normal.height, 3, ColorSpace::Data), rough(map.width, map.height, 1, ColorSpace::Data);
    const auto channel = [](const Image& from, std::size_t i, int c) {
        return from.pixels[i * static_cast<std::size_t>(from.channels) + static_cast<std::size_t>(c)];
    };
    for (std::size_t i = 0; i < rough.pixels.size(); ++i) {
        xy.pixels[3 * i] = channel(normal, i, o.normal_x);
        xy.pixels[3 * i + 1] = channel(normal, i, o.normal_y);
        rough.pixels[i] = channel(map, i, map.channels == 1 ? 0 : o.channel);
    }
    std::vector<Image> levels(1);
    for (std::size_t k = 1; k < chains.second.share.size(); ++k)
        levels.push_back(second_lobe(chains.second.normal[k], chains.second.roughness[k], &chains.second.share[k]));
    const texproc::PixelType type = a.bits == 8 ? texproc::PixelType::U8 : texproc::PixelType::U16;
    write_chain({a.second_lobe_out, "", a.bits, o.threads, {}},
                texproc::to_raw(second_lobe(xy, rough, nullptr), type), "", levels);
}

void write_chains(const Arguments& a, const PrefilterMaps& maps, const BlockFit& fit,
                  texproc::Prefiltered& chains)
{
    const texproc::PrefilterOptions& o = a.input.options;
    const bool whole = maps.map.channels == 1;
    texproc::RawImage channel;
    if (!whole) channel = texproc::channel_of(maps.map, o.channel);
    write_chain({a.out, a.format, a.bits, o.threads, fit.roughness_weights},
                whole ? maps.map : channel, whole ? maps.map_path : "", chains.roughness);
    if (!a.second_lobe_out.empty()) write_second_lobe(a, maps, chains);
    if (!a.normal_out.empty()) {
        for (std::size_t k = 1; k < chains.normal.size(); ++k) {
            chains.normal[k] =
                texproc::lay_out_normals(std::move(chains.normal[k]), o, maps.normal.channels);
        }
        const bool xyz = maps.normal.channels == 3 && o.normal_x == 0 && !o.rebuild_z;
        texproc::RawImage unit;
        if (xyz && texproc::drops_z(a.normal_format)) {
            unit = texproc::unit_normals(maps.normal, texproc::PixelType::U16);
        }
        write_chain({a.normal_out, a.normal_format, a.bits, o.threads, fit.normal_weights,
                     a.bits == 8 && !block_of(a.normal_format)},
                    unit.bytes.empty() ? maps.normal : unit, a.input.normal, chains.normal);
    }
    if (!a.base_share_out.empty()) {
        const Image one(maps.normal.width, maps.normal.height, 1, ColorSpace::Data, 1.0f);
        write_chain({a.base_share_out, "", a.bits, o.threads, {}},
                    texproc::to_raw(one, texproc::PixelType::U8), "", chains.base_share);
    }
    if (!a.metal_share_out.empty()) {
        const Image one(maps.normal.width, maps.normal.height, 1, ColorSpace::Data, 1.0f);
        write_chain({a.metal_share_out, "", a.bits, o.threads, {}},
                    texproc::to_raw(one, texproc::PixelType::U8), "", chains.metal_share);
    }
    if (!a.anisotropy_out.empty()) {
        // Level 0 has none: along x, strength 0.
        Image none(maps.normal.width, maps.normal.height, 3, ColorSpace::Data, 0.5f);
        for (std::size_t i = 0; i < none.pixels.size(); i += 3) {
            none.pixels[i] = 1.0f;
            none.pixels[i + 2] = 0.0f;
        }
        write_chain({a.anisotropy_out, "", a.bits, o.threads, {}},
                    texproc::to_raw(none, texproc::PixelType::U8), "", chains.anisotropy);
    }
}

std::size_t bytes_of(const PrefilterMaps& maps, const texproc::Prefiltered& chains)
{
    std::size_t bytes = maps.normal.bytes.size() + maps.map.bytes.size();
    for (const auto* chain : {&chains.normal, &chains.roughness}) {
        for (const Image& level : *chain) bytes += level.pixels.size() * sizeof(float);
    }
    return bytes;
}

void run(Arguments& a)
{
    take_options(a);
    const texproc::PrefilterOptions& o = a.input.options;
    PrefilterTimings timings;
    PrefilterMaps maps;
    texproc::Prefiltered chains;
    timings.read = timed([&] { maps = read_prefilter_maps(a.input); });
    if (o.bits == 8 && o.rule == "overlap") {  // lobes are fitted to the level 0 that ships
        // What was rounded is no longer what the source file holds, which else is copied.
        if (maps.normal.type != texproc::PixelType::U8) a.input.normal.clear();
        if (maps.map.type != texproc::PixelType::U8) maps.map_path.clear();
        maps.normal = texproc::normals_in_8_bits(std::move(maps.normal), o.normal_x, o.normal_y);
        maps.map = texproc::in_8_bits(std::move(maps.map));
    }
    BlockFit fit;
    timings.kernel = timed([&] {
        chains = texproc::prefilter_raw(maps.normal, maps.map, o);
        const StoredFormats formats = stored_formats(a, maps);
        if (a.score || formats.normal || formats.roughness) {
            fit = fit_to_blocks(maps.normal, maps.map, o, formats, chains);
        }
    });
    if (a.score) print_score(a, maps, fit);
    timings.texels =
        static_cast<std::size_t>(maps.normal.width) * static_cast<std::size_t>(maps.normal.height);
    timings.bytes = bytes_of(maps, chains);
    timings.write = timed([&] { write_chains(a, maps, fit, chains); });
    std::cout << chains.roughness.size() << " levels, " << maps.normal.width << " x "
              << maps.normal.height << ", rule " << o.rule << "\n";
    if (a.timings) std::cout << to_text(timings);
}

}  // namespace

void add_texture_prefilter(CLI::App& texture)
{
    auto a = std::make_shared<Arguments>();
    a->input.options.rule = "picture";
    CLI::App* app = texture.add_subcommand(
        "prefilter", "mip levels whose roughness holds what the normals lose");
    add_prefilter_input(*app, a->input);
    app->add_option("--rule", a->input.options.rule, "how the lobe of a texel is found; see below")
        ->capture_default_str();
    app->add_option("--design-light", a->input.options.design_light,
                    "alpha of the light to fit for: 0 the sun, 0.1 a window")
        ->capture_default_str();
    app->add_option("--quality", a->quality, "picture, overlap: full or quick")
        ->check(CLI::IsMember({"full", "quick"}))
        ->capture_default_str();
    app->add_flag("--roughness-only", a->roughness_only, "overlap: keep the mean normals");
    app->add_option("--bits", a->bits, "8 or 16 bits a channel")
        ->check(CLI::IsMember({8, 16}))
        ->capture_default_str();
    app->add_flag("--score", a->score, "print the lobe error of the files as written");
    app->add_flag("--timings", a->timings,
                  "print the time of reading, filtering and writing, beside memory bandwidth");
    app->add_option(
           "-o,--out", a->out,
           "roughness or smoothness of level k: 'out_%d.png', or all levels in out.dds, out.ktx2")
        ->required();
    app->add_option(
        "--normal-out", a->normal_out,
        "normals of level k: 'normal_%d.png' or normal.ktx2; without it only roughness changes");
    app->add_option("--format", a->format,
                    "of a texture file: r8, bc4, ...; default: plain numbers");
    app->add_option("--normal-format", a->normal_format,
                    "of a texture file of normals: bc5, bc7, ...");
    app->add_option("--anisotropy-out", a->anisotropy_out,
                    "direction (RG) and strength (B) as in glTF: 'aniso_%d.png'");
    app->add_option("--base-share-out", a->base_share_out,
                    "picture: what to multiply the base colour of level k by: 'share_%d.png'");
    app->add_option("--metal-share-out", a->metal_share_out,
                    "picture in full: the same of metal, 'metal_%d.png'");
    app->add_option("--second-lobe-out", a->second_lobe_out,
                    "picture in full: a second lobe of level k, normal RG, roughness B, share A: 'lobe_%d.png'; read as "
                    "formulas/light/second_lobe.h says");
    app->add_option("--surface", a->surface,
                    "picture in full: paint (anything but metal), metal, or both, which is a little "
                    "worse on either")
        ->check(CLI::IsMember({"both", "paint", "metal"}))
        ->capture_default_str();
    std::string notes = "Rules:\n";
    for (const texproc::Rule& rule : texproc::rules()) {
        notes += "  " + rule.name +
                 std::string(14 - std::min<std::size_t>(13, rule.name.size()), ' ') + rule.note +
                 "\n";
    }
    app->footer(
        notes +
        "\nExample:\n  petrichor texture prefilter --normal wall_n.png --roughness wall_r.png "
        "-o 'wall_r_%d.png' --normal-out 'wall_n_%d.png'\n"
        "  petrichor texture prefilter --smoothness Wall_LuxSPEC.png --bits 8 -o wall_s.dds "
        "--format bc4 --normal-out wall_n.dds --normal-format bc5");
    app->callback([a] { run(*a); });
}

}  // namespace petrichor::cli
