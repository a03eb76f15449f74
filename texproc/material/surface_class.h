#ifndef PETRICHOR_TEXPROC_MATERIAL_SURFACE_CLASS_H
#define PETRICHOR_TEXPROC_MATERIAL_SURFACE_CLASS_H

#include "base/image.h"
#include "texproc/prefilter/prefilter.h"

namespace petrichor::texproc {

/// What a metallic map says the surface is: paint where less than 2 % of it is metal, metal where less than
/// 2 % is not, else both.
///   metallic  1 channel, 0..1, times its factor
SurfaceClass surface_class(const Image& metallic);

}  // namespace petrichor::texproc

#endif
