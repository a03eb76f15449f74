#include "scene/snow/detail/cap_ground.h"

#include <algorithm>
#include <array>
#include <unordered_map>

#include "scene/snow/detail/borders.h"

namespace petrichor::scene::detail {

using glm::vec2;
using glm::vec3;

namespace {

constexpr float kSteepest = 0.4f;  // y of the normals of what holds snow
// Of pieces that hang together: narrower than this they hold no cap. By area over border, of which what has
// ground beyond does not count: bars of a grating, the frame of a cover.
constexpr float kNarrowest_m = 0.04f;
constexpr double kSmallest_m2 = 0.0025;

// From a point to the box around a triangle: enough to leave out what is far.
float triangle_distance_m(const vec3& p, const vec3& a, const vec3& b, const vec3& c)
{
    const vec3 low = glm::min(a, glm::min(b, c)), high = glm::max(a, glm::max(b, c));
    return glm::distance(p, glm::clamp(p, low, high));
}

}  // namespace

float nearest_eye_m(const SnowCapOptions& options, const vec3& p)
{
    float nearest = options.eyes_m.empty() ? 0.0f : 1.0e30f;
    for (const vec3& eye : options.eyes_m) nearest = std::min(nearest, glm::distance(eye, p));
    return nearest;
}

Ground ground_of(const Scene& scene, const SnowCapOptions& options)
{
    Ground ground;
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        if (!instance.stands()) continue;
        const glm::mat3 linear(instance.to_world);
        const bool mirrored = glm::determinant(linear) < 0.0f;
        for (const Primitive& from : scene.meshes[instance.mesh].primitives) {
            const Material& m = scene.materials[from.material];
            if (!holds_snow_body(m)) continue;
            Primitive to;
            to.material = from.material;
            std::vector<std::uint32_t> number(from.positions.size(), 0xffffffffu), below;
            const auto place = [&](std::uint32_t v) {
                return vec3(instance.to_world * glm::vec4(from.positions[v], 1.0f));
            };
            for (std::size_t k = 0; k + 2 < from.indices.size(); k += 3) {
                std::array<std::uint32_t, 3> t{from.indices[k], from.indices[k + 1], from.indices[k + 2]};
                if (mirrored != m.cull_front) std::swap(t[1], t[2]);
                const vec3 a = place(t[0]), b = place(t[1]), c = place(t[2]);
                vec3 face = glm::cross(b - a, c - a);
                if (face.y < 0.0f && m.double_sided) {
                    std::swap(t[1], t[2]);
                    face = -face;
                }
                const float area = glm::length(face);
                if (!(face.y > kSteepest * area) || !(area < 1.0e12f)) continue;
                bool near = options.eyes_m.empty();
                for (const vec3& eye : options.eyes_m)
                    near = near || triangle_distance_m(eye, a, b, c) < options.reach_m;
                if (!near) continue;
                below.push_back(static_cast<std::uint32_t>(k / 3));
                for (const std::uint32_t v : t) {
                    if (number[v] == 0xffffffffu) {
                        number[v] = static_cast<std::uint32_t>(to.positions.size());
                        to.positions.push_back(place(v));
                        to.normals.push_back(face / area);
                        to.uv0.push_back(from.uv0.empty() ? vec2(0.0f) : from.uv0[v]);
                        to.uv1.push_back(from.uv1.empty() ? to.uv0.back() : from.uv1[v]);
                        to.colors.push_back(from.colors.empty() ? glm::vec4(1.0f) : from.colors[v]);
                        to.weather.push_back(from.weather.empty() ? glm::vec4(1.0f) : from.weather[v]);
                        to.tangents.push_back(from.tangents.empty() ? glm::vec4(1, 0, 0, 1)
                                                                    : from.tangents[v]);
                        const vec3 along = linear * vec3(to.tangents.back());
                        const float length = glm::length(along);
                        to.tangents.back() = glm::vec4(length > 0.0f ? along / length : vec3(1, 0, 0),
                                                       to.tangents.back().w);
                    }
                    to.indices.push_back(number[v]);
                }
            }
            if (to.indices.empty()) continue;
            ground.primitives.push_back(std::move(to));
            ground.numbers.push_back(static_cast<std::uint32_t>(&from - scene.meshes[instance.mesh].primitives.data()));
            ground.below.push_back(std::move(below));
            ground.instances.push_back(static_cast<std::uint32_t>(i));
        }
    }
    return ground;
}

