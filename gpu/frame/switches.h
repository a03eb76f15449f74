// What of a frame may be switched off: one row each. FrameSettings, the keys of [render] in a
// scenario with their documentation, and the fingerprint of a frame follow from the rows.
//
//   ROW(name, on, meaning)   on: the default
#ifndef PETRICHOR_GPU_FRAME_SWITCHES_H
#define PETRICHOR_GPU_FRAME_SWITCHES_H

#define FRAME_SWITCHES(ROW)                                                                      \
    ROW(shadows, true, "of the sun and of lamps")                                                \
    ROW(ambient_occlusion, true, "darker corners")                                               \
    ROW(bent_normals, false, "with ambient_occlusion: light from all around comes from where near things leave it; mirrors see what they leave") \
    ROW(reflections, true, "smooth surfaces mirror the picture itself; false: probes and sky alone")  \
    ROW(image_based_light, true, "light from the sky or the HDR picture")                        \
    ROW(shelter, true, "roofs keep rain and snow off")                                           \
    ROW(falling, true, "rain and snow in the air; orthographic views show none")                 \
    ROW(motion_blur, false, "camera and scene move while the shutter is open ([camera] shutter_s)") \
    ROW(soft_shadows, false, "of sun and lamps by their size: each sample looks from another point of them") \
    ROW(film_lobe, true, "a film of water has its own highlight and normal; false: as Lux 2.02")  \
    ROW(snow_body, true, "deep snow has a shape: it rounds edges, stands over them, throws shadows") \
    ROW(icicles, true, "where water that drips from edges has frozen") \
    ROW(lamp_glow, true, "fog, rain and snow glow around lamps")                                 \
    ROW(draw_sky, true, "false: black where the scene ends")                                     \
    ROW(dither, true, "of the PNG: hides steps in soft gradients")

namespace petrichor::gpu {

struct FrameSwitches {
#define ROW(name, on, meaning) bool name = on;
    FRAME_SWITCHES(ROW)
#undef ROW
};

}  // namespace petrichor::gpu

#endif
