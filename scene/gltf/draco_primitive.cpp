#include "scene/gltf/detail/draco_primitive.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace petrichor::scene {
namespace {

constexpr const char* kFixDamaged = "Export the scene again: the file is damaged or incomplete.";

constexpr const char* kDraco = "KHR_draco_mesh_compression";

std::vector<std::byte> as_component_type(const std::vector<float>& values, ComponentType type)
{
    std::vector<std::byte> bytes;
    const auto put = [&bytes](auto value) {
        const auto* from = reinterpret_cast<const std::byte*>(&value);
        bytes.insert(bytes.end(), from, from + sizeof value);
    };
    const auto whole = [](float v, float low, float high) {
        return std::isnan(v) ? 0.0f : std::clamp(v, low, high);
    };
    for (const float v : values) {
        if (type == ComponentType::Float) put(v);
        if (type == ComponentType::Int8) put(static_cast<std::int8_t>(whole(v, -128, 127)));
        if (type == ComponentType::Uint8) put(static_cast<std::uint8_t>(whole(v, 0, 255)));
        if (type == ComponentType::Int16) put(static_cast<std::int16_t>(whole(v, -32768, 32767)));
        if (type == ComponentType::Uint16) put(static_cast<std::uint16_t>(whole(v, 0, 65535)));
        if (type == ComponentType::Uint32)
            put(static_cast<std::uint32_t>(whole(v, 0, 4294967040.0f)));
    }
    return bytes;
}

}  // namespace

UnpackedPrimitive unpack_primitive(GltfBuffers& buffers, const JsonObject& json,
                                   const JsonObject& attributes, const DracoMesh& packed)
{
    UnpackedPrimitive unpacked;
    const auto extension = json.extension(kDraco);
    const auto names = extension->object("attributes");
    if (!names) extension->fail("attributes", "is missing", kFixDamaged);
    for (const std::string& name : names->keys()) {
        const auto id = names->require_whole(name);
        const auto found = id <= 0xffffffffu
                               ? packed.attributes.find(static_cast<std::uint32_t>(id))
                               : packed.attributes.end();
        if (found == packed.attributes.end()) {
            names->fail(name, "Draco's mesh has no attribute " + std::to_string(id), kFixDamaged);
        }
        Accessor accessor =
            buffers.accessor(attributes.require_index(name, "accessor", buffers.accessor_count()));
        const DracoAttribute& attribute = found->second;
        if (accessor.count != packed.vertices ||
            accessor.components != static_cast<int>(attribute.components)) {
            names->fail(name,
                        "Draco's mesh has " + std::to_string(packed.vertices) + " vertices of " +
                            std::to_string(attribute.components) + " numbers; the accessor says " +
                            std::to_string(accessor.count) + " of " +
                            std::to_string(accessor.components),
                        kFixDamaged);
        }
        std::vector<std::byte>& bytes = unpacked.bytes[name];
        bytes = as_component_type(attribute.values, accessor.type);
        accessor.base = bytes.data();
        accessor.stride = bytes.size() / packed.vertices;
        accessor.sparse_indices.clear();
        unpacked.accessors.emplace(name, std::move(accessor));
    }
    unpacked.corners = &packed.indices;
    buffers.budget.take(packed.indices.size() + packed.vertices, 64, json.path_to("extensions"),
                        json.log());
    return unpacked;
}

std::map<std::pair<std::size_t, std::size_t>, DracoMesh> unpacked_meshes(GltfSource& source,
                                                                         const JsonArray& meshes)
{
    std::vector<std::span<const std::byte>> packed;
    std::vector<std::pair<std::size_t, std::size_t>> places;
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        const JsonArray primitives = meshes.object(m).array("primitives");
        for (std::size_t p = 0; p < primitives.size(); ++p) {
            const JsonObject json = primitives.object(p);
            const auto extension = json.extension(kDraco);
            const auto attributes = json.object("attributes");
            if (!extension || !attributes) continue;
            const auto position =
                attributes->index("POSITION", "accessor", source.buffers.accessor_count());
            if (!position || source.buffers.accessor(*position).base) continue;
            packed.push_back(source.buffers.view(extension->require_index(
                "bufferView", "buffer view", source.buffers.view_count())));
            places.emplace_back(m, p);
        }
    }
    std::vector<DracoMesh> unpacked = unpack_draco(packed, source.root.log().file);
    std::map<std::pair<std::size_t, std::size_t>, DracoMesh> found;
    for (std::size_t i = 0; i < places.size(); ++i) found[places[i]] = std::move(unpacked[i]);
    return found;
}

}  // namespace petrichor::scene
