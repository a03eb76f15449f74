#include "texproc/material/plan.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "base/error.h"
#include "base/words.h"

namespace petrichor::texproc {

namespace {

namespace fs = std::filesystem;

bool contains(const std::vector<std::string>& list, const std::string& word)
{
    return std::find(list.begin(), list.end(), word) != list.end();
}

// The maps a role can be baked from; the first group whose maps are all there is taken.
bool can_bake(const std::string& role, const MaterialFiles& files, const Recipe& recipe)
{
    if (!contains(recipe.bake, role)) return false;
    const auto given = [&](const char* name) { return files.inputs.count(name) > 0; };
    if (role == "porosity") return given("roughness") || given("smoothness");
    if (role == "height") return given("normal");
    return given("height");
}

// The roles that the channels of a rule take from a material; `missing` is the first one that a
// channel cannot do without, or the first one of all when every channel is a constant.
struct Roles {
    std::vector<std::string> taken;
    std::string missing;
};
Roles roles_of(const OutputRule& rule, const PlannedMaterial& material)
{
    Roles roles;
    std::string first;
    for (const std::string& text : rule.channels.channels) {
        const PackChannel sources = parse_pack_channel(text);
        const auto used = std::find_if(sources.begin(), sources.end(), [&](const PackSource& s) {
            return s.role.empty() || material.files.inputs.count(s.role) > 0 ||
                   can_bake(s.role, material.files, *material.recipe);
        });
        if (first.empty()) first = sources.front().role;
        if (used == sources.end()) {
            if (roles.missing.empty()) roles.missing = sources.front().role;
        } else if (!used->role.empty() && !contains(roles.taken, used->role)) {
            roles.taken.push_back(used->role);
        }
    }
    if (roles.taken.empty()) roles.missing = first;
    return roles;
}

// The output of a rule for a material whose maps are there.
PlannedOutput planned(const OutputRule& rule, const PlannedMaterial& material,
                      std::vector<std::string> roles)
{
    PlannedOutput out;
    out.rule = rule;
    out.roles = std::move(roles);
    std::string name = rule.file;
    name.replace(name.find("{name}"), 6, material.files.name);
    if (!material.files.tile.empty()) name += "." + material.files.tile;
    out.stem = (fs::path(rule.folder) / material.files.folder / name).generic_string();
    const Recipe& recipe = *material.recipe;
    const auto& inputs = material.files.inputs;
    const bool pair =
        inputs.count("normal") && (inputs.count("roughness") || inputs.count("smoothness"));
    out.prefiltered = rule.prefilter && recipe.prefilter.rule != "none" && pair &&
                      (rule.has_levels() || rule.size > 0) &&
                      (contains(out.roles, "roughness") || contains(out.roles, "smoothness") ||
                       contains(out.roles, "normal"));
    return out;
}

// Beside the normals of every folder, in each kind of file that they have: a second lobe of their texels.
void add_second_lobes(PlannedMaterial& material)
{
    const Recipe& recipe = *material.recipe;
    if (recipe.prefilter.lobes != 2) return;
    if (recipe.prefilter.rule != "picture" || recipe.prefilter.quick) {
        throw Error("texture build: a second lobe is made by the rule picture in full quality",
                    "Add --quality full, or leave --lobes out.");
    }
    std::vector<PlannedOutput> more;
    std::set<std::pair<std::string, std::string>> places;
    for (const PlannedOutput& output : material.outputs) {
        if (!output.prefiltered || !contains(output.roles, "normal") || !output.rule.has_levels()) continue;
        if (!places.emplace(output.rule.folder, output.rule.format).second) continue;
        PlannedOutput second;
        second.rule = output.rule;
        second.rule.file = "{name}_second_lobe";
        const auto& of_normal = output.rule.channels.channels;
        const bool turned = std::find(of_normal.begin(), of_normal.end(), "1 - normal.g") != of_normal.end();
        second.rule.channels = {"second lobe",
                                "normal RG, roughness B, share A",
                                {"second_lobe.r", turned ? "1 - second_lobe.g" : "second_lobe.g", "second_lobe.b",
                                 "second_lobe.a"},
                                {}};
        second.rule.compression = "none";  // four numbers that have little to do with each other: blocks cost too much
        second.rule.rdo.reset();
        second.roles = {kSecondLobe};
        second.prefiltered = true;
        const std::string name = material.files.name + (material.files.tile.empty() ? "" : "." + material.files.tile);
        std::string file = second.rule.file;
        second.stem = (fs::path(output.rule.folder) / material.files.folder /
                       file.replace(0, 6, name)).generic_string();
        more.push_back(std::move(second));
    }
    const auto& inputs = material.files.inputs;
    if (more.empty() && inputs.count("normal") && (inputs.count("roughness") || inputs.count("smoothness"))) {
        throw Error("texture build: " + material.name + ": no output holds normals with their levels, which a second "
                        "lobe goes with",
                    "Ask for dds or ktx2 (--format), or leave --lobes out.");
    }
    material.outputs.insert(material.outputs.end(), more.begin(), more.end());
}

void check_files(const PlannedMaterial& material)
{
    for (const auto& [role, map] : material.files.inputs) {
        std::error_code failed;
        if (fs::is_regular_file(map.path, failed)) continue;
        throw Error("texture build: " + material.name + ": its " + role + " map " +
                        map.path.string() + " does not exist",
                    "Correct the path in " +
                        (material.recipe->file.empty() ? std::string("the recipe")
                                                       : material.recipe->file.string()) +
                        "; it is relative to the recipe.");
    }
}

}  // namespace

PlannedMaterial plan_material(const MaterialFiles& files,
                              const std::shared_ptr<const Recipe>& recipe)
{
    PlannedMaterial material;
    material.files = files;
    material.recipe = recipe;
    material.name = (files.folder / files.name).generic_string();
    if (!files.tile.empty()) material.name += "." + files.tile;
    check_files(material);
    for (const OutputRule& rule : recipe->outputs) {
        const Roles roles = roles_of(rule, material);
        const PlannedOutput output = planned(rule, material, roles.taken);
        if (!roles.missing.empty()) {
            material.left_out.push_back(output.file() + ": there is no " + roles.missing);
            continue;
        }
        for (const std::string& role : roles.taken) {
            if (!files.inputs.count(role) && !contains(material.baked, role))
                material.baked.push_back(role);
        }
        material.outputs.push_back(output);
    }
    add_second_lobes(material);
    return material;
}

void check_output_names(const std::vector<PlannedMaterial>& plan)
{
    std::map<std::string, std::string> owner;
    std::set<std::string> names;
    for (const PlannedMaterial& material : plan) {
        if (!names.insert(material.name).second) {
            throw Error("texture build: two materials are called " + material.name,
                        "Write another name = \"...\" into one of the recipes.");
        }
        for (const PlannedOutput& output : material.outputs) {
            const auto [at, fresh] = owner.emplace(output.file(), material.name);
            if (fresh) continue;
            throw Error("texture build: " + output.file() + " would be written twice, for " +
                            at->second + " and for " + material.name,
                        "Give the outputs or the materials different names.");
        }
    }
}

std::string to_text(const PlannedMaterial& material)
{
    std::string text = material.name + "\n";
    for (const auto& [role, map] : material.files.inputs) {
        text +=
            "  " + role + std::string(std::max<std::size_t>(1, 12 - role.size()), ' ') + map.text();
        if (role == "normal" && material.files.green == Green::Down)
            text += "  (green down: turned)";
        text += "\n";
    }
    if (!material.baked.empty()) text += "  baked       " + join_words(material.baked) + "\n";
    for (const std::string& note : material.files.notes) text += "  note        " + note + "\n";
    for (const PlannedOutput& output : material.outputs) {
        const OutputRule& rule = output.rule;
        text += "  -> " + output.file() + "  " + std::to_string(rule.bits) + " bits" +
                (rule.srgb() ? " sRGB" : "") +
                (rule.compression == "none" ? "" : " " + rule.compression) +
                (rule.has_levels() ? " mips" : "") + (output.prefiltered ? " prefiltered" : "") +
                "\n";
        for (std::size_t c = 0; c < rule.channels.channels.size(); ++c) {
            text += std::string("       ") + "RGBA"[c] + " = " + rule.channels.channels[c] + "\n";
        }
    }
    for (const std::string& file : material.left_out) text += "  left out    " + file + "\n";
    return text;
}

}  // namespace petrichor::texproc
