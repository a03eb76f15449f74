#include "scene/animation/settle.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "base/error.h"
#include "base/words.h"
#include "scene/animation/deform.h"
#include "scene/animation/rig.h"

namespace petrichor::scene {
namespace {

constexpr int kReachSteps = 64;  // moments of each clip at which its reach is looked at
constexpr float kReachSlack = 0.02f;  // of its size, for what lies between them

using Driven = std::pair<std::uint32_t, AnimatedPath>;

std::set<Driven> driven_by(const Clip& clip)
{
    std::set<Driven> driven;
    for (const KeyTrack& channel : clip.channels) driven.emplace(channel.node, channel.path);
    return driven;
}

std::string seconds_text(double seconds)
{
    return number_text(std::round(seconds * 1000.0) / 1000.0) + " s";
}

std::vector<Clip> chosen(const Scene& scene, const Playing& playing,
                         std::vector<std::string>& lines)
{
    const std::vector<Clip>& all = scene.rig->clips;
    std::vector<Clip> clips;
    std::vector<std::string> names, played, left;
    std::set<Driven> driven;
    for (const Clip& clip : all) {
        names.push_back(clip.name);
        bool plays = playing.animation == clip.name && clips.empty();
        if (playing.animation == "all") {
            const auto here = driven_by(clip);
            plays = std::none_of(here.begin(), here.end(),
                                 [&](const Driven& d) { return driven.count(d) != 0; });
            if (plays) driven.insert(here.begin(), here.end());
        } else if (playing.animation == "none") {
            plays = false;
        }
        const std::string name = "\"" + printable(clip.name) + "\"";
        if (plays) {
            clips.push_back(clip);
            played.push_back(name + " (" + seconds_text(clip.duration_s()) + ")");
        } else {
            left.push_back(name);
        }
    }
    const bool by_word = playing.animation == "all" || playing.animation == "none";
    if (!by_word && played.empty()) {
        throw Error("scene " + scene.name + ": there is no animation \"" +
                        printable(playing.animation) + "\"." +
                        did_you_mean(playing.animation, names),
                    names.empty() ? "Leave [scene] animation out: the scene has none."
                                  : "Use all, none, or one of: " + join_words(names) + ".");
    }
    constexpr std::size_t kMost = 8;
    const auto say = [&](const std::string& what, std::vector<std::string> words) {
        if (words.empty()) return;
        if (words.size() > kMost) {
            const std::size_t more = words.size() - kMost;
            words.resize(kMost);
            words.push_back("and " + std::to_string(more) + " more");
        }
        lines.push_back("animation: " + what + " " + join_words(words));
    };
    say(playing.loop ? "plays, again and again," : "plays once", played);
    if (playing.animation == "all") {
        say("they move what another moves, and are not played ([scene] animation names one):", left);
    } else {
        say("not played:", left);
    }
    return clips;
}

// Nodes whose place changes, and those whose weights or sight do.
struct Moving {
    std::vector<bool> placed, shaped;
};

Moving moving_nodes(const Rig& rig, const std::vector<Clip>& clips)
{
    Moving moving{std::vector<bool>(rig.nodes.size(), false),
                  std::vector<bool>(rig.nodes.size(), false)};
    for (const Clip& clip : clips) {
        for (const KeyTrack& channel : clip.channels) {
            auto& list =
                channel.path == AnimatedPath::Weights ? moving.shaped : moving.placed;
            list[channel.node] = true;
        }
    }
    for (const std::uint32_t n : rig.order) {
        const std::int32_t parent = rig.nodes[n].parent;
        if (parent != kNoNode && moving.placed[static_cast<std::size_t>(parent)])
            moving.placed[n] = true;
    }
    return moving;
}

bool instance_moves(const Rig& rig, const Moving& moving, const Instance& instance,
                    const Mesh& mesh)
{
    if (instance.node == kNoNode) return false;
    const auto node = static_cast<std::size_t>(instance.node);
    const bool morphs = std::any_of(mesh.primitives.begin(), mesh.primitives.end(),
                                    [](const Primitive& p) { return !p.targets.empty(); });
    if (moving.shaped[node] && morphs) return true;
    if (instance.skin < 0) return moving.placed[node];
    const auto& joints = rig.skins[static_cast<std::size_t>(instance.skin)].joints;
    // Its own node may still be hidden and shown.
    return moving.placed[node] ||
           std::any_of(joints.begin(), joints.end(), [&](auto j) { return moving.placed[j]; });
}

bool deforms(const Mesh& mesh)
{
    return std::any_of(mesh.primitives.begin(), mesh.primitives.end(),
                       [](const Primitive& p) { return p.deforms(); });
}

Mesh baked(const Mesh& mesh, std::span<const float> weights, std::span<const glm::mat4> joints)
{
    Mesh out = mesh;
    for (Primitive& p : out.primitives) {
        Shape shape = deformed(p, weights, joints);
        p.positions = std::move(shape.positions);
        p.normals = std::move(shape.normals);
        p.tangents = std::move(shape.tangents);
        p.targets.clear();
        p.influences.clear();
    }
    return out;
}

// What stays where it is takes its shape at rest. Instances that keep a mesh as it was share it on.
void bake_still(Scene& scene, const Rig& rig, const Posture& rest)
{
    std::vector<bool> kept(scene.meshes.size(), false);
    const std::size_t count = scene.meshes.size();
    for (Instance& instance : scene.instances) {
        if (instance.moves || !deforms(scene.meshes[instance.mesh])) {
            kept[instance.mesh] = true;
            continue;
        }
        const auto joints = joints_of(rig, instance, rest);
        std::span<const float> weights;
        if (instance.node != kNoNode) weights = rest.weights[static_cast<std::size_t>(instance.node)];
        scene.meshes.push_back(baked(scene.meshes[instance.mesh], weights, joints));
        instance.mesh = static_cast<std::uint32_t>(scene.meshes.size() - 1);
        instance.to_world = place_of(instance, rest);
        instance.skin = -1;
    }
    // Meshes that only baked instances showed are gone.
    std::vector<std::uint32_t> number(scene.meshes.size(), 0);
    std::vector<Mesh> meshes;
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        if (m < count && !kept[m]) continue;
        number[m] = static_cast<std::uint32_t>(meshes.size());
        meshes.push_back(std::move(scene.meshes[m]));
    }
    scene.meshes = std::move(meshes);
    for (Instance& instance : scene.instances) instance.mesh = number[instance.mesh];
}

void widen(std::optional<Bounds>& bounds, const Bounds& by)
{
    if (!bounds) bounds = by;
    bounds->low = glm::min(bounds->low, by.low);
    bounds->high = glm::max(bounds->high, by.high);
}

void widen_by_box(std::optional<Bounds>& bounds, const Bounds& box, const glm::mat4& to_world)
{
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 p(corner & 1 ? box.high.x : box.low.x, corner & 2 ? box.high.y : box.low.y,
                          corner & 4 ? box.high.z : box.low.z);
        const glm::vec3 world(to_world * glm::vec4(p, 1.0f));
        widen(bounds, {world, world});
    }
}

