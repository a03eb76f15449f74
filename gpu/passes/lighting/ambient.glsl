// Light from all around: what of it arrives, and what a mirror would see of it.
struct Ambient {
    vec3 irradiance;  // over pi
    float occlusion;  // of what is left to darken it
    float screen;     // what near things leave of what is mirrored
    vec3 mirrored;    // the sky's maps times this, where no probe tells more
    vec3 unhidden;    // irradiance before what stands near takes its share
    float open;       // 0..1: how far a mirror sees the sky
    vec3 lean;        // from the normal to the middle of what near things leave
};
