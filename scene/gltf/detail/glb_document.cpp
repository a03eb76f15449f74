#include "scene/gltf/detail/glb_document.h"

#include <cmath>

namespace petrichor::scene::detail {

json number(float value)
{
    if (value == 0.0f) return 0.0;
    const double magnitude =
        std::pow(10.0, 7.0 - std::ceil(std::log10(std::abs(static_cast<double>(value)))));
    return std::round(static_cast<double>(value) * magnitude) / magnitude;
}

std::vector<std::byte> GlbDocument::container() const
{
    json complete = tree;
    complete["buffers"] = json::array({{{"byteLength", bytes.size()}}});
    if (!extensions.empty()) complete["extensionsUsed"] = extensions;
    std::string text = complete.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::size_t padding = (4 - bytes.size() % 4) % 4;
    std::vector<std::byte> out;
    out.reserve(28 + text.size() + bytes.size() + padding);
    const auto append = [&out](std::size_t value) {
        for (int shift = 0; shift < 32; shift += 8) {
            out.push_back(static_cast<std::byte>((value >> shift) & 0xffu));
        }
    };
    append(0x46546c67u);  // glTF
    append(2);
    append(28 + text.size() + bytes.size() + padding);
    append(text.size());
    append(0x4e4f534au);  // JSON
    const auto* chars = reinterpret_cast<const std::byte*>(text.data());
    out.insert(out.end(), chars, chars + text.size());
    append(bytes.size() + padding);
    append(0x004e4942u);  // BIN
    out.insert(out.end(), bytes.begin(), bytes.end());
    out.resize(out.size() + padding);
    return out;
}

}  // namespace petrichor::scene::detail
