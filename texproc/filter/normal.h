#ifndef PETRICHOR_TEXPROC_FILTER_NORMAL_H
#define PETRICHOR_TEXPROC_FILTER_NORMAL_H

#include <string>

#include "base/image.h"
#include "texproc/filter/mips.h"

namespace petrichor::texproc {

// Normal maps here: 3 channels, 0.5 + 0.5 n, +y up (green up), unless said otherwise. v runs down
// the image. A green-down map is turned by flip_green, which is its own inverse.

void flip_green(Image& normal);

/// Every texel to unit length; a zero vector becomes straight up. Lengths within `tolerance` of 1
/// stay: rounding to 8 bits alone moves them by up to 0.007.
void renormalize(Image& normal, float tolerance = 0.0f);

/// How two-channel layouts store x and y. Unpacking rebuilds z.
enum class NormalLayout {
    Rgb,       ///< x y z
    Rg,        ///< x y, third channel 0 (also BC5)
    Ag,        ///< R 1, G y, B 1, A x
    Rxgb,      ///< R 0, G y, B z, A x
    RgSigned,  ///< x y as they are, -1..1: floats, and signed BC5
};
Image to_layout(const Image& normal, NormalLayout layout);
/// Throws Error when the image has too few channels.
Image from_layout(const Image& image, NormalLayout layout);
NormalLayout normal_layout(const std::string& name);  ///< "rgb", "rg", "ag", "rxgb", "rg-signed"

/// Which way green points, and how sure that is (0 guess .. 1 certain).
struct GreenDirection {
    bool down = false;
    double confidence = 0.0;
};
/// From a height map of the same surface: the slopes must correlate with its gradient.
GreenDirection detect_green(const Image& normal, const Image& height);
/// From the map alone: the slopes of a surface have no curl, those of a flipped map do.
GreenDirection detect_green(const Image& normal);

struct HeightScale {
    float depth = 0.05f;  ///< height 1 in units of the width of the map
    Edge edge_u = Edge::Wrap, edge_v = Edge::Wrap;
};
/// Normals of a height map (first channel), central differences.
Image normal_from_height(const Image& height, const HeightScale& scale = {});
/// The height (0..1) whose slopes fit best in the mean square, and the depth that makes
/// normal_from_height give the slopes back. An axis that wraps gives a height that tiles; one that
/// mirrors or clamps, a height that goes on mirrored, so that opposite edges are free to differ.
struct IntegratedHeight {
    Image height;
    float depth = 0.0f;
};
IntegratedHeight height_from_normal(const Image& normal, Edge edge_u = Edge::Wrap,
                                    Edge edge_v = Edge::Wrap);

/// Adds the bumps of `detail` to `base`, turned into its frame (Barre-Brisebois and Hill 2012,
/// reoriented normal mapping). Same size; Throws Error when not.
Image blend_normals(const Image& base, const Image& detail);

}  // namespace petrichor::texproc

#endif
