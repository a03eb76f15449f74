// Lights of the table that reach a pixel: a loop for each kind (gpu/passes/lights/lights.h), so that what no
// light of a loop has is left out of it.

// Of lamps whose shadows a light map holds (gpu/frame/baked_shadow.glsl).
// The plain one last: else glslang does not take it for a constant.
const bool MASKED = (WAYS & LIGHTS_MASKED) != 0u && BAKED != 0u;
vec3 lamp_mask = vec3(1.0);    // of this pixel, by channel
float lamp_mask_share = 0.0;

struct LampShadow {
    float number;   // of its shadow map; below 0: none
    float channel;  // of masks, from 1; 0: none
    float strength;
};

LampShadow shadow_of(LightRow light)
{
    float channel = 0.0;
    if (MASKED) channel = floor((light.across.w + 1.0) / LIGHT_MASK_STEP);
    const float code = light.across.w - LIGHT_MASK_STEP * channel;
    if ((WAYS & LIGHTS_WEAK_SHADOWS) == 0u) return LampShadow(code, channel, 1.0);
    const float number = floor(code);
    return LampShadow(number, channel, 1.0 - 2.0 * (code - number));
}

// Of what is seen of a lamp through its shadows, whatever tells them.
float received_from(float visible, LampShadow shadow, LitPoint p)
{
    if ((WAYS & LIGHTS_WEAK_SHADOWS) != 0u) visible = weak_shadow(visible, shadow.strength);
    return received(visible, p);
}

// What is seen of a lamp. Without a shadow in real time the mask's word counts everywhere.
float masked(float visible, LampShadow shadow)
{
    const float seen = shadow.channel < 1.5 ? lamp_mask.x : shadow.channel < 2.5 ? lamp_mask.y : lamp_mask.z;
    float share = 1.0;
    if (LAMP_SHADOWS != 0u) share = shadow.number >= 0.0 ? lamp_mask_share : 1.0;
    return shadow.channel < 0.5 ? visible : mix(visible, seen, share);
}

// With so much of its highlight.
Lobe shown_so_much(Lobe lobe, float share)
{
    lobe.lit *= share;
    lobe.again *= share;
    lobe.steep *= share;
    lobe.loss.along /= max(share, 1.0e-6);  // of a lobe that has its share already
    return lobe;
}

