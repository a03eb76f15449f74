#ifndef PETRICHOR_FILM_COLOR_SHOWN_PICTURE_H
#define PETRICHOR_FILM_COLOR_SHOWN_PICTURE_H

#include "film/color/display_transform.h"
#include "gpu/renderer.h"

namespace petrichor::film {

/// Turns light that the renderer handed over into codes of the display: `exposed` into `display`. Nothing without a
/// transform.
void show(gpu::RenderResult& result, const DisplayTransform* transform, bool dither);

}  // namespace petrichor::film

#endif
