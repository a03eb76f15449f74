#include "scene/gltf/glb_writer.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"
#include "scene/gltf/detail/glb_document.h"
#include "scene/gltf/detail/glb_material.h"
#include "scene/light_shape.h"

namespace petrichor::scene {

namespace {

using detail::number;
using detail::numbers;
using nlohmann::json;

constexpr int kFloat = 5126;
constexpr int kUnsignedInt = 5125;
constexpr int kUnsignedShort = 5123;
constexpr int kUnsignedByte = 5121;

class Writer {
public:
    explicit Writer(const scene::Scene& scene) : scene_(scene) {}

    std::vector<std::byte> write()
    {
        glb_.tree["asset"] = {{"version", "2.0"}, {"generator", "petrichor"}};
        detail::add_textures(glb_, scene_);
        for (const scene::Material& material : scene_.materials) {
            detail::add_material(glb_, scene_, material);
        }
        for (const scene::Mesh& mesh : scene_.meshes) add_mesh(mesh);
        add_nodes();
        return glb_.container();
    }

private:
    static std::vector<std::uint8_t> to_bytes(const std::vector<glm::vec4>& values)
    {
        std::vector<std::uint8_t> bytes;
        bytes.reserve(values.size() * 4);
        for (const glm::vec4& v : values) {
            for (int c = 0; c < 4; ++c) {
                bytes.push_back(
                    static_cast<std::uint8_t>(std::lround(std::clamp(v[c], 0.0f, 1.0f) * 255.0f)));
            }
        }
        return bytes;
    }

    // A byte a channel: the accessor counts vertices, not bytes.
    std::size_t add_byte_colors(const std::vector<glm::vec4>& values)
    {
        const std::size_t accessor =
            glb_.add_accessor(to_bytes(values), "VEC4", kUnsignedByte, 34962, true);
        glb_.tree["accessors"][accessor]["count"] = values.size();
        return accessor;
    }

    // Two bytes an index where they suffice (65535 itself means "restart" to some readers).
    std::size_t add_indices(const scene::Primitive& p)
    {
        if (p.positions.size() > 65535)
            return glb_.add_accessor(p.indices, "SCALAR", kUnsignedInt, 34963);
        const std::vector<std::uint16_t> narrow(p.indices.begin(), p.indices.end());
        return glb_.add_accessor(narrow, "SCALAR", kUnsignedShort, 34963);
    }

    json primitive(const scene::Primitive& p)
    {
        const std::size_t count = p.positions.size();
        const auto fits = [count](std::size_t n) { return n == 0 || n == count; };
        const bool inside = std::all_of(p.indices.begin(), p.indices.end(),
                                        [count](std::uint32_t i) { return i < count; });
        if (count == 0 || p.indices.empty() || p.indices.size() % 3 != 0 || !inside ||
            !fits(p.normals.size()) || !fits(p.uv0.size()) || !fits(p.uv1.size()) ||
            !fits(p.tangents.size()) || !fits(p.colors.size()) || !fits(p.weather.size()) ||
            p.material >= scene_.materials.size()) {
            throw Error(
                "glb: a primitive of " + std::to_string(count) +
                    " vertices has arrays or indices that do not fit it",
                "Give every attribute one value a vertex and keep indices below the count.");
        }
        glm::vec3 low = p.positions.front();
        glm::vec3 high = low;
        for (const glm::vec3& position : p.positions) {
            low = glm::min(low, position);
            high = glm::max(high, position);
        }
        json attributes;
        const std::size_t positions = glb_.add_accessor(p.positions, "VEC3", kFloat, 34962);
        json& accessor = glb_.tree["accessors"][positions];
        // Bounds must be exact: the shortest decimal that reads back as the same float.
        accessor["min"] = {low.x, low.y, low.z};
        accessor["max"] = {high.x, high.y, high.z};
        attributes["POSITION"] = positions;
        if (!p.normals.empty())
            attributes["NORMAL"] = glb_.add_accessor(p.normals, "VEC3", kFloat, 34962);
        if (!p.tangents.empty())
            attributes["TANGENT"] = glb_.add_accessor(p.tangents, "VEC4", kFloat, 34962);
        if (!p.uv0.empty())
            attributes["TEXCOORD_0"] = glb_.add_accessor(p.uv0, "VEC2", kFloat, 34962);
        if (!p.uv1.empty())
            attributes["TEXCOORD_1"] = glb_.add_accessor(p.uv1, "VEC2", kFloat, 34962);
        if (!p.colors.empty()) attributes["COLOR_0"] = add_byte_colors(p.colors);
        if (!p.weather.empty()) attributes["_WEATHER"] = add_byte_colors(p.weather);
        return {{"attributes", attributes}, {"indices", add_indices(p)}, {"material", p.material}};
    }

    void add_mesh(const scene::Mesh& mesh)
    {
        json primitives = json::array();
        for (const scene::Primitive& p : mesh.primitives) primitives.push_back(primitive(p));
        glb_.tree["meshes"].push_back({{"name", mesh.name}, {"primitives", primitives}});
    }

