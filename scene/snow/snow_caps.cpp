#include "scene/snow/snow_caps.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "scene/snow/detail/bank.h"
#include "scene/snow/detail/borders.h"
#include "scene/snow/detail/cap_ground.h"
#include "scene/snow/detail/cap_parts.h"
#include "scene/snow/detail/cap_points.h"
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

constexpr float kCoarse_m = 0.4f;     // how far apart the sky is looked at
constexpr int kRounds = 6;            // of finer cuts where a shelter ends ..
constexpr float kOtherSky = 0.2f;     // .. ends of an edge see so much more of the sky one than the other ..
constexpr float kFineSky_m = 0.06f;   // .. and are so far apart, as seen from 3 m on; nearer less ..
constexpr float kFinestSky_m = 0.01f; // .. down to this
constexpr float kCoarser = 1.41421356f;
constexpr int kTries = 12;
constexpr float kAlong = 5.0f;        // times finer across an edge than along it
constexpr float kAlong_m = 0.2f;
constexpr float kAlongSmall_m = 0.055f;  // .. on a small model, whose pads of snow bend along them too
constexpr float kRoomy = 0.7f;        // edges are so long, a metre from a rim ..
constexpr float kRoomySmall = 0.35f;  // .. on a small model
constexpr float kTrack_m = 0.05f;     // edges where the snow is trodden
constexpr float kBar_m = 0.05f;       // .. and on a bar, over which the snow bends as it does beside it ..
constexpr float kOnBar_m = 0.03f;     // .. so near to its slot

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

// Asks whether to go on: between parts of the work, and now and then in one.
class Stops {
public:
    explicit Stops(const StopRequest& stop) : stop_(stop) {}
    void ask() const
    {
        if (stop_ && stop_()) throw Interrupted("interrupted while the snow was shaped");
    }
    void ask_sometimes()
    {
        if (++count_ % 65536 == 0) ask();
    }

private:
    const StopRequest& stop_;
    std::uint32_t count_ = 0;
};

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
    Stops stops(options.stop);
    detail::Ground ground = detail::ground_of(tracer.triangles().scene(), options);
    if (ground.primitives.empty()) return caps;
    SubdivideOptions coarse;
    coarse.most_levels = 12;
    // What is fine already stays so.
    std::size_t own = 0;
    for (const Primitive& p : ground.primitives) own += p.indices.size() / 3;
    coarse.most_triangles = own + options.most_triangles / 4;
    float scale = 1.0f;
    coarse.too_long = [&](const vec3& a, const vec3& b) {
        stops.ask_sometimes();
        const float length = glm::distance(a, b);
        const float away = std::max(detail::nearest_eye_m(options, 0.5f * (a + b)) - length, 0.0f);
        return length > scale * std::max(kCoarse_m, away * 0.08f);
    };
    CutMesh mesh = subdivide(ground.primitives, coarse);
    for (int i = 0; mesh.limited && i < kTries; ++i) {
        scale *= kCoarser;
        mesh = subdivide(ground.primitives, coarse);
    }
    stops.ask();
    detail::leave_out_ledges(mesh, tracer, detail::Keeper(ground));
    detail::SkySeen seen;
    detail::look_up(mesh, tracer, seen);
    detail::leave_out_hidden(mesh, detail::Keeper(ground));
    // Finer where a shelter ends: at the foot of what stands on large triangles.
    std::vector<std::vector<std::uint32_t>> first_cut = std::move(mesh.origins);
    for (int round = 0; round < kRounds; ++round) {
        stops.ask();
        SubdivideOptions at_shelters = coarse;
        at_shelters.most_levels = 1;
        at_shelters.most_triangles = own + options.most_triangles / 2;
        at_shelters.too_long = [&](const vec3& a, const vec3& b) {
            const auto at_a = seen.find(a), at_b = seen.find(b);
            if (at_a == seen.end() || at_b == seen.end() || std::abs(at_a->second - at_b->second) < kOtherSky) return false;
            const float away = detail::nearest_eye_m(options, 0.5f * (a + b));
            return glm::distance(a, b) > std::max(kFinestSky_m, away < 3.0f ? away * 0.01f : std::max(kFineSky_m, away * 0.02f));
        };
        CutMesh finer = subdivide(mesh.primitives, at_shelters);
        if (finer.limited) break;
        mesh = std::move(finer);
        mesh.origins = detail::composed(first_cut, std::move(mesh.origins));
        detail::look_up(mesh, tracer, seen);
        detail::leave_out_hidden(mesh, detail::Keeper(ground));
        first_cut = std::move(mesh.origins);
    }
    stops.ask();
    detail::Borders borders = detail::borders_of(mesh, tracer);
    EdgeGrid edges(std::move(borders.open));
    const EdgeGrid slots(std::move(borders.slots));
    const EdgeGrid closed(std::move(borders.closed));
    EdgeGrid low(std::move(borders.low));
    const EdgeGrid bars(std::move(borders.bars));
    // Fine at the rims, coarse between them.
    caps.finest_m = options.finest_m;
    SubdivideOptions fine;
    fine.most_levels = 8;
    fine.most_triangles = own + options.most_triangles;
    const std::vector<Primitive> looked = std::move(mesh.primitives);
    const float small = detail::small_model(tracer);
    const float roomy_share = glm::mix(kRoomy, kRoomySmall, small);
    const float along_m = glm::mix(kAlong_m, kAlongSmall_m, small);
    fine.too_long = [&](const vec3& a, const vec3& b) {
        stops.ask_sometimes();
        const vec3 middle = 0.5f * (a + b);
        const float away = detail::nearest_eye_m(options, middle);
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
            const float roomy = roomy_share * edge.distance_m;
            if (length <= std::max(least, roomy)) return false;
            const float across = std::abs(glm::dot(vec2(along.x, along.z), edge.border->out));
            const float beside = std::sqrt(std::max(length * length - across * across, 0.0f));
            return across > std::max(least, roomy) || beside > std::max({kAlong * least, along_m, roomy});
        };
        if (length > std::max(least, kBar_m) && bars.nearest(middle, normal / size).distance_m < kOnBar_m) return true;
        return bends(edges.nearest(middle, normal / size)) || bends(slots.nearest(middle, normal / size));
    };
    mesh = subdivide(looked, fine);
    for (int i = 0; mesh.limited && i < kTries; ++i) {
        caps.finest_m *= kCoarser;
        mesh = subdivide(looked, fine);
    }
    const std::vector<vec3> normals = point_normals(mesh);
    detail::fill_shares(caps, mesh, normals, options);
    detail::find_beyond(edges.edges(), caps);
    detail::find_beyond(low.edges(), caps);
    stops.ask();
    detail::fill_points(caps, mesh, {edges, slots, closed, low}, normals);
    detail::find_supports(caps, mesh);
    const std::vector<detail::Joint> joints = detail::joints_of(caps);
    detail::hold_by_repose(caps, mesh, normals, joints);
    detail::narrow_bridges(caps, joints);
    stops.ask();
    const detail::Sheet sheet = detail::fill_relief(caps, mesh, joints, tracer, options);
    std::vector<detail::BankPart> banks = detail::lay_banks(caps, mesh, sheet, edges.edges(), options);
    detail::tread(caps, options);
    detail::add_parts(caps, mesh, ground, first_cut);
    detail::add_banks(caps, mesh, ground, banks);
    detail::leave_out_unused(caps);
    stops.ask();
    caps.levels = build_snow_levels(caps, options.eyes_m);
    return caps;
}

}  // namespace petrichor::scene
