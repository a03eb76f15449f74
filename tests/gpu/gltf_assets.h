// Real files for the tests of the loader: only there when PETRICHOR_ASSETS names their folder.
#ifndef PETRICHOR_TESTS_GPU_GLTF_ASSETS_H
#define PETRICHOR_TESTS_GPU_GLTF_ASSETS_H

#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "gpu/gltf.h"

namespace petrichor::gpu::testing_files {

inline std::vector<std::byte> to_bytes(const std::string& text)
{
    std::vector<std::byte> bytes(text.size());
    if (!text.empty()) std::memcpy(bytes.data(), text.data(), text.size());
    return bytes;
}

inline std::vector<std::byte> read_file(const std::filesystem::path& path)
{
    std::ifstream in(path, std::ios::binary);
    if (!in) throw Error("no file " + path.string(), "Put it there.");
    return to_bytes(std::string(std::istreambuf_iterator<char>(in), {}));
}

inline std::optional<std::filesystem::path> assets()
{
    const char* folder = std::getenv("PETRICHOR_ASSETS");
    if (!folder || !std::filesystem::is_directory(folder)) return std::nullopt;
    return folder;
}

inline Scene load_file(const std::filesystem::path& path)
{
    return load_gltf(read_file(path), path.filename().string(),
                     [&](const std::string& uri) { return read_file(path.parent_path() / uri); });
}

}  // namespace petrichor::gpu::testing_files

#endif
