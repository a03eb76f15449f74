#ifndef PETRICHOR_TEXPROC_CODECS_DECODER_TIFF_H
#define PETRICHOR_TEXPROC_CODECS_DECODER_TIFF_H

#include <cstddef>
#include <span>

namespace petrichor::texproc::decoder {

/// Checks that the strips or tiles of the first image of a TIFF inflate to what was deflated; the
/// image library says nothing of those that do not, and leaves noise. Other compressions have no
/// checksum, and BigTIFF is let through. Throws std::runtime_error that names the strip.
void check_tiff(std::span<const std::byte> file);

}  // namespace petrichor::texproc::decoder

#endif
