// Exposure: from luminance to EV100, from EV100 to the scale of the picture, and how dark a night
// may stay.
//
// EV100 is the exposure value at ISO 100. A reflected-light meter with the constant K = 12.5 reads
// L = 2^EV100 * 12.5 / 100 cd/m2 (ISO 2720:1974); a sensor saturates at 78 / (100 * 0.65) * 2^EV100
// cd/m2 (ISO 12232:2006, as Lagarde and de Rousiers 2014 use it), which the scale maps to 1.
#ifndef PETRICHOR_FORMULAS_LIGHT_EXPOSURE_H
#define PETRICHOR_FORMULAS_LIGHT_EXPOSURE_H

#include "base/interop.h"

SHARED_BEGIN

// The linear scale of radiance, per cd/m2.
SHARED_FN float exposure_of_ev100(float ev100)
{
    return 1.0f / (1.2f * exp2(ev100));
}

// What a reflected-light meter shows for a luminance > 0, cd/m2.
SHARED_FN float ev100_of_luminance(float luminance)
{
    return log2(luminance * 8.0f);
}

// The EV100 to set for a metered one. A mean of bright day is placed at an eighth of white, half
// a stop below middle grey: log2(1.2 * 8 / 8) = 0.263 stops over the meter. Below EV100 10 (128
// cd/m2: indoors, dusk) each stop of darkness leaves the picture a quarter of a stop darker, at
// most 3 stops at EV100 -2: a night stays a night. Both were chosen by eye on the demo's street.
// Monotone: a darker scene is never set to a higher EV.
SHARED_FN float metered_setting(float ev100)
{
    return ev100 - 0.263f + 0.25f * clamp(10.0f - ev100, 0.0f, 12.0f);
}

// Stops, 0..1, by which a flat picture is exposed more: the even grey of an overcast day is no middle
// grey, and its brightest, `above` stops over its mean, belong near white. From two stops on there
// is nothing to add. Chosen by eye.
SHARED_FN float flat_stops(float above)
{
    return clamp(0.6f * (2.0f - above), 0.0f, 1.0f);
}

SHARED_END

#endif
