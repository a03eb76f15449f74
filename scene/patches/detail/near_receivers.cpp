// The points of surfaces that ask a patch for what is close.
#include <algorithm>
#include <array>
#include <cmath>

#include "scene/patches/detail/cells.h"
#include "scene/patches/detail/near_choice.h"
#include "scene/patches/detail/sampling.h"
#include "scene/patches/lookup.h"

namespace petrichor::scene {
namespace {

constexpr std::size_t kFewReceivers = 4;
constexpr float kAlike = 0.9f;          // cosine of two normals
constexpr int kMostAlong = 8;
constexpr float kTowardsEdge = 0.1f;   // of a side's breadth
constexpr float kAtEdge = 0.02f;

// A place of a face's side: its middle, and towards its edges, nearer and nearest.
struct Place {
    SamplePoint middle;
    std::array<std::array<SamplePoint, 2>, 4> edges;
    std::size_t count;  // of edges
};

// Places along a face's side, one a cell.
std::vector<Place> along(const NearFace& face, bool back, float cell_m)
{
    const auto c = corners_of(face.polygon);
    const glm::vec3 u = c[1] - c[0], v = c[2] - c[1];
    const bool by_u = glm::dot(u, u) > glm::dot(v, v);
    const float length = std::sqrt(std::max(glm::dot(u, u), glm::dot(v, v)));
    const int count = std::clamp(static_cast<int>(length / cell_m + 0.5f), 1, kMostAlong);
    const glm::vec3 n = back ? -face.normal : face.normal;
    const auto point = [&](float at, float across) {
        return SamplePoint{by_u ? point_in(c, at, across) : point_in(c, across, at), n};
    };
    std::vector<Place> places;
    for (int k = 0; k < count; ++k) {
        const float at = (static_cast<float>(k) + 0.5f) / static_cast<float>(count);
        Place place{point(at, 0.5f), {}, count == 1 ? std::size_t{4} : std::size_t{2}};
        for (std::size_t e = 0; e < 2; ++e) {
            const float off = e == 0 ? kTowardsEdge : kAtEdge;
            place.edges[0][e] = point(at, off);
            place.edges[1][e] = point(at, 1.0f - off);
            place.edges[2][e] = point(off, 0.5f);
            place.edges[3][e] = point(1.0f - off, 0.5f);
        }
        places.push_back(place);
    }
    return places;
}

// Where no receiver of a leaf faces along with what asks it.
void add_bevels(const Patches& patches, const Tracer& tracer, const NearFaces& faces, const LeafFinder& finder,
                int threads, std::vector<std::vector<SamplePoint>>& receivers)
{
    struct Asks {
        SamplePoint point;
        std::uint32_t leaf;
    };
    const float regular = patches.level_cell_m(1);
    const auto known = [&](const SamplePoint& p, std::uint32_t leaf) {
        return std::any_of(receivers[leaf].begin(), receivers[leaf].end(),
                           [&](const SamplePoint& other) { return glm::dot(other.normal, p.normal) > kAlike; });
    };
    // Whether the point shows; its leaf is known then, or asked.
    const auto ask = [&](const SamplePoint& p, std::vector<Asks>& list) {
        const std::uint32_t leaf = finder.leaf_at(p.position_m, p.normal);
        if (leaf >= patches.count) return false;
        if (known(p, leaf)) return true;
        const RayHit hit = tracer.nearest({p.position_m + p.normal * ray_lift_m(p.position_m, regular), p.normal});
        if (hit.hit() && hit.back && !tracer.triangles().double_sided(hit.triangle)) return false;
        list.push_back({p, leaf});
        return true;
    };
    constexpr std::size_t kFacesAJob = 512;
    std::vector<std::vector<Asks>> asks((faces.faces.size() + kFacesAJob - 1) / kFacesAJob);
    parallel_for(asks.size(), threads, [&](std::size_t job) {
        const std::size_t last = std::min(faces.faces.size(), (job + 1) * kFacesAJob);
        for (std::size_t f = job * kFacesAJob; f < last; ++f) {
            const NearFace& face = faces.faces[f];
            const bool both = tracer.triangles().double_sided(face.triangles[0]);
            for (const bool back : {false, true}) {
                if (back && !both) continue;
                for (const Place& place : along(face, back, regular)) {
                    // Of a beam's end in a wall the middle is buried, and what stands out of the wall is seen: it may
                    // ask another leaf.
                    const bool shows = ask(place.middle, asks[job]);
                    const glm::ivec3 cell = cell_of(place.middle.position_m, patches.cell_m);
                    for (std::size_t k = 0; k < place.count; ++k) {
                        const auto& [towards, at] = place.edges[k];
                        if (shows && cell_of(at.position_m, patches.cell_m) == cell) continue;
                        if (!ask(towards, asks[job])) ask(at, asks[job]);
                    }
                }
            }
        }
    });
    for (const auto& list : asks)
        for (const Asks& one : list)
            if (!known(one.point, one.leaf)) receivers[one.leaf].push_back(one.point);
}

}  // namespace

std::vector<std::vector<SamplePoint>> near_receivers(const Patches& patches, const Tracer& tracer,
                                                     const NearFaces& faces, int threads)
{
    const Triangles& triangles = tracer.triangles();
    const LeafFinder finder(patches);
    std::vector<SamplePoint> points(patches.samples.size());
    std::vector<std::uint32_t> leaf(points.size());
    for_patches(patches, threads, [&](std::uint32_t i) {
        for (std::size_t s = std::size_t{i} * kPatchSamples; s < std::size_t{i + 1} * kPatchSamples; ++s) {
            points[s] = sample_point(triangles, patches.samples[s]);
            leaf[s] = finder.leaf_at(points[s].position_m, points[s].normal);
        }
    });
    std::vector<std::vector<SamplePoint>> receivers(patches.count);
    for (std::size_t s = 0; s < points.size(); ++s) {
        if (leaf[s] < patches.count) receivers[leaf[s]].push_back(points[s]);
    }
    // Between points whose leaf is another there may be some that ask this one.
    for (std::uint32_t i = 0; i < patches.count; ++i) {
        if (receivers[i].size() >= kFewReceivers) continue;
        const auto own = points.begin() + static_cast<std::ptrdiff_t>(std::size_t{i} * kPatchSamples);
        receivers[i].insert(receivers[i].end(), own, own + kPatchSamples);
    }
    add_bevels(patches, tracer, faces, finder, threads, receivers);
    return receivers;
}

}  // namespace petrichor::scene