    std::size_t add_node(const std::string& name, const glm::mat4& to_world)
    {
        json node = {{"name", name}};
        if (to_world != glm::mat4(1.0f)) {
            json matrix = json::array();
            for (int column = 0; column < 4; ++column) {
                for (int row = 0; row < 4; ++row) matrix.push_back(to_world[column][row]);
            }
            node["matrix"] = matrix;
        }
        glb_.tree["nodes"].push_back(node);
        return glb_.tree["nodes"].size() - 1;
    }

    void add_nodes()
    {
        for (const scene::Instance& instance : scene_.instances) {
            if (instance.mesh >= scene_.meshes.size()) {
                throw Error("glb: instance " + instance.name + " uses mesh " +
                                std::to_string(instance.mesh) + " of " +
                                std::to_string(scene_.meshes.size()),
                            "Add the mesh to the scene first.");
            }
            glb_.tree["nodes"][add_node(instance.name, instance.to_world)]["mesh"] = instance.mesh;
        }
        for (const scene::Camera& camera : scene_.cameras) {
            json out = {{"name", camera.name}};
            if (camera.orthographic_height_m > 0.0f) {
                out["type"] = "orthographic";
                out["orthographic"] = {{"xmag", number(0.5f * camera.orthographic_height_m)},
                                       {"ymag", number(0.5f * camera.orthographic_height_m)},
                                       {"znear", number(camera.near_m)},
                                       {"zfar", 1000.0}};
            } else {
                out["type"] = "perspective";
                out["perspective"] = {{"yfov", number(camera.vertical_fov_rad)},
                                      {"znear", number(camera.near_m)}};
            }
            glb_.tree["cameras"].push_back(out);
            glb_.tree["nodes"][add_node(camera.name, camera.to_world)]["camera"] =
                glb_.tree["cameras"].size() - 1;
        }
        for (const scene::Light& light : scene_.lights) add_light(light);
        json roots = json::array();
        for (std::size_t i = 0; i < glb_.tree["nodes"].size(); ++i) roots.push_back(i);
        glb_.tree["scenes"] = json::array({{{"name", scene_.name}, {"nodes", roots}}});
        glb_.tree["scene"] = 0;
    }

    void add_light(const scene::Light& light)
    {
        glb_.extensions.insert("KHR_lights_punctual");
        json out = {{"name", light.name},
                    {"color", numbers(light.color)},
                    {"intensity", number(scene::light_candela(light))}};
        if (light.range_m > 0.0f) out["range"] = number(light.range_m);
        out["type"] = light.kind == scene::LightKind::Directional ? "directional"
                      : light.kind == scene::LightKind::Spot      ? "spot"
                                                                  : "point";
        if (light.kind == scene::LightKind::Spot) {
            out["spot"] = {{"innerConeAngle", number(light.inner_cone_rad)},
                           {"outerConeAngle", number(light.outer_cone_rad)}};
        }
        const json shape = shape_of(light);
        if (!shape.empty()) {
            glb_.extensions.insert("PETRICHOR_lights_shape");
            out["extensions"]["PETRICHOR_lights_shape"] = shape;
        }
        json& lights = glb_.tree["extensions"]["KHR_lights_punctual"]["lights"];
        lights.push_back(out);
        // A light shines along -z of its node.
        const glm::vec3 back = -glm::normalize(light.direction);
        const bool turned = std::abs(glm::dot(light.up, back)) < 0.99f;
        const glm::vec3 helper = turned                      ? light.up
                                 : std::abs(back.y) < 0.9f ? glm::vec3(0, 1, 0)
                                                           : glm::vec3(1, 0, 0);
        const glm::vec3 right = glm::normalize(glm::cross(helper, back));
        const glm::mat4 to_world(glm::vec4(right, 0.0f), glm::vec4(glm::cross(back, right), 0.0f),
                                 glm::vec4(back, 0.0f), glm::vec4(light.position_m, 1.0f));
        const std::size_t node = add_node(light.name, to_world);
        glb_.tree["nodes"][node]["extensions"]["KHR_lights_punctual"]["light"] = lights.size() - 1;
    }

    static json shape_of(const scene::Light& light)
    {
        json shape = json::object();
        const scene::LightShape own = shape_of_light(light);
        for (const scene::LightProperty& row : scene::light_table()) {
            const auto value = row.get(own);
            if (row.gltf.empty() || !value) continue;
            if (row.flag) shape[std::string(row.gltf)] = *value > 0.5f;
            else shape[std::string(row.gltf)] = number(*value);
        }
        if (own.both_sides) shape["bothSides"] = true;
        return shape;
    }

    const scene::Scene& scene_;
    detail::GlbDocument glb_;
};

}  // namespace

std::vector<std::byte> write_glb(const scene::Scene& scene)
{
    return Writer(scene).write();
}

}  // namespace petrichor::scene
