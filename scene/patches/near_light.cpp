#include "scene/patches/near_light.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "formulas/light/near_light.h"
#include "scene/light_shape.h"
#include "scene/patches/detail/cells.h"
#include "scene/patches/detail/links.h"
#include "scene/patches/detail/sampling.h"
#include "scene/patches/lamps.h"

namespace petrichor::scene {
namespace {

static_assert(NearLinks::kMostAPatch >= 4);
constexpr std::size_t kPatchesAJob = 64;
constexpr std::size_t kKept = 4;  // entries of a patch
constexpr int kLeastRays = 2;     // of its row that meet an entry's plane
constexpr float kSmallest_m2 = 1e-8f;

struct Polygon {
    std::array<glm::vec3, 12> corner;
    int count = 0;
};

// What of a polygon lies where dot(n, x) >= least.
Polygon above(const Polygon& polygon, glm::vec3 n, float least)
{
    Polygon cut;
    for (int k = 0; k < polygon.count; ++k) {
        const glm::vec3 a = polygon.corner[static_cast<std::size_t>(k)];
        const glm::vec3 b = polygon.corner[static_cast<std::size_t>((k + 1) % polygon.count)];
        const float da = glm::dot(n, a) - least, db = glm::dot(n, b) - least;
        if (da >= 0.0f && cut.count < 12) cut.corner[static_cast<std::size_t>(cut.count++)] = a;
        if ((da < 0.0f) != (db < 0.0f) && cut.count < 12)
            cut.corner[static_cast<std::size_t>(cut.count++)] = a + (b - a) * (da / (da - db));
    }
    return cut;
}

float corner_area_m2(const Polygon& p, int k)
{
    const auto at = [&](int i) {
        return p.corner[static_cast<std::size_t>((i + p.count) % p.count)];
    };
    const glm::vec3 n = glm::cross(at(k) - at(k - 1), at(k + 1) - at(k));
    return 0.5f * std::sqrt(glm::dot(n, n));
}

// No more than four corners: those go that cut off least.
void simplify(Polygon& p)
{
    while (p.count > 4) {
        int least = 0;
        for (int k = 1; k < p.count; ++k)
            if (corner_area_m2(p, k) < corner_area_m2(p, least)) least = k;
        for (int k = least; k + 1 < p.count; ++k)
            p.corner[static_cast<std::size_t>(k)] = p.corner[static_cast<std::size_t>(k + 1)];
        --p.count;
    }
}

struct Met {
    std::uint32_t triangle;
    bool back;
    std::uint32_t sender;
    int ray;
    float distance_m;
};

struct Entry {
    std::array<glm::vec3, 4> corners;
    float seen = 1.0f;
    std::uint32_t sender = 0;
    std::array<std::uint32_t, 8> visible{};
};

glm::vec3 front_of(const std::array<glm::vec3, 4>& c)
{
    const glm::vec3 n = glm::cross(c[1] - c[0], c[2] - c[0]) + glm::cross(c[2] - c[0], c[3] - c[0]);
    const float length = std::sqrt(glm::dot(n, n));
    return length > 0.0f ? n / length : glm::vec3(0.0f, 1.0f, 0.0f);
}

// A point within a polygon, by two numbers of 0..1.
glm::vec3 point_in(const std::array<glm::vec3, 4>& c, float u, float v)
{
    const glm::vec3 low = c[0] + (c[1] - c[0]) * u, high = c[3] + (c[2] - c[3]) * u;
    return low + (high - low) * v;
}

// As trace_visibility has it.
std::array<std::uint32_t, 8> sky_seen(const Entry& entry, const Tracer& tracer, float regular_m,
                                      std::uint64_t hash)
{
    std::array<std::uint32_t, 8> visible{};
    const glm::vec3 n = front_of(entry.corners);
    for (std::size_t bit = 0; bit < 256; ++bit) {
        const glm::vec3 raw = shared::visibility_raw_direction(static_cast<int>(bit));
        const glm::vec3 d = raw / std::sqrt(glm::dot(raw, raw));
        if (!(glm::dot(n, d) > 0.0f)) continue;
        const std::uint64_t at = mixed(hash, bit);
        const glm::vec3 x =
            point_in(entry.corners, unit_float(at), unit_float(mixed(at, 3)));
        if (!tracer.blocked({x + n * ray_lift_m(x, regular_m), d}))
            visible[bit >> 5] |= 1u << (bit & 31);
    }
    return visible;
}

struct Row {
    std::vector<Entry> entries;
    std::vector<std::uint16_t> rays;
    std::vector<std::uint8_t> ray_entry;
};

// The row's rays that meet something within reach.
std::vector<Met> near_hits(const Patches& patches, const Tracer& tracer, std::uint32_t patch,
                           float reach_m)
{
    std::vector<Met> met;
    for (int r = 0; r < patches.rays; ++r) {
        const LinkRay link = trace_link(patches, tracer, patch, r);
        if (!link.hit.hit() || link.inside || link.hit.distance_m > reach_m) continue;
        const std::uint16_t id = patches.row(patch)[r];
        if (id >= patches.count) continue;
        met.push_back({link.hit.triangle, link.hit.back, id, r, link.hit.distance_m});
    }
    return met;
}

std::uint32_t most_common(std::vector<std::uint32_t> ids)
{
    std::sort(ids.begin(), ids.end());
    std::uint32_t best = ids.front();
    std::size_t most = 0;
    for (std::size_t k = 0, first = 0; k < ids.size(); ++k) {
        if (ids[k] != ids[first]) first = k;
        if (k - first + 1 > most) {
            most = k - first + 1;
            best = ids[k];
        }
    }
    return best;
}

Row row_of(const Patches& patches, const Tracer& tracer, std::uint32_t patch)
{
    const Triangles& triangles = tracer.triangles();
    const shared::PatchKey key = patches.key[patch];
    const int level = level_of(key);
    const float edge = patches.level_cell_m(level);
    const glm::vec3 d = triangles.high() - triangles.low();
    // No further than what counts as closed (Patches::open).
    const float reach =
        std::min({edge, patches.level_cell_m(1), 0.03f * std::sqrt(glm::dot(d, d)), 0.5f});
    std::vector<Met> met = near_hits(patches, tracer, patch, reach);
    Row row;
    if (static_cast<int>(met.size()) < kLeastRays) return row;

    std::array<SamplePoint, kPatchSamples> points;
    const glm::vec3 n = patches.normal[patch];
    float lowest = std::numeric_limits<float>::max();
    for (std::size_t k = 0; k < points.size(); ++k) {
        points[k] = sample_point(triangles,
                                 patches.samples[std::size_t{patch} * kPatchSamples + k]);
        lowest = std::min(lowest, glm::dot(n, points[k].position_m));
    }
    const glm::vec3 low =
        (glm::vec3(cell_in(key) - glm::ivec3(shared::kPatchCellBias >> level))) * edge -
        shared::kPatchGridShift * patches.cell_m - reach;
    const glm::vec3 high = low + edge + 2.0f * reach;

    struct Candidate {
        std::uint32_t triangle;
        bool back;
        int rays = 0;
        float weight = 0.0f;
    };
    std::vector<Candidate> candidates;
    for (const Met& m : met) {
        auto found = std::find_if(candidates.begin(), candidates.end(), [&](const Candidate& c) {
            return c.triangle == m.triangle && c.back == m.back;
        });
        if (found == candidates.end()) {
            candidates.push_back({m.triangle, m.back});
            found = std::prev(candidates.end());
        }
        ++found->rays;
        found->weight += 1.0f / (m.distance_m + 0.02f * edge);
    }
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.weight > b.weight; });
    // Rays that met the triangle, or another in its plane: a face is of several.
    const auto rays_of_plane = [&](const Candidate& c) {
        const glm::vec3 n_c = triangles.normal(c.triangle);
        int rays = 0;
        for (const Candidate& other : candidates) {
            const glm::vec3 way = triangles.corner(other.triangle) - triangles.corner(c.triangle);
            const bool plane = glm::dot(triangles.normal(other.triangle), n_c) > 0.9999f &&
                               std::abs(glm::dot(way, n_c)) < 0.01f * edge;
            if (plane && other.back == c.back) rays += other.rays;
        }
        return rays;
    };
    for (const Candidate& c : candidates) {
        if (row.entries.size() == kKept) break;
        if (rays_of_plane(c) < kLeastRays) continue;
        Polygon polygon;
        polygon.count = 3;
        const glm::vec3 a = triangles.corner(c.triangle);
        polygon.corner[0] = a;
        polygon.corner[1] = a + triangles.edge1(c.triangle);
        polygon.corner[2] = a + triangles.edge2(c.triangle);
        if (c.back) std::swap(polygon.corner[1], polygon.corner[2]);
        polygon = above(polygon, n, lowest);
        for (int k = 0; k < 3; ++k) {
            glm::vec3 axis(0.0f);
            axis[k] = 1.0f;
            polygon = above(polygon, axis, low[k]);
            polygon = above(polygon, -axis, -high[k]);
        }
        simplify(polygon);
        if (polygon.count < 3) continue;
        float area = 0.0f;
        for (int k = 0; k < polygon.count; ++k) area += corner_area_m2(polygon, k);
        if (!(area > kSmallest_m2)) continue;
        Entry entry;
        for (int k = 0; k < 4; ++k)
            entry.corners[static_cast<std::size_t>(k)] =
                polygon.corner[static_cast<std::size_t>(std::min(k, polygon.count - 1))];
        float mean = 0.0f;
        for (const SamplePoint& p : points) {
            mean += shared::near_form_factor(
                        entry.corners[0] - p.position_m, entry.corners[1] - p.position_m,
                        entry.corners[2] - p.position_m, entry.corners[3] - p.position_m, p.normal) /
                    static_cast<float>(kPatchSamples);
        }
        if (!(mean > 0.0f)) continue;
        // Few rays say little: one more for both.
        entry.seen = std::min(1.0f, (static_cast<float>(c.rays) + 1.0f) /
                                        (static_cast<float>(patches.rays) * mean + 1.0f));
        std::vector<std::uint32_t> senders;
        const auto number = static_cast<std::uint8_t>(row.entries.size());
        for (const Met& m : met) {
            if (m.triangle != c.triangle || m.back != c.back) continue;
            senders.push_back(m.sender);
            row.rays.push_back(static_cast<std::uint16_t>(m.ray));
            row.ray_entry.push_back(number);
        }
        entry.sender = most_common(std::move(senders));
        entry.visible = sky_seen(entry, tracer, patches.level_cell_m(1),
                                 mixed(cell_hash(patches.seed, key), number));
        row.entries.push_back(entry);
    }
    return row;
}

}  // namespace

