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

#endif
