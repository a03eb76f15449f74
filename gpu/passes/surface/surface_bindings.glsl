// What every evaluation of a surface reads: set 0 is the frame's, set 1 the material's.
#ifndef PETRICHOR_SURFACE_BINDINGS_GLSL
#define PETRICHOR_SURFACE_BINDINGS_GLSL

#include "gpu/frame/frame_io.h"
#include "gpu/upload/material_io.h"

// What a draw needs is known before it is compiled: a CPU driver runs both sides of every branch.
layout(constant_id = 1) const uint HOLES = 1u;    // 0: opaque, so that hidden pixels are never shaded
layout(constant_id = 2) const uint SLOTS = 255u;  // texture slots that the material has, one bit each
layout(constant_id = 3) const uint WATER = 1u;    // 0: no water stands anywhere in this frame
layout(constant_id = 4) const uint SNOW = 1u;     // 0: no snow lies anywhere in this frame

layout(set = 0, binding = 0, scalar) uniform Frame { FrameConstants frame; };
layout(set = 0, binding = 1) uniform sampler2D ripple_map;
layout(set = 0, binding = 2) uniform sampler2D flow_map;
layout(set = 0, binding = 3) uniform sampler2D snow_map;
layout(set = 0, binding = 4) uniform sampler2DShadow shelter_map;
layout(set = 1, binding = 0, scalar) uniform Material { MaterialConstants material; };
layout(set = 1, binding = 1) uniform sampler2D base_color_map;
layout(set = 1, binding = 2) uniform sampler2D normal_map;
layout(set = 1, binding = 3) uniform sampler2D metallic_roughness_map;
layout(set = 1, binding = 4) uniform sampler2D occlusion_map;
layout(set = 1, binding = 5) uniform sampler2D emissive_map;
layout(set = 1, binding = 6) uniform sampler2D height_map;
layout(set = 1, binding = 7) uniform sampler2D puddle_map;
layout(set = 1, binding = 8) uniform sampler2D snow_mask_map;

#endif
