#include "gpu/lighting/lighting_models.h"

#include <algorithm>
#include <filesystem>

#include "base/error.h"
#include "base/words.h"
#include "gpu/compiler/compiler.h"
#include "gpu/lighting/models_io.h"

namespace petrichor::gpu {

namespace {

constexpr std::size_t kMostModels = 256;  // numbers of 8 bits

}  // namespace

const std::vector<std::string>& built_in_lighting_models()
{
#define ROW(number, name) #name,
    static const std::vector<std::string> names{BUILT_IN_LIGHTING_MODELS(ROW)};
#undef ROW
    return names;
}

LightingModels::LightingModels(const std::vector<std::string>& names)
{
    const auto& built_in = built_in_lighting_models();
    for (const std::string& name : names) {
        const bool known =
            name.empty() || std::find(built_in.begin(), built_in.end(), name) != built_in.end() ||
            std::any_of(own_.begin(), own_.end(), [&](const Own& own) { return own.text.path == name; });
        if (known) continue;
        const std::filesystem::path path(name);
        if (path.extension() != ".glsl") {
            throw Error("lighting model \"" + name + "\": there is no such model; there are " +
                            join_words(built_in),
                        "Choose one of these, or name a file of your own that ends in .glsl.");
        }
        std::vector<std::string> taken = built_in;
        for (const Own& other : own_) taken.push_back(other.text.name);
        own_.push_back(read_own(name, taken));
    }
    if (count() > kMostModels) {
        throw Error("lighting models: " + std::to_string(count()) + " in one scene; at most " +
                        std::to_string(kMostModels) + " are possible",
                    "Use fewer files.");
    }
}

LightingModels::Own LightingModels::read_own(const std::string& path, const std::vector<std::string>& taken)
{
    const auto read = [&](const std::vector<std::string>& parts) {
        return read_own_text(path, "lighting model", parts, taken, "data/shaders/minnaert.glsl");
    };
    Own own{read({})};
    const auto defines = [&](const char* part) {
        return own.text.text.find(own.text.name + part) != std::string::npos;
    };
    own.gathers = defines("_gather") && defines("_compose");
    own.answers = defines("_light");
    if (own.gathers) {
        read({"_gather", "_compose", "_surround", "_own"});
    } else if (own.answers || !(defines("_gather") || defines("_compose"))) {
        read({"_light", "_surround", "_own"});
    } else {
        const std::string& name = own.text.name;
        throw Error("lighting model " + path + ": it defines one of " + name + "_gather and " + name +
                        "_compose, and no " + name + "_light",
                    "Define both, as data/shaders/toon.glsl does, or NAME_light, as data/shaders/minnaert.glsl does.");
    }
    return own;
}

std::uint32_t LightingModels::number_of(const std::string& name) const
{
    const auto& built_in = built_in_lighting_models();
    for (std::size_t i = 0; i < built_in.size(); ++i) {
        if (built_in[i] == name) return static_cast<std::uint32_t>(i);
    }
    for (std::size_t i = 0; i < own_.size(); ++i) {
        if (own_[i].text.path == name) return static_cast<std::uint32_t>(built_in.size() + i);
    }
    return 0;
}

std::uint32_t LightingModels::count() const
{
    return static_cast<std::uint32_t>(built_in_lighting_models().size() + own_.size());
}

bool LightingModels::gathers(std::uint32_t number) const
{
    const std::size_t built_in = built_in_lighting_models().size();
    return number >= built_in && number < count() && own_[number - built_in].gathers;
}

std::vector<std::uint32_t> LightingModels::compile_lighting() const
{
    if (own_.empty()) return {};
    std::string rows = "#define OWN_LIGHTING_MODELS(ROW)";
    std::string gathering = "\n#define GATHERING_LIGHTING_MODELS(ROW)";
    ShaderText list{"gpu/lighting/own_models.glsl", "", ""};
    std::vector<ShaderText> texts;
    for (const Own& own : own_) {
        const std::string& name = own.text.name;
        const std::uint32_t number = number_of(own.text.path);
        const std::string include = "own/" + std::to_string(number) + ".glsl";
        const std::string row = " ROW(" + std::to_string(number) + ", " + name + ")";
        rows += row;
        if (own.gathers) gathering += row;
        list.text += "#include \"" + include + "\"\n";
        if (!own.answers) {  // light by light, where that is asked for
            list.text += "vec3 " + name + "_light(LitPoint p, vec3 to_light)\n{\n    return " + name +
                         "_compose(p, " + name + "_gather(p, to_light));\n}\n";
        }
        texts.push_back({include, own.text.text, own.text.path});
    }
    texts.insert(texts.begin(), list);
    return compile_shader("gpu/passes/lighting/lighting.comp.glsl", rows + gathering + "\n", texts,
                          user_cache());
}

}  // namespace petrichor::gpu
