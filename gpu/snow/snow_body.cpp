#include "gpu/snow/snow_body.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "formulas/weather/snow_body.h"
#include "formulas/weather/surface_weather.h"

namespace petrichor::gpu {
namespace {

using glm::vec3;

constexpr float kThin_m = 0.012f;  // less than this everywhere is drawn as a cover alone
constexpr float kTallest_m = scene::kDeepestSnow_m * 1.4f;

constexpr float kCovers_m = 0.01f;  // caps so high over a triangle of the scene stand for it

constexpr float kSunk_m = 0.002f;   // .. and so deep below it are not seen

// Snow hides what is deep below it from eyes that have none around so far and stand so high over it.
constexpr float kNear_m = 1.5f;
constexpr float kOverIt_m = 0.1f;

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
            const vec3 along(overlay_.vertices.back().tangent);
            const float length = glm::length(along);
            along_.push_back(length > 0.0f ? along / length : vec3(1.0f, 0.0f, 0.0f));
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
    const scene::SnowLevels& levels = caps_->levels;
    for (const scene::SnowLevels::Piece& piece : levels.pieces) {
        std::vector<std::uint32_t> points;
        for (std::uint32_t k = 0; k < piece.levels[0].index_count; ++k)
            points.push_back(caps_->corner_points[levels.indices[piece.levels[0].first_index + k]]);
        std::sort(points.begin(), points.end());
        points.erase(std::unique(points.begin(), points.end()), points.end());
        piece_points_.push_back(std::move(points));
    }
    for (const scene::SnowCaps::Point& point : caps_->points) {
        base_m_.push_back(point.base_m);
        besides_.push_back({point.beyond, point.below});
        lowest_m_ = std::min(lowest_m_, point.base_m.y);
    }
    list_corners();
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

// What each level of each piece draws, once for all frames.
void SnowBody::list_corners()
{
    const scene::SnowLevels& levels = caps_->levels;
    level_points_.reserve(levels.indices.size());
    for (const std::uint32_t corner : levels.indices) level_points_.push_back(caps_->corner_points[corner]);
    std::vector<std::uint32_t> last(caps_->corner_points.size(), 0);  // list, from 1, that has a corner
    std::uint32_t number = 0;
    for (const scene::SnowLevels::Piece& piece : levels.pieces) {
        auto& ranges = level_corners_.emplace_back();
        for (std::size_t level = 0; level < ranges.size(); ++level) {
            const scene::SnowLevels::Range& range = piece.levels[level];
            ++number;
            ranges[level].first = static_cast<std::uint32_t>(corner_lists_.size());
            for (std::uint32_t k = range.first_index; k < range.first_index + range.index_count; ++k) {
                const std::uint32_t corner = levels.indices[k];
                if (last[corner] == number) continue;
                last[corner] = number;
                corner_lists_.push_back(corner);
            }
            ranges[level].end = static_cast<std::uint32_t>(corner_lists_.size());
        }
    }
}

// Of the points, of what they lie on: as long as it is wide.
std::vector<vec3> SnowBody::base_faces() const
{
    std::vector<vec3> faces(base_m_.size(), vec3(0.0f));
    for (std::size_t k = 0; k + 2 < corners_.size(); k += 3) {
        const std::uint32_t a = corners_[k], b = corners_[k + 1], c = corners_[k + 2];
        const vec3 face = glm::cross(base_m_[b] - base_m_[a], base_m_[c] - base_m_[a]);
        for (const std::uint32_t point : {a, b, c}) faces[point] += face;
    }
    return faces;
}

std::vector<float> SnowBody::depths(const Frame& frame, const FrameTracks& tracks)
{
    const shared::WeatherMoment& w = frame.weather;
    const bool placed = frame.place && frame.place->shape->grid.levels > 0;
    const float open_m = placed && !frame.place->open.empty() ? frame.place->open[2].z : w.snow_depth_m;
    if (placed && patches_.shape() != frame.place->shape) {
        std::vector<vec3> places;
        for (const scene::SnowCaps::Point& point : caps_->points) places.push_back(point.base_m);
        patches_.find(frame.place->shape, places, base_faces());
    }
    std::vector<float> depths = placed ? patches_.depths_m(*frame.place, open_m) : std::vector<float>(caps_->points.size(), open_m);
    if (tracks.map() != nullptr) {
        for (std::size_t i = 0; i < depths.size(); ++i) depths[i] *= 1.0f - pressed_at(*tracks.map(), caps_->points[i].base_m);
    }
    // Most scenes lie above the line by far, and it runs up and down by no more than this.
    const float whole_m = w.snow_start_height_m + w.snow_height_blend_m * (1.0f + 2.0f * std::max(frame.look.snow_line_ragged, 0.0f));
    if (lowest_m_ > whole_m) return depths;
    for (std::size_t i = 0; i < depths.size(); ++i) {
        depths[i] *= shared::snow_line_factor(caps_->points[i].base_m, w.snow_start_height_m, w.snow_height_blend_m,
                                              frame.look.snow_line_ragged);
    }
    return depths;
}

bool SnowBody::lay(const Frame& frame, const FrameTracks& tracks)
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
        key.tracks = tracks.number();
    }
    if (laid_ == key) return false;
    const bool lay_before = lies_;
    laid_ = key;
    lies_ = false;
    if (!key.wanted) return lay_before;
    const std::vector<float> depth_m = depths(frame, tracks);
    choose_levels(depth_m);
    const scene::SnowShape shape = scene::snow_shape(*caps_, depth_m, drawn_, key.place ? std::span<const float>(patches_.held()) : std::span<const float>());
    lies_ = shape.thickest_m > kThin_m;
    if (!lies_) return lay_before;
    lift_m_ = 0.0f;
    for (const std::uint32_t i : drawn_corners_) {
        const std::uint32_t point = caps_->corner_points[i];
        Vertex& v = overlay_.vertices[i];
        v.position = shape.positions[point];
        v.normal = shape.normals[point];
        const float lift = std::max(v.position.y - base_m_[point].y, 0.0f);
        lift_m_ = std::max(lift_m_, lift);
        v.tangent = glm::vec4(along_[i] * (1.0f + lift), v.tangent.w);
        v.weather[3] = std::min<std::uint8_t>(code(shared::snow_body_code(shape.deep_m[point])), 254);
    }
    fill_indices(shape);
    find_covered(shape);
    top_m_ = shape.positions;
    return true;
}

