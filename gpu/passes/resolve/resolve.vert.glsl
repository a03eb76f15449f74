#version 460
// A triangle over the whole picture.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/frame/frame_io.h"
#include "gpu/passes/resolve/resolve_frame.glsl"
#include "gpu/passes/resolve/resolve_io.h"
#include "gpu/passes/sky/sky_light_io.h"

layout(binding = RESOLVE_FRAME, scalar) uniform Frame { FrameConstants frame; };
layout(binding = RESOLVE_SKY_LIGHT, scalar) uniform Sky { SkyLight sky_light; };
RESOLVE_FRAME_WORDS(out)

void main()
{
    gl_Position = vec4(gl_VertexIndex == 1 ? 3.0 : -1.0, gl_VertexIndex == 2 ? 3.0 : -1.0, 0.5, 1.0);
    size_flags = ivec3(frame.size, int(frame.flags));
    lens = vec4(frame.samples, frame.bloom, frame.wet_lens, frame.time_s);
    gains_exposure = vec4(frame.white_gains, sky_light.exposure);
}
