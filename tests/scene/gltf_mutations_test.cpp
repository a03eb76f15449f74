#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "scene/gltf/gltf.h"
#include "tests/scene/gltf_yard.h"

namespace petrichor::scene {
namespace {

using nlohmann::json;
using scene_files::expect_answer;
using yard::glb;
using yard::Pointer;
using yard::scene_json;

// Whatever happens to the bytes, there is an answer. Seeded, so a failure can be repeated.
TEST(GltfMutations, EveryTruncationIsRefused)
{
    const std::vector<std::byte> whole = glb(scene_json().dump());
    ASSERT_TRUE(expect_answer(whole, "whole"));
    for (std::size_t size = 0; size < whole.size(); ++size) {
        std::vector<std::byte> part(whole.begin(),
                                    whole.begin() + static_cast<std::ptrdiff_t>(size));
        EXPECT_FALSE(expect_answer(part, "first " + std::to_string(size) + " bytes"));
    }
}

TEST(GltfMutations, FlippedBytesAreAnswered)
{
    const std::vector<std::byte> whole = glb(scene_json().dump());
    scene_files::Random random{1};
    int loaded = 0;
    for (int round = 0; round < 4000; ++round) {
        std::vector<std::byte> damaged = whole;
        const std::size_t flips = 1 + random.below(3);
        for (std::size_t i = 0; i < flips; ++i) {
            damaged[random.below(whole.size())] = static_cast<std::byte>(random.below(256));
        }
        loaded += expect_answer(damaged, "round " + std::to_string(round));
    }
    EXPECT_GT(loaded, 100) << "some damage is harmless";
    EXPECT_LT(loaded, 3900);
}

// Damage that keeps the JSON valid gets further: numbers and keys of other places.
TEST(GltfMutations, WrongValuesAreAnswered)
{
    const json whole = scene_json();
    std::vector<std::string> places;
    const json flat = whole.flatten();
    for (const auto& item : flat.items()) places.push_back(item.key());
    const std::vector<json> values{
        0,     1,           2,     3,  7,      -1,   0.5,     1e9,           1e18,
        1e300, 4294967295u, 65536, "", "VEC4", true, nullptr, json::array(), json::object(),
        5121,  5126};
    scene_files::Random random{5};
    int loaded = 0;
    for (int round = 0; round < 4000; ++round) {
        json damaged = whole;
        const std::size_t edits = 1 + random.below(2);
        std::string what = "round " + std::to_string(round);
        for (std::size_t i = 0; i < edits; ++i) {
            const std::string& place = places[random.below(places.size())];
            const json& value = values[random.below(values.size())];
            if (!damaged.contains(Pointer(place))) continue;
            damaged[Pointer(place)] = value;
            what += " " + place + " = " + value.dump();
        }
        loaded += expect_answer(glb(damaged.dump()), what);
    }
    EXPECT_GT(loaded, 100);
    EXPECT_LT(loaded, 3900);
}

}  // namespace
}  // namespace petrichor::scene
