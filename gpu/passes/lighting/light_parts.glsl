// The light of a pixel by the way it came, beside its sum (gpu/outputs/light_parts_io.h). Included by the
// passes of lighting and background; left out where no picture of a part is asked for.
#ifndef PETRICHOR_LIGHT_PARTS_GLSL
#define PETRICHOR_LIGHT_PARTS_GLSL

struct PartsOfLight {
    vec3 of[LIGHT_PARTS];
};

PartsOfLight no_parts()
{
    PartsOfLight parts;
    for (int i = 0; i < LIGHT_PARTS; ++i) parts.of[i] = vec3(0.0);
    return parts;
}

// Behind fog that lets so much through.
void veil_parts(inout PartsOfLight parts, float kept, vec3 veil)
{
    for (int i = 0; i < LIGHT_PARTS; ++i) parts.of[i] *= kept;
    parts.of[PART_VOLUME] = veil * (1.0 - kept);
}

// So bright together as the picture, which ends at that.
void limit_parts(inout PartsOfLight parts, vec3 radiance, vec3 most)
{
    const vec3 share = min(most / max(radiance, most), vec3(1.0));
    for (int i = 0; i < LIGHT_PARTS; ++i) parts.of[i] *= share;
}

void store_parts(PartsOfLight parts, ivec2 texel)
{
    for (int i = 0; i < LIGHT_PARTS; ++i) {
        vec4 sum = vec4(parts.of[i], 0.0);
        if (frame.sample_index > 0u) sum += imageLoad(light_parts, ivec3(texel, i));
        imageStore(light_parts, ivec3(texel, i), sum);
    }
}

#endif
