// The lighting models that are built in: a row and an include each. The number stands in the
// G-buffer (8 bits); users' own models are numbered behind them.
//
//   ROW(number, name)   number from 0; the file of that name in gpu/lighting/models
#ifndef PETRICHOR_GPU_LIGHTING_MODELS_IO_H
#define PETRICHOR_GPU_LIGHTING_MODELS_IO_H

#define BUILT_IN_LIGHTING_MODELS(ROW)                                                         \
    ROW(0, standard) ROW(1, unlit) ROW(2, lambert) ROW(3, layered) ROW(4, lwrp) ROW(5, burley) \
    ROW(6, lux) ROW(7, skin) ROW(8, hair) ROW(9, unlit_shadowed)
#define LIGHTING_MODEL_STANDARD 0
#define LIGHTING_MODEL_LAYERED 3
#define LIGHTING_MODEL_BURLEY 5
#define LIGHTING_MODEL_SKIN 7
#define LIGHTING_MODEL_HAIR 8
#define LIGHTING_MODEL_UNLIT_SHADOWED 9

#ifndef __cplusplus
#include "gpu/lighting/models/burley.glsl"
#include "gpu/lighting/models/hair.glsl"
#include "gpu/lighting/models/lambert.glsl"
#include "gpu/lighting/models/layered.glsl"
#include "gpu/lighting/models/lux.glsl"
#include "gpu/lighting/models/lwrp.glsl"
#include "gpu/lighting/models/skin.glsl"
#include "gpu/lighting/models/standard.glsl"
#include "gpu/lighting/models/unlit.glsl"
#include "gpu/lighting/models/unlit_shadowed.glsl"
// The run-time compiler puts the rows and files of a user's own models here, and the rows of those of them
// that gather light first.
#ifdef OWN_LIGHTING_MODELS
#include "gpu/lighting/own_models.glsl"
#define LIGHTING_MODELS(ROW) BUILT_IN_LIGHTING_MODELS(ROW) OWN_LIGHTING_MODELS(ROW)
#else
#define LIGHTING_MODELS(ROW) BUILT_IN_LIGHTING_MODELS(ROW)
#define GATHERING_LIGHTING_MODELS(ROW)
#endif
#endif

#endif
