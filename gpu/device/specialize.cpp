#include "gpu/device/specialize.h"

#ifdef PETRICHOR_SPIRV_TOOLS
#include <spirv-tools/optimizer.hpp>

#include <condition_variable>
#include <cstring>
#include <functional>
#include <mutex>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "base/error.h"
#include "base/hash.h"
#include "gpu/device/by_value.h"
#include "gpu/device/droppable.h"
#include "gpu/device/small_functions.h"
#endif

namespace petrichor::gpu {

#ifdef PETRICHOR_SPIRV_TOOLS

bool can_specialize()
{
    return true;
}

namespace {

constexpr const char* kCacheKind = "shaders";

// Steps that a shader is taken through.
class Passes {
public:
    Passes() : optimizer_(SPV_ENV_VULKAN_1_3)
    {
        optimizer_.SetMessageConsumer(
            [](spv_message_level_t, const char*, const spv_position_t&, const char*) {});
    }

    // What was done to a shader that is kept.
    void add_to(Hasher& hasher) const
    {
        for (const char* name : optimizer_.GetPassNames()) hasher.add(std::string(name));
    }

    // Empty for one that does not hold. Passes take for granted that it does; what passes made is not asked again.
    std::vector<std::uint32_t> run(std::span<const std::uint32_t> code, bool made_by_passes = false) const
    {
        spvtools::OptimizerOptions options;
        spvtools::ValidatorOptions rules;
        rules.SetScalarBlockLayout(true);
        options.set_validator_options(rules);
        options.set_run_validator(!made_by_passes);
        std::vector<std::uint32_t> words;
        if (!optimizer_.Run(code.data(), code.size(), &words, options)) return {};
        return words;
    }

protected:
    spvtools::Optimizer optimizer_;
};

// Variables of each function become values where no other function sees them (with by_value() that is most of
// them). It is the same for all constants, so it is done once: half of the time of what follows.
class Prepare : public Passes {
public:
    Prepare()
    {
        optimizer_.RegisterPass(spvtools::CreateInlineExhaustivePass())
            .RegisterPass(spvtools::CreateEliminateDeadFunctionsPass())
            .RegisterPass(spvtools::CreateLocalSingleBlockLoadStoreElimPass())
            .RegisterPass(spvtools::CreateLocalSingleStoreElimPass())
            .RegisterPass(spvtools::CreateScalarReplacementPass(0))
            .RegisterPass(spvtools::CreateLocalAccessChainConvertPass())
            .RegisterPass(spvtools::CreateLocalSingleBlockLoadStoreElimPass())
            .RegisterPass(spvtools::CreateSSARewritePass())
            .RegisterPass(spvtools::CreateCCPPass())
            .RegisterPass(spvtools::CreateAggressiveDCEPass());
    }
};

// Cuts a shader down to what these constants leave of it.
class CutDown : public Passes {
public:
    explicit CutDown(const std::vector<Specialization>& constants)
    {
        std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> values;
        for (const Specialization& constant : constants) values[constant.id] = {constant.value};
        optimizer_.RegisterPass(spvtools::CreateSetSpecConstantDefaultValuePass(values))
            .RegisterPass(spvtools::CreateFreezeSpecConstantValuePass())
            .RegisterPass(spvtools::CreateFoldSpecConstantOpAndCompositePass())
            .RegisterPass(spvtools::CreateDeadBranchElimPass())
            .RegisterPass(spvtools::CreateEliminateDeadFunctionsPass())
            .RegisterPass(spvtools::CreateAggressiveDCEPass());
        make_one_function();
        fold();
    }

private:
    // .. whose variables are values: lavapipe then takes a sixth of the time for it.
    void make_one_function()
    {
        optimizer_.RegisterPass(spvtools::CreateMergeReturnPass())
            .RegisterPass(spvtools::CreateInlineExhaustivePass())
            // Arguments that are constants decide branches: two fifths of the words are gone then.
            .RegisterPass(spvtools::CreateCCPPass())
            .RegisterPass(spvtools::CreateDeadBranchElimPass())
            .RegisterPass(spvtools::CreateEliminateDeadFunctionsPass())
            .RegisterPass(spvtools::CreatePrivateToLocalPass())
            .RegisterPass(spvtools::CreateScalarReplacementPass(0))
            .RegisterPass(spvtools::CreateLocalAccessChainConvertPass())
            .RegisterPass(spvtools::CreateLocalSingleBlockLoadStoreElimPass())
            .RegisterPass(spvtools::CreateLocalSingleStoreElimPass())
            .RegisterPass(spvtools::CreateAggressiveDCEPass())
            .RegisterPass(spvtools::CreateSSARewritePass())
            .RegisterPass(spvtools::CreateAggressiveDCEPass());
    }

