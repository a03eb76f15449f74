// [materials."glob"] preset: what its words stand for.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "film/scenario/material_keys.h"
#include "film/scenario/scenario.h"

namespace petrichor::film {
namespace {

scene::Material with(const std::string& keys)
{
    const Scenario scenario = parse_scenario("[materials.\"*\"]\n" + keys + "\n", "s.toml");
    scene::Scene scene;
    scene.materials.resize(1);
    scene.materials[0].alpha_mode = scene::AlphaMode::Mask;
    apply_material_overrides(scenario.materials, {}, scene);
    return scene.materials[0];
}

TEST(MaterialKeys, APresetIsFourKeysInAWord)
{
    const scene::Material fade = with("preset = \"fade\"");
    EXPECT_EQ(fade.alpha_mode, scene::AlphaMode::Blend);
    EXPECT_FALSE(fade.premultiplied_alpha);
    EXPECT_FALSE(fade.casts_shadows);
    const scene::Material glass = with("preset = \"transparent with shadows\"");
    EXPECT_TRUE(glass.premultiplied_alpha);
    EXPECT_TRUE(glass.casts_shadows);
    EXPECT_FALSE(glass.double_sided);
    const scene::Material leaf = with("preset = \"clip double-sided\"");
    EXPECT_EQ(leaf.alpha_mode, scene::AlphaMode::Mask);
    EXPECT_TRUE(leaf.double_sided);
    EXPECT_EQ(with("preset = \"opaque\"").alpha_mode, scene::AlphaMode::Opaque);
    // Keys beside it win, whatever their letters.
    EXPECT_TRUE(with("casts_shadows = true\npreset = \"fade\"").casts_shadows);
    EXPECT_EQ(with("alpha_mode = \"OPAQUE\"\npreset = \"fade\"").alpha_mode,
              scene::AlphaMode::Opaque);
    try {
        with("preset = \"fadee\"");
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("fade"));
    }
}

TEST(MaterialKeys, TilingIsOfTheFirstSet)
{
    const scene::Material m = with("tiling = [4, 0.5]");
    EXPECT_EQ(m.base_color_texture.scale, glm::vec2(4.0f, 0.5f));
    EXPECT_EQ(m.normal_texture.scale, glm::vec2(4.0f, 0.5f));
    EXPECT_EQ(m.weather.height.scale, glm::vec2(4.0f, 0.5f));
    EXPECT_EQ(m.weather.snow_mask.scale, glm::vec2(1.0f));
    EXPECT_EQ(m.second.base_color_texture.scale, glm::vec2(1.0f));
    EXPECT_THROW(with("tiling = 4"), Error);
    EXPECT_THROW(with("tiling = [-1, 1]"), Error);
}

}  // namespace
}  // namespace petrichor::film
