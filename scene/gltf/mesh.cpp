#include <algorithm>
#include <array>
#include <cmath>

#include "scene/gltf/detail/gltf_parts.h"

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
    PrimitiveReader(GltfSource& source, const JsonObject& json, const JsonObject& attributes,
                    bool quantized)
        : buffers_(source.buffers), json_(json), attributes_(attributes), quantized_(quantized)
    {
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
        if (json_.extension("KHR_draco_mesh_compression") && !positions->base) {
            json_.fail("extensions.KHR_draco_mesh_compression",
                       "compressed meshes cannot be read, and there is no uncompressed copy",
                       "Export the scene without Draco compression.");
        }
        if (json_.array("targets").size() > 0) {
            json_.warn("targets", "morph targets are not applied: the mesh is shown at rest");
        }
        Primitive primitive;
        primitive.indices = to_triangles(read_corners(*positions, mode), mode);
        if (primitive.indices.empty()) {
            json_.warn("indices", "a primitive without a triangle is not drawn");
            return std::nullopt;
        }
        used_ = keep_used(primitive.indices, positions->count);
        read_attributes(primitive, *positions);
        return primitive;
    }

private:
    std::vector<std::uint32_t> read_corners(const Accessor& positions, std::uint64_t mode)
    {
        // What a corner can come to in the end: its index, and a vertex of its own.
        constexpr std::uint64_t kCorner = 64;
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
        const auto index = attributes_.index(name, "accessor", buffers_.accessor_count());
        if (!index) return nullptr;
        const Accessor& accessor = buffers_.accessor(*index);
        if (std::find(components.begin(), components.end(), accessor.components) ==
            components.end()) {
            attributes_.fail(name,
                             "accessor " + std::to_string(*index) + " has " +
                                 std::to_string(accessor.components) + " components, " +
                                 std::to_string(*components.begin()) + " are needed",
                             kFixDamaged);
        }
        const bool plain_integer =
            accessor.normalized &&
            (accessor.type == ComponentType::Uint8 || accessor.type == ComponentType::Uint16) &&
            (name.starts_with("TEXCOORD") || name.starts_with("COLOR") || name == "_WEATHER");
        const bool quantized_integer = quantized_ && accessor.type != ComponentType::Uint32;
        if (accessor.type != ComponentType::Float && !plain_integer && !quantized_integer) {
            attributes_.fail(name,
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
        constexpr float kLargest =
            1e18f;  // its square, and a place in the world, still fit a float
        std::vector<glm::vec<N, float>> values;
        if (!accessor) return values;
        if (accessor->count != vertex_count) {
            attributes_.fail(name,
                             "has " + std::to_string(accessor->count) + " elements, POSITION has " +
                                 std::to_string(vertex_count),
                             kFixDamaged);
        }
        const int components = std::min(accessor->components, N);
        buffers_.budget.take(used_.size(), sizeof values[0], attributes_.path_to(name),
                             json_.log());
        values.assign(used_.size(), glm::vec<N, float>(1.0f));
        bool broken = false;
        for (std::size_t i = 0; i < used_.size(); ++i) {
            for (int c = 0; c < components; ++c) {
                float value = accessor->value(used_[i], c);
                if (!(std::abs(value) <= kLargest)) {
                    if (name == std::string_view("POSITION")) {
                        attributes_.fail(name,
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
        if (broken) attributes_.warn(name, "numbers that are not finite count as 0");
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
        if (attributes_.has("JOINTS_0")) {
            json_.warn("attributes.JOINTS_0", "skins are not applied: the mesh is shown at rest");
        }
        if (attributes_.has("COLOR_1") || attributes_.has("TEXCOORD_2")) {
            json_.warn("attributes", "only COLOR_0, TEXCOORD_0 and TEXCOORD_1 are read");
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
};

bool lists_extension(const JsonArray& names, std::string_view name)
{
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (names.text(i) == name) return true;
    }
    return false;
}

}  // namespace

std::vector<Mesh> read_meshes(GltfSource& source, std::uint32_t default_material)
{
    const JsonArray meshes_json = source.root.array("meshes");
    const std::size_t material_count = source.root.array("materials").size();
    constexpr std::string_view kQuantization = "KHR_mesh_quantization";
    const bool quantized = lists_extension(source.root.array("extensionsUsed"), kQuantization) ||
                           lists_extension(source.root.array("extensionsRequired"), kQuantization);
    std::vector<Mesh> meshes;
    for (std::size_t m = 0; m < meshes_json.size(); ++m) {
        const JsonObject mesh_json = meshes_json.object(m);
        Mesh mesh;
        mesh.name = mesh_json.text("name", "mesh " + std::to_string(m));
        const JsonArray primitives_json = mesh_json.array("primitives");
        for (std::size_t p = 0; p < primitives_json.size(); ++p) {
            const JsonObject json = primitives_json.object(p);
            const auto material = json.index("material", "material", material_count);
            const auto attributes = json.object("attributes");
            if (!attributes) json.fail("attributes", "is missing", kFixDamaged);
            auto primitive = PrimitiveReader(source, json, *attributes, quantized).read();
            if (!primitive) continue;
            primitive->material = material.value_or(default_material);
            mesh.primitives.push_back(std::move(*primitive));
        }
        meshes.push_back(std::move(mesh));
    }
    return meshes;
}

}  // namespace petrichor::scene
