// How fine a texture may be read where a pixel is the mean of many jittered samples.
//
// A pixel's footprint in a texture is a parallelogram of the area |dx x dy|. One trilinear read
// covers a square of its longer side; N samples of the pixel need only cover the whole together.
// Each then reads a square of an N-th of the area, though never less than an N-th of the long side,
// which is as far as they lie apart along it. A sampler that takes several looks along the longer side reads
// a square that is drawn out so far, and needs no finer level for what is foreshortened.
#ifndef PETRICHOR_FORMULAS_GEOMETRY_FOOTPRINT_H
#define PETRICHOR_FORMULAS_GEOMETRY_FOOTPRINT_H

#include "base/interop.h"

SHARED_BEGIN

// Factor of both derivatives, 0..1; 1 for one sample.
//   stretch  length over width of what one read covers at most: the sampler's anisotropy, 1 without
SHARED_FN float footprint_scale(vec2 dx, vec2 dy, float samples, float stretch)
{
    const float a = dot(dx, dx);
    const float b = dot(dy, dy);
    const float longer = sqrt(max(a, b));
    if (longer <= 0.0f) return 1.0f;
    const float area = abs(dx.x * dy.y - dx.y * dy.x);
    // The long axis of the ellipse that the two span.
    const float c = dot(dx, dy);
    const float major = sqrt(0.5f * (a + b) + sqrt(0.25f * (a - b) * (a - b) + c * c));
    const float drawn_out = clamp(major * major / max(area, 1.0e-30f), 1.0f, stretch);
    const float side = max(sqrt(area * drawn_out / samples), major / samples);
    return min(side / longer, 1.0f);
}

SHARED_END

#endif