NearLinks trace_near(const Patches& patches, const Tracer& tracer, int threads)
{
    std::vector<Row> rows(patches.count);
    const std::size_t jobs = (patches.count + kPatchesAJob - 1) / kPatchesAJob;
    parallel_for(jobs, threads, [&](std::size_t job) {
        const auto first = static_cast<std::uint32_t>(job * kPatchesAJob);
        const std::uint32_t last =
            std::min(first + static_cast<std::uint32_t>(kPatchesAJob), patches.count);
        for (std::uint32_t i = first; i < last; ++i) rows[i] = row_of(patches, tracer, i);
    });
    NearLinks near;
    near.first.push_back(0);
    near.ray_first.push_back(0);
    for (const Row& row : rows) {
        for (const Entry& entry : row.entries) {
            near.corners.push_back(entry.corners);
            near.seen.push_back(entry.seen);
            near.sender.push_back(entry.sender);
            near.visible.push_back(entry.visible);
        }
        near.rays.insert(near.rays.end(), row.rays.begin(), row.rays.end());
        near.ray_entry.insert(near.ray_entry.end(), row.ray_entry.begin(), row.ray_entry.end());
        near.first.push_back(static_cast<std::uint32_t>(near.sender.size()));
        near.ray_first.push_back(static_cast<std::uint32_t>(near.rays.size()));
    }
    return near;
}

