// The lighting models that are built in: a row and an include each. The number stands in the
// G-buffer (8 bits); users' own models are numbered behind them.
//
//   ROW(number, name)   number from 0; the file of that name in gpu/lighting/models
#ifndef PETRICHOR_GPU_LIGHTING_MODELS_IO_H
#define PETRICHOR_GPU_LIGHTING_MODELS_IO_H

#define BUILT_IN_LIGHTING_MODELS(ROW) ROW(0, standard) ROW(1, unlit) ROW(2, lambert) ROW(3, layered)
#define LIGHTING_MODEL_STANDARD 0
#define LIGHTING_MODEL_LAYERED 3

#ifndef __cplusplus
#include "gpu/lighting/models/lambert.glsl"
#include "gpu/lighting/models/layered.glsl"
#include "gpu/lighting/models/standard.glsl"
#include "gpu/lighting/models/unlit.glsl"
// The run-time compiler puts the rows and files of a user's own models here.
#ifdef OWN_LIGHTING_MODELS
#include "gpu/lighting/own_models.glsl"
#define LIGHTING_MODELS(ROW) BUILT_IN_LIGHTING_MODELS(ROW) OWN_LIGHTING_MODELS(ROW)
#else
#define LIGHTING_MODELS(ROW) BUILT_IN_LIGHTING_MODELS(ROW)
#endif
#endif

#endif
