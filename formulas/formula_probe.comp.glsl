#version 460
// Evaluates the shared formulas on the device; tests/gpu/parity_test.cpp compares with the CPU.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "formulas/formula_probe.h"

layout(local_size_x = 64) in;
layout(binding = 0) uniform samplerBuffer arguments;
layout(binding = 1, scalar) writeonly buffer Results { vec4 results[]; };
layout(push_constant, scalar) uniform Push { int kind; };

void main()
{
    const int i = int(gl_GlobalInvocationID.x);
    if (i >= textureSize(arguments) / 3) return;
    results[i] = probe(kind, texelFetch(arguments, 3 * i), texelFetch(arguments, 3 * i + 1),
                       texelFetch(arguments, 3 * i + 2));
}
