#ifndef PETRICHOR_GPU_COMPILER_OWN_TEXT_H
#define PETRICHOR_GPU_COMPILER_OWN_TEXT_H

#include <string>
#include <vector>

namespace petrichor::gpu {

/// A user's GLSL file NAME.glsl.
struct OwnText {
    std::string path;
    std::string name;  ///< NAME, which its functions begin with
    std::string text;
};

/// Reads one, at most 256 KiB, that defines NAME with each of `parts` behind it. Throws Error for a name
/// that is no identifier or one of `taken`, and for a part that is missing; `what` begins messages,
/// `example` is a file that shows how.
OwnText read_own_text(const std::string& path, const std::string& what,
                      const std::vector<std::string>& parts, const std::vector<std::string>& taken,
                      const std::string& example);

}  // namespace petrichor::gpu

#endif
