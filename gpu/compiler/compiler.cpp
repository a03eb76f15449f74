#include "gpu/compiler/compiler.h"

#include <cstdlib>

#include "base/error.h"
#include "base/hash.h"
#include "base/input_file.h"
#include "base/limited_child.h"
#include "base/output_file.h"

namespace petrichor::gpu {

namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kMagic = 0x07230203;  // SPIR-V's first word
constexpr std::size_t kLargest = 16u << 20;   // bytes of a compiled shader

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

// A file of the cache: the SPIR-V, then its fingerprint, so that a torn file is made again.
std::vector<std::uint32_t> cached(const fs::path& file)
{
    std::error_code none;
    if (!fs::is_regular_file(file, none)) return {};
    try {
        const std::string bytes = read_file(file, "cache", kLargest);
        if (bytes.size() <= 32) return {};
        const auto content = std::as_bytes(std::span(bytes)).first(bytes.size() - 32);
        return fingerprint(content) == bytes.substr(bytes.size() - 32)
                   ? words_of(content)
                   : std::vector<std::uint32_t>{};
    } catch (const Error&) {
        return {};
    }
}

// A cache that cannot be written is no reason to stop: it costs the next start a second.
void keep(const fs::path& file, std::span<const std::byte> content)
{
    try {
        OutputFile output(file);
        output.write({reinterpret_cast<const char*>(content.data()), content.size()});
        output.write(fingerprint(content));
        output.commit();
    } catch (const Error&) {
    }
}

}  // namespace

fs::path default_cache_folder()
{
    const auto folder = [](const char* name) {
        const char* value = std::getenv(name);
        return fs::path(value ? value : "");
    };
    if (const fs::path own = folder("PETRICHOR_CACHE"); !own.empty()) return own;
    if (const fs::path user = folder("XDG_CACHE_HOME"); user.is_absolute()) {
        return user / "petrichor";
    }
    if (const fs::path home = folder("HOME"); home.is_absolute()) {
        return home / ".cache" / "petrichor";
    }
    return {};
}

std::vector<std::uint32_t> compile_shader(const std::string& main, const std::string& preamble,
                                          const std::vector<ShaderText>& own,
                                          const fs::path& cache_folder)
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
    const fs::path file = cache_folder.empty()
                              ? fs::path()
                              : cache_folder / "shaders" / (fingerprint(packed) + ".spv");
    if (!file.empty()) {
        if (auto words = cached(file); !words.empty()) return words;
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
    if (!file.empty()) keep(file, answer);
    return words;
}

}  // namespace petrichor::gpu
