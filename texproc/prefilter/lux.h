#ifndef PETRICHOR_TEXPROC_PREFILTER_LUX_H
#define PETRICHOR_TEXPROC_PREFILTER_LUX_H

#include <cstdint>
#include <vector>

namespace petrichor::texproc {

/// The smoothness that Lux 2.02 stores (before quantisation) for a mip texel of smoothness g whose
/// mean normal has the length l. Kept with its faults: 1/k is added to the square of the perceptual
/// roughness, and k jumps to 10000 at l = 1.
float lux_smoothness(float g, float l);

/// The smoothness mips of Lux 2.02, code for code: levels 1 and up, truncated to 8 bits.
///
///   normal_x, normal_y  size * size codes of level 0
///   mips                smoothness codes of levels 1.. as the engine averaged them
///   size                a power of two: other maps are where Lux reads the wrong texels
///   throws              Error for a size that is not a power of two or mips that do not fit
std::vector<std::vector<std::uint8_t>> lux_smoothness_mips(
    const std::vector<std::uint8_t>& normal_x, const std::vector<std::uint8_t>& normal_y,
    const std::vector<std::vector<std::uint8_t>>& mips, int size);

}  // namespace petrichor::texproc

#endif
