// The tree of cells in which pixels find their patch, beside a walk through the table of all nodes.
#include "gpu/place/place_parts.h"
#include "gpu/place/place_tree.h"

#include <gtest/gtest.h>

#include <set>

#include "scene/patches/lookup.h"
#include "scene/patches/patches.h"
#include "tests/gpu/place_street.h"

namespace petrichor::shared {
namespace {

using namespace petrichor::shared_names;

struct TreeLookup {
    const gpu::PlaceTree& tree;

    uint place_word(uint index) const { return tree.words[index]; }
    uvec4 place_texel(uint index) const { return tree.texels[index]; }

#include "formulas/light/place_lookup.inc"
};

}  // namespace
}  // namespace petrichor::shared

namespace petrichor::gpu {
namespace {

using glm::ivec3;
using glm::vec3;

struct Street {
    scene::Scene scene = place_street::street();
    scene::Patches patches;
    PlaceTree tree;

    Street()
    {
        const scene::Triangles triangles(scene, {});
        const scene::Tracer tracer(triangles);
        scene::PatchOptions options;
        options.cell_m = 0.3f;
        options.rays = 32;
        patches = scene::build_patches(tracer, options);
        tree = place_tree(scene::table_grid(patches), patches.table, patches.material);
    }
};

const Street& the_street()
{
    static const Street made;
    return made;
}

struct Leaf {
    std::uint32_t number = shared::kNoPatch;
    int level = 0;
};

Leaf leaf_by_table(const scene::Patches& patches, ivec3 cell0, int axis)
{
    for (int level = patches.levels - 1; level >= 0; --level) {
        const std::uint32_t node = scene::find_node(patches, shared::patch_key(cell0 >> level, axis, level));
        if (node == scene::Patches::kNoNode) return {};
        if (node < patches.count) return {node, level};
    }
    return {};
}

struct Both {
    std::uint32_t own = shared::kNoPatch, other = shared::kNoPatch;
};

// Step by step as the page says it: docs/places.md, 2.
Both by_table(const scene::Patches& patches, vec3 x, vec3 n, vec3 turn)
{
    const float inverse = 1.0f / patches.cell_m;
    const vec3 lifted = x + n * (0.06f * patches.cell_m);
    const ivec3 cell0 = shared::patch_cell(lifted, inverse);
    vec3 along = glm::abs(n);
    Leaf own;
    int axis = 0;
    for (int turned = 0; turned < 3 && own.number == shared::kNoPatch; ++turned) {
        const int most = along.x >= along.y && along.x >= along.z ? 0 : along.y >= along.z ? 1 : 2;
        axis = 2 * most + (n[most] >= 0.0f ? 0 : 1);
        along[most] = -1.0f;
        own = leaf_by_table(patches, cell0, axis);
    }
    if (own.number == shared::kNoPatch) return {};
    turn[axis / 2] = 0.0f;
    const ivec3 there = shared::patch_cell(lifted + turn * patches.level_cell_m(own.level), inverse);
    const ivec3 way = (there >> own.level) - (cell0 >> own.level) + 1;
    if (((patches.connected[own.number] >> (way.x + 3 * way.y + 9 * way.z)) & 1u) == 0u) return {own.number, own.number};
    Leaf other = leaf_by_table(patches, there, axis);
    if (other.number != shared::kNoPatch && other.level < own.level) {
        const ivec3 nearer = shared::patch_cell(lifted + turn * patches.level_cell_m(other.level), inverse);
        if ((nearer >> own.level) == (cell0 >> own.level)) return {own.number, own.number};
        other = leaf_by_table(patches, nearer, axis);
    }
    return {own.number, other.number == shared::kNoPatch ? own.number : other.number};
}

struct Point {
    vec3 x, n;
    std::uint32_t material;
};

// On the faces of the street, those far out less often.
std::vector<Point> points_of(const scene::Scene& scene, std::size_t count)
{
    std::vector<Point> points;
    const auto& parts = scene.meshes[0].primitives;
    for (std::uint32_t i = 0; points.size() < count; ++i) {
        const scene::Primitive& p = parts[shared::hash_u3(i, 1, 0) % parts.size()];
        const std::uint32_t t = shared::hash_u3(i, 2, 0) % static_cast<std::uint32_t>(p.indices.size() / 3);
        float u = shared::hash_f(shared::hash_u3(i, 3, 0)), v = shared::hash_f(shared::hash_u3(i, 4, 0));
        if (u + v > 1.0f) {
            u = 1.0f - u;
            v = 1.0f - v;
        }
        const vec3 a = p.positions[p.indices[3 * t]], b = p.positions[p.indices[3 * t + 1]], c = p.positions[p.indices[3 * t + 2]];
        const vec3 x = a + (b - a) * u + (c - a) * v;
        if (glm::length(x) > 12.0f && i % 7 != 0) continue;
        points.push_back({x, p.normals[p.indices[3 * t]], p.material});
    }
    return points;
}

TEST(PlaceTree, FindsWhatTheTableOfAllNodesHas)
{
    const Street& s = the_street();
    std::set<int> levels;
    std::size_t none = 0, apart = 0, finer = 0;
    std::uint32_t i = 0;
    for (const Point& p : points_of(s.scene, 60000)) {
        const vec3 turn = shared::place_turn({static_cast<int>(i), static_cast<int>(i / 7)}, i % 5);
        // Some points look past all surfaces, some along an edge.
        const vec3 n = i % 11 == 0 ? glm::normalize(p.n + 0.9f * turn) : p.n;
        const vec3 x = i % 23 == 0 ? p.x + vec3(0, 2, 0) : p.x;
        ++i;
        const Both expected = by_table(s.patches, x, n, turn);
        const shared::PlaceLeaves found = place_leaves(s.tree, x, n, turn);
        if (expected.own == shared::kNoPatch) {
            ASSERT_EQ(found.own, shared::kNoPlace) << i;
            ++none;
            continue;
        }
        ASSERT_EQ(shared::place_leaf_patch(found.own), expected.own) << i;
        ASSERT_EQ(shared::place_leaf_patch(found.other), expected.other) << i;
        levels.insert(shared::place_leaf_level(found.own));
        apart += expected.own != expected.other ? 1 : 0;
        ASSERT_EQ(found.other >> 16, s.patches.material[expected.other]) << i;
        finer += scene::level_of(s.patches.key[expected.other]) < shared::place_leaf_level(found.own) ? 1 : 0;
    }
    EXPECT_GE(levels.size(), 5u);
    EXPECT_GT(none, 300u);
    EXPECT_GT(apart, 10000u);
    EXPECT_GT(finer, 200u);
}

// A patch of most of its cell: what else lies in the cell has the weather of its own kind beside it, if there is one.
TEST(PlaceTree, FindsTheMaterialOfThePoint)
{
    const Street& s = the_street();
    std::size_t mended = 0, missed = 0;
    std::uint32_t i = 0;
    for (const Point& p : points_of(s.scene, 40000)) {
        const vec3 turn = shared::place_turn({static_cast<int>(i), 3}, i % 3);
        ++i;
        const Both both = by_table(s.patches, p.x, p.n, turn);
        if (both.own == shared::kNoPatch) continue;
        const shared::PlaceFound found = place_found(s.tree, p.x, p.n, turn, p.material);
        ASSERT_EQ(found.of_material, s.patches.material[found.number] == p.material);
        if (s.patches.material[both.other] == p.material) {
            ASSERT_EQ(found.number, both.other);
            continue;
        }
        if (s.patches.material[both.own] == p.material) {
            ASSERT_EQ(found.number, both.own);
            continue;
        }
        // A whole cell further, along the turn and across it.
        vec3 way = turn - p.n * glm::dot(turn, p.n);
        way /= std::max({std::abs(way.x), std::abs(way.y), std::abs(way.z)});
        bool there = false;
        for (int side = 0; side < 4; ++side) {
            const std::uint32_t other = by_table(s.patches, p.x, p.n, way).other;
            there = there || s.patches.material[other] == p.material;
            way = side == 1 ? glm::cross(p.n, way) : -way;
        }
        mended += found.of_material ? 1 : 0;
        missed += there && !found.of_material ? 1 : 0;
    }
    EXPECT_GT(mended, 1000u);
    EXPECT_LT(missed, mended / 100);
}

// Cells within a patch may have parts of their own; all others find what they found before.
TEST(PlaceTree, FindsThePartOfAPatch)
{
    const Street& s = the_street();
    const scene::Patches& p = s.patches;
    const shared::PatchGrid grid = scene::table_grid(p);
    std::vector<glm::uvec4> table = p.table;
    std::vector<std::uint32_t> materials = p.material;
    std::vector<PlaceParts> of(p.count);
    std::uint32_t first = 0;
    for (std::uint32_t i = 0; i < p.count; i += 3) {
        PlaceParts& parts = of[i];
        parts = {i, first, 2 + i % 3, {}};
        for (std::uint32_t k = 0; k < parts.of_cell.size(); ++k)
            parts.of_cell[k] = static_cast<std::uint8_t>((k % 8 + k / 8) * parts.count / 15);
        append_parts(table, parts);
        first += parts.count;
        for (std::uint32_t k = 0; k < parts.count; ++k) materials.push_back(p.material[i]);
    }
    ASSERT_EQ(parts_of(table, grid).size(), (p.count + 2) / 3);
    ASSERT_EQ(count_of_parts(parts_of(table, grid)), first);
    const PlaceTree tree = place_tree(grid, table, materials);
    ASSERT_EQ(tree.grid.patches, p.count + first);
    std::size_t within = 0, whole = 0, beside = 0;
    std::set<std::uint32_t> met;
    for (const Point& point : points_of(s.scene, 40000)) {
        const Both plain = by_table(p, point.x, point.n, vec3(0.0f));
        const shared::PlaceLeaves found = place_leaves(tree, point.x, point.n, vec3(0.0f));
        if (plain.own == shared::kNoPatch) {
            ASSERT_EQ(found.own, shared::kNoPlace);
            continue;
        }
        const std::uint32_t number = shared::place_leaf_patch(found.own);
        ASSERT_EQ(number, shared::place_leaf_patch(found.other));
        if (of[plain.own].count == 0) {
            ASSERT_EQ(number, plain.own);
            ++whole;
            continue;
        }
        // Where in its patch the point lies, and what stands there.
        const shared::PatchKey key = p.key[plain.own];
        const int axis = scene::axis_of(key), level = scene::level_of(key);
        const float edge = p.level_cell_m(level);
        const vec3 in_cells = ((point.x + point.n * (0.06f * p.cell_m)) + shared::kPatchGridShift * p.cell_m) / edge;
        const vec3 at = (in_cells - glm::floor(in_cells)) * 8.0f;
        const int u = static_cast<int>(at[(axis / 2 + 1) % 3]), v = static_cast<int>(at[(axis / 2 + 2) % 3]);
        if (std::abs(at[(axis / 2 + 1) % 3] - std::round(at[(axis / 2 + 1) % 3])) < 0.01f ||
            std::abs(at[(axis / 2 + 2) % 3] - std::round(at[(axis / 2 + 2) % 3])) < 0.01f)
            continue;
        const PlaceParts& parts = of[plain.own];
        ASSERT_EQ(number, p.count + parts.first + parts.of_cell[static_cast<std::size_t>(u + 8 * v)]);
        met.insert(number);
        ++within;
        // A turn stays within a cell of the part's own, and finds no patch that has parts.
        const vec3 turn = shared::place_turn({static_cast<int>(within), 5}, 1);
        const std::uint32_t other = shared::place_leaf_patch(place_leaves(tree, point.x, point.n, turn).other);
        ASSERT_TRUE(other >= p.count || of[other].count == 0);
        beside += other != number ? 1 : 0;
        ASSERT_EQ(place_found(tree, point.x, point.n, vec3(0.0f), p.material[plain.own]).of_material, true);
    }
    EXPECT_GT(whole, 10000u);
    EXPECT_GT(within, 5000u);
    EXPECT_GT(met.size(), 300u);
    EXPECT_GT(beside, 300u);
}

// What stands beside a patch in the table of texels spares a second search; it is what that search finds, where patches
// larger and smaller than the point's have parts too.
TEST(PlaceTree, ATurnFindsWhatASearchForItFinds)
{
    const Street& s = the_street();
    const scene::Patches& p = s.patches;
    std::vector<glm::uvec4> table = p.table;
    std::vector<std::uint32_t> materials = p.material;
    std::uint32_t first = 0;
    for (std::uint32_t i = 0; i < p.count; i += 2) {
        PlaceParts parts{i, first, 2, {}};
        for (std::uint32_t k = 0; k < parts.of_cell.size(); ++k) parts.of_cell[k] = (k % 8 + k / 8 + i) % 5 < 2 ? 1 : 0;
        append_parts(table, parts);
        first += parts.count;
        materials.insert(materials.end(), parts.count, p.material[i]);
    }
    const PlaceTree tree = place_tree(scene::table_grid(p), table, materials);
    shared::TreeLookup look{tree};
    std::size_t apart = 0, coarser = 0, finer = 0;
    std::uint32_t i = 0;
    for (const Point& point : points_of(s.scene, 60000)) {
        const vec3 turn = shared::place_turn({static_cast<int>(i), static_cast<int>(i / 5)}, i % 7);
        ++i;
        const shared::PlaceLeaves found = place_leaves(tree, point.x, point.n, turn);
        const shared::PlaceOwn own = look.place_own(tree.grid, point.x, point.n);
        ASSERT_EQ(found.own, own.leaf);
        if (own.leaf == shared::kNoPlace) continue;
        vec3 along = turn * shared::place_edge_m(tree.grid);
        along[own.axis / 2] = 0.0f;
        const vec3 lifted = look.place_lifted(tree.grid, point.x, point.n);
        const ivec3 cell0 = shared::place_cell(tree.grid, lifted);
        const int up = shared::place_leaf_level(own.leaf);
        // The leaf at the point moved by so wide a turn, the own one where that stays in its cell or is not seen.
        const auto turned = [&](int level) {
            const ivec3 there = shared::place_cell(tree.grid, lifted + along * static_cast<float>(1 << level));
            const ivec3 step = (there >> up) - (cell0 >> up);
            const int next = step[(own.axis / 2 + 1) % 3], behind = step[(own.axis / 2 + 2) % 3];
            if (next == 0 && behind == 0) return own.leaf;
            if (level == up && !shared::place_leaf_sees(own.leaf, shared::place_way(next, behind))) return own.leaf;
            const std::uint32_t leaf = look.place_leaf(tree.grid, there, own.axis);
            return leaf == shared::kNoPlace ? own.leaf : leaf;
        };
        std::uint32_t other = turned(up);
        const int level = shared::place_leaf_level(other);
        if (level < up) other = turned(level);
        const std::uint32_t patch = shared::place_leaf_patch(other);
        ASSERT_EQ(found.other, patch | materials[patch] << 16) << i;
        ASSERT_EQ(found.own_material, materials[shared::place_leaf_patch(own.leaf)]) << i;
        apart += patch != shared::place_leaf_patch(own.leaf) ? 1 : 0;
        coarser += level > up ? 1 : 0;
        finer += level < up ? 1 : 0;
    }
    EXPECT_GT(apart, 10000u);
    EXPECT_GT(coarser, 300u);
    EXPECT_GT(finer, 300u);
}

TEST(PlaceTree, WithoutPatchesNothingIsFound)
{
    const PlaceTree none = place_tree({}, {}, {});
    EXPECT_EQ(none.grid.levels, 0u);
    ASSERT_FALSE(none.words.empty());
    EXPECT_EQ(place_found(none, vec3(1.0f), {0, 1, 0}, vec3(0.1f), 0).number, shared::kNoPatch);
}

}  // namespace
}  // namespace petrichor::gpu
