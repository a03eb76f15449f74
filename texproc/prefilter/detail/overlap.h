#ifndef PETRICHOR_TEXPROC_PREFILTER_DETAIL_OVERLAP_H
#define PETRICHOR_TEXPROC_PREFILTER_DETAIL_OVERLAP_H

#include <cstdint>
#include <optional>

#include "texproc/prefilter/detail/cells.h"
#include "texproc/prefilter/detail/codes.h"
#include "texproc/prefilter/detail/lobe_tools.h"

namespace petrichor::texproc {

struct OverlapOptions {
    float light = 0.0f;         ///< alpha of the design light: 0 the sun, 0.1 a window
    bool joint = true;          ///< may re-aim the normal; else roughness only
    bool anisotropic = false;   ///< also fits an elliptic lobe
    bool quick = false;         ///< fewer samples and no search on the finest levels
    detail::StoredAs stored{};  ///< 8 bits: also chooses the codes of the file
};

/// One lobe for a footprint.
struct FittedLobe {
    detail::Direction normal;
    float alpha2 = 0.0f;
    // Elliptic only: roughness along the tangent and across it.
    bool elliptic = false;
    detail::Direction tangent{1.0f, 0.0f, 0.0f};
    float alpha2_x = 0.0f, alpha2_y = 0.0f;
    /// The codes to store, where rounding would cost light.
    std::optional<detail::Codes> codes{};
};

/// The lobe that shares most light with a footprint (docs/textures.md, 4), never dearer than the
/// plain mip on an independent set of samples.
///
///   cells    the footprint, alpha^2 without the light
///   means    its exact means
///   level    1.., which decides the number of samples
///   seed     a hash of level and texel: the same seed, the same lobe, on any thread
FittedLobe fit_overlap(const detail::Cells& cells, const detail::Means& means, int level,
                       std::uint32_t seed, const OverlapOptions& options);

}  // namespace petrichor::texproc

#endif
