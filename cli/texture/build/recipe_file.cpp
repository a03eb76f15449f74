#include "cli/texture/build/recipe_file.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "base/words.h"
#include "cli/rooms.h"
#include "cli/texture/maps/pack_file.h"
#include "film/data/folders.h"
#include "film/toml/toml_value.h"
#include "texproc/filter/normal.h"
#include "texproc/prefilter/rules.h"

namespace petrichor::cli {

namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kFormats{"png", "tga", "tif", "exr", "dds", "ktx2"};
const std::vector<std::string> kCompressions{"none", "bc1", "bc3", "bc4", "bc5", "bc7", "uastc", "astc-4x4", "astc-5x5", "astc-6x6", "astc-8x8"};
const std::vector<std::string> kOrders{"rgba", "bgra"};
const std::vector<std::string> kImports{"none", "unity", "godot"};
const std::vector<std::string> kFilters{"box", "kaiser", "lanczos3", "mitchell"};
const std::vector<std::string> kEdges{"wrap", "clamp", "mirror"};

texproc::OutputRule read_output(const TomlValue& table, const fs::path& folder)
{
    texproc::OutputRule out;
    bool named = false, bounded = false;
    std::optional<bool> srgb;
    const auto entries =
        table.entries({"file", "preset", "channels", "srgb", "format", "compression", "bits",
                       "mips", "level_files", "size", "prefilter", "order", "import", "rdo",
                       "rdo_most"});
    for (const auto& [key, value] : entries) {
        if (key == "file") {
            out.file = value.text();
            named = out.file.find("{name}") != std::string::npos;
            if (!named) value.refuse("a name that holds {name}, such as \"{name}_mask\"");
        }
        if (key == "preset") out.channels = pack_preset_or_file(value.text(), folder);
        if (key == "channels") {
            out.channels.name = "channels";
            out.channels.channels = value.texts();
            if (out.channels.channels.empty() || out.channels.channels.size() > 4) {
                value.refuse("an array of 1 to 4 channels");
            }
            for (const std::string& c : out.channels.channels) texproc::parse_pack_channel(c);
        }
        if (key == "srgb") srgb = value.boolean();
        if (key == "format")
            out.format = kFormats[static_cast<std::size_t>(value.choice(kFormats))];
        if (key == "compression") {
            out.compression = kCompressions[static_cast<std::size_t>(value.choice(kCompressions))];
        }
        if (key == "bits") {
            out.bits = value.integer(8, 32);
            if (out.bits != 8 && out.bits != 16 && out.bits != 32) value.refuse("8, 16 or 32");
        }
        if (key == "mips") out.mips = value.boolean();
        if (key == "level_files") out.level_files = value.boolean();
        if (key == "size") out.size = value.integer(0, 65536);
        if (key == "prefilter") out.prefilter = value.boolean();
        if (key == "rdo") out.rdo = static_cast<float>(value.number(0.0, 1000.0));
        if (key == "rdo_most") {
            out.rdo_most = static_cast<float>(value.number(0.01, 255.0));
            bounded = true;
        }
        if (key == "order") out.blue_first = value.choice(kOrders) == 1;
        if (key == "import") {
            const int engine = value.choice(kImports);
            out.import = engine == 0 ? "" : kImports[static_cast<std::size_t>(engine)];
        }
    }
    if (srgb && *srgb) out.channels.srgb_channels = {"r", "g", "b"};
    if (srgb && !*srgb) out.channels.srgb_channels.clear();
    const auto wrong = [&](const std::string& what, const std::string& fix) {
        throw Error(table.place() + ": this output " + what, fix);
    };
    if (!named) wrong("has no file", "Write file = \"{name}_mask\" or the like.");
    if (out.channels.channels.empty()) {
        wrong("has no channels",
              "Write preset = \"unity-hdrp-mask\", or channels = [\"metallic | 0\", ...].");
    }
    const bool container = out.format == "dds" || out.format == "ktx2";
    if (out.compression != "none" && !container) {
        wrong("asks for " + out.compression + " in a " + out.format + " file",
              "Use format = \"dds\" or \"ktx2\", or leave compression out.");
    }
    if (out.in_ktx2_alone() && out.format != "ktx2") {
        wrong("asks for " + out.compression + " in a " + out.format + " file", "Use format = \"ktx2\".");
    }
    if (out.compression != "none" && out.bits != 8) {
        wrong("asks for " + out.compression + " with " + std::to_string(out.bits) + " bits",
              "Leave bits out: block compression holds 8.");
    }
    if ((out.rdo || bounded) && !out.has_rdo()) {
        wrong("asks for rdo in " + (out.compression == "none" ? out.format : out.compression),
              "Use compression = \"uastc\", \"bc7\" or another bc, or leave rdo out.");
    }
    if (bounded && out.price_of_a_bit() == 0.0f) {
        wrong("bounds the loss of an rdo that it does not ask for", "Add rdo = 1.");
    }
    if (out.blue_first && (out.format != "dds" || out.compression != "none" || out.bits != 8)) {
        wrong("asks for bgra, which is plain texels of 8 bits in a dds file",
              "Write format = \"dds\" without compression, or leave order out.");
    }
    if (out.format == "exr" && out.bits == 8) out.bits = 16;
    if (out.bits == 32 && out.format != "exr")
        wrong("asks for 32 bits", "Only exr holds them; use 8 or 16.");
    if (out.bits == 16 && out.format == "tga")
        wrong("asks for 16 bits in a tga file", "Use png, tif or 8 bits.");
    return out;
}

std::vector<texproc::OutputRule> read_outputs(const TomlValue& array, const fs::path& folder)
{
    std::vector<texproc::OutputRule> outputs;
    for (const TomlValue& table : array.elements()) outputs.push_back(read_output(table, folder));
    return outputs;
}

void read_inputs(const TomlValue& table, const fs::path& folder, texproc::Recipe& recipe)
{
    for (const auto& [role, value] : table.entries(texproc::map_roles())) {
        texproc::InputMap map = texproc::parse_input_map(value.text());
        map.path = folder / map.path;
        recipe.inputs[role] = map;
    }
}

void read_prefilter(const TomlValue& table, texproc::Recipe& recipe)
{
    for (const auto& [key, value] : table.entries({"rule", "quality", "design_light", "lobes", "score"})) {
        if (key == "rule") {
            recipe.prefilter.rule = value.text();
            if (recipe.prefilter.rule != "none") texproc::rule_named(recipe.prefilter.rule);
        }
        if (key == "quality") recipe.prefilter.quick = value.choice({"full", "quick"}) == 1;
        if (key == "design_light")
            recipe.prefilter.design_light = static_cast<float>(value.number(0.0, 1.0));
        if (key == "lobes") recipe.prefilter.lobes = value.integer(1, 2);
        if (key == "score") recipe.score = value.boolean();
    }
}

void read_mips(const TomlValue& table, texproc::MipOptions& mips)
{
    static constexpr texproc::MipFilter kMeanings[] = {
        texproc::MipFilter::Box, texproc::MipFilter::Kaiser, texproc::MipFilter::Lanczos3,
        texproc::MipFilter::Mitchell};
    for (const auto& [key, value] :
         table.entries({"filter", "wrap_u", "wrap_v", "alpha_cutoff", "alpha_weighted"})) {
        if (key == "filter") mips.filter = kMeanings[value.choice(kFilters)];
        if (key == "wrap_u" || key == "wrap_v") {
            const int edge = value.choice(kEdges);
            (key == "wrap_u" ? mips.wrap_u : mips.wrap_v) = edge == 0;
            (key == "wrap_u" ? mips.mirror_u : mips.mirror_v) = edge == 2;
        }
        if (key == "alpha_weighted") mips.alpha_weighted = value.boolean();
        if (key == "alpha_cutoff") mips.alpha_cutoff = static_cast<float>(value.number(0.0, 1.0));
    }
}

void read_bake(const TomlValue& table, texproc::Recipe& recipe)
{
    static const std::vector<std::string> kRoles{"occlusion", "cavity", "porosity", "puddle",
                                                 "crack",     "height", "normal"};
    for (const auto& [key, value] : table.entries({"roles", "depth", "reach"})) {
        if (key == "depth") recipe.baking.depth = static_cast<float>(value.number(1e-4, 10.0));
        if (key == "reach") recipe.baking.reach = static_cast<float>(value.number(1e-4, 0.5));
        if (key != "roles") continue;
        recipe.bake = value.texts();
        for (const TomlValue& role : value.elements()) role.choice(kRoles);
    }
}

texproc::Recipe recipe_from(const fs::path& file)
{
    const toml::table table = parse_toml(read_toml_text(file, "recipe"), file.string());
    const fs::path folder = file.parent_path();
    texproc::Recipe recipe;
    recipe.file = file;
    const auto entries = TomlValue(table, file.string(), "recipe")
                             .entries({"name", "note", "engines", "folder", "inputs", "normal",
                                       "prefilter", "mips", "bake", "output"});
    for (const auto& [key, value] : entries) {
        if (key == "name") recipe.name = value.text();
        if (key == "engines") recipe.engines = value.texts();
        if (key == "folder") recipe.folder = folder / value.text();
        if (key == "inputs") read_inputs(value, folder, recipe);
        if (key == "normal") {
            for (const auto& [name, v] : value.entries({"green", "layout"})) {
                if (name == "green")
                    recipe.green = static_cast<texproc::Green>(v.choice({"auto", "up", "down"}));
                if (name == "layout") recipe.layout = v.text();
            }
            texproc::normal_layout(recipe.layout);
        }
        if (key == "prefilter") read_prefilter(value, recipe);
        if (key == "mips") read_mips(value, recipe.mips);
        if (key == "bake") read_bake(value, recipe);
        if (key == "output") recipe.outputs = read_outputs(value, folder);
    }
    const std::vector<texproc::OutputRule> more = engine_outputs(recipe.engines);
    recipe.outputs.insert(recipe.outputs.end(), more.begin(), more.end());
    return recipe;
}

}  // namespace

