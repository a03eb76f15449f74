#ifndef PETRICHOR_TEXPROC_MATERIAL_MATERIAL_H
#define PETRICHOR_TEXPROC_MATERIAL_MATERIAL_H

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "texproc/material/plan.h"
#include "texproc/material/source_maps.h"
#include "texproc/prefilter/picture.h"
#include "texproc/study/score.h"

namespace petrichor::texproc {

struct MadeOutput {
    std::vector<std::string> files;  ///< relative to the folder; one, or one a level
    int width = 0, height = 0, levels = 0;
    std::vector<std::string> settings{};  ///< files for the importer of an engine, beside those
};
/// How far lit floors (reference_pictures()) with the files that were made are from the truth, mean
/// over the cases, and with plain mips.
struct PictureError {
    PictureScore shipped, plain;
};
struct MadeMaterial {
    std::vector<MadeSource> sources;  ///< the maps that were read
    std::vector<MadeOutput> outputs;  ///< in the order of the plan
    std::string green;  ///< what was done to the normal map: "up", "down, turned, ..."
    std::optional<Score> lobe_error;
    std::optional<PictureError> picture_error;
    std::vector<std::string> notes{};  ///< what was done to the maps and is worth saying
};

/// Makes all outputs of a material below `folder` (which it creates). Same bytes at any thread
/// count. Throws Error that names the file at fault.
MadeMaterial make_material(const PlannedMaterial& material, const std::filesystem::path& folder,
                           int threads);

}  // namespace petrichor::texproc

#endif
