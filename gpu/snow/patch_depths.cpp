#include "gpu/snow/patch_depths.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "formulas/light/patch_cells.h"
#include "formulas/noise/noise.h"
#include "formulas/weather/surface_weather.h"
#include "scene/snow/snow_caps.h"

namespace petrichor::gpu {
namespace {

using glm::ivec3;
using glm::vec2;
using glm::vec3;
using glm::vec4;

constexpr int kUp = 2;
constexpr float kLifted = 0.06f;  // of a cell: a place on the ground lies in the cell over it
constexpr float kFaces = 0.4f;    // of a normal along an axis: less does not look along it
constexpr float kLeastUp = 0.4f;  // what is steeper holds no snow

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

vec3 unit(const vec3& v)
{
    const float length = glm::length(v);
    return length > 1.0e-12f ? v / length : vec3(0.0f, 1.0f, 0.0f);
}

// Shares of four cells, the place between the middles of the inner two: the uniform cubic B-spline.
vec4 spline(float t)
{
    const float s = 1.0f - t;
    return vec4(s * s * s, 4.0f - 3.0f * t * t * (1.0f + s), 4.0f - 3.0f * s * s * (1.0f + t), t * t * t) / 6.0f;
}

}  // namespace

// Shears, each of which keeps areas: along a way, by the place across it. Two ways for waves of a width, those of the next are turned.
vec2 snow_wanders(vec2 x_z)
{
    constexpr int kWidths = 4;
    constexpr float kTurn_rad = 0.97f;
    constexpr float kWidest = 4.6f, kNarrower = 0.62f, kReach = 0.46f;  // reach over width
    float width = kWidest;
    for (int i = 0; i < 2 * kWidths; ++i) {
        const float angle = kTurn_rad * static_cast<float>(i / 2) + 0.4f + 1.57079633f * static_cast<float>(i % 2);
        const vec2 along(std::cos(angle), std::sin(angle)), across(-along.y, along.x);
        const float at = glm::dot(x_z, across) / width + 17.3f * static_cast<float>(i);
        x_z += along * (kReach * width * (shared::endless_noise(vec2(at, 0.0f), 321u + static_cast<std::uint32_t>(i)) - 0.5f));
        if (i % 2 == 1) width *= kNarrower;
    }
    return x_z;
}

template <class OfPatch>
std::vector<float> PatchDepths::means(float otherwise, const OfPatch& of_patch) const
{
    std::vector<vec4> rows(kSide * windows_.size());
    for (std::size_t w = 0; w < windows_.size(); ++w) {
        for (std::size_t k = 0; k < windows_[w].size(); ++k) {
            const std::uint32_t patch = windows_[w][k];
            rows[kSide * w + k / kSide][static_cast<int>(k % kSide)] = patch != shared::kNoPatch ? of_patch(patch) : 0.0f;
        }
    }
    std::vector<float> means(places_.size(), otherwise);
    for (std::size_t i = 0; i < places_.size(); ++i) {
        const Place& place = places_[i];
        if (!(place.there > 0.0f)) continue;
        const vec4 x = spline(place.within.x), z = spline(place.within.y);
        vec4 sum(0.0f);
        for (std::size_t layer = 0; layer < 2; ++layer) {
            const float whole = layer == 0 ? 1.0f - place.above : place.above;
            if (place.windows[layer] == kNowhere || !(whole > 0.0f)) continue;
            const vec4* row = rows.data() + kSide * std::size_t{place.windows[layer]};
            sum += whole * (z[0] * row[0] + z[1] * row[1] + z[2] * row[2] + z[3] * row[3]);
        }
        means[i] = glm::dot(sum, x) / place.there;
    }
    return means;
}

void PatchDepths::find(std::shared_ptr<const PlaceShape> shape, const std::vector<vec3>& places_m, const std::vector<vec3>& faces)
{
    shape_ = std::move(shape);
    windows_.clear();
    places_.assign(places_m.size(), {});
    std::vector<vec3> all_faces(shape_->grid.patches, vec3(0.0f));
    const float cell_m = shape_->grid.cell_m;
    std::map<std::tuple<int, int, int, int, int>, std::uint32_t> numbers;  // of a window's first cell, level and axis
    // Whether any patch lies around there.
    const auto look_at = [&](Place& place, const vec3& at, int level, int axis) {
        const int edge = 1 << level;
        // In cells of that level, from the middle of one.
        const vec2 along = (vec2(at.x, at.z) / cell_m + shared::kPatchGridShift) / static_cast<float>(edge) - 0.5f;
        const vec2 whole = glm::floor(along);
        const int x = static_cast<int>(whole.x) - 1, z = static_cast<int>(whole.y) - 1;
        place.within = along - whole;
        // Ground rises and falls from layer to layer.
        const float height = (at.y / cell_m + shared::kPatchGridShift) / static_cast<float>(edge) - 0.5f;
        place.above = shared::smooth_edge(0.0f, 1.0f, height - std::floor(height));
        for (int layer = 0; layer < 2; ++layer) {
            const int y = static_cast<int>(std::floor(height)) + layer;
            const auto [found, fresh] = numbers.try_emplace({x, y, z, level, axis}, kNowhere);
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
            place.windows[static_cast<std::size_t>(layer)] = found->second;
        }
        return place.windows[0] != kNowhere || place.windows[1] != kNowhere;
    };
    for (std::size_t i = 0; i < places_m.size(); ++i) {
        const vec3 n = faces.empty() ? vec3(0.0f, 1.0f, 0.0f) : unit(faces[i]);
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
        if (!faces.empty()) all_faces[own.number] += faces[i];
        bool found = false;
        if (axis == kUp) {
            const vec2 here(at.x, at.z), way = snow_wanders(here / cell_m) * cell_m - here;
            // Along the slope.
            const float rises_m = n.y > kFaces ? -(n.x * way.x + n.z * way.y) / n.y : 0.0f;
            found = look_at(places_[i], at + vec3(way.x, rises_m, way.y), own.level, axis);
        }
        if (!found) look_at(places_[i], at, own.level, axis);
    }
    for (Place& place : places_) place.there = 1.0f;
    const std::vector<float> there = means(0.0f, [](std::uint32_t) { return 1.0f; });
    for (std::size_t i = 0; i < places_.size(); ++i) places_[i].there = there[i];
    up_.clear();
    for (const vec3& all : all_faces) up_.push_back(std::max(unit(all).y, kLeastUp));
    held_ = means(1.0f, [&](std::uint32_t patch) { return scene::snow_on_slope(up_[patch]); });
}

std::vector<float> PatchDepths::depths_m(const PlaceWeather& weather, float open_m) const
{
    return means(open_m, [&](std::uint32_t patch) { return weather.states[std::size_t{patch} * PLACE_STATE_TEXELS + 2].z / up_[patch]; });
}

}  // namespace petrichor::gpu
