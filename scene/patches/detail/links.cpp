#include "scene/patches/detail/links.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <numeric>
#include <string_view>
#include <utility>

#include "base/parallel.h"
#include "scene/patches/detail/cells.h"
#include "scene/patches/detail/sampling.h"

namespace petrichor::scene {
namespace {

constexpr std::size_t kPatchesAJob = 64;

// body(patch) for all patches, in jobs; says now and then how far it is.
template <class Body>
void over_patches(const Patches& patches, const PatchOptions& options, std::string_view what,
                  const Body& body)
{
    const std::size_t jobs = (patches.count + kPatchesAJob - 1) / kPatchesAJob;
    std::atomic<std::size_t> done{0};
    std::mutex telling;
    parallel_for(jobs, options.threads, [&](std::size_t job) {
        if (options.stop && options.stop())
            throw Interrupted("interrupted while the scene's light was traced");
        const auto first = static_cast<std::uint32_t>(job * kPatchesAJob);
        const std::uint32_t last =
            std::min(first + static_cast<std::uint32_t>(kPatchesAJob), patches.count);
        for (std::uint32_t patch = first; patch < last; ++patch) body(patch);
        const std::size_t now = ++done;
        if (options.progress && now % 32 == 0) {
            const std::lock_guard lock(telling);
            options.progress(what, static_cast<float>(now) / static_cast<float>(jobs));
        }
    });
}

SamplePoint point_of(const Patches& patches, const Triangles& triangles, std::uint32_t patch,
                     std::uint64_t k)
{
    return sample_point(triangles, patches.samples[std::size_t{patch} * kPatchSamples +
                                                   k % static_cast<std::uint64_t>(kPatchSamples)]);
}

// The radius of the screen's ambient occlusion in a scene of that size.
float open_radius_m(const Triangles& triangles)
{
    const glm::vec3 d = triangles.high() - triangles.low();
    return std::clamp(0.03f * std::sqrt(glm::dot(d, d)), 0.01f, 0.5f);
}

}  // namespace

std::uint32_t patch_of_hit(const Patches& patches, const Triangles& triangles, const Ray& ray,
                           const RayHit& hit)
{
    glm::vec3 n = triangles.normal(hit.triangle);
    if (hit.back) n = -n;
    const auto found = patch_at(patches, ray.origin + ray.direction * hit.distance_m, n);
    return found ? *found : patches.black();
}

RowRays::RowRays(const Patches& patches, const Triangles& triangles, std::uint32_t patch)
    : hash_(cell_hash(patches.seed, patches.key[patch])), count_(patches.rays)
{
    for (std::size_t k = 0; k < starts_.size(); ++k) {
        const SamplePoint from = point_of(patches, triangles, patch, k);
        const Tangents frame = tangents_of(from.normal);
        starts_[k] = {from.position_m + from.normal * ray_lift_m(from.position_m, patches.level_cell_m(1)),
                      from.normal, frame.t, frame.b};
    }
}

glm::vec3 RowRays::local(int r) const
{
    return local_row_direction(r, count_, hash_);
}

Ray RowRays::ray(int r, glm::vec3 local, std::size_t draw) const
{
    const std::uint64_t which = mixed(hash_, static_cast<std::uint64_t>(r) * kDraws + draw);
    const Start& from = starts_[(which >> 7) % starts_.size()];
    return {from.position_m, turned({from.t, from.b}, from.normal, local)};
}

std::vector<LinkRay> trace_row(const Tracer& tracer, const RowRays& row, std::span<const int> which)
{
    std::vector<LinkRay> links(which.size());
    std::vector<Ray> rays(which.size());
    std::vector<RayHit> hits(which.size());
    std::vector<std::size_t> asked(which.size()), again;
    std::iota(asked.begin(), asked.end(), std::size_t{0});
    for (std::size_t draw = 0; draw < RowRays::kDraws && !asked.empty(); ++draw) {
        for (std::size_t k = 0; k < asked.size(); ++k) {
            const int r = which[asked[k]];
            rays[k] = row.ray(r, row.local(r), draw);
        }
        tracer.nearest({rays.data(), asked.size()}, hits);
        again.clear();
        for (std::size_t k = 0; k < asked.size(); ++k) {
            const RayHit& hit = hits[k];
            const bool inside = hit.hit() && hit.back && !tracer.triangles().double_sided(hit.triangle);
            links[asked[k]] = {rays[k], hit, inside, draw + 1};
            if (inside) again.push_back(asked[k]);
        }
        asked.swap(again);
    }
    return links;
}

void trace_links(Patches& patches, const Tracer& tracer, const PatchOptions& options)
{
    const Triangles& triangles = tracer.triangles();
    const float open_m = open_radius_m(triangles);
    patches.links.resize(std::size_t{patches.count} * static_cast<std::size_t>(patches.rays));
    patches.sky_view.resize(patches.count);
    patches.redrawn.assign(std::size_t{patches.count} * patches.redrawn_row(), 0);
    std::vector<int> which(static_cast<std::size_t>(patches.rays));
    std::iota(which.begin(), which.end(), 0);
    over_patches(patches, options, "links", [&](std::uint32_t patch) {
        std::uint16_t* row =
            patches.links.data() + std::size_t{patch} * static_cast<std::size_t>(patches.rays);
        const RowRays rays(patches, triangles, patch);
        int sky = 0;
        int far = 0;
        int lost = 0;
        std::vector<std::pair<int, std::uint16_t>> replaced;
        const std::vector<LinkRay> traced = trace_row(tracer, rays, which);
        for (int r = 0; r < patches.rays; ++r) {
            const LinkRay& link = traced[static_cast<std::size_t>(r)];
            if (link.draws > 1)
                patches.redrawn[patch * patches.redrawn_row() + static_cast<std::size_t>(r) / 8] |=
                    static_cast<std::uint8_t>(1u << r % 8);
            std::uint32_t id = patches.black();
            if (!link.hit.hit() && !link.inside) {
                id = patches.count +
                     static_cast<std::uint32_t>(shared::sky_bin_left(link.ray.direction));
                sky += link.ray.direction.y > 0.0f ? 1 : 0;
                ++far;
            } else if (!link.inside) {
                id = patch_of_hit(patches, triangles, link.ray, link.hit);
                far += link.hit.distance_m > open_m ? 1 : 0;
            }
            row[r] = static_cast<std::uint16_t>(id);
            lost += id == patches.black() ? 1 : 0;
        }
        const int found = patches.rays - lost;
        patches.sky_view[patch] =
            found > 0 ? static_cast<float>(sky) / static_cast<float>(found) : 0.0f;
        patches.open[patch] =
            found > 0 ? static_cast<float>(far) / static_cast<float>(found) : 1.0f;
        // What starts inside a body sees nothing that is there: the other rays stand in for it, one
        // after the other, so that the row still adds up to 1.
        for (int r = 0, other = 0; r < patches.rays && lost > 0 && found > 0; ++r) {
            if (row[r] != patches.black()) continue;
            other = (other + 1) % patches.rays;
            while (row[other] == patches.black()) other = (other + 1) % patches.rays;
            replaced.push_back({r, row[other]});
        }
        for (const auto& [r, id] : replaced) row[r] = id;
    });
    std::vector<glm::vec4> open(patches.count);
    for (std::uint32_t i = 0; i < patches.count; ++i) open[i] = glm::vec4(patches.open[i]);
    open = with_interior(patches, open);
    for (std::uint32_t i = 0; i < patches.nodes(); ++i) patches.open[i] = open[i].x;
}

namespace {

constexpr int kSegments = 4;

// Up to four leaves below a node, by their order.
void leaves_below(const Patches& patches, std::uint32_t node, std::vector<std::uint32_t>& leaves)
{
    if (leaves.size() >= kSegments) return;
    if (node < patches.count) {
        leaves.push_back(node);
        return;
    }
    const std::uint32_t i = node - patches.count;
    for (std::uint32_t c = patches.children_first[i]; c < patches.children_first[i + 1]; ++c)
        leaves_below(patches, patches.children[c], leaves);
}

// Points of the surface of `node` near a cell, above the surface.
void points_near(const Patches& patches, const Triangles& triangles, std::uint32_t node, int level,
                 glm::vec3 middle, float lift, std::array<glm::vec3, kSegments>& points)
{
    if (node < patches.count && level_of(patches.key[node]) > level) {
        // A coarse leaf: the foot of the cell's middle on its plane.
        const glm::vec3 n = patches.normal[node];
        const float above = glm::dot(n, middle - patches.position_m[node]);
        points.fill(middle - n * above + n * lift);
        return;
    }
    std::vector<std::uint32_t> leaves;
    leaves_below(patches, node, leaves);
    for (std::size_t k = 0; k < kSegments; ++k) {
        const std::uint32_t leaf = leaves[k % leaves.size()];
        const SamplePoint p = point_of(patches, triangles, leaf, 5 * k + 1);
        points[k] = p.position_m + p.normal * lift;
    }
}

}  // namespace

void connect(Patches& patches, const Tracer& tracer, const PatchOptions& options)
{
    const Triangles& triangles = tracer.triangles();
    over_patches(patches, options, "connections", [&](std::uint32_t patch) {
        const shared::PatchKey key = patches.key[patch];
        const int level = level_of(key), axis = axis_of(key);
        const glm::ivec3 own = cell_in(key);
        const float edge = patches.level_cell_m(level);
        const float lift = 0.12f * edge;
        struct Neighbour {
            int n;
            std::array<glm::vec3, kSegments> to;
            int seen = 0;
        };
        std::vector<Neighbour> around;
        for (int n = 0; n < 27; ++n) {
            if (n == 13) continue;
            const glm::ivec3 there = own + glm::ivec3(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
            std::uint32_t node = Patches::kNoNode;
            for (int l = level; l < patches.levels && node == Patches::kNoNode; ++l)
                node = find_node(patches, shared::patch_key({there.x >> (l - level),
                                                             there.y >> (l - level),
                                                             there.z >> (l - level)},
                                                            axis, l));
            if (node == Patches::kNoNode) continue;
            const glm::vec3 middle =
                (glm::vec3(there - glm::ivec3(shared::kPatchCellBias >> level)) + 0.5f) * edge -
                shared::kPatchGridShift * patches.cell_m;
            around.push_back({n, {}, 0});
            points_near(patches, triangles, node, level, middle, lift, around.back().to);
        }
        std::array<glm::vec3, kSegments> from;
        for (std::size_t k = 0; k < kSegments; ++k) {
            const SamplePoint p = point_of(patches, triangles, patch, 4 * k + 2);
            from[k] = p.position_m + p.normal * lift;
        }
        // Two segments each, and where not both are free the other two.
        for (std::size_t first = 0; first < kSegments; first += 2) {
            std::vector<Ray> rays;
            std::vector<Neighbour*> of;
            for (Neighbour& neighbour : around) {
                if (neighbour.seen >= 2) continue;
                for (std::size_t k = first; k < first + 2; ++k) {
                    if (const auto ray = ray_between(from[k], neighbour.to[k])) {
                        rays.push_back(*ray);
                        of.push_back(&neighbour);
                    } else {
                        ++neighbour.seen;
                    }
                }
            }
            std::array<bool, 2 * 27> blocked;
            tracer.blocked(rays, blocked);
            for (std::size_t k = 0; k < rays.size(); ++k) of[k]->seen += blocked[k] ? 0 : 1;
        }
        std::uint32_t bits = 1u << 13;
        for (const Neighbour& neighbour : around)
            if (neighbour.seen >= 2) bits |= 1u << neighbour.n;
        patches.connected[patch] = bits;
    });
}

void trace_visibility(Patches& patches, const Tracer& tracer, const PatchOptions& options)
{
    const Triangles& triangles = tracer.triangles();
    const float regular = patches.level_cell_m(1);
    constexpr int kBits = shared::kVisibilityAcross * shared::kVisibilityAcross;
    std::array<glm::vec3, kBits> directions;
    std::array<std::uint64_t, kBits> which;
    for (int bit = 0; bit < kBits; ++bit) {
        const auto at = static_cast<std::size_t>(bit);
        const glm::vec3 raw = shared::visibility_raw_direction(bit);
        directions[at] = raw / std::sqrt(glm::dot(raw, raw));
        which[at] = mixed(options.seed, 1000 + at) >> 9;
    }
    patches.visible.assign(patches.count, {});
    over_patches(patches, options, "visibility", [&](std::uint32_t patch) {
        std::array<SamplePoint, kPatchSamples> points;
        for (std::size_t k = 0; k < points.size(); ++k) {
            points[k] = point_of(patches, triangles, patch, k);
            points[k].position_m +=
                points[k].normal * ray_lift_m(points[k].position_m, regular);
        }
        std::array<Ray, kBits> rays;
        std::array<bool, kBits> blocked;
        std::array<std::size_t, kBits> bit_of;
        std::size_t count = 0;
        for (std::size_t bit = 0; bit < kBits; ++bit) {
            const SamplePoint& from = points[which[bit] % kPatchSamples];
            if (!(glm::dot(from.normal, directions[bit]) > 0.0f)) continue;
            rays[count] = {from.position_m, directions[bit]};
            bit_of[count++] = bit;
        }
        tracer.blocked({rays.data(), count}, blocked);
        for (std::size_t k = 0; k < count; ++k)
            if (!blocked[k]) patches.visible[patch][bit_of[k] >> 5] |= 1u << (bit_of[k] & 31);
    });
}

}  // namespace petrichor::scene
