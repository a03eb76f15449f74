#include "gpu/device/specialize.h"

#ifdef PETRICHOR_SPIRV_TOOLS
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
#include "gpu/device/decided.h"
#include "gpu/device/droppable.h"
#include "gpu/device/prepared.h"
#include "gpu/device/spirv_passes.h"
#endif

namespace petrichor::gpu {

#ifdef PETRICHOR_SPIRV_TOOLS

bool can_specialize()
{
    return true;
}

namespace {

constexpr const char* kCacheKind = "shaders";

// Cuts a shader down to what these constants leave of it.
class CutDown : public Passes {
public:
    // .. of which with_constants() did all, or not.
    CutDown(const std::vector<Specialization>& constants, bool all_decided)
    {
        if (!all_decided) {
            std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> values;
            for (const Specialization& constant : constants) values[constant.id] = {constant.value};
            optimizer_.RegisterPass(spvtools::CreateSetSpecConstantDefaultValuePass(values))
                .RegisterPass(spvtools::CreateFreezeSpecConstantValuePass())
                .RegisterPass(spvtools::CreateFoldSpecConstantOpAndCompositePass())
                .RegisterPass(spvtools::CreateDeadBranchElimPass())
                .RegisterPass(spvtools::CreateEliminateDeadFunctionsPass())
                .RegisterPass(spvtools::CreateAggressiveDCEPass());
        }
        // What values decide goes before functions are copied into their callers: a third of the words that are copied.
        optimizer_.RegisterPass(spvtools::CreateCCPPass())
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

// What is made of a shader, from the cache if it is there.
std::vector<std::uint32_t> made(std::span<const std::uint32_t> code, Hasher& hasher, const ContentCache& cache,
                                const std::function<std::vector<std::uint32_t>()>& make)
{
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

// A text that the program is given is prepared for its first pipeline.
std::vector<std::uint32_t> prepared_or_kept(std::span<const std::uint32_t> code, const ContentCache& cache)
{
    if (!cache.on()) return prepared(code);
    Hasher hasher;
    hasher.add("prepared 4");
    return made(code, hasher, cache, [&] { return prepared(code); });
}

}  // namespace

std::vector<std::uint32_t> specialized(std::span<const std::uint32_t> code,
                                       const std::vector<Specialization>& constants,
                                       const ContentCache& cache,
                                       std::span<const std::uint32_t> prepared_before)
{
    const auto make = [&] {
        std::vector<std::uint32_t> own;
        if (prepared_before.empty()) own = prepared_or_kept(code, cache);
        const std::span<const std::uint32_t> words = prepared_before.empty() ? own : prepared_before;
        if (words.empty()) return own;
        const Decided decided = with_constants(words, constants);
        return with_shuffles_again(CutDown(constants, decided.all).run(decided.words, true));
    };
    if (!cache.on()) return make();
    Hasher hasher;
    hasher.add("specialized 7");
    for (const Specialization& constant : constants) {
        hasher.add_bytes(std::as_bytes(std::span(&constant, 1)));
    }
    for (const char* name : CutDown(constants, false).names()) hasher.add(std::string(name));
    return made(code, hasher, cache, make);
}

#else

bool can_specialize()
{
    return false;
}

std::vector<std::uint32_t> specialized(std::span<const std::uint32_t>,
                                       const std::vector<Specialization>&, const ContentCache&,
                                       std::span<const std::uint32_t>)
{
    return {};
}

#endif

}  // namespace petrichor::gpu
