#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "scene/gltf/detail/draco_primitive.h"
#include "scene/gltf/detail/gltf_parts.h"
#include "scene/gltf/detail/gltf_variants.h"

namespace petrichor::scene {
namespace {

constexpr const char* kFixDamaged = "Export the scene again: the file is damaged or incomplete.";

enum Mode { Points, Lines, LineLoop, LineStrip, Triangles, TriangleStrip, TriangleFan };

// Turns the corners of a list, strip or fan into triangles of a list. Triangles that use a vertex
// twice have no area (strips use them to jump) and are dropped.
std::vector<std::uint32_t> to_triangles(std::span<const std::uint32_t> corners, std::uint64_t mode)
{
    std::vector<std::uint32_t> indices;
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        if (a != b && b != c && c != a) indices.insert(indices.end(), {a, b, c});
    };
    if (mode == Triangles) {
        indices.reserve(corners.size());
        for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
            add(corners[i], corners[i + 1], corners[i + 2]);
        }
    } else {
        indices.reserve(3 * corners.size());
        for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
            if (mode == TriangleStrip) {
                const std::size_t odd = i % 2;
                add(corners[i], corners[i + 1 + odd], corners[i + 2 - odd]);
            } else {
                add(corners[i + 1], corners[i + 2], corners[0]);
            }
        }
    }
    return indices;
}

// Keeps only the vertices that triangles use, since files often share one vertex array among many
// primitives. Renumbers `indices`; gives the old numbers, increasing. The cost follows the number
// of indices, not the size of the shared array.
std::vector<std::uint32_t> keep_used(std::vector<std::uint32_t>& indices, std::size_t vertex_count)
{
    std::vector<std::uint32_t> used;
    if (vertex_count / 8 > indices.size()) {
        used = indices;
        std::sort(used.begin(), used.end());
        used.erase(std::unique(used.begin(), used.end()), used.end());
        for (std::uint32_t& index : indices) {
            const auto found = std::lower_bound(used.begin(), used.end(), index);
            index = static_cast<std::uint32_t>(found - used.begin());
        }
        return used;
    }
    std::vector<std::uint32_t> number(vertex_count, 0);
    for (const std::uint32_t index : indices) number[index] = 1;
    for (std::uint32_t v = 0; v < vertex_count; ++v) {
        if (!number[v]) continue;
        number[v] = static_cast<std::uint32_t>(used.size());
        used.push_back(v);
    }
    for (std::uint32_t& index : indices) index = number[index];
    return used;
}

class PrimitiveReader {
public:
    /// `packed`: what Draco gave for it; null: it is not packed.
    PrimitiveReader(GltfSource& source, const JsonObject& json, const JsonObject& attributes,
                    bool quantized, const DracoMesh* packed)
        : buffers_(source.buffers), json_(json), attributes_(attributes), quantized_(quantized)
    {
        if (packed) unpacked_ = unpack_primitive(source.buffers, json, attributes, *packed);
    }

    /// Nothing when there is nothing to draw.
    std::optional<Primitive> read()
    {
        const std::uint64_t mode = json_.whole("mode", Triangles);
        if (mode > TriangleFan) {
            json_.fail("mode", "must be in 0..6, got " + std::to_string(mode), kFixDamaged);
        }
        const Accessor* positions = attribute("POSITION", {3});
        if (!positions) {
            json_.warn("attributes", "a primitive without POSITION is not drawn");
            return std::nullopt;
        }
        if (mode < Triangles) {
            json_.warn("mode", "points and lines are not drawn");
            return std::nullopt;
        }
        Primitive primitive;
        primitive.indices = to_triangles(read_corners(*positions, mode), mode);
        if (primitive.indices.empty()) {
            json_.warn("indices", "a primitive without a triangle is not drawn");
            return std::nullopt;
        }
        used_ = keep_used(primitive.indices, positions->count);
        read_attributes(primitive, *positions);
        read_targets(primitive, positions->count);
        read_influences(primitive, positions->count);
        return primitive;
    }

private:
    std::vector<std::uint32_t> read_corners(const Accessor& positions, std::uint64_t mode)
    {
        // What a corner can come to in the end: its index, and a vertex of its own.
        constexpr std::uint64_t kCorner = 64;
        if (unpacked_.corners) return *unpacked_.corners;
        std::vector<std::uint32_t> corners;
        if (!json_.has("indices")) {
            buffers_.budget.take(positions.count,
                                 positions.base ? kCorner : Budget::kInventedElement,
                                 json_.path_to("attributes.POSITION"), json_.log());
            corners.resize(positions.count);
            for (std::uint32_t i = 0; i < corners.size(); ++i) corners[i] = i;
        } else {
            const Accessor& indices = buffers_.accessor(
                json_.require_index("indices", "accessor", buffers_.accessor_count()));
            const bool whole = indices.type == ComponentType::Uint8 ||
                               indices.type == ComponentType::Uint16 ||
                               indices.type == ComponentType::Uint32;
            if (!whole || indices.components != 1) {
                json_.fail("indices", "must be a SCALAR accessor of an unsigned integer type",
                           kFixDamaged);
            }
            buffers_.budget.take(indices.count, indices.base ? kCorner : Budget::kInventedElement,
                                 json_.path_to("indices"), json_.log());
            corners.resize(indices.count);
            for (std::size_t i = 0; i < corners.size(); ++i) {
                corners[i] = indices.whole(i);
                if (corners[i] >= positions.count) {
                    json_.fail("indices",
                               "index " + std::to_string(i) + " is " + std::to_string(corners[i]) +
                                   ", but there are only " + std::to_string(positions.count) +
                                   " vertices",
                               kFixDamaged);
                }
            }
        }
        if (mode == Triangles && corners.size() % 3 != 0) {
            json_.warn("indices", "the last, incomplete triangle was dropped");
        }
        return corners;
    }

