#include "scene/patches/patches.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"
#include "scene/patches/detail/cells.h"
#include "scene/patches/detail/links.h"
#include "scene/patches/detail/nodes.h"
#include "scene/patches/detail/sampling.h"
#include "scene/patches/visible_way.h"

namespace petrichor::scene {
namespace {

constexpr float kCell_m = 0.35f;
constexpr float kCellsAcross = 48.0f;
constexpr float kCoarsestAcross = 20.0f;
constexpr float kSlopesAcross = 128.0f;
constexpr float kSlope_m = 4.0f;
constexpr int kBackdropLevels = 3;  // coarser ones for open ground around a scene
constexpr float kSmallest_m = 1e-4f;

void check(const PatchOptions& options)
{
    const auto refuse = [](const std::string& what, const std::string& fix) {
        throw Error("patches: " + what, fix);
    };
    if (!(options.cell_m == 0.0f || (options.cell_m >= kSmallest_m && options.cell_m <= 1e5f))) {
        refuse("cell_m must be 0 or 0.0001 to 100000, got " + std::to_string(options.cell_m),
               "Use 0 to let the scene decide.");
    }
    if (options.rays < 16 || options.rays > 1024) {
        refuse("rays must be 16 to 1024, got " + std::to_string(options.rays), "Use 128.");
    }
    if (options.max_patches < 1 || options.max_patches > kMostPatches) {
        refuse("max_patches must be 1 to " + std::to_string(kMostPatches) + ", got " +
                   std::to_string(options.max_patches),
               "Use " + std::to_string(kMostPatches) + ".");
    }
}

float longest_side_m(const Triangles& triangles)
{
    const glm::vec3 d = triangles.high() - triangles.low();
    return std::max({d.x, d.y, d.z});
}

// The finest regular cell that a scene starts with.
float first_cell_m(const Triangles& triangles, const PatchOptions& options)
{
    float cell = options.cell_m;
    const float longest = longest_side_m(triangles);
    if (cell == 0.0f) {
        cell = kCell_m;
        // A model that stands on ground of ours meets it all along its foot.
        const float across = triangles.backdrop() ? 0.5f * kCellsAcross : kCellsAcross;
        while (cell * across > longest && cell > kSmallest_m) cell *= 0.5f;
    }
    // Numbers of cells fit their bits.
    while (2.0f * triangles.farthest_m() / cell > static_cast<float>(shared::kPatchCellBias) * 0.99f) cell *= 2.0f;
    return cell;
}

CellPlan plan_of(float regular_cell_m, const Triangles& triangles, const PatchOptions& options)
{
    CellPlan plan;
    plan.cell_m = 0.5f * regular_cell_m;
    plan.most = options.max_patches;
    plan.levels = 2;
    const float coarsest = longest_side_m(triangles) / kCoarsestAcross;
    while (plan.levels < shared::kPatchLevels &&
           plan.cell_m * static_cast<float>(1 << (plan.levels - 1)) < coarsest)
        ++plan.levels;
    plan.content_levels = plan.levels;
    plan.slope_m = std::max(kSlope_m, longest_side_m(triangles) / kSlopesAcross);
    if (triangles.backdrop())
        plan.levels = std::min(plan.levels + kBackdropLevels, shared::kPatchLevels);
    return plan;
}

std::uint32_t most_common_material(const Triangles& triangles, const Cell& cell)
{
    std::array<std::uint32_t, kPatchSamples> materials;
    for (int k = 0; k < cell.points; ++k)
        materials[static_cast<std::size_t>(k)] =
            triangles.material(cell.samples[static_cast<std::size_t>(k)].triangle);
    std::sort(materials.begin(), materials.begin() + cell.points);
    std::uint32_t best = materials[0];
    int most = 0;
    for (int k = 0, first = 0; k < cell.points; ++k) {
        if (materials[static_cast<std::size_t>(k)] != materials[static_cast<std::size_t>(first)])
            first = k;
        if (k - first + 1 > most) {
            most = k - first + 1;
            best = materials[static_cast<std::size_t>(k)];
        }
    }
    return best;
}

bool before(const shared::PatchKey& a, const shared::PatchKey& b)
{
    return whole_key(a) < whole_key(b);
}

void report(const PatchOptions& options, std::string_view what, float share)
{
    if (options.stop && options.stop())
        throw Interrupted("interrupted while the scene's light was traced");
    if (options.progress) options.progress(what, share);
}

Patches assemble(std::vector<Cell>& cells, const Triangles& triangles, const CellPlan& plan,
                 const PatchOptions& options)
{
    std::vector<const Cell*> leaves, interior;
    for (const Cell& cell : cells) {
        if (cell.state == CellState::Leaf) leaves.push_back(&cell);
        if (cell.state == CellState::Split) interior.push_back(&cell);
    }
    const auto by_key = [](const Cell* a, const Cell* b) { return before(a->key, b->key); };
    std::sort(leaves.begin(), leaves.end(), by_key);
    std::sort(interior.begin(), interior.end(), by_key);

    Patches patches;
    patches.cell_m = plan.cell_m;
    patches.levels = plan.levels;
    patches.rays = options.rays;
    patches.seed = options.seed;
    patches.count = static_cast<std::uint32_t>(leaves.size());
    patches.interior = static_cast<std::uint32_t>(interior.size());
    const std::size_t nodes = patches.nodes();
    patches.position_m.resize(nodes);
    patches.normal.resize(nodes);
    patches.area_m2.resize(nodes);
    patches.connected.assign(nodes, 0);
    patches.open.assign(nodes, 0.0f);
    for (const auto* list : {&leaves, &interior}) {
        for (const Cell* cell : *list) patches.key.push_back(cell->key);
    }
    patches.samples.reserve(std::size_t{patches.count} * kPatchSamples);
    for (std::uint32_t i = 0; i < patches.count; ++i) {
        const Cell& cell = *leaves[i];
        patches.position_m[i] = cell.position_m;
        patches.normal[i] = cell.normal;
        patches.area_m2[i] = cell.area_m2;
        patches.material.push_back(most_common_material(triangles, cell));
        for (int k = 0; k < kPatchSamples; ++k)
            patches.samples.push_back(cell.samples[static_cast<std::size_t>(k % cell.points)]);
    }
    index_nodes(patches);
    average_interior(patches);
    return patches;
}

}  // namespace

Patches build_patches(const Tracer& tracer, const PatchOptions& options)
{
    check(options);
    const Triangles& triangles = tracer.triangles();
    Patches patches;
    if (triangles.size() == 0) {
        patches.rays = options.rays;
        patches.seed = options.seed;
        index_nodes(patches);
        return patches;
    }
    float cell = first_cell_m(triangles, options);
    for (;;) {
        report(options, "patches", 0.0f);
        const CellPlan plan = plan_of(cell, triangles, options);
        GrownCells grown = grow_cells(tracer, plan, options);
        if (grown.fit) {
            patches = assemble(grown.cells, triangles, plan, options);
            break;
        }
        // Too many at a coarse level already: far too fine.
        cell *= grown.level > 3 ? 4.0f : grown.level > 1 ? 2.0f : 1.4f;
    }
    report(options, "links", 0.0f);
    trace_links(patches, tracer, options);
    report(options, "connections", 0.0f);
    connect(patches, tracer, options);
    for (glm::uvec4& slot : patches.table) {
        if (slot.z != Patches::kNoNode) slot.w = patches.connected[slot.z];
    }
    report(options, "visibility", 0.0f);
    trace_visibility(patches, tracer, options);
    if (options.progress) options.progress("visibility", 1.0f);
    return patches;
}

std::uint32_t find_node(const Patches& patches, shared::PatchKey key)
{
    const std::size_t mask = patches.table.size() - 1;
    for (std::size_t i = shared::patch_key_hash(key) & mask;; i = (i + 1) & mask) {
        const glm::uvec4& slot = patches.table[i];
        if (slot.z == Patches::kNoNode) return Patches::kNoNode;
        if (slot.x == key.low && slot.y == key.high) return slot.z;
    }
}

namespace {

// From the coarsest cell down to the leaf; all cells above a node exist.
std::uint32_t leaf_of(const Patches& patches, glm::ivec3 cell0, int axis)
{
    int level = patches.levels - 1;
    std::uint32_t node = find_node(patches, key_of(cell0, axis, level));
    while (node != Patches::kNoNode && node >= patches.count) {
        if (--level < 0) return Patches::kNoNode;
        node = patches.octants[std::size_t{node - patches.count} * 8 + octant_of(cell0, level)];
    }
    return node;
}

// The leaf of a cell, of any axis, that faces most as `normal` does.
std::uint32_t any_leaf_of(const Patches& patches, glm::ivec3 cell0, glm::vec3 normal, float& best)
{
    std::uint32_t found = Patches::kNoNode;
    for (int axis = 0; axis < 6; ++axis) {
        const std::uint32_t leaf = leaf_of(patches, cell0, axis);
        if (leaf == Patches::kNoNode) continue;
        const float facing = glm::dot(patches.normal[leaf], normal);
        if (facing > best) {
            best = facing;
            found = leaf;
        }
    }
    return found;
}

}  // namespace

std::optional<std::uint32_t> patch_at(const Patches& patches, glm::vec3 position, glm::vec3 normal)
{
    if (patches.empty()) return std::nullopt;
    const glm::ivec3 cell0 = cell_of(position, patches.cell_m);
    const std::uint32_t leaf = leaf_of(patches, cell0, shared::patch_axis(normal));
    if (leaf != Patches::kNoNode) return leaf;
    float facing = 0.0f;
    const std::uint32_t other = any_leaf_of(patches, cell0, normal, facing);
    if (other != Patches::kNoNode) return other;
    // The nearest of the cells around that does not face away; wider and wider.
    for (int level = 0; level < std::min(patches.levels, 4); ++level) {
        std::uint32_t nearest = Patches::kNoNode;
        float least = std::numeric_limits<float>::max();
        for (int n = 0; n < 27; ++n) {
            const glm::ivec3 step{n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
            const glm::ivec3 there = cell0 + step * (1 << level);
            float good = 0.0f;
            const std::uint32_t found = any_leaf_of(patches, there, normal, good);
            if (found == Patches::kNoNode) continue;
            const glm::vec3 way = patches.position_m[found] - position;
            const float distance2 = glm::dot(way, way);
            if (distance2 < least) {
                least = distance2;
                nearest = found;
            }
        }
        if (nearest != Patches::kNoNode) return nearest;
    }
    return std::nullopt;
}

float visible_share(const Patches& patches, std::uint32_t patch, glm::vec3 direction)
{
    return visible_share(patches.visible[patch], direction);
}

float visible_share(const std::array<std::uint32_t, 8>& bits, glm::vec3 direction)
{
    return VisibleWay(direction).share(bits);
}

VisibleWay::VisibleWay(glm::vec3 direction)
{
    if (!(direction.y > 0.0f)) return;
    const glm::vec2 at = shared::visibility_texel(direction) - 0.5f;
    const glm::vec2 corner = glm::floor(at);
    const glm::vec2 part = at - corner;
    for (int k = 0; k < 4; ++k) {
        const int x = std::clamp(static_cast<int>(corner.x) + (k & 1), 0, shared::kVisibilityAcross - 1);
        const int y = std::clamp(static_cast<int>(corner.y) + (k >> 1), 0, shared::kVisibilityAcross - 1);
        const auto of = static_cast<std::size_t>(k);
        bit_[of] = static_cast<std::uint32_t>(y * shared::kVisibilityAcross + x);
        weight_[of] = ((k & 1) ? part.x : 1.0f - part.x) * ((k >> 1) ? part.y : 1.0f - part.y);
    }
}

float rain_exposure(const Patches& patches, std::uint32_t patch, glm::vec3 drop_velocity_m_s)
{
    if (!(drop_velocity_m_s.y < 0.0f)) return 0.0f;
    const glm::vec3 from =
        -drop_velocity_m_s / std::sqrt(glm::dot(drop_velocity_m_s, drop_velocity_m_s));
    const float facing = std::max(glm::dot(patches.normal[patch], from), 0.0f);
    return visible_share(patches, patch, from) * facing / from.y;
}

std::vector<glm::vec4> with_interior(const Patches& patches, const std::vector<glm::vec4>& leaves)
{
    std::vector<glm::vec4> values = leaves;
    values.resize(patches.nodes(), glm::vec4(0.0f));
    for (std::uint32_t i = 0; i < patches.interior; ++i) {
        glm::vec4 sum(0.0f);
        float area = 0.0f;
        for (std::uint32_t c = patches.children_first[i]; c < patches.children_first[i + 1]; ++c) {
            const std::uint32_t child = patches.children[c];
            sum += values[child] * patches.area_m2[child];
            area += patches.area_m2[child];
        }
        values[patches.count + i] = area > 0.0f ? sum / area : sum;
    }
    return values;
}

SamplePoint sample_point(const Triangles& triangles, const PatchSample& sample)
{
    const glm::vec3 n = triangles.normal(sample.triangle);
    return {triangles.point(sample.triangle, sample.at), sample.back ? -n : n};
}

}  // namespace petrichor::scene
