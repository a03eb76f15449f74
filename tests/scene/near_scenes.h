// Scenes whose patches and what is close to them are found, and their light.
#ifndef PETRICHOR_TESTS_SCENE_NEAR_SCENES_H
#define PETRICHOR_TESTS_SCENE_NEAR_SCENES_H

#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

#include "scene/patches/lookup.h"
#include "scene/patches/near_light.h"
#include "scene/patches/radiosity.h"
#include "scene/patches/surfaces.h"
#include "tests/scene/patch_scenes.h"

namespace petrichor::scene::near_scenes {

using namespace patch_scenes;

struct Cut {
    explicit Cut(const Scene& made, float cell_m = 0.5f)
        : scene(made), triangles(scene, {}), tracer(triangles)
    {
        PatchOptions options;
        options.cell_m = cell_m;
        patches = build_patches(tracer, options);
        glow = trace_glow(patches, tracer, glowing_patches(patches, patch_surfaces(patches, triangles, {})));
        near = trace_near(patches, tracer, &glow);
    }
    Scene scene;
    Triangles triangles;
    Tracer tracer;
    Patches patches;
    GlowLinks glow;
    NearLinks near;
};

struct Lit {
    Lit(const Cut& cut, const Relight& input)
        : light(relight(cut.patches, input)),
          ways(lookup_ways(cut.patches, input.near)),
          planes(lookup_planes(cut.patches)),
          lit{ways.table, ways.ways, planes, light.irradiance, light.gradient, ways.grid, light.near}
    {
    }
    PatchIrradiance light;
    LookupWays ways;
    std::vector<glm::vec4> planes;
    LitPatches lit;
};

/// Light that patches and sources of what is close start with: albedo as given, all else none until a test says so.
struct Given {
    Given(const Cut& cut, float albedo_of_all)
        : albedo(cut.patches.count, glm::vec3(albedo_of_all)),
          direct(cut.patches.count, glm::vec3(0.0f)),
          emission(direct),
          sky(shared::kSkyBins, glm::vec3(0.0f)),
          near_albedo(cut.near.sources(), glm::vec3(albedo_of_all)),
          near_direct(cut.near.sources(), glm::vec3(0.0f)),
          near_emission(near_direct),
          near(&cut.near)
    {
    }
    Relight input() const
    {
        Relight input;
        input.albedo = albedo;
        input.direct = direct;
        input.emission = emission;
        input.sky = sky;
        input.near = near;
        input.near_albedo = near_albedo;
        input.near_direct = near_direct;
        input.near_emission = near_emission;
        return input;
    }
    std::vector<glm::vec3> albedo, direct, emission, sky, near_albedo, near_direct, near_emission;
    const NearLinks* near;
};

}  // namespace petrichor::scene::near_scenes

#endif
