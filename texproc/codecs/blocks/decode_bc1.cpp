// BC1 and BC4: endpoints and the steps between them.
#include "texproc/codecs/blocks/detail/decode_block.h"

namespace petrichor::texproc::detail {

namespace {

std::uint64_t load64(const std::byte* from)
{
    std::uint64_t v = 0;
    for (int i = 0; i < 8; ++i) v |= static_cast<std::uint64_t>(from[i]) << (8 * i);
    return v;
}

}  // namespace

std::array<std::array<std::uint8_t, 4>, 4> bc1_palette(std::uint16_t c0, std::uint16_t c1,
                                                       bool three)
{
    const int a[3] = {widen5(c0 >> 11), widen6((c0 >> 5) & 63), widen5(c0 & 31)};
    const int b[3] = {widen5(c1 >> 11), widen6((c1 >> 5) & 63), widen5(c1 & 31)};
    std::array<std::array<std::uint8_t, 4>, 4> palette{};
    for (std::size_t c = 0; c < 3; ++c) {
        palette[0][c] = static_cast<std::uint8_t>(a[c]);
        palette[1][c] = static_cast<std::uint8_t>(b[c]);
        palette[2][c] =
            static_cast<std::uint8_t>(three ? (a[c] + b[c] + 1) >> 1 : (2 * a[c] + b[c] + 1) / 3);
        palette[3][c] = static_cast<std::uint8_t>(three ? 0 : (a[c] + 2 * b[c] + 1) / 3);
    }
    for (std::size_t k = 0; k < 4; ++k) palette[k][3] = three && k == 3 ? 0 : 255;
    return palette;
}

std::array<std::uint8_t, 8> bc4_palette(int r0, int r1)
{
    std::array<std::uint8_t, 8> palette{static_cast<std::uint8_t>(r0),
                                        static_cast<std::uint8_t>(r1)};
    const int steps = r0 > r1 ? 7 : 5;
    for (int k = 1; k < steps; ++k) {
        palette[static_cast<std::size_t>(k + 1)] =
            static_cast<std::uint8_t>(((steps - k) * r0 + k * r1 + steps / 2) / steps);
    }
    if (steps == 5) palette[7] = 255;
    return palette;
}

void decode_bc1(const std::byte* block, bool always_four, Rgba8Block& to)
{
    const std::uint64_t v = load64(block);
    const std::uint16_t c0 = static_cast<std::uint16_t>(v),
                        c1 = static_cast<std::uint16_t>(v >> 16);
    const auto palette = bc1_palette(c0, c1, !always_four && c0 <= c1);
    for (std::size_t t = 0; t < 16; ++t) to[t] = palette[(v >> (32 + 2 * t)) & 3];
}

std::array<std::uint8_t, 16> decode_bc4(const std::byte* block)
{
    const std::uint64_t v = load64(block);
    const auto palette = bc4_palette(static_cast<int>(v & 255), static_cast<int>((v >> 8) & 255));
    std::array<std::uint8_t, 16> values;
    for (std::size_t t = 0; t < 16; ++t) values[t] = palette[(v >> (16 + 3 * t)) & 7];
    return values;
}

std::array<float, 16> decode_bc4_exact(const std::byte* block)
{
    const std::uint64_t v = load64(block);
    const auto palette =
        exact_bc4_palette(static_cast<int>(v & 255), static_cast<int>((v >> 8) & 255));
    std::array<float, 16> values;
    for (std::size_t t = 0; t < 16; ++t) values[t] = palette[(v >> (16 + 3 * t)) & 7] / 255.0f;
    return values;
}

std::array<float, 16> decode_bc4_signed(const std::byte* block)
{
    const std::uint64_t v = load64(block);
    const auto endpoint = [](std::uint64_t code) {
        const int value = static_cast<std::int8_t>(code & 255);
        return static_cast<float>(value < -127 ? -127 : value) / 127.0f;  // -128 is a second -1
    };
    const float r0 = endpoint(v), r1 = endpoint(v >> 8);
    const int steps =
        static_cast<std::int8_t>(v & 255) > static_cast<std::int8_t>((v >> 8) & 255) ? 7 : 5;
    float palette[8] = {r0, r1, 0, 0, 0, 0, -1.0f, 1.0f};
    for (int k = 1; k < steps; ++k) {
        palette[k + 1] = (static_cast<float>(steps - k) * r0 + static_cast<float>(k) * r1) /
                         static_cast<float>(steps);
    }
    std::array<float, 16> values;
    for (std::size_t t = 0; t < 16; ++t) values[t] = palette[(v >> (16 + 3 * t)) & 7];
    return values;
}

}  // namespace petrichor::texproc::detail
