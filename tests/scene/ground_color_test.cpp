// The colour that patches have on a ground of layers.
#include <gtest/gtest.h>

#include "scene/patches/surfaces.h"
#include "scene/patches/triangles.h"
#include "tests/scene/patch_scenes.h"

namespace petrichor::scene {
namespace {

ColorImage row(std::vector<float> rgb)
{
    ColorImage image;
    image.width = static_cast<int>(rgb.size() / 3);
    image.height = 1;
    image.rgb = std::move(rgb);
    return image;
}

class GroundColor : public testing::Test {
protected:
    GroundColor() : scene(patch_scenes::empty_scene())
    {
        patch_scenes::add_face(scene, {0, 0, 1}, {1, 0, 0}, {0, 0, -1});
        scene.textures.resize(3);
        Material& m = scene.materials[0];
        m.base_color = glm::vec4(0.1f, 0.1f, 0.1f, 1.0f);
        m.second.use = SecondSetUse::Layers;
        m.second.mix_mask.texture = 0;
        m.second.color = glm::vec3(0.2f);
        m.second.third.color = glm::vec3(0.4f);
        m.second.fourth.color = glm::vec3(0.8f);
        images = {row({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}), row({1, 1, 1, 0.5f, 0.5f, 0.5f}), row({0.7f, 0.7f, 0.7f})};
    }

    // At the middle of the k-th quarter along u.
    float at(int k)
    {
        const Triangles triangles(scene, {});
        const float u = (static_cast<float>(k) + 0.5f) / 4.0f;
        return surface_color(triangles, 0, {u - 0.05f, 0.05f}, images).x;
    }

    Scene scene;
    std::vector<ColorImage> images;
};

TEST_F(GroundColor, IsThatOfTheLayerWithWeight)
{
    const float colors[] = {0.1f, 0.2f, 0.4f, 0.8f};
    for (int k = 0; k < 4; ++k) EXPECT_NEAR(at(k), colors[k], 1e-5f) << k;
    images[0] = row({0.25f, 0.25f, 0.25f});
    EXPECT_NEAR(at(0), 0.375f, 1e-5f);
}

TEST_F(GroundColor, TexturesRepeatAsTheirLayerDoes)
{
    images[0] = row({0, 0, 1});
    scene.materials[0].second.third.base_color_texture.texture = 1;
    EXPECT_NEAR(at(1), 0.4f, 1e-5f);
    EXPECT_NEAR(at(2), 0.2f, 1e-5f);
    scene.materials[0].second.third.tiling = glm::vec2(2.0f, 1.0f);
    EXPECT_NEAR(at(0), 0.4f, 1e-5f);
    EXPECT_NEAR(at(1), 0.2f, 1e-5f);
    EXPECT_NEAR(at(2), 0.4f, 1e-5f);
}

TEST_F(GroundColor, IsThatFromAfarWhereThereIsOne)
{
    scene.materials[0].second.far_texture.texture = 2;
    for (int k = 0; k < 4; ++k) EXPECT_NEAR(at(k), 0.7f, 1e-5f);
    scene.materials[0].second.use = SecondSetUse::None;
    EXPECT_NEAR(at(3), 0.1f, 1e-5f);
}

}  // namespace
}  // namespace petrichor::scene
