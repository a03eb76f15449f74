#ifndef PETRICHOR_TEXPROC_CODECS_DECODER_IMAGE_LIBRARY_H
#define PETRICHOR_TEXPROC_CODECS_DECODER_IMAGE_LIBRARY_H

#include "texproc/codecs/decoder/oiio.h"

namespace petrichor::texproc::decoder {

/// The functions of oiio.h, in a module that lies beside this program: the image library brings
/// some hundred others and takes a fifth of a second to load, so only decoders that are started for
/// its formats load it.
struct ImageLibrary {
    decltype(&warm_up_oiio) warm_up;
    decltype(&read_with_oiio) read;
    decltype(&write_with_oiio) write;
};

/// Loads the module and warms it up. Throws std::runtime_error when it is missing or of another
/// version.
const ImageLibrary& load_image_library();

}  // namespace petrichor::texproc::decoder

#endif