    // The accessor of an attribute, or null when there is none. Its type must be a float, or an
    // integer that the attribute allows: normalised (texture coordinates, colours), or any with
    // KHR_mesh_quantization.
    const Accessor* attribute(std::string_view name, std::initializer_list<int> components)
    {
        return attribute(attributes_, name, components);
    }
    const Accessor& accessor_of(const JsonObject& attributes, std::string_view name,
                                std::uint32_t index)
    {
        const auto found = unpacked_.accessors.find(name);
        const bool own = &attributes == &attributes_ && found != unpacked_.accessors.end();
        return own ? found->second : buffers_.accessor(index);
    }


    const Accessor* attribute(const JsonObject& attributes, std::string_view name,
                              std::initializer_list<int> components)
    {
        const auto index = attributes.index(name, "accessor", buffers_.accessor_count());
        if (!index) return nullptr;
        const Accessor& accessor = accessor_of(attributes, name, *index);
        if (std::find(components.begin(), components.end(), accessor.components) ==
            components.end()) {
            attributes.fail(name,
                             "accessor " + std::to_string(*index) + " has " +
                                 std::to_string(accessor.components) + " components, " +
                                 std::to_string(*components.begin()) + " are needed",
                             kFixDamaged);
        }
        const bool plain_integer =
            accessor.normalized &&
            (accessor.type == ComponentType::Uint8 || accessor.type == ComponentType::Uint16) &&
            (name.starts_with("TEXCOORD") || name.starts_with("COLOR") ||
             name.starts_with("WEIGHTS") || name == "_WEATHER");
        const bool quantized_integer = quantized_ && accessor.type != ComponentType::Uint32;
        if (accessor.type != ComponentType::Float && !plain_integer && !quantized_integer) {
            attributes.fail(name,
                             "accessor " + std::to_string(*index) + " has component type " +
                                 std::to_string(static_cast<std::uint32_t>(accessor.type)) +
                                 ", which this attribute may not have",
                             "Use floats, or list KHR_mesh_quantization in extensionsRequired.");
        }
        return &accessor;
    }

    // The attribute at the used vertices; empty when the file has none. A broken normal, tangent,
    // colour or texture coordinate counts as 0 and is mended later; a broken position is an error.
    template <int N>
    std::vector<glm::vec<N, float>> read(const char* name, const Accessor* accessor,
                                         std::size_t vertex_count)
    {
        return read<N>(attributes_, name, accessor, vertex_count);
    }

    template <int N>
    std::vector<glm::vec<N, float>> read(const JsonObject& attributes, const std::string& name,
                                         const Accessor* accessor, std::size_t vertex_count)
    {
        constexpr float kLargest =
            1e18f;  // its square, and a place in the world, still fit a float
        std::vector<glm::vec<N, float>> values;
        if (!accessor) return values;
        if (accessor->count != vertex_count) {
            attributes.fail(name,
                             "has " + std::to_string(accessor->count) + " elements, POSITION has " +
                                 std::to_string(vertex_count),
                             kFixDamaged);
        }
        const int components = std::min(accessor->components, N);
        buffers_.budget.take(used_.size(), sizeof values[0], attributes.path_to(name),
                             json_.log());
        values.assign(used_.size(), glm::vec<N, float>(1.0f));
        bool broken = false;
        for (std::size_t i = 0; i < used_.size(); ++i) {
            for (int c = 0; c < components; ++c) {
                float value = accessor->value(used_[i], c);
                if (!(std::abs(value) <= kLargest)) {
                    if (name == "POSITION") {
                        attributes.fail(name,
                                         "element " + std::to_string(used_[i]) +
                                             " is not a finite number below 1e18",
                                         "Remove the broken vertex, or export the scene again.");
                    }
                    broken = true;
                    value = 0.0f;
                }
                values[i][c] = value;
            }
        }
        if (broken) attributes.warn(name, "numbers that are not finite count as 0");
        return values;
    }

