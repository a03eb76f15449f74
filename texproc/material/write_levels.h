#ifndef PETRICHOR_TEXPROC_MATERIAL_WRITE_LEVELS_H
#define PETRICHOR_TEXPROC_MATERIAL_WRITE_LEVELS_H

#include <filesystem>
#include <string>
#include <vector>

#include "texproc/image/raw_image.h"
#include "texproc/material/recipe.h"

namespace petrichor::texproc {

/// Writes the levels of one output in the format of its rule: one file, or one a level;
/// texel_weights as in TextureWriteOptions, may be empty. Returns the names relative to `folder`.
/// Throws Error (disk full, read-only folder, ...).
std::vector<std::string> write_levels(const std::filesystem::path& folder, const std::string& stem,
                                      const OutputRule& rule, std::vector<RawImage> levels,
                                      std::vector<Image> texel_weights, int threads);

}  // namespace petrichor::texproc

#endif
