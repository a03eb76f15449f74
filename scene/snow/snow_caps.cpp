#include "scene/snow/snow_caps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "base/parallel.h"
#include "formulas/noise/noise.h"
#include "formulas/weather/surface_weather.h"
#include "scene/snow/detail/bank.h"
#include "scene/snow/detail/borders.h"
#include "scene/snow/detail/settle.h"
#include "scene/snow/detail/sheet.h"
#include "scene/snow/detail/sky_seen.h"
#include "scene/subdivide/subdivide.h"

namespace petrichor::scene {
namespace {

using detail::EdgeGrid;
using detail::NearEdge;
using glm::vec2;
using glm::vec3;

constexpr float kSteepest = 0.4f;     // y of the normals of what holds snow
constexpr float kCoarse_m = 0.4f;     // how far apart the sky is looked at
constexpr float kHidden = 0.1f;       // share of the sky that is none
constexpr int kRounds = 6;            // of finer cuts where a shelter ends ..
constexpr float kOtherSky = 0.2f;     // .. ends of an edge see so much more of the sky one than the other ..
constexpr float kFineSky_m = 0.06f;   // .. and are so far apart, as seen from 3 m on; nearer less ..
constexpr float kFinestSky_m = 0.01f; // .. down to this
constexpr float kEven_m = 0.04f;      // what is seen of it is evened out over edges up to this
constexpr int kEvenPasses = 8;
constexpr float kCoarser = 1.41421356f;
constexpr int kTries = 12;
constexpr float kAlong = 5.0f;        // times finer across an edge than along it
constexpr float kAlong_m = 0.2f;
constexpr float kTrack_m = 0.05f;     // edges where the snow is trodden
constexpr float kBridge_m = 0.018f;   // caps reach so far into walls and over joints
constexpr float kMeet_m = 0.004f;     // surfaces so near to each other meet
constexpr int kSpread = 12;           // edges that a support is told over

float nearest_eye_m(const SnowCapOptions& options, const vec3& p)
{
    float nearest = options.eyes_m.empty() ? 0.0f : 1.0e30f;
    for (const vec3& eye : options.eyes_m) nearest = std::min(nearest, glm::distance(eye, p));
    return nearest;
}

// From a point to the box around a triangle: enough to leave out what is far.
float triangle_distance_m(const vec3& p, const vec3& a, const vec3& b, const vec3& c)
{
    const vec3 low = glm::min(a, glm::min(b, c)), high = glm::max(a, glm::max(b, c));
    return glm::distance(p, glm::clamp(p, low, high));
}

// What faces up, in the world: a primitive for each of the scene's, with the exposure in w of _WEATHER.
struct Ground {
    std::vector<Primitive> primitives;
    std::vector<std::uint32_t> instances;
    std::vector<std::uint32_t> numbers;             // of the primitives in their meshes
    std::vector<std::vector<std::uint32_t>> below;  // of each primitive, by its triangles: which of the mesh's it was
};

// Keeps those triangles of a primitive that are wanted, and forgets which the others were a part of.
class Keeper {
public:
    explicit Keeper(Ground& ground) : ground_(&ground) {}

