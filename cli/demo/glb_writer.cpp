#include "cli/demo/glb_writer.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <tuple>

#include "base/error.h"

namespace petrichor::cli {

namespace {

using nlohmann::json;

constexpr int kFloat = 5126;
constexpr int kUnsignedInt = 5125;
constexpr int kUnsignedShort = 5123;
constexpr int kUnsignedByte = 5121;

// Numbers that came from floats, written with the digits a float has.
json number(float value)
{
    if (value == 0.0f) return 0.0;
    const double magnitude =
        std::pow(10.0, 7.0 - std::ceil(std::log10(std::abs(static_cast<double>(value)))));
    return std::round(static_cast<double>(value) * magnitude) / magnitude;
}

template <typename Vector>
json numbers(const Vector& v)
{
    json list = json::array();
    for (int i = 0; i < v.length(); ++i) list.push_back(number(v[i]));
    return list;
}

class Writer {
public:
    explicit Writer(const gpu::Scene& scene) : scene_(scene) {}

    std::vector<std::byte> write()
    {
        document_["asset"] = {{"version", "2.0"}, {"generator", "petrichor"}};
        add_textures();
        for (const gpu::Material& material : scene_.materials) add_material(material);
        for (const gpu::Mesh& mesh : scene_.meshes) add_mesh(mesh);
        add_nodes();
        document_["buffers"] = json::array({{{"byteLength", bytes_.size()}}});
        if (!extensions_.empty()) document_["extensionsUsed"] = extensions_;
        return container();
    }

private:
    template <typename T>
    std::size_t add_view(const T* data, std::size_t count, int target = 0)
    {
        while (bytes_.size() % 4 != 0) bytes_.push_back(std::byte{0});
        const std::size_t offset = bytes_.size();
        const std::size_t length = count * sizeof(T);
        bytes_.resize(offset + length);
        if (length != 0) std::memcpy(bytes_.data() + offset, data, length);
        json view = {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", length}};
        if (target != 0) view["target"] = target;
        document_["bufferViews"].push_back(view);
        return document_["bufferViews"].size() - 1;
    }

    template <typename T>
    std::size_t add_accessor(const std::vector<T>& values, const char* type, int component,
                             int target, bool normalized = false)
    {
        json accessor = {{"bufferView", add_view(values.data(), values.size(), target)},
                         {"componentType", component},
                         {"count", values.size()},
                         {"type", type}};
        if (normalized) accessor["normalized"] = true;
        document_["accessors"].push_back(accessor);
        return document_["accessors"].size() - 1;
    }

    void use(const char* extension) { extensions_.insert(extension); }

    json texture_info(const gpu::TextureUse& texture)
    {
        if (static_cast<std::size_t>(texture.texture) >= scene_.textures.size()) {
            throw Error("glb: texture " + std::to_string(texture.texture) + " of " +
                            std::to_string(scene_.textures.size()),
                        "Add the image to the scene before a material uses it.");
        }
        json info = {{"index", texture.texture}};
        if (texture.texcoord != 0) info["texCoord"] = texture.texcoord;
        if (texture.offset != glm::vec2(0.0f) || texture.scale != glm::vec2(1.0f) ||
            texture.rotation_rad != 0.0f) {
            use("KHR_texture_transform");
            json transform = {{"offset", numbers(texture.offset)},
                              {"scale", numbers(texture.scale)}};
            if (texture.rotation_rad != 0.0f) transform["rotation"] = number(texture.rotation_rad);
            info["extensions"]["KHR_texture_transform"] = transform;
        }
        return info;
    }

    void add_textures()
    {
        std::map<std::tuple<int, int, bool>, std::size_t> samplers;
        for (const gpu::EncodedImage& image : scene_.textures) {
            if (image.bytes.size() < 8) {
                throw Error("glb: image " + image.name + " is empty", "Encode it before writing.");
            }
            const bool png = image.bytes[0] == std::byte{0x89};
            const std::size_t view = add_view(image.bytes.data(), image.bytes.size());
            document_["images"].push_back({{"name", image.name},
                                           {"mimeType", png ? "image/png" : "image/jpeg"},
                                           {"bufferView", view}});
            const auto code = [](gpu::Wrap wrap) {
                return wrap == gpu::Wrap::Repeat ? 10497 : wrap == gpu::Wrap::Clamp ? 33071 : 33648;
            };
            const auto key = std::make_tuple(code(image.wrap_u), code(image.wrap_v), image.nearest);
            auto found = samplers.find(key);
            if (found == samplers.end()) {
                document_["samplers"].push_back({{"magFilter", image.nearest ? 9728 : 9729},
                                                 {"minFilter", 9987},
                                                 {"wrapS", std::get<0>(key)},
                                                 {"wrapT", std::get<1>(key)}});
                found = samplers.emplace(key, document_["samplers"].size() - 1).first;
            }
            document_["textures"].push_back(
                {{"source", document_["images"].size() - 1}, {"sampler", found->second}});
        }
    }

    json weather(const gpu::MaterialWeather& w)
    {
        const gpu::MaterialWeather normal;
        json out = json::object();
        if (w.height.present()) out["heightTexture"] = texture_info(w.height);
        if (w.puddle_mask.present()) out["puddleMaskTexture"] = texture_info(w.puddle_mask);
        if (w.snow_mask.present()) out["snowMaskTexture"] = texture_info(w.snow_mask);
        const auto scalar = [&out](const char* name, float value, float usual) {
            if (value != usual) out[name] = number(value);
        };
        scalar("heightScale", w.height_scale_m, normal.height_scale_m);
        scalar("defaultHeight", w.default_height, normal.default_height);
        scalar("porosity", w.porosity, normal.porosity);
        scalar("waterSlopeDamp", w.water_slope_damp, normal.water_slope_damp);
        scalar("flowTiling", w.flow_tiling, normal.flow_tiling);
        scalar("flowSpeed", w.flow_speed, normal.flow_speed);
        scalar("flowInterval", w.flow_interval_s, normal.flow_interval_s);
        scalar("flowRefraction", w.flow_refraction, normal.flow_refraction);
        scalar("flowNormalStrength", w.flow_normal_strength, normal.flow_normal_strength);
        scalar("snowSlopeDamp", w.snow_slope_damp, normal.snow_slope_damp);
        scalar("snowNormalStrength", w.snow_normal_strength, normal.snow_normal_strength);
        scalar("snowDetailStrength", w.snow_detail_strength, normal.snow_detail_strength);
        scalar("snowOpacity", w.snow_opacity, normal.snow_opacity);
        if (w.water_accumulation != normal.water_accumulation) {
            out["waterAccumulation"] = numbers(w.water_accumulation);
        }
        if (w.water_color != normal.water_color) out["waterColor"] = numbers(w.water_color);
        if (w.snow_accumulation != normal.snow_accumulation) {
            out["snowAccumulation"] = numbers(w.snow_accumulation);
        }
        if (w.sheltered) out["sheltered"] = true;
        return out;
    }

    void add_material(const gpu::Material& m)
    {
        json out = {{"name", m.name}};
        json& pbr = out["pbrMetallicRoughness"];
        pbr = json::object();
        if (m.base_color != glm::vec4(1.0f)) pbr["baseColorFactor"] = numbers(m.base_color);
        if (m.base_color_texture.present()) {
            pbr["baseColorTexture"] = texture_info(m.base_color_texture);
        }
        if (m.metallic != 1.0f) pbr["metallicFactor"] = number(m.metallic);
        if (m.roughness != 1.0f) pbr["roughnessFactor"] = number(m.roughness);
        if (m.metallic_roughness_texture.present()) {
            pbr["metallicRoughnessTexture"] = texture_info(m.metallic_roughness_texture);
        }
        if (m.normal_texture.present()) {
            out["normalTexture"] = texture_info(m.normal_texture);
            if (m.normal_scale != 1.0f) out["normalTexture"]["scale"] = number(m.normal_scale);
        }
        if (m.occlusion_texture.present()) {
            out["occlusionTexture"] = texture_info(m.occlusion_texture);
            if (m.occlusion_strength != 1.0f) {
                out["occlusionTexture"]["strength"] = number(m.occlusion_strength);
            }
        }
        json extensions = json::object();
        add_emission(m, out, extensions);
        add_layers(m, extensions);
        const json wet = weather(m.weather);
        if (!wet.empty()) extensions["PETRICHOR_materials_weather"] = wet;
        for (const auto& item : extensions.items()) use(item.key().c_str());
        if (!extensions.empty()) out["extensions"] = extensions;
        if (m.alpha_mode == gpu::AlphaMode::Blend) out["alphaMode"] = "BLEND";
        if (m.alpha_mode == gpu::AlphaMode::Mask) {
            out["alphaMode"] = "MASK";
            out["alphaCutoff"] = number(m.alpha_cutoff);
        }
        if (m.double_sided) out["doubleSided"] = true;
        document_["materials"].push_back(out);
    }

    void add_emission(const gpu::Material& m, json& out, json& extensions)
    {
        const float strongest = std::max({m.emissive.x, m.emissive.y, m.emissive.z});
        if (strongest <= 0.0f) return;
        const float strength = std::max(strongest, 1.0f);
        out["emissiveFactor"] = numbers(m.emissive / strength);
        if (m.emissive_texture.present()) out["emissiveTexture"] = texture_info(m.emissive_texture);
        if (strength > 1.0f) {
            extensions["KHR_materials_emissive_strength"]["emissiveStrength"] = number(strength);
        }
    }

    void add_layers(const gpu::Material& m, json& extensions)
    {
        if (m.unlit) extensions["KHR_materials_unlit"] = json::object();
        if (m.ior != 1.5f) extensions["KHR_materials_ior"]["ior"] = number(m.ior);
        if (m.specular != 1.0f || m.specular_color != glm::vec3(1.0f)) {
            extensions["KHR_materials_specular"] = {
                {"specularFactor", number(m.specular)},
                {"specularColorFactor", numbers(m.specular_color)}};
        }
        if (m.transmission > 0.0f) {
            extensions["KHR_materials_transmission"]["transmissionFactor"] = number(m.transmission);
        }
        if (m.clearcoat > 0.0f) {
            extensions["KHR_materials_clearcoat"] = {
                {"clearcoatFactor", number(m.clearcoat)},
                {"clearcoatRoughnessFactor", number(m.clearcoat_roughness)}};
        }
        if (m.sheen_color != glm::vec3(0.0f)) {
            extensions["KHR_materials_sheen"] = {
                {"sheenColorFactor", numbers(m.sheen_color)},
                {"sheenRoughnessFactor", number(m.sheen_roughness)}};
        }
        if (m.anisotropy != 0.0f) {
            extensions["KHR_materials_anisotropy"] = {
                {"anisotropyStrength", number(m.anisotropy)},
                {"anisotropyRotation", number(m.anisotropy_rotation_rad)}};
        }
    }

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
            add_accessor(to_bytes(values), "VEC4", kUnsignedByte, 34962, true);
        document_["accessors"][accessor]["count"] = values.size();
        return accessor;
    }

