#include "film/scenes/node_tracks.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "base/error.h"
#include "base/portable_math.h"
#include "base/words.h"
#include "scene/animation/rig.h"
#include "scene/patches/tracer.h"

namespace petrichor::film {
namespace {

using glm::dvec2;
using glm::dvec3;

constexpr int kMostMoments = 4096;
constexpr double kPerFrame = 4.0;
constexpr double kSpacing_m = 0.15;   // between points of a way
constexpr double kStands_m = 0.05;    // what goes no farther stands
constexpr double kShortStep_m = 0.4;  // a foot on the ground goes no farther
constexpr double kOneTyre_m = 0.5;    // a node narrower than this has tyres on one line
constexpr double kJump_m = 0.3;       // moves so long within a moment are looked into
constexpr int kHalvings = 6;

// The points of a node that may be its lowest: the outermost in many directions, in its own space.
std::vector<dvec3> outermost(const scene::Scene& scene, const scene::Rig& rig, std::uint32_t node)
{
    std::vector<bool> below(rig.nodes.size(), false);
    for (const std::uint32_t i : rig.order) {
        const std::int32_t parent = rig.nodes[i].parent;
        below[i] = i == node || (parent != scene::kNoNode && below[static_cast<std::size_t>(parent)]);
    }
    std::vector<dvec3> directions;
    constexpr int kAround = 16;
    for (int i = 0; i < kAround; ++i) {
        const SinCos turn = portable_sin_cos(6.283185307179586 * i / kAround);
        directions.insert(directions.end(), {{turn.cosine, turn.sine, 0.0}, {0.0, turn.cosine, turn.sine}, {turn.sine, 0.0, turn.cosine}});
    }
    for (int i = 0; i < 8; ++i)
        directions.emplace_back((i & 1) != 0 ? 1.0 : -1.0, (i & 2) != 0 ? 1.0 : -1.0, (i & 4) != 0 ? 1.0 : -1.0);
    std::vector<dvec3> points(directions.size(), dvec3(0.0));
    std::vector<double> most(directions.size(), -1e300);
    const scene::Posture rest = scene::posture_at(rig, 0.0);
    const glm::dmat4 to_node = glm::inverse(rest.to_world[node]);
    bool any = false;
    for (const scene::Instance& instance : scene.instances) {
        if (!instance.moves || instance.skin >= 0 || instance.node == scene::kNoNode || !below[static_cast<std::size_t>(instance.node)]) continue;
        const glm::dmat4 place = to_node * glm::dmat4(scene::place_of(instance, rest));
        for (const scene::Primitive& primitive : scene.meshes[instance.mesh].primitives) {
            for (const glm::vec3& position : primitive.positions) {
                const dvec3 p(place * glm::dvec4(dvec3(position), 1.0));
                if (!std::isfinite(p.x + p.y + p.z)) continue;
                any = true;
                for (std::size_t d = 0; d < directions.size(); ++d) {
                    const double far = glm::dot(p, directions[d]);
                    if (far > most[d]) {
                        most[d] = far;
                        points[d] = p;
                    }
                }
            }
        }
    }
    // A joint, a node of a camera: itself.
    return any ? points : std::vector<dvec3>{dvec3(0.0)};
}

struct Moment {
    dvec2 below{0.0};           // the middle of the node, from above
    dvec3 lowest{0.0};
    std::vector<dvec3> points;  // in the world
    bool seen = true;
};

Moment moment_of(const scene::Rig& rig, std::uint32_t node, const std::vector<dvec3>& points, double animation_s)
{
    const scene::Posture posture = scene::posture_at(rig, animation_s);
    Moment m;
    m.seen = posture.visible[node];
    dvec3 low(1e300), high(-1e300);
    for (const dvec3& p : points) {
        low = glm::min(low, p);
        high = glm::max(high, p);
        m.points.emplace_back(posture.to_world[node] * glm::dvec4(p, 1.0));
    }
    const dvec3 middle(posture.to_world[node] * glm::dvec4(0.5 * (low + high), 1.0));
    m.below = {middle.x, middle.z};
    m.lowest = *std::min_element(m.points.begin(), m.points.end(), [](const dvec3& a, const dvec3& b) { return a.y < b.y; });
    return m;
}

// How high the ground is below; nothing: it is far, or there is none.
std::optional<double> ground_below(const scene::Tracer& still, const Moment& m)
{
    scene::Ray ray;
    ray.origin = glm::vec3(static_cast<float>(m.below.x), static_cast<float>(m.lowest.y + kInGround_m), static_cast<float>(m.below.y));
    ray.direction = {0.0f, -1.0f, 0.0f};
    ray.longest_m = static_cast<float>(kInGround_m + kNearGround_m);
    const scene::RayHit hit = still.nearest(ray);
    if (!hit.hit()) return std::nullopt;
    return static_cast<double>(ray.origin.y) - static_cast<double>(hit.distance_m);
}

// A clip that begins again puts a node elsewhere in no time: it goes no way between.
template <class At>
bool jumps(const At& at, double from_s, double to_s)
{
    dvec2 a = at(from_s).below, b = at(to_s).below;
    const double whole = glm::distance(a, b);
    if (whole < kJump_m) return false;
    for (int i = 0; i < kHalvings; ++i) {
        const double middle_s = 0.5 * (from_s + to_s);
        const dvec2 m = at(middle_s).below;
        if (glm::distance(a, m) > glm::distance(m, b)) {
            to_s = middle_s;
            b = m;
        } else {
            from_s = middle_s;
            a = m;
        }
    }
    return glm::distance(a, b) > 0.5 * whole;
}

// How wide a node is across its way.
double width_across(const Moment& m, const dvec2& along)
{
    const dvec2 side(along.y, -along.x);
    double low = 1e300, high = -1e300;
    for (const dvec3& p : m.points) {
        const double at = glm::dot(dvec2(p.x, p.z), side);
        low = std::min(low, at);
        high = std::max(high, at);
    }
    return high - low;
}

struct Run {
    std::vector<dvec2> points;
    std::vector<double> animation_s;
    dvec2 end{0.0};  // where it was on the ground last
    double end_s = 0.0;
    double low_y = 1e300, high_y = -1e300;
    double length_m() const
    {
        double sum = 0.0;
        for (std::size_t i = 1; i < points.size(); ++i) sum += glm::distance(points[i - 1], points[i]);
        return sum;
    }
};

struct Walk {
    std::vector<Run> runs;
    double gone_m = 0.0;  // in the air too
};

Walk walk_of(const scene::Tracer& still, const AnimationClock& clock, const auto& at)
{
    const double last_s = clock.start_s + clock.speed * (clock.frames - 1) / clock.fps;
    // What it went before the film begins is there in the first frame.
    const double first_s = clock.speed >= 0.0 ? std::min(0.0, clock.start_s) : clock.start_s;
    const double whole_s = std::abs(last_s - first_s);
    const double step_s = std::max(std::abs(clock.speed), 1e-3) / (kPerFrame * clock.fps);
    const int steps = static_cast<int>(std::clamp(std::ceil(whole_s / step_s), 1.0, static_cast<double>(kMostMoments)));
    Walk walk;
    bool on = false;
    std::optional<Moment> before;
    double before_s = first_s;
    for (int i = 0; i <= steps; ++i) {
        const double now_s = first_s + (last_s - first_s) * i / steps;
        const Moment now = at(now_s);
        const bool jumped = before && jumps(at, before_s, now_s);
        if (before && !jumped) walk.gone_m += glm::distance(now.below, before->below);
        const auto ground = now.seen ? ground_below(still, now) : std::nullopt;
        if (!ground || jumped) on = false;
        if (ground) {
            if (!on) walk.runs.emplace_back();
            Run& run = walk.runs.back();
            if (run.points.empty() || glm::distance(run.points.back(), now.below) >= kSpacing_m) {
                run.points.push_back(now.below);
                run.animation_s.push_back(now_s);
            }
            run.low_y = std::min(run.low_y, *ground);
            run.high_y = std::max(run.high_y, *ground);
            run.end = now.below;
            run.end_s = now_s;
            on = true;
        }
        before = now;
        before_s = now_s;
    }
    for (Run& run : walk.runs) {
        if (run.end_s == run.animation_s.back()) continue;
        run.points.push_back(run.end);
        run.animation_s.push_back(run.end_s);
    }
    return walk;
}

// Toes point from where the foot was before to where it is next.
dvec2 toes_of(const std::vector<Run>& runs, std::size_t i)
{
    const dvec2 from = runs[i > 0 ? i - 1 : i].points.front();
    const dvec2 to = runs[i + 1 < runs.size() ? i + 1 : i].points.back();
    const double length = glm::distance(from, to);
    return length > 1e-6 ? (to - from) / length : dvec2(0.0, -1.0);
}

std::vector<std::uint32_t> named_nodes(const ScenarioTrack& track, const scene::Scene& scene, std::vector<std::string>& notes)
{
    std::vector<std::uint32_t> nodes;
    std::set<std::string> names;
    if (scene.rig)
        for (const scene::RigNode& node : scene.rig->nodes)
            if (!node.name.empty()) names.insert(node.name);
    for (const scene::Instance& instance : scene.instances)
        if (!instance.name.empty()) names.insert(instance.name);
    for (const std::string& glob : track.nodes) {
        const auto is_named = [&](const std::string& name) { return glob_matches(glob, name); };
        if (std::none_of(names.begin(), names.end(), is_named)) {
            std::vector<std::string> known(names.begin(), names.end());
            const std::string hint = did_you_mean(glob, known);
            if (known.size() > 12) {
                known.resize(12);
                known.push_back("...");
            }
            throw Error(track.place + ": [ground] tracks: no node of the scene is named \"" + printable(glob) + "\"." + hint,
                        known.empty() ? "Name the nodes where the scene was exported." : "Use one of: " + printable(join_words(known)) + ".");
        }
        if (!scene.rig) {
            notes.push_back("[ground] tracks: \"" + printable(glob) + "\" does not move, and leaves none");
            continue;
        }
        for (std::uint32_t i = 0; i < scene.rig->nodes.size(); ++i) {
            const std::string& name = scene.rig->nodes[i].name;
            if (!name.empty() && is_named(name) && std::find(nodes.begin(), nodes.end(), i) == nodes.end()) nodes.push_back(i);
        }
    }
    return nodes;
}

}  // namespace

std::vector<NodeWay> node_ways(const std::vector<ScenarioTrack>& tracks, const scene::Scene& scene, const AnimationClock& clock,
                               std::vector<std::string>& notes)
{
    std::vector<NodeWay> ways;
    std::optional<scene::Triangles> triangles;
    std::optional<scene::Tracer> still;
    const auto film_s = [&](double animation_s) {
        return clock.speed != 0.0 ? (animation_s - clock.start_s) / clock.speed : animation_s - clock.start_s;
    };
    for (const ScenarioTrack& track : tracks) {
        for (const std::uint32_t node : named_nodes(track, scene, notes)) {
            if (!still) {
                triangles.emplace(scene, std::span<const scene::AlphaImage>());
                still.emplace(*triangles);
            }
            const std::string name = "[ground] tracks: \"" + printable(scene.rig->nodes[node].name) + "\" ";
            const std::vector<dvec3> points = outermost(scene, *scene.rig, node);
            const auto at = [&](double animation_s) { return moment_of(*scene.rig, node, points, animation_s); };
            const Walk walk = walk_of(*still, clock, at);
            if (walk.gone_m < kStands_m) {
                notes.push_back(name + "does not move in this film, and leaves none");
                continue;
            }
            const std::size_t before = ways.size();
            for (std::size_t i = 0; i < walk.runs.size(); ++i) {
                const Run& run = walk.runs[i];
                const double length = run.length_m();
                NodeWay one;
                one.way.tyre = track.tyre;
                one.way.depth = track.depth;
                one.way.low_y_m = run.low_y;
                one.way.high_y_m = run.high_y;
                one.way.points = run.points;
                for (const double s : run.animation_s) one.at_s.push_back(film_s(s));
                if (track.tyre) {
                    if (length < kStands_m) continue;
                    const std::size_t half = run.points.size() / 2;
                    const dvec2 step = run.points[half] - run.points[half - 1];
                    const double wide = width_across(at(run.animation_s[half]), glm::length(step) > 0.0 ? glm::normalize(step) : dvec2(0.0, 1.0));
                    const bool two = wide >= kOneTyre_m;
                    one.way.width_m = track.width_m > 0.0 ? track.width_m : two || wide <= 0.0 ? 0.22 : std::max(wide, 0.03);
                    one.way.gauge_m = track.gauge_m.value_or(two ? std::max(wide - one.way.width_m, 0.0) : 0.0);
                } else {
                    one.way.width_m = track.width_m > 0.0 ? track.width_m : 0.10;
                    if (length < kShortStep_m && walk.runs.size() > 1) {
                        const dvec2 middle = 0.5 * (run.points.front() + run.points.back());
                        const dvec2 toes = toes_of(walk.runs, i);
                        one.way.one_print = true;
                        one.way.points = {middle - 0.05 * toes, middle + 0.05 * toes};
                        one.at_s = {one.at_s.front(), one.at_s.front()};
                    } else if (length < kStands_m) {
                        continue;
                    }
                }
                ways.push_back(std::move(one));
            }
            if (ways.size() == before) notes.push_back(name + "comes nowhere near the ground, and leaves none");
        }
    }
    return ways;
}

NodeWay gone_by(const NodeWay& way, double film_s)
{
    NodeWay gone = way;
    const auto end = std::upper_bound(way.at_s.begin(), way.at_s.end(), film_s);
    const auto count = static_cast<std::size_t>(end - way.at_s.begin());
    gone.way.points.resize(count);
    gone.at_s.resize(count);
    if (count == 0 || count == way.at_s.size()) return gone;
    const double share = (film_s - way.at_s[count - 1]) / (way.at_s[count] - way.at_s[count - 1]);
    gone.way.points.push_back(glm::mix(way.way.points[count - 1], way.way.points[count], share));
    gone.at_s.push_back(film_s);
    return gone;
}

}  // namespace petrichor::film
