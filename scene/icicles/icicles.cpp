#include "scene/icicles/icicles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <tuple>

#include "base/portable_math.h"
#include "formulas/noise/noise.h"

namespace petrichor::scene {
namespace {

using glm::vec3;

constexpr float kTurn = 6.28318531f;
constexpr float kFarthest_m = 80.0f;
constexpr float kUnseen = 0.0012f;      // of the distance: about a pixel
constexpr float kCell_m = 4.0f;
constexpr float kClear_m = 0.1f;        // above what lies below
constexpr float kLean = 0.03f;
constexpr float kOut_m = 0.015f;        // drops fall so far before the edge
constexpr float kUp_m = 0.004f;
constexpr float kRing_m = 0.01f;
constexpr float kRingDepth = 0.06f;     // of the radius
// Of the length of one that the water never left. Rivulets change their ways every few hands, so some have had most of it and their neighbours little, and
// longer parts of an eave are fed better than others. In the world, so that all of one eave agree.
constexpr float kLeastShare = 0.08f, kMostShare = 0.92f;
constexpr float kFed_m = 0.8f, kFedFiner_m = 0.27f;
constexpr std::uint32_t kMostTriangles = 300'000;  // then all are coarser
constexpr const char* kName = "icicles";

// How finely one is cut, by the distance to the nearest eye.
struct Fineness {
    float to_m;
    int sides, bands;
};
constexpr std::array<Fineness, 4> kFineness{{{3.0f, 8, 48}, {7.0f, 6, 20}, {14.0f, 5, 8}, {kFarthest_m, 4, 4}}};

// Above its root it ends in a dome, on the edge that it grew from: shares of the radius up, and of the radius.
constexpr std::array<std::array<float, 2>, 2> kDome{{{0.55f, 0.45f}, {0.3f, 0.85f}}};
constexpr float kDomeTop = 0.65f;
constexpr int kDomes = static_cast<int>(kDome.size());

int rings_of(const Icicle& icicle)
{
    return kDomes + icicle.bands + 1;
}

float number_of(std::uint32_t number, std::uint32_t which)
{
    return shared::hash_f(number + 77u * (which + 1u));
}

float share_of(const DripPoint& point)
{
    const float fed = 0.6f * shared::endless_noise_3(point.from_m / kFed_m, 611u) + 0.4f * shared::endless_noise_3(point.from_m / kFedFiner_m + 3.7f, 613u);
    const float well = glm::smoothstep(0.3f, 0.7f, fed);
    return glm::mix(kLeastShare, kMostShare, std::min(number_of(point.number, 2) * (0.4f + well), 1.0f));
}

// Of the round profile and its rings, at a way down from the root.
float radius_at(const Icicle& icicle, float length_m, float down_m)
{
    const float ring_m = std::max(kRing_m, 4.0f * length_m / static_cast<float>(icicle.bands));
    const float grown = std::min(down_m / (2.0f * ring_m), 1.0f) * std::min((length_m - down_m) / ring_m, 1.0f);
    const float wave = portable_sin(kTurn * down_m / ring_m + icicle.turn);
    const float depth = icicle.bands >= 8 ? kRingDepth * std::max(grown, 0.0f) : 0.0f;
    return icicle_radius_m(length_m - down_m) * (1.0f + depth * wave);
}

}  // namespace

namespace {

// coarser: so many steps of fineness less than near each eye.
Icicles hung(std::span<const DripPoint> points, std::span<const vec3> eyes_m, std::size_t coarser)
{
    Icicles all;
    for (const DripPoint& point : points) {
        float near_m = eyes_m.empty() ? 5.0f : 1.0e9f;
        for (const vec3& eye : eyes_m) near_m = std::min(near_m, glm::distance(eye, point.from_m));
        if (near_m > kFarthest_m) continue;
        std::size_t step = 0;
        while (near_m > kFineness[step].to_m) ++step;
        const Fineness& fine = kFineness[std::min(step + coarser, kFineness.size() - 1)];
        Icicle one;
        one.root_m = point.from_m - vec3(point.out.x, 0.0f, point.out.y) * kOut_m + vec3(0.0f, kUp_m, 0.0f);
        one.lean = (glm::vec2(number_of(point.number, 0), number_of(point.number, 1)) - 0.5f) * (2.0f * kLean);
        one.drained_m2 = point.drained_m2;
        one.share = share_of(point);
        one.most_m = std::clamp(point.from_m.y - point.ground_m - kClear_m, 0.0f, kLongestIcicle_m);
        one.shortest_m = std::max(kShortestIcicle_m, kUnseen * near_m);
        one.turn = kTurn * number_of(point.number, 3);
        one.drip = static_cast<std::uint32_t>(&point - points.data());
        one.sides = fine.sides;
        one.bands = fine.bands;
        all.icicles.push_back(one);
    }
    const auto cell = [](const Icicle& one) {
        return std::make_tuple(std::floor(one.root_m.x / kCell_m), std::floor(one.root_m.z / kCell_m));
    };
    std::stable_sort(all.icicles.begin(), all.icicles.end(), [&](const Icicle& a, const Icicle& b) { return cell(a) < cell(b); });
    for (std::uint32_t i = 0; i < all.icicles.size(); ++i) {
        Icicle& one = all.icicles[i];
        one.first_vertex = all.vertices;
        all.vertices += icicle_vertices(one);
        all.triangles += icicle_triangles(one);
        if (i == 0 || cell(one) != cell(all.icicles[i - 1])) all.parts.push_back({i, i, {vec3(1.0e30f), vec3(-1.0e30f)}});
        Icicles::Part& part = all.parts.back();
        part.end = i + 1;
        const float wide_m = 2.0f * icicle_radius_m(one.most_m) + 2.0f * kLean * one.most_m;
        part.box.low = glm::min(part.box.low, one.root_m - vec3(wide_m, one.most_m + 0.01f, wide_m));
        part.box.high = glm::max(part.box.high, one.root_m + vec3(wide_m));
    }
    return all;
}

}  // namespace

Icicles hang_icicles(std::span<const DripPoint> points, std::span<const vec3> eyes_m)
{
    Icicles all = hung(points, eyes_m, 0);
    for (std::size_t coarser = 1; coarser < kFineness.size() && all.triangles > kMostTriangles; ++coarser)
        all = hung(points, eyes_m, coarser);
    return all;
}

float icicle_length_m(const Icicle& icicle, const IcicleLengths& lengths)
{
    const float length_m = std::min(icicle_length_m(lengths, icicle.drained_m2) * icicle.share, icicle.most_m);
    return length_m >= icicle.shortest_m ? length_m : 0.0f;
}

std::uint32_t icicle_vertices(const Icicle& icicle)
{
    return static_cast<std::uint32_t>(rings_of(icicle) * icicle.sides + 2);
}

std::uint32_t icicle_triangles(const Icicle& icicle)
{
    return static_cast<std::uint32_t>(2 * (rings_of(icicle) - 1) * icicle.sides + 2 * icicle.sides);
}

void shape_icicle(const Icicle& icicle, float length_m, std::span<vec3> positions, std::span<vec3> normals)
{
    const int rings = rings_of(icicle), sides = icicle.sides;
    const float step = kTurn / static_cast<float>(sides);
    // Of corners whose section is as large as the round one.
    const float corner = std::sqrt(step / portable_sin(step));
    const float root_m = icicle_radius_m(length_m);
    const auto axis = [&](float down_m) {
        return icicle.root_m + vec3(icicle.lean.x * down_m, -down_m, icicle.lean.y * down_m);
    };
    std::size_t v = 0;
    for (int ring = 0; ring < rings; ++ring) {
        float down_m = 0.0f, radius_m = 0.0f, slope = 0.0f;
        if (ring < kDomes) {
            const auto& dome = kDome[static_cast<std::size_t>(ring)];
            down_m = -dome[0] * root_m;
            radius_m = dome[1] * root_m;
            slope = dome[0] / std::max(dome[1], 0.1f) * 2.0f;
        } else {
            down_m = length_m * static_cast<float>(ring - kDomes) / static_cast<float>(icicle.bands);
            radius_m = radius_at(icicle, length_m, down_m);
            const float d = 0.001f;
            const float above_m = std::max(down_m - d, 0.0f), below_m = std::min(down_m + d, length_m);
            slope = (radius_at(icicle, length_m, below_m) - radius_at(icicle, length_m, above_m)) / (below_m - above_m);
        }
        const vec3 middle = axis(down_m);
        for (int k = 0; k < sides; ++k) {
            const float angle = icicle.turn + step * static_cast<float>(k);
            const vec3 out(portable_cos(angle), 0.0f, portable_sin(angle));
            positions[v] = middle + out * (radius_m * corner);
            normals[v++] = glm::normalize(out + vec3(0.0f, slope, 0.0f));
        }
    }
    positions[v] = axis(-kDomeTop * root_m);
    normals[v++] = vec3(0.0f, 1.0f, 0.0f);
    positions[v] = axis(length_m + 0.6f * kIcicleTip_m);
    normals[v] = vec3(0.0f, -1.0f, 0.0f);
}

void icicle_indices(const Icicle& icicle, std::span<std::uint32_t> indices)
{
    const auto sides = static_cast<std::uint32_t>(icicle.sides);
    const auto rings = static_cast<std::uint32_t>(rings_of(icicle));
    const std::uint32_t top = rings * sides, tip = top + 1;
    std::size_t i = 0;
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        for (const std::uint32_t corner : {a, b, c}) indices[i++] = icicle.first_vertex + corner;
    };
    for (std::uint32_t k = 0; k < sides; ++k) {
        const std::uint32_t next = (k + 1) % sides;
        add(top, next, k);
        for (std::uint32_t ring = 0; ring + 1 < rings; ++ring) {
            const std::uint32_t a = ring * sides, b = a + sides;
            add(a + k, a + next, b + k);
            add(a + next, b + next, b + k);
        }
        add((rings - 1) * sides + k, (rings - 1) * sides + next, tip);
    }
}