    // Two bytes an index where they suffice (65535 itself means "restart" to some readers).
    std::size_t add_indices(const gpu::Primitive& p)
    {
        if (p.positions.size() > 65535)
            return add_accessor(p.indices, "SCALAR", kUnsignedInt, 34963);
        const std::vector<std::uint16_t> narrow(p.indices.begin(), p.indices.end());
        return add_accessor(narrow, "SCALAR", kUnsignedShort, 34963);
    }

    json primitive(const gpu::Primitive& p)
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
        const std::size_t positions = add_accessor(p.positions, "VEC3", kFloat, 34962);
        json& accessor = document_["accessors"][positions];
        // Bounds must be exact: the shortest decimal that reads back as the same float.
        accessor["min"] = {low.x, low.y, low.z};
        accessor["max"] = {high.x, high.y, high.z};
        attributes["POSITION"] = positions;
        if (!p.normals.empty())
            attributes["NORMAL"] = add_accessor(p.normals, "VEC3", kFloat, 34962);
        if (!p.tangents.empty())
            attributes["TANGENT"] = add_accessor(p.tangents, "VEC4", kFloat, 34962);
        if (!p.uv0.empty()) attributes["TEXCOORD_0"] = add_accessor(p.uv0, "VEC2", kFloat, 34962);
        if (!p.uv1.empty()) attributes["TEXCOORD_1"] = add_accessor(p.uv1, "VEC2", kFloat, 34962);
        if (!p.colors.empty()) attributes["COLOR_0"] = add_byte_colors(p.colors);
        if (!p.weather.empty()) attributes["_WEATHER"] = add_byte_colors(p.weather);
        return {{"attributes", attributes}, {"indices", add_indices(p)}, {"material", p.material}};
    }

