#include "scene/probes/probes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "formulas/codec/octahedral.h"
#include "formulas/light/reflection_probe.h"

namespace petrichor::scene {
namespace {

constexpr float kEye_m = 1.6f;
constexpr float kFar_m = 1.0e4f;
constexpr float kLeastScene_m = 1.0f;

glm::vec3 direction_of(int x, int y)
{
    const float step = 2.0f / static_cast<float>(shared::kProbeSide);
    return shared::octahedral_decode({(static_cast<float>(x) + 0.5f) * step - 1.0f,
                                      (static_cast<float>(y) + 0.5f) * step - 1.0f});
}

std::uint8_t tint_of(float now, float mean)
{
    const float tint = mean > 1e-4f ? now / mean : 1.0f;
    return static_cast<std::uint8_t>(std::clamp(tint * ProbeTexel::kTintScale + 0.5f, 0.0f, 255.0f));
}

// Directions that a place is judged by: the six axes and the eight corners between.
std::vector<glm::vec3> around()
{
    std::vector<glm::vec3> ways;
    for (int x = -1; x <= 1; ++x) {
        for (int y = -1; y <= 1; ++y) {
            for (int z = -1; z <= 1; ++z) {
                if (x != 0 || y != 0 || z != 0)
                    ways.push_back(glm::normalize(glm::vec3(x, y, z)));
            }
        }
    }
    return ways;
}

// Nothing stands closer than this, and no surface shows its back.
bool has_room(const Tracer& tracer, glm::vec3 at, float least_m)
{
    for (const glm::vec3& way : around()) {
        const RayHit hit = tracer.nearest({at, way});
        if (!hit.hit()) continue;
        if (hit.distance_m < least_m) return false;
        if (hit.back && !tracer.triangles().double_sided(hit.triangle)) return false;
    }
    return true;
}

// How far the wall is that faces one side: what four of five rays of a fan meet sooner; kFar_m where more than
// one sees the sky. A wall that is too near bends what is mirrored beside it, one too far only shifts it.
float wall_m(const Tracer& tracer, glm::vec3 at, int axis, float sign)
{
    std::vector<float> found;
    for (int u = -2; u <= 2; ++u) {
        for (int v = -2; v <= 2; ++v) {
            glm::vec3 way(0.0f);
            way[axis] = sign;
            way[(axis + 1) % 3] = 0.2f * static_cast<float>(u);
            way[(axis + 2) % 3] = 0.2f * static_cast<float>(v);
            way = glm::normalize(way);
            const RayHit hit = tracer.nearest({at, way});
            found.push_back(hit.hit() ? hit.distance_m * std::abs(way[axis]) : kFar_m);
        }
    }
    const std::size_t chosen = found.size() * 4 / 5;
    std::nth_element(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(chosen), found.end());
    return found[chosen];
}

// Where most patches are: what is much smaller than the whole stands on a ground that reaches out to the
// horizon, and nothing out there is looked at.
struct Box {
    glm::vec3 low, high;
};
Box looked_at(const Patches& patches, const Triangles& triangles)
{
    const Box whole{triangles.low(), triangles.high()};
    Box most = whole;
    std::vector<float> along(patches.count);
    for (int axis = 0; axis < 3; ++axis) {
        for (std::size_t i = 0; i < along.size(); ++i) along[i] = patches.position_m[i][axis];
        const auto at = [&](double share) {
            const auto k = static_cast<std::ptrdiff_t>(share * static_cast<double>(along.size() - 1));
            std::nth_element(along.begin(), along.begin() + k, along.end());
            return along[static_cast<std::size_t>(k)];
        };
        most.low[axis] = at(0.02);
        most.high[axis] = at(0.98);
    }
    const glm::vec3 all = whole.high - whole.low, part = most.high - most.low;
    return std::max(part.x, part.z) < 0.25f * std::max(all.x, all.z) ? most : whole;
}

constexpr int kMostMirrors = 4;

bool is_mirror(const PatchSurface& surface)
{
    return surface.metallic > 0.9f && surface.roughness < 0.25f;
}

// What one ray meets, behind mirrors too: they tint what they show. A mirror that shows no patch, or another mirror
// after as many as are followed, is as matt as its patch.
ProbeTexel seen_along(const Patches& patches, const Tracer& tracer, std::span<const PatchSurface> surfaces,
                      std::span<const ColorImage> images, glm::vec3 from, glm::vec3 way)
{
    const Triangles& triangles = tracer.triangles();
    ProbeTexel matt;
    glm::vec3 mirrors(1.0f);
    for (int passed = 0; passed <= kMostMirrors; ++passed) {
        const RayHit hit = tracer.nearest({from, way});
        if (!hit.hit()) return matt;
        glm::vec3 normal = triangles.normal(hit.triangle);
        if (glm::dot(normal, way) > 0.0f) normal = -normal;
        const glm::vec3 at = triangles.point(hit.triangle, hit.at);
        const auto patch = patch_at(patches, at, normal);
        ProbeTexel texel;
        texel.patch = patch.value_or(ProbeTexel::kBlack);
        const bool known = patch && *patch < surfaces.size();
        if (known) {
            const glm::vec3 color = surface_color(triangles, hit.triangle, hit.at, images);
            const PatchSurface& surface = surfaces[*patch];
            for (int c = 0; c < 3; ++c) texel.tint[c] = tint_of(mirrors[c] * color[c], surface.base_color[c]);
            if (is_mirror(surface)) {
                if (passed == 0) matt = texel;
                mirrors *= color;
                way = glm::reflect(way, normal);
                from = at + 1e-4f * std::max(1.0f, hit.distance_m) * normal;
                continue;
            }
        }
        // A surface without a patch is black: the mirror before it knows better.
        return passed > 0 && !known ? matt : texel;
    }
    return matt;
}

}  // namespace

TracedProbe trace_probe(const Patches& patches, const Tracer& tracer,
                        std::span<const PatchSurface> surfaces, std::span<const ColorImage> images,
                        const ProbePlace& place, int threads)
{
    constexpr int kSide = shared::kProbeSide;
    TracedProbe probe{place, std::vector<ProbeTexel>(static_cast<std::size_t>(kSide) * kSide), {}};
    parallel_for(static_cast<std::size_t>(kSide), threads, [&](std::size_t row) {
        for (int x = 0; x < kSide; ++x) {
            probe.texels[row * kSide + static_cast<std::size_t>(x)] = seen_along(
                patches, tracer, surfaces, images, place.position_m, direction_of(x, static_cast<int>(row)));
        }
    });
    return probe;
}

std::vector<ProbePlace> place_probes(const Patches& patches, const Tracer& tracer, std::size_t most)
{
    std::vector<ProbePlace> places;
    if (patches.empty() || most == 0) return places;
    const Box box = looked_at(patches, tracer.triangles());
    const float wide = std::max(box.high.x - box.low.x, box.high.z - box.low.z);
    if (!(wide >= kLeastScene_m)) return places;
    const float spacing = std::max(3.0f, wide / 6.0f);
    std::vector<glm::vec3> ground;
    for (std::uint32_t i = 0; i < patches.count; ++i) {
        const glm::vec3 at = patches.position_m[i];
        const bool near = at.x >= box.low.x && at.x <= box.high.x && at.z >= box.low.z &&
                          at.z <= box.high.z;
        if (near && patches.normal[i].y > 0.9f) ground.push_back(at);
    }
    if (ground.empty()) return places;
    // The first is the lowest ground near the middle; each other the farthest from all before.
    const glm::vec3 middle = 0.5f * (box.low + box.high);
    std::vector<float> apart(ground.size());
    for (std::size_t i = 0; i < ground.size(); ++i) {
        const glm::vec3 way = ground[i] - glm::vec3(middle.x, box.low.y, middle.z);
        apart[i] = -glm::dot(way, way);
    }
    const float least = std::min(0.25f, 0.1f * spacing);
    bool first = true;
    for (std::size_t tried = 0; tried < 16 * most && places.size() < most; ++tried) {
        const auto best = std::max_element(apart.begin(), apart.end());
        if (!first && *best < spacing * spacing) break;
        if (first && *best == -std::numeric_limits<float>::max()) break;
        const std::size_t chosen = static_cast<std::size_t>(best - apart.begin());
        const glm::vec3 at = ground[chosen] + glm::vec3(0.0f, kEye_m, 0.0f);
        if (!has_room(tracer, at, least)) {
            apart[chosen] = first ? -std::numeric_limits<float>::max() : 0.0f;
            continue;
        }
        ProbePlace place;
        place.position_m = at;
        for (int axis = 0; axis < 3; ++axis) {
            place.low_m[axis] = at[axis] - wall_m(tracer, at, axis, -1.0f);
            place.high_m[axis] = at[axis] + wall_m(tracer, at, axis, 1.0f);
        }
        place.blend_m = std::max(spacing, 0.5f * wide);
        places.push_back(place);
        for (std::size_t i = 0; i < ground.size(); ++i) {
            const glm::vec3 way = ground[i] - ground[chosen];
            const float now = glm::dot(way, way);
            apart[i] = first ? now : std::min(apart[i], now);
        }
        first = false;
    }
    return places;
}

}  // namespace petrichor::scene
