#ifndef PETRICHOR_TEXPROC_IMAGE_ZERO_ROWS_H
#define PETRICHOR_TEXPROC_IMAGE_ZERO_ROWS_H

#include <string>

#include "texproc/image/raw_image.h"

namespace petrichor::texproc {

/// Tells rows that hold nothing but zeros: "it is zero all over", "rows 96 to 127 of 128 are zero",
/// "rows 0 to 15 of 128 are zero". A file that was cut and filled up decodes so where its format
/// has no checksum. Empty: fewer than a sixteenth of the rows at either end. Alpha is not looked
/// at.
std::string zero_rows(const RawImage& image);

}  // namespace petrichor::texproc

#endif
