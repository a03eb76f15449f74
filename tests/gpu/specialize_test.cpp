#include "gpu/device/specialize.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#ifdef PETRICHOR_SPIRV_TOOLS
#include <spirv-tools/libspirv.hpp>
#include <spirv-tools/optimizer.hpp>
#endif

#include "gpu/device/by_value.h"
#include "gpu/device/decided.h"
#include "gpu/device/droppable.h"
#include "gpu/device/prepared.h"
#include "gpu/device/shaders.h"
#include "gpu/device/small_functions.h"
#include "gpu/frame/frame_words_io.h"

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
    // The lighting shader, as pipelines ask for it.
    std::vector<std::uint32_t> cut_down(const std::vector<Specialization>& constants, const ContentCache& cache = {}) const
    {
        return specialized(lighting, constants, cache, find_embedded_shader("lighting.comp")->prepared);
    }
};

TEST_F(Specialize, WhatIsSwitchedOffIsGone)
{
    ASSERT_GT(count_of(lighting, kDecorate, kSpecId), 5);
    const auto with_all = [this](std::uint32_t value) {
        std::vector<Specialization> all;
        for (std::uint32_t id = 0; id < 32; ++id) all.push_back({id, value});
        return cut_down(all);
    };
    const auto off = with_all(0);
    const auto on = with_all(1);
    EXPECT_EQ(count_of(off, kDecorate, kSpecId), 0);
    EXPECT_GT(count_of(lighting, kFunction), 10);
    EXPECT_EQ(count_of(off, kFunction), 1);
    EXPECT_LT(off.size(), on.size() / 2);
}

#ifdef PETRICHOR_SPIRV_TOOLS

// Of a shader, how often each instruction is in it once nothing is in it that nothing needs.
std::map<std::uint32_t, int> needed(std::span<const std::uint32_t> code, spvtools::Optimizer& optimizer)
{
    optimizer.RegisterPass(spvtools::CreateCCPPass())
        .RegisterPass(spvtools::CreateDeadBranchElimPass())
        .RegisterPass(spvtools::CreateEliminateDeadFunctionsPass())
        .RegisterPass(spvtools::CreateAggressiveDCEPass())
        .RegisterPass(spvtools::CreateUnifyConstantPass())
        .RegisterPass(spvtools::CreateAggressiveDCEPass());
    spvtools::OptimizerOptions options;
    options.set_run_validator(false);
    std::vector<std::uint32_t> words;
    EXPECT_TRUE(optimizer.Run(code.data(), code.size(), &words, options));
    std::map<std::uint32_t, int> count;
    constexpr std::uint32_t kPhiOfOne = 5u << 16 | 245u;  // another name of a value
    for (std::size_t at = 5; at < words.size() && words[at] >> 16 > 0; at += words[at] >> 16) {
        if (words[at] != kPhiOfOne) ++count[words[at] & 0xffffu];
    }
    return count;
}

// Constants that switch all off, all on, and every other one: what is left is a shader, without constants that could be set, and
// passes find in it what they find by themselves.
TEST_F(Specialize, WhatConstantsDecideIsDecidedInOneWalk)
{
    spvtools::SpirvTools rules(SPV_ENV_VULKAN_1_3);
    std::string said;
    rules.SetMessageConsumer([&](spv_message_level_t, const char*, const spv_position_t&, const char* text) { said = text; });
    spvtools::ValidatorOptions options;
    options.SetScalarBlockLayout(true);
    std::size_t before = 0, after = 0;
    for (const EmbeddedShader& shader : embedded_shaders()) {
        for (std::uint32_t pattern = 0; pattern < 3; ++pattern) {
            std::vector<Specialization> constants;
            for (std::uint32_t id = 0; id < 64; ++id) constants.push_back({id, pattern < 2 ? pattern : id % 2});
            const Decided decided = with_constants(shader.prepared, constants);
            EXPECT_TRUE(decided.all) << shader.name;
            for (const std::uint32_t spec : {48u, 49u, 50u, 51u, 52u}) EXPECT_EQ(count_of(decided.words, spec), 0) << shader.name;
            EXPECT_EQ(count_of(decided.words, kDecorate, kSpecId), 0) << shader.name;
            EXPECT_TRUE(rules.Validate(decided.words.data(), decided.words.size(), options)) << shader.name << ", " << pattern << ": " << said;
            before += shader.prepared.size();
            after += decided.words.size();
        }
    }
    EXPECT_LT(after, before * 3 / 4);
    for (const char* name : {"lighting.comp", "surface_resolve.comp", "transparent.frag", "resolve.comp"}) {
        const EmbeddedShader* shader = find_embedded_shader(name);
        ASSERT_NE(shader, nullptr) << name;
        std::vector<Specialization> constants;
        std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> values;
        for (std::uint32_t id = 0; id < 64; ++id) {
            constants.push_back({id, id % 3 == 0 ? 1u : 0u});
            values[id] = {constants.back().value};
        }
        spvtools::Optimizer passes(SPV_ENV_VULKAN_1_3), rest(SPV_ENV_VULKAN_1_3);
        passes.RegisterPass(spvtools::CreateSetSpecConstantDefaultValuePass(values))
            .RegisterPass(spvtools::CreateFreezeSpecConstantValuePass())
            .RegisterPass(spvtools::CreateFoldSpecConstantOpAndCompositePass());
        auto found = needed(with_constants(shader->prepared, constants).words, rest);
        for (const auto& [number, count] : needed(shader->prepared, passes)) EXPECT_EQ(found[number], count) << name << ": " << number;
    }
}

