#include "gpu/place/place_tree.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <unordered_set>

#include "gpu/place/place_parts.h"

namespace petrichor::shared {
namespace {

using namespace petrichor::shared_names;

// The tables behind the shared text.
struct PlaceLookup {
    std::span<const std::uint32_t> words;
    std::span<const glm::uvec4> texels;

    uint place_word(uint index) const { return words[index]; }
    uvec4 place_texel(uint index) const { return texels[index]; }

#include "formulas/light/place_lookup.inc"
};

}  // namespace
}  // namespace petrichor::shared

namespace petrichor::gpu {
namespace {

using shared::kNoPlace;
using shared::kPlaceAsk;
using shared::kPlaceCut;
using shared::kPlaceTexels;

// Levels have four bits in a leaf.
constexpr std::uint32_t kMostLevels = 16;

// Of all six axes. More levels of roots would save a step of those below them.
constexpr std::int64_t kMostRoots = 1 << 17;

struct Leaf {
    glm::ivec3 cell;  // counted in its own level
    int level;
    int axis;
    std::uint32_t patch;
    std::uint32_t connected;  // 27 bits
};

int along_of(int axis) { return (axis / 2 + 1) % 3; }
int across_of(int axis) { return (axis / 2 + 2) % 3; }

glm::ivec3 step_of(int axis, int along, int across)
{
    glm::ivec3 step(0);
    step[along_of(axis)] = along;
    step[across_of(axis)] = across;
    return step;
}

bool sees(const Leaf& leaf, const glm::ivec3& step)
{
    const glm::ivec3 way = step + 1;
    return ((leaf.connected >> (way.x + 3 * way.y + 9 * way.z)) & 1u) != 0;
}

std::uint32_t word_of(const Leaf& leaf)
{
    std::uint32_t word = leaf.patch | static_cast<std::uint32_t>(leaf.level) << 16;
    for (int way = 0; way < 9; ++way) {
        if (sees(leaf, step_of(leaf.axis, way % 3 - 1, way / 3 - 1))) word |= 1u << (20 + way);
    }
    return word;
}

// finer: levels of the tree below those of the patches.
std::vector<Leaf> leaves_of(const shared::PatchGrid& grid, std::span<const glm::uvec4> table, int finer)
{
    std::vector<Leaf> leaves;
    for (const glm::uvec4& entry : table.first(std::size_t{grid.table_mask} + 1)) {
        if (entry.z >= grid.patches) continue;
        const auto x = static_cast<int>(entry.x & 0x7ffffu);
        const auto y = static_cast<int>(entry.x >> 19 | (entry.y & 63u) << 13);
        const auto z = static_cast<int>(entry.y >> 6 & 0x7ffffu);
        leaves.push_back({{x, y, z},
                          static_cast<int>(entry.y >> 28) + finer,
                          static_cast<int>(entry.y >> 25 & 7u),
                          entry.z,
                          entry.w});
    }
    return leaves;
}

// The leaves of a patch's parts: squares of one part each, through all of its cell along its axis. A leaf within the patch is
// connected to all of it, at its border as the patch is.
void add_parts(std::vector<Leaf>& leaves, const Leaf& whole, const PlaceParts& parts, std::uint32_t first)
{
    const int finest = whole.level - kPartLevels;
    const auto part_at = [&](int u, int v) { return parts.of_cell[static_cast<std::size_t>(u + v * kPartCells)]; };
    const auto add_square = [&](const auto& self, int u, int v, int side, int level) -> void {
        bool same = true;
        for (int k = 0; k < side * side; ++k) same = same && part_at(u + k % side, v + k / side) == part_at(u, v);
        if (!same) {
            const int half = side / 2;
            for (int k = 0; k < 4; ++k) self(self, u + k % 2 * half, v + k / 2 * half, half, level - 1);
            return;
        }
        Leaf leaf = whole;
        leaf.level = level;
        leaf.patch = first + part_at(u, v);
        leaf.connected = 0;
        for (int way = 0; way < 9; ++way) {
            const int along = way % 3 - 1, across = way / 3 - 1;
            const auto out = [&](int at, int step) { return at + step * side < 0 ? -1 : at + step * side >= kPartCells ? 1 : 0; };
            if (sees(whole, step_of(whole.axis, out(u, along), out(v, across)))) {
                const glm::ivec3 bit = step_of(whole.axis, along, across) + 1;
                leaf.connected |= 1u << (bit.x + 3 * bit.y + 9 * bit.z);
            }
        }
        leaf.cell = whole.cell << (whole.level - level);
        leaf.cell[along_of(whole.axis)] += u / side;
        leaf.cell[across_of(whole.axis)] += v / side;
        for (int layer = 0; layer < kPartCells / side; ++layer) {
            leaves.push_back(leaf);
            ++leaf.cell[whole.axis / 2];
        }
    };
    add_square(add_square, 0, 0, kPartCells, finest + kPartLevels);
}

// The finest level of roots whose box is not too large.
struct Roots {
    int level = 0;
    glm::ivec3 first{0}, across{0};

