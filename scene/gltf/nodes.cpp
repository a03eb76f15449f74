#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "scene/animation/transform.h"
#include "scene/gltf/detail/gltf_parts.h"
#include "scene/light_shape.h"

namespace petrichor::scene {
namespace {

constexpr const char* kFixTree = "Give every node one parent at most, or export the scene again.";
constexpr const char* kFixDamaged = "Export the scene again: the file is damaged or incomplete.";

glm::dmat4 local_matrix(const JsonObject& node)
{
    glm::mat4 matrix(1.0f);
    if (node.numbers("matrix", {glm::value_ptr(matrix), 16})) {
        if (matrix[0][3] != 0.0f || matrix[1][3] != 0.0f || matrix[2][3] != 0.0f ||
            matrix[3][3] != 1.0f) {
            node.fail("matrix", "the last row must be 0 0 0 1", kFixDamaged);
        }
        if (node.has("translation") || node.has("rotation") || node.has("scale")) {
            node.warn("matrix", "a node with a matrix and other transforms: the matrix counts");
        }
        return glm::dmat4(matrix);
    }
    glm::vec3 translation(0.0f);
    glm::vec4 rotation(0.0f, 0.0f, 0.0f, 1.0f);
    glm::vec3 scale(1.0f);
    node.numbers("translation", {&translation.x, 3});
    node.numbers("rotation", {&rotation.x, 4});
    node.numbers("scale", {&scale.x, 3});
    const auto turned = to_rotation(rotation);
    if (!turned) node.fail("rotation", "is a quaternion of length 0", kFixDamaged);
    return compose(glm::dvec3(translation), *turned, glm::dvec3(scale));
}

// Checks that the nodes form trees. Gives the children by node.
std::vector<std::vector<std::uint32_t>> read_tree(const JsonArray& nodes,
                                                  std::vector<std::int32_t>& parents)
{
    std::vector<std::vector<std::uint32_t>> children(nodes.size());
    parents.assign(nodes.size(), kNoNode);
    for (std::uint32_t n = 0; n < nodes.size(); ++n) {
        const JsonArray list = nodes.object(n).array("children");
        for (std::size_t i = 0; i < list.size(); ++i) {
            const std::uint32_t child = list.index(i, "node", nodes.size());
            if (parents[child] != kNoNode) {
                nodes.object(n).log().fail(list.path_to(i),
                                           "node " + std::to_string(child) +
                                               " is already a child of node " +
                                               std::to_string(parents[child]),
                                           kFixTree);
            }
            parents[child] = static_cast<std::int32_t>(n);
            children[n].push_back(child);
        }
    }
    // With one parent each, every node that a root does not reach is on a cycle or hangs from one.
    std::vector<bool> reached(nodes.size(), false);
    std::vector<std::uint32_t> open;
    for (std::uint32_t n = 0; n < nodes.size(); ++n) {
        if (parents[n] == kNoNode) open.push_back(n);
    }
    while (!open.empty()) {
        const std::uint32_t n = open.back();
        open.pop_back();
        reached[n] = true;
        open.insert(open.end(), children[n].begin(), children[n].end());
    }
    for (std::uint32_t n = 0; n < nodes.size(); ++n) {
        if (!reached[n]) {
            const JsonObject node = nodes.object(n);
            node.fail("children", "is part of a cycle of nodes, or hangs from one", kFixTree);
        }
    }
    return children;
}

std::vector<std::uint32_t> scene_roots(const JsonObject& root,
                                       const std::vector<std::int32_t>& parents,
                                       std::string& scene_name)
{
    std::vector<std::uint32_t> roots;
    const JsonArray scenes = root.array("scenes");
    const auto chosen = root.index("scene", "scene", scenes.size());
    if (scenes.size() == 0) {
        for (std::uint32_t n = 0; n < parents.size(); ++n) {
            if (parents[n] == kNoNode) roots.push_back(n);
        }
        return roots;
    }
    const JsonObject scene = scenes.object(chosen.value_or(0));
    if (scene.has("name")) scene_name = scene.text("name");
    const JsonArray list = scene.array("nodes");
    std::vector<bool> listed(parents.size(), false);
    for (std::size_t i = 0; i < list.size(); ++i) {
        const std::uint32_t n = list.index(i, "node", parents.size());
        if (parents[n] != kNoNode || listed[n]) {
            scene.log().fail(
                list.path_to(i),
                "node " + std::to_string(n) +
                    (listed[n] ? " is listed twice" : " is not a root: it has a parent"),
                kFixTree);
        }
        listed[n] = true;
        roots.push_back(n);
    }
    return roots;
}

class NodeReader {
public:
    NodeReader(GltfSource& source, std::size_t mesh_count, Scene& scene)
        : source_(source),
          scene_(scene),
          mesh_count_(mesh_count),
          lights_(read_lights(source.root)),
          cameras_(read_cameras(source.root))
    {
    }