    template <class Wanted>
    void keep(CutMesh& mesh, std::size_t i, const Wanted& wanted)
    {
        Primitive& p = mesh.primitives[i];
        std::vector<std::uint32_t> kept, origins;
        for (std::size_t k = 0; k + 2 < p.indices.size(); k += 3) {
            const std::uint32_t origin = mesh.origins[i][k / 3];
            if (!wanted(k)) {
                ground_->below[i][origin] = SnowCaps::kUncovered;
                continue;
            }
            kept.insert(kept.end(), {p.indices[k], p.indices[k + 1], p.indices[k + 2]});
            origins.push_back(origin);
        }
        p.indices = std::move(kept);
        mesh.origins[i] = std::move(origins);
    }

private:
    Ground* ground_;
};

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

// What sees none of the sky, within houses and under eaves, has no cap.
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

// Which triangle of the first mesh each is a part of, after a second cut.
std::vector<std::vector<std::uint32_t>> composed(const std::vector<std::vector<std::uint32_t>>& first,
                                                 std::vector<std::vector<std::uint32_t>> second)
{
    for (std::size_t i = 0; i < second.size(); ++i)
        for (std::uint32_t& origin : second[i]) origin = first[i][origin];
    return second;
}

float smooth_noise(const vec3& p, float cell_m, std::uint32_t seed)
{
    return shared::tileable_noise(vec2(p.x, p.z) / cell_m, 1 << 20, seed);
}

// Of pieces that hang together: narrower than this they hold no cap. By area over border, of which what has
// ground beyond does not count: bars of a grating, the frame of a cover.
constexpr float kNarrowest_m = 0.04f;
constexpr double kSmallest_m2 = 0.0025;

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
        const detail::Beyond there = detail::beyond(tracer, middle, out);
        if (there == detail::Beyond::Ground ||
            (there == detail::Beyond::Nothing && detail::gap_beyond_m(tracer, middle, out) < 1.0f))
            ground[r] += static_cast<double>(glm::distance(at, next));
    });
    for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
        const Primitive& p = mesh.primitives[i];
        keeper.keep(mesh, i, [&](std::size_t k) { return !narrow(root(mesh.points[i][p.indices[k]])); });
    }
}

// Where nothing is kept of a triangle's depth, it is left out.
bool lies(const SnowCaps& caps, const std::array<std::uint32_t, 3>& t)
{
    return caps.points[t[0]].share > 0.02f || caps.points[t[1]].share > 0.02f ||
           caps.points[t[2]].share > 0.02f;
}

// The longest edge at each point.
std::vector<float> longest_edges_m(const CutMesh& mesh, std::size_t count)
{
    std::vector<float> longest(count, 0.0f);
    for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
        const Primitive& p = mesh.primitives[i];
        for (std::size_t k = 0; k < p.indices.size(); ++k) {
            const std::uint32_t a = p.indices[k];
            const std::uint32_t b = p.indices[k % 3 == 2 ? k - 2 : k + 1];
            const float length = glm::distance(p.positions[a], p.positions[b]);
            for (const std::uint32_t at : {mesh.points[i][a], mesh.points[i][b]}) longest[at] = std::max(longest[at], length);
        }
    }
    return longest;
}

// Share of the sky at each point. Rays are few, and a step of a hand's width from point to point is no step of the snow.
std::vector<float> even_sky(const CutMesh& mesh, std::size_t count)
{
    std::vector<float> sky(count, 0.0f);
    for (std::size_t i = 0; i < mesh.primitives.size(); ++i)
        for (std::size_t v = 0; v < mesh.points[i].size(); ++v) sky[mesh.points[i][v]] = mesh.primitives[i].weather[v].w;
    for (int pass = 0; pass < kEvenPasses; ++pass) {
        std::vector<float> sum(sky), weight(count, 1.0f);
        for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
            const Primitive& p = mesh.primitives[i];
            for (std::size_t k = 0; k < p.indices.size(); ++k) {
                const std::uint32_t a = p.indices[k], b = p.indices[k % 3 == 2 ? k - 2 : k + 1];
                const float length = glm::distance(p.positions[a], p.positions[b]);
                if (length >= kEven_m) continue;
                const float w = 1.0f - length / kEven_m;
                const std::uint32_t pa = mesh.points[i][a], pb = mesh.points[i][b];
                sum[pa] += w * sky[pb];
                sum[pb] += w * sky[pa];
                weight[pa] += w;
                weight[pb] += w;
            }
        }
        for (std::size_t i = 0; i < count; ++i) sky[i] = sum[i] / weight[i];
    }
    return sky;
}

