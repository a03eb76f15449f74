// What a light map says of sun and lamps, beside the share of skylight that it holds: in the alpha of the
// G-buffer's target `baked`. The share alone is 0..1 as it is; both together are negative halfs, of which 30720
// differ: 64 levels of what is seen, 29 of how far that counts, 8 of the share, lamps or not.
#ifndef PETRICHOR_GPU_FRAME_BAKED_SHADOW_GLSL
#define PETRICHOR_GPU_FRAME_BAKED_SHADOW_GLSL

// In place of the share: no map is here, what stands in the target is light of lamps at vertices.
const float kBakedAtVertices = 2.0;

const float kBakedShadowSteps = 28.0;

struct BakedShadow {
    float visible;  // 0..1: what the map says of the sun is seen
    float share;    // 0: real-time shadows alone .. 1: the map's word alone
    float lamps;    // 1: lamps, too, are seen so far only
};

BakedShadow no_baked_shadow()
{
    return BakedShadow(1.0, 0.0, 0.0);
}

// As the code will have it.
float baked_shadow_step(float share)
{
    return floor(clamp(share, 0.0, 1.0) * kBakedShadowSteps + 0.5) / kBakedShadowSteps;
}

float baked_shadow_code(BakedShadow b, float sky)
{
    const uint share = uint(clamp(b.share, 0.0, 1.0) * kBakedShadowSteps + 0.5);
    if (share == 0u) return sky;
    uint code = uint(clamp(b.visible, 0.0, 1.0) * 63.0 + 0.5);
    code = code * 29u + share;
    code = code * 8u + uint(clamp(sky, 0.0, 1.0) * 7.0 + 0.5);
    code = code * 2u + (b.lamps > 0.5 ? 1u : 0u);
    // Ten bits of fraction, exponents of normal halfs.
    return -uintBitsToFloat((code + (113u << 10)) << 13);
}

uint baked_shadow_bits(float code)
{
    return (floatBitsToUint(-code) >> 13) - (113u << 10);
}

float baked_sky_of(float code)
{
    return code == kBakedAtVertices ? 0.0 : code >= 0.0 ? code : float(baked_shadow_bits(code) / 2u % 8u) / 7.0;
}

BakedShadow baked_shadow_of(float code)
{
    if (code >= 0.0) return no_baked_shadow();
    const uint bits = baked_shadow_bits(code);
    return BakedShadow(float(bits / 464u) / 63.0, float(bits / 16u % 29u) / kBakedShadowSteps, float(bits & 1u));
}

// What it says of lamps stands in the alpha of `emission`, where layers that light passes have the share of their
// thickness (0..1, as it is): negative halfs again, 31 levels of each of three channels.
const uint kLampMaskLevels = 31u;

float lamp_mask_code(vec3 seen, float body)
{
    const uvec3 level = uvec3(clamp(seen, vec3(0.0), vec3(1.0)) * float(kLampMaskLevels - 1u) + 0.5);
    if (level == uvec3(kLampMaskLevels - 1u)) return body;
    const uint code = (level.x * kLampMaskLevels + level.y) * kLampMaskLevels + level.z;
    return -uintBitsToFloat((code + (113u << 10)) << 13);
}

vec3 lamp_mask_of(float code)
{
    if (code >= 0.0) return vec3(1.0);
    const uint bits = baked_shadow_bits(code);
    const uvec3 level = uvec3(bits / (kLampMaskLevels * kLampMaskLevels), bits / kLampMaskLevels % kLampMaskLevels,
                              bits % kLampMaskLevels);
    return vec3(level) / float(kLampMaskLevels - 1u);
}

#endif
