#ifndef PETRICHOR_SCENE_GLTF_DETAIL_GLB_DOCUMENT_H
#define PETRICHOR_SCENE_GLTF_DETAIL_GLB_DOCUMENT_H

#include <cstddef>
#include <cstring>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

namespace petrichor::scene::detail {

using nlohmann::json;

/// Numbers that came from floats, written with the digits a float has.
json number(float value);
template <typename Vector>
json numbers(const Vector& v)
{
    json list = json::array();
    for (int i = 0; i < v.length(); ++i) list.push_back(number(v[i]));
    return list;
}

/// A GLB in the making: the JSON tree and the one binary buffer it points into.
struct GlbDocument {
    json tree = json::object();
    std::vector<std::byte> bytes;
    std::set<std::string> extensions;  ///< those used so far

    /// Appends `count` values to the buffer; returns the index of their view. `target` 34962 for
    /// vertices, 34963 for indices, 0 for images.
    template <typename T>
    std::size_t add_view(const T* data, std::size_t count, int target = 0)
    {
        while (bytes.size() % 4 != 0) bytes.push_back(std::byte{0});
        const std::size_t offset = bytes.size();
        const std::size_t length = count * sizeof(T);
        bytes.resize(offset + length);
        if (length != 0) std::memcpy(bytes.data() + offset, data, length);
        json view = {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", length}};
        if (target != 0) view["target"] = target;
        tree["bufferViews"].push_back(view);
        return tree["bufferViews"].size() - 1;
    }
    /// The same with an accessor that says how to read them; returns its index. `component` is the
    /// code of the number type, `type` SCALAR, VEC2, ...
    template <typename T>
    std::size_t add_accessor(const std::vector<T>& values, const char* type, int component,
                             int target, bool normalized = false)
    {
        json accessor = {{"bufferView", add_view(values.data(), values.size(), target)},
                         {"componentType", component},
                         {"count", values.size()},
                         {"type", type}};
        if (normalized) accessor["normalized"] = true;
        tree["accessors"].push_back(accessor);
        return tree["accessors"].size() - 1;
    }
    /// The whole file: header, JSON chunk padded with spaces, binary chunk padded with zeros.
    std::vector<std::byte> container() const;
};

}  // namespace petrichor::scene::detail

#endif