std::optional<Bounds> reach_of(const Scene& scene, const Rig& rig)
{
    std::optional<Bounds> reach;
    std::set<double> moments{0.0};
    for (const Clip& clip : rig.clips) {
        for (int i = 0; i <= kReachSteps; ++i)
            moments.insert(clip.duration_s() * (static_cast<double>(i) - 0.001) / kReachSteps);
    }
    std::vector<std::vector<Bounds>> boxes(scene.meshes.size());  // of what does not bend
    for (const Instance& instance : scene.instances) {
        if (!instance.moves || !boxes[instance.mesh].empty()) continue;
        for (const Primitive& p : scene.meshes[instance.mesh].primitives)
            boxes[instance.mesh].push_back(deformed_bounds(p, {}, {}));
    }
    // Deformed meshes cost every vertex at every moment: fewer of them.
    std::size_t n = 0;
    for (const double moment : moments) {
        const Posture posture = posture_at(rig, std::max(moment, 0.0));
        const bool shapes = n++ % 4 == 0;
        for (const Instance& instance : scene.instances) {
            if (!instance.moves) continue;
            const Mesh& mesh = scene.meshes[instance.mesh];
            const bool bends = deforms(mesh);
            if (bends && !shapes) continue;
            const auto joints = joints_of(rig, instance, posture);
            const auto& weights = posture.weights[static_cast<std::size_t>(instance.node)];
            for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
                const Bounds box = bends ? deformed_bounds(mesh.primitives[p], weights, joints)
                                         : boxes[instance.mesh][p];
                if (box.low.x <= box.high.x)
                    widen_by_box(reach, box, place_of(instance, posture));
            }
        }
    }
    if (reach) {
        const glm::vec3 slack(kReachSlack * glm::length(reach->high - reach->low));
        reach->low -= slack;
        reach->high += slack;
    }
    return reach;
}

}  // namespace

std::vector<std::string> settle_animation(Scene& scene, const Playing& playing)
{
    std::vector<std::string> lines;
    if (!scene.rig) {
        if (playing.animation == "all" || playing.animation == "none") return lines;
        throw Error("scene " + scene.name + ": there is no animation \"" +
                        printable(playing.animation) + "\"; it has none",
                    "Leave [scene] animation out.");
    }
    if (scene.rig->settled) return lines;
    auto rig = std::make_shared<Rig>(*scene.rig);
    const std::vector<Clip> clips = chosen(scene, playing, lines);
    rig->clips.clear();
    const Posture rest = posture_at(*rig, 0.0);
    const Moving moving = moving_nodes(*rig, clips);
    for (Instance& instance : scene.instances)
        instance.moves = instance_moves(*rig, moving, instance, scene.meshes[instance.mesh]);
    std::erase_if(scene.instances, [&](const Instance& i) {
        return !i.moves && i.node != kNoNode && !rest.visible[static_cast<std::size_t>(i.node)];
    });
    bake_still(scene, *rig, rest);
    rig->clips = clips;
    rig->loop = playing.loop;
    rig->settled = true;
    scene.reach = reach_of(scene, *rig);
    const auto moves = [&](std::int32_t node) {
        return node != kNoNode && moving.placed[static_cast<std::size_t>(node)];
    };
    bool any = std::any_of(scene.instances.begin(), scene.instances.end(),
                           [](const Instance& i) { return i.moves; });
    for (Light& light : scene.lights) {
        if (!moves(light.node)) light.node = kNoNode;
        any = any || light.node != kNoNode;
    }
    for (Camera& camera : scene.cameras) {
        if (!moves(camera.node)) camera.node = kNoNode;
        any = any || camera.node != kNoNode;
    }
    if (any)
        scene.rig = std::move(rig);
    else
        scene.rig = nullptr;
    return lines;
}

}  // namespace petrichor::scene
