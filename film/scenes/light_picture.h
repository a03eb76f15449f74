#ifndef PETRICHOR_FILM_SCENES_LIGHT_PICTURE_H
#define PETRICHOR_FILM_SCENES_LIGHT_PICTURE_H

#include <filesystem>

#include "film/scenario/scenario.h"
#include "gpu/frame/frame.h"

namespace petrichor::film {

/// Reads a lat-long picture of light. Throws Error when it is missing, damaged, not twice as wide as
/// high, or not of the kind that `code` reads.
///
///   source   Karis 2009 (RGBM); dLDR and RGBM with their ranges in a gamma of 2.2, as reflection probes
///            of engines with linear light hold them: 2^2.2 and 5^2.2
gpu::EnvironmentMap read_light_picture(const std::filesystem::path& file,
                                       LightCode code = LightCode::Auto);

}  // namespace petrichor::film

#endif
