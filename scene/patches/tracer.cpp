#include "scene/patches/tracer.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace petrichor::scene {
namespace {

constexpr int kBins = 16;
constexpr std::uint32_t kLeaf = 4;       // triangles of a leaf that need no thought
constexpr std::uint32_t kLargestLeaf = 32;  // beyond that a leaf is halved whatever the heuristic says
constexpr int kDeepest = 96;

struct Box {
    glm::vec3 low{std::numeric_limits<float>::max()};
    glm::vec3 high{std::numeric_limits<float>::lowest()};

    void add(const Box& other)
    {
        low = glm::min(low, other.low);
        high = glm::max(high, other.high);
    }
    void add(const glm::vec3& p)
    {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    float half_area() const
    {
        const glm::vec3 d = high - low;
        if (d.x < 0.0f) return 0.0f;
        return d.x * d.y + d.y * d.z + d.z * d.x;
    }
};

// Further than rounding in the slab test can miss a triangle that lies in the face of its box.
Box widened(const Box& box)
{
    Box wide = box;
    for (int k = 0; k < 3; ++k) {
        const float most = std::max(std::abs(box.low[k]), std::abs(box.high[k]));
        const float margin = most * 4e-7f + 1e-12f;
        wide.low[k] -= margin;
        wide.high[k] += margin;
    }
    return wide;
}

}  // namespace

struct Tracer::Builder {
    const Triangles& triangles;
    std::vector<Node>& nodes;
    std::vector<std::uint32_t>& order;
    std::vector<Box> boxes;
    std::vector<glm::vec3> centres;

    struct Part {
        std::uint32_t first, count;
        Box box;
    };

    Box box_of(std::uint32_t first, std::uint32_t count) const
    {
        Box box;
        for (std::uint32_t i = first; i < first + count; ++i) box.add(boxes[order[i]]);
        return box;
    }

    // Where to cut; count of the left part, 0: keep it whole.
    std::uint32_t cut(const Part& part)
    {
        Box range;
        for (std::uint32_t i = part.first; i < part.first + part.count; ++i)
            range.add(centres[order[i]]);
        float best = static_cast<float>(part.count) * part.box.half_area();
        int best_axis = -1;
        int best_bin = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const float low = range.low[axis];
            const float width = range.high[axis] - low;
            if (!(width > 0.0f)) continue;
            const float scale = static_cast<float>(kBins) * 0.9999f / width;
            std::array<Box, kBins> bin_box;
            std::array<std::uint32_t, kBins> bin_count{};
            for (std::uint32_t i = part.first; i < part.first + part.count; ++i) {
                const std::uint32_t t = order[i];
                const auto b = static_cast<std::size_t>(
                    std::clamp(static_cast<int>((centres[t][axis] - low) * scale), 0, kBins - 1));
                bin_box[b].add(boxes[t]);
                ++bin_count[b];
            }
            std::array<float, kBins> right_cost{};
            Box right;
            std::uint32_t right_count = 0;
            for (std::size_t b = kBins - 1; b > 0; --b) {
                right.add(bin_box[b]);
                right_count += bin_count[b];
                right_cost[b] = static_cast<float>(right_count) * right.half_area();
            }
            Box left;
            std::uint32_t left_count = 0;
            for (std::size_t b = 0; b + 1 < kBins; ++b) {
                left.add(bin_box[b]);
                left_count += bin_count[b];
                if (left_count == 0 || left_count == part.count) continue;
                const float cost = static_cast<float>(left_count) * left.half_area() +
                                   right_cost[b + 1] + part.box.half_area();
                if (cost < best || (part.count > kLargestLeaf && best_axis < 0)) {
                    best = cost;
                    best_axis = axis;
                    best_bin = static_cast<int>(b);
                }
            }
        }
        if (best_axis < 0) return part.count > kLargestLeaf ? part.count / 2 : 0;
        const float low = range.low[best_axis];
        const float scale =
            static_cast<float>(kBins) * 0.9999f / (range.high[best_axis] - low);
        const auto begin = order.begin() + part.first;
        const auto middle = std::stable_partition(
            begin, begin + part.count, [&](std::uint32_t t) {
                return std::clamp(static_cast<int>((centres[t][best_axis] - low) * scale), 0,
                                  kBins - 1) <= best_bin;
            });
        return static_cast<std::uint32_t>(middle - begin);
    }

