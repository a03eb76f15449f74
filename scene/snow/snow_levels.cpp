#include "scene/snow/snow_levels.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "scene/snow/snow_caps.h"

namespace petrichor::scene {
namespace {

using glm::vec2;
using glm::vec3;
using glm::vec4;

constexpr float kPiece_m = 4.0f;
// Depths that a level must hold for: its own, and what lies between them is nearly linear.
constexpr std::array<float, 5> kDepths_m{0.07f, 0.1f, 0.14f, 0.28f, 0.45f};
constexpr std::array<std::size_t, SnowLevels::kCoarser> kFirstDepth{0, 2};
constexpr float kOff = 0.0004f;      // of the distance of the nearest eye: about a third of a pixel ..
constexpr float kLeastOff_m = 0.001f, kMostOff_m = 0.01f;  // .. within these
constexpr float kOffAtBank_m = 0.0007f;  // where banks and caps lie over each other
constexpr float kTurned = 0.06f;    // of normals, radians, near by ..
constexpr float kTurnedFar = 0.003f; // .. and more a metre of distance
constexpr float kOffUv = 0.004f;
constexpr float kOffMask = 0.1f;
constexpr float kSlim = 0.06f;       // twice the area of a triangle over its longest edge squared
constexpr int kRounds = 24;
constexpr float kFirstShare = 0.15f; // of what is allowed, in the first round; all of it after half of them

struct Snow {
    std::vector<SnowShape> shapes;  // of all points, at kDepths_m
};

// What stays of a piece while it is coarsened.
class Thinned {
public:
    Thinned(const SnowCaps& caps, const SnowCaps::Part& part, const Snow& snow, std::vector<std::uint32_t> indices, std::vector<bool>& free,
         const std::vector<float>& eye_m)
        : caps_(&caps), part_(&part), snow_(&snow), eye_m_(&eye_m)
    {
        std::map<std::uint32_t, std::uint32_t> number;
        for (const std::uint32_t corner : indices) {
            const auto [found, fresh] = number.try_emplace(corner, static_cast<std::uint32_t>(corners_.size()));
            if (fresh) corners_.push_back(corner);
            if (triangles_.empty() || triangles_.back().size == 3) triangles_.push_back({});
            triangles_.back().corner[triangles_.back().size++] = found->second;
        }
        around_.resize(corners_.size());
        for (std::uint32_t t = 0; t < triangles_.size(); ++t)
            for (const std::uint32_t c : triangles_[t].corner) around_[c].push_back(t);
        for (const std::uint32_t corner : corners_) free_.push_back(free[caps.corner_points[corner]]);
    }

    void coarsen(std::size_t first_depth)
    {
        first_depth_ = first_depth;
        std::vector<int> touched(corners_.size(), -1);
        for (int round = 0; round < kRounds; ++round) {
            share_ = std::min(kFirstShare + (1.0f - kFirstShare) * 2.0f * static_cast<float>(round) / kRounds, 1.0f);
            std::size_t left_out = 0;
            for (std::uint32_t v = 0; v < corners_.size(); ++v) {
                if (!free_[v] || around_[v].empty() || touched[v] == round) continue;
                if (!leave_out(v)) continue;
                ++left_out;
                for (const std::uint32_t r : ring_) touched[r] = round;
            }
            if (left_out == 0 && share_ >= 1.0f) break;
        }
    }

    void append(std::vector<std::uint32_t>& indices) const
    {
        for (const Triangle& t : triangles_)
            if (t.size == 3)
                for (const std::uint32_t c : t.corner) indices.push_back(corners_[c]);
    }

private:
    struct Triangle {
        std::array<std::uint32_t, 3> corner{};
        std::uint32_t size = 0;             // 0: left out
        std::vector<std::uint32_t> within;  // corners that were left out there
    };

    std::uint32_t point(std::uint32_t v) const { return caps_->corner_points[corners_[v]]; }
    vec2 plan(std::uint32_t v) const
    {
        const vec3& at = caps_->points[point(v)].base_m;
        return {at.x, at.z};
    }
    static float cross(const vec2& a, const vec2& b) { return a.x * b.y - a.y * b.x; }

