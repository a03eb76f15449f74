#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>

#include "scene/animation/transform.h"
#include "scene/gltf/detail/gltf_parts.h"

namespace petrichor::scene {
namespace {

constexpr const char* kFixDamaged = "Export the scene again: the file is damaged or incomplete.";
constexpr const char* kFixKeys = "Correct the keys, or export the animation again.";
constexpr const char* kVisibility = "KHR_node_visibility";
constexpr const char* kPointer = "KHR_animation_pointer";
constexpr float kLargest = 1e18f;

std::vector<float> list_of_numbers(const JsonObject& json, std::string_view key)
{
    std::vector<float> values(json.array(key).size());
    json.numbers(key, values);
    return values;
}

class RigReader {
public:
    RigReader(GltfSource& source, std::span<const std::int32_t> parents)
        : buffers_(source.buffers),
          nodes_(source.root.array("nodes")),
          meshes_(source.root.array("meshes")),
          skins_(source.root.array("skins")),
          animations_(source.root.array("animations")),
          parents_(parents.begin(), parents.end())
    {
    }

    std::shared_ptr<Rig> read()
    {
        bool hides = false;
        for (std::size_t n = 0; n < nodes_.size(); ++n)
            hides = hides || nodes_.object(n).extension(kVisibility).has_value();
        bool morphs = false;
        for (std::size_t m = 0; m < meshes_.size(); ++m) morphs = morphs || targets_of(m) > 0;
        if (!hides && !morphs && skins_.size() == 0 && animations_.size() == 0) return nullptr;

        auto rig = std::make_shared<Rig>();
        for (std::size_t n = 0; n < nodes_.size(); ++n)
            rig->nodes.push_back(read_node(nodes_.object(n), n));
        put_in_order(*rig);
        for (std::size_t s = 0; s < skins_.size(); ++s)
            rig->skins.push_back(read_skin(skins_.object(s)));
        for (std::size_t a = 0; a < animations_.size(); ++a) {
            Clip clip = read_clip(animations_.object(a), a, *rig);
            if (!clip.channels.empty()) rig->clips.push_back(std::move(clip));
        }
        return rig;
    }

private:
    std::size_t targets_of(std::size_t mesh) const
    {
        const JsonArray primitives = meshes_.object(mesh).array("primitives");
        std::size_t most = 0;
        for (std::size_t p = 0; p < primitives.size(); ++p)
            most = std::max(most, primitives.object(p).array("targets").size());
        return most;
    }

    std::size_t targets_of_node(const JsonObject& node) const
    {
        const auto mesh = node.index("mesh", "mesh", meshes_.size());
        return mesh ? targets_of(*mesh) : 0;
    }

    // Transforms were checked when the node was placed, or will be.
    RigNode read_node(const JsonObject& json, std::size_t number)
    {
        RigNode node;
        node.name = json.text("name", "node " + std::to_string(number));
        buffers_.budget.take(1, sizeof node + node.name.size(), json.path(), json.log());
        node.parent = parents_[number];
        glm::mat4 matrix(1.0f);
        if (json.numbers("matrix", {glm::value_ptr(matrix), 16})) node.matrix = glm::dmat4(matrix);
        glm::vec3 translation(0.0f), scale(1.0f);
        glm::vec4 rotation(0.0f, 0.0f, 0.0f, 1.0f);
        json.numbers("translation", {&translation.x, 3});
        json.numbers("rotation", {&rotation.x, 4});
        json.numbers("scale", {&scale.x, 3});
        const auto turned = to_rotation(rotation);
        if (!turned) json.fail("rotation", "is a quaternion of length 0", kFixDamaged);
        node.translation = glm::dvec3(translation);
        node.rotation = *turned;
        node.scale = glm::dvec3(scale);
        if (const std::size_t targets = targets_of_node(json)) {
            const auto mesh = meshes_.object(*json.index("mesh", "mesh", meshes_.size()));
            const JsonObject& holder = json.has("weights") ? json : mesh;
            node.weights = list_of_numbers(holder, "weights");
            if (!node.weights.empty() && node.weights.size() != targets) {
                holder.warn("weights", "there are more or fewer than morph targets; those that are "
                                       "missing are 0");
            }
            buffers_.budget.take(targets, sizeof(float), json.path(), json.log());
            node.weights.resize(targets, 0.0f);
        }
        if (const auto extension = json.extension(kVisibility))
            node.visible = extension->flag("visible", true);
        return node;
    }

