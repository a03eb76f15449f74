#ifndef PETRICHOR_TEXPROC_MATERIAL_ONE_SIZE_H
#define PETRICHOR_TEXPROC_MATERIAL_ONE_SIZE_H

#include <map>
#include <string>
#include <vector>

#include "texproc/image/raw_image.h"
#include "texproc/material/plan.h"

namespace petrichor::texproc {

/// Maps that meet in a file, in the prefilter or in something baked are brought to the size of the
/// largest of them (by texels): means over exact areas, bilinear where a side grows; colour in
/// linear light, normals to unit length again, integers in their own type. Others stay. Returns a
/// note for each map that was resampled: "occlusion: 32 x 64 resampled to 64 x 64".
std::vector<std::string> bring_to_one_size(const PlannedMaterial& plan,
                                           std::map<std::string, RawImage>& maps, int threads);

}  // namespace petrichor::texproc

#endif