// One light of the table; zero out of its range or behind the surface.
vec3 punctual_light(LitPoint p, LightRow light, ivec2 texel, const bool shadowed, const bool shaped)
{
    const vec4 sphere = light.sphere;
    const vec3 to_light = sphere.xyz - p.position;
    const float d2 = dot(to_light, to_light);
    // A CPU takes both sides of every branch: there what is dark is chosen away at the end.
    const bool SKIPS = (WAYS & LIGHTS_SKIP) != 0u;
    bool lit = d2 < sphere.w * sphere.w;
    if (SKIPS && !lit) return vec3(0.0);
    float visible = 1.0;
    bool one_of_shape = shaped;  // all of that loop are, and end before
    const LampShadow shadow = shadow_of(light);
    if (LAMP_SHADOWS != 0u && shadowed) {
        const float number = shadow.number;
        vec3 from = sphere.xyz;
        if (SOFT_LAMPS != 0u) from += frame_arrays.lamp_offset_m[max(int(number), 0)].xyz;
        if (number >= 0.0) visible = lamp_visibility(number, from, light_near_m(light), p.position, p.mesh_normal, texel);
    }
    if (MASKED) visible = masked(visible, shadow);
    visible = received_from(visible, shadow, p);
    lit = lit && (visible > 0.0 || BLEEDS);
    if (SKIPS && !lit) return vec3(0.0);
    if (WAYS != 0u) {
        const vec4 size = light.size;
        if (shaped && (WAYS & (LIGHTS_LTC | LIGHTS_NEAREST)) != 0u && size.x > 0.0) {
            if ((WAYS & LIGHTS_BY_MATERIAL) == 0u || !p.point_lamps)
                return lit ? area_light(p, light, to_light, sphere.w, size, visible) : vec3(0.0);
            if (light.color.w < LIGHT_POINT - 0.5)
                return lit ? rectangle_light(p, light, to_light, light.color) * visible : vec3(0.0);
            // Radiance times what is seen of the lamp: its intensity.
            if ((WAYS & LIGHTS_LTC) != 0u) light.color.rgb *= (3.14159265 * size.x + 4.0 * size.y) * size.x;
            one_of_shape = false;
        }
        if ((WAYS & (LIGHTS_FILL | LIGHTS_BY_MATERIAL)) != 0u) {
            const float highlight = highlight_share(size.z, p.roughness);
            p.lobe = shown_so_much(p.lobe, highlight);
            if (TWO_LOBES) p.second.lobe = shown_so_much(p.second.lobe, highlight);
            p.film.lit *= highlight_share(size.z, p.film.roughness);
            p.layers.coat_spared = 1.0 - highlight_share(size.z, p.layers.coat_roughness);
        }
    }
    if (RECTANGLES != 0u && shaped) {
        const vec4 glow = light.color;
        if (glow.w < LIGHT_POINT - 0.5) {
            return lit ? rectangle_light(p, light, to_light, glow) * visible : vec3(0.0);
        }
    }
    if (one_of_shape) return vec3(0.0);
    const float inverse = inversesqrt(max(d2, 1.0e-8));
    const vec3 l = to_light * inverse;
    lit = lit && (dot(p.normal, l) > 0.0 || p.layers.transmitted > 0.0 || BLEEDS || TWO_LOBES);
    if (SKIPS && !lit) return vec3(0.0);
    const vec4 color = light.color;
    float falloff = square_attenuation(d2, inverse, light.inverse_reach2);
    if ((WAYS & LIGHTS_CONE) != 0u && color.w > -1.5) {  // the cosine of the outer cone
        const vec4 axis = light.axis;
        falloff *= spot_attenuation(dot(axis.xyz, -l), axis.w, color.w);
    }
    vec3 shines = color.rgb;
    if ((WAYS & (LIGHTS_PROFILE | LIGHTS_LANTERN)) != 0u) shines *= light_profile(light, -l, sqrt(d2));
    const vec3 radiance = shadowed_light(p, l, visible) * shines * falloff;
    return lit ? radiance : vec3(0.0);
}

const bool ONE_RANGE = ((WAYS & LIGHTS_SHADOWED) != 0u ? 1u : 0u) + ((WAYS & LIGHTS_SHADOWED_SHAPED) != 0u ? 1u : 0u) +
                           ((WAYS & LIGHTS_PLAIN) != 0u ? 1u : 0u) + ((WAYS & LIGHTS_SHAPED) != 0u ? 1u : 0u) == 1u;

const bool ONE_WORD = (WAYS & LIGHTS_ONE_WORD) != 0u;

// The lowest so many bits of 32.
uint low_bits(uint count)
{
    return count < 32u ? (1u << count) - 1u : ~0u;
}

// The i-th word of a tile's list: its number and those bits that are of a range; beyond the last none.
uvec2 listed_word(int list, int words, int i, uint first, uint end)
{
    uvec2 word = texelFetch(light_lists, list + min(i, max(words, 1))).rg;
    const uint low = word.r * 32u;
    if (!ONE_RANGE) word.g &= low_bits(max(end, low) - low) & ~low_bits(max(first, low) - low);
    return i <= words ? word : uvec2(0u);
}

