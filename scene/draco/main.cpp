// petrichor-draco: unpacks the meshes on standard input with Draco's library, confined.
//
//   in   for each mesh: its size in bytes, the bytes
//   out  for each: triangles, vertices, attributes; the corners; for each attribute its number, its
//        components, the values of every vertex. Words of 32 bits, floats, little-endian.
#include <draco/compression/decode.h>

#include <cstring>
#include <memory>
#include <string>

#include "base/confine.h"
#include "base/error.h"

namespace petrichor {
namespace {

constexpr const char* kFix = "Export the scene again: a Draco mesh is damaged.";

class Writer {
public:
    void word(std::uint32_t value) { add(&value, sizeof value); }
    void number(float value) { add(&value, sizeof value); }
    std::vector<std::byte> bytes;

private:
    void add(const void* from, std::size_t size)
    {
        const auto* begin = static_cast<const std::byte*>(from);
        bytes.insert(bytes.end(), begin, begin + size);
    }
};

// As it was written: glTF's accessor says whether whole numbers are parts of 1.
float component(const draco::PointAttribute& attribute, draco::AttributeValueIndex at,
                std::uint32_t c)
{
    const std::uint8_t* from =
        attribute.GetAddress(at) +
        c * static_cast<std::uint32_t>(draco::DataTypeLength(attribute.data_type()));
    const auto as = [from](auto value) {
        std::memcpy(&value, from, sizeof value);
        return static_cast<float>(value);
    };
    switch (attribute.data_type()) {
        case draco::DT_FLOAT32:
            return as(float{});
        case draco::DT_INT8:
            return as(std::int8_t{});
        case draco::DT_UINT8:
            return as(std::uint8_t{});
        case draco::DT_INT16:
            return as(std::int16_t{});
        case draco::DT_UINT16:
            return as(std::uint16_t{});
        case draco::DT_INT32:
            return as(std::int32_t{});
        case draco::DT_UINT32:
            return as(std::uint32_t{});
        default:
            throw Error("Draco: an attribute of a type that glTF does not know", kFix);
    }
}

void unpack(std::span<const std::byte> packed, Writer& out)
{
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(packed.data()), packed.size());
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok())
        throw Error("Draco: " + decoded.status().error_msg_string(), kFix);
    const std::unique_ptr<draco::Mesh> mesh = std::move(decoded).value();
    out.word(mesh->num_faces());
    out.word(mesh->num_points());
    out.word(static_cast<std::uint32_t>(mesh->num_attributes()));
    for (draco::FaceIndex f(0); f < mesh->num_faces(); ++f) {
        for (const draco::PointIndex& corner : mesh->face(f)) out.word(corner.value());
    }
    for (int a = 0; a < mesh->num_attributes(); ++a) {
        const draco::PointAttribute& attribute = *mesh->attribute(a);
        const auto components = static_cast<std::uint32_t>(attribute.num_components());
        out.word(attribute.unique_id());
        out.word(components);
        for (draco::PointIndex p(0); p < mesh->num_points(); ++p) {
            const draco::AttributeValueIndex at = attribute.mapped_index(p);
            if (at.value() >= attribute.size()) throw Error("Draco: a vertex without a value", kFix);
            for (std::uint32_t c = 0; c < components; ++c)
                out.number(component(attribute, at, c));
        }
    }
}

std::vector<std::byte> answer(const HelperInput& input)
{
    Writer out;
    std::span<const std::byte> rest = input.bytes;
    while (!rest.empty()) {
        std::uint32_t size = 0;
        if (rest.size() < sizeof size) throw Error("Draco: a question that is cut short", kFix);
        std::memcpy(&size, rest.data(), sizeof size);
        rest = rest.subspan(sizeof size);
        if (size > rest.size()) throw Error("Draco: a question that is cut short", kFix);
        unpack(rest.first(size), out);
        rest = rest.subspan(size);
    }
    return std::move(out.bytes);
}

}  // namespace
}  // namespace petrichor

int main(int argc, char** argv)
{
    return petrichor::run_helper(argc, argv, petrichor::answer);
}
