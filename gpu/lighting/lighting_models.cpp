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
            std::any_of(own_.begin(), own_.end(), [&](const OwnText& own) { return own.path == name; });
        if (known) continue;
        const std::filesystem::path path(name);
        if (path.extension() != ".glsl") {
            throw Error("lighting model \"" + name + "\": there is no such model; there are " +
                            join_words(built_in),
                        "Choose one of these, or name a file of your own that ends in .glsl.");
        }
        std::vector<std::string> taken = built_in;
        for (const OwnText& other : own_) taken.push_back(other.name);
        own_.push_back(read_own_text(name, "lighting model", {"_light", "_surround", "_own"}, taken,
                                     "data/shaders/minnaert.glsl"));
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
    for (const OwnText& own : own_) {
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