    void add_mesh(const gpu::Mesh& mesh)
    {
        json primitives = json::array();
        for (const gpu::Primitive& p : mesh.primitives) primitives.push_back(primitive(p));
        document_["meshes"].push_back({{"name", mesh.name}, {"primitives", primitives}});
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
        document_["nodes"].push_back(node);
        return document_["nodes"].size() - 1;
    }

    void add_nodes()
    {
        for (const gpu::Instance& instance : scene_.instances) {
            if (instance.mesh >= scene_.meshes.size()) {
                throw Error("glb: instance " + instance.name + " uses mesh " +
                                std::to_string(instance.mesh) + " of " +
                                std::to_string(scene_.meshes.size()),
                            "Add the mesh to the scene first.");
            }
            document_["nodes"][add_node(instance.name, instance.to_world)]["mesh"] = instance.mesh;
        }
        for (const gpu::Camera& camera : scene_.cameras) {
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
            document_["cameras"].push_back(out);
            document_["nodes"][add_node(camera.name, camera.to_world)]["camera"] =
                document_["cameras"].size() - 1;
        }
        for (const gpu::Light& light : scene_.lights) add_light(light);
        json roots = json::array();
        for (std::size_t i = 0; i < document_["nodes"].size(); ++i) roots.push_back(i);
        document_["scenes"] = json::array({{{"name", scene_.name}, {"nodes", roots}}});
        document_["scene"] = 0;
    }

