#ifndef PETRICHOR_SCENE_PATCHES_PATCH_FILE_H
#define PETRICHOR_SCENE_PATCHES_PATCH_FILE_H

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "scene/patches/patches.h"

namespace petrichor::scene {

/// Patches as bytes, little-endian: what is kept between runs. What can be made again from the rest
/// (table, children) is left out.
std::vector<std::byte> patches_to_bytes(const Patches& patches);

/// The same patches, bit for bit.
///
///   triangles  how many the scene has; samples point at them
///   throws     Error when the bytes are not such a file, of another version, cut short or damaged
///              (a checksum over everything), or when a number in it points nowhere.
Patches patches_from_bytes(std::span<const std::byte> bytes, std::uint32_t triangles);

/// Fingerprint of everything that decides the patches of a scene: what rays see, options and the
/// version of the code that cuts and traces. Albedo, lights and weather are not in it.
std::string patches_fingerprint(const std::string& what_rays_see, const PatchOptions& options);

}  // namespace petrichor::scene

#endif
