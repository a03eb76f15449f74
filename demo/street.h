#ifndef PETRICHOR_DEMO_STREET_H
#define PETRICHOR_DEMO_STREET_H

#include <cstdint>
#include <filesystem>

#include "scene/scene.h"

namespace petrichor::demo {

struct DemoOptions {
    std::uint32_t seed = 1;
    int texture_size = 1024;  ///< of every material; the cobbles get twice that
    int threads = 0;          ///< 0: all cores
};

/// A small old street, metres, +y up, seen along -z: cobbles with relief and hollows for puddles,
/// gutters, kerbs and pavements, a brick house with a metal awning over its pavement, a timbered
/// house, a garden wall with grass, a lamp, a gate at the far end.
///
/// Cameras "main" (eye level), "low" (by a puddle) and "top"; one point light "lamp"; no sun.
/// Masks are in Primitive::weather (g 1 where puddles may stand). Same options, same bytes.
///
///   throws   Error when texture_size is not in 16 .. 4096.
scene::Scene make_demo_street(const DemoOptions& options = {});

/// Writes the street as `folder`/street.glb, whole or not at all, and returns its path.
std::filesystem::path write_demo(const std::filesystem::path& folder,
                                 const DemoOptions& options = {});

}  // namespace petrichor::demo

#endif
