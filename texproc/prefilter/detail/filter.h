#ifndef PETRICHOR_TEXPROC_PREFILTER_DETAIL_FILTER_H
#define PETRICHOR_TEXPROC_PREFILTER_DETAIL_FILTER_H

#include <memory>

#include "texproc/prefilter/detail/overlap.h"
#include "texproc/prefilter/detail/picture_lobe.h"
#include "texproc/prefilter/detail/walk.h"
#include "texproc/prefilter/prefilter.h"
#include "texproc/prefilter/rules.h"

namespace petrichor::texproc::detail {

/// The lobe that a rule gives to a texel of a surface: rule, light and effort from the options,
/// which must outlive it. Pure: the same texel, the same lobe, on any thread. Throws Error for an unknown rule
/// and for options that the rule does not have.
class Filter {
public:
    Filter(const PrefilterOptions& options, const MapSurface& surface);
    bool needs_cells() const { return kind_ != RuleKind::Moments; }
    FittedLobe operator()(const MipTexel& texel) const;

private:
    FittedLobe from_moments(const Means& means) const;
    FittedLobe from_cells(const MipTexel& texel) const;

    const PrefilterOptions& options_;
    RuleKind kind_;
    OverlapOptions overlap_;
    std::shared_ptr<const PictureLobe> picture_;
};

/// Levels 1.. of every map that these options give, to be filled by store(); level 0 stays empty.
Prefiltered empty_chain(const std::vector<LevelSize>& sizes, const PrefilterOptions& options);

/// Writes a lobe into its texel, as the options say that maps are stored.
void store(const FittedLobe& lobe, const MipTexel& texel, const PrefilterOptions& options,
           Prefiltered& chain);

}  // namespace petrichor::texproc::detail

#endif