    // What the constants and the inlined arguments decide.
    void fold()
    {
        optimizer_.RegisterPass(spvtools::CreateCCPPass())
            .RegisterPass(spvtools::CreateDeadBranchElimPass())
            .RegisterPass(spvtools::CreateSimplificationPass())
            .RegisterPass(spvtools::CreateVectorDCEPass())
            .RegisterPass(spvtools::CreateDeadInsertElimPass())
            .RegisterPass(spvtools::CreateBlockMergePass())
            .RegisterPass(spvtools::CreateAggressiveDCEPass());
    }
};

// Renderers side by side ask for the same shaders at the same time: who comes second waits for what the first keeps.
class OneAtATime {
public:
    explicit OneAtATime(std::string key) : key_(std::move(key))
    {
        std::unique_lock lock(mutex_);
        done_.wait(lock, [&] { return at_work_.count(key_) == 0; });
        at_work_.insert(key_);
    }
    ~OneAtATime()
    {
        {
            const std::lock_guard lock(mutex_);
            at_work_.erase(key_);
        }
        done_.notify_all();
    }
    OneAtATime(const OneAtATime&) = delete;
    OneAtATime& operator=(const OneAtATime&) = delete;

private:
    static inline std::mutex mutex_;
    static inline std::condition_variable done_;
    static inline std::unordered_set<std::string> at_work_;
    std::string key_;
};

}  // namespace

namespace {

// What these passes make of a shader, from the cache if it is there.
std::vector<std::uint32_t> made(const Passes& passes, std::span<const std::uint32_t> code, Hasher& hasher,
                                const ContentCache& cache,
                                const std::function<std::vector<std::uint32_t>()>& make)
{
    passes.add_to(hasher);
    hasher.add(spvSoftwareVersionString());
    hasher.add_bytes(std::as_bytes(code));
    const std::string key = hasher.text();
    const OneAtATime only(key);
    if (const auto kept = cache.find(kCacheKind, key); kept && kept->size() % 4 == 0) {
        std::vector<std::uint32_t> words(kept->size() / 4);
        std::memcpy(words.data(), kept->data(), kept->size());
        return words;
    }
    std::vector<std::uint32_t> words = make();
    try {
        if (!words.empty()) cache.keep(kCacheKind, key, {std::as_bytes(std::span(words))});
    } catch (const Error&) {  // costs the next start some milliseconds
    }
    return words;
}

std::vector<std::uint32_t> prepared(std::span<const std::uint32_t> code, const ContentCache& cache)
{
    const Prepare prepare;
    const auto make = [&] {
        return with_inlining(prepare.run(with_large_apart(with_droppable_shuffles(by_value(code)))));
    };
    if (!cache.on()) return make();
    Hasher hasher;
    hasher.add("prepared 3");
    return made(prepare, code, hasher, cache, make);
}

}  // namespace

std::vector<std::uint32_t> specialized(std::span<const std::uint32_t> code,
                                       const std::vector<Specialization>& constants,
                                       const ContentCache& cache)
{
    const CutDown cut_down(constants);
    const auto make = [&] {
        const std::vector<std::uint32_t> words = prepared(code, cache);
        return words.empty() ? words : with_shuffles_again(cut_down.run(words, true));
    };
    if (!cache.on()) return make();
    Hasher hasher;
    hasher.add("specialized 6");
    for (const Specialization& constant : constants) {
        hasher.add_bytes(std::as_bytes(std::span(&constant, 1)));
    }
    return made(cut_down, code, hasher, cache, make);
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