    static void put_in_order(Rig& rig)
    {
        // A level of the tree at a time; the trees were checked for cycles.
        std::vector<std::vector<std::uint32_t>> children(rig.nodes.size());
        for (std::uint32_t n = 0; n < rig.nodes.size(); ++n) {
            const std::int32_t parent = rig.nodes[n].parent;
            if (parent == kNoNode)
                rig.order.push_back(n);
            else
                children[static_cast<std::size_t>(parent)].push_back(n);
        }
        for (std::size_t i = 0; i < rig.order.size(); ++i) {
            const auto& below = children[rig.order[i]];
            rig.order.insert(rig.order.end(), below.begin(), below.end());
        }
    }

    Skin read_skin(const JsonObject& json)
    {
        Skin skin;
        const JsonArray joints = json.array("joints");
        if (joints.size() == 0) json.fail("joints", "must name at least one node", kFixDamaged);
        for (std::size_t j = 0; j < joints.size(); ++j)
            skin.joints.push_back(joints.index(j, "node", nodes_.size()));
        skin.from_mesh_at_rest.assign(skin.joints.size(), glm::mat4(1.0f));
        const auto index =
            json.index("inverseBindMatrices", "accessor", buffers_.accessor_count());
        if (!index) return skin;
        const Accessor& accessor = buffers_.accessor(*index);
        if (accessor.components != 16 || accessor.type != ComponentType::Float ||
            accessor.count < skin.joints.size()) {
            json.fail("inverseBindMatrices",
                      "must be a MAT4 accessor of floats with a matrix for each of the " +
                          std::to_string(skin.joints.size()) + " joints",
                      kFixDamaged);
        }
        for (std::size_t j = 0; j < skin.joints.size(); ++j) {
            for (int i = 0; i < 16; ++i) {
                const float value = accessor.value(j, i);
                if (!(std::abs(value) <= kLargest)) {
                    json.fail("inverseBindMatrices",
                              "matrix " + std::to_string(j) + " is not of finite numbers below 1e18",
                              kFixDamaged);
                }
                skin.from_mesh_at_rest[j][i / 4][i % 4] = value;
            }
        }
        return skin;
    }

    Clip read_clip(const JsonObject& json, std::size_t number, const Rig& rig)
    {
        Clip clip;
        clip.name = json.text("name", "animation " + std::to_string(number));
        const JsonArray samplers = json.array("samplers");
        const JsonArray channels = json.array("channels");
        if (channels.size() == 0) json.warn("channels", "an animation without channels moves nothing");
        for (std::size_t c = 0; c < channels.size(); ++c) {
            const JsonObject channel_json = channels.object(c);
            auto channel = read_target(channel_json, rig);
            if (!channel) continue;
            const auto sampler = channel_json.require_index("sampler", "sampler", samplers.size());
            read_sampler(samplers.object(sampler), *channel);
            clip.channels.push_back(std::move(*channel));
        }
        return clip;
    }

    // Node and path of a channel; nothing when it moves what we do not move.
    std::optional<KeyTrack> read_target(const JsonObject& json, const Rig& rig)
    {
        const auto target = json.object("target");
        if (!target) json.fail("target", "is missing", kFixDamaged);
        std::string path = target->text("path");
        auto node = target->index("node", "node", nodes_.size());
        if (path == "pointer") {
            const auto extension = target->extension(kPointer);
            const std::string pointer = extension ? extension->text("pointer") : "";
            if (!split_pointer(pointer, node, path)) {
                target->warn("path", "an animation of " + in_quotes(pointer) +
                                         " is not played; those of nodes are");
                return std::nullopt;
            }
        }
        if (!node) {
            target->warn("node", "a channel without a node moves nothing");
            return std::nullopt;
        }
        KeyTrack channel;
        channel.node = *node;
        if (path == "translation") {
            channel.path = AnimatedPath::Translation;
        } else if (path == "rotation") {
            channel.path = AnimatedPath::Rotation;
            channel.width = 4;
        } else if (path == "scale") {
            channel.path = AnimatedPath::Scale;
        } else if (path == "weights") {
            channel.path = AnimatedPath::Weights;
            channel.width = static_cast<std::uint32_t>(rig.nodes[*node].weights.size());
        } else if (path == "visible") {
            channel.path = AnimatedPath::Visible;
            channel.width = 1;
        } else {
            target->warn("path", "unknown path " + in_quotes(path) + ": not played");
            return std::nullopt;
        }
        if (channel.width == 0) {
            target->warn("path", "weights of a node whose mesh has no morph targets move nothing");
            return std::nullopt;
        }
        const bool shapes =
            channel.path == AnimatedPath::Weights || channel.path == AnimatedPath::Visible;
        if (!shapes && rig.nodes[*node].matrix) {
            target->warn("node", "a node with a matrix cannot be animated; it stays");
            return std::nullopt;
        }
        return channel;
    }

