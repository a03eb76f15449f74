// Hollows and the water in them: volumes, levels, spilling, and the books.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>
#include <random>
#include <tuple>
#include <vector>

#include "scene/basins/basin_map.h"
#include "scene/basins/hierarchy.h"
#include "scene/basins/water.h"

namespace petrichor::scene {
namespace {

HeightField field_of(std::size_t width, std::size_t depth, std::vector<float> heights)
{
    HeightField field;
    field.width = width;
    field.depth = depth;
    field.height_m = std::move(heights);
    return field;
}

// A line between two walls: the reference's example has open ends.
HeightField line_of(const std::vector<float>& heights)
{
    std::vector<float> all(heights.size(), kSolid_m);
    all.insert(all.end(), heights.begin(), heights.end());
    all.insert(all.end(), heights.size(), kSolid_m);
    return field_of(heights.size(), 3, std::move(all));
}

HeightField rough_field(std::size_t width, std::size_t depth, unsigned seed)
{
    std::mt19937 random(seed);
    std::vector<float> heights(width * depth);
    for (float& h : heights) h = static_cast<float>(random() % 64) * 0.25f;  // with many ties
    return field_of(width, depth, std::move(heights));
}

std::uint32_t pit_at(const Basins& basins, const HeightField& field, std::size_t x, std::size_t z)
{
    return basins.label[field.cell_of(x, z)];
}

double poured(const Basins& basins, BasinWater& water, std::uint32_t pit, double amount)
{
    std::vector<double> into(basins.pits + 1, 0.0);
    into[pit] = amount;
    return pour(basins, water, into);
}

TEST(Basins, TheLineOfTheReference)
{
    const HeightField field = line_of({0, 6, 2, 4, 1, 3, 7, 0});
    const Basins basins = find_basins(field);
    ASSERT_EQ(basins.pits, 2u);
    ASSERT_EQ(basins.hollow.size(), 4u);
    const std::uint32_t left = pit_at(basins, field, 2, 1), right = pit_at(basins, field, 4, 1);
    EXPECT_EQ(basins.hollow[left].capacity_m3, 2.0);
    EXPECT_EQ(basins.hollow[right].capacity_m3, 4.0);
    EXPECT_EQ(basins.hollow[left].spill_m, 4.0f);
    EXPECT_EQ(basins.hollow[3].capacity_m3, 14.0);
    EXPECT_EQ(basins.hollow[3].spill_m, 6.0f);
    EXPECT_EQ(basins.hollow[3].spills_to, kOutside);

    struct Row {
        double volume, left, right, out;
    };
    for (const Row& row : {Row{1, 3, 1, 0}, Row{2, 4, 1, 0}, Row{3, 4, 2, 0}, Row{5, 4, 3.5, 0},
                           Row{6, 4, 4, 0}, Row{10, 5, 5, 0}, Row{14, 6, 6, 0}, Row{15, 6, 6, 1}}) {
        BasinWater water(basins);
        EXPECT_NEAR(poured(basins, water, left, row.volume), row.out, 1e-12);
        const std::vector<float> level = levels_m(basins, water);
        EXPECT_NEAR(level[left], row.left, 1e-6) << row.volume;
        EXPECT_NEAR(level[right], row.right, 1e-6) << row.volume;
        EXPECT_NEAR(stored_m3(basins, water) + row.out, row.volume, 1e-12);
    }
}

// Heights and results of a case that the authors of Fill-Spill-Merge test (MoveWaterIntoPits 1).
TEST(Basins, TheFieldOfTheAuthors)
{
    const HeightField field =
        field_of(10, 10,
                 {
                     -9, -9, -9, -9, -9, -9, -9, -9, -9, -9, -9, 9,  9,  9,  9,  9,  9,  9,  9,  -9,
                     -9, 9,  8,  8,  8,  8,  7,  6,  9,  -9, -9, 9,  8,  7,  8,  7,  6,  5,  9,  -9,
                     -9, 9,  8,  7,  8,  6,  5,  4,  9,  -9, -9, 9,  8,  8,  8,  5,  4,  3,  9,  -9,
                     -9, 9,  7,  6,  5,  4,  3,  2,  9,  -9, -9, 9,  7,  6,  5,  4,  3,  1,  9,  -9,
                     -9, 9,  9,  9,  9,  9,  9,  9,  9,  -9, -9, -9, -9, -9, -9, -9, -9, -9, -9, -9,
                 });
    const Basins basins = find_basins(field);
    ASSERT_EQ(basins.pits, 2u);
    EXPECT_EQ(basins.hollow[pit_at(basins, field, 7, 7)].capacity_m3, 73.0);
    EXPECT_EQ(basins.hollow[pit_at(basins, field, 3, 3)].capacity_m3, 2.0);
    ASSERT_EQ(basins.hollow.size(), 4u);
    EXPECT_EQ(basins.hollow[3].capacity_m3, 111.0);
    EXPECT_EQ(basins.hollow[3].spill_m, 9.0f);
}

TEST(Basins, RootsHoldWhatRainWithoutEndFills)
{
    for (unsigned seed = 1; seed <= 20; ++seed) {
        const HeightField field = rough_field(13 + seed, 9 + seed % 5, seed);
        const Basins basins = find_basins(field);
        const std::vector<float> filled = filled_heights(field);
        double fill = 0.0, roots = 0.0;
        for (std::size_t i = 0; i < field.cells(); ++i)
            fill += static_cast<double>(filled[i]) - static_cast<double>(field.height_m[i]);
        for (std::uint32_t i = 1; i < basins.hollow.size(); ++i)
            if (basins.hollow[i].parent == 0) roots += basins.hollow[i].capacity_m3;
        EXPECT_NEAR(roots, fill, 1e-9 * fill) << seed;
        // And cell by cell, as the picture would show it.
        BasinWater water(basins);
        std::vector<double> flood(basins.pits + 1, 1e6);
        pour(basins, water, flood);
        const std::vector<float> level = levels_m(basins, water);
        for (std::size_t i = 0; i < field.cells(); ++i) {
            const std::uint32_t label = basins.label[i];
            const float wet =
                label == kOutside ? field.height_m[i] : std::max(field.height_m[i], level[label]);
            EXPECT_EQ(wet, filled[i]) << seed << " " << i;
        }
    }
}

TEST(Basins, WaterIsNeitherMadeNorLostInAnyOrder)
{
    for (unsigned seed = 1; seed <= 12; ++seed) {
        const HeightField field = rough_field(24, 17, seed + 100);
        const Basins basins = find_basins(field);
        std::mt19937 random(seed);
        std::vector<std::pair<std::uint32_t, double>> rain;
        double fallen = 0.0;
        for (int i = 0; i < 400; ++i) {
            rain.emplace_back(1 + random() % basins.pits,
                              static_cast<double>(random() % 1000) * 1e-2);
            fallen += rain.back().second;
        }
        std::vector<float> first;
        for (int turn = 0; turn < 4; ++turn) {
            std::shuffle(rain.begin(), rain.end(), random);
            BasinWater water(basins);
            double out = 0.0;
            for (const auto& [pit, amount] : rain) out += poured(basins, water, pit, amount);
            EXPECT_NEAR(stored_m3(basins, water) + out, fallen, 1e-9 * fallen);
            const std::vector<float> level = levels_m(basins, water);
            if (turn == 0) first = level;
            for (std::size_t i = 1; i < level.size(); ++i)
                EXPECT_NEAR(level[i], first[i], 1e-5) << seed << " " << i;
            double held = 0.0;
            for (const WaterShape& shape : water_shapes(basins, water))
                held += shape.depth_m * shape.area_m2;
            EXPECT_NEAR(held, stored_m3(basins, water), 1e-9 * fallen);
        }
    }
}

TEST(Basins, LevelAndVolumeAreInverse)
{
    const HeightField field = rough_field(30, 30, 5);
    const Basins basins = find_basins(field);
    for (std::uint32_t i = 1; i < basins.hollow.size(); ++i) {
        const Hollow& h = basins.hollow[i];
        if (h.capacity_m3 <= 0.0) continue;
        double least = 0.0;  // of a parent: what its children hold
        for (const std::uint32_t c : h.child)
            if (c != 0) least += basins.hollow[c].capacity_m3;
        double before = -1e9;
        for (int k = 0; k <= 10; ++k) {
            const double volume = least + (h.capacity_m3 - least) * 0.1 * k;
            const double level = level_at_m(basins, i, volume);
            EXPECT_GE(level, before);
            EXPECT_NEAR(volume_at_m3(basins, i, level), volume, 1e-9 * h.capacity_m3 + 1e-12);
            before = level;
        }
    }
}

TEST(Basins, EvaporationLowersTheLevelAndPartsTheWater)
{
    const HeightField field = line_of({0, 6, 2, 4, 1, 3, 7, 0});
    const Basins basins = find_basins(field);
    BasinWater water(basins);
    const std::uint32_t left = pit_at(basins, field, 2, 1), right = pit_at(basins, field, 4, 1);
    poured(basins, water, left, 10.0);  // one water at 5
    const std::vector<double> loss(basins.pits + 1, 0.5);
    EXPECT_NEAR(evaporate(basins, water, loss), 4 * 0.5, 1e-12);  // four cells are wet
    EXPECT_NEAR(levels_m(basins, water)[left], 4.5, 1e-6);
    EXPECT_NEAR(evaporate(basins, water, std::vector<double>(basins.pits + 1, 1.0)),
                4 * 0.5 + (1 + 2) * 0.5, 1e-12);  // below the saddle it stands in two places
    EXPECT_NEAR(levels_m(basins, water)[left], 3.5, 1e-6);
    EXPECT_NEAR(levels_m(basins, water)[right], 3.5, 1e-6);
    poured(basins, water, left, 0.25);
    EXPECT_NEAR(levels_m(basins, water)[left], 3.75, 1e-6);
    EXPECT_NEAR(levels_m(basins, water)[right], 3.5, 1e-6);
    evaporate(basins, water, std::vector<double>(basins.pits + 1, 100.0));
    EXPECT_EQ(stored_m3(basins, water), 0.0);
    EXPECT_EQ(levels_m(basins, water)[left], 2.0f);
    // In a picture what is dry is so below the height of its pit too.
    EXPECT_EQ(drawn_levels_m(basins, water)[left], kDry_m);
    poured(basins, water, left, 0.25);
    EXPECT_EQ(drawn_levels_m(basins, water)[left], levels_m(basins, water)[left]);
    EXPECT_EQ(drawn_levels_m(basins, water)[right], kDry_m);
}

TEST(Basins, EvaporationClosesTheBooks)
{
    const HeightField field = rough_field(20, 20, 77);
    const Basins basins = find_basins(field);
    BasinWater water(basins);
    std::mt19937 random(3);
    double in = 0.0, out = 0.0, lost = 0.0;
    for (int hour = 0; hour < 300; ++hour) {
        std::vector<double> rain(basins.pits + 1, 0.0), loss(basins.pits + 1, 0.0);
        for (std::uint32_t i = 1; i <= basins.pits; ++i) {
            rain[i] = hour % 7 == 0 ? static_cast<double>(random() % 100) * 0.02 : 0.0;
            loss[i] = static_cast<double>(random() % 100) * 1e-3;
            in += rain[i];
        }
        out += pour(basins, water, rain);
        lost += evaporate(basins, water, loss);
        EXPECT_NEAR(stored_m3(basins, water) + out + lost, in, 1e-9 * in) << hour;
    }
    EXPECT_GT(lost, 0.0);
    EXPECT_GT(out, 0.0);
}

// As the authors have it: one queue of all that is reached, by height, first come first served. Flats, drains and voids.
TEST(Basins, CellsGoToThePitsThatOneQueueGivesThemTo)
{
    struct Waits {
        float height_m;
        std::uint64_t order;
        std::size_t cell;
        std::uint32_t label;
        bool operator<(const Waits& o) const { return std::tie(height_m, order) > std::tie(o.height_m, o.order); }
    };
    for (unsigned seed = 0; seed < 12; ++seed) {
        HeightField field = rough_field(31, 23, seed);
        for (float& h : field.height_m) h = h > 15.0f ? kSolid_m : h > 14.5f ? kNoGround_m : h == 1.0f ? -0.0f : h - 3.0f;
        const std::vector<std::size_t> drains{77, 301};
        const auto around = [&](std::size_t cell) {
            std::vector<std::size_t> cells;
            const auto x = static_cast<int>(cell % 31), z = static_cast<int>(cell / 31);
            for (int nz = z - 1; nz <= z + 1; ++nz)
                for (int nx = x - 1; nx <= x + 1; ++nx)
                    if (nx >= 0 && nz >= 0 && nx < 31 && nz < 23 && (nx != x || nz != z))
                        cells.push_back(static_cast<std::size_t>(nz * 31 + nx));
            return cells;
        };
        const auto ground = [&](std::size_t cell) { return std::isfinite(field.height_m[cell]); };
        std::vector<std::size_t> rising;
        std::vector<bool> out(field.cells(), false);
        for (std::size_t cell = 0; cell < field.cells(); ++cell) {
            if (!ground(cell)) continue;
            rising.push_back(cell);
            const auto cells = around(cell);
            out[cell] = cells.size() < 8 || std::any_of(cells.begin(), cells.end(), [&](std::size_t c) {
                            return std::isnan(field.height_m[c]);
                        });
        }
        for (const std::size_t drain : drains) out[drain] = out[drain] || ground(drain);
        std::stable_sort(rising.begin(), rising.end(), [&](std::size_t a, std::size_t b) {
            return field.height_m[a] != field.height_m[b] ? field.height_m[a] < field.height_m[b] : out[a] > out[b];
        });
        std::vector<std::uint32_t> label(field.cells(), kNoLabel);
        std::uint32_t pits = 0;
        std::uint64_t order = 0;
        std::priority_queue<Waits> waits;
        const auto settle = [&](std::size_t cell, std::uint32_t to) {
            label[cell] = out[cell] ? kOutside : to;
            for (const std::size_t next : around(cell))
                if (ground(next) && label[next] == kNoLabel)
                    waits.push({std::max(field.height_m[cell], field.height_m[next]), order++, next, label[cell]});
        };
        for (std::size_t next = 0; next < rising.size() || !waits.empty();) {
            while (next < rising.size() && label[rising[next]] != kNoLabel) ++next;
            const bool above = next < rising.size() && !waits.empty() && waits.top().height_m == field.height_m[rising[next]];
            if (!waits.empty() && (next == rising.size() || waits.top().height_m < field.height_m[rising[next]] ||
                                   (above && !out[rising[next]]))) {
                const Waits top = waits.top();
                waits.pop();
                if (label[top.cell] == kNoLabel) settle(top.cell, top.label);
            } else if (next < rising.size()) {
                settle(rising[next], out[rising[next]] ? kOutside : ++pits);
            }
        }
        const Basins found = find_basins(field, drains);
        EXPECT_EQ(found.pits, pits) << seed;
        EXPECT_GT(pits, 20u) << seed;
        EXPECT_EQ(found.label, label) << seed;
    }
}

TEST(Basins, ADrainEmptiesItsHollow)
{
    const HeightField field = field_of(5, 5,
                                       {
                                           9, 9, 9, 9, 9,  //
                                           9, 1, 1, 1, 9,  //
                                           9, 1, 0, 1, 9,  //
                                           9, 1, 1, 1, 9,  //
                                           9, 9, 9, 9, 9,
                                       });
    EXPECT_EQ(find_basins(field).hollow.back().capacity_m3, 9 + 8 * 8);
    const std::size_t drain[] = {field.cell_of(2, 2), 1000};
    const Basins drained = find_basins(field, drain);
    EXPECT_EQ(drained.pits, 0u);
    EXPECT_EQ(drained.label[field.cell_of(1, 1)], kOutside);
}

TEST(Basins, FlatGroundHasNoHollow)
{
    const Basins basins = find_basins(field_of(30, 20, std::vector<float>(600, 3.0f)));
    EXPECT_EQ(basins.pits, 0u);
}

TEST(Basins, WallsKeepWaterInAndVoidsLetItOut)
{
    std::vector<float> heights(49, kSolid_m);
    for (std::size_t z = 2; z < 5; ++z)
        for (std::size_t x = 2; x < 5; ++x) heights[z * 7 + x] = 1.0f;
    heights[3 * 7 + 3] = 0.0f;
    const Basins court = find_basins(field_of(7, 7, heights));
    EXPECT_EQ(court.pits, 1u);
    EXPECT_EQ(court.hollow[1].capacity_m3, 1.0);  // to the brim of its highest cell
    heights[2 * 7 + 2] = kNoGround_m;             // beside the pit: its water falls out
    EXPECT_EQ(find_basins(field_of(7, 7, heights)).pits, 0u);
    EXPECT_EQ(find_basins({}).pits, 0u);
    const HeightField nothing = field_of(2, 2, std::vector<float>(4, kNoGround_m));
    EXPECT_EQ(find_basins(nothing).pits, 0u);
}

TEST(Basins, TheMapShowsWaterWhereItStands)
{
    const HeightField field = field_of(5, 3, {1, 1, 1, 1, 1, 1, 0.9f, 1, 1, 1, 1, 1, 1, 1, 1});
    const Basins basins = find_basins(field);
    const Image full = basin_map(field, basins);
    EXPECT_EQ(full.width, 5);
    EXPECT_EQ(full.height, 3);
    EXPECT_GT(full.at(1, 1, 2), 2.0f * full.at(1, 1, 0));  // blue
    EXPECT_NEAR(full.at(4, 1, 2), full.at(4, 1, 0), 1e-6f);
    const Image dry = basin_map(field, basins, levels_m(basins, BasinWater(basins)));
    EXPECT_LT(dry.at(1, 1, 2), 2.0f * dry.at(1, 1, 0));
}

}  // namespace
}  // namespace petrichor::scene
