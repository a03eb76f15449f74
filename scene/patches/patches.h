#ifndef PETRICHOR_SCENE_PATCHES_PATCHES_H
#define PETRICHOR_SCENE_PATCHES_PATCHES_H

#include <array>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "base/interrupted.h"
#include "formulas/light/patch_cells.h"
#include "scene/patches/tracer.h"
#include "scene/patches/triangles.h"

namespace petrichor::scene {

/// Points of its surface that a patch keeps.
inline constexpr int kPatchSamples = 16;
/// Patches, sky bins and black share the numbers of 16 bits.
inline constexpr std::uint32_t kMostPatches = 65536 - 1025;

/// A point on a triangle.
struct PatchSample {
    std::uint32_t triangle = 0;
    Barycentric at;
    bool back = false;  ///< on the back of a double-sided triangle
};

/// How far the work is: its name and 0..1.
using PatchProgress = std::function<void(std::string_view, float)>;

struct PatchOptions {
    /// Edge of the finest regular cell, metres; patches that a wall parts get half of it. 0: 0.35,
    /// halved until the scene is 48 cells wide (24 on ground of ours), and coarser when there would be more patches than
    /// max_patches.
    float cell_m = 0.0f;
    int rays = 128;  ///< links a patch, 16..1024
    bool split_by_sight = true;
    std::uint32_t max_patches = kMostPatches;  ///< 1..kMostPatches
    std::uint32_t seed = 1;
    int threads = 0;  ///< 0: all cores; the result is the same for any number
    PatchProgress progress;
    StopRequest stop;
};

/// A scene's surfaces cut into patches, and what rays found between them: how patches see each
/// other and the sky. Weather, light and albedo are not in it.
///
/// Cells of a grid, by the axis that their surface faces, in levels: cell(level) = cell(0) * 2^level
/// metres. Cells are split by what is near them, cells of landscapes by their slopes too. A leaf is a patch; a cell that was split is an interior node, kept for lookups. Leaves
/// come first, in the order of their keys, then interior nodes, in the order of theirs.
/// All arrays of leaves have `count` entries, those of nodes `count + interior`.
struct Patches {
    float cell_m = 0.0f;      ///< edge of a cell of level 0, the finest
    int levels = 0;           ///< levels in use; the coarsest is levels - 1
    int rays = 0;             ///< links of each patch
    std::uint32_t seed = 0;   ///< of all draws
    std::uint32_t count = 0;  ///< patches
    std::uint32_t interior = 0;

    // Of nodes.
    std::vector<shared::PatchKey> key;
    std::vector<glm::vec3> position_m;  ///< mean of the surface in the cell
    std::vector<glm::vec3> normal;      ///< mean, unit, towards the side that is seen
    std::vector<float> area_m2;
    std::vector<std::uint32_t> connected;  ///< 27 bits: neighbour cell in sight, x fastest, then y
    std::vector<float> open;  ///< share of links longer than the radius of screen occlusion, 0.5 m at most
    // Interior nodes: children_first[i] .. children_first[i + 1] of children, numbers of nodes;
    // i = node - count.
    std::vector<std::uint32_t> children_first;
    std::vector<std::uint32_t> children;
    /// Eight an interior node: the child in each octant of its cell, x fastest; kNoNode where there is none.
    std::vector<std::uint32_t> octants;

    // Of leaves.
    std::vector<std::uint32_t> material;  ///< of most of its samples, index into Scene::materials
    std::vector<float> sky_view;  ///< cosine-weighted share of sky above the horizon, 0..1
    /// rays entries a patch. Each stands for 1 / rays of all light that arrives: the number of a
    /// patch, count + bin of the sky (shared::sky_bin, the whole sphere), or black() (nothing: all
    /// rays of the patch start inside a body).
    /// Form factors: F_ij = how often j is in row i / rays; each row adds up to 1 exactly.
    std::vector<std::uint16_t> links;
    /// A byte for eight rays of a patch, rows of whole bytes: those that were drawn more than once. Known as long as the
    /// patches are those that were traced, not read from a file; empty then.
    std::vector<std::uint8_t> redrawn;
    /// 256 bits: a ray in the direction of shared::visibility_raw_direction(bit) leaves the scene.
    std::vector<std::array<std::uint32_t, 8>> visible;
    std::vector<PatchSample> samples;  ///< kPatchSamples a patch

