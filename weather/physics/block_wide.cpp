// Compiled for AVX2 where the target is x86-64 (see CMakeLists.txt); called only where the machine
// has it. Nothing but the kernel templates, whose types carry the register width, may be used here.
#include "weather/physics/detail/block_kernel.h"

namespace petrichor::weather::detail {

#if defined(__AVX2__)
void advance_block_32(CellBlock& block, const PlaceBlock& place, const StepForcing* steps,
                      std::size_t count, const CellConstants& k, const StepConstants& s)
{
    advance_block<32>(block, place, steps, count, k, s);
}
#else
void advance_block_32(CellBlock& block, const PlaceBlock& place, const StepForcing* steps,
                      std::size_t count, const CellConstants& k, const StepConstants& s)
{
    advance_block_16(block, place, steps, count, k, s);
}
#endif

}  // namespace petrichor::weather::detail
