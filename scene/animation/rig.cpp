#include "scene/animation/rig.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/error.h"
#include "scene/animation/transform.h"
#include "scene/light_shape.h"

namespace petrichor::scene {
namespace {

using Values = std::vector<double>;

void make_unit(Values& v)
{
    double length = 0.0;
    for (const double x : v) length += x * x;
    length = std::sqrt(length);
    if (!(length > 1e-12)) {
        v = {0.0, 0.0, 0.0, 1.0};
        return;
    }
    for (double& x : v) x /= length;
}

// Along the shorter arc; straight where the two are so near that its sine says nothing.
Values on_sphere(const Values& a, const Values& b, double s)
{
    double cosine = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) cosine += a[i] * b[i];
    const double sign = cosine < 0.0 ? -1.0 : 1.0;
    cosine = std::min(std::abs(cosine), 1.0);
    double of_a = 1.0 - s, of_b = s;
    if (cosine < 1.0 - 1e-9) {
        const double angle = std::acos(cosine);
        of_a = std::sin((1.0 - s) * angle) / std::sin(angle);
        of_b = std::sin(s * angle) / std::sin(angle);
    }
    Values out(a.size());
    for (std::size_t i = 0; i < a.size(); ++i) out[i] = of_a * a[i] + sign * of_b * b[i];
    return out;
}

// The time on a clip's own clock.
double clip_time_s(const Clip& clip, double time_s, bool loop)
{
    const double duration_s = clip.duration_s();
    if (!loop) return time_s;
    if (!(duration_s > 0.0)) return 0.0;
    const double within = std::fmod(time_s, duration_s);
    return within < 0.0 ? within + duration_s : within;
}

void apply(const KeyTrack& channel, double time_s, std::vector<RigNode>& nodes)
{
    RigNode& node = nodes[channel.node];
    const Values v = value_at(channel, time_s);
    switch (channel.path) {
        case AnimatedPath::Translation:
            node.translation = {v[0], v[1], v[2]};
            break;
        case AnimatedPath::Rotation:
            node.rotation = glm::dquat(v[3], v[0], v[1], v[2]);
            break;
        case AnimatedPath::Scale:
            node.scale = {v[0], v[1], v[2]};
            break;
        case AnimatedPath::Weights:
            node.weights.assign(v.begin(), v.end());
            break;
        case AnimatedPath::Visible:
            node.visible = v[0] != 0.0;
            break;
    }
}

}  // namespace

std::vector<double> value_at(const KeyTrack& channel, double time_s)
{
    const auto& times = channel.times_s;
    const std::size_t width = channel.width;
    const std::size_t parts = channel.blend == KeyBlend::Cubic ? 3 : 1;
    const auto read = [&](std::size_t key, std::size_t part) {
        const auto* from = channel.values.data() + (key * parts + part) * width;
        return Values(from, from + width);
    };
    const std::size_t middle = parts == 3 ? 1 : 0;
    const bool turns = channel.path == AnimatedPath::Rotation;
    const auto after = static_cast<std::size_t>(
        std::upper_bound(times.begin(), times.end(), time_s,
                         [](double t, float key) { return t < static_cast<double>(key); }) -
        times.begin());
    const std::size_t at = after == 0 ? 0 : after - 1;
    Values a = read(at, middle);
    if (after == 0 || after == times.size() || channel.blend == KeyBlend::Step) {
        if (turns) make_unit(a);
        return a;
    }
    const double start_s = static_cast<double>(times[at]);
    const double step_s = static_cast<double>(times[after]) - start_s;
    const double s = (time_s - start_s) / step_s;
    Values b = read(after, middle);
    Values out(width);
    if (channel.blend == KeyBlend::Cubic) {
        const Values leave = read(at, 2), arrive = read(after, 0);
        const double s2 = s * s, s3 = s2 * s;
        for (std::size_t i = 0; i < width; ++i) {
            out[i] = (2.0 * s3 - 3.0 * s2 + 1.0) * a[i] + step_s * (s3 - 2.0 * s2 + s) * leave[i] +
                     (3.0 * s2 - 2.0 * s3) * b[i] + step_s * (s3 - s2) * arrive[i];
        }
    } else if (turns) {
        make_unit(a);
        make_unit(b);
        out = on_sphere(a, b, s);
    } else {
        for (std::size_t i = 0; i < width; ++i) out[i] = a[i] + s * (b[i] - a[i]);
    }
    if (turns) make_unit(out);
    return out;
}

double Clip::duration_s() const
{
    double end_s = 0.0;
    for (const KeyTrack& channel : channels)
        end_s = std::max(end_s, static_cast<double>(channel.times_s.back()));
    return end_s;
}

Posture posture_at(const Rig& rig, double time_s)
{
    std::vector<RigNode> nodes = rig.nodes;
    for (const Clip& clip : rig.clips) {
        const double here_s = clip_time_s(clip, time_s, rig.loop);
        for (const KeyTrack& channel : clip.channels) apply(channel, here_s, nodes);
    }
    Posture posture;
    posture.to_world.resize(nodes.size());
    posture.weights.resize(nodes.size());
    posture.visible.resize(nodes.size());
    for (const std::uint32_t n : rig.order) {
        RigNode& node = nodes[n];
        const glm::dmat4 local =
            node.matrix ? *node.matrix : compose(node.translation, node.rotation, node.scale);
        const bool root = node.parent == kNoNode;
        const auto parent = static_cast<std::size_t>(node.parent);
        posture.to_world[n] = root ? local : posture.to_world[parent] * local;
        posture.visible[n] = node.visible && (root || posture.visible[parent]);
        posture.weights[n] = std::move(node.weights);
        if (!is_usable(posture.to_world[n])) {
            throw Error("animation: node \"" + node.name + "\" is beyond 1e18 at " +
                            std::to_string(time_s) + " s",
                        "Correct its keys, or export the scene again.");
        }
    }
    return posture;
}

glm::mat4 place_of(const Instance& instance, const Posture& posture)
{
    if (instance.skin >= 0) return glm::mat4(1.0f);
    if (instance.node == kNoNode) return instance.to_world;
    return glm::mat4(posture.to_world[static_cast<std::size_t>(instance.node)] *
                     glm::dmat4(instance.in_node));
}

std::vector<glm::mat4> joints_of(const Rig& rig, const Instance& instance, const Posture& posture)
{
    std::vector<glm::mat4> joints;
    if (instance.skin < 0) return joints;
    const Skin& skin = rig.skins[static_cast<std::size_t>(instance.skin)];
    for (std::size_t j = 0; j < skin.joints.size(); ++j) {
        joints.emplace_back(posture.to_world[skin.joints[j]] *
                            glm::dmat4(skin.from_mesh_at_rest[j]));
    }
    return joints;
}

Light carried(const Light& light, const Posture& posture)
{
    if (light.node == kNoNode) return light;
    const glm::mat4 frame(
        without_scale(posture.to_world[static_cast<std::size_t>(light.node)]));
    Light out = light;
    out.position_m = glm::vec3(frame[3]);
    out.direction = -glm::vec3(frame[2]);
    out.up = glm::vec3(frame[1]);
    turn_shape(out);
    return out;
}

Camera carried(const Camera& camera, const Posture& posture)
{
    if (camera.node == kNoNode) return camera;
    Camera out = camera;
    out.to_world =
        glm::mat4(without_scale(posture.to_world[static_cast<std::size_t>(camera.node)]));
    return out;
}

}  // namespace petrichor::scene
