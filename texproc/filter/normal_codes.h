#ifndef PETRICHOR_TEXPROC_FILTER_NORMAL_CODES_H
#define PETRICHOR_TEXPROC_FILTER_NORMAL_CODES_H

#include "texproc/image/raw_image.h"

namespace petrichor::texproc {

/// Normals as a file of 8 bits holds them, whose levels are made of these codes.
///
/// Of 8 bits no code is straight up: 127 and 128 lean by 0.0039 to either side. Texels about straight up
/// that become the nearer of the two have a mean that no code is, and no level can hold it. So x and y are
/// rounded half a code up where the flat of a map lies between codes: it becomes 128, which flat is
/// written as everywhere, its neighbours lean as it does, by 0.2 degrees, and so does their mean. Where
/// the flat is a code already (16 bits made of 8), the nearest codes are taken.
///
///   x, y   channels that hold them, 0.5 + 0.5 n; other channels become the nearest codes
///
/// U8 stays as it is, and so do codes of 8 bits that more bits hold (k / 255). Same bytes at any time.
RawImage normals_in_8_bits(RawImage normals, int x = 0, int y = 1);

}  // namespace petrichor::texproc

#endif