// What of the depth lies at each point.
// broad: at first what shelter leaves, on any slope.
void fill_shares(SnowCaps& caps, const CutMesh& mesh, const std::vector<vec3>& normals, const SnowCapOptions& options)
{
    caps.points.resize(normals.size());
    const std::vector<float> even = even_sky(mesh, normals.size());
    for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
        const Primitive& p = mesh.primitives[i];
        for (std::size_t v = 0; v < p.positions.size(); ++v) {
            const std::uint32_t number = mesh.points[i][v];
            SnowCaps::Point& point = caps.points[number];
            point.base_m = p.positions[v];
            const float sky = even[number];
            const float ragged = 0.3f * (smooth_noise(point.base_m, 0.17f, 91u) - 0.5f);
            const float open = shared::smooth_edge(kHidden, 0.8f, sky + ragged * std::min(1.0f, 4.0f * (1.0f - sky)));
            const float slope = detail::snow_on_slope(normals[number].y);
            const float far = nearest_eye_m(options, point.base_m) / options.reach_m;
            point.broad = open * (1.0f - shared::smooth_edge(0.7f, 0.97f, far));
            point.share = point.broad * slope;
        }
    }
}

struct Grids {
    const EdgeGrid &edges, &slots, &closed, &low;
};

void fill_points(SnowCaps& caps, const CutMesh& mesh, const Grids& grids, const std::vector<vec3>& normals)
{
    const std::vector<float> longest = longest_edges_m(mesh, normals.size());
    parallel_for(caps.points.size(), 0, [&](std::size_t number) {
        SnowCaps::Point& point = caps.points[number];
        const vec3& at = point.base_m;
        const vec3& normal = normals[number];
        if (const NearEdge edge = grids.edges.nearest(at, normal); edge.border != nullptr) {
            point.edge_m = edge.distance_m;
            point.drop_m = edge.border->drop_m;
            point.out = edge.border->out;
            point.beyond = edge.border->beyond;
        }
        point.support_m = point.edge_m;
        if (const NearEdge border = grids.closed.nearest(at, normal); border.distance_m < 1.0e-3f)
            point.bridge_m = border.border->out * kBridge_m;
        if (const NearEdge step = grids.low.nearest(at, normal); step.border != nullptr) {
            point.low_m = step.distance_m;
            point.below = step.border->beyond;
        }
        if (const NearEdge slot = grids.slots.nearest(at, normal); slot.border != nullptr) {
            point.slot_m = slot.distance_m;
            point.gap_m = slot.border->gap_m;
            if (point.slot_m < 1.0e-3f) point.bridge_m = slot.border->out * (0.5f * point.gap_m + 0.01f);
        }
        point.uneven = detail::uneven_at(at, longest[number]);
    });
}

// What tracks press down, at last: the snow around them does not know of them.
void tread(SnowCaps& caps, const SnowCapOptions& options)
{
    if (!options.pressed) return;
    for (SnowCaps::Point& point : caps.points) {
        const float left = 1.0f - options.pressed(point.base_m);
        point.share *= left;
        point.broad *= left;
    }
}

// Surfaces that meet reach over each other a little: on a slope their borders would stand off each other.
void narrow_bridges(SnowCaps& caps, const std::vector<detail::Joint>& joints)
{
    std::vector<bool> meets(caps.points.size(), false);
    for (const detail::Joint& joint : joints) {
        const SnowCaps::Point &here = caps.points[joint.here], &there = caps.points[joint.beyond];
        const vec2 way(there.base_m.x - here.base_m.x, there.base_m.z - here.base_m.z);
        const float length = glm::length(here.bridge_m);
        const bool opposite = glm::dot(here.bridge_m, there.bridge_m) < -0.7f * length * glm::length(there.bridge_m);
        meets[joint.here] = meets[joint.here] || (opposite && std::abs(glm::dot(way, here.bridge_m)) < kMeet_m * length);
    }
    for (std::size_t i = 0; i < meets.size(); ++i)
        if (meets[i]) caps.points[i].bridge_m *= 0.5f;
}

// Whether tracks cross an edge.
bool is_trodden(const SnowCapOptions& options, const vec3& a, const vec3& b)
{
    if (!options.pressed) return false;
    const int steps = std::clamp(static_cast<int>(glm::distance(a, b) / kTrack_m), 2, 24);
    for (int i = 0; i <= steps; ++i) {
        const float t = static_cast<float>(i) / static_cast<float>(steps);
        if (options.pressed(a + (b - a) * t) > 0.02f) return true;
    }
    return false;
}

