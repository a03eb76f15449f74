#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>

#include "base/error.h"
#include "cli/texture/cmd_texture.h"
#include "cli/texture/maps/files.h"
#include "cli/texture/prefilter_options.h"
#include "cli/texture/score_picture.h"
#include "cli/texture/score_protocol.h"
#include "texproc/codecs/files/texture.h"
#include "texproc/material/normal_channels.h"
#include "texproc/study/score.h"

namespace petrichor::cli {

namespace {

struct Arguments {
    PrefilterInput input;
    std::string chain, normal_chain;
    texproc::ScoreOptions scoring;
    ProtocolRequest protocol;
    bool self_test = false, json = false;
};

// All levels of a texture file.
std::vector<Image> read_chain_file(const std::string& name, const texproc::ReadOptions& reading)
{
    const texproc::MipTexture texture = texproc::read_texture(name, reading);
    std::vector<Image> levels(1);
    for (std::size_t k = 1; k < texture.levels.size(); ++k) {
        levels.push_back(texproc::to_image(
            texproc::decode_level(texture, static_cast<int>(k), 0, true), ColorSpace::Data));
    }
    return levels;
}

// Levels 1.. of a chain, as far as there are files.
std::vector<Image> read_chain(const std::string& pattern, const texproc::ReadOptions& reading)
{
    if (pattern.find('%') == std::string::npos && texproc::holds_mip_chain(pattern)) {
        return read_chain_file(pattern, reading);
    }
    std::vector<Image> levels(1);
    const std::size_t colon = pattern.rfind(':');
    const bool has_channel = colon != std::string::npos && pattern.find('%') < colon;
    const std::string names = has_channel ? pattern.substr(0, colon) : pattern;
    const std::string channel = has_channel ? pattern.substr(colon) : "";
    for (int level = 1;; ++level) {
        const std::string name = level_name(names, level);
        if (!std::filesystem::exists(name)) break;
        levels.push_back(texproc::to_image(read_map(name + channel, reading), ColorSpace::Data));
    }
    if (levels.size() == 1) {
        throw Error("score: there is no " + level_name(names, 1),
                    "Name the chain as 'out_%d.png', with level 1 as out_1.png.");
    }
    return levels;
}

void print_json(const texproc::Score& s)
{
    std::printf("{\"levels\": [");
    const char* comma = "";
    for (const texproc::LevelScore& l : s.levels) {
        std::printf(
            "%s\n  {\"level\": %d, \"plain\": %.5f, \"best\": %.5f, \"error\": %.5f, "
            "\"energy\": %.5f}",
            comma, l.level, l.plain, l.best, l.tested, l.energy);
        comma = ",";
    }
    std::printf("\n]");
    const std::pair<const char*, texproc::RangeScore> ranges[] = {{"fine", s.fine()},
                                                                  {"coarse", s.coarse()}};
    for (const auto& [name, r] : ranges) {
        std::printf(
            ",\n\"%s\": {\"plain\": %.5f, \"best\": %.5f, \"error\": %.5f, "
            "\"worst_over_plain\": %.5f}",
            name, r.plain, r.best, r.tested, r.levels ? r.worst_over_plain : 0.0);
    }
    std::printf("}\n");
}

void run(Arguments& a)
{
    if (a.self_test) {
        bool good = true;
        for (const texproc::SelfCheck& check : texproc::score_self_test()) {
            std::printf("%-28s %8.4f  in %.3f..%.3f  %s\n", check.name.c_str(), check.value,
                        check.low, check.high, check.good() ? "ok" : "WRONG");
            good &= check.good();
        }
        if (!good) throw std::runtime_error("the yardstick does not measure what it should");
        return;
    }
    if (!a.protocol.sheet.empty() && a.protocol.pictures.empty()) {
        throw Error("score: --sheet shows the pictures of --picture, which was not asked for",
                    "Add --picture quick, or leave --sheet out.");
    }
    if (a.json && (!a.protocol.pictures.empty() || !a.protocol.effort.empty())) {
        throw Error("score: --json is for the score of one map, --picture and --protocol write tables",
                    "Add --csv out.csv for every case, or leave --json out.");
    }
    if (!a.protocol.pictures.empty() && !a.protocol.effort.empty()) {
        throw Error("score: --picture and --protocol are two measures",
                    "Ask for one of them at a time.");
    }
    if (a.protocol.drawn_seed != 1 && a.protocol.pictures != "drawn") {
        throw Error("score: --drawn-seed is for --picture drawn", "Add --picture drawn, or leave the seed out.");
    }
    if (a.protocol.lobes != 1 && a.protocol.pictures.empty()) {
        throw Error("score: --lobes is for --picture", "Add --picture quick, or leave --lobes out.");
    }
    if (a.protocol.best_codes && (a.protocol.effort.empty() || a.protocol.bits != 8)) {
        throw Error("score: --best-codes looks at every code of 8 bits, for --protocol",
                    "Add --protocol quick --bits 8, or leave --best-codes out.");
    }
    if (!a.protocol.pictures.empty()) {
        run_score_picture(a.protocol, a.input.reading, a.input.options.threads);
        return;
    }
    if (!a.protocol.effort.empty()) {
        a.protocol.best_ellipse = a.scoring.best_ellipse;
        run_score_protocol(a.protocol, a.input.reading, a.input.options.threads);
        return;
    }
    if (a.chain.empty()) {
        throw Error("score: no chain was given", "Give --chain 'out_%d.png', or --selftest.");
    }
    const PrefilterMaps maps = read_prefilter_maps(a.input);
    texproc::Prefiltered chain;
    chain.roughness = read_chain(a.chain, a.input.reading);
    for (Image& level : chain.roughness) {
        if (level.channels > 1) {
            Image one(level.width, level.height, 1, level.space);
            for (std::size_t i = 0; i < one.pixels.size(); ++i) {
                one.pixels[i] = level.pixels[i * static_cast<std::size_t>(level.channels)];
            }
            level = std::move(one);
        }
    }
    if (!a.normal_chain.empty()) chain.normal = read_chain(a.normal_chain, a.input.reading);
    for (std::size_t k = 1; k < chain.normal.size(); ++k) {
        chain.normal[k] =
            texproc::read_out_normals(chain.normal[k], a.input.options, static_cast<int>(k));
    }
    const texproc::Score s =
        texproc::score(maps.normal, maps.map, chain, a.input.options, a.scoring);
    if (a.json) {
        print_json(s);
    } else {
        std::cout << to_text(s);
    }
}

}  // namespace

void add_texture_score(CLI::App& texture)
{
    auto a = std::make_shared<Arguments>();
    CLI::App* app = texture.add_subcommand(
        "score", "how much light the mips of any tool misplace (0 none .. 2 all)");
    add_prefilter_input(*app, a->input);
    app->add_option(
        "--chain", a->chain,
        "roughness or smoothness of level k: 'out_%d.png', or all levels in out.dds, out.ktx2");
    app->add_option("--normal-chain", a->normal_chain,
                    "normals of level k; default: the mean normals");
    app->add_option("--light", a->scoring.light, "alpha of the light: 0 the sun, 0.1 a window")
        ->capture_default_str();
    app->add_option("--texels", a->scoring.texels, "mip texels a level")->capture_default_str();
    app->add_option("--points", a->scoring.points, "half-vectors a texel")->capture_default_str();
    app->add_option("--seed", a->scoring.seed, "which texels and points")->capture_default_str();
    app->add_flag("--json", a->json, "for machines; of --picture and --protocol: --csv");
    app->add_flag("--selftest", a->self_test, "check the yardstick itself");
    app->add_option(
           "--protocol", a->protocol.effort,
           "score every rule on the named sets and on hard maps made from code: full (3 rolls "
           "of each map, 64 texels a level) or quick")
        ->check(CLI::IsMember({"full", "quick"}));
    app->add_option(
           "--picture", a->protocol.pictures,
           "score every rule by lit floors under a moving camera against supersampled ones: full "
           "(18 views and lights), quick (5), or drawn (12 that no rule was chosen with)")
        ->check(CLI::IsMember({"full", "quick", "drawn"}));
    app->add_option("--drawn-seed", a->protocol.drawn_seed, "for --picture drawn: which views and lights")
        ->check(CLI::Range(1, 1000000));
    app->add_option("--lobes", a->protocol.lobes,
                    "--picture: lobes of a texel that the rule picture in full quality may take")
        ->check(CLI::Range(1, 2));
    app->add_option("--sheet", a->protocol.sheet,
                    "--picture: a PNG of plain mips, the rules and the truth side by side");
    app->add_option("SETS", a->protocol.sets,
                    "for --protocol: roughness maps, or folders of materials");
    app->add_option("--rules", a->protocol.rules,
                    "for --protocol, --picture: only these, with commas between")
        ->delimiter(',')
        ->allow_extra_args(false);
    app->add_option("--bits", a->protocol.bits, "for --protocol: of the files that would ship")
        ->check(CLI::IsMember({8, 16}))
        ->capture_default_str();
    app->add_option("--seeds", a->protocol.seeds, "for --protocol: rolls of every map")
        ->check(CLI::Range(1, 100));
    app->add_flag("!--no-hard", a->protocol.hard,
                  "for --protocol: without the maps made from code");
    app->add_flag("!--no-puddles", a->protocol.puddles,
                  "for --protocol: no wet variant of sets with a height map");
    app->add_flag("--patchwork", a->protocol.patchwork,
                  "for --protocol: each set also in patches with the next one");
    app->add_option("--fresh", a->protocol.fresh,
                    "for --protocol: also 14 materials that no rule was chosen on, drawn from "
                    "this seed (several with commas between)")
        ->delimiter(',')
        ->allow_extra_args(false);
    app->add_option("--only", a->protocol.only,
                    "for --protocol: only materials with one of these words in their names")
        ->delimiter(',')
        ->allow_extra_args(false);
    app->add_flag("--best-ellipse", a->scoring.best_ellipse,
                  "also the best elliptic lobe of all, searched for at every texel: what no "
                  "anisotropic output can beat (slow)");
    app->add_flag("--best-codes", a->protocol.best_codes,
                  "for --protocol --bits 8: also the best lobes that 8 bits can hold, of all codes of normal and "
                  "roughness: what no rule can beat (slow)");
    app->add_option("--csv", a->protocol.csv,
                    "for --protocol, --picture: every level or case of every row");
    app->footer(
        "A gap of 100 % is the best isotropic lobe about the mean normal, 0 % plain mips; in "
        "brackets,\n"
        "where there is little to gain, the excess over the best lobe.\n\nExample:\n"
        "  petrichor texture score --normal n.png --roughness r.png --chain 'r_%d.png' "
        "--normal-chain 'n_%d.png'\n"
        "  petrichor texture score --protocol quick materials/Rock020 materials/Tiles036\n"
        "  petrichor texture score --picture quick --no-hard materials/Rock020 --rules "
        "unreal,picture "
        "--sheet floors.png\n"
        "  petrichor texture score --protocol quick --fresh 1,2 --only corrugated,strokes,brushed "
        "--best-ellipse");
    app->callback([a] { run(*a); });
}

}  // namespace petrichor::cli
