#include "scene/snow/coarser_caps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace petrichor::scene {
namespace {

using glm::vec2;
using glm::vec3;

constexpr int kPasses = 12;
constexpr std::size_t kFew = 1000;      // of so many points, one that a pass leaves out is not worth another
constexpr float kLeastTurn = 0.5f;    // cosine that a triangle may turn by
constexpr float kUnder = 4.0f;        // times as far below the snow as over it, where it would shadow itself ..
constexpr float kAlong = 8.0f;        // .. and along it
// Of snow under which that holds; between them it nearly does.
constexpr std::array kDepths_m{0.02f, 0.06f, 0.15f, 0.32f};
constexpr std::size_t kMostStar = 24;
constexpr std::uint32_t kGone = 0xffffffffu;

struct Triangle {
    std::array<std::uint32_t, 3> corner{kGone, kGone, kGone};  // points
    std::uint32_t part = 0;
    bool gone() const { return corner[0] == kGone; }
};

// Where a point lies on a triangle: shares of its corners.
struct Shares {
    float a = 0.0f, b = 0.0f, c = 0.0f;
};

// Moves points onto neighbours, one by one, where all that lay around lies well then: the shortest way first, and places
// far from each other in turn, so that triangles grow evenly.
class Coarser {
public:
    Coarser(const SnowCaps& caps, const std::vector<vec3>& eyes_m) : caps_(&caps)
    {
        for (const float depth : kDepths_m)
            shapes_.push_back(snow_shape(caps, std::vector<float>(caps.points.size(), depth)));
        for (std::uint32_t i = 0; i < caps.parts.size(); ++i) {
            const SnowCaps::Part& part = caps.parts[i];
            for (std::uint32_t k = 0; k + 2 < part.index_count; k += 3) {
                const std::uint32_t* index = caps.indices.data() + part.first_index + k;
                triangles_.push_back({{caps.corner_points[index[0]], caps.corner_points[index[1]], caps.corner_points[index[2]]}, i});
            }
        }
        held_.resize(triangles_.size());
        risen_m_.resize(triangles_.size());
        stars_.resize(caps.points.size());
        for (std::uint32_t t = 0; t < triangles_.size(); ++t)
            for (const std::uint32_t corner : triangles_[t].corner) stars_[corner].push_back(t);
        over_m_.reserve(caps.points.size());
        for (const SnowCaps::Point& p : caps.points) {
            float away = eyes_m.empty() ? 0.0f : 1.0e30f;
            for (const vec3& eye : eyes_m) away = std::min(away, glm::distance(eye, p.base_m));
            over_m_.push_back(casters_over_m(away));
        }
    }

    void run()
    {
        for (int pass = 0; pass < kPasses; ++pass) {
            rested_.assign(stars_.size(), false);
            std::size_t left_out = 0;
            for (std::uint32_t v = 0; v < stars_.size(); ++v)
                if (!rested_[v] && leave_out(v)) ++left_out;
            if (left_out < stars_.size() / kFew) break;
        }
    }

    std::vector<std::vector<std::uint32_t>> points() const;

private:
    // Ends of the edges at a point, with the triangles at each.
    bool neighbours_of(std::uint32_t v)
    {
        around_.clear();
        for (const std::uint32_t t : stars_[v]) {
            for (const std::uint32_t p : triangles_[t].corner) {
                if (p == v) continue;
                const auto found = std::find_if(around_.begin(), around_.end(), [p](const auto& n) { return n.first == p; });
                if (found == around_.end()) around_.emplace_back(p, 1);
                else ++found->second;
            }
        }
        int ends = 0;
        for (const auto& [p, count] : around_) {
            if (count > 2) return false;  // leaves of a book
            ends += count == 1 ? 1 : 0;
        }
        return ends == 0 || ends == 2;
    }

    bool leave_out(std::uint32_t v)
    {
        if (stars_[v].empty() || stars_[v].size() > kMostStar || !neighbours_of(v)) return false;
        const bool border = std::any_of(around_.begin(), around_.end(), [](const auto& n) { return n.second == 1; });
        std::vector<std::pair<float, std::uint32_t>> ways;
        for (const auto& [u, count] : around_)
            if (!border || count == 1) ways.emplace_back(glm::distance(shapes_.back().positions[u], shapes_.back().positions[v]), u);
        std::sort(ways.begin(), ways.end());
        for (const auto& [length, u] : ways)
            if (merge(v, u)) return true;
        return false;
    }

