// petrichor texture convert: any image that can be read to any file that can be written.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/words.h"
#include "cli/texture/cmd_texture.h"
#include "cli/texture/maps/files.h"
#include "texproc/codecs/files/texture.h"
#include "texproc/filter/bump_slopes.h"
#include "texproc/filter/mips.h"
#include "texproc/filter/normal.h"
#include "texproc/filter/resample.h"
#include "texproc/material/normal_channels.h"

namespace petrichor::cli {

namespace {

namespace fs = std::filesystem;

struct Arguments {
    std::string in, out, format;
    std::string wrap = "wrap";
    bool srgb = false, linear = false, mips = false, normals = false, dither = false;
    bool alpha_data = false, bump_slopes = false;
    std::string size;
    double scale = 0.0;
    float rdo = 0.0f;
    std::optional<float> rdo_most;
    int bits = 0, jpeg_quality = 95, zstd = 0, threads = 0;
    std::string quality = "normal";
    std::string filter = "box";
    texproc::ReadOptions reading;
};

constexpr int kMostTexels = 65536;  // along a side

const std::map<std::string, texproc::BlockQuality> kQualities{
    {"fast", texproc::BlockQuality::Fast},
    {"normal", texproc::BlockQuality::Normal},
    {"best", texproc::BlockQuality::Best}};

const std::map<std::string, texproc::MipFilter> kFilters{
    {"box", texproc::MipFilter::Box},
    {"kaiser", texproc::MipFilter::Kaiser},
    {"lanczos3", texproc::MipFilter::Lanczos3},
    {"mitchell", texproc::MipFilter::Mitchell}};

std::string extension_of(const fs::path& path)
{
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

bool is_container(const std::string& extension)
{
    return extension == ".dds" || extension == ".ktx2";
}

void check(const Arguments& a)
{
    const std::string extension = extension_of(a.out);
    const bool container = is_container(extension);
    if (a.srgb && a.linear) {
        throw Error("texture convert: --srgb and --linear exclude each other", "Give one of them.");
    }
    if (!a.format.empty()) {
        const auto names = texproc::texture_format_names();
        if (std::find(names.begin(), names.end(), a.format) == names.end()) {
            throw Error("texture convert: there is no format '" + a.format + "'." +
                            did_you_mean(a.format, names),
                        "Use one of " + join_words(names) + ".");
        }
    }
    if (!container && !a.format.empty() && !(extension == ".exr" && a.mips)) {
        throw Error(
            "texture convert: --format is for .dds and .ktx2 (and .exr with --mips), not '" +
                extension + "'",
            "Use --bits 8 or 16 (png, tif), 16 or 32 (exr).");
    }
    if (a.mips && !container && extension != ".exr") {
        throw Error("texture convert: '" + extension + "' does not hold mip levels",
                    "Write .dds, .ktx2 or .exr; or: petrichor texture mips IN -o 'out_%d.png'.");
    }
    if (a.bump_slopes && (extension != ".exr" || !a.mips)) {
        throw Error("texture convert: --bump-slopes is for .exr with --mips, not '" + extension + "'",
                    "Write .exr and add --mips.");
    }
    if (a.bump_slopes && (a.srgb || !a.format.empty() || a.bits)) {
        throw Error("texture convert: --bump-slopes writes six channels of 32-bit floats",
                    "Leave out --srgb, --format and --bits.");
    }
    if (!a.size.empty() && a.scale > 0.0) {
        throw Error("texture convert: --size and --scale exclude each other", "Give one of them.");
    }
    if (a.rdo > 0.0f && (a.format.empty() || !texproc::texture_format(a.format).block)) {
        throw Error("texture convert: --rdo is for formats of blocks, not '" +
                        (a.format.empty() ? extension : a.format) + "'",
                    "Add --format bc7, or leave it out.");
    }
    if (a.rdo_most && a.rdo == 0.0f) {
        throw Error("texture convert: --rdo-most bounds what --rdo costs",
                    "Add --rdo 1, or leave it out.");
    }
    if (a.zstd && extension != ".ktx2") {
        throw Error("texture convert: --zstd is for .ktx2, not '" + extension + "'",
                    "Leave it out.");
    }
}

texproc::PixelType type_for(const std::string& extension, int bits, texproc::PixelType own)
{
    using texproc::PixelType;
    if (extension == ".exr") {
        if (bits) return bits == 32 ? PixelType::F32 : PixelType::F16;
        return own == PixelType::F32 ? PixelType::F32 : PixelType::F16;
    }
    if (bits == 8) return PixelType::U8;
    if (bits == 16) return PixelType::U16;
    if (bits == 32) return PixelType::F32;
    if (is_container(extension)) return own;
    const bool deep = own != PixelType::U8 &&
                      (extension == ".png" || extension == ".tif" || extension == ".tiff");
    return deep ? PixelType::U16 : PixelType::U8;
}

// Levels filtered in linear light where the numbers are colour.
std::vector<Image> levels_of(const Arguments& a, const texproc::RawImage& raw)
{
    Image image = texproc::to_image(raw, a.srgb ? ColorSpace::Linear : ColorSpace::Data);
    return texproc::mip_chain(std::move(image), {.wrap_u = a.wrap == "wrap",
                                      .wrap_v = a.wrap == "wrap",
                                      .normals = a.normals,
                                      .filter = kFilters.at(a.filter),
                                      .mirror_u = a.wrap == "mirror",
                                      .mirror_v = a.wrap == "mirror",
                                      .alpha_weighted = !a.alpha_data,
                                      .drop_first = true,
                                      .threads = a.threads});
}

struct Extent {
    int width, height;
};

// "512" (the longer side), "512x256".
Extent extent_of(const std::string& text, const texproc::RawImage& raw)
{
    int width = 0, height = 0;
    char rest = 0;
    if (std::sscanf(text.c_str(), "%dx%d%c", &width, &height, &rest) == 2 && width > 0 &&
        height > 0 && width <= kMostTexels && height <= kMostTexels)
        return {width, height};
    if (std::sscanf(text.c_str(), "%d%c", &width, &rest) != 1 || width < 1 || width > kMostTexels) {
        throw Error("texture convert: --size takes W or WxH, 1 to " + std::to_string(kMostTexels) +
                        ", not '" + text + "'",
                    "Write --size 1024 (the longer side), or --size 1024x512.");
    }
    const double scale = static_cast<double>(width) / std::max(raw.width, raw.height);
    return {std::max(1, static_cast<int>(std::lround(raw.width * scale))),
            std::max(1, static_cast<int>(std::lround(raw.height * scale)))};
}

Extent scaled(const texproc::RawImage& raw, double scale)
{
    const auto side = [&](int size) {
        return std::clamp(static_cast<int>(std::lround(size * scale)), 1, kMostTexels);
    };
    return {side(raw.width), side(raw.height)};
}

// Means over exact areas where a side shrinks, bilinear where it grows; colour in linear light.
texproc::RawImage in_size(const Arguments& a, const texproc::RawImage& raw)
{
    const Extent to = a.size.empty() ? scaled(raw, a.scale) : extent_of(a.size, raw);
    if (static_cast<long long>(to.width) * to.height > a.reading.max_pixels) {
        throw Error("texture convert: " + std::to_string(to.width) + " x " +
                        std::to_string(to.height) + " is more than --max-pixels " +
                        std::to_string(a.reading.max_pixels),
                    "Ask for less, or raise --max-pixels.");
    }
    Image image = texproc::to_image(raw, a.srgb ? ColorSpace::Linear : ColorSpace::Data);
    image = texproc::resized(image, to.width, to.height, a.threads);
    if (a.normals && image.channels == 3) texproc::renormalize(image);
    return texproc::to_raw(image, raw.type);
}

// What BC6H has no place for.
void tell_losses(const std::string& format, const texproc::RawImage& raw)
{
    if (!format.starts_with("bc6h")) return;
    const Image values = texproc::to_image(raw, ColorSpace::Data);
    const std::size_t step = static_cast<std::size_t>(values.channels);
    const std::size_t colors = step == 2 || step == 4 ? step - 1 : step;
    std::size_t below = 0, beyond = 0;
    for (std::size_t i = 0; i < values.pixels.size(); ++i) {
        if (i % step >= std::min<std::size_t>(colors, 3)) continue;
        below += values.pixels[i] < 0.0f;
        beyond += !(std::abs(values.pixels[i]) <= 65504.0f);
    }
    if (colors < step) std::cerr << "note: BC6H has no alpha, it is left out\n";
    if (below > 0 && format == "bc6h")
        std::cerr << "note: " << below << " numbers below 0 become 0 (bc6h-signed keeps them)\n";
    if (beyond > 0)
        std::cerr << "note: " << beyond << " numbers beyond half floats become the last one, 65504, or 0\n";
}

// Floats beyond 0..1 have no code among integers and in most blocks.
void tell_cuts(const texproc::RawImage& raw, const std::string& format, texproc::PixelType type)
{
    const auto is_float = [](texproc::PixelType t) {
        return t == texproc::PixelType::F16 || t == texproc::PixelType::F32;
    };
    bool kept = is_float(type);
    if (!format.empty()) {
        const texproc::TextureFormat to = texproc::texture_format(format);
        kept = to.block ? format.starts_with("bc6h") : is_float(to.type);
    }
    if (!is_float(raw.type) || kept) return;
    tell_cut_numbers(texproc::to_image(raw, ColorSpace::Data));
}

void write_slopes(const Arguments& a, const texproc::RawImage& raw)
{
    const int channels = a.normals ? 3 : 1;
    const Image map = texproc::to_image(raw, ColorSpace::Data);
    if (map.channels < channels) {
        throw Error("texture convert: --normals needs 3 channels, '" + a.in + "' has " +
                        std::to_string(map.channels),
                    "Leave --normals out where it holds heights.");
    }
    for (std::size_t i = 0; !a.normals && map.channels > 2 && i < map.pixels.size();
         i += static_cast<std::size_t>(map.channels)) {  // gray in three channels is fine
        if (map.pixels[i] == map.pixels[i + 1] && map.pixels[i] == map.pixels[i + 2]) continue;
        throw Error("texture convert: --bump-slopes needs heights, '" + a.in + "' is coloured",
                    "Give a height map, or add --normals where it is a normal map.");
    }
    texproc::Edge edge = texproc::Edge::Wrap;
    if (a.wrap == "clamp") edge = texproc::Edge::Clamp;
    if (a.wrap == "mirror") edge = texproc::Edge::Mirror;
    Image used(map.width, map.height, channels, ColorSpace::Data);
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x)
            for (int c = 0; c < channels; ++c) used.at(x, y, c) = map.at(x, y, c);
    const std::vector<Image> levels = texproc::mip_chain(
        texproc::bump_slopes(used, edge, edge), {.filter = kFilters.at(a.filter), .threads = a.threads});
    texproc::write_bump_slopes(a.out, levels);
    std::cout << levels.size() << " levels\n";
}

void run(const Arguments& a)
{
    check(a);
    texproc::RawImage raw = texproc::read_raw(a.in, a.reading);
    if (const std::uint64_t images = texproc::images_of_texture(a.in); images > 1) {
        std::cerr << "note: " << a.in << " is an array, a cube or a film of " << images
                  << " images; the first is converted\n";
    }
    if (!a.size.empty() || a.scale > 0.0) raw = in_size(a, raw);
    if (a.bump_slopes) {
        write_slopes(a, raw);
        return;
    }
    if (a.normals && raw.channels == 3 && texproc::drops_z(a.format))
        raw = texproc::unit_normals(raw, raw.type);
    tell_losses(a.format, raw);
    const std::string extension = extension_of(a.out);
    const texproc::PixelType type = type_for(extension, a.bits, raw.type);
    tell_cuts(raw, a.format, type);
    const texproc::Rounding rounding =
        a.dither ? texproc::Rounding::Ordered : texproc::Rounding::Nearest;
    const ColorSpace space = a.srgb ? ColorSpace::Linear : ColorSpace::Data;
    const texproc::TextureWriteOptions writing{.format = a.format,
                                               .srgb = a.srgb,
                                               .dither = a.dither,
                                               .quality = kQualities.at(a.quality),
                                               .repeat = a.rdo,
                                               .repeat_most = a.rdo_most.value_or(
                                                   std::numeric_limits<float>::infinity()),
                                               .zstd = a.zstd,
                                               .threads = a.threads};
    // Integers stay as they are; a change of type goes through linear light when they are colour.
    const auto stored = [&](const Image& level) { return texproc::to_raw(level, type, rounding); };
    const auto first = [&] {
        return raw.type == type ? raw : stored(texproc::to_image(raw, space));
    };
    if (a.rdo > 0.0f && a.zstd == 0) {
        std::cerr << "note: --rdo makes what is packed later smaller, not this file"
                  << (extension == ".ktx2" ? " (--zstd packs it)\n" : "\n");
    }
    if (!a.mips) {
        const texproc::RawImage image = first();
        if (is_container(extension)) {
            texproc::write_mip_chain(a.out, std::vector<texproc::RawImage>{image}, writing);
        } else {
            texproc::write_raw(a.out, image, {.quality = a.jpeg_quality, .threads = a.threads});
        }
        return;
    }
    const std::vector<Image> chain = levels_of(a, raw);
    std::vector<texproc::RawImage> levels;
    levels.push_back(raw.type == type ? std::move(raw) : first());
    for (std::size_t k = 1; k < chain.size(); ++k) levels.push_back(stored(chain[k]));
    texproc::write_mip_chain(a.out, levels, writing);
    std::cout << levels.size() << " levels\n";
}

}  // namespace

void add_texture_convert(CLI::App& texture)
{
    auto a = std::make_shared<Arguments>();
    CLI::App* app = texture.add_subcommand(
        "convert", "any image to another file: png, tga, tif, jpg, exr, dds, ktx2");
    app->add_option("image", a->in, "PNG, TGA, TIFF, PSD, EXR, HDR, JPEG, WebP, BMP, DDS, KTX2")
        ->required();
    app->add_option("-o,--out", a->out, "the extension decides")->required();
    app->add_option(
        "--format", a->format,
        "dds, ktx2: r8 rg8 rgb8 rgba8, 16, 16f, 32f; bc1 bc1a bc3 bc4 bc5 bc7, bc6h "
        "(light beyond 0..1; bc6h-signed keeps what is below 0); ktx2 alone: "
        "uastc uastca, astc-4x4 astc-5x5 astc-6x6 astc-8x8; default: the numbers of the image");
    app->add_flag("--srgb", a->srgb, "it is colour: label it so, filter in linear light");
    app->add_flag("--linear", a->linear, "it is data (default)");
    app->add_flag("--mips", a->mips, "all levels down to 1 x 1 (dds, ktx2, exr)");
    app->add_option("--filter", a->filter, "of the levels")
        ->check(CLI::IsMember({"box", "kaiser", "lanczos3", "mitchell"}))
        ->capture_default_str();
    app->add_option("--size", a->size,
                    "W (the longer side) or WxH: another size before anything else");
    app->add_option("--scale", a->scale, "the same by a factor: 0.5 halves the sides")
        ->check(CLI::Range(1e-4, 64.0));
    app->add_option("--wrap", a->wrap, "past the edges: wrap, clamp, mirror")
        ->check(CLI::IsMember({"wrap", "clamp", "mirror"}))
        ->capture_default_str();
    app->add_flag("--alpha-data", a->alpha_data,
                  "--srgb --mips: alpha is no coverage; colour counts the same under all of it");
    app->add_flag("--normals", a->normals, "a normal map: levels are made unit length again");
    app->add_flag("--bump-slopes", a->bump_slopes,
                  "exr --mips: height, its slopes a texel, their squares and product, as maketx "
                  "--bumpslopes; of heights, or with --normals of a normal map");
    app->add_option("--quality", a->quality, "of blocks")
        ->check(CLI::IsMember({"fast", "normal", "best"}))
        ->capture_default_str();
    app->add_option("--bits", a->bits, "8 or 16 (integers), 16 or 32 (exr); default: as the image")
        ->check(CLI::IsMember({8, 16, 32}));
    app->add_flag("--dither", a->dither, "to 8 bits by an ordered pattern in place of rounding");
    app->add_option("--zstd", a->zstd, "ktx2: compress, 1 (fast) to 22 (small)")
        ->check(CLI::Range(0, 22));
    app->add_option("--rdo", a->rdo,
                    "blocks repeat bytes of earlier ones where that costs at most so much squared "
                    "error a bit (0.25 is hardly seen; 1 shows as stripes on smooth maps): smaller files with --zstd")
        ->check(CLI::Range(0.0, 1000.0));
    app->add_option("--rdo-most", a->rdo_most,
                    "how far off a block may get by --rdo, root mean square in codes (1: 48 dB); default: any")
        ->check(CLI::Range(0.01, 255.0));
    app->add_option("--jpeg-quality", a->jpeg_quality, "1 to 100")->check(CLI::Range(1, 100));
    app->add_option("--threads", a->threads, "0: all cores; the bytes do not depend on it");
    app->add_option("--max-pixels", a->reading.max_pixels, "refuse larger inputs")
        ->capture_default_str();
    app->footer(
        "Examples:\n"
        "  petrichor texture convert wall_color.png -o wall.dds --format bc7 --srgb --mips\n"
        "  petrichor texture convert wall_normal.png -o wall_n.ktx2 --format bc5 --mips --normals "
        "--zstd 18\n"
        "  petrichor texture convert sky.hdr -o sky.dds --format bc6h --mips\n"
        "  petrichor texture convert height.exr -o height.png --bits 16\n"
        "  petrichor texture convert wall_color.png -o small.png --srgb --size 512\n"
        "  petrichor texture convert height.exr -o height_tx.exr --mips");
    app->callback([a] { run(*a); });
}

}  // namespace petrichor::cli
