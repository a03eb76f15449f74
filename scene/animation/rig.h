#ifndef PETRICHOR_SCENE_ANIMATION_RIG_H
#define PETRICHOR_SCENE_ANIMATION_RIG_H

#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace petrichor::scene {

/// A node as it stands at rest.
struct RigNode {
    std::string name;
    std::int32_t parent = kNoNode;
    glm::dvec3 translation{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    glm::dvec3 scale{1.0};
    std::optional<glm::dmat4> matrix;  ///< instead of the three
    std::vector<float> weights;        ///< of its mesh's morph targets
    bool visible = true;               ///< with all below it (KHR_node_visibility)
};

struct Skin {
    std::vector<std::uint32_t> joints;         ///< nodes
    std::vector<glm::mat4> from_mesh_at_rest;  ///< inverse bind matrices, one a joint
};

enum class AnimatedPath { Translation, Rotation, Scale, Weights, Visible };
enum class KeyBlend { Step, Linear, Cubic };

/// One property of a node over time. Before the first key it is as there, after the last as there.
struct KeyTrack {
    std::uint32_t node = 0;
    AnimatedPath path = AnimatedPath::Translation;
    KeyBlend blend = KeyBlend::Linear;
    std::uint32_t width = 3;      ///< numbers of a value
    std::vector<float> times_s;   ///< at least one; never fall; of equal ones the last counts
    std::vector<float> values;    ///< width a key; with Cubic in-tangent, value, out-tangent
};

/// Value of a channel at a time. Rotations are blended along the sphere and come out unit.
/// source: glTF 2.0 specification, appendix C (animation sampler interpolation modes).
std::vector<double> value_at(const KeyTrack& channel, double time_s);

/// Channels that play together.
struct Clip {
    std::string name;
    std::vector<KeyTrack> channels;

    /// Time of its last key.
    double duration_s() const;
};

struct Rig {
    std::vector<RigNode> nodes;
    std::vector<std::uint32_t> order;  ///< all nodes, parents before children
    std::vector<Skin> skins;
    std::vector<Clip> clips;       ///< once settled: those that are played
    bool settled = false;          ///< by settle_animation()
    bool loop = true;              ///< clips begin again when they end
};

/// Where everything is at a moment.
struct Posture {
    std::vector<glm::dmat4> to_world;         ///< by node
    std::vector<std::vector<float>> weights;  ///< of morph targets, by node
    std::vector<bool> visible;                ///< by node
};

/// `time_s` on the clock of the clips; a function of the two alone. Throws Error for a place that is
/// beyond 1e18.
Posture posture_at(const Rig& rig, double time_s);

/// Where the rest of an instance is then: from its mesh to the world; of a skinned one the identity.
glm::mat4 place_of(const Instance& instance, const Posture& posture);
/// From the mesh to the world by joint; empty without a skin.
std::vector<glm::mat4> joints_of(const Rig& rig, const Instance& instance, const Posture& posture);

/// The same light or camera where its node has carried it.
Light carried(const Light& light, const Posture& posture);
Camera carried(const Camera& camera, const Posture& posture);

}  // namespace petrichor::scene

#endif