// By the depths alone: a frame is the same whatever was laid before.
void SnowBody::choose_levels(const std::vector<float>& depth_m)
{
    const scene::SnowLevels& levels = caps_->levels;
    const auto [least_of_all, most_of_all] = std::minmax_element(depth_m.begin(), depth_m.end());
    const auto level_at = [](float least_m) { return static_cast<std::uint8_t>(scene::SnowLevels::level_at(least_m)); };
    std::vector<std::uint8_t> chosen(piece_points_.size(), level_at(*least_of_all));
    const bool alike = level_at(*least_of_all) == level_at(*most_of_all);
    for (std::size_t i = 0; i < chosen.size() && !alike; ++i) {
        float least_m = *most_of_all;
        for (const std::uint32_t point : piece_points_[i]) least_m = std::min(least_m, depth_m[point]);
        chosen[i] = level_at(least_m);
    }
    if (chosen == levels_) return;
    levels_ = std::move(chosen);
    drawn_.points.assign(caps_->points.size(), 0);
    drawn_.triangles.clear();
    drawn_corners_.clear();
    std::vector<std::uint8_t> known(caps_->corner_points.size(), 0);
    for (std::size_t i = 0; i < levels_.size(); ++i) {
        const scene::SnowLevels::Range& range = levels.pieces[i].levels[levels_[i]];
        const auto first = level_points_.begin() + range.first_index;
        drawn_.triangles.insert(drawn_.triangles.end(), first, first + range.index_count);
        const CornerRange& own = level_corners_[i][levels_[i]];
        for (std::uint32_t k = own.first; k < own.end; ++k) {
            const std::uint32_t corner = corner_lists_[k];
            known[corner] = 1;
            drawn_.points[caps_->corner_points[corner]] = scene::DrawnSnow::kDrawn;
        }
    }
    for (std::uint32_t corner = 0; corner < known.size(); ++corner)
        if (known[corner] != 0) drawn_corners_.push_back(corner);
    for (std::size_t i = 0; i < drawn_.points.size(); ++i) {
        if (drawn_.points[i] != scene::DrawnSnow::kDrawn) continue;
        for (const std::uint32_t other : besides_[i])
            if (other != scene::SnowCaps::kNone) drawn_.points[other] = std::max(drawn_.points[other], scene::DrawnSnow::kBeside);
    }
}

