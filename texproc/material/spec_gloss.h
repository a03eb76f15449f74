#ifndef PETRICHOR_TEXPROC_MATERIAL_SPEC_GLOSS_H
#define PETRICHOR_TEXPROC_MATERIAL_SPEC_GLOSS_H

#include "base/image.h"

namespace petrichor::texproc {

// One surface told in two ways: diffuse and specular colour, or base colour and metallic. Both
// colours linear, three channels; metallic one. Source: the reference conversion of Khronos'
// KHR_materials_pbrSpecularGlossiness (glTF 2.0, 2017, appendix), with the 4 % of dielectrics.

struct MetallicColor {
    Image base;      ///< linear, three channels
    Image metallic;  ///< one channel
};
struct SpecularColor {
    Image diffuse, specular;  ///< linear, three channels
};

/// Metallic is the share that solves the mix of dielectric and metal for the brightness of both
/// colours; the base colour is taken from the diffuse one below it and from the specular above.
/// Throws Error when the sizes differ or a colour has other than three channels.
MetallicColor to_metallic(const Image& diffuse, const Image& specular);

/// What to_metallic() undoes: exactly where the surface is either metal or none, or grey. Throws
/// Error as above; metallic has one channel.
SpecularColor to_specular(const Image& base, const Image& metallic);

}  // namespace petrichor::texproc

#endif
