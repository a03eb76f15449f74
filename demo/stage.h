#ifndef PETRICHOR_DEMO_STAGE_H
#define PETRICHOR_DEMO_STAGE_H

#include "scene/scene.h"

namespace petrichor::demo {

/// A stage to show materials and lamps on, metres, +y up, seen along -z: a floor and a back wall, plinths with a
/// bust, an urn and a ring, balls in front of them, and four lamps with a size that hang over them.
///
/// Materials "floor", "wall", "plinth", "bust", "urn", "ring", "ball 1" to "ball 5" (smooth to rough, the last two
/// metal), without textures. Floor and wall have second texture coordinates of their own, for light maps.
/// Lamps "tube", "panel", "bulb" and "disc", each with a body of its name that glows; camera "main". Same bytes
/// always.
scene::Scene make_demo_stage();

}  // namespace petrichor::demo

#endif
