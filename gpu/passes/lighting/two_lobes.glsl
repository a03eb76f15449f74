// A second lobe of a surface (formulas/light/two_lobes.h): read, weathered, and what both mirror. Included by the
// lighting pass; left out where no material in the picture has one.
#ifndef PETRICHOR_LIGHTING_TWO_LOBES_GLSL
#define PETRICHOR_LIGHTING_TWO_LOBES_GLSL

const bool TWO_LOBES = (LAYERS & LAYERS_SECOND_LOBE) != 0u && SHARES != 0u;

// SHARES_.. of the material that the G-buffer names by a row behind the models.
uint kind_of_shares(uint model)
{
    if ((LAYERS & (LAYERS_SECOND_LOBE | LAYERS_TRANSMISSION)) == 0u || SHARES == 0u || model < LIGHTING_MODEL_COUNT) return SHARES_SHEEN;
    return uint(texelFetch(layers_table, int(model - LIGHTING_MODEL_COUNT) * LAYERS_TEXELS + 7).w);
}

bool has_second_lobe(uint model)
{
    return TWO_LOBES && kind_of_shares(model) == SHARES_LOBES;
}

// The dry lobe of a pixel, before weather; share 0 where there is none.
struct DryLobe {
    vec3 normal;
    float roughness;
    float share;
};

DryLobe dry_second_lobe(uint model, ivec2 texel)
{
    DryLobe lobe = DryLobe(vec3(0.0, 1.0, 0.0), 1.0, 0.0);
    if (!has_second_lobe(model)) return lobe;
    const LayerShares s = unpack_shares(texelFetch(layer_shares, texel, 0), SHARES_LOBES);
    return DryLobe(s.second_normal, s.second_roughness, s.second_share);
}

// As the first: a normal map must not turn a visible point away from the eye.
vec3 toward_eye(vec3 n, vec3 v)
{
    const float facing = dot(n, v);
    return facing < 0.02 ? normalize(n + v * (0.02 - facing)) : n;
}

// What one lobe of GGX mirrors of F0.
vec3 mirrored_by(vec3 f0, vec2 sum)
{
    return f0 * sum.x + vec3(sum.y);
}

// Of what both mirror together, that of the second.
//   first, second  scale and offset of F0 of each
vec3 share_of_second(LitPoint p, vec2 first, vec2 second)
{
    const vec3 both = mirrored_by(p.specular, mix(first, second, p.second.share));
    return mirrored_by(p.specular, second) * p.second.share / max(both, vec3(1.0e-6));
}

// The lobe that stands for both in the pass of reflections, which takes one.
//   normal    of the first
vec4 joined_lobe(LitPoint p, vec3 normal)
{
    return vec4(normalize(mix(normal, p.second.lobe.normal, p.second.share)),
                joined_roughness(p.roughness, p.second.roughness, p.second.share));
}

#endif
