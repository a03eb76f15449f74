#include "film/weather/surface_by_name.h"

#include <algorithm>
#include <cctype>
#include <string>

namespace petrichor::film {
namespace {

struct NameWord {
    const char* word;
    const char* surface;
};
// The first word that a name holds decides: "roof tile" comes before "tile" and "metal".
constexpr NameWord kWords[] = {
    {"asphalt", "asphalt"},
    {"tarmac", "asphalt"},
    {"road", "asphalt"},
    {"street", "asphalt"},
    {"cobble", "cobblestone"},
    {"paving", "paving_stones"},
    {"pavement", "paving_stones"},
    {"sidewalk", "paving_stones"},
    {"kerb", "concrete"},
    {"curb", "concrete"},
    {"concrete", "concrete"},
    {"plaster", "concrete"},
    {"stucco", "concrete"},
    {"brick", "brick"},
    {"gravel", "gravel"},
    {"sand", "sand"},
    {"soil", "soil"},
    {"dirt", "soil"},
    {"mud", "soil"},
    {"earth", "soil"},
    {"grass", "lawn"},
    {"lawn", "lawn"},
    {"meadow", "lawn"},
    {"moss", "lawn"},
    {"metal", "roof_metal"},
    {"steel", "roof_metal"},
    {"zinc", "roof_metal"},
    {"iron", "roof_metal"},
    {"roof", "roof_tile"},
    {"tile", "roof_tile"},
    {"shingle", "roof_tile"},
    {"wood", "wood"},
    {"plank", "wood"},
    {"bark", "wood"},
    {"rock", "rock"},
    {"stone", "rock"},
    {"marble", "rock"},
};

// Thin, with little heat in it and air around: as a lawn's blades, but no soil behind.
constexpr const char* kFoliage[] = {"needle", "leaves", "leaf", "foliage", "hedge",
                                    "plant",  "bush",   "ivy",  "fern"};

std::string lower(const std::string& text)
{
    std::string out;
    for (const char c : text) out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return out;
}

}  // namespace

bool is_leaves(const scene::Material& material)
{
    return material.alpha_mode == scene::AlphaMode::Mask;
}

bool is_foliage(const scene::Material& material)
{
    const std::string name = lower(material.name);
    return is_leaves(material) ||
           std::any_of(std::begin(kFoliage), std::end(kFoliage), [&](const char* word) {
               return name.find(word) != std::string::npos;
           });
}

weather::Surface surface_of_material(const scene::Material& material,
                                     const weather::Surface& otherwise)
{
    const std::string name = lower(material.name);
    if (is_foliage(material) && !is_leaves(material)) return weather::surface_preset("lawn");
    for (const NameWord& word : kWords)
        if (name.find(word.word) != std::string::npos) return weather::surface_preset(word.surface);
    if (material.metallic > 0.5f && !material.metallic_roughness_texture.present())
        return weather::surface_preset("roof_metal");
    return otherwise;
}

double slides_above_deg(const scene::Material& material, const weather::Surface& surface)
{
    const std::string name = lower(material.name);
    const bool glass = material.transmission > 0.5f || name.find("glass") != std::string::npos;
    if (glass || surface.name == "roof_metal") return 15.0;
    return surface.name == "roof_tile" ? 30.0 : 90.0;
}

}  // namespace petrichor::film
