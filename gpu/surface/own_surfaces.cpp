#include "gpu/surface/own_surfaces.h"

#include <algorithm>

#include "base/error.h"
#include "gpu/compiler/compiler.h"

namespace petrichor::gpu {

OwnSurfaces::OwnSurfaces(const std::vector<std::string>& names)
{
    for (const std::string& name : names) {
        if (name.empty() || number_of(name) != 0) continue;
        if (!name.ends_with(".glsl")) {
            throw Error("surface \"" + name + "\": it is no GLSL file",
                        "Name a file that ends in .glsl.");
        }
        std::vector<std::string> taken;
        for (const OwnText& other : own_) taken.push_back(other.name);
        own_.push_back(read_own_text(name, "surface", {"_input", "_surface"}, taken,
                                     "data/shaders/moss.glsl"));
    }
}

std::uint32_t OwnSurfaces::number_of(const std::string& name) const
{
    for (std::size_t i = 0; i < own_.size(); ++i) {
        if (own_[i].path == name) return static_cast<std::uint32_t>(i + 1);
    }
    return 0;
}

bool OwnSurfaces::moves(std::uint32_t number) const
{
    if (number == 0) return false;
    const OwnText& own = own_[number - 1];
    return own.text.find(own.name + "_move") != std::string::npos;
}

std::vector<std::uint32_t> OwnSurfaces::compile_move() const
{
    for (std::size_t i = 0; i < own_.size(); ++i) {
        if (moves(static_cast<std::uint32_t>(i + 1))) return compile("gpu/passes/own_moves/own_move.comp.glsl");
    }
    return {};
}

std::vector<std::uint32_t> OwnSurfaces::compile_resolve() const
{
    return compile("gpu/passes/surface_resolve/surface_resolve.comp.glsl");
}

std::vector<std::uint32_t> OwnSurfaces::compile_transparent(bool baked) const
{
    return compile(baked ? "gpu/passes/transparent/transparent_baked.frag.glsl"
                         : "gpu/passes/transparent/transparent.frag.glsl");
}

std::vector<std::uint32_t> OwnSurfaces::compile(const std::string& main) const
{
    if (own_.empty()) return {};
    std::string rows = "#define OWN_SURFACES(ROW)";
    std::string movers = "#define OWN_MOVES(ROW)";
    ShaderText list{"gpu/passes/surface/own_surfaces.glsl", "", ""};
    std::vector<ShaderText> texts;
    for (std::size_t i = 0; i < own_.size(); ++i) {
        const std::string number = std::to_string(i + 1);
        const std::string include = "own/surface_" + number + ".glsl";
        const std::string row = " ROW(" + number + ", " + own_[i].name + ")";
        rows += row;
        if (moves(static_cast<std::uint32_t>(i + 1))) movers += row;
        list.text += "#include \"" + include + "\"\n";
        texts.push_back({include, own_[i].text, own_[i].path});
    }
    texts.insert(texts.begin(), list);
    return compile_shader(main, rows + "\n" + movers + "\n", texts, user_cache());
}

}  // namespace petrichor::gpu
