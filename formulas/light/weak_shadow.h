// Shadows that do not take all of the light.
#ifndef PETRICHOR_FORMULAS_LIGHT_WEAK_SHADOW_H
#define PETRICHOR_FORMULAS_LIGHT_WEAK_SHADOW_H

#include "base/interop.h"

SHARED_BEGIN

// What is left of a light of which so much is seen. Of strength 1 the same to the bit.
//   visible   0 in the full shadow .. 1
//   strength  share of the light that the full shadow takes away, 0..1
SHARED_FN float weak_shadow(float visible, float strength)
{
    return visible * strength + (1.0f - strength);
}

SHARED_END

#endif
