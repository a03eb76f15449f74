// Textures with mip levels to and from files.
#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cstring>
#include <fstream>

#include "base/error.h"
#include "base/input_file.h"
#include "texproc/codecs/files/detail/dds.h"
#include "texproc/codecs/files/detail/exr_mips.h"
#include "texproc/codecs/files/detail/ktx2.h"
#include "texproc/codecs/files/detail/little_endian.h"
#include "texproc/codecs/files/detail/texture_codes.h"
#include "texproc/codecs/files/detail/texture_shape.h"
#include "texproc/codecs/files/texture.h"

namespace petrichor::texproc {

namespace {

namespace fs = std::filesystem;

std::string lower_extension(const fs::path& path)
{
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

void check_holds_levels(const fs::path& path)
{
    if (holds_mip_chain(path)) return;
    throw Error(
        "output " + path.string() + ": '" + lower_extension(path) + "' does not hold mip levels",
        "Write .dds, .ktx2 or .exr, or one file a level with %d in the name: 'out_%d.png'.");
}

void write_exr_chain(const fs::path& path, std::span<const RawImage> levels,
                     const TextureWriteOptions& options)
{
    TextureWriteOptions plain = options;
    if (plain.format.empty() && !levels.empty()) {
        const bool single = levels[0].type == PixelType::F32;
        const int channels = std::clamp(levels[0].channels, 1, 4);
        plain.format = name_of({{}, single ? PixelType::F32 : PixelType::F16, channels, false});
    }
    const TextureFormat format = texture_format(plain.format);
    if (format.block || (format.type != PixelType::F16 && format.type != PixelType::F32)) {
        throw Error(
            "output " + path.string() + ": EXR holds halves and floats, not " + plain.format,
            "Use --format rgba16f or rgba32f (r, rg, rgb), or write .dds or .ktx2.");
    }
    detail::write_exr_mips(path, make_texture(levels, plain));
}

MipTexture in_file_order(MipTexture texture)
{
    if (!texture.blue_first) return texture;
    for (auto& level : texture.levels) detail::swap_red_blue(level, texture.format.channels);
    return texture;
}

void check_red_first(const MipTexture& texture)
{
    if (!texture.blue_first) return;
    throw Error("texture: ktx2 is not written blue first (bgra8)", "Use rgba8, or write .dds.");
}

std::vector<std::byte> file_bytes(const fs::path& path, std::uint64_t most)
{
    const std::string text = read_file(path, "image", most);
    const auto* bytes = reinterpret_cast<const std::byte*>(text.data());
    return {bytes, bytes + text.size()};
}

}  // namespace

bool holds_mip_chain(const fs::path& path)
{
    const std::string extension = lower_extension(path);
    return extension == ".dds" || extension == ".ktx2" || extension == ".exr";
}

void write_mip_chain(const fs::path& path, std::span<const RawImage> levels,
                     const TextureWriteOptions& options)
{
    check_holds_levels(path);
    const std::string extension = lower_extension(path);
    if (extension == ".exr") {
        write_exr_chain(path, levels, options);
        return;
    }
    if (options.zstd && extension == ".dds") {
        throw Error("output " + path.string() + ": DDS has no zstd compression", "Write .ktx2.");
    }
    // Levels that are stored as they are need no copy.
    MipTexture texture = detail::texture_shape(levels, options);
    detail::LevelBytes bytes;
    const bool kept = !texture.blue_first && !texture.format.block &&
                      texture.format.type == levels[0].type &&
                      texture.format.channels == levels[0].channels;
    if (kept) {
        for (const RawImage& level : levels) bytes.emplace_back(level.bytes);
    } else {
        texture = in_file_order(make_texture(levels, options));
        bytes = detail::level_bytes_of(texture);
    }
    if (extension == ".ktx2") {
        check_red_first(texture);
        const detail::Ktx2Parts file = detail::ktx2_parts(texture, bytes, options.zstd);
        write_bytes(path, file.parts);
        return;
    }
    const std::vector<std::byte> header = detail::dds_header(texture, bytes.size());
    bytes.insert(bytes.begin(), header);
    write_bytes(path, bytes);
}

void write_mip_chain(const fs::path& path, const std::vector<RawImage>& levels,
                     const TextureWriteOptions& options)
{
    write_mip_chain(path, std::span(levels), options);
}

void write_mip_chain(const fs::path& path, const std::vector<Image>& levels,
                     const TextureWriteOptions& options)
{
    check_holds_levels(path);
    TextureWriteOptions labelled = options;
    labelled.srgb = options.srgb || (!levels.empty() && levels[0].space == ColorSpace::Linear);
    const bool exr = lower_extension(path) == ".exr";
    PixelType type = exr ? PixelType::F32 : PixelType::U8;
    if (!options.format.empty()) type = texture_format(options.format).type;
    std::vector<RawImage> raw;
    for (const Image& level : levels) {
        raw.push_back(to_raw(level, type, options.dither ? Rounding::Ordered : Rounding::Nearest));
    }
    if (exr && options.format.empty() && !levels.empty()) {
        labelled.format =
            name_of({{}, PixelType::F16, std::clamp(levels[0].channels, 1, 4), false});
    }
    write_mip_chain(path, raw, labelled);
}

void write_bump_slopes(const fs::path& path, const std::vector<Image>& levels)
{
    if (lower_extension(path) != ".exr" || levels.empty() || levels[0].channels != 6) {
        throw Error("output " + path.string() + ": slopes of bumps are six channels of an .exr",
                    "Write .exr.");
    }
    MipTexture texture{levels[0].width, levels[0].height, {{}, PixelType::F32, 6, false}, false, {}};
    for (const Image& level : levels) texture.levels.push_back(to_raw(level, PixelType::F32).bytes);
    detail::write_exr_mips(path, texture);
}

std::vector<std::byte> texture_bytes(const MipTexture& texture, const std::string& container,
                                     int zstd)
{
    if (container == "ktx2") {
        check_red_first(texture);
        return detail::ktx2_file(texture, zstd);
    }
    std::vector<std::byte> bytes = detail::dds_header(texture, texture.levels.size());
    for (const auto& level : in_file_order(texture).levels) bytes.insert(bytes.end(), level.begin(), level.end());
    return bytes;
}

std::uint64_t images_of_texture(const fs::path& path)
{
    std::array<char, 148> bytes{};
    std::ifstream file(path, std::ios::binary);
    file.read(bytes.data(), bytes.size());
    const std::span<const std::byte> head = std::as_bytes(std::span(bytes));
    const auto word = [&](std::size_t at) { return std::uint64_t{detail::read_u32(head, at)}; };
    if (std::memcmp(bytes.data() + 1, "KTX 20", 6) == 0)
        return std::max<std::uint64_t>(1, word(32)) * std::max<std::uint64_t>(1, word(36));
    if (std::memcmp(bytes.data(), "DDS ", 4) != 0) return 1;
    constexpr std::uint64_t kFaces = 0xfc00, kCube = 0x200, kCubeOfDx10 = 4;
    if (std::memcmp(bytes.data() + 84, "DX10", 4) == 0)
        return std::max<std::uint64_t>(1, word(140)) * ((word(136) & kCubeOfDx10) != 0 ? 6u : 1u);
    return (word(112) & kCube) != 0 ? std::max<std::uint64_t>(1, static_cast<std::uint64_t>(std::popcount(word(112) & kFaces))) : 1;
}

MipTexture read_texture(const fs::path& path, const ReadOptions& options)
{
    return decode_texture(file_bytes(path, options.max_bytes), path.string(), options);
}

MipTexture decode_texture(std::span<const std::byte> bytes, const std::string& name,
                          const ReadOptions& options)
{
    const bool ktx2 = bytes.size() > 12 && bytes[0] == std::byte{0xab};
    const bool dds = bytes.size() > 4 && std::memcmp(bytes.data(), "DDS ", 4) == 0;
    if (!ktx2 && !dds) {
        throw Error("image " + name + ": its content is neither DDS nor KTX2",
                    "Convert it: petrichor texture convert " + fs::path(name).filename().string() +
                        " -o out.dds");
    }
    try {
        return ktx2 ? detail::parse_ktx2(bytes, options) : detail::parse_dds(bytes, options);
    } catch (const Error&) {
        throw;
    } catch (const std::runtime_error& why) {
        throw Error(
            "image " + name + ": " + why.what(),
            "Check that the file opens in another program; export it again if it is damaged.");
    }
}

}  // namespace petrichor::texproc