void add_icicle_material(Scene& scene)
{
    Material ice;
    ice.name = kName;
    // What bubbles scatter, half of it from behind; the rest is seen through it (formulas/light/clear_ice.h). Ours, by eye.
    ice.base_color = glm::vec4(0.20f, 0.215f, 0.225f, 1.0f);
    ice.metallic = 0.0f;
    ice.roughness = 0.06f;
    ice.ior = 1.31f;
    ice.diffuse_transmission = 0.5f;
    ice.weather.wetness = Wetness::None;
    ice.weather.porosity = 0.0f;
    ice.weather.sheltered = true;
    scene.materials.push_back(std::move(ice));
    scene.meshes.push_back({kName, {}});
    Instance name;
    name.name = kName;
    name.mesh = static_cast<std::uint32_t>(scene.meshes.size() - 1);
    scene.instances.push_back(std::move(name));
}

bool find_icicle_material(const Scene& scene, Icicles& icicles)
{
    if (scene.instances.empty() || scene.instances.back().name != kName) return false;
    if (!scene.meshes[scene.instances.back().mesh].primitives.empty()) return false;
    for (std::size_t i = scene.materials.size(); i-- > 0;) {
        if (scene.materials[i].name != kName) continue;
        icicles.material = static_cast<std::uint32_t>(i);
        icicles.instance = static_cast<std::uint32_t>(scene.instances.size() - 1);
        return true;
    }
    return false;
}

}  // namespace petrichor::scene
