#ifndef PETRICHOR_TEXPROC_CODECS_FILES_DETAIL_SNIFF_H
#define PETRICHOR_TEXPROC_CODECS_FILES_DETAIL_SNIFF_H

#include <cstddef>
#include <span>
#include <string>

namespace petrichor::texproc::detail {

/// The image format of a file from its first bytes: "png", "jpeg", "webp", "bmp", "tiff",
/// "openexr", "hdr", "psd", "dds", "ktx2", "pnm", "gif", "sgi"; "targa" (which has no signature)
/// when the name says so or the header is plausible; "" when nothing fits.
std::string sniff(std::span<const std::byte> head, const std::string& name);

}  // namespace petrichor::texproc::detail

#endif