    // "/nodes/3/translation", ".../extensions/KHR_node_visibility/visible".
    bool split_pointer(const std::string& pointer, std::optional<std::uint32_t>& node,
                       std::string& path) const
    {
        constexpr std::string_view kNodes = "/nodes/";
        if (!pointer.starts_with(kNodes)) return false;
        const char* end = pointer.data() + pointer.size();
        std::uint32_t number = 0;
        const auto read = std::from_chars(pointer.data() + kNodes.size(), end, number);
        if (read.ec != std::errc() || number >= nodes_.size()) return false;
        const std::string_view rest(read.ptr, static_cast<std::size_t>(end - read.ptr));
        for (const std::string_view word : {"translation", "rotation", "scale", "weights"}) {
            if (rest == "/" + std::string(word)) path = word;
        }
        if (rest == std::string("/extensions/") + kVisibility + "/visible") path = "visible";
        node = number;
        return path != "pointer";
    }

    void read_sampler(const JsonObject& json, KeyTrack& channel)
    {
        const std::string blend = json.text("interpolation", "LINEAR");
        if (blend == "STEP") {
            channel.blend = KeyBlend::Step;
        } else if (blend == "CUBICSPLINE") {
            channel.blend = KeyBlend::Cubic;
        } else if (blend != "LINEAR") {
            json.fail("interpolation", "must be LINEAR, STEP or CUBICSPLINE, got " + in_quotes(blend),
                      kFixKeys);
        }
        if (channel.path == AnimatedPath::Visible) channel.blend = KeyBlend::Step;
        const auto read = [&](const char* key, std::size_t count) {
            const Accessor& accessor = buffers_.accessor(
                json.require_index(key, "accessor", buffers_.accessor_count()));
            const auto components = static_cast<std::size_t>(accessor.components);
            if (count != 0 && accessor.count * components != count) {
                json.fail(key,
                          "has " + std::to_string(accessor.count * components) +
                              " numbers; the keys ask for " + std::to_string(count),
                          kFixDamaged);
            }
            if (count == 0 && (components != 1 || accessor.type != ComponentType::Float))
                json.fail(key, "must be a SCALAR accessor of floats", kFixDamaged);
            buffers_.budget.take(accessor.count,
                                 accessor.base ? 4 * components : Budget::kInventedElement,
                                 json.path_to(key), json.log());
            std::vector<float> values;
            values.reserve(accessor.count * components);
            for (std::size_t i = 0; i < accessor.count; ++i) {
                for (int c = 0; c < accessor.components; ++c) {
                    values.push_back(accessor.value(i, c));
                    if (std::abs(values.back()) <= kLargest) continue;
                    json.fail(key,
                              "element " + std::to_string(i) + " is not a finite number below 1e18",
                              kFixKeys);
                }
            }
            return values;
        };
        channel.times_s = read("input", 0);
        for (std::size_t i = 0; i < channel.times_s.size(); ++i) {
            const float before = i == 0 ? 0.0f : channel.times_s[i - 1];
            if (channel.times_s[i] >= before) continue;
            json.fail("input",
                      "key " + std::to_string(i) + " is at " +
                          number_text(static_cast<double>(channel.times_s[i])) + " s, after one at " +
                          number_text(static_cast<double>(before)) + " s; times must not fall",
                      kFixKeys);
        }
        const std::size_t parts = channel.blend == KeyBlend::Cubic ? 3 : 1;
        channel.values = read("output", channel.times_s.size() * parts * channel.width);
    }

    GltfBuffers& buffers_;
    JsonArray nodes_, meshes_, skins_, animations_;
    std::vector<std::int32_t> parents_;
};

}  // namespace

std::shared_ptr<Rig> read_rig(GltfSource& source, std::span<const std::int32_t> parents)
{
    return RigReader(source, parents).read();
}

}  // namespace petrichor::scene
