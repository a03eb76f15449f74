// A surface of your own is a GLSL file NAME.glsl with two functions, named by a material
// ([materials."glob"] surface = "NAME.glsl", or "surface" in the weather extension of glTF):
//
//   void NAME_input(inout SurfaceInput at)
//       before anything is read. What a point is asked with may change: at.weather (red mixes the two
//       sets of textures, green lets puddles stand, blue lets snow lie; each 0..1), at.color, at.uv.
//   void NAME_surface(SurfaceInput at, inout SurfaceData data)
//       at the end. data.texel holds the dry material (base_color, roughness, metallic, base_normal,
//       occlusion, porosity), data.texel.weather the film, water, snow and frost here, data.emission
//       the radiance. What weather does to the material is worked out from these, in the light.
//       Of a material that is blended (alphaMode BLEND) data.opacity is the share of what lies behind that
//       is hidden, 0..1, reflections stay whole (as long as it is below 0, the material's alpha holds), and
//       data.filtered what is let through of the rest, by colour. Its shadow goes by the material's alpha.
//
// It may have a third one:
//
//   vec3 NAME_move(MoveInput at)
//       how far a vertex is moved from where it rests, metres in the world: waves, swaying, breath. Asked once
//       for each vertex and moment, and at two places beside it for its normal; the mesh is as fine as it is
//       (displacement_edge_m of the material cuts it). What is moved throws shadows, is met by rays of rain and
//       seen in mirrors as it is. Vertices at one place have one normal and spacing, so that a function of these
//       and of the place opens no seam. Light between surfaces and what keeps rain off go by the mesh at rest,
//       meshes that joints bend are not moved, and what is moved wind does not bend.
//
// What a point is asked with (gpu/passes/surface/surface_data.glsl): at.position in the world, metres;
// at.normal and at.tangent of the geometry; at.uv, both texture coordinates; at.color and at.weather of the
// vertices, 1 where a mesh has none; at.instance_id and at.material_id; and how position, normal and uv
// change to the next pixel (at.position_dx, at.position_dy, ..): the scale of what is seen.
//
// frame holds the time, the weather of the moment and the look (gpu/frame/frame_io.h), material the
// constants of the material (gpu/upload/material_io.h). No derivative may be taken: at.position_dx and
// the like are given. Random numbers are hashes of places (formulas/noise/noise.h).
//
// What is solid is then shaded from a visibility buffer, whatever [render] surface_path says.
#ifndef PETRICHOR_OWN_SURFACE_GLSL
#define PETRICHOR_OWN_SURFACE_GLSL

#include "formulas/noise/noise.h"
#include "gpu/passes/surface/sets.glsl"

// Of frame only time_s, weather and look are told then; maps of the weather are white.
struct MoveInput {
    vec3 position;  // at rest, world, metres
    vec3 normal;    // of the mesh there, at rest, unit
    vec4 uv;        // texture coordinates 0 and 1
    vec4 color;     // of the vertices, linear
    vec4 weather;   // likewise: mix, puddle mask, snow mask, -
    float spacing;  // metres to the farthest neighbour: the mesh cannot show waves shorter than twice that
};

// A texture of the material as a vertex reads it. slot: TEXTURE_... of gpu/upload/material_io.h
vec4 texel_at(sampler2D map, int slot, MoveInput at)
{
    const TextureSlot t = material.slots[slot];
    const vec2 p = t.texcoord != 0u ? at.uv.zw : at.uv.xy;
    return textureLod(map, vec2(dot(t.row0.xy, p) + t.row0.z, dot(t.row1.xy, p) + t.row1.z), 0.0);
}

#endif