void leave_out_hidden(CutMesh& mesh, Keeper keeper)
{
    for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
        const Primitive& p = mesh.primitives[i];
        keeper.keep(mesh, i, [&](std::size_t k) {
            const auto see = [&](std::size_t c) { return p.weather[p.indices[k + c]].w; };
            return !(std::max({see(0), see(1), see(2)}) < kHidden);
        });
    }
}

std::vector<std::vector<std::uint32_t>> composed(const std::vector<std::vector<std::uint32_t>>& first,
                                                 std::vector<std::vector<std::uint32_t>> second)
{
    for (std::size_t i = 0; i < second.size(); ++i)
        for (std::uint32_t& origin : second[i]) origin = first[i][origin];
    return second;
}

void leave_out_ledges(CutMesh& mesh, const Tracer& tracer, Keeper keeper)
{
    std::vector<std::uint32_t> parent(mesh.normals.size());
    for (std::uint32_t i = 0; i < parent.size(); ++i) parent[i] = i;
    const auto root = [&](std::uint32_t i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    };
    std::vector<double> area(parent.size(), 0.0), border(parent.size(), 0.0), ground(parent.size(), 0.0);
    std::unordered_map<std::uint64_t, int> triangles;  // at an edge
    const auto each = [&](const auto& visit) {
        for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
            const Primitive& p = mesh.primitives[i];
            for (std::size_t k = 0; k < p.indices.size(); ++k) {
                const std::uint32_t a = p.indices[k], b = p.indices[k % 3 == 2 ? k - 2 : k + 1];
                const std::uint32_t pa = mesh.points[i][a], pb = mesh.points[i][b];
                const auto key = (static_cast<std::uint64_t>(std::min(pa, pb)) << 32) | std::max(pa, pb);
                visit(p, k, pa, pb, key);
            }
        }
    };
    each([&](const Primitive&, std::size_t, std::uint32_t a, std::uint32_t b, std::uint64_t key) {
        parent[root(a)] = root(b);
        ++triangles[key];
    });
    each([&](const Primitive& p, std::size_t k, std::uint32_t a, std::uint32_t, std::uint64_t key) {
        const std::uint32_t r = root(a);
        const vec3 at = p.positions[p.indices[k]];
        const vec3 next = p.positions[p.indices[k % 3 == 2 ? k - 2 : k + 1]];
        if (triangles[key] == 1) border[r] += static_cast<double>(glm::distance(at, next));
        if (k % 3 != 0) return;
        const vec3 last = p.positions[p.indices[k + 2]];
        area[r] += 0.5 * static_cast<double>(glm::length(glm::cross(next - at, last - at)));
    });
    const auto narrow = [&](std::uint32_t r) {
        return area[r] < kSmallest_m2 ||
               2.0 * area[r] < static_cast<double>(kNarrowest_m) * (border[r] - ground[r]);
    };
    // Rays for those alone that are narrow otherwise.
    std::vector<bool> asked(parent.size());
    for (std::uint32_t r = 0; r < parent.size(); ++r) asked[r] = narrow(r);
    each([&](const Primitive& p, std::size_t k, std::uint32_t a, std::uint32_t, std::uint64_t key) {
        const std::uint32_t r = root(a);
        if (triangles[key] != 1 || !asked[r]) return;
        const vec3 at = p.positions[p.indices[k]];
        const vec3 next = p.positions[p.indices[k % 3 == 2 ? k - 2 : k + 1]];
        const vec3 inwards = p.positions[p.indices[k - k % 3 + (k + 2) % 3]] - at;
        vec2 out(next.z - at.z, at.x - next.x);
        const float length = glm::length(out);
        if (!(length > 1.0e-5f)) return;
        out /= glm::dot(out, vec2(inwards.x, inwards.z)) > 0.0f ? -length : length;
        const vec3 middle = 0.5f * (at + next);
        const Beyond there = beyond(tracer, middle, out);
        if (there == Beyond::Ground ||
            (there == Beyond::Nothing && gap_beyond_m(tracer, middle, out) < 1.0f))
            ground[r] += static_cast<double>(glm::distance(at, next));
    });
    for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
        const Primitive& p = mesh.primitives[i];
        keeper.keep(mesh, i, [&](std::size_t k) { return !narrow(root(mesh.points[i][p.indices[k]])); });
    }
}

}  // namespace petrichor::scene::detail
