// Prints fingerprints of what rays find in scenes: `patch_bytes model.glb ...`. Holes of textures count as closed.
// For tests/same_bits/compare, which builds it by several compilers.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/hash.h"
#include "scene/gltf/gltf.h"
#include "scene/patches/patch_file.h"
#include "scene/patches/patches.h"
#include "scene/patches/tracer.h"
#include "scene/patches/triangles.h"

namespace {

std::vector<std::byte> read_bytes(const std::filesystem::path& file)
{
    std::ifstream in(file, std::ios::binary);
    const std::vector<char> text{std::istreambuf_iterator<char>(in), {}};
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

}  // namespace

int main(int count, char** arguments)
{
    using namespace petrichor;
    for (int i = 1; i < count; ++i) {
        const std::filesystem::path file = arguments[i];
        try {
            const scene::Scene scene = scene::load_gltf(
                read_bytes(file), file.filename().string(),
                [&](const std::string& name) { return read_bytes(file.parent_path() / name); });
            const scene::Triangles triangles(scene, {});
            const scene::Tracer tracer(triangles);
            const scene::Patches patches = scene::build_patches(tracer, {});
            Hasher hasher;
            hasher.add_bytes(scene::patches_to_bytes(patches));
            std::printf("%s %s %u\n", hasher.text().c_str(), file.filename().string().c_str(), patches.count);
        } catch (const Error& error) {
            std::fprintf(stderr, "%s: %s\n  %s\n", arguments[i], error.what(), error.fix().c_str());
            return 2;
        }
    }
    return 0;
}
