#include "gpu/compiler/compiler.h"

#include "base/error.h"
#include "base/hash.h"
#include "base/limited_child.h"

namespace petrichor::gpu {

namespace {

constexpr std::uint32_t kMagic = 0x07230203;  // SPIR-V's first word
constexpr std::size_t kLargest = 16u << 20;   // bytes of a compiled shader
constexpr const char* kCacheKind = "own_shaders";

// The extensions of a shader must stand before its first statement, so the preamble goes behind
// them.
std::string with_preamble(const std::string& text, const std::string& preamble)
{
    const std::size_t at = text.find("#include");
    return text.substr(0, at) + preamble + text.substr(at);
}

std::string fingerprint(std::span<const std::byte> bytes)
{
    Hasher hasher;
    hasher.add("petrichor " PETRICHOR_VERSION " glslang " PETRICHOR_GLSLANG_VERSION);
    hasher.add_bytes(bytes);
    return hasher.text();
}

std::vector<std::uint32_t> words_of(std::span<const std::byte> bytes)
{
    std::vector<std::uint32_t> words(bytes.size() / 4);
    std::memcpy(words.data(), bytes.data(), words.size() * 4);
    const bool whole = bytes.size() % 4 == 0 && words.size() > 5 && words[0] == kMagic;
    return whole ? words : std::vector<std::uint32_t>{};
}

}  // namespace

std::vector<std::uint32_t> compile_shader(const std::string& main, const std::string& preamble,
                                          const std::vector<ShaderText>& own,
                                          const ContentCache& cache)
{
    std::vector<ShaderText> texts;
    for (const ShaderText& one : embedded_texts()) {
        if (one.name == main) {
            texts.insert(texts.begin(), {one.name, with_preamble(one.text, preamble), one.place});
        } else {
            texts.push_back(one);
        }
    }
    texts.insert(texts.end(), own.begin(), own.end());
    const std::vector<std::byte> packed = pack_texts(texts);
    const std::string key = fingerprint(packed);
    if (const auto kept = cache.find(kCacheKind, key)) {
        if (auto words = words_of(*kept); !words.empty()) return words;
    }
    HelperJob job;
    job.program = find_helper("petrichor-glsl", {PETRICHOR_GLSL_INSTALLED, PETRICHOR_GLSL_BUILT});
    job.name = "shader " + (own.empty() || own.back().place.empty() ? main : own.back().place);
    job.limits = {.memory_bytes = 1ull << 30, .cpu_seconds = 30};
    job.wall_seconds = 60.0;
    job.max_answer_bytes = kLargest;
    const std::vector<std::byte> answer = run_limited(job, packed);
    std::vector<std::uint32_t> words = words_of(answer);
    if (words.empty()) throw Error(job.name + ": the compiler gave no SPIR-V", "Report this.");
    try {
        cache.keep(kCacheKind, key, {answer});
    } catch (const Error&) {  // costs the next start a second, and is said for the scene's textures
    }
    return words;
}

}  // namespace petrichor::gpu
