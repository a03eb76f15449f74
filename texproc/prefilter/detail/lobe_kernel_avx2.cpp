#include "texproc/prefilter/detail/lobe_kernel.inc"

namespace petrichor::texproc::detail {

const LobeKernel kLobeKernelAvx2{place,       shade,      weigh, overlaps, elliptic_overlap,
                                 differences, reweighted, median};

}  // namespace petrichor::texproc::detail
