#ifndef PETRICHOR_GPU_UPLOAD_MATERIAL_CONSTANTS_H
#define PETRICHOR_GPU_UPLOAD_MATERIAL_CONSTANTS_H

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "gpu/upload/material_io.h"
#include "gpu/upload/scene_names.h"

namespace petrichor::gpu {

/// A member of MaterialConstants and the row of scene/material_table.h that fills it.
struct MaterialField {
    std::string_view name;
    std::size_t offset = 0;  ///< bytes
    std::size_t size = 0;    ///< bytes; 4 a number
    bool whole = false;      ///< uint: a flag or a choice
};
const std::vector<MaterialField>& material_fields();

/// The texture of each slot.
std::vector<const TextureUse*> slots_of(const Material& material);

/// The textures of its layers that have pixels, in their slots behind the others.
struct LayerSlots {
    std::vector<const TextureUse*> uses;
    std::array<std::uint32_t, LAYER_ROLE_WORDS> roles{};  ///< LAYER_TEXTURES by four bits each
    bool of_light = false;                 ///< some are shares that lighting reads
};
LayerSlots layer_slots_of(const Material& material, const std::vector<bool>& loaded);

/// Constants from the rows of the material table. loaded[t]: texture t has pixels.
/// Throws Error when a field has no row: a mistake in this program.
shared::MaterialConstants material_constants(const Material& material,
                                             const std::vector<bool>& loaded);

/// Light passes through parts of it: drawn by chance, not sorted.
bool is_blended(const Material& material);

}  // namespace petrichor::gpu

#endif
