// What every evaluation of a surface reads: set 0 is the frame's, set 1 the material's.
#ifndef PETRICHOR_SURFACE_BINDINGS_GLSL
#define PETRICHOR_SURFACE_BINDINGS_GLSL

#include "gpu/frame/frame_io.h"
#include "gpu/passes/surface/surface_io.h"
#include "gpu/upload/material_io.h"

layout(constant_id = SURFACE_SPEC_HOLES) const uint HOLES = 1u;
layout(constant_id = SURFACE_SPEC_SLOTS) const uint SLOTS = (1u << TEXTURE_SLOTS) - 1u;
layout(constant_id = SURFACE_SPEC_WATER) const uint WATER = 7u;
layout(constant_id = SURFACE_SPEC_SNOW) const uint SNOW = 1u;
layout(constant_id = SURFACE_SPEC_FROST) const uint FROST = 1u;
layout(constant_id = SURFACE_SPEC_PARALLAX) const uint PARALLAX = 0u;
layout(constant_id = SURFACE_SPEC_SECOND) const uint SECOND = SECOND_NONE;
layout(constant_id = SURFACE_SPEC_LOOKS) const uint LOOKS = 0u;
layout(constant_id = SURFACE_SPEC_FADE) const uint FADE = 0u;
layout(constant_id = SURFACE_SPEC_OWN) const uint OWN = 0u;
layout(constant_id = SURFACE_SPEC_LAYER_ROLES_A) const uint LAYER_ROLES_A = 0u;
layout(constant_id = SURFACE_SPEC_LAYER_ROLES_B) const uint LAYER_ROLES_B = 0u;
layout(constant_id = SURFACE_SPEC_LAYER_ROLES_C) const uint LAYER_ROLES_C = 0u;
layout(constant_id = SURFACE_SPEC_BESIDES) const uint BESIDES = 0u;
layout(constant_id = SURFACE_SPEC_GROUND_VARIES) const uint GROUND_VARIES = 1u;
layout(constant_id = SURFACE_SPEC_FALLS) const int FALLS = 1;
layout(constant_id = SURFACE_SPEC_VERTEX_LIGHT) const uint VERTEX_LIGHT = 0u;
layout(constant_id = SURFACE_SPEC_STRETCH) const uint STRETCH = 1u;
layout(constant_id = SURFACE_SPEC_PLACE) const uint PLACE = 0u;

// A compute shader reads both blocks by words, where its driver gains by that: read_constants() at its beginning.
#ifdef FRAME_BY_WORDS
#define FRAME_PLACE set = 0, binding = SURFACE_FRAME
#include "gpu/frame/frame_words.glsl"
#else
layout(set = 0, binding = SURFACE_FRAME, scalar) uniform Frame { FrameConstants frame; };
FallConstants fall_of(int k) { return frame.arrays.falls[k]; }
#endif
layout(set = 0, binding = SURFACE_RIPPLE) uniform sampler2D ripple_map;
layout(set = 0, binding = SURFACE_FLOW) uniform usamplerBuffer flow_quads;
layout(set = 0, binding = SURFACE_SNOW) uniform sampler2D snow_map;
layout(set = 0, binding = SURFACE_SHELTER) uniform usamplerBuffer shelter_quads;  // of the depth maps of the sky
layout(set = 0, binding = SURFACE_PLACE_TABLE) uniform usamplerBuffer place_table;
layout(set = 0, binding = SURFACE_PLACE_STATES) uniform usamplerBuffer place_states;
layout(set = 0, binding = SURFACE_PLACE_LABELS) uniform usamplerBuffer place_labels;
layout(set = 0, binding = SURFACE_PLACE_LEVELS) uniform samplerBuffer place_levels;
layout(set = 0, binding = SURFACE_TRACKS) uniform sampler2D track_map;
layout(set = 0, binding = SURFACE_INSTANCE_LOOKS) uniform samplerBuffer instance_looks;
#ifdef FRAME_BY_WORDS
layout(set = 1, binding = 0, scalar) uniform Material { MaterialConstants material_block; };
layout(set = 1, binding = 0, scalar) uniform MaterialWords { uint material_words[MATERIAL_WORD_COUNT]; };
MaterialConstants material;

LANE_WORDS(material, MATERIAL_WORD_COUNT)

void material_take(inout int at, out TextureSlot v)
{
    material_take(at, v.row0);
    material_take(at, v.row1);
    material_take(at, v.texcoord);
    material_take(at, v.present);
    material_take(at, v.channel);
}

void read_constants()
{
    read_frame();
    if (LANES == 0u) {
        material = material_block;
        return;
    }
    int at = 0;
#define TAKE(type, member) material_take(at, material.member);
    MATERIAL_FIELDS(TAKE)
#undef TAKE
    material_take(at, material.lighting_model);
#define SLOT(i) material_take(at, material.slots[i]);
    SLOT(0) SLOT(1) SLOT(2) SLOT(3) SLOT(4) SLOT(5) SLOT(6) SLOT(7) SLOT(8) SLOT(9) SLOT(10)
    SLOT(11) SLOT(12) SLOT(13) SLOT(14) SLOT(15) SLOT(16) SLOT(17) SLOT(18) SLOT(19) SLOT(20) SLOT(21)
#undef SLOT
}
#else
layout(set = 1, binding = 0, scalar) uniform Material { MaterialConstants material; };
#endif
#define MATERIAL_TEXTURE(slot, name) layout(set = 1, binding = 1 + slot) uniform sampler2D name;
MATERIAL_TEXTURES(MATERIAL_TEXTURE)
#undef MATERIAL_TEXTURE
#define LAYER_SLOT(slot) \
    layout(set = 1, binding = 1 + TEXTURE_SLOTS + slot) uniform sampler2D layer_texture_##slot;
LAYER_SLOT(0) LAYER_SLOT(1) LAYER_SLOT(2) LAYER_SLOT(3) LAYER_SLOT(4) LAYER_SLOT(5)
#undef LAYER_SLOT

#endif