    void read_attributes(Primitive& out, const Accessor& positions)
    {
        const std::size_t count = positions.count;
        out.positions = read<3>("POSITION", &positions, count);
        out.normals = read<3>("NORMAL", attribute("NORMAL", {3}), count);
        out.uv0 = read<2>("TEXCOORD_0", attribute("TEXCOORD_0", {2}), count);
        out.uv1 = read<2>("TEXCOORD_1", attribute("TEXCOORD_1", {2}), count);
        out.colors = read<4>("COLOR_0", attribute("COLOR_0", {3, 4}), count);
        out.weather = read<4>("_WEATHER", attribute("_WEATHER", {4}), count);
        // Without normals the normals become flat, and given tangents would not fit them.
        if (!out.normals.empty()) {
            out.tangents = read<4>("TANGENT", attribute("TANGENT", {4}), count);
        }
        for (glm::vec4& masks : out.weather) masks = glm::clamp(masks, 0.0f, 1.0f);
        mend_normals(out);
        mend_tangents(out);
        if (attributes_.has("COLOR_1") || attributes_.has("TEXCOORD_2")) {
            json_.warn("attributes", "only COLOR_0, TEXCOORD_0 and TEXCOORD_1 are read");
        }
    }

    void read_targets(Primitive& out, std::size_t vertex_count)
    {
        const JsonArray targets = json_.array("targets");
        for (std::size_t t = 0; t < targets.size(); ++t) {
            const JsonObject json = targets.object(t);
            const auto deltas = [&](const char* name) {
                return read<3>(json, name, attribute(json, name, {3}), vertex_count);
            };
            MorphTarget target{deltas("POSITION"), {}, {}};
            if (!out.normals.empty()) target.normals = deltas("NORMAL");
            if (!out.tangents.empty()) target.tangents = deltas("TANGENT");
            for (const std::string& name : json.keys()) {
                if (name == "POSITION" || name == "NORMAL" || name == "TANGENT") continue;
                json_.warn("targets", "of morph targets only POSITION, NORMAL and TANGENT are read");
            }
            out.targets.push_back(std::move(target));
        }
    }

    // Joints and weights, four a set. Weights are made to sum up to 1.
    void read_influences(Primitive& out, std::size_t vertex_count)
    {
        constexpr int kMostSets = 4;
        std::vector<std::vector<Influence>> sets;
        for (int set = 0; set < kMostSets; ++set) {
            const std::string joints_name = "JOINTS_" + std::to_string(set);
            const std::string weights_name = "WEIGHTS_" + std::to_string(set);
            if (!attributes_.has(joints_name) && !attributes_.has(weights_name)) break;
            const auto index =
                attributes_.require_index(joints_name, "accessor", buffers_.accessor_count());
            const Accessor& joints = accessor_of(attributes_, joints_name, index);
            const bool whole = joints.type == ComponentType::Uint8 ||
                               joints.type == ComponentType::Uint16;
            if (!whole || joints.components != 4 || joints.count != vertex_count) {
                attributes_.fail(joints_name,
                                 "must be a VEC4 accessor of unsigned bytes or shorts with as many "
                                 "elements as POSITION",
                                 kFixDamaged);
            }
            const Accessor* accessor = attribute(weights_name, {4});
            if (!accessor) attributes_.fail(weights_name, "is missing", kFixDamaged);
            const auto weights = read<4>(attributes_, weights_name, accessor, vertex_count);
            std::vector<Influence> influences;
            buffers_.budget.take(used_.size(), 4 * sizeof(Influence),
                                 attributes_.path_to(joints_name), json_.log());
            for (std::size_t i = 0; i < used_.size(); ++i) {
                for (int c = 0; c < 4; ++c) {
                    influences.push_back(
                        {joints.part(used_[i], c), std::max(weights[i][c], 0.0f)});
                }
            }
            sets.push_back(std::move(influences));
        }
        if (attributes_.has("JOINTS_" + std::to_string(kMostSets)))
            json_.warn("attributes", "only 16 joints of a vertex are read");
        for (std::size_t v = 0; v < used_.size() && !sets.empty(); ++v) {
            const std::size_t first = out.influences.size();
            float sum = 0.0f;
            for (const auto& set : sets) {
                out.influences.insert(out.influences.end(), set.begin() + 4 * static_cast<long>(v),
                                      set.begin() + 4 * static_cast<long>(v + 1));
            }
            for (std::size_t i = first; i < out.influences.size(); ++i)
                sum += out.influences[i].weight;
            if (!(sum > 0.0f)) {
                json_.warn("attributes.WEIGHTS_0", "vertices without weight follow one joint");
                out.influences[first].weight = sum = 1.0f;
            }
            for (std::size_t i = first; i < out.influences.size(); ++i)
                out.influences[i].weight /= sum;
        }
    }

