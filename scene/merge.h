#ifndef PETRICHOR_SCENE_MERGE_H
#define PETRICHOR_SCENE_MERGE_H

#include "scene/scene.h"

namespace petrichor::scene {

/// Joins the primitives of each mesh that have one material and the same attributes, so that they
/// are one draw: triangles keep their order within a material, which comes where its first one was.
/// The picture and its ids stay the same. What blends stays apart: it is drawn from back to front.
void merge_primitives(Scene& scene);

}  // namespace petrichor::scene

#endif
