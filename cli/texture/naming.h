#ifndef PETRICHOR_CLI_TEXTURE_NAMING_H
#define PETRICHOR_CLI_TEXTURE_NAMING_H

#include <filesystem>
#include <string>

namespace petrichor::cli {

/// The normal map that belongs to a smoothness, roughness or packed map, by the names that tools
/// give: X_LuxSPEC and X_LuxNRM, X_Roughness and X_Normal / X_NormalGL, X_rough and X_nor_gl, ...
/// Looks beside the map, with its extension and with others. Throws Error that lists what was tried.
struct NormalPartner {
    std::filesystem::path path;
    bool green_down = false;  ///< the name says DirectX
    bool smoothness = false;  ///< the name of the map says smoothness (or LuxSPEC)
    int channel = 0;          ///< of the map: LuxSPEC keeps smoothness in alpha
};
NormalPartner find_normal(const std::filesystem::path& map);

}  // namespace petrichor::cli

#endif
