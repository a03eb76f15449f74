#ifndef PETRICHOR_GPU_COMPILER_COMPILER_H
#define PETRICHOR_GPU_COMPILER_COMPILER_H

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "gpu/compiler/pack.h"

namespace petrichor::gpu {

/// The texts that a shader compiled at run time may include: formulas, frame, lighting, passes, as
/// they were when the program was built.
std::span<const ShaderText> embedded_texts();

/// SPIR-V 1.6 of the embedded compute shader `main` with `preamble` before its first #include and
/// `own` texts beside the embedded ones.
///
/// The compiler runs in a program of its own, with 30 s and 1 GiB. What it made is kept in
/// `cache_folder` (empty: nowhere) by the content of all texts, so that a second start is warm.
/// Throws Error with place and line of what is wrong.
std::vector<std::uint32_t> compile_shader(const std::string& main, const std::string& preamble,
                                          const std::vector<ShaderText>& own,
                                          const std::filesystem::path& cache_folder);

/// $PETRICHOR_CACHE, else $XDG_CACHE_HOME/petrichor, else ~/.cache/petrichor; empty: there is none.
std::filesystem::path default_cache_folder();

}  // namespace petrichor::gpu

#endif
