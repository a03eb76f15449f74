#include "scene/merge.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace petrichor::scene {
namespace {

// A triangle whose corners and attributes hold `tag`, so that each can be told from all others.
Primitive triangle(float tag, std::uint32_t material, bool with_uv)
{
    Primitive p;
    p.positions = {{tag, 0, 0}, {tag, 1, 0}, {tag, 0, 1}};
    p.normals.assign(3, {0, 1, 0});
    p.tangents.assign(3, {1, 0, 0, tag});
    if (with_uv) p.uv0.assign(3, {tag, tag});
    p.colors.assign(3, glm::vec4(tag));
    p.indices = {0, 1, 2};
    p.material = material;
    return p;
}

// What is drawn: material, tag and attributes of every corner, in order.
std::vector<std::vector<float>> corners_of(const Mesh& mesh, std::uint32_t material)
{
    std::vector<std::vector<float>> corners;
    for (const Primitive& p : mesh.primitives) {
        if (p.material != material) continue;
        for (const std::uint32_t i : p.indices) {
            corners.push_back({p.positions[i].x, p.positions[i].y, p.positions[i].z, p.normals[i].y,
                               p.tangents[i].w, p.uv0.empty() ? -1.0f : p.uv0[i].x, p.colors[i].x});
        }
    }
    return corners;
}

TEST(MergePrimitives, OneDrawAMaterialAndTheSameTriangles)
{
    Scene scene;
    scene.materials.resize(4);
    scene.materials[2].alpha_mode = AlphaMode::Blend;
    scene.materials[3].transmission = 0.5f;
    Mesh mesh;
    for (int i = 0; i < 40; ++i)
        mesh.primitives.push_back(
            triangle(static_cast<float>(i), static_cast<std::uint32_t>(i % 4), true));
    mesh.primitives.push_back(triangle(99, 0, false));
    scene.meshes = {mesh, {"empty", {}}, {"one", {triangle(1, 1, true)}}};
    merge_primitives(scene);
    // Two opaque materials, one of them also without coordinates; blended ones stay apart.
    EXPECT_EQ(scene.meshes[0].primitives.size(), 2u + 1u + 10u + 10u);
    EXPECT_TRUE(scene.meshes[1].primitives.empty());
    EXPECT_EQ(scene.meshes[2].primitives.size(), 1u);
    for (const std::uint32_t material : {0u, 1u, 2u, 3u})
        EXPECT_EQ(corners_of(scene.meshes[0], material), corners_of(mesh, material)) << material;
    const auto once = scene.meshes[0].primitives.size();
    merge_primitives(scene);
    EXPECT_EQ(scene.meshes[0].primitives.size(), once);
}

}  // namespace
}  // namespace petrichor::scene