void find_supports(SnowCaps& caps, const CutMesh& mesh)
{
    for (SnowCaps::Point& p : caps.points) p.support_m = std::min(p.support_m, EdgeGrid::kReach_m);
    for (int pass = 0; pass < kSpread; ++pass) {
        std::vector<float> next(caps.points.size());
        for (std::size_t i = 0; i < next.size(); ++i) next[i] = caps.points[i].support_m;
        for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
            const Primitive& p = mesh.primitives[i];
            for (std::size_t k = 0; k < p.indices.size(); ++k) {
                const std::uint32_t a = mesh.points[i][p.indices[k]];
                const std::uint32_t b = mesh.points[i][p.indices[k % 3 == 2 ? k - 2 : k + 1]];
                next[a] = std::max(next[a], caps.points[b].support_m);
                next[b] = std::max(next[b], caps.points[a].support_m);
            }
        }
        for (std::size_t i = 0; i < next.size(); ++i) caps.points[i].support_m = next[i];
    }
}

// Corners of no triangle, and points that neither those that are left nor what lies below their edges ask for.
void leave_out_unused(SnowCaps& caps)
{
    std::vector<std::uint8_t> used(caps.corner_points.size(), 0);
    for (const std::uint32_t corner : caps.indices) used[corner] = 1;
    std::vector<std::uint32_t> corners(used.size(), SnowCaps::kNone), corner_points;
    std::vector<std::uint8_t> asked(caps.points.size(), 0);
    for (SnowCaps::Part& part : caps.parts) {
        const std::uint32_t first = part.first_corner, count = static_cast<std::uint32_t>(part.source.positions.size());
        part.first_corner = static_cast<std::uint32_t>(corner_points.size());
        for (std::uint32_t i = first; i < first + count; ++i) {
            if (used[i] == 0) continue;
            corners[i] = static_cast<std::uint32_t>(corner_points.size());
            corner_points.push_back(caps.corner_points[i]);
            asked[caps.corner_points[i]] = 1;
        }
        const auto keep = [&](auto& list) {
            std::size_t to = 0;
            for (std::uint32_t i = 0; i < count; ++i)
                if (used[first + i] != 0) list[to++] = list[i];
            list.resize(to);
        };
        Primitive& p = part.source;
        keep(p.positions);
        keep(p.normals);
        keep(p.tangents);
        keep(p.uv0);
        keep(p.uv1);
        keep(p.colors);
        keep(p.weather);
    }
    for (std::uint32_t& corner : caps.indices) corner = corners[corner];
    std::vector<std::uint32_t> numbers(caps.points.size(), SnowCaps::kNone);
    for (const std::uint32_t i : corner_points) {
        for (const std::uint32_t other : {caps.points[i].beyond, caps.points[i].below})
            if (other != SnowCaps::kNone) asked[other] = 1;
    }
    std::uint32_t left = 0;
    for (std::size_t i = 0; i < asked.size(); ++i) {
        if (asked[i] == 0) continue;
        numbers[i] = left;
        caps.points[left++] = caps.points[i];
    }
    caps.points.resize(left);
    for (SnowCaps::Point& point : caps.points) {
        for (std::uint32_t* other : {&point.beyond, &point.below})
            if (*other != SnowCaps::kNone) *other = numbers[*other];
    }
    for (std::uint32_t& i : corner_points) i = numbers[i];
    caps.corner_points = std::move(corner_points);
}

}  // namespace

bool holds_snow_body(const Material& m)
{
    return m.alpha_mode == AlphaMode::Opaque && m.transmission <= 0.0f && !m.weather.sheltered &&
           !m.decal.on && !m.wind.moves() &&
           m.weather.snow_rule == SnowRule::Surface && m.weather.snow_accumulation.y > 0.0f;
}

