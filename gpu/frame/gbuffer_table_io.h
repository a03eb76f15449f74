// The targets of the G-buffer: one row each, read by C++ and GLSL. The surface pass writes the dry
// material and the weather at each pixel; later passes read them (gpu/frame/gbuffer_read.glsl).
//
//   ROW(name, location, format, when, meaning)
//     location   of the shader's output, counted from 0 in the order of the rows
//     format     VK_FORMAT_...
//     when       the part of a frame without which nothing is kept: the name of the rows' table
//
// A new channel is a row here and its line in encode_gbuffer (gpu/frame/gbuffer.glsl).
#ifndef PETRICHOR_GPU_FRAME_GBUFFER_TABLE_IO_H
#define PETRICHOR_GPU_FRAME_GBUFFER_TABLE_IO_H

#define GBUFFER_ALWAYS(ROW)                                                                \
    ROW(color, 0, R8G8B8A8_UNORM, ALWAYS, "square root of base colour; ambient occlusion") \
    ROW(normals, 1, R16G16B16A16_SNORM, ALWAYS,                                            \
        "octahedral: base normal, cover normal (of water or snow)")                        \
    ROW(material, 2, R8G8B8A8_UNORM, ALWAYS,                                               \
        "perceptual roughness, metallic, porosity; lighting model")                        \
    ROW(payload, 3, R8G8B8A8_UNORM, ALWAYS,                                                \
        "root of the reflectance at normal incidence, not of metal; direction of the tangent")
#define GBUFFER_PAYLOAD 3  // its location
#define GBUFFER_WEATHER(ROW)                                                                 \
    ROW(weather, 4, R16G16B16A16_UNORM, WEATHER,                                             \
        "number of the material; smoothness of the snow, with two sets the share of the first; in 8 bits each film and standing water, snow and frost")
#define GBUFFER_EMISSION(ROW) \
    ROW(emission, 5, R16G16B16A16_SFLOAT, EMISSION, \
    "radiance; of a layer its thickness, else codes of the shadows of lamps that a light map holds")
#define GBUFFER_BAKED(ROW)                       \
    ROW(baked, 6, R16G16B16A16_SFLOAT, BAKED,     \
        "light map: irradiance divided by pi; share of skylight that it holds already, or codes of that and of shadows")

#define GBUFFER_TABLE(ROW) \
    GBUFFER_ALWAYS(ROW) GBUFFER_WEATHER(ROW) GBUFFER_EMISSION(ROW) GBUFFER_BAKED(ROW)

// What is kept of the weather; specialization constants of passes that write or read it.
#define WEATHER_DRY 0
#define WEATHER_WHOLE 1  // the row above
#define WEATHER_WET 2    // half as wide, in place of it, where nothing is white and no surface has two sets (FrameTargets::wet): film, standing water, number of the material in two

// Bindings of a pass that reads the G-buffer: depth at the first, the targets behind it.
#define GBUFFER_BINDINGS 8

#endif
