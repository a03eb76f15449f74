#ifndef PETRICHOR_GPU_COMPILER_PACK_H
#define PETRICHOR_GPU_COMPILER_PACK_H

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace petrichor::gpu {

/// A shader text by the name that #include says.
struct ShaderText {
    std::string name;
    std::string text;
    std::string place;  ///< as messages call it: a user's own path; empty: the name
};

/// Texts as bytes, for the compiler in its own program: count, then (size, bytes) of each member.
inline std::vector<std::byte> pack_texts(const std::vector<ShaderText>& texts)
{
    std::vector<std::byte> bytes;
    const auto add = [&bytes](const void* data, std::size_t size) {
        const auto* from = static_cast<const std::byte*>(data);
        bytes.insert(bytes.end(), from, from + size);
    };
    const auto add_text = [&add](const std::string& text) {
        const auto size = static_cast<std::uint32_t>(text.size());
        add(&size, sizeof size);
        add(text.data(), text.size());
    };
    const auto count = static_cast<std::uint32_t>(texts.size());
    add(&count, sizeof count);
    for (const ShaderText& one : texts) {
        add_text(one.name);
        add_text(one.text);
        add_text(one.place);
    }
    return bytes;
}

inline std::vector<ShaderText> unpack_texts(std::span<const std::byte> bytes)
{
    std::size_t at = 0;
    const auto number = [&] {
        std::uint32_t value = 0;
        if (bytes.size() - at < sizeof value) throw std::runtime_error("shader texts: cut off");
        std::memcpy(&value, bytes.data() + at, sizeof value);
        at += sizeof value;
        return value;
    };
    const auto text = [&] {
        const std::size_t size = number();
        if (bytes.size() - at < size) throw std::runtime_error("shader texts: cut off");
        std::string value(reinterpret_cast<const char*>(bytes.data() + at), size);
        at += size;
        return value;
    };
    std::vector<ShaderText> texts(std::min<std::size_t>(number(), bytes.size()));
    for (ShaderText& one : texts) {
        one.name = text();
        one.text = text();
        one.place = text();
    }
    return texts;
}

}  // namespace petrichor::gpu

#endif
