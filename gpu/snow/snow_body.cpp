#include "gpu/snow/snow_body.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "formulas/light/patch_cells.h"
#include "formulas/weather/snow_body.h"
#include "formulas/weather/surface_weather.h"

namespace petrichor::gpu {
namespace {

using glm::vec3;

constexpr float kThin_m = 0.012f;  // less than this everywhere is drawn as a cover alone
constexpr float kApart = 0.4f;     // of a patch's cell, between the places whose depths are blended
// By binomial weights: patches are squares, and what lies on them is not.
constexpr int kSide = SnowBody::kAround;
constexpr std::array<float, kSide> kShare{1.0f / 16, 4.0f / 16, 6.0f / 16, 4.0f / 16, 1.0f / 16};
constexpr float kTallest_m = scene::kDeepestSnow_m * 1.4f;

constexpr float kCovers_m = 0.01f;  // caps so high over a triangle of the scene stand for it

constexpr float kHides_m = 0.02f;      // .. and so high, upright within this, ..
constexpr float kUpright_m = 0.001f;
constexpr float kNear_m = 1.5f;        // .. hide it from eyes that have none around so far ..
constexpr float kOverIt_m = 0.1f;      // .. and stand so high over it

constexpr int kMiddle = kSide * kSide / 2;

// The leaf that lies at a point and faces up; as place_leaf() of gpu/frame/place.glsl. Its number and
// level, kNoPatch where there is none.
struct Leaf {
    std::uint32_t number = shared::kNoPatch;
    int level = 0;
};

Leaf leaf_at(const PlaceShape& shape, const vec3& place)
{
    const shared::PatchGrid& grid = shape.grid;
    constexpr int kUp = 2;
    const glm::ivec3 cell = shared::patch_cell(
        place + vec3(0.0f, 0.06f * grid.cell_m, 0.0f), 1.0f / grid.cell_m);
    for (int level = static_cast<int>(grid.levels) - 1; level >= 0; --level) {
        const shared::PatchKey key = shared::patch_key(
            glm::ivec3(cell.x >> level, cell.y >> level, cell.z >> level), kUp, level);
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

std::uint8_t code(float share)
{
    return static_cast<std::uint8_t>(std::lround(std::clamp(share, 0.0f, 1.0f) * 255.0f));
}

}  // namespace

SnowBody::SnowBody(std::shared_ptr<const scene::SnowCaps> caps) : caps_(std::move(caps))
{
    overlay_.indices = caps_->indices;
    for (const scene::SnowCaps::Part& from : caps_->parts) {
        Overlay::Part part{from.material, from.instance, from.first_index, from.index_count,
                           {vec3(1.0e30f), vec3(-1.0e30f)}};
        for (std::size_t v = 0; v < from.source.positions.size(); ++v) {
            overlay_.vertices.push_back(vertex_of(from.source, v));
            part.box.low = glm::min(part.box.low, from.source.positions[v] - kTallest_m);
            part.box.high = glm::max(part.box.high, from.source.positions[v] + kTallest_m);
        }
        overlay_.parts.push_back(part);
        std::uint32_t last = 0;
        for (const std::uint32_t below : from.below)
            if (below != scene::SnowCaps::kUncovered) last = std::max(last, below + 1);
        // Banks cover nothing, and have the name of what does.
        if (last == 0) continue;
        covered_.push_back({from.instance, from.primitive, std::vector<std::uint8_t>(last)});
        covering_.push_back(static_cast<std::uint32_t>(&from - caps_->parts.data()));
    }
    corners_.reserve(caps_->indices.size());
    for (const std::uint32_t corner : caps_->indices) corners_.push_back(caps_->corner_points[corner]);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> ways;
    for (std::size_t k = 0; k < corners_.size(); ++k) {
        const std::uint32_t a = corners_[k], b = corners_[k % 3 == 2 ? k - 2 : k + 1];
        ways[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
    inner_.assign(caps_->points.size(), 1);
    for (const auto& [edge, way] : ways)
        if (way != 0) inner_[edge.first] = inner_[edge.second] = 0;
}

void SnowBody::find_patches(const PlaceShape& shape)
{
    patches_.clear();
    patches_.reserve(caps_->points.size());
    for (const scene::SnowCaps::Point& point : caps_->points) {
        const Leaf own = leaf_at(shape, point.base_m);
        const float step =
            kApart * shape.grid.cell_m * static_cast<float>(std::uint32_t{1} << own.level);
        Around around;
        for (int k = 0; k < kSide * kSide; ++k) {
            const vec3 way(step * static_cast<float>(k % kSide - kSide / 2), 0.0f,
                           step * static_cast<float>(k / kSide - kSide / 2));
            const std::uint32_t there = own.number == shared::kNoPatch || k == kMiddle
                                            ? own.number
                                            : leaf_at(shape, point.base_m + way).number;
            around[static_cast<std::size_t>(k)] = there == shared::kNoPatch ? own.number : there;
        }
        patches_.push_back(around);
    }
}

std::vector<float> SnowBody::depths(const Frame& frame)
{
    const shared::WeatherMoment& w = frame.weather;
    std::vector<float> depths;
    depths.reserve(caps_->points.size());
    const bool placed = frame.place && frame.place->shape->grid.levels > 0;
    if (placed && shape_ != frame.place->shape) {
        shape_ = frame.place->shape;
        find_patches(*shape_);
    }
    for (std::size_t i = 0; i < caps_->points.size(); ++i) {
        float depth = placed && !frame.place->open.empty() ? frame.place->open[2].z : w.snow_depth_m;
        if (placed && patches_[i][kMiddle] != shared::kNoPatch) {
            depth = 0.0f;
            for (std::size_t k = 0; k < patches_[i].size(); ++k) {
                depth += kShare[k % kSide] * kShare[k / kSide] *
                         frame.place->states[std::size_t{patches_[i][k]} * PLACE_STATE_TEXELS + 2].z;
            }
        }
        depths.push_back(depth * shared::snow_line_factor(caps_->points[i].base_m, w.snow_start_height_m,
                                                          w.snow_height_blend_m, frame.look.snow_line_ragged));
    }
    return depths;
}

bool SnowBody::lay(const Frame& frame)
{
    const shared::WeatherMoment& w = frame.weather;
    const bool placed = frame.place && frame.place->shape->grid.levels > 0;
    Key key;
    key.wanted = frame.settings.snow_body && (placed || w.snow_amount > 0.0f);
    if (key.wanted) {
        key.depth_m = w.snow_amount > 0.0f ? w.snow_depth_m : 0.0f;
        key.start_m = w.snow_start_height_m;
        key.blend_m = w.snow_height_blend_m;
        key.ragged = frame.look.snow_line_ragged;
        key.place = placed ? frame.place : nullptr;
    }
    if (laid_ == key) return false;
    const bool lay_before = lies_;
    laid_ = key;
    lies_ = false;
    if (!key.wanted) return lay_before;
    const scene::SnowShape shape = scene::snow_shape(*caps_, depths(frame));
    lies_ = shape.thickest_m > kThin_m;
    if (!lies_) return lay_before;
    lift_m_ = 0.0f;
    for (std::size_t i = 0; i < overlay_.vertices.size(); ++i) {
        const std::uint32_t point = caps_->corner_points[i];
        Vertex& v = overlay_.vertices[i];
        v.position = shape.positions[point];
        v.normal = shape.normals[point];
        const vec3 along = vec3(v.tangent);
        const float length = glm::length(along);
        const float lift = std::max(v.position.y - caps_->points[point].base_m.y, 0.0f);
        lift_m_ = std::max(lift_m_, lift);
        const vec3 unit = length > 0.0f ? along / length : vec3(1.0f, 0.0f, 0.0f);
        v.tangent = glm::vec4(unit * (1.0f + lift), v.tangent.w);
        v.weather[3] = std::min<std::uint8_t>(code(shared::snow_body_code(shape.deep_m[point])), 254);
    }
    top_m_ = shape.positions;
    find_covered(shape);
    return true;
}

// Points that lie deep below snow that stands upright over them, and whose neighbours do: an eye beside others may look under
// the snow.
std::vector<std::uint8_t> SnowBody::hidden_points(const scene::SnowShape& shape) const
{
    std::vector<std::uint8_t> deep = inner_;
    for (std::size_t i = 0; i < deep.size(); ++i) {
        const vec3 lift = shape.positions[i] - caps_->points[i].base_m;
        const bool upright = std::max(std::abs(lift.x), std::abs(lift.z)) < kUpright_m;
        if (!(lift.y > kHides_m) || !upright) deep[i] = 0;
    }
    std::vector<std::uint8_t> hidden = deep;
    for (std::size_t k = 0; k + 2 < corners_.size(); k += 3) {
        const std::uint32_t a = corners_[k], b = corners_[k + 1], c = corners_[k + 2];
        if ((deep[a] & deep[b] & deep[c]) == 0) hidden[a] = hidden[b] = hidden[c] = 0;
    }
    return hidden;
}

void SnowBody::find_covered(const scene::SnowShape& shape)
{
    std::vector<std::uint8_t> from = hidden_points(shape);
    for (std::size_t i = 0; i < from.size(); ++i) {
        from[i] = from[i] != 0 ? Covered::kFromEye : std::uint8_t{0};
        if (shape.positions[i].y - caps_->points[i].base_m.y > kCovers_m) from[i] |= Covered::kFromSun;
    }
    for (std::size_t i = 0; i < covering_.size(); ++i) {
        const scene::SnowCaps::Part& part = caps_->parts[covering_[i]];
        std::vector<std::uint8_t>& triangles = covered_[i].triangles;
        std::fill(triangles.begin(), triangles.end(), std::uint8_t{0});
        for (const std::uint32_t below : part.below)
            if (below != scene::SnowCaps::kUncovered) triangles[below] = Covered::kFromSun | Covered::kFromEye;
        const std::uint32_t* corner = corners_.data() + part.first_index;
        for (std::size_t t = 0; t < part.below.size(); ++t, corner += 3) {
            const std::uint32_t below = part.below[t];
            if (below != scene::SnowCaps::kUncovered) triangles[below] = static_cast<std::uint8_t>(triangles[below] & from[corner[0]] & from[corner[1]] & from[corner[2]]);
        }
    }
}

bool SnowBody::lies_below(const vec3& eye_m) const
{
    if (!lies_) return false;
    for (std::size_t i = 0; i < top_m_.size(); ++i) {
        const vec3 way = eye_m - top_m_[i];
        if (way.x * way.x + way.z * way.z < kNear_m * kNear_m && way.y < kOverIt_m && eye_m.y > caps_->points[i].base_m.y - kTallest_m) return false;
    }
    return true;
}

std::span<const Covered> SnowBody::covered() const
{
    if (!lies_) return {};
    return covered_;
}

std::span<const Vertex> SnowBody::vertices() const
{
    if (!lies_) return {};
    return overlay_.vertices;
}

}  // namespace petrichor::gpu
