#ifndef PETRICHOR_GPU_COMPILER_COMPILER_H
#define PETRICHOR_GPU_COMPILER_COMPILER_H

#include <span>
#include <string>
#include <vector>

#include "base/content_cache.h"
#include "gpu/compiler/pack.h"

namespace petrichor::gpu {

/// The texts that a shader compiled at run time may include: formulas, frame, lighting, passes, as
/// they were when the program was built.
std::span<const ShaderText> embedded_texts();

/// SPIR-V 1.6 of the embedded compute or fragment shader `main` (NAME.frag.glsl) with `preamble` before its first #include and
/// `own` texts beside the embedded ones.
///
/// The compiler runs in a program of its own, with 30 s and 1 GiB. What it made is kept in `cache`
/// by the content of all texts, so that a second start is warm.
/// Throws Error with place and line of what is wrong.
std::vector<std::uint32_t> compile_shader(const std::string& main, const std::string& preamble,
                                          const std::vector<ShaderText>& own,
                                          const ContentCache& cache);

}  // namespace petrichor::gpu

#endif
