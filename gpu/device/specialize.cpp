#include "gpu/device/specialize.h"

#ifdef PETRICHOR_SPIRV_TOOLS
#include <spirv-tools/optimizer.hpp>

#include <cstring>
#include <unordered_map>

#include "base/error.h"
#include "base/hash.h"
#endif

namespace petrichor::gpu {

#ifdef PETRICHOR_SPIRV_TOOLS

bool can_specialize()
{
    return true;
}

namespace {

constexpr const char* kCacheKind = "shaders";

std::vector<std::uint32_t> cut_down(std::span<const std::uint32_t> code,
                                    const std::vector<Specialization>& constants)
{
    std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> values;
    for (const Specialization& constant : constants) values[constant.id] = {constant.value};
    spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_3);
    optimizer.SetMessageConsumer(
        [](spv_message_level_t, const char*, const spv_position_t&, const char*) {});
    optimizer.RegisterPass(spvtools::CreateSetSpecConstantDefaultValuePass(values))
        .RegisterPass(spvtools::CreateFreezeSpecConstantValuePass())
        .RegisterPass(spvtools::CreateFoldSpecConstantOpAndCompositePass())
        .RegisterPass(spvtools::CreateDeadBranchElimPass())
        .RegisterPass(spvtools::CreateEliminateDeadFunctionsPass())
        .RegisterPass(spvtools::CreateAggressiveDCEPass());
    // One function whose variables are values: lavapipe then takes a sixth of the time for it.
    optimizer.RegisterPass(spvtools::CreateMergeReturnPass())
        .RegisterPass(spvtools::CreateInlineExhaustivePass())
        .RegisterPass(spvtools::CreateEliminateDeadFunctionsPass())
        .RegisterPass(spvtools::CreatePrivateToLocalPass())
        .RegisterPass(spvtools::CreateLocalSingleBlockLoadStoreElimPass())
        .RegisterPass(spvtools::CreateLocalSingleStoreElimPass())
        .RegisterPass(spvtools::CreateAggressiveDCEPass())
        .RegisterPass(spvtools::CreateScalarReplacementPass(0))
        .RegisterPass(spvtools::CreateLocalAccessChainConvertPass())
        .RegisterPass(spvtools::CreateLocalSingleBlockLoadStoreElimPass())
        .RegisterPass(spvtools::CreateLocalSingleStoreElimPass())
        .RegisterPass(spvtools::CreateAggressiveDCEPass())
        .RegisterPass(spvtools::CreateSSARewritePass())
        .RegisterPass(spvtools::CreateAggressiveDCEPass());
    // What the constants and the inlined arguments decide.
    optimizer.RegisterPass(spvtools::CreateCCPPass())
        .RegisterPass(spvtools::CreateDeadBranchElimPass())
        .RegisterPass(spvtools::CreateSimplificationPass())
        .RegisterPass(spvtools::CreateVectorDCEPass())
        .RegisterPass(spvtools::CreateDeadInsertElimPass())
        .RegisterPass(spvtools::CreateBlockMergePass())
        .RegisterPass(spvtools::CreateAggressiveDCEPass());
    spvtools::OptimizerOptions options;
    // Passes take for granted that it holds.
    spvtools::ValidatorOptions rules;
    rules.SetScalarBlockLayout(true);
    options.set_validator_options(rules);
    options.set_run_validator(true);
    std::vector<std::uint32_t> words;
    if (!optimizer.Run(code.data(), code.size(), &words, options)) return {};
    return words;
}

}  // namespace

std::vector<std::uint32_t> specialized(std::span<const std::uint32_t> code,
                                       const std::vector<Specialization>& constants,
                                       const ContentCache& cache)
{
    if (!cache.on()) return cut_down(code, constants);
    Hasher hasher;
    hasher.add("specialized 2");
    hasher.add(spvSoftwareVersionString());
    hasher.add_bytes(std::as_bytes(code));
    for (const Specialization& constant : constants) {
        hasher.add_bytes(std::as_bytes(std::span(&constant, 1)));
    }
    const std::string key = hasher.text();
    if (const auto kept = cache.find(kCacheKind, key); kept && kept->size() % 4 == 0) {
        std::vector<std::uint32_t> words(kept->size() / 4);
        std::memcpy(words.data(), kept->data(), kept->size());
        return words;
    }
    std::vector<std::uint32_t> words = cut_down(code, constants);
    try {
        if (!words.empty()) cache.keep(kCacheKind, key, {std::as_bytes(std::span(words))});
    } catch (const Error&) {  // costs the next start some milliseconds
    }
    return words;
}

#else

bool can_specialize()
{
    return false;
}

std::vector<std::uint32_t> specialized(std::span<const std::uint32_t>,
                                       const std::vector<Specialization>&, const ContentCache&)
{
    return {};
}

#endif

}  // namespace petrichor::gpu
