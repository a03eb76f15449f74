// The first layer of a pixel that bends or blurs what is behind it, in four words.
#ifndef PETRICHOR_GPU_PASSES_TRANSPARENT_BENT_LAYER_GLSL
#define PETRICHOR_GPU_PASSES_TRANSPARENT_BENT_LAYER_GLSL

struct BentLayer {
    float depth;      // 0: there is none
    vec4 normals;     // as in the G-buffer
    uint material;
    float roughness;  // eight bits
    float body;       // of the material's thickness, eight bits
};

BentLayer no_bent_layer()
{
    return BentLayer(0.0, vec4(0.0), 0u, 0.0, 0.0);
}

uvec4 bent_layer_words(BentLayer l)
{
    return uvec4(floatBitsToUint(l.depth), packSnorm2x16(l.normals.xy), packSnorm2x16(l.normals.zw),
                 (l.material & 0xffffu) | packUnorm4x8(vec4(0.0, 0.0, l.roughness, l.body)));
}

BentLayer bent_layer(uvec4 words)
{
    const vec4 last = unpackUnorm4x8(words.w);
    return BentLayer(uintBitsToFloat(words.x), vec4(unpackSnorm2x16(words.y), unpackSnorm2x16(words.z)),
                     words.w & 0xffffu, last.z, last.w);
}

#endif
