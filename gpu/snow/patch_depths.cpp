#include "gpu/snow/patch_depths.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "formulas/light/patch_cells.h"
#include "formulas/weather/surface_weather.h"

namespace petrichor::gpu {
namespace {

using glm::ivec3;
using glm::vec2;
using glm::vec3;
using glm::vec4;

constexpr int kUp = 2;
constexpr float kLifted = 0.06f;  // of a cell: a place on the ground lies in the cell over it
constexpr float kFaces = 0.4f;    // of a normal along an axis: less does not look along it

// The leaf that looks along an axis in a cell of level 0, as place_leaf() of formulas/light/place_lookup.inc: its number and level,
// kNoPatch where there is none.
struct Leaf {
    std::uint32_t number = shared::kNoPatch;
    int level = 0;
};

Leaf leaf_in(const PlaceShape& shape, const ivec3& cell, int axis)
{
    const shared::PatchGrid& grid = shape.grid;
    for (int level = static_cast<int>(grid.levels) - 1; level >= 0; --level) {
        const shared::PatchKey key =
            shared::patch_key(ivec3(cell.x >> level, cell.y >> level, cell.z >> level), axis, level);
        std::uint32_t slot = shared::patch_key_hash(key) & grid.table_mask;
        bool inner = false;
        for (int probe = 0; probe < 64; ++probe) {
            const glm::uvec4& entry = shape.table[slot];
            if (entry.z == shared::kNoPatch) break;
            if (entry.x == key.low && entry.y == key.high) {
                inner = entry.z >= grid.patches;
                if (!inner) return {entry.z, level};
                break;
            }
            slot = (slot + 1) & grid.table_mask;
        }
        if (!inner) return {};
    }
    return {};
}

// Where a place looks for its patches: by the axis that its normal points along most, then by the others that it faces.
std::array<int, 3> axes_of(const vec3& n)
{
    const vec3 along = glm::abs(n);
    std::array<int, 3> axes{n.x >= 0.0f ? 0 : 1, n.y >= 0.0f ? kUp : kUp + 1, n.z >= 0.0f ? 4 : 5};
    std::stable_sort(axes.begin(), axes.end(), [&](int a, int b) { return along[a / 2] > along[b / 2]; });
    return axes;
}

// Shares of four cells, the place between the middles of the inner two: the uniform cubic B-spline.
vec4 spline(float t)
{
    const float s = 1.0f - t;
    return vec4(s * s * s, 4.0f - 3.0f * t * t * (1.0f + s), 4.0f - 3.0f * s * s * (1.0f + t), t * t * t) / 6.0f;
}

}  // namespace

void PatchDepths::find(std::shared_ptr<const PlaceShape> shape, const std::vector<vec3>& places_m, const std::vector<vec3>& normals)
{
    shape_ = std::move(shape);
    windows_.clear();
    places_.assign(places_m.size(), {});
    const float cell_m = shape_->grid.cell_m;
    std::map<std::tuple<int, int, int, int, int>, std::uint32_t> numbers;  // of a window's first cell, level and axis
    for (std::size_t i = 0; i < places_m.size(); ++i) {
        const vec3 n = normals.empty() ? vec3(0.0f, 1.0f, 0.0f) : normals[i];
        vec3 at(0.0f);
        Leaf own;
        int axis = kUp;
        for (const int asked : axes_of(n)) {
            if (std::abs(n[asked / 2]) < kFaces) break;
            axis = asked;
            at = places_m[i] + kLifted * cell_m * (axis == kUp ? vec3(0.0f, 1.0f, 0.0f) : n);
            own = leaf_in(*shape_, shared::patch_cell(at, 1.0f / cell_m), axis);
            if (own.number != shared::kNoPatch) break;
        }
        if (own.number == shared::kNoPatch) continue;
        const int edge = 1 << own.level;
        // In cells of that level, from the middle of one.
        const vec2 along = (vec2(at.x, at.z) / cell_m + shared::kPatchGridShift) / static_cast<float>(edge) - 0.5f;
        const vec2 whole = glm::floor(along);
        const int x = static_cast<int>(whole.x) - 1, z = static_cast<int>(whole.y) - 1;
        places_[i].within = along - whole;
        // Ground rises and falls from layer to layer.
        const float height = (at.y / cell_m + shared::kPatchGridShift) / static_cast<float>(edge) - 0.5f;
        places_[i].above = shared::smooth_edge(0.0f, 1.0f, height - std::floor(height));
        for (int layer = 0; layer < 2; ++layer) {
            const int y = static_cast<int>(std::floor(height)) + layer;
            const auto [found, fresh] = numbers.try_emplace({x, y, z, own.level, axis}, kNowhere);
            if (fresh) {
                const auto middle = [&](int of) { return of * edge + edge / 2 + shared::kPatchCellBias; };
                Window window;
                bool any = false;
                for (int k = 0; k < kSide * kSide; ++k) {
                    const std::uint32_t patch = leaf_in(*shape_, {middle(x + k % kSide), middle(y), middle(z + k / kSide)}, axis).number;
                    window[static_cast<std::size_t>(k)] = patch;
                    any = any || patch != shared::kNoPatch;
                }
                if (any) {
                    found->second = static_cast<std::uint32_t>(windows_.size());
                    windows_.push_back(window);
                }
            }
            places_[i].windows[static_cast<std::size_t>(layer)] = found->second;
        }
    }
}

std::vector<float> PatchDepths::depths_m(const PlaceWeather& weather, float open_m) const
{
    // Of each window: depths, and which of them there are.
    struct Known {
        std::array<float, kSide * kSide> depth_m{}, there{};
    };
    std::vector<Known> known(windows_.size());
    for (std::size_t w = 0; w < windows_.size(); ++w) {
        for (std::size_t k = 0; k < windows_[w].size(); ++k) {
            const std::uint32_t patch = windows_[w][k];
            if (patch == shared::kNoPatch) continue;
            known[w].depth_m[k] = weather.states[std::size_t{patch} * PLACE_STATE_TEXELS + 2].z;
            known[w].there[k] = 1.0f;
        }
    }
    std::vector<float> depths(places_.size(), open_m);
    for (std::size_t i = 0; i < places_.size(); ++i) {
        const Place& place = places_[i];
        const vec4 x = spline(place.within.x), z = spline(place.within.y);
        float sum = 0.0f, share = 0.0f;
        for (std::size_t layer = 0; layer < 2; ++layer) {
            const float whole = layer == 0 ? 1.0f - place.above : place.above;
            if (place.windows[layer] == kNowhere || !(whole > 0.0f)) continue;
            const Known& around = known[place.windows[layer]];
            for (int k = 0; k < kSide * kSide; ++k) {
                const float w = whole * x[k % kSide] * z[k / kSide];
                const auto at = static_cast<std::size_t>(k);
                sum += w * around.depth_m[at];
                share += w * around.there[at];
            }
        }
        if (share > 0.0f) depths[i] = sum / share;
    }
    return depths;
}

}  // namespace petrichor::gpu