// Triangles that lie below the ground all over are not seen; and where caps are as thin as that the ground throws their shadow.
void SnowBody::fill_indices(const scene::SnowShape& shape)
{
    counts_.assign(caps_->parts.size(), 0);
    hidden_.resize(overlay_.indices.size() / 3);
    std::vector<std::uint8_t> out(caps_->points.size());
    constexpr std::uint8_t kSunk = 0x80;
    for (std::size_t i = 0; i < out.size(); ++i) {
        const float lift = shape.positions[i].y - base_m_[i].y;
        out[i] = static_cast<std::uint8_t>((lift < -kSunk_m ? kSunk : 0) | (lift > kCovers_m ? 0 : Covered::kFromSun));
    }
    std::size_t k = 0;
    for (std::size_t i = 0; i < levels_.size(); ++i) {
        const scene::SnowLevels::Piece& piece = caps_->levels.pieces[i];
        const std::uint32_t first = caps_->parts[piece.part].first_index;
        std::uint32_t& count = counts_[piece.part];
        const scene::SnowLevels::Range& range = piece.levels[levels_[i]];
        const std::uint32_t* corner = caps_->levels.indices.data() + range.first_index;
        const std::size_t begin = k;
        for (const std::size_t end = k + range.index_count; k < end; k += 3) {
            const std::uint32_t* point = drawn_.triangles.data() + k;
            const auto all = static_cast<std::uint8_t>(out[point[0]] & out[point[1]] & out[point[2]]);
            if ((all & kSunk) != 0) continue;
            std::copy_n(corner + (k - begin), 3, overlay_.indices.data() + first + count);
            hidden_[(first + count) / 3] = all;
            count += 3;
        }
    }
}

// Points that lie deep below snow that stands upright over them, and whose neighbours do: an eye beside others may look under
// the snow.
std::vector<std::uint8_t> SnowBody::hidden_points(const scene::SnowShape& shape) const
{
    std::vector<std::uint8_t> deep = inner_;
    for (std::size_t i = 0; i < deep.size(); ++i) {
        const vec3 lift = shape.positions[i] - base_m_[i];
        const bool upright = std::max(std::abs(lift.x), std::abs(lift.z)) < scene::kUpright_m;
        // What coarser levels leave out lies deep, and so does all around it.
        if (drawn_.points[i] == scene::DrawnSnow::kDrawn && (!(lift.y > scene::kHidesGround_m) || !upright)) deep[i] = 0;
    }
    std::vector<std::uint8_t> hidden = deep;
    for (std::size_t k = 0; k + 2 < drawn_.triangles.size(); k += 3) {
        const std::uint32_t a = drawn_.triangles[k], b = drawn_.triangles[k + 1], c = drawn_.triangles[k + 2];
        if ((deep[a] & deep[b] & deep[c]) == 0) hidden[a] = hidden[b] = hidden[c] = 0;
    }
    return hidden;
}

void SnowBody::find_covered(const scene::SnowShape& shape)
{
    std::vector<std::uint8_t> from = hidden_points(shape);
    for (std::size_t i = 0; i < from.size(); ++i) {
        from[i] = from[i] != 0 ? Covered::kFromEye : std::uint8_t{0};
        if (drawn_.points[i] != scene::DrawnSnow::kDrawn || shape.positions[i].y - base_m_[i].y > kCovers_m) from[i] |= Covered::kFromSun;
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
        if (drawn_.points[i] != scene::DrawnSnow::kDrawn) continue;
        const vec3 way = eye_m - top_m_[i];
        if (way.x * way.x + way.z * way.z < kNear_m * kNear_m && way.y < kOverIt_m && eye_m.y > base_m_[i].y - kTallest_m) return false;
    }
    return true;
}

LaidOverlay SnowBody::laid() const
{
    if (!lies_) return {};
    return {overlay_.vertices, overlay_.indices, counts_, hidden_, covered_, true};
}

}  // namespace petrichor::gpu
