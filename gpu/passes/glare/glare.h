#ifndef PETRICHOR_GPU_PASSES_GLARE_GLARE_H
#define PETRICHOR_GPU_PASSES_GLARE_GLARE_H

#include "gpu/frame/targets.h"

namespace petrichor::gpu {

// Light that a lens scatters around its image: each level of a pyramid is twice as wide and gets
// three quarters of what the finer one leaves, so that it falls off about as the inverse 2.4th
// power of the distance. Every kernel sums to one: what is blurred is neither more nor less than
// the picture. The resolve mixes it in.
//
//   reads    accumulated
//   writes   glare (all levels; the first is the answer, half the picture's size)
void add_glare(FrameGraph& graph, FrameTargets& targets, int samples);

}  // namespace petrichor::gpu

#endif
