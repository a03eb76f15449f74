#include "scene/patches/tracer.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace petrichor::scene {
namespace {

constexpr int kBins = 16;
constexpr std::uint32_t kLeaf = 4;  // triangles of a leaf that need no thought
constexpr std::uint32_t kLargestLeaf =
    32;  // beyond that a leaf is halved whatever the heuristic says
constexpr std::uint32_t kEmpty = 0xffffffffu;

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

// Of a tree of two children a node, as it is built.
struct Pair {
    Box box[2];
    std::uint32_t child[2];  // number of a pair, or of a first triangle in the order
    std::uint32_t count[2];  // triangles of a leaf; 0: a pair
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
    std::vector<Packet>& packets;
    std::vector<std::uint32_t> order;
    std::vector<Pair> pairs;
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
        const float scale = static_cast<float>(kBins) * 0.9999f / (range.high[best_axis] - low);
        const auto begin = order.begin() + part.first;
        const auto middle = std::stable_partition(begin, begin + part.count, [&](std::uint32_t t) {
            return std::clamp(static_cast<int>((centres[t][best_axis] - low) * scale), 0,
                              kBins - 1) <= best_bin;
        });
        return static_cast<std::uint32_t>(middle - begin);
    }

    // The pair that holds two parts. Explicit stack: scenes can be deep.
    void build()
    {
        struct Work {
            Part part;
            std::uint32_t node;
            int side, depth;
        };
        const auto all = static_cast<std::uint32_t>(order.size());
        pairs.push_back({});
        std::vector<Work> stack;
        const auto place = [&](const Part& part, std::uint32_t node, int side, int depth) {
            pairs[node].box[side] = part.box;
            pairs[node].child[side] = part.first;
            pairs[node].count[side] = part.count;
            if (part.count > kLeaf) stack.push_back({part, node, side, depth});
        };
        place({0, all, box_of(0, all)}, 0, 0, 0);
        // The root has one child.
        pairs[0].box[1] = {};
        pairs[0].child[1] = kEmpty;
        pairs[0].count[1] = 0;
        while (!stack.empty()) {
            const Work work = stack.back();
            stack.pop_back();
            // Degenerate heaps are cut in the middle once the tree is deep.
            const std::uint32_t left = work.depth > kDeepest / 2 && work.part.count > kLargestLeaf
                                           ? work.part.count / 2
                                           : cut(work.part);
            if (left == 0 || work.depth >= kDeepest - 2) continue;
            const auto child = static_cast<std::uint32_t>(pairs.size());
            pairs.push_back({});
            pairs[work.node].child[work.side] = child;
            pairs[work.node].count[work.side] = 0;
            const std::uint32_t first = work.part.first;
            const std::uint32_t right = work.part.count - left;
            place({first, left, box_of(first, left)}, child, 0, work.depth + 1);
            place({first + left, right, box_of(first + left, right)}, child, 1, work.depth + 1);
        }
    }

    // What a node of four is made from: a side of a pair.
    struct Side {
        std::uint32_t pair;
        int side;
    };
    const Box& box(Side s) const { return pairs[s.pair].box[s.side]; }
    std::uint32_t child(Side s) const { return pairs[s.pair].child[s.side]; }
    std::uint32_t count(Side s) const { return pairs[s.pair].count[s.side]; }

    // The largest inner side is opened until there are four.
    int open(std::uint32_t pair, std::array<Side, 4>& sides) const
    {
        int found = 0;
        const auto add = [&](Side s) {
            if (child(s) != kEmpty) sides[static_cast<std::size_t>(found++)] = s;
        };
        add({pair, 0});
        add({pair, 1});
        while (found < 4) {
            int largest = -1;
            for (int k = 0; k < found; ++k) {
                const Side s = sides[static_cast<std::size_t>(k)];
                if (count(s) > 0) continue;
                if (largest < 0 ||
                    box(s).half_area() > box(sides[static_cast<std::size_t>(largest)]).half_area())
                    largest = k;
            }
            if (largest < 0) break;
            const std::uint32_t inner = child(sides[static_cast<std::size_t>(largest)]);
            sides[static_cast<std::size_t>(largest)] = {inner, 0};
            sides[static_cast<std::size_t>(found++)] = {inner, 1};
        }
        return found;
    }

    std::uint32_t pack(std::uint32_t first, std::uint32_t count_of)
    {
        const auto packet = static_cast<std::uint32_t>(packets.size());
        for (std::uint32_t i = 0; i < count_of; ++i) {
            if (i % 4 == 0) packets.push_back({});
            const std::uint32_t t = order[first + i];
            const glm::vec3 a = triangles.corner(t), b = triangles.edge1(t), c = triangles.edge2(t);
            for (int k = 0; k < 3; ++k) {
                packets.back().corner[k][i % 4] = a[k];
                packets.back().edge1[k][i % 4] = b[k];
                packets.back().edge2[k][i % 4] = c[k];
            }
            packets.back().triangle[i % 4] = t;
        }
        return packet;
    }

    // Nodes of four from the pairs.
    void widen()
    {
        struct Work {
            std::uint32_t pair, node;
        };
        nodes.push_back({});
        std::vector<Work> stack{{0, 0}};
        while (!stack.empty()) {
            const Work work = stack.back();
            stack.pop_back();
            std::array<Side, 4> sides{};
            const int found = open(work.pair, sides);
            for (int lane = 0; lane < 4; ++lane) {
                // A lane without a child is a point that no ray reaches.
                Box wide{glm::vec3(std::numeric_limits<float>::max()),
                         glm::vec3(std::numeric_limits<float>::max())};
                std::uint32_t to = 0, many = 1;
                if (lane < found) {
                    const Side s = sides[static_cast<std::size_t>(lane)];
                    wide = widened(box(s));
                    many = (count(s) + 3) / 4;
                    to = many > 0 ? pack(child(s), count(s))
                                  : static_cast<std::uint32_t>(nodes.size());
                    if (many == 0) {
                        nodes.push_back({});
                        stack.push_back({child(s), to});
                    }
                }
                Node& node = nodes[work.node];
                for (int k = 0; k < 3; ++k) {
                    node.low[k][lane] = wide.low[k];
                    node.high[k][lane] = wide.high[k];
                }
                node.child[lane] = to;
                node.count[lane] = many;
            }
        }
    }
};

Tracer::Tracer(const Triangles& triangles) : triangles_(&triangles)
{
    const std::uint32_t count = triangles.size();
    if (count == 0) return;
    Builder builder{triangles, nodes_, packets_, {}, {}, {}, {}};
    builder.order.resize(count);
    builder.boxes.reserve(count);
    builder.centres.reserve(count);
    for (std::uint32_t t = 0; t < count; ++t) {
        builder.order[t] = t;
        Box box;
        const glm::vec3 a = triangles.corner(t);
        box.add(a);
        box.add(a + triangles.edge1(t));
        box.add(a + triangles.edge2(t));
        builder.centres.push_back((box.low + box.high) * 0.5f);
        builder.boxes.push_back(box);
    }
    builder.build();
    builder.widen();
}

}  // namespace petrichor::scene
