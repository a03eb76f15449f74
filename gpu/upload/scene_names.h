#ifndef PETRICHOR_GPU_UPLOAD_SCENE_NAMES_H
#define PETRICHOR_GPU_UPLOAD_SCENE_NAMES_H

#include "scene/scene.h"

// This room draws scenes: what a scene is made of goes by its plain name here.
namespace petrichor::gpu {
using namespace petrichor::scene;
}

#endif
