// libFuzzer target for scenes: glTF text and GLB. Files that a scene names are a few bytes.
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/error.h"
#include "scene/gltf/gltf.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    try {
        petrichor::scene::load_gltf(
            std::span(reinterpret_cast<const std::byte*>(data), size), "fuzz.gltf",
            [](const std::string&) { return std::vector<std::byte>(96, std::byte{1}); });
    } catch (const petrichor::Error&) {
    }
    return 0;
}
