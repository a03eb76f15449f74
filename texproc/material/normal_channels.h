#ifndef PETRICHOR_TEXPROC_MATERIAL_NORMAL_CHANNELS_H
#define PETRICHOR_TEXPROC_MATERIAL_NORMAL_CHANNELS_H

#include <string>

#include "texproc/prefilter/prefilter.h"

namespace petrichor::texproc {

/// Normals (three channels) as a file of so many channels holds them: x and y where the options
/// say, z in the third where there is one, 1 elsewhere.
Image lay_out_normals(Image normals, const PrefilterOptions& options, int channels);

/// The same back: x y z of any layout, z rebuilt where the options say so or the level holds x and
/// y only. Throws Error that names the level when channels are missing.
Image read_out_normals(const Image& level, const PrefilterOptions& options, int number);

/// A normal map whose readers will make z from x and y, so that texels of another length, which
/// many maps have (JPEG, filters), would come back pointing elsewhere: of unit length, in `type`.
/// Texels that are of unit length keep their numbers.
RawImage unit_normals(const RawImage& normal, PixelType type);

/// Lengths so far from 1 are unit length, rounded to 8 bits.
inline constexpr float kUnitRounding = 0.01f;

/// True for texture formats that hold x and y only: bc5, rg8, ...
bool drops_z(const std::string& format);

}  // namespace petrichor::texproc

#endif
