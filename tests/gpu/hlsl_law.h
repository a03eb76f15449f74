#ifndef PETRICHOR_TESTS_GPU_HLSL_LAW_H
#define PETRICHOR_TESTS_GPU_HLSL_LAW_H

#include <string>
#include <vector>

namespace glslang {
class TIntermediate;
}

namespace petrichor::gpu {

/// What Microsoft's compilers (FXC, DXC) refuse of a text or read otherwise than GLSL does, and glslang lets pass: names
/// that either language keeps for itself, vectors made of one number that is known beforehand, a counter of a `for`
/// that its function declares once more (FXC keeps it to the function's end).
std::vector<std::string> objections_of(const std::string& text);

/// The same of what a tree of GLSL shows: vectors made of one number or cut from a longer one, vectors and structs
/// compared as a whole, constructors of structs, arrays that are no members, matrices; and what Godot 4.6 refuses: an
/// unsigned number shifted by a signed one.
std::vector<std::string> objections_of(glslang::TIntermediate& tree);

}  // namespace petrichor::gpu

#endif
