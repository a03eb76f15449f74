// Of the build alone: petrichor-embed-shader SYMBOL IN.spv OUT.h writes a shader, and what prepared() makes of it, as C++.
#include <cinttypes>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>
#include <string>
#include <vector>

#include "gpu/device/prepared.h"

namespace {

bool read_words(const char* path, std::vector<std::uint32_t>& words)
{
    std::error_code failed;
    const std::uintmax_t bytes = std::filesystem::file_size(path, failed);
    if (failed || bytes == 0 || bytes % 4 != 0) return false;
    words.resize(static_cast<std::size_t>(bytes / 4));
    std::ifstream in(path, std::ios::binary);
    return bool(in.read(reinterpret_cast<char*>(words.data()), static_cast<std::streamsize>(bytes)));
}

std::string array_of(const std::string& name, std::span<const std::uint32_t> words)
{
    if (words.empty()) return "constexpr std::span<const std::uint32_t> " + name + ";\n";
    std::string text = "constexpr std::uint32_t " + name + "[] = {";
    char word[16];
    for (std::size_t i = 0; i < words.size(); ++i) {
        std::snprintf(word, sizeof word, "%s0x%" PRIx32 ",", i % 16 == 0 ? "\n" : "", words[i]);
        text += word;
    }
    return text + "};\n";
}

}  // namespace

int main(int count, char** arguments)
{
    std::vector<std::uint32_t> words;
    if (count != 4 || !read_words(arguments[2], words)) {
        std::fprintf(stderr, "petrichor-embed-shader SYMBOL IN.spv OUT.h\n");
        return 2;
    }
    const std::string symbol = arguments[1];
    std::ofstream out(arguments[3], std::ios::binary);
    out << array_of(symbol, words) << array_of(symbol + "_prepared", petrichor::gpu::prepared(words));
    out.flush();
    if (!out) std::fprintf(stderr, "petrichor-embed-shader: cannot write %s\n", arguments[3]);
    return out ? 0 : 1;
}
