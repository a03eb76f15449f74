// What the tests of texture files share: small chains, and files broken in every way.
#ifndef PETRICHOR_TESTS_TEXPROC_TEXTURES_H
#define PETRICHOR_TESTS_TEXPROC_TEXTURES_H

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>

#include "texproc/codecs/files/texture.h"

namespace petrichor::texproc {

inline std::vector<RawImage> small_chain(int width, int height, int channels, PixelType type)
{
    std::vector<RawImage> levels;
    std::uint32_t seed = 17;
    for (int k = 0;; ++k) {
        RawImage level{
            level_extent(width, k), level_extent(height, k), channels, PixelType::U8, {}, {}};
        for (std::size_t i = 0; i < level.values(); ++i) {
            seed = seed * 1664525u + 1013904223u;
            level.bytes.push_back(static_cast<std::byte>(seed >> 24));
        }
        levels.push_back(type == PixelType::U8 ? level
                                               : to_raw(to_image(level, ColorSpace::Data), type));
        if (level.width == 1 && level.height == 1) return levels;
    }
}

/// Calls `parse` with the file cut after every byte, with every byte changed in several ways and
/// with every header word set to extremes. It may throw std::runtime_error or return; nothing else.
/// Returns how many of the cut files were taken for good.
inline int torture(const std::vector<std::byte>& file,
                   const std::function<void(std::span<const std::byte>)>& parse)
{
    int good = 0;
    const auto attempt = [&](std::span<const std::byte> bytes) {
        try {
            parse(bytes);
            return true;
        } catch (const std::runtime_error& why) {
            EXPECT_STRNE(why.what(), "");
            return false;
        }
    };
    for (std::size_t size = 0; size < file.size(); ++size) {
        // A copy of its own size, so that a sanitizer sees every read past its end.
        const std::vector<std::byte> cut(file.begin(),
                                         file.begin() + static_cast<std::ptrdiff_t>(size));
        if (attempt(cut)) ++good;
    }
    std::vector<std::byte> bytes = file;
    for (std::size_t i = 0; i < file.size(); ++i) {
        for (const int change : {0x01, 0x80, 0xff, 0x7f}) {
            bytes[i] = file[i] ^ static_cast<std::byte>(change);
            attempt(bytes);
        }
        bytes[i] = file[i];
    }
    for (std::size_t i = 0; i + 4 <= std::min<std::size_t>(file.size(), 256); i += 4) {
        for (const std::uint32_t word : {0u, 1u, 0x7fffffffu, 0x80000000u, 0xffffffffu, 65536u}) {
            for (std::size_t b = 0; b < 4; ++b)
                bytes[i + b] = static_cast<std::byte>(word >> (8 * b));
            attempt(bytes);
        }
        std::copy_n(file.begin() + static_cast<std::ptrdiff_t>(i), 4,
                    bytes.begin() + static_cast<std::ptrdiff_t>(i));
    }
    return good;
}

class TextureFiles : public testing::Test {
protected:
    void SetUp() override
    {
        const auto* info = testing::UnitTest::GetInstance()->current_test_info();
        folder = std::filesystem::temp_directory_path() /
                 ("petrichor-" + std::string(info->name()) + std::to_string(::getpid()));
        std::filesystem::create_directories(folder);
    }
    void TearDown() override { std::filesystem::remove_all(folder); }
    std::filesystem::path folder;
};

inline std::vector<std::byte> content_of(const std::filesystem::path& path)
{
    std::ifstream in(path, std::ios::binary);
    const std::string text((std::istreambuf_iterator<char>(in)), {});
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

}  // namespace petrichor::texproc

#endif
