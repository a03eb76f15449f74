#include "texproc/prefilter/detail/lobe_kernel.inc"

namespace petrichor::texproc::detail {

// Degrees of the yardstick as unit vectors, rounded once here so that every build agrees.
const float kViewDirections[kViews][3] = {
    {0.0f, 0.0f, 1.0f},
    {0.66446302f, 0.24184476f, 0.70710678f},
    {-0.24184476f, 0.66446302f, 0.70710678f},
    {0.39713126f, 0.85165074f, 0.34202014f},
    {-0.85165074f, 0.39713126f, 0.34202014f},
};

const LobeKernel kLobeKernelBase{place,       shade,      weigh, overlaps, elliptic_overlap,
                                 differences, reweighted, inside};

const LobeKernel& lobe_kernel()
{
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2")) return kLobeKernelAvx2;
#endif
    return kLobeKernelBase;
}

}  // namespace petrichor::texproc::detail
