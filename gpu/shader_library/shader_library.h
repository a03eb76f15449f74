#ifndef PETRICHOR_GPU_SHADER_LIBRARY_SHADER_LIBRARY_H
#define PETRICHOR_GPU_SHADER_LIBRARY_SHADER_LIBRARY_H

#include <span>
#include <string>
#include <vector>

#include "gpu/compiler/pack.h"

namespace petrichor::gpu {

enum class ShaderLanguage { Glsl, Hlsl };

/// The formulas as one text for the shaders of another engine: no includes, no macros of ours but numbers with
/// PETRICHOR_ before their names, and petrichor_ before the name of every function, struct and constant, so that it can
/// stand beside anything. Members of structs and parameters keep their names.
///
///   GLSL  330 and later, ES 300 and later: locals are not const, since older ones take constants only
///   HLSL  shader model 4 and later
std::string shader_library(ShaderLanguage language);

/// The formulas as they are, with what they include: names of files with their texts, for C++ with GLM and for
/// compilers of GLSL and HLSL that find includes from a root.
std::vector<ShaderText> formula_headers();

/// What shader_library() does, of any texts: `roots` and all that they include of `texts`.
/// Throws Error where one includes what is not among `texts`, or uses the preprocessor for more than guards, the choice
/// of a language and simple macros.
std::string flattened_texts(std::span<const ShaderText> texts, const std::vector<std::string>& roots,
                            ShaderLanguage language);

}  // namespace petrichor::gpu

#endif
