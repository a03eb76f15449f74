// Nodes of patches: the table that finds them by their keys, parents and children.
#ifndef PETRICHOR_SCENE_PATCHES_DETAIL_NODES_H
#define PETRICHOR_SCENE_PATCHES_DETAIL_NODES_H

#include "scene/patches/patches.h"

namespace petrichor::scene {

/// Fills table and children from keys and connections.
void index_nodes(Patches& patches);

/// Position, normal and area of interior nodes, from their children.
void average_interior(Patches& patches);

}  // namespace petrichor::scene

#endif
