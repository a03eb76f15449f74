#ifndef PETRICHOR_TEXPROC_CODECS_FILES_DETAIL_LITTLE_ENDIAN_H
#define PETRICHOR_TEXPROC_CODECS_FILES_DETAIL_LITTLE_ENDIAN_H

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace petrichor::texproc::detail {

/// Numbers out of untrusted bytes; throws std::runtime_error where there are none.
inline std::uint64_t read_little(std::span<const std::byte> bytes, std::size_t at, int size)
{
    const std::size_t count = static_cast<std::size_t>(size);
    if (at > bytes.size() || bytes.size() - at < count) {
        throw std::runtime_error("it is truncated: its header ends after " +
                                 std::to_string(bytes.size()) + " bytes");
    }
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < count; ++i) {
        value |= static_cast<std::uint64_t>(bytes[at + i]) << (8 * i);
    }
    return value;
}
inline std::uint32_t read_u32(std::span<const std::byte> bytes, std::size_t at)
{
    return static_cast<std::uint32_t>(read_little(bytes, at, 4));
}
inline std::uint64_t read_u64(std::span<const std::byte> bytes, std::size_t at)
{
    return read_little(bytes, at, 8);
}

/// `size` bytes from `at`; throws std::runtime_error that says what is missing.
inline std::span<const std::byte> part(std::span<const std::byte> bytes, std::uint64_t at,
                                       std::uint64_t size, const std::string& what)
{
    if (at > bytes.size() || bytes.size() - at < size) {
        throw std::runtime_error("it is truncated: " + what + " needs " + std::to_string(size) +
                                 " bytes from " + std::to_string(at) + ", the file has " +
                                 std::to_string(bytes.size()));
    }
    return bytes.subspan(static_cast<std::size_t>(at), static_cast<std::size_t>(size));
}

inline void put_little(std::vector<std::byte>& to, std::uint64_t value, int size)
{
    for (int i = 0; i < size; ++i) to.push_back(static_cast<std::byte>(value >> (8 * i)));
}
inline void put_u32(std::vector<std::byte>& to, std::uint64_t value)
{
    put_little(to, value, 4);
}

}  // namespace petrichor::texproc::detail

#endif