    /// Open addressing, a power of two, at most half full, linear probing from
    /// shared::patch_key_hash modulo its size. x, y: key; z: node, kNoNode where free; w: connected.
    std::vector<glm::uvec4> table;
    static constexpr std::uint32_t kNoNode = 0xffffffffu;

    std::uint32_t nodes() const { return count + interior; }
    std::uint32_t black() const { return count + static_cast<std::uint32_t>(shared::kSkyBins); }
    float level_cell_m(int level) const
    {
        return cell_m * static_cast<float>(std::uint32_t{1} << level);
    }
    const std::uint16_t* row(std::uint32_t patch) const
    {
        return links.data() + std::size_t{patch} * static_cast<std::size_t>(rays);
    }
    std::size_t redrawn_row() const { return (static_cast<std::size_t>(rays) + 7) / 8; }
    bool may_be_redrawn(std::uint32_t patch, int r) const
    {
        const auto at = static_cast<std::size_t>(r);
        return redrawn.empty() || (redrawn[patch * redrawn_row() + at / 8] >> at % 8 & 1u) != 0;
    }
    bool empty() const { return count == 0; }
};

inline int level_of(const shared::PatchKey& key)
{
    return static_cast<int>(key.high >> 28);
}
inline int axis_of(const shared::PatchKey& key)
{
    return static_cast<int>((key.high >> 25) & 7u);
}

/// Cuts and traces. A scene without a triangle that stops light gives no patches.
///
/// Deterministic: the same bits for any number of threads and any compiler. Rays of a patch are
/// drawn from its key, so that what is added to a scene elsewhere changes no row that does not see
/// it. Costs about 8 CPU-seconds for 160 000 triangles and 26 000 patches; memory is bounded by
/// max_patches (about 600 bytes each) beside the triangles (about 150 bytes each).
///
///   throws   Error for options out of range, Interrupted when `stop` says so.
///   source   Ward 1988 (cells by mean distance); Goral 1984, Cohen 1988 (form factors).
Patches build_patches(const Tracer& tracer, const PatchOptions& options = {});

/// The node of a key; Patches::kNoNode where there is none.
std::uint32_t find_node(const Patches& patches, shared::PatchKey key);

/// The leaf that holds a point with this normal: walks from the coarsest cell down; where no leaf
/// faces that way, the leaf of the same cell whose normal is nearest; then cells around. Nothing
/// when the scene has no surface near.
std::optional<std::uint32_t> patch_at(const Patches& patches, glm::vec3 position, glm::vec3 normal);

/// Share 0..1 of a patch that sees the sky in a direction (unit, from the patch outwards): four
/// bits mixed. 0 below the horizon. Samples that face away do not see it.
float visible_share(const Patches& patches, std::uint32_t patch, glm::vec3 direction);

/// The same of bits that stand as Patches::visible.
float visible_share(const std::array<std::uint32_t, 8>& bits, glm::vec3 direction);

/// Falling rain that a patch gets, over what level open ground gets: drops come along their velocity
/// (m/s, falling: y < 0), walls catch the more the stronger the wind. 0 for drops that do not fall.
float rain_exposure(const Patches& patches, std::uint32_t patch, glm::vec3 drop_velocity_m_s);

/// How light and other things that average are carried up: area-weighted means of the children, for
/// interior nodes, from values of leaves. values: one entry a leaf; returns one a node.
std::vector<glm::vec4> with_interior(const Patches& patches, const std::vector<glm::vec4>& leaves);

/// A point of a sample, metres, and the normal of its face, unit, towards the side that is seen.
struct SamplePoint {
    glm::vec3 position_m{0.0f};
    glm::vec3 normal{0.0f, 1.0f, 0.0f};
};
SamplePoint sample_point(const Triangles& triangles, const PatchSample& sample);

}  // namespace petrichor::scene

#endif
