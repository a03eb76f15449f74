#ifndef PETRICHOR_TEXPROC_FILTER_MIPS_H
#define PETRICHOR_TEXPROC_FILTER_MIPS_H

#include <vector>

#include "base/image.h"

namespace petrichor::texproc {

enum class MipFilter {
    Box,       ///< exact area of level 0; the only one without ringing or overlap
    Kaiser,    ///< sinc in a Kaiser window (alpha 4) of 3 texels: sharp
    Lanczos3,  ///< sinc in a sinc window of 3 texels: sharpest
    Mitchell,  ///< cubic of Mitchell and Netravali (1/3, 1/3): soft, hardly rings
};

/// What lies past an edge.
enum class Edge { Wrap, Clamp, Mirror };

/// The texel that stands at i, inside or past an edge (mirrored: the edge texel twice).
constexpr int edge_index(int i, int size, Edge edge)
{
    if (i >= 0 && i < size) return i;
    if (edge == Edge::Clamp) return i < 0 ? 0 : size - 1;
    if (edge == Edge::Wrap) return (i % size + size) % size;
    const int at = (i % (2 * size) + 2 * size) % (2 * size);
    return at < size ? at : 2 * size - 1 - at;
}

struct MipOptions {
    bool wrap_u = true;  ///< false: clamp
    bool wrap_v = true;
    float alpha_cutoff = -1.0f;  ///< >= 0: keep the coverage of alpha > cutoff in every level
    bool normals = false;        ///< channels 0..2 hold 0.5 + 0.5 n: renormalise each level
    MipFilter filter = MipFilter::Box;
    bool mirror_u = false;  ///< instead of wrap or clamp
    bool mirror_v = false;
    bool keep_length = false;  ///< normals: leave them shorter where they differ
    /// Colour (space Linear) with alpha counts by its alpha, which means coverage: no fringes of
    /// what lies under holes. An opaque image gives the same bits either way. Data: no effect.
    bool alpha_weighted = false;
    bool drop_first = false;  ///< level 0 of the result is left empty: a large image is not kept
    int threads = 0;          ///< 0: all cores; the bytes do not depend on it
};

/// Level 0 is the input; each next level is floor(half), at least 1, down to 1 x 1. Box: a texel is
/// the mean over its exact area of level 0 (fractional edge weights for odd sizes). The others
/// filter the level before. Colour is filtered as it is: linear light. Rolling a tileable image by
/// the texels of a level rolls that level, bit for bit.
std::vector<Image> mip_chain(Image image, const MipOptions& options = {});

/// One filtered reduction. Throws Error when the target is empty or larger than the image.
Image resampled(const Image& image, int width, int height, MipFilter filter, Edge edge_u,
                Edge edge_v, int threads = 0);

}  // namespace petrichor::texproc

#endif
