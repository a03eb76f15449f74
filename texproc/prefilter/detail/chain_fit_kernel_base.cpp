#include "texproc/prefilter/detail/chain_fit_kernel.inc"

namespace petrichor::texproc::detail {

const ChainFitKernel kChainFitKernelBase{mean_light, seen, add_slopes, move};

const ChainFitKernel& chain_fit_kernel()
{
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2")) return kChainFitKernelAvx2;
#endif
    return kChainFitKernelBase;
}

}  // namespace petrichor::texproc::detail