    // The node that holds two parts. Explicit stack: scenes can be deep.
    void build()
    {
        struct Work {
            Part part;
            std::uint32_t node;
            int side, depth;
        };
        const auto all = static_cast<std::uint32_t>(order.size());
        nodes.push_back({});
        std::vector<Work> stack;
        const auto place = [&](const Part& part, std::uint32_t node, int side, int depth) {
            const Box wide = widened(part.box);
            for (int k = 0; k < 3; ++k) {
                nodes[node].low[side][k] = wide.low[k];
                nodes[node].high[side][k] = wide.high[k];
            }
            nodes[node].child[side] = part.first;
            nodes[node].count[side] = part.count;
            if (part.count > kLeaf) stack.push_back({part, node, side, depth});
        };
        place({0, all, box_of(0, all)}, 0, 0, 0);
        // The root's second side is a point that no ray reaches.
        for (int k = 0; k < 3; ++k) {
            nodes[0].low[1][k] = std::numeric_limits<float>::max();
            nodes[0].high[1][k] = std::numeric_limits<float>::max();
        }
        nodes[0].child[1] = 0;
        nodes[0].count[1] = 1;
        while (!stack.empty()) {
            const Work work = stack.back();
            stack.pop_back();
            // Degenerate heaps are cut in the middle once the tree is deep.
            const std::uint32_t left = work.depth > kDeepest / 2 && work.part.count > kLargestLeaf
                                           ? work.part.count / 2
                                           : cut(work.part);
            if (left == 0 || work.depth >= kDeepest - 2) continue;
            const auto child = static_cast<std::uint32_t>(nodes.size());
            nodes.push_back({});
            nodes[work.node].child[work.side] = child;
            nodes[work.node].count[work.side] = 0;
            const std::uint32_t first = work.part.first;
            const std::uint32_t right = work.part.count - left;
            place({first, left, box_of(first, left)}, child, 0, work.depth + 1);
            place({first + left, right, box_of(first + left, right)}, child, 1, work.depth + 1);
        }
    }
};

Tracer::Tracer(const Triangles& triangles) : triangles_(&triangles)
{
    const std::uint32_t count = triangles.size();
    if (count == 0) return;
    order_.resize(count);
    Builder builder{triangles, nodes_, order_, {}, {}};
    builder.boxes.reserve(count);
    builder.centres.reserve(count);
    for (std::uint32_t t = 0; t < count; ++t) {
        order_[t] = t;
        Box box;
        const glm::vec3 a = triangles.corner(t);
        box.add(a);
        box.add(a + triangles.edge1(t));
        box.add(a + triangles.edge2(t));
        builder.centres.push_back((box.low + box.high) * 0.5f);
        builder.boxes.push_back(box);
    }
    builder.build();
    faces_.reserve(count);
    for (const std::uint32_t t : order_)
        faces_.push_back({triangles.corner(t), triangles.edge1(t), triangles.edge2(t)});
}

namespace {

struct Slabs {
    float origin[3], inverse[3];
};

// Where the ray enters a box, or a number beyond `longest` when it does not.
inline float entry(const float low[3], const float high[3], const Slabs& ray, float longest)
{
    float near = 0.0f;
    float far = longest;
    for (int k = 0; k < 3; ++k) {
        const float a = (low[k] - ray.origin[k]) * ray.inverse[k];
        const float b = (high[k] - ray.origin[k]) * ray.inverse[k];
        const float first = a < b ? a : b;
        const float last = a < b ? b : a;
        near = first > near ? first : near;
        far = last < far ? last : far;
    }
    // Entry and exit may be off by rounding.
    return near <= far * 1.000001f ? near : std::numeric_limits<float>::infinity();
}

}  // namespace

