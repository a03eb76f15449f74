#include "texproc/codecs/blocks/detail/astc.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <string>
#include <thread>

#include "base/error.h"
#include "base/parallel.h"

#ifdef PETRICHOR_ASTC
#define ASTCENC_DYNAMIC_LIBRARY  // its functions have C linkage
#include <astcenc.h>
#endif

namespace petrichor::texproc {

#ifdef PETRICHOR_ASTC

bool has_astc()
{
    return true;
}

namespace detail {
namespace {

constexpr std::size_t kBlockBytes = 16;

void check(astcenc_error error)
{
    if (error == ASTCENC_SUCCESS) return;
    throw Error(std::string("astc: ") + astcenc_get_error_string(error),
                "Free some memory, or choose another format.");
}

using Context = std::unique_ptr<astcenc_context, decltype(&astcenc_context_free)>;

Context context_of(int side, bool srgb, float quality, unsigned flags, const std::array<float, 4>& weights)
{
    const auto extent = static_cast<unsigned>(side);
    astcenc_config config{};
    check(astcenc_config_init(srgb ? ASTCENC_PRF_LDR_SRGB : ASTCENC_PRF_LDR, extent, extent, 1, quality, flags,
                              &config));
    // None at all would be a division by zero.
    config.cw_r_weight = std::max(weights[0], 1e-3f);
    config.cw_g_weight = std::max(weights[1], 1e-3f);
    config.cw_b_weight = std::max(weights[2], 1e-3f);
    config.cw_a_weight = std::max(weights[3], 1e-3f);
    astcenc_context* made = nullptr;
    check(astcenc_context_alloc(&config, 1, &made));
    return {made, &astcenc_context_free};
}

// A strip of rows of blocks: its first row of texels, how many, and where its blocks are.
struct Strip {
    int first = 0, rows = 0;
    std::size_t at = 0, bytes = 0;
};

std::vector<Strip> strips_of(int side, int width, int height, int threads)
{
    const int down = (height + side - 1) / side;
    const auto row_bytes = static_cast<std::size_t>((width + side - 1) / side) * kBlockBytes;
    const int count = std::clamp(threads > 0 ? threads : static_cast<int>(std::max(1u, std::thread::hardware_concurrency())), 1, down);
    std::vector<Strip> strips;
    for (int i = 0; i < count; ++i) {
        const int from = down * i / count, to = down * (i + 1) / count;
        strips.push_back({from * side, std::min(to * side, height) - from * side,
                          static_cast<std::size_t>(from) * row_bytes, static_cast<std::size_t>(to - from) * row_bytes});
    }
    return strips;
}

float quality_of(BlockQuality quality)
{
    return quality == BlockQuality::Fast     ? ASTCENC_PRE_FAST
           : quality == BlockQuality::Normal ? ASTCENC_PRE_MEDIUM
                                             : ASTCENC_PRE_THOROUGH;
}

// Four channels: one stands for red, green and blue, missing alpha is 255.
std::vector<std::uint8_t> four_channels(const RawImage& image, const Strip& strip)
{
    const auto channels = static_cast<std::size_t>(image.channels), width = static_cast<std::size_t>(image.width);
    const std::size_t first = static_cast<std::size_t>(strip.first) * width;
    std::vector<std::uint8_t> texels(4 * width * static_cast<std::size_t>(strip.rows));
    for (std::size_t i = 0; 4 * i < texels.size(); ++i) {
        const std::byte* from = &image.bytes[(first + i) * channels];
        for (std::size_t c = 0; c < 4; ++c) {
            const bool there = c < channels;
            texels[4 * i + c] = there                     ? static_cast<std::uint8_t>(from[c])
                                : c == 3                  ? std::uint8_t{255}
                                : channels == 1           ? static_cast<std::uint8_t>(from[0])
                                                          : std::uint8_t{0};
        }
    }
    return texels;
}

astcenc_image image_of(int width, int rows, void** slice)
{
    return {static_cast<unsigned>(width), static_cast<unsigned>(rows), 1, ASTCENC_TYPE_U8, slice};
}

constexpr astcenc_swizzle kAsItIs{ASTCENC_SWZ_R, ASTCENC_SWZ_G, ASTCENC_SWZ_B, ASTCENC_SWZ_A};

}  // namespace

std::vector<std::byte> encode_astc(const RawImage& image, int side, const BlockOptions& options)
{
    const std::vector<Strip> strips = strips_of(side, image.width, image.height, options.threads);
    std::vector<std::byte> bytes(strips.back().at + strips.back().bytes);
    parallel_for(strips.size(), options.threads, [&](std::size_t i) {
        const Strip& strip = strips[i];
        const Context context = context_of(side, options.srgb, quality_of(options.quality), 0, options.weights);
        std::vector<std::uint8_t> texels = four_channels(image, strip);
        void* slice = texels.data();
        astcenc_image source = image_of(image.width, strip.rows, &slice);
        check(astcenc_compress_image(context.get(), &source, &kAsItIs,
                                     reinterpret_cast<std::uint8_t*>(bytes.data() + strip.at), strip.bytes, 0));
    });
    return bytes;
}

RawImage decode_astc(std::span<const std::byte> bytes, int side, int width, int height, bool srgb, int threads)
{
    RawImage image{width, height, 4, PixelType::U8, {}, {}};
    image.bytes.resize(image.values());
    const std::vector<Strip> strips = strips_of(side, width, height, threads);
    parallel_for(strips.size(), threads, [&](std::size_t i) {
        const Strip& strip = strips[i];
        const Context context =
            context_of(side, srgb, ASTCENC_PRE_FASTEST, ASTCENC_FLG_DECOMPRESS_ONLY, {1.0f, 1.0f, 1.0f, 1.0f});
        void* slice = image.bytes.data() + 4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(strip.first);
        astcenc_image to = image_of(width, strip.rows, &slice);
        check(astcenc_decompress_image(context.get(), reinterpret_cast<const std::uint8_t*>(bytes.data() + strip.at),
                                       strip.bytes, &to, &kAsItIs, 0));
    });
    return image;
}

}  // namespace detail

#else

bool has_astc()
{
    return false;
}

namespace detail {
namespace {

[[noreturn]] void refuse()
{
    throw Error("astc: this program was built without Arm's library for it",
                "Install libastcenc-dev and build again, or use bc7 or uastc.");
}

}  // namespace

std::vector<std::byte> encode_astc(const RawImage&, int, const BlockOptions&)
{
    refuse();
}

RawImage decode_astc(std::span<const std::byte>, int, int, int, bool, int)
{
    refuse();
}

}  // namespace detail

#endif

}  // namespace petrichor::texproc