    // The corners around one, in their order; false where they do not close.
    bool find_ring(std::uint32_t v)
    {
        ring_.clear();
        next_.clear();
        for (const std::uint32_t t : around_[v]) {
            const auto& c = triangles_[t].corner;
            const std::size_t k = c[0] == v ? 0 : c[1] == v ? 1 : 2;
            next_.emplace_back(c[(k + 1) % 3], c[(k + 2) % 3]);
        }
        std::uint32_t at = next_.front().first;
        for (std::size_t i = 0; i < next_.size(); ++i) {
            ring_.push_back(at);
            const auto found = std::find_if(next_.begin(), next_.end(), [at](const auto& n) { return n.first == at; });
            if (found == next_.end()) return false;
            at = found->second;
        }
        if (at != ring_.front() || ring_.size() < 3) return false;
        std::vector<std::uint32_t> sorted = ring_;
        std::sort(sorted.begin(), sorted.end());
        return std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end();
    }

    // Where a corner lies in the fan around ring_[u]: the number of the triangle there, 1 .. size - 2, and the shares of its
    // other two corners.
    struct Place {
        std::size_t triangle = 0;
        float b1 = 0.0f, b2 = 0.0f;
    };
    Place place_in_fan(std::uint32_t v, std::size_t u) const
    {
        const std::size_t n = ring_.size();
        const vec2 from = plan(ring_[u]), w = plan(v) - from;
        for (std::size_t k = 1; k + 1 < n; ++k) {
            const vec2 a = plan(ring_[(u + k) % n]) - from, b = plan(ring_[(u + k + 1) % n]) - from;
            const float area = cross(a, b);
            const float b1 = cross(w, b) / area, b2 = cross(a, w) / area;
            if (b1 >= -1.0e-4f && b2 >= -1.0e-4f && b1 + b2 <= 1.0001f) return {k, b1, b2};
        }
        return {};
    }

    bool is_fan(std::size_t u) const
    {
        const std::size_t n = ring_.size();
        const vec2 from = plan(ring_[u]);
        float sense = 0.0f;
        for (std::size_t k = 1; k + 1 < n; ++k) {
            const vec2 a = plan(ring_[(u + k) % n]) - from, b = plan(ring_[(u + k + 1) % n]) - from;
            const float area = cross(a, b);
            const float longest = std::max({glm::dot(a, a), glm::dot(b, b), glm::dot(b - a, b - a)});
            if (sense == 0.0f) sense = area < 0.0f ? -1.0f : 1.0f;
            if (!(sense * area > kSlim * longest)) return false;
        }
        return true;
    }

    // How far the fan is from the snow at a corner, over what is allowed; above 1: too far.
    float off(std::uint32_t v, std::size_t u) const
    {
        constexpr float kFar = 1.0e9f;
        const Place place = place_in_fan(v, u);
        if (place.triangle == 0) return kFar;
        const std::size_t n = ring_.size();
        const std::uint32_t a = ring_[u], b = ring_[(u + place.triangle) % n], c = ring_[(u + place.triangle + 1) % n];
        const float b1 = place.b1, b2 = place.b2, b0 = 1.0f - b1 - b2;
        const Primitive& p = part_->source;
        const auto corner = [&](std::uint32_t of) { return corners_[of] - part_->first_corner; };
        const auto lies = [&](const auto& list, float most) {
            const auto d = b0 * list[corner(a)] + b1 * list[corner(b)] + b2 * list[corner(c)] - list[corner(v)];
            return glm::dot(d, d) <= most * most;
        };
        if (!lies(p.uv0, kOffUv) || !lies(p.uv1, kOffUv) || !lies(p.colors, kOffMask) || !lies(p.weather, kOffMask)) return kFar;
        const SnowCaps::Point& own = caps_->points[point(v)];
        const float away = (*eye_m_)[point(v)];
        const bool at_bank = own.bank > 0.0f || own.fade > 0.0f;
        const float most_m = at_bank ? kOffAtBank_m : std::clamp(kOff * away, kLeastOff_m, kMostOff_m);
        const float most_turned = kTurned + kTurnedFar * away;
        float most = 0.0f;
        for (std::size_t j = first_depth_; j < kDepths_m.size(); ++j) {
            const SnowShape& shape = snow_->shapes[j];
            const auto mean = [&](const std::vector<vec3>& list) { return b0 * list[point(a)] + b1 * list[point(b)] + b2 * list[point(c)]; };
            const float off_m = std::abs(mean(shape.positions).y - shape.positions[point(v)].y);
            const float turned = glm::distance(glm::normalize(mean(shape.normals)), shape.normals[point(v)]);
            most = std::max({most, off_m / most_m, turned / most_turned});
        }
        return most;
    }

