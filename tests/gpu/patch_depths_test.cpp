// Snow between patches that are squares of one depth each.
#include "gpu/snow/patch_depths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "formulas/light/patch_cells.h"
#include "formulas/noise/noise.h"

namespace petrichor::gpu {
namespace {

using glm::vec3;

constexpr float kCell_m = 0.5f;
constexpr int kCells = 24;

// Level ground of squares that rises by half a cell on its way along x.
float ground_m(float x) { return 0.02f * x; }

std::uint32_t& patch_in(PlaceShape& shape, const glm::ivec3& cell, int axis)
{
    const shared::PatchKey key = shared::patch_key(cell, axis, 0);
    std::uint32_t slot = shared::patch_key_hash(key) & shape.grid.table_mask;
    while (shape.table[slot].z != shared::kNoPatch && (shape.table[slot].x != key.low || shape.table[slot].y != key.high))
        slot = (slot + 1) & shape.grid.table_mask;
    if (shape.table[slot].z == shared::kNoPatch) shape.table[slot] = glm::uvec4(key.low, key.high, shared::kNoPatch, 0);
    return shape.table[slot].z;
}

std::shared_ptr<PlaceShape> squares()
{
    auto shape = std::make_shared<PlaceShape>();
    shape->grid.cell_m = kCell_m;
    shape->grid.levels = 1;
    shape->grid.patches = 4 * kCells * kCells;
    shape->grid.table_mask = 8191;
    shape->table.assign(8192, glm::uvec4(0, 0, shared::kNoPatch, 0));
    std::uint32_t number = 0;
    constexpr int kFine = 64;  // places along a cell: where the ground crosses a layer a column has a patch in each
    for (int i = 0; i < kFine * kCells * kCells; ++i) {
        const vec3 at(kCell_m / kFine * static_cast<float>(i % (kFine * kCells)), 0.0f, kCell_m * static_cast<float>(i / (kFine * kCells)));
        const glm::ivec3 cell = shared::patch_cell(at + vec3(0.0f, ground_m(at.x) + 0.06f * kCell_m, 0.0f), 1.0f / kCell_m);
        std::uint32_t& patch = patch_in(*shape, cell, 2);
        if (patch == shared::kNoPatch) patch = number++;
    }
    return shape;
}

PlaceWeather weather_of(const std::shared_ptr<PlaceShape>& shape, float rough_m)
{
    PlaceWeather weather;
    weather.shape = shape;
    weather.states.assign(std::size_t{shape->grid.patches} * PLACE_STATE_TEXELS, glm::vec4(0.0f));
    for (std::uint32_t i = 0; i < shape->grid.patches; ++i)
        weather.states[std::size_t{i} * PLACE_STATE_TEXELS + 2].z = 0.1f + rough_m * (shared::hash_f(shared::hash_u3(i, 3u, 5u)) - 0.5f);
    return weather;
}

// Neither steps nor creases along a line over borders and layers: as steep as the spline, and no steeper from one millimetre to the next.
TEST(PatchDepths, KnowNoBordersOfPatches)
{
    std::vector<vec3> places;
    for (float x = 2.0f; x < 9.0f; x += 0.001f) places.emplace_back(x, ground_m(x), 5.3f);
    const auto shape = squares();
    PatchDepths depths;
    depths.find(shape, places);
    const std::vector<float> even = depths.depths_m(weather_of(shape, 0.0f), 0.7f);
    const auto [low, high] = std::minmax_element(even.begin(), even.end());
    EXPECT_NEAR(*low, 0.1f, 1.0e-5f);
    EXPECT_NEAR(*high, 0.1f, 1.0e-5f);
    const std::vector<float> rough = depths.depths_m(weather_of(shape, 0.04f), 0.7f);
    float step_m = 0.0f, bend_m = 0.0f, range_m = 0.0f;
    for (std::size_t i = 10; i + 10 < rough.size(); ++i) {
        step_m = std::max(step_m, std::abs(rough[i + 1] - rough[i]));
        bend_m = std::max(bend_m, std::abs(rough[i + 10] - 2.0f * rough[i] + rough[i - 10]));
        range_m = std::max(range_m, std::abs(rough[i] - 0.1f));
    }
    EXPECT_GT(range_m, 0.002f) << "patches do differ";
    EXPECT_LT(step_m, 1.5e-4f) << "a step of 15 % at most";
    EXPECT_LT(bend_m, 1.0e-4f) << "no crease within a centimetre";
}

// A roof of 53 degrees has patches that look to its side, which know what has slid from it; what has none at all is open ground.
TEST(PatchDepths, OfASteepRoofAreThoseOfItsOwnSide)
{
    const auto shape = squares();
    const vec3 side(0.8f, 0.6f, 0.0f), place(5.0f, 6.0f, 5.0f);
    PatchDepths depths;
    depths.find(shape, {place}, {side});
    EXPECT_EQ(depths.depths_m(weather_of(shape, 0.0f), 0.7f)[0], 0.7f);
    const glm::ivec3 cell = shared::patch_cell(place + 0.06f * kCell_m * side, 1.0f / kCell_m);
    const std::uint32_t roof = patch_in(*shape, cell, 0) = shape->grid.patches - 1;
    const auto with_roof = std::make_shared<PlaceShape>(*shape);
    depths.find(with_roof, {place, place, {5.0f, ground_m(5.0f), 5.0f}}, {side, vec3(0, 1, 0), vec3(0.3f, 0.95f, 0.0f)});
    PlaceWeather weather = weather_of(shape, 0.0f);
    weather.states[std::size_t{roof} * PLACE_STATE_TEXELS + 2].z = 0.02f;
    const std::vector<float> found = depths.depths_m(weather, 0.7f);
    EXPECT_NEAR(found[0], 0.02f / 0.6f, 1.0e-5f) << "upright";
    EXPECT_EQ(found[1], 0.7f) << "what faces up has no patch there";
    EXPECT_GT(found[2], 0.10005f) << "its own patch is inclined";
    EXPECT_LT(found[2], 0.1049f) << "those around it are level";
}

// A field of deep snow that ends where a row of patches does: its border winds about that row, and no snow is lost or made.
TEST(PatchDepths, EndAlongNoStraightLineAndKeepWhatLies)
{
    constexpr float kDeep_m = 0.1f, kStep_m = 0.025f;
    constexpr int kFirst = 7, kLast = 17;  // rows and columns with snow
    const auto shape = squares();
    PlaceWeather weather = weather_of(shape, 0.0f);
    std::vector<vec3> places;
    const int across = static_cast<int>(kCell_m * kCells / kStep_m);
    for (int k = 0; k < across * across; ++k) {
        const float x = kStep_m * (0.5f + static_cast<float>(k % across)), z = kStep_m * (0.5f + static_cast<float>(k / across));
        places.emplace_back(x, ground_m(x), z);
        const glm::ivec3 cell = shared::patch_cell(places.back() + vec3(0, 0.06f * kCell_m, 0), 1.0f / kCell_m);
        const auto inside = [](float at) { return at > kFirst * kCell_m && at < kLast * kCell_m; };
        const std::uint32_t patch = patch_in(*shape, cell, 2);
        if (patch != shared::kNoPatch) weather.states[std::size_t{patch} * PLACE_STATE_TEXELS + 2].z = inside(x) && inside(z) ? kDeep_m : 0.0f;
    }
    PatchDepths depths;
    depths.find(shape, places);
    const std::vector<float> found = depths.depths_m(weather, 0.0f);
    double volume_m3 = 0.0;
    for (const float depth_m : found) volume_m3 += static_cast<double>(depth_m) * kStep_m * kStep_m;
    const double side_m = (kLast - kFirst) * kCell_m;
    EXPECT_NEAR(volume_m3, kDeep_m * side_m * side_m, 0.02 * kDeep_m * side_m * side_m);
    // Where it is half as deep, along each side: how far off the line, in patches.
    for (const bool along_x : {true, false}) {
        for (const bool from_low : {true, false}) {
            double sum = 0.0, squares = 0.0, count = 0.0;
            for (int i = 0; i < across; ++i) {
                const float at = kStep_m * static_cast<float>(i) / kCell_m;
                if (at < kFirst + 2 || at > kLast - 2) continue;
                int in = 0;
                const auto deep = [&](int k) { return found[static_cast<std::size_t>(along_x ? k * across + i : i * across + k)] >= 0.5f * kDeep_m; };
                while (in < across / 2 && !deep(from_low ? in : across - 1 - in)) ++in;
                const double off = static_cast<double>(kStep_m * static_cast<float>(in) / kCell_m) - (from_low ? kFirst : kCells - kLast);
                sum += off;
                squares += off * off;
                count += 1.0;
            }
            EXPECT_GT(std::sqrt(squares / count - sum * sum / count / count), 0.1) << along_x << from_low;
            EXPECT_LT(std::abs(sum / count), 2.0) << along_x << from_low;
        }
    }
}

TEST(SnowWanders, KeepsAreasAndStaysNear)
{
    double squares = 0.0;
    float farthest = 0.0f;
    constexpr float kNear = 0.004f;
    for (int i = 0; i < 10000; ++i) {
        const glm::vec2 at(0.37f * static_cast<float>(i % 100), 0.41f * static_cast<float>(i / 100));
        const glm::vec2 there = snow_wanders(at), dx = (snow_wanders(at + glm::vec2(kNear, 0)) - there) / kNear,
                        dy = (snow_wanders(at + glm::vec2(0, kNear)) - there) / kNear;
        ASSERT_NEAR(dx.x * dy.y - dx.y * dy.x, 1.0f, 0.03f) << at.x << " " << at.y;
        const float far = glm::length(there - at);
        farthest = std::max(farthest, far);
        squares += static_cast<double>(far * far);
    }
    RecordProperty("deviation", std::to_string(std::sqrt(squares / 10000.0)));
    EXPECT_LT(farthest, 2.6f);
    EXPECT_GT(std::sqrt(squares / 10000.0), 0.3);
    EXPECT_LT(std::sqrt(squares / 10000.0), 1.0);
}

// Depths of patches are across their slope; upright there is more of it. What it holds is told beside.
TEST(PatchDepths, OfASlopeAreUprightAndKnowWhatItHolds)
{
    const auto shape = squares();
    const vec3 place(5.0f, ground_m(5.0f), 5.0f);
    const vec3 slope(0.6f, 0.8f, 0.0f);  // 37 degrees
    std::vector<vec3> places, faces;
    for (int k = 0; k < 2 * 2 * kCells * kCells; ++k) {
        const float x = kCell_m * (0.25f + 0.5f * static_cast<float>(k % (2 * kCells))), z = kCell_m * (0.25f + 0.5f * static_cast<float>(k / (2 * kCells)));
        places.emplace_back(x, ground_m(x), z);
        faces.push_back((k % 2 == 0 ? 3.0f : 1.0f) * slope);
    }
    places.push_back(place);
    faces.push_back(slope);
    places.emplace_back(60.0f, 0.0f, 5.0f);
    faces.push_back(slope);
    PatchDepths depths;
    depths.find(shape, places, faces);
    const std::vector<float> found = depths.depths_m(weather_of(shape, 0.0f), 0.7f);
    EXPECT_NEAR(found[found.size() - 2], 0.125f, 1.0e-5f);
    EXPECT_NEAR(depths.held()[found.size() - 2], 0.771f, 1.0e-3f);
    EXPECT_EQ(found.back(), 0.7f);
    EXPECT_EQ(depths.held().back(), 1.0f);
    depths.find(shape, {place});
    EXPECT_NEAR(depths.depths_m(weather_of(shape, 0.0f), 0.7f)[0], 0.1f, 1.0e-5f) << "level as far as is known";
    EXPECT_EQ(depths.held()[0], 1.0f);
}

TEST(PatchDepths, AreThoseOfTheOpenBeyondThem)
{
    const auto shape = squares();
    PatchDepths depths;
    depths.find(shape, {{5.0f, ground_m(5.0f), 5.0f}, {60.0f, 0.0f, 5.0f}, {5.0f, 9.0f, 5.0f}});
    const std::vector<float> found = depths.depths_m(weather_of(shape, 0.0f), 0.7f);
    EXPECT_NEAR(found[0], 0.1f, 1.0e-5f);
    EXPECT_EQ(found[1], 0.7f);
    EXPECT_EQ(found[2], 0.7f);
}

}  // namespace
}  // namespace petrichor::gpu
