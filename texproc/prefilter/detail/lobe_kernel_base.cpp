#include "texproc/prefilter/detail/lobe_kernel.inc"

namespace petrichor::texproc::detail {

const LobeKernel kLobeKernelBase{place,       shade,      weigh, overlaps, elliptic_overlap,
                                 differences, reweighted, median};

const LobeKernel& lobe_kernel()
{
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2")) return kLobeKernelAvx2;
#endif
    return kLobeKernelBase;
}

}  // namespace petrichor::texproc::detail
