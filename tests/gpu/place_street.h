// A scene whose patches are of many sizes and materials.
#ifndef PETRICHOR_TESTS_GPU_PLACE_STREET_H
#define PETRICHOR_TESTS_GPU_PLACE_STREET_H

#include "tests/scene/patch_scenes.h"

namespace petrichor::gpu::place_street {

/// A street of slabs, with a house, a roof, posts and a wall thinner than a cell, and ground far out around it.
inline scene::Scene street()
{
    using namespace scene::patch_scenes;
    scene::Scene scene = empty_scene();
    std::size_t part[4] = {0, 0, 0, 0};
    for (int i = 1; i < 4; ++i) part[i] = add_material(scene, {});
    for (int x = 0; x < 12; ++x) {
        for (int z = 0; z < 12; ++z)
            add_face(scene, {0.83f * static_cast<float>(x) - 5.0f, 0.0f, 0.83f * static_cast<float>(z) - 5.0f}, {0, 0, 0.83f}, {0.83f, 0, 0},
                     part[(x * 7 + z * 5) % 4 == 0 ? 1 : 0]);
    }
    add_box(scene, {-4, 0, -4}, {-1, 3, 0}, false, part[2]);
    add_box(scene, {1, 0, -3}, {1.1f, 1.2f, 3}, false, part[3]);
    for (int k = 0; k < 5; ++k) {
        const float z = static_cast<float>(k);
        add_box(scene, {2.3f, 0, z - 2}, {2.36f, 1.5f, z - 1.9f}, false, part[1]);
    }
    add_face(scene, {-4.4f, 2.8f, -4}, {0, 0, 4}, {1.9f, 1.7f, 0}, part[1]);
    add_face(scene, {-120, -0.4f, -120}, {0, 0, 240}, {240, 0, 0}, part[0]);
    return scene;
}

}  // namespace petrichor::gpu::place_street

#endif