    Roots(std::span<const Leaf> leaves, int finer) : level(finer)
    {
        glm::ivec3 low(std::numeric_limits<int>::max()), high(0);
        for (const Leaf& leaf : leaves) {
            low = glm::min(low, leaf.cell << leaf.level);
            high = glm::max(high, (leaf.cell << leaf.level) + ((1 << leaf.level) - 1));
        }
        for (bool fits = false; !fits; level += fits ? 0 : 1) {
            first = low >> level;
            across = (high >> level) - first + 1;
            fits = std::max({across.x, across.y, across.z}) <= shared::kMostRootsAcross &&
                   std::int64_t{6} * across.x * across.y * across.z <= kMostRoots;
        }
    }
};

// Writes a word for all cells of `side` across from a place in a box of words.
void fill(std::vector<std::uint32_t>& words, std::size_t first, const glm::ivec3& across, const glm::ivec3& at, int side,
          std::uint32_t word)
{
    for (int z = at.z; z < at.z + side; ++z) {
        for (int y = at.y; y < at.y + side; ++y) {
            const auto row = first + (static_cast<std::size_t>(z) * static_cast<std::size_t>(across.y) + static_cast<std::size_t>(y)) *
                                         static_cast<std::size_t>(across.x);
            std::fill_n(words.begin() + static_cast<std::ptrdiff_t>(row) + at.x, side, word);
        }
    }
}

void add_leaf(std::vector<std::uint32_t>& words, const Roots& box, const Leaf& leaf)
{
    int level = box.level;
    glm::ivec3 across = box.across;
    const int over = std::max(leaf.level - level, 0);
    glm::ivec3 at = leaf.level >= level ? (leaf.cell << over) - box.first : (leaf.cell >> (level - leaf.level)) - box.first;
    std::size_t first = static_cast<std::size_t>(leaf.axis) * static_cast<std::size_t>(across.x) *
                                    static_cast<std::size_t>(across.y) * static_cast<std::size_t>(across.z);
    while (leaf.level < level) {
        const int down = std::min(level, 2);
        const auto index = first + (static_cast<std::size_t>(at.z) * static_cast<std::size_t>(across.y) + static_cast<std::size_t>(at.y)) *
                                       static_cast<std::size_t>(across.x) + static_cast<std::size_t>(at.x);
        if (words[index] == kNoPlace) {
            words[index] = kPlaceCut | static_cast<std::uint32_t>(words.size());
            words.insert(words.end(), std::size_t{1} << (3 * down), kNoPlace);
        }
        first = words[index] & ~kPlaceCut;
        level -= down;
        across = glm::ivec3(1 << down);
        const glm::ivec3 cell = leaf.level >= level ? leaf.cell << (leaf.level - level) : leaf.cell >> (level - leaf.level);
        at = cell & ((1 << down) - 1);
    }
    fill(words, first, across, at, 1 << (leaf.level - level), word_of(leaf));
}

// Patches of other materials in a cell beside a leaf, next to it.
void add_beside(std::vector<std::uint32_t>& found, shared::PlaceLookup lookup, const shared::PatchGrid& grid, const Leaf& leaf,
                const glm::ivec3& step, std::span<const std::uint32_t> materials)
{
    if (!sees(leaf, step)) return;
    const int side = 1 << leaf.level;
    const int parts = std::min(side, 4);
    for (int k = 0; k < parts * parts; ++k) {
        glm::ivec3 at = leaf.cell << leaf.level;
        for (int d = 0; d < 3; ++d) {
            const int part = d == leaf.axis / 2 ? k % parts : k / parts;
            at[d] += step[d] > 0 ? side : step[d] < 0 ? -1 : (2 * part + 1) * side / (2 * parts);
        }
        const std::uint32_t there = lookup.place_leaf(grid, at, leaf.axis);
        if (there == kNoPlace) continue;
        const std::uint32_t patch = shared::place_leaf_patch(there);
        const bool known = std::find(found.begin(), found.end(), patch) != found.end();
        if (!known && materials[patch] != materials[leaf.patch]) found.push_back(patch);
    }
}

// One patch for each side of a leaf, straight over it rather than over its corners; as many materials as there are.
std::array<std::uint32_t, 4> sides_of(const shared::PlaceLookup& lookup, const shared::PatchGrid& grid, const Leaf& leaf,
                                      std::span<const std::uint32_t> materials)
{
    constexpr std::array<glm::ivec2, 4> kSides{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
    std::array<std::vector<std::uint32_t>, 4> found;
    for (std::size_t side = 0; side < 4; ++side) {
        const glm::ivec2 s = kSides[side];
        for (const int corner : {0, 1, -1}) {
            const glm::ivec2 way = s + corner * glm::ivec2(s.y, s.x);
            add_beside(found[side], lookup, grid, leaf, step_of(leaf.axis, way.x, way.y), materials);
        }
    }
    std::array<std::uint32_t, 4> taken;
    taken.fill(leaf.patch);
    std::vector<std::uint32_t> known{materials[leaf.patch]};
    const auto take_new = [&](std::size_t side, std::span<const std::uint32_t> of) {
        for (const std::uint32_t patch : of) {
            if (std::find(known.begin(), known.end(), materials[patch]) != known.end()) continue;
            taken[side] = patch;
            known.push_back(materials[patch]);
            return;
        }
    };
    for (std::size_t side = 0; side < 4; ++side) take_new(side, found[side]);
    for (std::size_t side = 0; side < 4; ++side) {
        for (std::size_t other = 0; other < 4 && taken[side] == leaf.patch; ++other) take_new(side, found[other]);
        if (taken[side] == leaf.patch && !found[side].empty()) taken[side] = found[side].front();
    }
    return taken;
}

void put_sides(PlaceTree& tree, const Leaf& leaf, std::span<const std::uint32_t> materials)
{
    const std::array<std::uint32_t, 4> sides = sides_of({tree.words, {}}, tree.grid, leaf, materials);
    glm::uvec4& texel = tree.texels[std::size_t{leaf.patch} * kPlaceTexels];
    for (int side = 0; side < 4; ++side) {
        const std::uint32_t patch = sides[static_cast<std::size_t>(side)];
        texel[side] = patch | materials[patch] << 16;
    }
}

// Cells that are cut into finer ones.
class CutCells {
public:
    // Cells around a leaf, itself where it has parts.
    void add(const Leaf& leaf, bool parted)
    {
        glm::ivec3 cell = leaf.cell;
        int level = leaf.level;
        if (!parted) {
            cell >>= 1;
            ++level;
        }
        for (; level < static_cast<int>(kMostLevels) && cut_.insert(number_of(cell, level, leaf.axis)).second; ++level) cell >>= 1;
    }
    bool holds(const glm::ivec3& cell, int level, int axis) const { return cut_.contains(number_of(cell, level, axis)); }

private:
    static std::uint64_t number_of(const glm::ivec3& cell, int level, int axis)
    {
        const shared::PatchKey key = shared::patch_key(cell, axis, level);
        return std::uint64_t{key.high} << 32 | key.low;
    }
    std::unordered_set<std::uint64_t> cut_;
};

// What a turn finds of a whole patch in the cell of its own level that lies a step away; none where that one is cut finer.
std::optional<std::uint32_t> found_by_turn(const PlaceTree& tree, const Leaf& leaf, const glm::ivec3& step, const CutCells& cut)
{
    if (!sees(leaf, step)) return leaf.patch;
    const glm::ivec3 cell = leaf.cell + step;
    if (cut.holds(cell, leaf.level, leaf.axis)) return {};
    const std::uint32_t there = shared::PlaceLookup{tree.words, {}}.place_leaf(tree.grid, cell << leaf.level, leaf.axis);
    if (there == kNoPlace) return leaf.patch;
    // Within the parts of a larger one.
    if (shared::place_leaf_level(there) < leaf.level) return {};
    return shared::place_leaf_patch(there);
}

// Of a part all is asked but itself.
void put_ways(PlaceTree& tree, const Leaf& leaf, bool part, const CutCells& cut, std::span<const std::uint32_t> materials)
{
    const auto put = [&](int behind, int next, std::optional<std::uint32_t> patch) {
        tree.texels[std::size_t{leaf.patch} * kPlaceTexels + static_cast<std::size_t>(2 + behind)][1 + next] =
            patch ? *patch | materials[*patch] << 16 : kPlaceAsk;
    };
    for (int behind = -1; behind <= 1; ++behind) {
        put(behind, 2, leaf.patch);
        for (int next = -1; next <= 1; ++next) {
            const glm::ivec3 step = step_of(leaf.axis, next, behind);
            std::optional<std::uint32_t> patch = leaf.patch;
            if (step != glm::ivec3(0)) patch = part ? std::nullopt : found_by_turn(tree, leaf, step, cut);
            put(behind, next, patch);
        }
    }
}

}  // namespace

PlaceTree place_tree(const shared::PatchGrid& grid, std::span<const glm::uvec4> table,
                     std::span<const std::uint32_t> materials)
{
    PlaceTree tree;
    const bool deep = grid.levels + std::uint32_t{kPartLevels} > kMostLevels;
    const std::vector<PlaceParts> parted = grid.levels > 0 && !deep ? parts_of(table, grid) : std::vector<PlaceParts>{};
    const int finer = parted.empty() ? 0 : kPartLevels;
    const std::vector<Leaf> wholes = grid.levels > 0 ? leaves_of(grid, table, finer) : std::vector<Leaf>{};
    if (wholes.empty()) {
        tree.words.assign(1, kNoPlace);
        tree.texels.assign(kPlaceTexels, glm::uvec4(0));
        return tree;
    }
    std::vector<const PlaceParts*> parts(grid.patches, nullptr);
    for (const PlaceParts& one : parted) parts[one.patch] = &one;
    std::vector<Leaf> leaves;
    for (const Leaf& whole : wholes) {
        const PlaceParts* of = parts[whole.patch];
        if (of == nullptr) {
            leaves.push_back(whole);
        } else {
            add_parts(leaves, whole, *of, grid.patches + of->first);
        }
    }
    const Roots box(leaves, finer);
    const shared::PatchKey first = shared::patch_key(box.first, 0, 0);
    tree.grid = {grid.cell_m,
                 static_cast<std::uint32_t>(box.level + 1) | static_cast<std::uint32_t>(box.across.x) << 5 |
                     static_cast<std::uint32_t>(box.across.y) << 14 | static_cast<std::uint32_t>(box.across.z) << 23,
                 static_cast<std::uint32_t>(materials.size()), first.low,
                 first.high | static_cast<std::uint32_t>(finer) << 25};
    tree.words.assign(std::size_t{6} * static_cast<std::size_t>(box.across.x) * static_cast<std::size_t>(box.across.y) *
                          static_cast<std::size_t>(box.across.z),
                      kNoPlace);
    tree.texels.assign(std::size_t{tree.grid.patches} * kPlaceTexels, glm::uvec4(0));
    for (const Leaf& leaf : leaves) add_leaf(tree.words, box, leaf);
    CutCells cut;
    for (const Leaf& whole : wholes) cut.add(whole, parts[whole.patch] != nullptr);
    for (const Leaf& whole : wholes) {
        const auto put = [&](const Leaf& leaf, bool part) {
            put_sides(tree, leaf, materials);
            put_ways(tree, leaf, part, cut, materials);
        };
        put(whole, false);
        const PlaceParts* of = parts[whole.patch];
        for (std::uint32_t k = 0; of != nullptr && k < of->count; ++k) {
            Leaf part = whole;
            part.patch = grid.patches + of->first + k;
            put(part, true);
        }
    }
    return tree;
}

shared::PlaceFound place_found(const PlaceTree& tree, glm::vec3 x, glm::vec3 n, glm::vec3 turn, std::uint32_t material)
{
    return shared::PlaceLookup{tree.words, tree.texels}.place_found(tree.grid, x, n, turn, material);
}

shared::PlaceLeaves place_leaves(const PlaceTree& tree, glm::vec3 x, glm::vec3 n, glm::vec3 turn)
{
    return shared::PlaceLookup{tree.words, tree.texels}.place_leaves(tree.grid, x, n, turn);
}

}  // namespace petrichor::gpu
