// What is traced once the cells are there: links, connections, visibility.
#ifndef PETRICHOR_SCENE_PATCHES_DETAIL_LINKS_H
#define PETRICHOR_SCENE_PATCHES_DETAIL_LINKS_H

#include "scene/patches/patches.h"

namespace petrichor::scene {

/// Fills links, sky_view and open.
void trace_links(Patches& patches, const Tracer& tracer, const PatchOptions& options);
/// Fills connected.
void connect(Patches& patches, const Tracer& tracer, const PatchOptions& options);
/// Fills visible.
void trace_visibility(Patches& patches, const Tracer& tracer, const PatchOptions& options);

}  // namespace petrichor::scene

#endif