    void add_light(const gpu::Light& light)
    {
        use("KHR_lights_punctual");
        json out = {{"name", light.name},
                    {"color", numbers(light.color)},
                    {"intensity", number(light.intensity)}};
        if (light.range_m > 0.0f) out["range"] = number(light.range_m);
        out["type"] = light.kind == gpu::LightKind::Directional ? "directional"
                      : light.kind == gpu::LightKind::Point     ? "point"
                                                                : "spot";
        if (light.kind == gpu::LightKind::Spot) {
            out["spot"] = {{"innerConeAngle", number(light.inner_cone_rad)},
                           {"outerConeAngle", number(light.outer_cone_rad)}};
        }
        json& lights = document_["extensions"]["KHR_lights_punctual"]["lights"];
        lights.push_back(out);
        // A light shines along -z of its node.
        const glm::vec3 back = -glm::normalize(light.direction);
        const glm::vec3 helper = std::abs(back.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
        const glm::vec3 right = glm::normalize(glm::cross(helper, back));
        const glm::mat4 to_world(glm::vec4(right, 0.0f), glm::vec4(glm::cross(back, right), 0.0f),
                                 glm::vec4(back, 0.0f), glm::vec4(light.position_m, 1.0f));
        const std::size_t node = add_node(light.name, to_world);
        document_["nodes"][node]["extensions"]["KHR_lights_punctual"]["light"] = lights.size() - 1;
    }

    // Header, JSON chunk padded with spaces, binary chunk padded with zeros.
    std::vector<std::byte> container()
    {
        std::string text = document_.dump();
        text.resize((text.size() + 3) / 4 * 4, ' ');
        bytes_.resize((bytes_.size() + 3) / 4 * 4, std::byte{0});
        std::vector<std::byte> out;
        out.reserve(28 + text.size() + bytes_.size());
        const auto append = [&out](std::size_t value) {
            for (int shift = 0; shift < 32; shift += 8) {
                out.push_back(static_cast<std::byte>((value >> shift) & 0xffu));
            }
        };
        append(0x46546c67u);  // glTF
        append(2);
        append(28 + text.size() + bytes_.size());
        append(text.size());
        append(0x4e4f534au);  // JSON
        const auto* chars = reinterpret_cast<const std::byte*>(text.data());
        out.insert(out.end(), chars, chars + text.size());
        append(bytes_.size());
        append(0x004e4942u);  // BIN
        out.insert(out.end(), bytes_.begin(), bytes_.end());
        return out;
    }

    const gpu::Scene& scene_;
    json document_ = json::object();
    std::set<std::string> extensions_;
    std::vector<std::byte> bytes_;
};

}  // namespace

std::vector<std::byte> write_glb(const gpu::Scene& scene)
{
    return Writer(scene).write();
}

}  // namespace petrichor::cli
