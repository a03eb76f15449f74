// The outputs of the renderer besides the beauty ("AOVs"): one row each, read by C++ and GLSL. A
// new output is a row here and nothing else: --aov, the EXR's channels and the documentation
// follow.
//
//   ROW(name, count, channels, unit, precision, meaning, value, background)
//     name         as in --aov
//     count        numbers a pixel, 1 to 4
//     channels     suffixes of the EXR's channels, one a number
//     unit         "1" for shares and directions
//     precision    HALF or FLOAT in the EXR
//     value        GLSL: float, vec2, vec3 or vec4, from `frame` and the AovPoint `p`
//     (aov.comp.glsl) background   GLSL float: where no surface is seen
//
// Labels come from the sample at the pixel's centre.
#ifndef PETRICHOR_GPU_OUTPUTS_AOV_TABLE_IO_H
#define PETRICHOR_GPU_OUTPUTS_AOV_TABLE_IO_H

#define AOV_TABLE(ROW)                                                                          \
    ROW(depth, 1, "Z", "m", FLOAT, "distance along the view axis; infinity for the sky",        \
        linear_depth(frame, p.depth), kInfinity)                                                \
    ROW(position, 3, "XYZ", "m", FLOAT, "world position", p.position, 0.0)                      \
    ROW(normal, 3, "XYZ", "1", HALF, "world normal of the dry surface, unit", p.g.base_normal,  \
        0.0)                                                                                    \
    ROW(base_color, 3, "RGB", "1", HALF, "dry base colour, linear, 0..1", p.g.base_color, 0.0)  \
    ROW(roughness, 1, "Y", "1", HALF, "dry perceptual roughness, 0..1", p.g.roughness, 0.0)     \
    ROW(metallic, 1, "Y", "1", HALF, "metallic, 0..1", p.g.metallic, 0.0)                       \
    ROW(occlusion, 1, "Y", "1", HALF, "baked ambient occlusion, 1 open", p.g.occlusion, 0.0)    \
    ROW(emission, 3, "RGB", "cd/m2", HALF, "emitted radiance, linear", p.g.emission, 0.0)       \
    ROW(baked_light, 3, "RGB", "lx", HALF, "irradiance of the light map, linear",              \
        p.g.baked * 3.14159265, 0.0)                                                            \
    ROW(film, 1, "Y", "1", HALF, "where a film of water can form: shelter and slope, 0..1",     \
        p.g.weather.x, 0.0)                                                                     \
    ROW(water, 1, "Y", "1", HALF, "cover of standing water, 0..1", p.g.weather.y, 0.0)          \
    ROW(snow, 1, "Y", "1", HALF, "cover of snow, 0..1", p.g.weather.z, 0.0)                     \
    ROW(frost, 1, "Y", "1", HALF, "cover of hoar frost, 0..1", p.g.weather.w, 0.0)              \
    ROW(cover_normal, 3, "XYZ", "1", HALF, "world normal of the water or snow surface, unit",   \
        p.g.cover_normal, 0.0)                                                                  \
    ROW(ring_roughness, 1, "Y", "1", HALF,                                                      \
        "perceptual roughness of standing water by rings smaller than a pixel, 0..1", p.g.cover_roughness, 0.0) \
    ROW(porosity, 1, "Y", "1", HALF, "porosity: how far water darkens the dry surface, 0..1",   \
        p.g.porosity, 0.0)                                                                      \
    ROW(specular, 3, "RGB", "1", HALF, "dry reflectance at normal incidence, metals included",  \
        mix(p.g.f0, p.g.base_color, p.g.metallic), 0.0)                                   \
    ROW(film_depth, 1, "Y", "mm", FLOAT, "film of water on the patch; 1 mm is 1 kg/m2",         \
        p.stores.x, 0.0)                                                                        \
    ROW(water_depth, 1, "Y", "m", FLOAT, "standing water on the patch, or of the hollow",       \
        p.stores.y, 0.0)                                                                        \
    ROW(snow_depth, 1, "Y", "m", FLOAT, "snow on the patch, along its normal", p.stores.z, 0.0) \
    ROW(ice, 1, "Y", "kg/m2", FLOAT, "ice on the patch: film, cracks and puddles",              \
        p.stores.w, 0.0)                                                                        \
    ROW(liquid, 1, "Y", "1", HALF, "liquid share of all water on the patch", p.state.x, 0.0)    \
    ROW(surface_temperature, 1, "Y", "K", FLOAT, "of the patch's surface", p.state.y, 0.0)      \
    ROW(rain_exposure, 1, "Y", "1", HALF, "rain that meets the patch over rain on open ground", \
        p.state.z, 0.0)                                                                         \
    ROW(lighting_model, 1, "Y", "1", HALF,                                                      \
        "number of the lighting model, behind them of layers; -1: nothing",                     \
        float(p.g.model), -1.0)                                                             \
    ROW(lighting_path, 1, "Y", "1", HALF,                                                       \
        "0 lit from the G-buffer, 1 light gathered before the material is asked (prepass), "    \
        "2 a model of your own asked light by light (forward); -1: nothing",                    \
        lighting_path(p.g.model), -1.0)                                                         \
    ROW(material, 1, "Y", "1", FLOAT, "number of the material in the scene; -1: nothing",       \
        float(p.g.material), -1.0)

#endif