    bool merge(std::uint32_t v, std::uint32_t u);
    bool keeps_faces(std::uint32_t v, std::uint32_t u) const;
    float rise_m(std::uint32_t v, std::uint32_t u) const;
    bool lies_well(std::uint32_t p, const Triangle& on, const Shares& at) const;
    Shares shares(std::uint32_t p, const Triangle& on) const;

    const SnowCaps* caps_;
    std::vector<SnowShape> shapes_;
    std::vector<Triangle> triangles_;
    std::vector<std::vector<std::uint32_t>> held_;   // of each triangle: points that were left out on it
    std::vector<std::vector<std::uint32_t>> stars_;  // of each point: triangles around it
    std::vector<float> risen_m_;                     // of each triangle: over the snow between points, at most
    std::vector<float> over_m_;  // of each point
    std::vector<bool> rested_;
    std::vector<std::pair<std::uint32_t, int>> around_;
};

// From above, on the ground.
Shares Coarser::shares(std::uint32_t p, const Triangle& on) const
{
    const auto at = [&](std::uint32_t i) { return vec2(caps_->points[i].base_m.x, caps_->points[i].base_m.z); };
    const vec2 a = at(on.corner[0]), b = at(on.corner[1]), c = at(on.corner[2]), x = at(p);
    const auto cross = [](const vec2& s, const vec2& t) { return s.x * t.y - s.y * t.x; };
    const float whole = cross(b - a, c - a);
    if (!(std::abs(whole) > 0.0f)) return {-1.0e9f, 0.0f, 0.0f};
    Shares s;
    s.b = cross(x - a, c - a) / whole;
    s.c = cross(b - a, x - a) / whole;
    s.a = 1.0f - s.b - s.c;
    return s;
}

bool Coarser::lies_well(std::uint32_t p, const Triangle& on, const Shares& at) const
{
    const auto& t = on.corner;
    for (const SnowShape& shape : shapes_) {
        const auto mixed = [&](const auto& values) { return at.a * values[t[0]] + at.b * values[t[1]] + at.c * values[t[2]]; };
        const vec3 away = mixed(shape.positions) - shape.positions[p];
        const vec3& normal = shape.normals[p];
        const float over = glm::dot(away, normal);
        if (!(over <= over_m_[p]) || !(over >= -kUnder * over_m_[p]) || !(glm::length(away) <= kAlong * over_m_[p])) return false;
    }
    return true;
}

// How far triangles would come to lie over those before them between points: where edges from u, as they would be, cross those
// from v. Below them there is room.
float Coarser::rise_m(std::uint32_t v, std::uint32_t u) const
{
    float rise = 0.0f;
    const auto at = [&](std::uint32_t i) { return vec2(caps_->points[i].base_m.x, caps_->points[i].base_m.z); };
    const auto cross = [](const vec2& s, const vec2& t) { return s.x * t.y - s.y * t.x; };
    for (const auto& [w, sides] : around_) {
        if (w == u) continue;
        for (const auto& [x, ends] : around_) {
            if (x == u || x == w) continue;
            const vec2 now = at(w) - at(u), old = at(x) - at(v), way = at(v) - at(u);
            const float turn = cross(now, old);
            if (!(std::abs(turn) > 0.0f)) continue;
            const float s = cross(way, old) / turn, t = cross(way, now) / turn;
            if (!(s > 0.0f && s < 1.0f && t > 0.0f && t < 1.0f)) continue;
            for (const SnowShape& shape : shapes_) {
                const auto& p = shape.positions;
                const float over = glm::mix(p[u].y, p[w].y, s) - glm::mix(p[v].y, p[x].y, t);
                rise = std::max({rise, over, -over / kUnder});
            }
        }
    }
    return rise;
}

bool Coarser::keeps_faces(std::uint32_t v, std::uint32_t u) const
{
    for (const std::uint32_t t : stars_[v]) {
        std::array<std::uint32_t, 3> before{}, after{};
        bool both = false;
        for (std::size_t c = 0; c < 3; ++c) {
            before[c] = after[c] = triangles_[t].corner[c];
            both = both || before[c] == u;
            if (before[c] == v) after[c] = u;
        }
        if (both) continue;
        const auto ground = [&](const std::array<std::uint32_t, 3>& p) {
            const vec3 ab = caps_->points[p[1]].base_m - caps_->points[p[0]].base_m;
            const vec3 ac = caps_->points[p[2]].base_m - caps_->points[p[0]].base_m;
            return ab.z * ac.x - ab.x * ac.z;
        };
        if (!(ground(after) > 1.0e-7f)) return false;
        for (const SnowShape& shape : shapes_) {
            const auto face = [&](const std::array<std::uint32_t, 3>& p) {
                return glm::cross(shape.positions[p[1]] - shape.positions[p[0]], shape.positions[p[2]] - shape.positions[p[0]]);
            };
            const vec3 old = face(before), now = face(after);
            if (!(glm::dot(old, now) >= kLeastTurn * glm::length(old) * glm::length(now))) return false;
        }
    }
    return true;
}

bool Coarser::merge(std::uint32_t v, std::uint32_t u)
{
    // Neighbours that both have are corners of the triangles that go.
    const auto has = [&](std::uint32_t t, std::uint32_t p) {
        const auto& corner = triangles_[t].corner;
        return corner[0] == p || corner[1] == p || corner[2] == p;
    };
    const auto going = std::count_if(stars_[v].begin(), stars_[v].end(), [&](std::uint32_t t) { return has(t, u); });
    if (static_cast<std::size_t>(going) == stars_[v].size()) return false;
    const auto shared = std::count_if(around_.begin(), around_.end(), [&](const auto& n) {
        return n.first != u && std::any_of(stars_[u].begin(), stars_[u].end(), [&](std::uint32_t t) { return has(t, n.first); });
    });
    if (shared != going || !keeps_faces(v, u)) return false;
    // Summed up, for edges are compared with those before them.
    float rise = 0.0f;
    for (const std::uint32_t t : stars_[v]) rise = std::max(rise, risen_m_[t]);
    rise += rise_m(v, u);
    if (!(rise <= over_m_[v])) return false;
    std::vector<std::uint32_t> resting{v};
    std::vector<std::pair<std::uint32_t, Triangle>> stay;
    for (const std::uint32_t t : stars_[v]) {
        resting.insert(resting.end(), held_[t].begin(), held_[t].end());
        if (has(t, u)) continue;
        stay.emplace_back(t, triangles_[t]);
        std::replace(stay.back().second.corner.begin(), stay.back().second.corner.end(), v, u);
    }
    std::vector<std::size_t> homes;
    for (const std::uint32_t p : resting) {
        float best = -1.0e30f;
        std::size_t home = stay.size();
        Shares at;
        for (std::size_t s = 0; s < stay.size(); ++s) {
            const Shares here = shares(p, stay[s].second);
            const float inside = std::min(here.a, std::min(here.b, here.c));
            if (inside > best) {
                best = inside;
                home = s;
                at = here;
            }
        }
        if (home == stay.size()) return false;
        // Beside it: the nearest of its own, nearly.
        at = {std::max(at.a, 0.0f), std::max(at.b, 0.0f), std::max(at.c, 0.0f)};
        const float sum = at.a + at.b + at.c;
        if (!(sum > 0.0f)) return false;
        at = {at.a / sum, at.b / sum, at.c / sum};
        if (!lies_well(p, stay[home].second, at)) return false;
        homes.push_back(home);
    }
    for (const std::uint32_t t : stars_[v]) {
        held_[t].clear();
        for (const std::uint32_t p : triangles_[t].corner) {
            rested_[p] = true;
            if (p == v) continue;
            auto& star = stars_[p];
            star.erase(std::find(star.begin(), star.end(), t));
        }
        triangles_[t] = {};
    }
    stars_[v].clear();
    for (const auto& [t, after] : stay) {
        triangles_[t] = after;
        risen_m_[t] = rise;
        for (const std::uint32_t corner : after.corner) stars_[corner].push_back(t);
    }
    for (std::size_t i = 0; i < resting.size(); ++i) held_[stay[homes[i]].first].push_back(resting[i]);
    return true;
}

std::vector<std::vector<std::uint32_t>> Coarser::points() const
{
    std::vector<std::vector<std::uint32_t>> points(caps_->parts.size());
    for (const Triangle& t : triangles_)
        if (!t.gone()) points[t.part].insert(points[t.part].end(), t.corner.begin(), t.corner.end());
    return points;
}

}  // namespace

float casters_over_m(float away_m)
{
    return std::clamp(0.00038f * away_m, 0.0025f, 0.012f);
}

void add_casters(SnowCaps& caps, const std::vector<vec3>& eyes_m)
{
    if (caps.empty()) return;
    Coarser coarser(caps, eyes_m);
    coarser.run();
    std::vector<std::vector<std::uint32_t>> points = coarser.points();
    for (std::size_t i = 0; i < points.size(); ++i) caps.parts[i].casters = std::move(points[i]);
}

}  // namespace petrichor::scene
