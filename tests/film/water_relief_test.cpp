// Water in the relief below patches: its level is the one at which it has the volume that they hold.
#include "film/weather/water_relief.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "formulas/weather/ground_relief.h"
#include "tests/scene/patch_scenes.h"
#include "texproc/codecs/files/io.h"

namespace petrichor::film {
namespace {

using namespace scene::patch_scenes;

// A floor of 6 x 6 m. steps: its height map has that many plateaus between 0 and 1, in rows; 0: none.
struct Floor {
    explicit Floor(int steps) : scene(made(steps)), triangles(scene, {}), tracer(triangles)
    {
        scene::PatchOptions options;
        options.cell_m = 0.5f;
        options.rays = 32;
        patches = scene::build_patches(tracer, options);
    }
    static scene::Scene made(int steps)
    {
        scene::Scene scene = empty_scene();
        add_face(scene, {-3, 0, 3}, {6, 0, 0}, {0, 0, -6});
        scene::Material& m = scene.materials[0];
        if (steps > 0) {
            std::vector<std::uint8_t> grey;
            for (int y = 0; y < 64; ++y)
                for (int x = 0; x < 64; ++x)
                    grey.push_back(
                        static_cast<std::uint8_t>(255 * ((y * steps / 64) % steps) / (steps - 1)));
            scene::EncodedImage image;
            image.name = "heights";
            image.bytes = texproc::encode_png8(64, 64, 1, grey);
            scene.textures.push_back(image);
            m.weather.height.texture = 0;
            m.weather.height.scale = glm::vec2(13.0f);
            m.weather.height_scale_m = 0.03f;
        }
        return scene;
    }
    WaterReliefs all() const
    {
        std::vector<std::string> notes;
        auto made = water_reliefs(patches, triangles, notes);
        EXPECT_TRUE(notes.empty());
        return made;
    }
    WaterRelief relief() const { return all().of_material.at(0); }

    scene::Scene scene;
    scene::Triangles triangles;
    scene::Tracer tracer;
    scene::Patches patches;
};

TEST(WaterRelief, ALevelHoldsTheVolume)
{
    const WaterRelief relief = Floor(4).relief();
    for (const double mm : {0.2, 1.0, 2.0, 6.0, 14.0, 25.0}) {
        const float level = relief_level(relief, mm);
        double mean_mm = 0.0, below = 0.0;
        for (int k = 0; k < 4; ++k) {
            const double depth = static_cast<double>(level) - k / 3.0;
            mean_mm += std::max(depth, 0.0) * 30.0 / 4.0;
            below += depth > 0.0 ? 0.25 : 0.0;
        }
        EXPECT_NEAR(mean_mm, mm, 0.05 * mm + 0.05) << mm;
        EXPECT_NEAR(static_cast<double>(drowned_share(relief, level)), below, 0.06) << mm;
    }
    EXPECT_LT(relief_level(relief, 0.0), 0.0f) << "the lowest point is dry";
    EXPECT_EQ(drowned_share(relief, relief_level(relief, 0.0)), 0.0f);
}

// Without a height map the relief is the world's own, and its hollows hold the volume together.
TEST(WaterRelief, GroundWithoutAMapHoldsTheVolumeInItsOwnHollows)
{
    const Floor floor(0);
    const WaterRelief relief = floor.relief();
    const float base = floor.scene.materials[0].weather.default_height;
    for (const double mm : {0.5, 3.0, 10.0, 40.0}) {
        const float level = relief_level(relief, mm);
        double sum = 0.0;
        const int across = 200;
        for (int i = 0; i < across * across; ++i) {
            const glm::vec2 at = (glm::vec2(i % across, i / across) + 0.5f) / float{across} * 6.0f - 3.0f;
            const float height = base + shared::kGroundRelief * shared::ground_relief(at);
            sum += static_cast<double>(std::max(level - height, 0.0f)) * 15.0;
        }
        EXPECT_NEAR(sum / (across * across), mm, 0.05 * mm + 0.05) << mm;
    }
}

TEST(WaterRelief, FlatGroundIsCoveredEvenly)
{
    // A map of one grey.
    Floor floor(4);
    floor.scene.textures[0].bytes =
        texproc::encode_png8(2, 2, 1, std::vector<std::uint8_t>(4, std::uint8_t{51}));
    const WaterRelief relief = floor.relief();
    EXPECT_NEAR(relief_level(relief, 3.0), 0.2f + 0.1f, 1e-3f);
    EXPECT_EQ(drowned_share(relief, relief_level(relief, 0.1)), 1.0f);
}

// What it holds before it runs off: a third of the ground under water, in a hollow all of it; and the model
// wets as much of a patch as the picture.
TEST(WaterRelief, MasksTellHollowsThatHoldMore)
{
    Floor floor(4);
    const WaterReliefs plain = floor.all();
    EXPECT_EQ(std::count(plain.hollow.begin(), plain.hollow.end(), true), 0);
    auto& p = floor.scene.meshes[0].primitives[0];
    for (const glm::vec3& x : p.positions)
        p.weather.emplace_back(1.0f, x.x < 0.0f ? 1.0f : 0.0f, 1.0f, 1.0f);
    const WaterReliefs masked = floor.all();
    for (std::uint32_t i = 0; i < floor.patches.count; ++i) {
        const float x = floor.patches.position_m[i].x;
        if (std::abs(x) > 0.3f) {
            EXPECT_EQ(masked.hollow[i], x < 0.0f) << x;
        }
    }
    const WaterRelief& relief = masked.of_material[0];
    const weather::Hypsometry level = store_of_relief(relief, false),
                              hollow = store_of_relief(relief, true);
    // Plateaus at 0, 10, 20 and 30 mm.
    EXPECT_NEAR(level.capacity_kg_m2(), 2.5, 0.4);
    EXPECT_NEAR(hollow.capacity_kg_m2(), 15.0, 0.5);
    for (const double mm : {0.5, 2.0}) {
        EXPECT_NEAR(weather::wet_area(level, weather::water_level_mm(level, mm)),
                    static_cast<double>(drowned_share(relief, relief_level(relief, mm))), 0.08)
            << mm;
    }
}

TEST(WaterRelief, SlopesAndMaterialsKeepWaterAway)
{
    Floor floor(4);
    floor.scene.materials[0].weather.water_accumulation = {0.0f, 0.0f, 0.0f, 0.0f};
    EXPECT_LT(relief_level(floor.relief(), 5.0), 0.0f);
    EXPECT_FALSE(holds_water(floor.scene.materials[0], {0.8f, 0.6f, 0.0f}));
    EXPECT_TRUE(holds_water(floor.scene.materials[0], {0.6f, 0.8f, 0.0f}));
    floor.scene.materials[0].weather.height = {};
    EXPECT_FALSE(holds_water(floor.scene.materials[0], {0.6f, 0.8f, 0.0f}));
}

TEST(WaterRelief, AMapThatCannotBeReadIsSaid)
{
    Floor floor(4);
    floor.scene.textures[0].bytes.resize(20);
    std::vector<std::string> notes;
    const auto reliefs = water_reliefs(floor.patches, floor.triangles, notes);
    EXPECT_EQ(notes.size(), 1u);
    EXPECT_GT(reliefs.of_material.at(0).unit_mm, 0.0);
}

}  // namespace
}  // namespace petrichor::film
