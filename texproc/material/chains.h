#ifndef PETRICHOR_TEXPROC_MATERIAL_CHAINS_H
#define PETRICHOR_TEXPROC_MATERIAL_CHAINS_H

#include <string>
#include <vector>

#include "texproc/filter/mips.h"
#include "texproc/prefilter/prefilter.h"

namespace petrichor::texproc {

// From the maps of a material to all their levels: the part that `texture build` and `render`
// share, with its defaults.

/// How roughness and normals are filtered together.
struct PrefilterChoice {
    std::string rule = "picture";  ///< a name of rules(); "none": plain mips
    bool quick = true;             ///< overlap, picture: less search
    float design_light = 0.0f;     ///< as PrefilterOptions::design_light
    int lobes = 1;                 ///< as PrefilterOptions::lobes
};

/// What the levels are for.
struct ChainUse {
    bool joint = true;        ///< the normals are written with the roughness: they may be re-aimed
    int bits = 8;             ///< of the finest file; 8: codes are chosen for 8 bits
    bool smoothness = false;  ///< the second map holds smoothness
    int threads = 0;          ///< 0: all cores; the bytes do not depend on it
};

/// The options that a choice means for a use.
PrefilterOptions prefilter_options(const PrefilterChoice& choice, const ChainUse& use);

/// Roles that hold colour, which files keep as sRGB.
bool is_color(const std::string& role);

/// Levels of a map that no prefilter touches, by its role: normals keep their length; only an
/// albedo with alpha keeps the coverage of options.alpha_cutoff. Level 0 is the map.
std::vector<Image> plain_levels(const Image& map, const std::string& role, MipOptions options);

}  // namespace petrichor::texproc

#endif