    // Makes normals unit; one without direction becomes the mean of its triangles'.
    void mend_normals(Primitive& out)
    {
        std::vector<glm::dvec3> mean;
        for (std::size_t v = 0; v < out.normals.size(); ++v) {
            glm::dvec3 normal(out.normals[v]);
            if (!(glm::length(normal) > 1e-12)) {
                if (mean.empty()) {
                    json_.warn("attributes.NORMAL", "normals of length 0 were computed anew");
                    mean = mean_normals(out);
                }
                normal = mean[v];
            }
            out.normals[v] = glm::vec3(glm::normalize(normal));
        }
    }

    static std::vector<glm::dvec3> mean_normals(const Primitive& primitive)
    {
        std::vector<glm::dvec3> sums(primitive.positions.size(), glm::dvec3(0.0));
        for (std::size_t i = 0; i < primitive.indices.size(); i += 3) {
            const std::uint32_t* index = &primitive.indices[i];
            const glm::dvec3 origin(primitive.positions[index[0]]);
            const auto across = glm::cross(glm::dvec3(primitive.positions[index[1]]) - origin,
                                           glm::dvec3(primitive.positions[index[2]]) - origin);
            for (int c = 0; c < 3; ++c) sums[index[c]] += across;
        }
        for (glm::dvec3& sum : sums) {
            const double length = glm::length(sum);
            if (!(length > 0.0) || !std::isfinite(length)) sum = {0.0, 1.0, 0.0};
        }
        return sums;
    }

    // Makes tangents unit with w = -1 or 1; when one has no direction, all are computed anew.
    void mend_tangents(Primitive& out)
    {
        for (glm::vec4& tangent : out.tangents) {
            const glm::dvec3 direction(tangent);
            const double length = glm::length(direction);
            if (!(length > 1e-12)) {
                json_.warn("attributes.TANGENT", "tangents of length 0: all were computed anew");
                out.tangents.clear();
                return;
            }
            tangent = glm::vec4(glm::vec3(direction / length), tangent.w < 0.0f ? -1.0f : 1.0f);
        }
    }

    GltfBuffers& buffers_;
    const JsonObject& json_;
    const JsonObject& attributes_;
    bool quantized_;                   ///< KHR_mesh_quantization is in use
    std::vector<std::uint32_t> used_;  ///< vertices of the file that triangles use
    UnpackedPrimitive unpacked_;       ///< what Draco gave; empty when it is not packed
};

bool lists_extension(const JsonArray& names, std::string_view name)
{
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (names.text(i) == name) return true;
    }
    return false;
}

}  // namespace

std::vector<Mesh> read_meshes(GltfSource& source, std::uint32_t default_material,
                              const std::string& variant)
{
    const auto chosen = variant_number(source.root, variant);
    const JsonArray meshes_json = source.root.array("meshes");
    const std::size_t material_count = source.root.array("materials").size();
    constexpr std::string_view kQuantization = "KHR_mesh_quantization";
    const bool quantized = lists_extension(source.root.array("extensionsUsed"), kQuantization) ||
                           lists_extension(source.root.array("extensionsRequired"), kQuantization);
    const auto unpacked = unpacked_meshes(source, meshes_json);
    std::vector<Mesh> meshes;
    for (std::size_t m = 0; m < meshes_json.size(); ++m) {
        const JsonObject mesh_json = meshes_json.object(m);
        Mesh mesh;
        mesh.name = mesh_json.text("name", "mesh " + std::to_string(m));
        const JsonArray primitives_json = mesh_json.array("primitives");
        for (std::size_t p = 0; p < primitives_json.size(); ++p) {
            const JsonObject json = primitives_json.object(p);
            auto material = json.index("material", "material", material_count);
            if (chosen) {
                const auto other = variant_material(json, *chosen, material_count);
                if (other) material = other;
            }
            const auto attributes = json.object("attributes");
            if (!attributes) json.fail("attributes", "is missing", kFixDamaged);
            const auto packed = unpacked.find({m, p});
            const DracoMesh* draco = packed == unpacked.end() ? nullptr : &packed->second;
            auto primitive = PrimitiveReader(source, json, *attributes, quantized, draco).read();
            if (!primitive) continue;
            primitive->material = material.value_or(default_material);
            mesh.primitives.push_back(std::move(*primitive));
        }
        meshes.push_back(std::move(mesh));
    }
    return meshes;
}

}  // namespace petrichor::scene