    bool leave_out(std::uint32_t v)
    {
        if (!find_ring(v)) return false;
        within_ = {v};
        for (const std::uint32_t t : around_[v]) within_.insert(within_.end(), triangles_[t].within.begin(), triangles_[t].within.end());
        float best = share_;
        std::size_t to = ring_.size();
        for (std::size_t u = 0; u < ring_.size(); ++u) {
            if (!is_fan(u)) continue;
            float most = 0.0f;
            for (std::size_t i = 0; i < within_.size() && most < best; ++i) most = std::max(most, off(within_[i], u));
            if (!(most < best)) continue;
            best = most;
            to = u;
        }
        if (to == ring_.size()) return false;
        const std::uint32_t u = ring_[to];
        std::vector<std::vector<std::uint32_t>> shared(ring_.size());
        for (const std::uint32_t w : within_) shared[place_in_fan(w, to).triangle].push_back(w);
        for (const std::uint32_t t : around_[v]) {
            Triangle& triangle = triangles_[t];
            auto& c = triangle.corner;
            if (c[0] == u || c[1] == u || c[2] == u) {
                for (const std::uint32_t r : c)
                    if (r != v) std::erase(around_[r], t);
                triangle.size = 0;
                continue;
            }
            const std::size_t k = c[0] == v ? 0 : c[1] == v ? 1 : 2;
            const auto first = static_cast<std::size_t>(std::find(ring_.begin(), ring_.end(), c[(k + 1) % 3]) - ring_.begin());
            triangle.within = std::move(shared[(first + ring_.size() - to) % ring_.size()]);
            c[k] = u;
            around_[u].push_back(t);
        }
        around_[v].clear();
        return true;
    }

