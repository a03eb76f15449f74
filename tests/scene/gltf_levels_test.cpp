// Instances with colours of their own, and nodes that stand in for others.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/scene/gltf_yard.h"

namespace petrichor::scene {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using yard::glb;
using yard::load;
using yard::refusal;
using yard::scene_json;

TEST(GltfInstances, MayHaveColours)
{
    json document = scene_json();
    auto& attributes = document["nodes"][4]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
    attributes["_COLOR_0"] = attributes["TRANSLATION"];
    const Scene scene = load(document);
    ASSERT_EQ(scene.instances.size(), 4u);
    EXPECT_FALSE(scene.instances[0].look.color.has_value());
    EXPECT_EQ(scene.instances[2].look.color, glm::vec3(1, 0, 0)) << "held in 0 to 1";
    EXPECT_EQ(scene.instances[3].look.color, glm::vec3(0, 0, 1));
    attributes["_COLOR_0"] = 2;  // texture coordinates: two numbers
    EXPECT_THAT(refusal(glb(document.dump())), HasSubstr("_COLOR_0: needs 3 or 4"));
}

json with_levels()
{
    json document = scene_json();
    document["extensionsUsed"].push_back("MSFT_lod");
    document["nodes"].push_back({{"name", "wall far"}, {"mesh", 0}, {"translation", {0, 0, 1}}});
    document["nodes"].push_back({{"name", "wall away"}, {"mesh", 0}});
    document["nodes"][1]["extensions"]["MSFT_lod"]["ids"] = {5, 6};
    document["nodes"][1]["extras"]["MSFT_screencoverage"] = {0.4, 0.1, 0.02};
    return document;
}

TEST(GltfLevels, AreShownBySizeAndCountOnce)
{
    const Scene scene = load(with_levels());
    ASSERT_EQ(scene.instances.size(), 6u);
    const auto named = [&](const char* name) -> const Instance& {
        for (const Instance& instance : scene.instances) {
            if (instance.name == name) return instance;
        }
        throw Error("none", "");
    };
    const Instance& near = named("wall");
    const Instance& far = named("wall far");
    const Instance& away = named("wall away");
    EXPECT_EQ(near.to_world, far.to_world) << "they hang where it hangs";
    EXPECT_EQ(near.detail.level, 0u);
    EXPECT_FLOAT_EQ(near.detail.low, 0.4f);
    EXPECT_FLOAT_EQ(far.detail.high, 0.4f);
    EXPECT_FLOAT_EQ(far.detail.low, 0.1f);
    EXPECT_FLOAT_EQ(away.detail.low, 0.02f);
    // A square of 2 m: half of its diagonal.
    EXPECT_NEAR(near.detail.radius_m, 1.41421f, 1e-4f);
    EXPECT_EQ(away.detail.centre_m, near.detail.centre_m);
    EXPECT_EQ(named("crowd").detail, DetailLevel{});
    EXPECT_TRUE(near.stands());
    EXPECT_FALSE(away.stands());
}

TEST(GltfLevels, HaveSizesWithoutBeingTold)
{
    json document = with_levels();
    document["nodes"][1].erase("extras");
    for (const Instance& instance : load(document).instances) {
        if (instance.name == "wall") {
            EXPECT_FLOAT_EQ(instance.detail.low, 0.25f);
        }
        if (instance.name == "wall away") {
            EXPECT_EQ(instance.detail.low, 0.0f);
        }
    }
    document["nodes"][1]["extras"]["MSFT_screencoverage"] = {0.1, 0.4, 0.0};
    EXPECT_THAT(load(document).warnings, testing::Contains(HasSubstr("must fall")));
}

TEST(GltfLevels, AreNoPartOfTheScene)
{
    json document = with_levels();
    document["nodes"][1]["extensions"]["MSFT_lod"]["ids"] = {4};
    EXPECT_THAT(refusal(glb(document.dump())), HasSubstr("part of the scene already"));
    document["nodes"][1]["extensions"]["MSFT_lod"]["ids"] = {5, 5};
    EXPECT_THAT(refusal(glb(document.dump())), HasSubstr("part of the scene already"));
    document["nodes"][1]["extensions"]["MSFT_lod"]["ids"] = {99};
    EXPECT_THAT(refusal(glb(document.dump())), HasSubstr("99"));
}

}  // namespace
}  // namespace petrichor::scene
