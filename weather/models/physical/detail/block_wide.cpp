// Compiled for AVX2 where the target is x86-64 (see CMakeLists.txt); called only where the machine
// has it. Nothing but the kernel templates, whose types carry the register width, may be used here.
#include "weather/models/physical/detail/block_kernel.h"
#include "weather/physics/detail/single.h"

namespace petrichor::weather::detail {

#if defined(__AVX2__)
void advance_block_32(CellBlock& block, const PlaceBlock& place, const StepForcing* steps,
                      std::size_t count, const CellConstants& k, const StepConstants& s)
{
    advance_block<32>(block, place, steps, count, k, s);
}
void advance_cell_wide(CellState& cell, const CellPlace<double>& place, const StepForcing* steps,
                       std::size_t count, const CellConstants& k, const StepConstants& s)
{
    CellVars<Single> c;
    CellPlace<Single> here;
    static_assert(sizeof c == sizeof cell && sizeof here == sizeof place);
    std::memcpy(static_cast<void*>(&c), &cell, sizeof c);
    std::memcpy(static_cast<void*>(&here), &place, sizeof here);
    advance_steps(c, steps, count, here, k, s);
    std::memcpy(&cell, static_cast<const void*>(&c), sizeof c);
}
#else
void advance_cell_wide(CellState& cell, const CellPlace<double>& place, const StepForcing* steps,
                       std::size_t count, const CellConstants& k, const StepConstants& s)
{
    advance_cell_plain(cell, place, steps, count, k, s);
}
void advance_block_32(CellBlock& block, const PlaceBlock& place, const StepForcing* steps,
                      std::size_t count, const CellConstants& k, const StepConstants& s)
{
    advance_block_16(block, place, steps, count, k, s);
}
#endif

}  // namespace petrichor::weather::detail
