#include "scene/patches/detail/sight_groups.h"

#include <algorithm>

#include "scene/patches/detail/sampling.h"

namespace petrichor::scene {

namespace {

constexpr int kSkyRays = 48;

}  // namespace

int sky_rays(const Tracer& tracer, std::span<const PatchSample> samples, float regular_cell_m, std::uint64_t hash)
{
    int sky = 0;
    for (int r = 0; r < kSkyRays && sky < kSeesTheSky; ++r) {
        const SamplePoint from = sample_point(tracer.triangles(), samples[static_cast<std::size_t>(r) % samples.size()]);
        const glm::vec3 way = row_direction(from.normal, r, kSkyRays, hash);
        if (!(way.y > 0.0f)) continue;
        const glm::vec3 origin = from.position_m + from.normal * ray_lift_m(from.position_m, regular_cell_m);
        sky += tracer.blocked({origin, way}) ? 0 : 1;
    }
    return sky;
}

bool SightGroups::parted() const
{
    return std::any_of(of.begin(), of.begin() + points, [&](int group) { return group != of[0]; });
}

bool SightGroups::large() const
{
    int large = 0;
    for (int r = 0; r < points; ++r) {
        const auto members = std::count(of.begin(), of.begin() + points, r);
        if (members * 5 >= points) ++large;
    }
    return large >= 2;
}

SightGroups sight_groups(const Tracer& tracer, const Cell& cell, float regular_cell_m)
{
    const float lift = kSightLift * regular_cell_m;
    std::array<glm::vec3, kPatchSamples> points;
    SightGroups groups;
    groups.points = cell.points;
    for (int i = 0; i < cell.points; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const SamplePoint point = sample_point(tracer.triangles(), cell.samples[k]);
        points[k] = point.position_m + point.normal * lift;
        groups.of[k] = i;
    }
    const auto root = [&](int i) {
        while (groups.of[static_cast<std::size_t>(i)] != i) i = groups.of[static_cast<std::size_t>(i)];
        return i;
    };
    // Neighbours in the list first: where nothing is in the way, that joins all.
    int count = cell.points;
    for (int step = 1; step < cell.points && count > 1; ++step) {
        for (int i = 0; i + step < cell.points && count > 1; ++i) {
            const int a = root(i), b = root(i + step);
            if (a == b) continue;
            if (tracer.blocked_between(points[static_cast<std::size_t>(i)],
                                       points[static_cast<std::size_t>(i + step)]))
                continue;
            groups.of[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
            --count;
        }
    }
    for (int i = 0; i < cell.points; ++i) groups.of[static_cast<std::size_t>(i)] = root(i);
    return groups;
}

std::uint32_t shut_in(const Tracer& tracer, const Cell& cell, const SightGroups& groups, float regular_cell_m,
                      std::uint64_t hash)
{
    std::uint32_t shut = 0;
    bool open = false;
    for (int first = 0; first < cell.points; ++first) {
        if (groups.of[static_cast<std::size_t>(first)] != first) continue;
        std::array<PatchSample, kPatchSamples> own;
        std::size_t count = 0;
        std::uint32_t members = 0;
        for (int i = first; i < cell.points; ++i) {
            if (groups.of[static_cast<std::size_t>(i)] != first) continue;
            own[count++] = cell.samples[static_cast<std::size_t>(i)];
            members |= 1u << i;
        }
        const int sky = sky_rays(tracer, {own.data(), count}, regular_cell_m, mixed(hash, 31));
        open = open || sky >= kSeesTheSky;
        if (sky == 0) shut |= members;
    }
    return open ? shut : 0u;
}

}  // namespace petrichor::scene
