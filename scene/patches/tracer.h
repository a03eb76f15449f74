#ifndef PETRICHOR_SCENE_PATCHES_TRACER_H
#define PETRICHOR_SCENE_PATCHES_TRACER_H

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <span>
#include <vector>

#include "scene/patches/triangles.h"

namespace petrichor::scene {

struct Ray {
    glm::vec3 origin{0.0f};
    glm::vec3 direction{0.0f, 1.0f, 0.0f};  ///< unit
    float longest_m = std::numeric_limits<float>::max();
};

struct RayHit {
    static constexpr std::uint32_t kNothing = 0xffffffffu;
    std::uint32_t triangle = kNothing;
    float distance_m = std::numeric_limits<float>::max();
    Barycentric at;
    bool back = false;  ///< the ray came from behind the triangle

    bool hit() const { return triangle != kNothing; }
};

/// Rays against triangles: a tree of boxes split by the surface area heuristic (16 bins), four
/// children a node, triangles by Moeller and Trumbore 1997 with an exact division, holes by alpha.
/// Of several triangles at the same distance the one with the lowest number counts, so that a hit
/// does not depend on the tree. Only additions, multiplications, divisions and comparisons: the
/// same bits on every machine.
class Tracer {
public:
    /// The triangles must outlive the tracer. Built by one thread, about 1 us a triangle.
    explicit Tracer(const Triangles& triangles);

    /// The nearest triangle, from both sides.
    RayHit nearest(const Ray& ray) const;
    /// What a ray met last: the next one is asked to meet that first.
    struct Blocker {
        std::uint32_t packet = RayHit::kNothing;
    };

    /// Whether anything lies on the ray. Rays that follow each other and share a `last` cost less, and answer the same.
    bool blocked(const Ray& ray, Blocker* last = nullptr) const;
    /// Whether anything lies between two points, `margin_m` before each left out.
    bool blocked_between(glm::vec3 from, glm::vec3 to, float margin_m = 1e-4f, Blocker* last = nullptr) const;

    /// What each of many rays meets, as if it were asked alone. Rays that start near each other go down the tree together
    /// for a fraction of the work.
    void nearest(std::span<const Ray> rays, std::span<RayHit> hits) const;
    void blocked(std::span<const Ray> rays, std::span<bool> blocked) const;

    /// Triangles whose boxes meet a box, by number.
    std::vector<std::uint32_t> within(glm::vec3 low, glm::vec3 high) const;

    const Triangles& triangles() const { return *triangles_; }

private:
    // Four children's boxes lie in their parent, side by side: one instruction looks at all.
    struct Node {
        float low[3][4], high[3][4];
        std::uint32_t child[4];  // number of a node, or of the first of a leaf's packets
        std::uint32_t count[4];  // packets of a leaf; 0: a node
    };
    // Four triangles of a leaf; what is left over has no area.
    struct Packet {
        float corner[3][4], edge1[3][4], edge2[3][4];
        std::uint32_t triangle[4];
    };
    struct Builder;
    struct Way;
    struct Bundle;
    template <bool kAny>
    RayHit trace(const Ray& ray, Blocker* last) const;
    template <bool kAny>
    void walk(std::uint32_t from, const Way& way, RayHit& best, Blocker* last) const;
    template <bool kAny>
    void descend(Bundle& bundle) const;
    void descend_nearest(Bundle& bundle) const;
    void descend_any(Bundle& bundle) const;
    template <class Descend, class Answer>
    void in_bundles(std::span<const Ray> rays, const Descend& descend_all, const Answer& answer) const;
    static constexpr int kDeepest = 96;

    const Triangles* triangles_ = nullptr;
    std::vector<Node> nodes_;
    std::vector<Packet> packets_;
};

}  // namespace petrichor::scene

#endif
