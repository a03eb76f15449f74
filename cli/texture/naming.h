#ifndef PETRICHOR_CLI_TEXTURE_NAMING_H
#define PETRICHOR_CLI_TEXTURE_NAMING_H

#include <filesystem>
#include <optional>
#include <string>

namespace petrichor::cli {

/// The normal map that belongs to a smoothness, roughness or packed map, by the names that tools
/// give: X_LuxSPEC and X_LuxNRM, X_Roughness and X_Normal / X_NormalGL, X_rough and X_nor_gl, ...
/// Looks beside the map, with its extension and with others. Throws Error that lists what was
/// tried.
struct NormalPartner {
    std::filesystem::path path;
    bool green_down = false;  ///< the name says DirectX
    bool smoothness = false;  ///< the name of the map says smoothness (or LuxSPEC)
    int channel = 0;          ///< of the map: LuxSPEC keeps smoothness in alpha
};
NormalPartner find_normal(const std::filesystem::path& map);

/// The channel that the name of a map says: alpha of X_LuxSPEC, green of X_arm, else 0.
int named_channel(const std::filesystem::path& map);

/// The height map beside a map, by the same names, or nothing: "X_Displacement.jpg",
/// "X_height.png", "X_alb_ht.png:a", ...
std::optional<std::string> find_height(const std::filesystem::path& map);

/// The map of a folder whose normal map find_normal() finds: what one means who names the folder of
/// a material. Throws Error when there is none or several of equal right.
std::filesystem::path find_material(const std::filesystem::path& folder);

}  // namespace petrichor::cli

#endif
