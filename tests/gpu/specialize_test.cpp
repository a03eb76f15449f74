#include "gpu/device/specialize.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "gpu/device/by_value.h"
#include "gpu/device/shaders.h"

namespace petrichor::gpu {
namespace {

// Instructions of SPIR-V: five words of head, then each with its length and number in its first.
int count_of(std::span<const std::uint32_t> words, std::uint32_t op, std::uint32_t second = 0)
{
    int count = 0;
    for (std::size_t at = 5; at < words.size() && words[at] >> 16 > 0; at += words[at] >> 16) {
        if ((words[at] & 0xffffu) != op) continue;
        if (second == 0 || (at + 2 < words.size() && words[at + 2] == second)) ++count;
    }
    return count;
}

constexpr std::uint32_t kFunction = 54;
constexpr std::uint32_t kDecorate = 71;
constexpr std::uint32_t kSpecId = 1;  // the decoration

class Specialize : public testing::Test {
protected:
    void SetUp() override
    {
        if (!can_specialize()) GTEST_SKIP() << "built without SPIRV-Tools";
        ASSERT_FALSE(lighting.empty());
    }
    std::span<const std::uint32_t> lighting = embedded_shader("lighting.comp");
};

TEST_F(Specialize, WhatIsSwitchedOffIsGone)
{
    ASSERT_GT(count_of(lighting, kDecorate, kSpecId), 5);
    const auto with_all = [this](std::uint32_t value) {
        std::vector<Specialization> all;
        for (std::uint32_t id = 0; id < 32; ++id) all.push_back({id, value});
        return specialized(lighting, all);
    };
    const auto off = with_all(0);
    const auto on = with_all(1);
    EXPECT_EQ(count_of(off, kDecorate, kSpecId), 0);
    EXPECT_GT(count_of(lighting, kFunction), 10);
    EXPECT_EQ(count_of(off, kFunction), 1);
    EXPECT_LT(off.size(), on.size() / 2);
}

TEST_F(Specialize, NoShaderOfOursIsLeftToTheDriver)
{
    ASSERT_GT(embedded_shaders().size(), 50u);
    for (const EmbeddedShader& shader : embedded_shaders())
        EXPECT_FALSE(specialized(shader.code, {}).empty()) << shader.name;
}

// Addresses stay where a function writes: what it only reads comes as a value, and it is the same shader.
TEST_F(Specialize, ArgumentsThatAreReadComeAsValues)
{
    const auto pointers = [](std::span<const std::uint32_t> words) {
        constexpr std::uint32_t kTypePointer = 32, kParameter = 55, kOfFunction = 7;
        std::vector<std::uint32_t> types;
        int count = 0;
        for (std::size_t at = 5; at < words.size() && words[at] >> 16 > 0; at += words[at] >> 16) {
            if ((words[at] & 0xffffu) == kTypePointer && words[at + 2] == kOfFunction) types.push_back(words[at + 1]);
            if ((words[at] & 0xffffu) == kParameter) count += std::count(types.begin(), types.end(), words[at + 1]) > 0;
        }
        return count;
    };
    constexpr std::uint32_t kParameter = 55, kCall = 57;
    const auto values = by_value(lighting);
    EXPECT_EQ(count_of(values, kParameter), count_of(lighting, kParameter));
    EXPECT_EQ(count_of(values, kCall), count_of(lighting, kCall));
    EXPECT_GT(pointers(lighting), 400);
    EXPECT_LT(pointers(values), pointers(lighting) / 5);
    EXPECT_GT(pointers(values), 0);
    EXPECT_EQ(by_value(values), values) << "nothing is left to do";
}

TEST_F(Specialize, WhatIsNoShaderStaysAsItIs)
{
    const std::vector<std::uint32_t> noise(100, 0xdeadbeefu);
    EXPECT_EQ(by_value(noise), noise);
    EXPECT_TRUE(by_value({}).empty());
    for (std::size_t size = 1; size < lighting.size(); size += lighting.size() / 97)
        EXPECT_GE(by_value(lighting.first(size)).size(), size);
}

TEST_F(Specialize, ShadersThatCannotBeReadAreLeftToTheDriver)
{
    const std::vector<std::uint32_t> noise(100, 0xdeadbeefu);
    EXPECT_TRUE(specialized(noise, {}).empty());
    EXPECT_TRUE(specialized({}, {}).empty());
    EXPECT_TRUE(specialized(lighting.first(lighting.size() / 2), {}).empty());
}

TEST_F(Specialize, WhatIsKeptIsWhatWasMadeForEachConstant)
{
    namespace fs = std::filesystem;
    const fs::path folder =
        fs::path(testing::TempDir()) / ("petrichor_specialize_" + std::to_string(::getpid()));
    const ContentCache cache(folder, 64u << 20);
    const auto zero = specialized(lighting, {{1, 0}}, cache);
    const auto one = specialized(lighting, {{1, 1}}, cache);
    EXPECT_NE(zero, one);
    EXPECT_EQ(specialized(lighting, {{1, 0}}, cache), zero);
    EXPECT_EQ(specialized(lighting, {{1, 1}}, cache), one);
    EXPECT_EQ(specialized(lighting, {{1, 1}}), one);
    EXPECT_GT(cache.size(), 0u);
    fs::remove_all(folder);
}

}  // namespace
}  // namespace petrichor::gpu
