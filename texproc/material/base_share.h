#ifndef PETRICHOR_TEXPROC_MATERIAL_BASE_SHARE_H
#define PETRICHOR_TEXPROC_MATERIAL_BASE_SHARE_H

#include <vector>

#include "base/image.h"

namespace petrichor::texproc {

// Base colour for small levels (docs/textures.md, 8): a mean normal of unit length reflects more
// diffuse light than the slopes that it stands for, by one over the length that it lost. That
// length goes into the base colour, where no engine needs to know of it.

/// Lengths of the mean normals of a normal map, 0..1: one channel, level 0 (all 1) to 1 x 1.
///   normals  3 channels, 0.5 + 0.5 n; z follows from x and y
std::vector<Image> base_shares(const Image& normals, int threads = 0);

/// The same of pixels, which blend texels and lose length once more (filter/pixel_length.h): what the rule
/// picture darkens by.
std::vector<Image> pixel_base_shares(const Image& normals, int threads = 0);

/// Multiplies red, green and blue of the levels of a base colour by the shares. Metal, whose colour is
/// that of its highlight, has shares of its own, and keeps its colour without them.
///   color     3 or 4 channels, level 0 first, which stays
///   shares    level 0 may be empty; sizes need not be those of the colour
///   metallic  1 channel a level, sizes of the colour; empty: no metal
///   of_metal  as shares; empty: all 1
void apply_base_shares(std::vector<Image>& color, const std::vector<Image>& shares,
                       const std::vector<Image>& metallic,
                       const std::vector<Image>& of_metal = {});

}  // namespace petrichor::texproc

#endif