template <bool kAny>
RayHit Tracer::trace(const Ray& ray) const
{
    RayHit best;
    best.distance_m = ray.longest_m;
    if (nodes_.empty()) return best;
    Slabs slabs;
    for (int k = 0; k < 3; ++k) {
        slabs.origin[k] = ray.origin[k];
        // Not exactly along an axis: 0 * infinity would be no number.
        const float d = ray.direction[k];
        slabs.inverse[k] = 1.0f / (std::abs(d) < 1e-20f ? std::copysign(1e-20f, d) : d);
    }
    const glm::vec3 origin = ray.origin, direction = ray.direction;
    struct Waiting {
        std::uint32_t node;
        float entry;
    };
    std::array<Waiting, kDeepest + 2> stack;
    std::size_t depth = 0;
    std::uint32_t at = 0;
    for (;;) {
        const Node& node = nodes_[at];
        const float entries[2] = {entry(node.low[0], node.high[0], slabs, best.distance_m),
                                  entry(node.low[1], node.high[1], slabs, best.distance_m)};
        const int nearer = entries[1] < entries[0] ? 1 : 0;
        std::uint32_t next[2];
        int found = 0;
        for (int k = 0; k < 2; ++k) {
            const int side = k == 0 ? nearer : 1 - nearer;
            if (!(entries[side] <= best.distance_m)) continue;
            if (node.count[side] == 0) {
                next[found++] = static_cast<std::uint32_t>(side);
                continue;
            }
            const std::uint32_t first = node.child[side];
            for (std::uint32_t i = first; i < first + node.count[side]; ++i) {
                const Face& face = faces_[i];
                const glm::vec3 p = glm::cross(direction, face.edge2);
                const float determinant = glm::dot(face.edge1, p);
                if (determinant == 0.0f) continue;
                const glm::vec3 s = origin - face.corner;
                const float u = glm::dot(s, p);
                const glm::vec3 q = glm::cross(s, face.edge1);
                const float v = glm::dot(direction, q);
                if (determinant > 0.0f) {
                    if (u < 0.0f || v < 0.0f || u + v > determinant) continue;
                } else {
                    if (u > 0.0f || v > 0.0f || u + v < determinant) continue;
                }
                const float distance = glm::dot(face.edge2, q) / determinant;
                if (!(distance > 0.0f) || distance > best.distance_m) continue;
                const std::uint32_t triangle = order_[i];
                if (distance == best.distance_m && triangle > best.triangle) continue;
                const Barycentric place{u / determinant, v / determinant};
                if (triangles_->flags(triangle) & kTriangleMasked) {
                    if (triangles_->is_hole(triangle, place)) continue;
                }
                best = {triangle, distance, place, determinant < 0.0f};
                if (kAny) return best;
            }
        }
        // Both inner: the further waits.
        if (found == 2) stack[depth++] = {node.child[next[1]], entries[next[1]]};
        if (found > 0) {
            at = node.child[next[0]];
            continue;
        }
        do {
            if (depth == 0) return best;
            --depth;
        } while (!(stack[depth].entry <= best.distance_m));
        at = stack[depth].node;
    }
}

RayHit Tracer::nearest(const Ray& ray) const
{
    return trace<false>(ray);
}

bool Tracer::blocked(const Ray& ray) const
{
    return trace<true>(ray).hit();
}

bool Tracer::blocked_between(glm::vec3 from, glm::vec3 to, float margin_m) const
{
    const glm::vec3 way = to - from;
    const float length = std::sqrt(glm::dot(way, way));
    if (!(length > 2.0f * margin_m)) return false;
    const glm::vec3 direction = way / length;
    return blocked({from + direction * margin_m, direction, length - 2.0f * margin_m});
}

}  // namespace petrichor::scene
