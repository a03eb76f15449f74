#ifndef PETRICHOR_TEXPROC_CODECS_DECODER_IMAGE_LIBRARY_H
#define PETRICHOR_TEXPROC_CODECS_DECODER_IMAGE_LIBRARY_H

#include "texproc/codecs/decoder/oiio.h"

namespace petrichor::texproc::decoder {

/// The functions of oiio.h, in a module that lies beside this program: the image library brings
/// some hundred others and takes a fifth of a second to load, so it is loaded for the first file
/// that needs it. Throws std::runtime_error when the module is missing. `loaded` is called after
/// loading.
struct ImageLibrary {
    decltype(&read_with_oiio) read;
    decltype(&write_with_oiio) write;
};
const ImageLibrary& image_library(void (*loaded)());

}  // namespace petrichor::texproc::decoder

#endif
