#include "texproc/prefilter/detail/chain_fit_kernel.inc"

namespace petrichor::texproc::detail {

const ChainFitKernel kChainFitKernelAvx2{mean_light, seen, add_slopes, move};

}  // namespace petrichor::texproc::detail
