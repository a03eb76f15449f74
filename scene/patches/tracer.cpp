#include "scene/patches/tracer.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "scene/patches/detail/cells.h"
#include "scene/patches/detail/four.h"

namespace petrichor::scene {
namespace {

// Whether a packet holds what is nearer than `best`; with kAny the first that is found will do.
template <bool kAny, class Packet>
__attribute__((always_inline)) inline bool meet(const Packet& faces, const Triangles& triangles, const Four3& origin, const Four3& direction,
                 RayHit& best)
{
    const Four3 edge1 = four3(faces.edge1), edge2 = four3(faces.edge2);
    const Four3 corner = four3(faces.corner);
    const Four3 p = cross(direction, edge2);
    const Four determinant = dot(edge1, p);
    const Four3 s = origin - corner;
    const Four u = dot(s, p);
    const Four3 q = cross(s, edge1);
    const Four v = dot(direction, q);
    const Four zero = all(0.0f);
    const Signs inside = ((determinant > zero) & (u >= zero) & (v >= zero) & (u + v <= determinant)) |
                         ((determinant < zero) & (u <= zero) & (v <= zero) & (u + v >= determinant));
    if (none(inside)) return false;
    const Four along = dot(edge2, q);
    bool met = false;
    for (int k = 0; k < 4; ++k) {
        if (inside[k] == 0) continue;
        const float distance = along[k] / determinant[k];
        if (!(distance > 0.0f) || distance > best.distance_m) continue;
        const std::uint32_t triangle = faces.triangle[k];
        if (distance == best.distance_m && triangle > best.triangle) continue;
        const Barycentric place{u[k] / determinant[k], v[k] / determinant[k]};
        if (triangles.flags(triangle) & kTriangleMasked) {
            if (triangles.is_hole(triangle, place)) continue;
        }
        best = {triangle, distance, place, determinant[k] < 0.0f};
        met = true;
        if (kAny) return true;
    }
    return met;
}

}  // namespace

// A ray as boxes and triangles want it.
struct Tracer::Way {
    Four3 origin, direction, inverse;
    bool falling[3];
};

namespace {

// Not exactly along an axis: 0 * infinity would be no number.
float inverse_of(float d)
{
    return 1.0f / (std::abs(d) < 1e-20f ? std::copysign(1e-20f, d) : d);
}

// Both may be off by rounding.
constexpr float kBeyond = 1.000001f;

}  // namespace

// What is nearer than `best`, below a node.
template <bool kAny>
__attribute__((always_inline)) inline void Tracer::walk(std::uint32_t from, const Way& way, RayHit& best, Blocker* last) const
{
    struct Waiting {
        std::uint32_t node;
        float entry;
    };
    std::array<Waiting, 3 * kDeepest + 4> stack;
    std::size_t depth = 0;
    std::uint32_t at = from;
    const Four start[3] = {way.origin.x, way.origin.y, way.origin.z};
    const Four inverse[3] = {way.inverse.x, way.inverse.y, way.inverse.z};
    for (;;) {
        const Node& node = nodes_[at];
        // Where the ray enters each box, and leaves it.
        Four near = all(0.0f), far = all(best.distance_m);
        for (int k = 0; k < 3; ++k) {
            const Four low = (four(node.low[k]) - start[k]) * inverse[k];
            const Four high = (four(node.high[k]) - start[k]) * inverse[k];
            near = larger(way.falling[k] ? high : low, near);
            far = smaller(way.falling[k] ? low : high, far);
        }
        const Signs meets = (near <= far * all(kBeyond)) & (near <= all(best.distance_m));
        if (!none(meets)) {
            // Those that are met, nearest first.
            std::uint32_t lane_of[4];
            int found = 0;
            for (std::uint32_t lane = 0; lane < 4; ++lane) {
                if (meets[lane] == 0) continue;
                int place = found++;
                for (; place > 0 && near[lane_of[place - 1]] > near[lane]; --place)
                    lane_of[place] = lane_of[place - 1];
                lane_of[place] = lane;
            }
            int inner = 0;
            for (int f = 0; f < found; ++f) {
                const std::uint32_t lane = lane_of[f];
                if (node.count[lane] == 0) {
                    lane_of[inner++] = lane;
                    continue;
                }
                if (near[lane] > best.distance_m) continue;
                const std::uint32_t first = node.child[lane];
                for (std::uint32_t i = first; i < first + node.count[lane]; ++i) {
                    if (meet<kAny>(packets_[i], *triangles_, way.origin, way.direction, best) && kAny) {
                        if (last) last->packet = i;
                        return;
                    }
                }
            }
            // Inner ones: the further wait.
            for (int k = inner - 1; k > 0; --k)
                stack[depth++] = {node.child[lane_of[k]], near[lane_of[k]]};
            if (inner > 0 && near[lane_of[0]] <= best.distance_m) {
                at = node.child[lane_of[0]];
                continue;
            }
        }
        do {
            if (depth == 0) return;
            --depth;
        } while (!(stack[depth].entry <= best.distance_m));
        at = stack[depth].node;
    }
}

template <bool kAny>
__attribute__((always_inline)) inline RayHit Tracer::trace(const Ray& ray, Blocker* last) const
{
    RayHit best;
    best.distance_m = ray.longest_m;
    if (nodes_.empty()) return best;
    Way way{all3(ray.origin), all3(ray.direction), {}, {}};
    if (kAny && last && last->packet < packets_.size()) {
        if (meet<kAny>(packets_[last->packet], *triangles_, way.origin, way.direction, best)) return best;
    }
    const glm::vec3 inverse{inverse_of(ray.direction.x), inverse_of(ray.direction.y), inverse_of(ray.direction.z)};
    way.inverse = all3(inverse);
    for (int k = 0; k < 3; ++k) way.falling[k] = inverse[k] < 0.0f;
    walk<kAny>(0, way, best, last);
    return best;
}

PETRICHOR_ALSO_AVX RayHit Tracer::nearest(const Ray& ray) const
{
    return trace<false>(ray, nullptr);
}

PETRICHOR_ALSO_AVX bool Tracer::blocked(const Ray& ray, Blocker* last) const
{
    return trace<true>(ray, last).hit();
}

// Rays that go down the tree together.
struct Tracer::Bundle {
    static constexpr std::size_t kMost = 128;
    struct One {
        glm::vec3 origin;
        float distance_m;  // of what it met; less than none: it wants nothing more
        glm::vec3 inverse;
    };
    std::array<One, kMost> rays;
    std::span<const Ray> asked;
    std::array<RayHit, kMost> best;
    glm::vec3 middle;  // of the origins
};

// A node's children are met by all rays that reached the node, and each goes on with those that met it; what is nearer to
// the middle of the origins is nearer to most rays.
template <bool kAny>
__attribute__((always_inline)) inline void Tracer::descend(Bundle& bundle) const
{
    constexpr std::size_t kFew = 1;  // go down alone
    using Number = std::uint8_t;
    struct Waiting {
        std::uint32_t node;
        std::uint32_t first, count;  // in `numbers`
        std::uint32_t free;
    };
    std::array<Waiting, 3 * kDeepest + 4> stack;
    std::array<Number, std::size_t{4} * (kDeepest + 1) * Bundle::kMost> numbers;
    const std::size_t all_of = bundle.asked.size();
    for (std::size_t r = 0; r < all_of; ++r) numbers[r] = static_cast<Number>(r);
    std::size_t depth = 0;
    stack[depth++] = {0, 0, static_cast<std::uint32_t>(all_of), static_cast<std::uint32_t>(all_of)};
    const Four3 middle = all3(bundle.middle);
    while (depth > 0) {
        const Waiting work = stack[--depth];
        const Node& node = nodes_[work.node];
        const Number* const own = numbers.data() + work.first;
        if (work.count <= kFew) {
            for (std::uint32_t k = 0; k < work.count; ++k) {
                const Bundle::One& one = bundle.rays[own[k]];
                if (kAny && one.distance_m < 0.0f) continue;
                const Ray& ray = bundle.asked[own[k]];
                Way way{all3(ray.origin), all3(ray.direction), all3(one.inverse), {}};
                for (int axis = 0; axis < 3; ++axis) way.falling[axis] = one.inverse[axis] < 0.0f;
                RayHit& best = bundle.best[own[k]];
                walk<kAny>(work.node, way, best, nullptr);
                bundle.rays[own[k]].distance_m = kAny && best.hit() ? -1.0f : best.distance_m;
            }
            continue;
        }
        const Four3 low = four3(node.low), high = four3(node.high);
        // How many met each child, and which.
        std::array<std::uint32_t, 4> count{};
        Number* const to = numbers.data() + work.free;
        std::array<Number*, 4> end{to, to + work.count, to + 2 * work.count, to + 3 * work.count};
        for (std::uint32_t k = 0; k < work.count; ++k) {
            const Number r = own[k];
            const Bundle::One& one = bundle.rays[r];
            const Four3 start = all3(one.origin), inverse = all3(one.inverse);
            const Four x0 = (low.x - start.x) * inverse.x, x1 = (high.x - start.x) * inverse.x;
            const Four y0 = (low.y - start.y) * inverse.y, y1 = (high.y - start.y) * inverse.y;
            const Four z0 = (low.z - start.z) * inverse.z, z1 = (high.z - start.z) * inverse.z;
            const Four longest = all(one.distance_m);
            const Four near = larger(larger(smaller(x0, x1), smaller(y0, y1)), larger(smaller(z0, z1), all(0.0f)));
            const Four far = smaller(smaller(larger(x0, x1), larger(y0, y1)), smaller(larger(z0, z1), longest));
            const std::uint32_t bits = bits_of((near <= far * all(kBeyond)) & (near <= longest));
            *end[0] = r, end[0] += bits & 1u;
            *end[1] = r, end[1] += bits >> 1 & 1u;
            *end[2] = r, end[2] += bits >> 2 & 1u;
            *end[3] = r, end[3] += bits >> 3;
        }
        for (std::size_t lane = 0; lane < 4; ++lane)
            count[lane] = static_cast<std::uint32_t>(end[lane] - (to + lane * work.count));
        const Four zero = all(0.0f);
        const Four3 off{larger(larger(low.x - middle.x, middle.x - high.x), zero), larger(larger(low.y - middle.y, middle.y - high.y), zero),
                        larger(larger(low.z - middle.z, middle.z - high.z), zero)};
        const Four distance2 = dot(off, off);
        std::uint32_t lane_of[4];
        int found = 0;
        for (std::uint32_t lane = 0; lane < 4; ++lane) {
            if (count[lane] == 0) continue;
            int place = found++;
            for (; place > 0 && distance2[lane_of[place - 1]] > distance2[lane]; --place)
                lane_of[place] = lane_of[place - 1];
            lane_of[place] = lane;
        }
        int inner = 0;
        for (int f = 0; f < found; ++f) {
            const std::uint32_t lane = lane_of[f];
            if (node.count[lane] == 0) {
                lane_of[inner++] = lane;
                continue;
            }
            const Number* const those = to + lane * work.count;
            for (std::uint32_t k = 0; k < count[lane]; ++k) {
                Bundle::One& one = bundle.rays[those[k]];
                if (kAny && one.distance_m < 0.0f) continue;
                const Ray& ray = bundle.asked[those[k]];
                RayHit& best = bundle.best[those[k]];
                const Four3 origin = all3(ray.origin), direction = all3(ray.direction);
                for (std::uint32_t i = node.child[lane]; i < node.child[lane] + node.count[lane]; ++i) {
                    if (!meet<kAny>(packets_[i], *triangles_, origin, direction, best)) continue;
                    one.distance_m = kAny ? -1.0f : best.distance_m;
                    if (kAny) break;
                }
            }
        }
        const std::uint32_t free = work.free + 4 * work.count;
        for (int k = inner - 1; k >= 0; --k) {
            const std::uint32_t lane = lane_of[k];
            stack[depth++] = {node.child[lane], work.free + lane * work.count, count[lane], free};
        }
    }
}

PETRICHOR_ALSO_AVX void Tracer::descend_nearest(Bundle& bundle) const
{
    descend<false>(bundle);
}

PETRICHOR_ALSO_AVX void Tracer::descend_any(Bundle& bundle) const
{
    descend<true>(bundle);
}

// In bundles; what is asked of each answer.
template <class Descend, class Answer>
void Tracer::in_bundles(std::span<const Ray> rays, const Descend& descend_all, const Answer& answer) const
{
    for (std::size_t first = 0; first < rays.size(); first += Bundle::kMost) {
        Bundle bundle;
        bundle.asked = rays.subspan(first, std::min(Bundle::kMost, rays.size() - first));
        bundle.middle = glm::vec3(0.0f);
        for (std::size_t r = 0; r < bundle.asked.size(); ++r) {
            const Ray& ray = bundle.asked[r];
            bundle.rays[r] = {ray.origin, ray.longest_m,
                              {inverse_of(ray.direction.x), inverse_of(ray.direction.y), inverse_of(ray.direction.z)}};
            bundle.best[r] = {};
            bundle.best[r].distance_m = ray.longest_m;
            bundle.middle += ray.origin / static_cast<float>(bundle.asked.size());
        }
        if (!nodes_.empty()) descend_all(bundle);
        for (std::size_t r = 0; r < bundle.asked.size(); ++r) answer(first + r, bundle.best[r]);
    }
}

void Tracer::nearest(std::span<const Ray> rays, std::span<RayHit> hits) const
{
    assert(hits.size() >= rays.size());
    in_bundles(rays, [&](Bundle& b) { descend_nearest(b); }, [&](std::size_t r, const RayHit& hit) { hits[r] = hit; });
}

void Tracer::blocked(std::span<const Ray> rays, std::span<bool> blocked) const
{
    assert(blocked.size() >= rays.size());
    in_bundles(rays, [&](Bundle& b) { descend_any(b); }, [&](std::size_t r, const RayHit& hit) { blocked[r] = hit.hit(); });
}

std::vector<std::uint32_t> Tracer::within(glm::vec3 low, glm::vec3 high) const
{
    std::vector<std::uint32_t> found;
    if (nodes_.empty()) return found;
    std::vector<std::uint32_t> stack{0};
    while (!stack.empty()) {
        const Node& node = nodes_[stack.back()];
        stack.pop_back();
        for (int lane = 0; lane < 4; ++lane) {
            bool meets = true;
            for (int k = 0; k < 3; ++k)
                meets = meets && node.low[k][lane] <= high[k] && node.high[k][lane] >= low[k];
            if (!meets) continue;
            if (node.count[lane] == 0) {
                stack.push_back(node.child[lane]);
                continue;
            }
            for (std::uint32_t i = node.child[lane]; i < node.child[lane] + node.count[lane]; ++i) {
                const Packet& faces = packets_[i];
                for (int f = 0; f < 4; ++f) {
                    bool in = false, apart = false;
                    for (int k = 0; k < 3; ++k) {
                        const float a = faces.corner[k][f], b = a + faces.edge1[k][f], c = a + faces.edge2[k][f];
                        in = in || a != b || a != c;  // what fills up a packet has no area
                        apart = apart || std::min({a, b, c}) > high[k] || std::max({a, b, c}) < low[k];
                    }
                    if (in && !apart) found.push_back(faces.triangle[f]);
                }
            }
        }
    }
    std::sort(found.begin(), found.end());
    return found;
}

bool Tracer::blocked_between(glm::vec3 from, glm::vec3 to, float margin_m, Blocker* last) const
{
    const auto ray = ray_between(from, to, margin_m);
    return ray && blocked(*ray, last);
}

}  // namespace petrichor::scene
