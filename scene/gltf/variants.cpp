#include <algorithm>
#include <string>
#include <vector>

#include "base/words.h"
#include "scene/gltf/detail/gltf_variants.h"

namespace petrichor::scene {
namespace {

constexpr const char* kVariants = "KHR_materials_variants";

}  // namespace

std::optional<std::uint32_t> variant_number(const JsonObject& root, const std::string& variant)
{
    const auto extension = root.extension(kVariants);
    const JsonArray list =
        extension ? extension->array("variants") : JsonArray(nullptr, "", root.log());
    std::vector<std::string> names;
    for (std::uint32_t i = 0; i < list.size(); ++i) names.push_back(list.object(i).text("name"));
    const auto found = std::find(names.begin(), names.end(), variant);
    if (!variant.empty() && found == names.end()) {
        root.log().fail(
            "extensions.KHR_materials_variants",
            "there is no variant " + in_quotes(variant) + "." + did_you_mean(variant, names),
            names.empty() ? "Leave [scene] variant out: the scene has none."
                          : "Use one of: " + printable(join_words(names)) + ".");
    }
    if (variant.empty() && !names.empty()) {
        root.log().warnings.add("", "variants of materials: " + printable(join_words(names)) +
                                        "; [scene] variant chooses one");
    }
    if (variant.empty()) return std::nullopt;
    return static_cast<std::uint32_t>(found - names.begin());
}

std::optional<std::uint32_t> variant_material(const JsonObject& primitive, std::uint32_t variant,
                                              std::size_t material_count)
{
    const auto extension = primitive.extension(kVariants);
    if (!extension) return std::nullopt;
    const JsonArray mappings = extension->array("mappings");
    for (std::size_t i = 0; i < mappings.size(); ++i) {
        const JsonObject mapping = mappings.object(i);
        const JsonArray variants = mapping.array("variants");
        for (std::size_t v = 0; v < variants.size(); ++v) {
            if (variants.index(v, "variant", std::size_t{1} << 31) == variant)
                return mapping.require_index("material", "material", material_count);
        }
    }
    return std::nullopt;
}

}  // namespace petrichor::scene