    const SnowCaps* caps_;
    const SnowCaps::Part* part_;
    const Snow* snow_;
    const std::vector<float>* eye_m_;
    std::vector<std::uint32_t> corners_;
    std::vector<Triangle> triangles_;
    std::vector<std::vector<std::uint32_t>> around_;
    std::vector<bool> free_;
    std::size_t first_depth_ = 0;
    float share_ = 0.0f;
    std::vector<std::uint32_t> ring_, within_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> next_;
};

// Which points may be left out at all: of one corner and one piece, within snow that hides what is below from the first level on,
// as all of their neighbours are.
std::vector<bool> free_points(const SnowCaps& caps, const SnowLevels& levels, const SnowShape& least)
{
    const std::size_t count = caps.points.size();
    std::vector<std::uint32_t> corner(count, SnowCaps::kNone), piece(count, SnowCaps::kNone);
    std::vector<bool> free(count, true);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> ways;
    for (std::uint32_t k = 0; k < levels.pieces.size(); ++k) {
        const SnowLevels::Range& whole = levels.pieces[k].levels[0];
        for (std::uint32_t i = whole.first_index; i < whole.first_index + whole.index_count; ++i) {
            const std::uint32_t c = levels.indices[i], p = caps.corner_points[c];
            if ((corner[p] != SnowCaps::kNone && corner[p] != c) || (piece[p] != SnowCaps::kNone && piece[p] != k)) free[p] = false;
            corner[p] = c;
            piece[p] = k;
            const std::uint32_t first = whole.first_index + (i - whole.first_index) / 3 * 3;
            const std::uint32_t next = caps.corner_points[levels.indices[i + 1 < first + 3 ? i + 1 : first]];
            ways[{std::min(p, next), std::max(p, next)}] += p < next ? 1 : -1;
        }
    }
    std::vector<bool> deep(count);
    for (std::size_t i = 0; i < count; ++i) {
        const vec3 lift = least.positions[i] - caps.points[i].base_m;
        deep[i] = lift.y > 1.05f * kHidesGround_m && std::max(std::abs(lift.x), std::abs(lift.z)) < 0.5f * kUpright_m;
    }
    for (const auto& [edge, way] : ways)
        if (way != 0) deep[edge.first] = deep[edge.second] = false;
    for (std::size_t k = 0; k + 2 < levels.indices.size(); k += 3) {
        const std::array t{caps.corner_points[levels.indices[k]], caps.corner_points[levels.indices[k + 1]], caps.corner_points[levels.indices[k + 2]]};
        if (!deep[t[0]] || !deep[t[1]] || !deep[t[2]])
            for (const std::uint32_t i : t) free[i] = false;
    }
    return free;
}

}  // namespace

std::size_t SnowLevels::level_at(float least_depth_m)
{
    std::size_t level = 0;
    while (level < kCoarser && least_depth_m >= kFrom_m[level]) ++level;
    return level;
}

SnowLevels build_snow_levels(const SnowCaps& caps, const std::vector<vec3>& eyes_m)
{
    SnowLevels levels;
    std::map<std::tuple<std::uint32_t, int, int>, std::vector<std::uint32_t>> cells;  // indices, of a part's square
    for (std::uint32_t number = 0; number < caps.parts.size(); ++number) {
        const SnowCaps::Part& part = caps.parts[number];
        for (std::uint32_t k = part.first_index; k < part.first_index + part.index_count; k += 3) {
            vec3 middle(0.0f);
            for (std::uint32_t c = 0; c < 3; ++c) middle += caps.points[caps.corner_points[caps.indices[k + c]]].base_m / 3.0f;
            auto& cell = cells[{number, static_cast<int>(std::floor(middle.x / kPiece_m)), static_cast<int>(std::floor(middle.z / kPiece_m))}];
            cell.insert(cell.end(), caps.indices.begin() + k, caps.indices.begin() + k + 3);
        }
    }
    for (const auto& [cell, indices] : cells) {
        SnowLevels::Piece piece;
        piece.part = std::get<0>(cell);
        piece.levels[0] = {static_cast<std::uint32_t>(levels.indices.size()), static_cast<std::uint32_t>(indices.size())};
        levels.indices.insert(levels.indices.end(), indices.begin(), indices.end());
        levels.pieces.push_back(piece);
    }
    Snow snow;
    for (const float depth_m : kDepths_m) snow.shapes.push_back(snow_shape(caps, std::vector<float>(caps.points.size(), depth_m)));
    std::vector<bool> free = free_points(caps, levels, snow.shapes.front());
    std::vector<float> eye_m(caps.points.size(), eyes_m.empty() ? 0.0f : 1.0e30f);
    for (std::size_t i = 0; i < eye_m.size(); ++i)
        for (const vec3& eye : eyes_m) eye_m[i] = std::min(eye_m[i], glm::distance(eye, caps.points[i].base_m));
    for (SnowLevels::Piece& piece : levels.pieces) {
        const auto whole = levels.indices.begin() + piece.levels[0].first_index;
        Thinned mesh(caps, caps.parts[piece.part], snow, {whole, whole + piece.levels[0].index_count}, free, eye_m);
        for (std::size_t level = 0; level < SnowLevels::kCoarser; ++level) {
            mesh.coarsen(kFirstDepth[level]);
            SnowLevels::Range& range = piece.levels[1 + level];
            range.first_index = static_cast<std::uint32_t>(levels.indices.size());
            mesh.append(levels.indices);
            range.index_count = static_cast<std::uint32_t>(levels.indices.size()) - range.first_index;
        }
    }
    return levels;
}

}  // namespace petrichor::scene
