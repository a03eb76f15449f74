#ifndef PETRICHOR_TEXPROC_STUDY_SCORED_MAPS_H
#define PETRICHOR_TEXPROC_STUDY_SCORED_MAPS_H

#include <string>
#include <vector>

#include "base/image.h"
#include "texproc/image/raw_image.h"
#include "texproc/prefilter/prefilter.h"

namespace petrichor::texproc {

/// A normal map (three channels, +y up) and a roughness map (one channel, perceptual).
struct ScoredMaps {
    std::string name;
    RawImage normal, roughness;
};

/// The maps of a file pair as ScoredMaps, 16 bits, whatever layout the options name. Throws Error
/// when the maps do not fit.
ScoredMaps scored_maps(std::string name, const RawImage& normal, const RawImage& map,
                       const PrefilterOptions& options);

/// Materials on which rules of prefiltering fail, made from code, 16 bits, tileable, the same for
/// ever: glitter flakes in lacquer, brushed metal, a tile in two glosses, rough noise, a checker of
/// opposing slopes, a mirror with scratches. size: a power of two >= 64.
std::vector<ScoredMaps> hard_maps(int size);

/// A dry material after rain: the lowest `share` of the height map under still water, a film on the
/// rest. height: one channel of the size of the maps. Throws Error when the sizes differ.
ScoredMaps with_puddles(const ScoredMaps& dry, const Image& height, float share = 0.35f);

/// The maps rolled by (dx, dy) texels, which a tileable material does not notice.
RawImage rolled(const RawImage& image, int dx, int dy);

}  // namespace petrichor::texproc

#endif
