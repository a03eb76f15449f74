#include "scene/snow/detail/borders.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "formulas/weather/surface_weather.h"

namespace petrichor::scene::detail {
namespace {

using glm::vec2;
using glm::vec3;

constexpr float kPiece_m = 0.25f;
constexpr float kCell_m = EdgeGrid::kReach_m;
constexpr float kStep_m = 0.05f;  // what is no lower goes on, in a street; ..
constexpr float kStepOfSize = 0.02f;  // .. of a small model, of its size: its steps are its shape

constexpr float kLowStep = 0.25f;  // of that step: lower ones are joints

constexpr float kWidestGap_m = 0.14f;
constexpr float kNarrowSlot_m = 0.008f;
constexpr float kWidestBar_m = 0.05f;
constexpr float kBevel_m = 0.03f;
constexpr float kBesideJoint_m = 0.03f;
constexpr float kOver_m = 0.12f;    // rays start so high
constexpr float kTooth_m = 0.03f;   // sides as short are teeth of a border, which runs as it does over twice that ..
constexpr float kToothless = 0.5f;  // .. unless it turns back within that

float size_m(const Tracer& tracer)
{
    const vec3 size = tracer.triangles().high() - tracer.triangles().low();
    return std::max(size.x, std::max(size.y, size.z));
}

float step_m(const Tracer& tracer) { return std::min(kStep_m, kStepOfSize * size_m(tracer)); }

// Ground at a place, or a step up.
bool ground_at(const Tracer& tracer, const vec3& at)
{
    return tracer.blocked({at + vec3(0.0f, kOver_m, 0.0f), vec3(0.0f, -1.0f, 0.0f), kOver_m + step_m(tracer)});
}

// How far below a border the ground beyond it lies; kDeepDrop_m where there is none.
float drop_beyond_m(const Tracer& tracer, const vec3& at, const vec2& out)
{
    const vec3 from = at + vec3(out.x, 0.0f, out.y) * kBeyond_m + vec3(0.0f, kOver_m, 0.0f);
    const RayHit hit = tracer.nearest({from, vec3(0.0f, -1.0f, 0.0f), kOver_m + kDeepDrop_m});
    return hit.hit() ? hit.distance_m - kOver_m : kDeepDrop_m;
}

// Whether a border looks along the joint between two blocks: ground on both sides of where it looks.
bool at_a_joint(const Tracer& tracer, const vec3& at, const vec2& out, const vec3& along)
{
    const vec3 there = at + vec3(out.x, 0.0f, out.y) * kBeyond_m;
    return ground_at(tracer, there + along * kBesideJoint_m) && ground_at(tracer, there - along * kBesideJoint_m);
}

std::uint64_t cell_of(int x, int z)
{
    return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) << 32) |
           static_cast<std::uint32_t>(z);
}

int cell_along(float v)
{
    return static_cast<int>(std::floor(v / kCell_m));
}

}  // namespace

float small_model(const Tracer& tracer)
{
    constexpr float kStreet_m = kStep_m / kStepOfSize;
    return 1.0f - shared::smooth_edge(0.5f * kStreet_m, kStreet_m, size_m(tracer));
}

Beyond beyond(const Tracer& tracer, const vec3& at, const vec2& out)
{
    const vec3 way(out.x, 0.0f, out.y);
    // A wall that rises just behind the edge.
    if (tracer.blocked({at + vec3(0.0f, 0.06f, 0.0f) - way * 0.03f, way, 0.1f})) return Beyond::Wall;
    return ground_at(tracer, at + way * kBeyond_m) ? Beyond::Ground : Beyond::Nothing;
}

float gap_beyond_m(const Tracer& tracer, const vec3& at, const vec2& out)
{
    for (float gap = 0.06f; gap < kWidestGap_m + 0.001f; gap += 0.02f) {
        if (ground_at(tracer, at + vec3(out.x, 0.0f, out.y) * gap)) return gap;
    }
    return 1.0e9f;
}

namespace {

// Whether a border is that of a bar over lower ground, along a slot to another one as high as it is.
bool at_a_bar(const Tracer& tracer, const vec3& at, const vec2& out)
{
    const float level = kLowStep * step_m(tracer);
    enum class Height { Lower, Same, Higher };
    const auto height = [&](float gap) {
        const vec3 from = at + vec3(out.x, 0.0f, out.y) * gap + vec3(0.0f, kOver_m, 0.0f);
        const RayHit hit = tracer.nearest({from, vec3(0.0f, -1.0f, 0.0f), kOver_m + level});
        return !hit.hit() ? Height::Lower : hit.distance_m > kOver_m - level ? Height::Same : Height::Higher;
    };
    if (height(kNarrowSlot_m) != Height::Lower) return false;
    bool narrow = false;
    for (float width = 2.0f * kNarrowSlot_m; width < kWidestBar_m && !narrow; width += kNarrowSlot_m) narrow = height(-width) == Height::Lower;
    if (!narrow) return false;
    for (float gap = 2.0f * kNarrowSlot_m; gap < kWidestGap_m; gap += kNarrowSlot_m)
        if (const Height there = height(gap); there != Height::Lower) return there == Height::Same;
    return false;
}

struct Side {
    vec3 from, to, inner;
    int triangles = 0;