glm::vec3 near_normal(const NearLinks& near, std::size_t entry)
{
    return front_of(near.corners[entry]);
}

std::vector<std::uint8_t> trace_near_lamp(const NearLinks& near, const Tracer& tracer,
                                          float regular_m, glm::vec3 position_m, float range_m,
                                          int threads)
{
    std::vector<std::uint8_t> reached(near.sender.size(), 0);
    constexpr std::size_t kEntriesAJob = 256;
    parallel_for((reached.size() + kEntriesAJob - 1) / kEntriesAJob, threads, [&](std::size_t job) {
        const std::size_t last = std::min(reached.size(), (job + 1) * kEntriesAJob);
        for (std::size_t e = job * kEntriesAJob; e < last; ++e) {
            const glm::vec3 n = near_normal(near, e);
            const glm::vec3 way = position_m - near.corners[e][0];
            if (!(std::sqrt(glm::dot(way, way)) < range_m + 2.0f * regular_m)) continue;
            int seen = 0;
            for (int k = 0; k < 4; ++k) {
                const glm::vec3 x = point_in(near.corners[e], k % 2 == 0 ? 0.25f : 0.75f,
                                             k / 2 == 0 ? 0.25f : 0.75f);
                const glm::vec3 from = x + n * ray_lift_m(x, regular_m);
                const glm::vec3 d = position_m - from;
                const float length = std::sqrt(glm::dot(d, d));
                if (!(glm::dot(d, n) > 0.0f)) continue;
                const bool blocked =
                    length > kLanternRadius_m &&
                    tracer.blocked({from, d / length, length - kLanternRadius_m});
                seen += blocked ? 0 : 1;
            }
            reached[e] = static_cast<std::uint8_t>(seen * 255 / 4);
        }
    });
    return reached;
}

void add_sun(const NearLinks& near, glm::vec3 towards_sun, glm::vec3 illuminance,
             std::vector<glm::vec3>& direct)
{
    for (std::size_t e = 0; e < near.sender.size(); ++e) {
        const float cosine = glm::dot(near_normal(near, e), towards_sun);
        if (cosine > 0.0f)
            direct[e] += illuminance * (cosine * visible_share(near.visible[e], towards_sun));
    }
}

void add_lamp(const NearLinks& near, const Light& light, std::span<const std::uint8_t> reach,
              std::vector<glm::vec3>& direct)
{
    if (light.kind == LightKind::Directional) {
        add_sun(near, -light.direction, light.color * light_candela(light), direct);
        return;
    }
    for (std::size_t e = 0; e < near.sender.size(); ++e) {
        const float seen = reach.empty() ? 1.0f : static_cast<float>(reach[e]) / 255.0f;
        if (seen <= 0.0f) continue;
        const auto& c = near.corners[e];
        const glm::vec3 d = c[2] - c[0];
        direct[e] += lamp_irradiance(light, point_in(c, 0.5f, 0.5f), near_normal(near, e),
                                     0.5f * std::sqrt(glm::dot(d, d))) *
                     seen;
    }
}

}  // namespace petrichor::scene
