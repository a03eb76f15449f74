#include "cli/texture/build/plan_build.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "base/error.h"
#include "cli/texture/build/recipe_file.h"
#include "texproc/prefilter/rules.h"

namespace petrichor::cli {

namespace {

namespace fs = std::filesystem;

void set_edges(const std::string& wrap, texproc::Recipe& recipe)
{
    recipe.mips.wrap_u = recipe.mips.wrap_v = wrap == "wrap";
    recipe.mips.mirror_u = recipe.mips.mirror_v = wrap == "mirror";
    recipe.baking.edge_u = recipe.baking.edge_v = wrap == "wrap"     ? texproc::Edge::Wrap
                                                  : wrap == "mirror" ? texproc::Edge::Mirror
                                                                     : texproc::Edge::Clamp;
}

// Only readers of two-channel blocks make z themselves.
void keep_z(texproc::OutputRule& output)
{
    std::vector<std::string>& channels = output.channels.channels;
    if (output.compression != "none" || channels.size() != 2) return;
    if (channels[0] == "normal.r" && channels[1].ends_with("normal.g"))
        channels.push_back("normal.b");
}

void apply_rdo(const BuildChoice& choice, texproc::Recipe& recipe)
{
    if (!choice.rdo && !choice.rdo_most) return;
    bool taken = false;
    for (texproc::OutputRule& output : recipe.outputs) {
        if (!output.has_rdo()) continue;
        if (choice.rdo) output.rdo = choice.rdo;
        if (choice.rdo_most) output.rdo_most = *choice.rdo_most;
        taken = taken || choice.rdo || output.price_of_a_bit() > 0.0f;
    }
    if (taken) return;
    throw Error(std::string("texture build: no output is one for ") +
                    (choice.rdo ? "--rdo" : "--rdo-most"),
                choice.rdo ? "Leave it out: it is for blocks (bc1 to bc7, uastc)."
                           : "Add --rdo 1, or leave it out.");
}

void apply(const BuildChoice& choice, texproc::Recipe& recipe)
{
    if (!choice.engines.empty()) {
        recipe.engines = choice.engines;
        recipe.outputs = engine_outputs(choice.engines);
    }
    if (!choice.rule.empty()) {
        if (choice.rule != "none") texproc::rule_named(choice.rule);
        recipe.prefilter.rule = choice.rule;
    }
    if (!choice.quality.empty()) recipe.prefilter.quick = choice.quality == "quick";
    if (choice.lobes != 0) recipe.prefilter.lobes = choice.lobes;
    if (choice.no_score) recipe.score = false;
    if (!choice.wrap.empty()) set_edges(choice.wrap, recipe);
    if (choice.normal_green == "up") recipe.green = texproc::Green::Up;
    if (choice.normal_green == "down") recipe.green = texproc::Green::Down;
    for (texproc::OutputRule& output : recipe.outputs) {
        if (choice.size > 0) output.size = choice.size;
        if (choice.format.empty()) continue;
        output.format = choice.format;
        const bool holds = choice.format == "ktx2" ||
                           (choice.format == "dds" && !output.in_ktx2_alone());
        if (!holds) output.compression = "none";
        if (choice.format != "dds") output.blue_first = false;
        keep_z(output);
        if (choice.format == "exr") output.bits = std::max(output.bits, 16);
        if (choice.format == "tga") output.bits = 8;
    }
    apply_rdo(choice, recipe);
}

std::vector<texproc::MaterialFiles> materials_of(const texproc::Recipe& recipe)
{
    if (!recipe.folder.empty()) return texproc::find_materials(recipe.folder);
    texproc::MaterialFiles files;
    files.name = recipe.name;
    files.inputs = recipe.inputs;
    const auto normal = files.inputs.find("normal");
    if (normal != files.inputs.end()) {
        std::string stem = normal->second.path.stem().string();
        if (const std::size_t mark = stem.find("<UDIM>"); mark != std::string::npos)
            stem.replace(mark, 6, "1001");
        files.green = texproc::maps_named(stem).green;
    }
    return texproc::udim_tiles(files);
}

}  // namespace

std::vector<texproc::PlannedMaterial> plan_build(const std::vector<fs::path>& inputs,
                                                 const BuildChoice& choice)
{
    std::vector<texproc::PlannedMaterial> plan;
    for (const fs::path& input : inputs) {
        texproc::Recipe recipe;
        if (input.extension() == ".toml") {
            recipe = read_recipe(input);
        } else {
            recipe.folder = input;
        }
        apply(choice, recipe);
        if (recipe.outputs.empty()) {
            throw Error(
                "texture build: " + input.string() + ": nothing says what to make",
                "Give --engine NAME (see --list), or write engines = [\"...\"] or [[output]] "
                "into a recipe.");
        }
        const auto shared = std::make_shared<const texproc::Recipe>(recipe);
        // What lies past the edge of a tile is another tile.
        if (choice.wrap.empty()) set_edges("clamp", recipe);
        const auto tiled = std::make_shared<const texproc::Recipe>(recipe);
        for (const texproc::MaterialFiles& files : materials_of(recipe)) {
            texproc::PlannedMaterial material = 
                texproc::plan_material(files, files.tile.empty() ? shared : tiled);
            if (material.outputs.empty() && recipe.folder.empty()) {
                throw Error("texture build: " + input.string() + ": none of its outputs has a map",
                            "Name the maps that the outputs take, or choose other outputs.");
            }
            if (!material.outputs.empty()) plan.push_back(std::move(material));
        }
        if (plan.empty()) {
            throw Error(
                "texture build: no material in " + input.string() + " has maps for these outputs",
                "Choose another engine or other outputs.");
        }
    }
    texproc::check_output_names(plan);
    return plan;
}

std::vector<texproc::PlannedMaterial> plan_materials(
    const std::vector<texproc::MaterialFiles>& materials, const BuildChoice& choice)
{
    texproc::Recipe recipe;
    apply(choice, recipe);
    std::vector<texproc::PlannedMaterial> plan;
    for (const texproc::MaterialFiles& files : materials) {
        texproc::Recipe own = recipe;
        if (choice.wrap.empty()) {
            own.mips.wrap_u = files.edge_u == texproc::Edge::Wrap;
            own.mips.wrap_v = files.edge_v == texproc::Edge::Wrap;
            own.mips.mirror_u = files.edge_u == texproc::Edge::Mirror;
            own.mips.mirror_v = files.edge_v == texproc::Edge::Mirror;
        }
        texproc::PlannedMaterial material =
            texproc::plan_material(files, std::make_shared<const texproc::Recipe>(own));
        if (!material.outputs.empty()) plan.push_back(std::move(material));
    }
    texproc::check_output_names(plan);
    return plan;
}

}  // namespace petrichor::cli