    void place(const JsonObject& node, std::size_t number, const glm::dmat4& to_world)
    {
        const std::string name = node.text("name", "node " + std::to_string(number));
        if (const auto mesh = node.index("mesh", "mesh", mesh_count_)) {
            const std::size_t first = scene_.instances.size();
            place_mesh(node, name, *mesh, to_world);
            if (scene_.rig) bind(node, number, first);
        }
        if (const auto index = node.index("camera", "camera", cameras_.size())) {
            Camera camera = cameras_[*index];
            charge(node, sizeof camera + camera.name.size());
            camera.to_world = glm::mat4(without_scale(to_world));
            if (scene_.rig) camera.node = static_cast<std::int32_t>(number);
            scene_.cameras.push_back(std::move(camera));
        }
        const auto extension = node.extension("KHR_lights_punctual");
        if (!extension) return;
        const auto& light = lights_[extension->require_index("light", "light", lights_.size())];
        if (!light) return;
        charge(node, sizeof *light + light->name.size());
        const glm::mat4 frame(without_scale(to_world));
        scene_.lights.push_back(*light);
        scene_.lights.back().position_m = glm::vec3(frame[3]);
        scene_.lights.back().direction = -glm::vec3(frame[2]);
        scene_.lights.back().up = glm::vec3(frame[1]);
        turn_shape(scene_.lights.back());
        if (scene_.rig) scene_.lights.back().node = static_cast<std::int32_t>(number);
    }

private:
    void charge(const JsonObject& node, std::size_t bytes)
    {
        source_.buffers.budget.take(1, bytes, node.path(), node.log());
    }

    // The instances from `first` on hang on their node, and bend by its skin.
    void bind(const JsonObject& node, std::size_t number, std::size_t first)
    {
        const auto skin = node.index("skin", "skin", scene_.rig->skins.size());
        for (std::size_t i = first; i < scene_.instances.size(); ++i) {
            Instance& instance = scene_.instances[i];
            instance.node = static_cast<std::int32_t>(number);
            if (skin) bind_skin(node, *skin, instance);
        }
    }

    void bind_skin(const JsonObject& node, std::uint32_t skin, Instance& instance)
    {
        const std::size_t joints = scene_.rig->skins[skin].joints.size();
        bool bends = false;
        for (const Primitive& primitive : scene_.meshes[instance.mesh].primitives) {
            for (const Influence& influence : primitive.influences) {
                if (influence.joint < joints) continue;
                node.fail("skin",
                          "has " + std::to_string(joints) + " joints, and mesh " +
                              std::to_string(instance.mesh) + " asks for joint " +
                              std::to_string(influence.joint),
                          kFixDamaged);
            }
            if (!primitive.influences.empty()) {
                bends = true;
            } else {
                node.warn("skin", "a mesh without JOINTS_0 is not bent by the node's skin");
            }
        }
        if (bends) instance.skin = static_cast<std::int32_t>(skin);
    }