texproc::Recipe read_recipe(const fs::path& file)
{
    texproc::Recipe recipe;
    try {
        recipe = recipe_from(file);
    } catch (const Error& wrong) {
        // The reader's advice is about scenarios.
        const bool scenario = wrong.fix().find("petrichor init") != std::string::npos;
        throw Error(wrong.what(), scenario
                                      ? "Correct this line; `petrichor texture build --help` shows "
                                        "a recipe."
                                      : wrong.fix());
    }
    if (recipe.inputs.empty() == recipe.folder.empty()) {
        throw Error(file.string() + (recipe.inputs.empty() ? ": it names no maps"
                                                           : ": it has both [inputs] and a folder"),
                    "Write either [inputs] with albedo = \"...\" and so on, or folder = \"...\".");
    }
    if (recipe.name.empty() && recipe.folder.empty()) recipe.name = file.stem().string();
    return recipe;
}

std::vector<texproc::OutputRule> engine_outputs(const std::string& name)
{
    const std::vector<std::string> names = preset_names("recipes");
    if (std::find(names.begin(), names.end(), name) == names.end()) {
        throw Error("texture build: there is no engine '" + name + "'." + did_you_mean(name, names),
                    "Use one of: " + join_words(names) + ".");
    }
    const fs::path file = data_folder() / "recipes" / (name + ".toml");
    const toml::table table = parse_toml(read_toml_text(file, "recipe"), file.string());
    for (const auto& [key, value] :
         TomlValue(table, file.string(), "engine").entries({"note", "output"})) {
        if (key == "output") return read_outputs(value, file.parent_path());
    }
    throw Error(file.string() + ": no [[output]]", "Add at least one.");
}

std::vector<texproc::OutputRule> engine_outputs(const std::vector<std::string>& names)
{
    std::vector<texproc::OutputRule> all;
    for (const std::string& name : names) {
        for (texproc::OutputRule output : engine_outputs(name)) {
            if (names.size() > 1) output.folder = name;
            all.push_back(std::move(output));
        }
    }
    return all;
}

std::vector<EngineInfo> engines()
{
    std::vector<EngineInfo> all;
    for (const std::string& name : preset_names("recipes")) {
        const fs::path file = data_folder() / "recipes" / (name + ".toml");
        const toml::table table = parse_toml(read_toml_text(file, "recipe"), file.string());
        EngineInfo info{name, table["note"].value_or(std::string()), engine_outputs(name)};
        all.push_back(std::move(info));
    }
    return all;
}

}  // namespace petrichor::cli
