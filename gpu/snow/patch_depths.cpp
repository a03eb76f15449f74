#include "gpu/snow/patch_depths.h"

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

// The leaf that faces up in a cell of level 0, as place_leaf() of gpu/frame/place.glsl: its number and level, kNoPatch where
// there is none.
struct Leaf {
    std::uint32_t number = shared::kNoPatch;
    int level = 0;
};

Leaf leaf_in(const PlaceShape& shape, const ivec3& cell)
{
    const shared::PatchGrid& grid = shape.grid;
    for (int level = static_cast<int>(grid.levels) - 1; level >= 0; --level) {
        const shared::PatchKey key =
            shared::patch_key(ivec3(cell.x >> level, cell.y >> level, cell.z >> level), kUp, level);
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

// Shares of four cells, the place between the middles of the inner two: the uniform cubic B-spline.
vec4 spline(float t)
{
    const float s = 1.0f - t;
    return vec4(s * s * s, 4.0f - 3.0f * t * t * (1.0f + s), 4.0f - 3.0f * s * s * (1.0f + t), t * t * t) / 6.0f;
}

}  // namespace

void PatchDepths::find(std::shared_ptr<const PlaceShape> shape, const std::vector<vec3>& places_m)
{
    shape_ = std::move(shape);
    windows_.clear();
    places_.assign(places_m.size(), {});
    const float cell_m = shape_->grid.cell_m;
    std::map<std::tuple<int, int, int, int>, std::uint32_t> numbers;  // of a window's first cell and level
    for (std::size_t i = 0; i < places_m.size(); ++i) {
        const vec3 at = places_m[i] + vec3(0.0f, kLifted * cell_m, 0.0f);
        const ivec3 cell = shared::patch_cell(at, 1.0f / cell_m);
        const Leaf own = leaf_in(*shape_, cell);
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
            const auto [found, fresh] = numbers.try_emplace({x, y, z, own.level}, kNowhere);
            if (fresh) {
                const auto middle = [&](int of) { return of * edge + edge / 2 + shared::kPatchCellBias; };
                Window window;
                bool any = false;
                for (int k = 0; k < kSide * kSide; ++k) {
                    const std::uint32_t patch = leaf_in(*shape_, {middle(x + k % kSide), middle(y), middle(z + k / kSide)}).number;
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
