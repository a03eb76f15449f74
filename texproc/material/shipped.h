#ifndef PETRICHOR_TEXPROC_MATERIAL_SHIPPED_H
#define PETRICHOR_TEXPROC_MATERIAL_SHIPPED_H

#include <filesystem>
#include <functional>
#include <vector>

#include "base/image.h"
#include "texproc/material/material.h"

namespace petrichor::texproc {

/// The levels of a role read back from the files of an output, as an engine gets them (block
/// formats: as a shader does), by their number in the full chain: levels of 1.. that the files do
/// not hold stay empty. Image channels are those of the role, `channels` of them; a third one that
/// is missing is rebuilt as z of a normal. Nothing when the output does not hold the role, or is of
/// a kind that is not read back (exr).
///
///   has   whether there is a map of a role: it decides which alternative a channel was made from
std::vector<Image> shipped_levels(const std::filesystem::path& folder, const PlannedOutput& output,
                                  const MadeOutput& made, const std::string& role, int channels,
                                  int width, const std::function<bool(const std::string&)>& has);

}  // namespace petrichor::texproc

#endif
