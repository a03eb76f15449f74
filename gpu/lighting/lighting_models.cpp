#include "gpu/lighting/lighting_models.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "base/error.h"
#include "base/input_file.h"
#include "base/words.h"
#include "gpu/compiler/compiler.h"
#include "gpu/lighting/models_io.h"

namespace petrichor::gpu {

namespace {

constexpr std::size_t kLargestFile = 256u << 10;
constexpr std::size_t kMostModels = 256;  // numbers of 8 bits

bool is_identifier(const std::string& word)
{
    const auto letter = [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
    };
    return !word.empty() && std::isdigit(static_cast<unsigned char>(word[0])) == 0 &&
           std::all_of(word.begin(), word.end(), letter) && word.find("__") == std::string::npos;
}

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
            std::any_of(own_.begin(), own_.end(), [&](const Own& own) { return own.path == name; });
        if (known) continue;
        const std::filesystem::path path(name);
        if (path.extension() != ".glsl") {
            throw Error("lighting model \"" + name + "\": there is no such model; there are " +
                            join_words(built_in),
                        "Choose one of these, or name a file of your own that ends in .glsl.");
        }
        Own own{name, path.stem().string(), ""};
        const auto taken = [&](const Own& other) { return other.name == own.name; };
        if (!is_identifier(own.name) || own.name.rfind("gl_", 0) == 0 ||
            std::find(built_in.begin(), built_in.end(), own.name) != built_in.end() ||
            std::any_of(own_.begin(), own_.end(), taken)) {
            throw Error("lighting model " + name + ": \"" + own.name +
                            "\" cannot name its functions: letters, digits and _ can, once a "
                            "scene, and not the name of a built-in model",
                        "Rename the file.");
        }
        own.text = read_file(path, "lighting model", kLargestFile);
        for (const char* part : {"_light", "_surround", "_own"}) {
            if (own.text.find(own.name + part) == std::string::npos) {
                throw Error("lighting model " + name + ": it does not define " + own.name + part,
                            "Define NAME_light, NAME_surround and NAME_own, as "
                            "data/shaders/minnaert.glsl does.");
            }
        }
        own_.push_back(std::move(own));
    }
    if (count() > kMostModels) {
        throw Error("lighting models: " + std::to_string(count()) + " in one scene; at most " +
                        std::to_string(kMostModels) + " are possible",
                    "Use fewer files.");
    }
}

std::uint32_t LightingModels::number_of(const std::string& name) const
{
    const auto& built_in = built_in_lighting_models();
    for (std::size_t i = 0; i < built_in.size(); ++i) {
        if (built_in[i] == name) return static_cast<std::uint32_t>(i);
    }
    for (std::size_t i = 0; i < own_.size(); ++i) {
        if (own_[i].path == name) return static_cast<std::uint32_t>(built_in.size() + i);
    }
    return 0;
}

std::uint32_t LightingModels::count() const
{
    return static_cast<std::uint32_t>(built_in_lighting_models().size() + own_.size());
}

std::vector<std::uint32_t> LightingModels::compile_lighting() const
{
    if (own_.empty()) return {};
    std::string rows = "#define OWN_LIGHTING_MODELS(ROW)";
    ShaderText list{"gpu/lighting/own_models.glsl", "", ""};
    std::vector<ShaderText> texts;
    for (const Own& own : own_) {
        const std::uint32_t number = number_of(own.path);
        const std::string include = "own/" + std::to_string(number) + ".glsl";
        rows += " ROW(" + std::to_string(number) + ", " + own.name + ")";
        list.text += "#include \"" + include + "\"\n";
        texts.push_back({include, own.text, own.path});
    }
    texts.insert(texts.begin(), list);
    return compile_shader("gpu/passes/lighting/lighting.comp.glsl", rows + "\n", texts,
                          user_cache());
}

}  // namespace petrichor::gpu