#endif

// What is no shader, or cut off, comes back as it was.
TEST_F(Specialize, WordsThatAreNoShaderAreLeftAlone)
{
    const std::span<const std::uint32_t> whole = find_embedded_shader("resolve.comp")->prepared;
    for (std::size_t length = 0; length < whole.size(); length += 1 + length / 7) {
        const Decided decided = with_constants(whole.first(length), {{0, 1}, {1, 0}});
        if (decided.all) continue;  // ended between two functions
        EXPECT_TRUE(std::ranges::equal(decided.words, whole.first(length))) << length;
    }
    std::vector<std::uint32_t> wild(whole.begin(), whole.end());
    for (std::size_t at = 5; at < wild.size(); at += 3) {
        const std::uint32_t kept = std::exchange(wild[at], wild[at] * 2654435761u);
        EXPECT_FALSE(with_constants(wild, {{0, 1}}).words.empty()) << at;
        wild[at] = kept;
    }
}

TEST_F(Specialize, NoShaderOfOursIsLeftToTheDriver)
{
    ASSERT_GT(embedded_shaders().size(), 50u);
    for (const EmbeddedShader& shader : embedded_shaders())
        EXPECT_FALSE(specialized(shader.code, {}, {}, shader.prepared).empty()) << shader.name;
}

TEST_F(Specialize, TheBuildPreparesShadersAsTheProgramWould)
{
    for (const EmbeddedShader& shader : embedded_shaders()) EXPECT_FALSE(shader.prepared.empty()) << shader.name;
    const EmbeddedShader* shader = find_embedded_shader("lighting.comp");
    ASSERT_NE(shader, nullptr);
    EXPECT_TRUE(std::ranges::equal(prepared(shader->code), shader->prepared));
    const std::vector<Specialization> constants{{1, 1}};
    EXPECT_EQ(specialized(shader->code, constants, {}, shader->prepared), specialized(shader->code, constants));
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

// Lanes hand each other every word of a frame's constants; a shader keeps those that it needs.
TEST_F(Specialize, WordsThatNothingNeedsAreDropped)
{
    constexpr std::uint32_t kShuffle = 345, kExtract = 203;
    const auto needed = [this](std::vector<Specialization> constants) {
        constants.push_back({FRAME_SPEC_LANES, 8});
        const auto words = cut_down(constants);
        EXPECT_EQ(count_of(words, kExtract), count_of(lighting, kExtract)) << "no driver sees the other form";
        return count_of(words, kShuffle);
    };
    std::vector<Specialization> off;
    for (std::uint32_t id = 0; id < 60; ++id) off.push_back({id, 0});
    const int few = needed(off);
    const int all = needed({});
    EXPECT_GT(few, 0);
    EXPECT_LT(few, FRAME_WORD_COUNT / 2);
    EXPECT_GT(all, few);
}

TEST_F(Specialize, ShufflesComeBackAsTheyWere)
{
    constexpr std::uint32_t kShuffle = 345;
    const auto droppable = with_droppable_shuffles(lighting);
    const int of_numbers = count_of(droppable, kShuffle);  // those that are no words stay
    EXPECT_GT(count_of(lighting, kShuffle), of_numbers);
    EXPECT_EQ(count_of(with_shuffles_again(droppable), kShuffle), count_of(lighting, kShuffle));
    EXPECT_EQ(with_droppable_shuffles(droppable), droppable) << "nothing is left to do";
    const auto plain = embedded_shader("glare_up.comp");
    EXPECT_TRUE(std::ranges::equal(with_droppable_shuffles(plain), plain));
}

TEST_F(Specialize, LargeFunctionsStayUntilConstantsAreKnown)
{
    const auto apart = [](std::span<const std::uint32_t> words) {
        int count = 0;
        for (std::size_t at = 5; at < words.size() && words[at] >> 16 > 0; at += words[at] >> 16)
            count += (words[at] & 0xffffu) == kFunction && (words[at + 3] & 2u) != 0 ? 1 : 0;
        return count;
    };
    const auto marked = with_large_apart(lighting);
    EXPECT_EQ(apart(lighting), 0);
    EXPECT_GT(apart(marked), 10);
    EXPECT_LT(apart(marked), count_of(lighting, kFunction));
    EXPECT_TRUE(std::ranges::equal(with_inlining(marked), lighting));
}

TEST_F(Specialize, WhatIsNoShaderStaysAsItIs)
{
    const std::vector<std::uint32_t> noise(100, 0xdeadbeefu);
    using Step = std::vector<std::uint32_t> (*)(std::span<const std::uint32_t>);
    for (const Step step : {by_value, with_droppable_shuffles, with_shuffles_again, with_large_apart, with_inlining}) {
        EXPECT_EQ(step(noise), noise);
        EXPECT_TRUE(step({}).empty());
        for (std::size_t size = 1; size < lighting.size(); size += lighting.size() / 97)
            EXPECT_GE(step(lighting.first(size)).size(), size);
    }
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
    const auto zero = cut_down({{1, 0}}, cache);
    const auto one = cut_down({{1, 1}}, cache);
    EXPECT_NE(zero, one);
    EXPECT_EQ(cut_down({{1, 0}}, cache), zero);
    EXPECT_EQ(cut_down({{1, 1}}, cache), one);
    EXPECT_EQ(cut_down({{1, 1}}), one);
    EXPECT_EQ(specialized(lighting, {{1, 0}}, cache), zero);
    EXPECT_GT(cache.size(), 0u);
    fs::remove_all(folder);
}

}  // namespace
}  // namespace petrichor::gpu
