#include "cli/texture/score_protocol.h"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <span>

#include "base/error.h"
#include "base/words.h"
#include "cli/texture/maps/files.h"
#include "cli/texture/naming.h"
#include "texproc/material/pack.h"
#include "texproc/study/fresh_maps.h"
#include "texproc/study/protocol.h"

namespace petrichor::cli {

namespace {

constexpr int kHardSize = 512;
constexpr int kFreshSize = 384;
constexpr int kPatch = 37;  // no level has a border at every patch

// A set as its maps, and once more after rain where a height map tells where water stands.
void add_set(const std::string& set, const ProtocolRequest& request,
             const texproc::ReadOptions& reading, std::vector<texproc::ScoredMaps>& materials)
{
    const std::filesystem::path map =
        std::filesystem::is_directory(set) ? find_material(set) : std::filesystem::path(set);
    const NormalPartner partner = find_normal(map);
    texproc::PrefilterOptions input;
    input.smoothness = partner.smoothness;
    input.green_down = partner.green_down;
    const texproc::RawImage normal = texproc::read_raw(partner.path, reading);
    const texproc::RawImage values = texproc::read_raw(map, reading);
    input.channel = std::min(partner.channel, values.channels - 1);
    const std::string stem = map.stem().string();
    materials.push_back(
        texproc::scored_maps(stem.substr(0, stem.find('_')), normal, values, input));
    const std::optional<std::string> height = request.puddles ? find_height(map) : std::nullopt;
    if (!height) return;
    texproc::RawImage levels = read_map(*height, reading);
    if (levels.channels > 1) levels = texproc::channel_of(levels, 0);
    materials.push_back(
        texproc::with_puddles(materials.back(), texproc::to_image(levels, ColorSpace::Data)));
}

void add_patchwork(std::vector<texproc::ScoredMaps>& materials)
{
    const std::size_t count = materials.size();
    for (std::size_t i = 0; count > 1 && i < count; ++i) {
        materials.push_back(texproc::patchwork(materials[i], materials[(i + 1) % count], kPatch));
    }
}

void keep_only(const std::vector<std::string>& words, std::vector<texproc::ScoredMaps>& materials)
{
    if (words.empty()) return;
    std::erase_if(materials, [&](const texproc::ScoredMaps& maps) {
        return std::none_of(words.begin(), words.end(), [&](const std::string& word) {
            return glob_matches("*" + word + "*", maps.name);
        });
    });
}

}  // namespace

std::vector<texproc::Variant> requested_variants(const ProtocolRequest& request)
{
    std::vector<texproc::Variant> all = texproc::protocol_variants(request.bits), kept;
    if (request.rules.empty()) return all;
    std::vector<std::string> names;
    for (const texproc::Variant& v : all) names.push_back(v.name);
    for (const std::string& rule : request.rules) {
        const auto at = std::find(names.begin(), names.end(), rule);
        if (at == names.end()) {
            throw Error("score: there is no rule '" + rule + "'" + did_you_mean(rule, names),
                        "Use some of: " + join_words(names) + ".");
        }
        kept.push_back(all[static_cast<std::size_t>(at - names.begin())]);
    }
    return kept;
}

std::vector<texproc::ScoredMaps> requested_materials(const ProtocolRequest& request,
                                                     const texproc::ReadOptions& reading)
{
    std::vector<texproc::ScoredMaps> materials;
    for (const std::string& set : request.sets) add_set(set, request, reading, materials);
    if (request.patchwork) add_patchwork(materials);
    for (const std::uint32_t seed : request.fresh) {
        for (texproc::ScoredMaps& maps : texproc::fresh_maps(kFreshSize, seed)) {
            materials.push_back(std::move(maps));
        }
    }
    if (request.hard) {
        for (texproc::ScoredMaps& maps : texproc::hard_maps(kHardSize)) {
            materials.push_back(std::move(maps));
        }
    }
    keep_only(request.only, materials);
    if (materials.empty()) {
        throw Error(
            "score: there is nothing to score",
            "Name roughness maps or folders of materials, or leave --no-hard or --only out.");
    }
    return materials;
}

void run_score_protocol(const ProtocolRequest& request, const texproc::ReadOptions& reading,
                        int threads)
{
    const std::vector<texproc::Variant> variants = requested_variants(request);
    const std::vector<texproc::ScoredMaps> materials = requested_materials(request, reading);
    texproc::ProtocolOptions options;
    if (request.effort == "quick") options = texproc::quick_protocol();
    if (request.seeds > 0) options.seeds = request.seeds;
    options.bits = request.bits;
    options.threads = threads;
    options.best_ellipse = request.best_ellipse;
    options.best_codes = request.best_codes;
    options.progress = [](const std::string& what) { std::cerr << "score: " << what << "\n"; };
    const std::vector<texproc::ProtocolRow> rows =
        texproc::run_protocol(materials, variants, options);
    if (!request.csv.empty()) {
        const std::string text = texproc::to_csv(rows);
        texproc::write_bytes(request.csv, std::as_bytes(std::span(text)));
    }
    std::cout << materials.size() << " materials, " << request.bits << " bits, " << options.seeds
              << " seeds, " << options.texels << " texels a level, " << options.points
              << " points\n\n"
              << texproc::to_markdown(texproc::summarize(rows)) << "\n"
              << texproc::to_markdown_by_material(rows);
}

}  // namespace petrichor::cli