// Adds those of a range of the table that reach this tile, in their order: eight at a time from two words of the list, of
// which each invocation reads one and asks whether it may light any of the group.
void add_range_together(inout vec3 radiance, LitPoint p, LitGroup group, ivec2 texel, int list, uint first, uint end,
                        const bool shadowed, const bool shaped)
{
    const int words = int(texelFetch(light_lists, list).r);
    const uint lane = gl_SubgroupInvocationID;
    uvec2 here = listed_word(list, words, 1, first, end);
    uvec2 next = ONE_WORD ? uvec2(0u) : listed_word(list, words, 2, first, end);
    int i = 3;
    // Loops that ask at their end: a CPU takes one that asks at its beginning once more, for nobody.
    do {
        const uint count = ONE_WORD ? LIGHTS_AT_ONCE : uint(bitCount(here.g));
        const bool of_next = lane >= count;
        const uvec2 mine = of_next ? next : here;
        const uint own = without_lowest(mine.g, of_next ? lane - count : lane);
        const LightRow row = light_row(int(mine.r * 32u) + max(findLSB(own), 0));
        bool may = own != 0u;
        if (SIFTED) may = may && may_light(group, row, shadowed, shaped);
        // What is left of the two words.
        const bool spare = count >= LIGHTS_AT_ONCE;
        const uvec2 last = spare ? here : next;
        here = uvec2(last.r, without_lowest(last.g, spare ? LIGHTS_AT_ONCE : LIGHTS_AT_ONCE - count));
        if (!ONE_WORD) {
            const uvec2 later = listed_word(list, words, i, first, end);
            next = spare ? next : later;
            i += spare ? 0 : 1;
        }
        uint rest = group_or(may ? 1u << lane : 0u);
        do {
            const LightRow light = row_of_lane(row, uint(max(findLSB(rest), 0)));
            if (rest != 0u) radiance += punctual_light(p, light, texel, shadowed, shaped);
            rest &= rest - 1u;
        } while (rest != 0u);
    } while ((here.g | next.g) != 0u || (!ONE_WORD && !ONE_RANGE && i <= words));
}

// Adds those of a range of the table that reach this tile, in their order.
void add_range(inout vec3 radiance, LitPoint p, LitGroup group, ivec2 texel, uint first, uint end, const bool shadowed,
               const bool shaped)
{
    if (ALL_LIGHTS != 0u) {
        for (uint i = first; i < end; ++i) radiance += punctual_light(p, light_row(int(i)), texel, shadowed, shaped);
        return;
    }
    const ivec2 tile = texel / LIGHT_TILE;
    const int list = (tile.y * frame.light_tiles.x + tile.x) * int(frame.light_words + 1u);
    if (TOGETHER) {
        add_range_together(radiance, p, group, texel, list, first, end, shadowed, shaped);
        return;
    }
    const int words = int(texelFetch(light_lists, list).r);
    for (int i = 1; i <= words; ++i) {
        const uvec2 word = listed_word(list, words, i, first, end);
        for (uint bits = word.g; bits != 0u; bits &= bits - 1u)
            radiance += punctual_light(p, light_row(int(word.r * 32u) + findLSB(bits)), texel, shadowed, shaped);
    }
}

// Adds lights far away, then those that reach this tile, in the order of the table.
//   there   a surface is shown here
void add_all_lights(inout vec3 radiance, LitPoint p, bool there, ivec2 texel)
{
    for (uint i = 0u; i < ((WAYS & LIGHTS_FAR) != 0u ? frame.directional_count : 0u); ++i) {
        const LightRow light = light_row(int(i));
        float visible = 1.0;
        if (MASKED) visible = received_from(masked(visible, shadow_of(light)), shadow_of(light), p);
        radiance += shadowed_light(p, -light.axis.xyz, visible) * light.color.rgb;
    }
    LitGroup group;
    if (SIFTED) group = group_of(p.position, p.normal, there);
    if ((WAYS & LIGHTS_SHADOWED) != 0u)
        add_range(radiance, p, group, texel, frame.directional_count, frame.shaped_shadows, true, false);
    if ((WAYS & LIGHTS_SHADOWED_SHAPED) != 0u)
        add_range(radiance, p, group, texel, frame.shaped_shadows, frame.plain_lights, true, true);
    if ((WAYS & LIGHTS_PLAIN) != 0u)
        add_range(radiance, p, group, texel, frame.plain_lights, frame.shaped_lights, false, false);
    if ((WAYS & LIGHTS_SHAPED) != 0u)
        add_range(radiance, p, group, texel, frame.shaped_lights, frame.light_count, false, true);
}

// .. so much of them.
void add_lights(inout vec3 radiance, LitPoint p, float share, bool there, ivec2 texel)
{
    vec3 lamps = BAKED != 0u ? vec3(0.0) : radiance;
    add_all_lights(lamps, p, there, texel);
    radiance = BAKED != 0u ? radiance + lamps * share : lamps;
}
