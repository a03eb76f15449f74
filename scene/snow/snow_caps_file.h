#ifndef PETRICHOR_SCENE_SNOW_SNOW_CAPS_FILE_H
#define PETRICHOR_SCENE_SNOW_SNOW_CAPS_FILE_H

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scene/snow/snow_caps.h"

namespace petrichor::scene {

/// Caps as bytes of this machine: what is kept between runs. No shape of a frame is in them.
std::vector<std::byte> snow_caps_to_bytes(const SnowCaps& caps);

/// The same caps, bit for bit; nothing when the bytes are no such file, are cut short, or name what neither
/// they nor the scene have.
std::optional<SnowCaps> snow_caps_from_bytes(std::span<const std::byte> bytes, const Scene& scene);

/// Fingerprint of everything that build_snow_caps() reads but what is trodden down.
///
///   what_rays_see  of the triangles and holes that rays are traced against
std::string snow_caps_fingerprint(const std::string& what_rays_see, const Scene& scene,
                                  const SnowCapOptions& options);

}  // namespace petrichor::scene

#endif