SnowCaps build_snow_caps(const Tracer& tracer, const SnowCapOptions& options)
{
    SnowCaps caps;
    Ground ground = ground_of(tracer.triangles().scene(), options);
    if (ground.primitives.empty()) return caps;
    SubdivideOptions coarse;
    coarse.most_levels = 12;
    // What is fine already stays so.
    std::size_t own = 0;
    for (const Primitive& p : ground.primitives) own += p.indices.size() / 3;
    coarse.most_triangles = own + options.most_triangles / 4;
    float scale = 1.0f;
    coarse.too_long = [&](const vec3& a, const vec3& b) {
        const float length = glm::distance(a, b);
        const float away = std::max(nearest_eye_m(options, 0.5f * (a + b)) - length, 0.0f);
        return length > scale * std::max(kCoarse_m, away * 0.08f);
    };
    CutMesh mesh = subdivide(ground.primitives, coarse);
    for (int i = 0; mesh.limited && i < kTries; ++i) {
        scale *= kCoarser;
        mesh = subdivide(ground.primitives, coarse);
    }
    leave_out_ledges(mesh, tracer, Keeper(ground));
    detail::SkySeen seen;
    detail::look_up(mesh, tracer, seen);
    leave_out_hidden(mesh, Keeper(ground));
    // Finer where a shelter ends: at the foot of what stands on large triangles.
    std::vector<std::vector<std::uint32_t>> first_cut = std::move(mesh.origins);
    for (int round = 0; round < kRounds; ++round) {
        SubdivideOptions at_shelters = coarse;
        at_shelters.most_levels = 1;
        at_shelters.most_triangles = own + options.most_triangles / 2;
        at_shelters.too_long = [&](const vec3& a, const vec3& b) {
            const auto at_a = seen.find(a), at_b = seen.find(b);
            if (at_a == seen.end() || at_b == seen.end() || std::abs(at_a->second - at_b->second) < kOtherSky) return false;
            const float away = nearest_eye_m(options, 0.5f * (a + b));
            return glm::distance(a, b) > std::max(kFinestSky_m, away < 3.0f ? away * 0.01f : std::max(kFineSky_m, away * 0.02f));
        };
        CutMesh finer = subdivide(mesh.primitives, at_shelters);
        if (finer.limited) break;
        mesh = std::move(finer);
        mesh.origins = composed(first_cut, std::move(mesh.origins));
        detail::look_up(mesh, tracer, seen);
        leave_out_hidden(mesh, Keeper(ground));
        first_cut = std::move(mesh.origins);
    }
    detail::Borders borders = detail::borders_of(mesh, tracer);
    EdgeGrid edges(std::move(borders.open));
    const EdgeGrid slots(std::move(borders.slots));
    const EdgeGrid closed(std::move(borders.closed));
    EdgeGrid low(std::move(borders.low));
    // Fine at the rims, coarse between them.
    caps.finest_m = options.finest_m;
    SubdivideOptions fine;
    fine.most_levels = 8;
    fine.most_triangles = own + options.most_triangles;
    const std::vector<Primitive> looked = std::move(mesh.primitives);
    fine.too_long = [&](const vec3& a, const vec3& b) {
        const vec3 middle = 0.5f * (a + b);
        const float away = nearest_eye_m(options, middle);
        const float least = std::max(caps.finest_m, away * options.per_metre);
        const float length = glm::distance(a, b);
        if (length <= least) return false;
        if (length > std::max(options.coarsest_m, away * 0.06f)) return true;
        if (length > std::max(least, kTrack_m) && is_trodden(options, a, b)) return true;
        // Across the edge its ends lie on one surface.
        const vec3 along = b - a;
        const vec3 side = glm::cross(along, vec3(0.0f, 1.0f, 0.0f));
        const vec3 normal = glm::cross(side, along);
        const float size = glm::length(normal);
        if (!(size > 0.0f)) return false;
        // A shoulder bends across its edge, and hardly along it.
        const auto bends = [&](const NearEdge& edge) {
            if (edge.border == nullptr) return false;
            const float roomy = 0.7f * edge.distance_m;
            if (length <= std::max(least, roomy)) return false;
            const float across = std::abs(glm::dot(vec2(along.x, along.z), edge.border->out));
            const float beside = std::sqrt(std::max(length * length - across * across, 0.0f));
            return across > std::max(least, roomy) || beside > std::max({kAlong * least, kAlong_m, roomy});
        };
        return bends(edges.nearest(middle, normal / size)) || bends(slots.nearest(middle, normal / size));
    };
    mesh = subdivide(looked, fine);
    for (int i = 0; mesh.limited && i < kTries; ++i) {
        caps.finest_m *= kCoarser;
        mesh = subdivide(looked, fine);
    }
    const std::vector<vec3> normals = point_normals(mesh);
    fill_shares(caps, mesh, normals, options);
    detail::find_beyond(edges.edges(), caps);
    detail::find_beyond(low.edges(), caps);
    fill_points(caps, mesh, {edges, slots, closed, low}, normals);
    find_supports(caps, mesh);
    const std::vector<detail::Joint> joints = detail::joints_of(caps);
    detail::hold_by_repose(caps, mesh, normals, joints);
    narrow_bridges(caps, joints);
    const detail::Sheet sheet = detail::fill_relief(caps, mesh, joints, tracer, options);
    std::vector<detail::BankPart> banks = detail::lay_banks(caps, mesh, sheet, edges.edges(), options);
    tread(caps, options);
    for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
        Primitive& p = mesh.primitives[i];
        SnowCaps::Part part;
        part.material = p.material;
        part.instance = ground.instances[i];
        part.primitive = ground.numbers[i];
        part.first_index = static_cast<std::uint32_t>(caps.indices.size());
        part.first_corner = static_cast<std::uint32_t>(caps.corner_points.size());
        std::vector<std::uint32_t> origins;
        for (std::size_t k = 0; k + 2 < p.indices.size(); k += 3) {
            const std::array<std::uint32_t, 3> t{mesh.points[i][p.indices[k]],
                                                 mesh.points[i][p.indices[k + 1]],
                                                 mesh.points[i][p.indices[k + 2]]};
            const std::uint32_t origin = first_cut[i][mesh.origins[i][k / 3]];
            if (!lies(caps, t)) {
                ground.below[i][origin] = SnowCaps::kUncovered;
                continue;
            }
            origins.push_back(origin);
            for (std::size_t c = 0; c < 3; ++c)
                caps.indices.push_back(part.first_corner + p.indices[k + c]);
        }
        for (const std::uint32_t origin : origins) part.below.push_back(ground.below[i][origin]);
        part.index_count = static_cast<std::uint32_t>(caps.indices.size()) - part.first_index;
        if (part.index_count == 0) continue;
        caps.corner_points.insert(caps.corner_points.end(), mesh.points[i].begin(), mesh.points[i].end());
        p.indices.clear();
        part.source = std::move(p);
        caps.parts.push_back(std::move(part));
    }
    // Banks stand for nothing of the scene: caps lie below them.
    for (detail::BankPart& bank : banks) {
        SnowCaps::Part part;
        part.material = mesh.primitives[bank.primitive].material;
        part.instance = ground.instances[bank.primitive];
        part.primitive = ground.numbers[bank.primitive];
        part.first_index = static_cast<std::uint32_t>(caps.indices.size());
        part.first_corner = static_cast<std::uint32_t>(caps.corner_points.size());
        part.index_count = static_cast<std::uint32_t>(bank.source.indices.size());
        part.below.assign(bank.source.indices.size() / 3, SnowCaps::kUncovered);
        for (const std::uint32_t corner : bank.source.indices) caps.indices.push_back(part.first_corner + corner);
        caps.corner_points.insert(caps.corner_points.end(), bank.points.begin(), bank.points.end());
        bank.source.indices.clear();
        bank.source.material = part.material;
        part.source = std::move(bank.source);
        caps.parts.push_back(std::move(part));
    }
    leave_out_unused(caps);
    caps.levels = build_snow_levels(caps, options.eyes_m);
    return caps;
}

}  // namespace petrichor::scene
