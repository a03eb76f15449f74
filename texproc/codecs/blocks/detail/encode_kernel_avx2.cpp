#include "texproc/codecs/blocks/detail/encode_kernel.inc"

namespace petrichor::texproc::detail {

const EncodeKernel kEncodeKernelAvx2{encode_bc1, encode_bc4, encode_bc7, encode_uastc};

}  // namespace petrichor::texproc::detail
