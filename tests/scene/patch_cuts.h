// Scenes with the patches that they are cut into.
#ifndef PETRICHOR_TESTS_SCENE_PATCH_CUTS_H
#define PETRICHOR_TESTS_SCENE_PATCH_CUTS_H

#include <vector>

#include "scene/patches/patches.h"
#include "tests/scene/patch_scenes.h"

namespace petrichor::scene::patch_cuts {

using namespace patch_scenes;

struct Cut {
    explicit Cut(const Scene& made, const PatchOptions& options,
                 const std::vector<AlphaImage>& alpha = {})
        : scene(made),
          triangles(scene, alpha),
          tracer(triangles),
          patches(build_patches(tracer, options))
    {
    }
    Scene scene;
    Triangles triangles;
    Tracer tracer;
    Patches patches;
};

inline PatchOptions half_metre(int rays = 256)
{
    PatchOptions options;
    options.cell_m = 0.5f;
    options.rays = rays;
    return options;
}

}  // namespace petrichor::scene::patch_cuts

#endif
