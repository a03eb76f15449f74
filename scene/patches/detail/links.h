// What is traced once the cells are there: links, connections, visibility.
#ifndef PETRICHOR_SCENE_PATCHES_DETAIL_LINKS_H
#define PETRICHOR_SCENE_PATCHES_DETAIL_LINKS_H

#include "scene/patches/patches.h"

namespace petrichor::scene {

struct LinkRay {
    Ray ray;
    RayHit hit;
    bool inside = false;  ///< it starts inside a body, whatever was drawn
};
/// Ray r of a patch's row: drawn again, up to three times, where it starts inside a body.
LinkRay trace_link(const Patches& patches, const Tracer& tracer, std::uint32_t patch, int r);

/// Where the light of a hit comes from; black where no patch is near.
std::uint32_t patch_of_hit(const Patches& patches, const Triangles& triangles, const Ray& ray, const RayHit& hit);

/// Fills links, sky_view and open.
void trace_links(Patches& patches, const Tracer& tracer, const PatchOptions& options);
/// Fills connected.
void connect(Patches& patches, const Tracer& tracer, const PatchOptions& options);
/// Fills visible.
void trace_visibility(Patches& patches, const Tracer& tracer, const PatchOptions& options);

}  // namespace petrichor::scene

#endif
