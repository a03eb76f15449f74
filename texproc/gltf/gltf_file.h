#ifndef PETRICHOR_TEXPROC_GLTF_GLTF_FILE_H
#define PETRICHOR_TEXPROC_GLTF_GLTF_FILE_H

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "texproc/gltf/json_text.h"

namespace petrichor::texproc {

/// A glTF scene as its file holds it, whatever it means: JSON, and the chunks of a .glb.
struct GltfFile {
    std::filesystem::path path;
    bool binary = false;  ///< .glb
    JsonText json;
    std::vector<std::byte> bin;  ///< the BIN chunk; empty: none
    struct Chunk {
        std::uint32_t type = 0;
        std::vector<std::byte> bytes;
    };
    std::vector<Chunk> others;  ///< chunks that only their makers know
};

/// Throws Error for a file that is missing, damaged, truncated or not glTF 2.
GltfFile read_gltf_file(const std::filesystem::path& path);

/// The file of a scene: a .glb with its chunks, or the text of a .gltf.
std::vector<std::byte> to_bytes(const GltfFile& file);

/// What a relative uri or a data: uri of the scene names. Throws Error when it leaves the folder of
/// the scene, is damaged, or is not there.
std::vector<std::byte> resource_bytes(const GltfFile& file, const std::string& uri);
/// The path that a uri names, relative to the scene; nothing for data: and for other protocols.
std::optional<std::filesystem::path> resource_path(const std::string& uri);
/// A path as a uri.
std::string to_uri(const std::filesystem::path& path);

/// The bytes of a buffer view that lies in the BIN chunk or in a file. Throws Error.
std::vector<std::byte> view_bytes(const GltfFile& file, std::size_t view);

/// Takes the bytes of buffer views out of the BIN chunk and moves what follows; all other bytes
/// stay, each at its old alignment of 16. The listed views are to be changed or reused after that.
void remove_from_bin(GltfFile& file, const std::vector<std::size_t>& views);
/// Puts bytes at the end of the BIN chunk; returns the new view, or changes view `reuse`.
std::size_t add_to_bin(GltfFile& file, std::span<const std::byte> bytes,
                       std::optional<std::size_t> reuse = {});

}  // namespace petrichor::texproc

#endif
