// Compiled for AVX-512 where the target is x86-64, as block_wide.cpp is for AVX2.
#include "weather/models/physical/detail/block_kernel.h"

namespace petrichor::weather::detail {

void advance_block_64(CellBlock& block, const PlaceBlock& place, const StepForcing* steps,
                      std::size_t count, const CellConstants& k, const StepConstants& s)
{
#if defined(__AVX512F__) && defined(__AVX512DQ__)
    advance_block<64>(block, place, steps, count, k, s);
#else
    advance_block_16(block, place, steps, count, k, s);
#endif
}

}  // namespace petrichor::weather::detail
