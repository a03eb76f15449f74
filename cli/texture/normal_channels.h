#ifndef PETRICHOR_CLI_TEXTURE_NORMAL_CHANNELS_H
#define PETRICHOR_CLI_TEXTURE_NORMAL_CHANNELS_H

#include "texproc/prefilter/prefilter.h"

namespace petrichor::cli {

/// Normals (three channels) as a file of so many channels holds them: x and y where the options
/// say, z in the third where there is one, 1 elsewhere.
Image lay_out_normals(const Image& normals, const texproc::PrefilterOptions& options, int channels);

/// The same back: x y z of any layout, z rebuilt where the options say so or the level holds x and
/// y only. Throws Error that names the level when channels are missing.
Image read_out_normals(const Image& level, const texproc::PrefilterOptions& options, int number);

}  // namespace petrichor::cli

#endif