    void place_mesh(const JsonObject& node, const std::string& name, std::uint32_t mesh,
                    const glm::dmat4& to_world)
    {
        const auto extension = node.extension("EXT_mesh_gpu_instancing");
        if (!extension) {
            charge(node, sizeof(Instance) + name.size());
            scene_.instances.push_back({name, mesh, glm::mat4(to_world)});
            return;
        }
        const auto attributes = extension->object("attributes");
        if (!attributes) extension->fail("attributes", "is missing", kFixDamaged);
        std::size_t count = 0;
        bool has_data = false;
        const auto find = [&](const char* key, int components) -> const Accessor* {
            const auto index = attributes->index(key, "accessor", source_.buffers.accessor_count());
            if (!index) return nullptr;
            const Accessor& accessor = source_.buffers.accessor(*index);
            if (accessor.components != components || (count != 0 && accessor.count != count)) {
                attributes->fail(key,
                                 "needs " + std::to_string(components) +
                                     " components and as many elements as the other attributes",
                                 kFixDamaged);
            }
            count = accessor.count;
            has_data = has_data || accessor.base;
            return &accessor;
        };
        const Accessor* translations = find("TRANSLATION", 3);
        const Accessor* rotations = find("ROTATION", 4);
        const Accessor* scales = find("SCALE", 3);
        const Accessor* colors = find_color(*attributes, count, has_data);
        if (count == 0) attributes->warn("", "no attribute that we know: nothing is placed");
        source_.buffers.budget.take(
            count, name.size() + (has_data ? sizeof(Instance) : Budget::kInventedElement),
            attributes->path(), node.log());
        for (std::size_t i = 0; i < count; ++i) {
            glm::vec3 translation(0.0f);
            glm::vec4 turn(0.0f, 0.0f, 0.0f, 1.0f);
            glm::vec3 scale(1.0f);
            for (int c = 0; c < 4; ++c) {
                if (translations && c < 3) translation[c] = translations->value(i, c);
                if (scales && c < 3) scale[c] = scales->value(i, c);
                if (rotations) turn[c] = rotations->value(i, c);
            }
            const auto rotation = to_rotation(turn);
            const glm::dmat4 placed =
                rotation ? to_world * compose(glm::dvec3(translation), *rotation, glm::dvec3(scale))
                         : glm::dmat4(0.0);
            if (!rotation || !is_usable(placed)) {
                attributes->fail("", "instance " + std::to_string(i) + " has no usable transform",
                                 kFixDamaged);
            }
            scene_.instances.push_back({name, mesh, glm::mat4(placed)});
            scene_.instances.back().in_node =
                glm::mat4(compose(glm::dvec3(translation), *rotation, glm::dvec3(scale)));
            if (colors) {
                glm::vec3 color(0.0f);
                for (int c = 0; c < 3; ++c) color[c] = colors->value(i, c);
                scene_.instances.back().look.color = glm::clamp(color, 0.0f, 1.0f);
            }
        }
    }

    // Linear, with or without an alpha, which nothing reads.
    const Accessor* find_color(const JsonObject& attributes, std::size_t count, bool& has_data)
    {
        const auto index = attributes.index("_COLOR_0", "accessor", source_.buffers.accessor_count());
        if (!index) return nullptr;
        const Accessor& accessor = source_.buffers.accessor(*index);
        if ((accessor.components != 3 && accessor.components != 4) || accessor.count != count) {
            attributes.fail("_COLOR_0",
                            "needs 3 or 4 components and as many elements as the other attributes",
                            kFixDamaged);
        }
        has_data = has_data || accessor.base;
        return &accessor;
    }

    GltfSource& source_;
    Scene& scene_;
    std::size_t mesh_count_;
    std::vector<std::optional<Light>> lights_;
    std::vector<Camera> cameras_;
};

}  // namespace

void read_nodes(GltfSource& source, std::size_t mesh_count, Scene& scene)
{
    const JsonArray nodes = source.root.array("nodes");
    std::vector<std::int32_t> parents;
    const auto children = read_tree(nodes, parents);
    scene.rig = read_rig(source, parents);
    NodeReader reader(source, mesh_count, scene);

    struct Visit {
        std::uint32_t node;
        glm::dmat4 parent_to_world;
    };
    std::vector<Visit> open;  // a stack of our own: files may nest a million deep
    const auto roots = scene_roots(source.root, parents, scene.name);
    for (auto n = roots.rbegin(); n != roots.rend(); ++n) open.push_back({*n, glm::dmat4(1.0)});
    while (!open.empty()) {
        const Visit visit = open.back();
        open.pop_back();
        const JsonObject node = nodes.object(visit.node);
        const glm::dmat4 to_world = visit.parent_to_world * local_matrix(node);
        if (!is_usable(to_world)) {
            node.fail("", "its place in the world is beyond 1e18", "Correct the node's transform.");
        }
        reader.place(node, visit.node, to_world);
        const auto& below = children[visit.node];
        for (auto n = below.rbegin(); n != below.rend(); ++n) open.push_back({*n, to_world});
    }
}

}  // namespace petrichor::scene
