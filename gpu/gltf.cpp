#include "gpu/gltf.h"