    // Out of its triangle, as long as the side is in plan.
    vec2 out() const
    {
        const vec3 along = to - from, inwards = inner - from;
        const vec2 across(along.z, -along.x);
        return glm::dot(across, vec2(inwards.x, inwards.z)) > 0.0f ? -across : across;
    }
};
// By points, in order: the same for any machine.
using Sides = std::map<std::pair<std::uint32_t, std::uint32_t>, Side>;

// Which way a border runs that is cut in teeth: as the sum of its sides around one, up to kTooth_m along it to either end.
class Teeth {
public:
    explicit Teeth(const Sides& sides) : sides_(&sides)
    {
        for (const auto& [key, side] : sides) {
            if (side.triangles != 1) continue;
            at_[key.first].push_back(key.second);
            at_[key.second].push_back(key.first);
        }
    }
    // Not unit.
    vec2 out(const std::pair<std::uint32_t, std::uint32_t>& key) const
    {
        const Side& own = sides_->at(key);
        vec2 sum = own.out();
        for (const auto& [end, other] : {key, std::pair(key.second, key.first)}) {
            std::uint32_t at = end, before = other;
            for (float left = kTooth_m - 0.5f * glm::length(own.out()); left > 0.0f;) {
                const std::vector<std::uint32_t>& next = at_.at(at);
                if (next.size() != 2) break;  // it ends or forks
                const std::uint32_t to = next[0] == before ? next[1] : next[0];
                if (to == key.first || to == key.second) break;
                const vec2 out = sides_->at({std::min(at, to), std::max(at, to)}).out();
                const float length = glm::length(out);
                sum += length > left ? out * (left / length) : out;
                left -= length;
                before = at;
                at = to;
            }
        }
        return sum;
    }

private:
    const Sides* sides_;
    std::map<std::uint32_t, std::vector<std::uint32_t>> at_;  // of each point: the other ends of the sides there
};

}  // namespace

Borders borders_of(const CutMesh& mesh, const Tracer& tracer)
{
    Sides sides;
    for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
        const Primitive& p = mesh.primitives[i];
        for (std::size_t k = 0; k < p.indices.size(); ++k) {
            const std::size_t first = k - k % 3;
            const std::uint32_t a = p.indices[k];
            const std::uint32_t b = p.indices[first + (k + 1) % 3];
            const std::uint32_t c = p.indices[first + (k + 2) % 3];
            const std::uint32_t pa = mesh.points[i][a], pb = mesh.points[i][b];
            Side& border = sides[{std::min(pa, pb), std::max(pa, pb)}];
            if (border.triangles++ == 0)
                border = {p.positions[a], p.positions[b], p.positions[c], 1};
        }
    }
    Borders borders;
    const Teeth teeth(sides);
    for (const auto& [key, border] : sides) {
        if (border.triangles != 1) continue;
        const vec3 along = border.to - border.from;
        vec2 out = border.out();
        const float length = glm::length(out);
        if (!(length > 1.0e-5f)) continue;
        if (length < kTooth_m) {
            const vec2 of_border = teeth.out(key);
            if (glm::length(of_border) > kToothless * kTooth_m) out = of_border;
        }
        out /= glm::length(out);
        const int pieces = std::max(1, static_cast<int>(std::ceil(glm::length(along) / kPiece_m)));
        for (int k = 0; k < pieces; ++k) {
            const auto at = [&, from = border.from](float t) {
                return from + along * (t / static_cast<float>(pieces));
            };
            const auto f = static_cast<float>(k);
            const vec3 middle = at(f + 0.5f);
            Border piece{at(f), at(f + 1.0f), out};
            Beyond there = beyond(tracer, middle, out);
            const bool joint = there == Beyond::Nothing && at_a_joint(tracer, middle, out, along / glm::length(along));
            if (joint) there = Beyond::Ground;
            if (there != Beyond::Wall) piece.drop_m = drop_beyond_m(tracer, middle, out);
            // The bevelled corner of a block looks over the end of the next: that is no slot.
            if (there == Beyond::Nothing && glm::length(along) > kBevel_m) piece.gap_m = gap_beyond_m(tracer, middle, out);
            auto& list = there != Beyond::Nothing ? borders.closed
                         : piece.gap_m < 1.0f     ? borders.slots
                                                  : borders.open;
            list.push_back(piece);
            if (there == Beyond::Ground && !joint && glm::length(along) > kBevel_m && at_a_bar(tracer, middle, out)) borders.bars.push_back(piece);
            if (there == Beyond::Ground && !joint && piece.drop_m > kLowStep * step_m(tracer)) borders.low.push_back(piece);
        }
    }
    return borders;
}

EdgeGrid::EdgeGrid(std::vector<Border> edges) : edges_(std::move(edges))
{
    for (std::uint32_t i = 0; i < edges_.size(); ++i) {
        const Border& e = edges_[i];
        const vec3 low = glm::min(e.from, e.to) - kReach_m;
        const vec3 high = glm::max(e.from, e.to) + kReach_m;
        for (int z = cell_along(low.z); z <= cell_along(high.z); ++z) {
            for (int x = cell_along(low.x); x <= cell_along(high.x); ++x)
                cells_[cell_of(x, z)].push_back(i);
        }
    }
}

NearEdge EdgeGrid::nearest(const vec3& place, const vec3& normal) const
{
    NearEdge best;
    const auto cell = cells_.find(cell_of(cell_along(place.x), cell_along(place.z)));
    if (cell == cells_.end()) return best;
    for (const std::uint32_t i : cell->second) {
        const Border& e = edges_[i];
        const vec3 along = e.to - e.from;
        const float t = std::clamp(
            glm::dot(place - e.from, along) / std::max(glm::dot(along, along), 1.0e-12f), 0.0f, 1.0f);
        const vec3 way = e.from + along * t - place;
        const float distance = glm::length(way);
        // Not of a kerb above or below.
        if (std::abs(glm::dot(way, normal)) > 0.02f + 0.12f * distance) continue;
        if (distance < best.distance_m) best = {distance, &e};
    }
    if (best.distance_m > kReach_m) return {};
    return best;
}

}  // namespace petrichor::scene::detail
