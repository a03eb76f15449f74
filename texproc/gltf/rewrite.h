#ifndef PETRICHOR_TEXPROC_GLTF_REWRITE_H
#define PETRICHOR_TEXPROC_GLTF_REWRITE_H

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "texproc/gltf/image_levels.h"

namespace petrichor::texproc {

struct GltfBuildOptions {
    ImageMakingOptions images;
    bool fallback = false;  ///< the old images stay beside the new ones, for readers without KTX2
    bool score = true;      ///< measure pictures of each pair of normals and roughness
    int zstd = 10;          ///< 0..22
    StopRequest stop = {};  ///< asked between images; ends with Interrupted
};

struct GltfBuildReport {
    struct MadeImage {
        std::string name;  ///< "image 3 (wall_normal)"
        ImageMeaning meaning = ImageMeaning::Data;
        int width = 0, height = 0, levels = 0;
        std::uint64_t bytes_before = 0, bytes = 0;
        bool resampled = false;
    };
    struct MadeMaterial {
        std::string name;
        PictureError picture;
        int lobes = 1;  ///< 2: as who knows kTwoLobes sees it
    };
    std::vector<MadeImage> images;
    std::vector<MadeMaterial> materials;  ///< whose normals and roughness were filtered together
    std::vector<std::string> notes;       ///< what was left as it was
    std::vector<std::filesystem::path> files;
};

/// Writes a scene again with the textures of its materials as KTX2 in UASTC with all their levels
/// (KHR_texture_basisu), prefiltered by the rule; everything else byte for byte: meshes,
/// animations, unknown extensions, Draco and meshopt data. With PrefilterChoice::lobes 2 (the rule picture
/// in full) materials get the textures of two lobes beside their own, as kTwoLobes, where their pictures are
/// better with them. A .glb gives a .glb, a .gltf a .gltf
/// with its images and its other files beside. Same bytes at any thread count.
///
///   throws  Error for a scene or an image that cannot be read, another extension than the input's,
///           and an output that is the input
GltfBuildReport build_gltf(const std::filesystem::path& input, const std::filesystem::path& output,
                           const GltfBuildOptions& options = {});

/// True for the names of scenes: .glb and .gltf.
bool is_gltf_name(const std::filesystem::path& path);

}  // namespace petrichor::texproc

#endif
