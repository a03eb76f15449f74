#include "texproc/files/detail/deflate.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "texproc/files/detail/huffman.h"

namespace petrichor::texproc::detail {
namespace {

using Bytes = std::vector<std::uint8_t>;

// What zlib makes of deflate blocks; empty when it finds a fault in them.
Bytes inflated(const std::vector<std::byte>& blocks, std::size_t size)
{
    Bytes out(size + 1);
    z_stream z{};
    EXPECT_EQ(inflateInit2(&z, -15), Z_OK);
    z.next_in = reinterpret_cast<Bytef*>(const_cast<std::byte*>(blocks.data()));
    z.avail_in = static_cast<uInt>(blocks.size());
    z.next_out = out.data();
    z.avail_out = static_cast<uInt>(out.size());
    const int result = inflate(&z, Z_FINISH);
    EXPECT_EQ(result, Z_STREAM_END) << (z.msg ? z.msg : "");
    EXPECT_EQ(z.avail_in, 0u);
    out.resize(out.size() - z.avail_out);
    inflateEnd(&z);
    return result == Z_STREAM_END ? out : Bytes();
}

struct Content {
    const char* name;
    std::function<int(std::size_t, std::uint32_t)> value;  // of a place and random bits
};
void PrintTo(const Content& content, std::ostream* out)
{
    *out << content.name;
}

class Deflate : public testing::TestWithParam<Content> {};

TEST_P(Deflate, ZlibReadsWhatWasWritten)
{
    for (const std::size_t size : {0, 1, 2, 3, 7, 258, 259, 5000, 32768, 32770, 131072, 300001}) {
        Bytes data(size);
        std::uint32_t state = 1;
        for (std::size_t i = 0; i < size; ++i) {
            state = state * 1664525u + 1013904223u;
            data[i] = static_cast<std::uint8_t>(GetParam().value(i, state >> 8));
        }
        const auto whole = deflated(data, true);
        EXPECT_EQ(inflated(whole, size), data) << size;
        EXPECT_LE(static_cast<double>(whole.size()), 1.001 * static_cast<double>(size) + 300.0);

        // Two parts that know nothing of each other follow on.
        const std::span<const std::uint8_t> all(data);
        auto parts = deflated(all.first(size / 3), false);
        const auto rest = deflated(all.subspan(size / 3), true);
        parts.insert(parts.end(), rest.begin(), rest.end());
        EXPECT_EQ(inflated(parts, size), data) << size;
    }
}

INSTANTIATE_TEST_SUITE_P(
    Contents, Deflate,
    testing::Values(Content{"flat", [](std::size_t, std::uint32_t) { return 17; }},
                    Content{"noise",
                            [](std::size_t, std::uint32_t bits) { return int(bits & 255); }},
                    Content{"ramp", [](std::size_t i, std::uint32_t) { return int(i & 255); }},
                    Content{"far_repeats",
                            [](std::size_t i, std::uint32_t) { return int(i * i % 32749 % 251); }},
                    Content{"rare_bytes",
                            [](std::size_t, std::uint32_t bits) {
                                return bits % 997 == 0 ? int(bits / 997 % 256) : 0;
                            }},
                    Content{"narrow",
                            [](std::size_t, std::uint32_t bits) {
                                return int((bits & 3) + (bits >> 4 & 3) + (bits >> 8 & 3)) - 4;
                            }}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(Deflate, FlatDataNearlyVanish)
{
    EXPECT_LT(deflated(Bytes(1 << 19, 5), true).size(), 2000u);
}

double kraft_sum(const PrefixCode& code)
{
    double sum = 0.0;
    for (const int length : code.length) sum += length ? std::ldexp(1.0, -length) : 0.0;
    return sum;
}

TEST(PrefixCodes, AreCompleteWithinTheLongestWordForAnyCounts)
{
    std::vector<std::uint32_t> fibonacci{1, 1};  // the counts with the deepest tree
    while (fibonacci.size() < 40)
        fibonacci.push_back(*(fibonacci.end() - 1) + *(fibonacci.end() - 2));
    std::vector<std::uint32_t> one(19), none(30), equal(286, 7);
    one[11] = 5;
    for (const auto& counts : {fibonacci, one, none, equal}) {
        for (const int longest : {15, 9}) {
            const PrefixCode code = prefix_code(counts, longest);
            EXPECT_DOUBLE_EQ(kraft_sum(code), 1.0);
            EXPECT_LE(*std::max_element(code.length.begin(), code.length.end()), longest);
            for (std::size_t s = 0; s < counts.size(); ++s) {
                if (counts[s]) {
                    EXPECT_GT(code.length[s], 0) << s;
                }
            }
        }
    }
}

TEST(PrefixCodes, MatchTheExampleOfTheStandard)
{
    // RFC 1951, 3.2.2: lengths (3, 3, 3, 3, 3, 2, 4, 4) give 010 011 100 101 110 00 1110 1111.
    const std::vector<std::uint32_t> counts{4, 4, 4, 4, 4, 8, 2, 2};
    const PrefixCode code = prefix_code(counts, 15);
    EXPECT_EQ(code.length, (std::vector<std::uint8_t>{3, 3, 3, 3, 3, 2, 4, 4}));
    // Lowest bit first.
    EXPECT_EQ(code.bits, (std::vector<std::uint16_t>{2, 6, 1, 5, 3, 0, 7, 15}));
}

}  // namespace
}  // namespace petrichor::texproc::detail
