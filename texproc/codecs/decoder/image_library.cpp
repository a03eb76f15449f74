#include "texproc/codecs/decoder/image_library.h"

#include <dlfcn.h>

#include <filesystem>
#include <stdexcept>

namespace petrichor::texproc::decoder {

const ImageLibrary& load_image_library()
{
    const std::filesystem::path here =
        std::filesystem::read_symlink("/proc/self/exe").parent_path();
    const std::string module = (here / "petrichor-images.so").string();
    void* opened = dlopen(module.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!opened) {
        throw std::runtime_error(std::string("the image library cannot be loaded (") + dlerror() +
                                 "); install petrichor again");
    }
    const auto* found = static_cast<const ImageLibrary*>(dlsym(opened, "petrichor_images"));
    if (!found)
        throw std::runtime_error(module + " is of another version; install petrichor again");
    found->warm_up();
    return *found;
}

}  // namespace petrichor::texproc::decoder
