// Lamps that have a size, and what materials have beside their lobes. Included by the lighting pass behind
// model_light(); all of it is left out where nothing in the picture asks for it.
#ifndef PETRICHOR_AREA_LIGHTS_GLSL
#define PETRICHOR_AREA_LIGHTS_GLSL

#include "gpu/passes/lighting/light_profile.glsl"

// Something answers to light from behind.
const bool BLEEDS = (LAYERS & (LAYERS_TRANSLUCENT | LAYERS_SKIN)) != 0u;

vec3 skin_lookup(float nl, float curvature)
{
    const float last = float(SKIN_TABLE_SIDE - 1);
    const vec2 at = clamp(vec2(0.5 * nl + 0.5, curvature), vec2(0.0), vec2(1.0)) * last;
    const vec2 low = min(floor(at), vec2(last - 1.0));
    const vec2 part = at - low;
    const int first = int(low.y) * SKIN_TABLE_SIDE + int(low.x);
    const vec3 a = mix(texelFetch(skin_table, first).rgb, texelFetch(skin_table, first + 1).rgb, part.x);
    const vec3 b = mix(texelFetch(skin_table, first + SKIN_TABLE_SIDE).rgb,
                       texelFetch(skin_table, first + SKIN_TABLE_SIDE + 1).rgb, part.x);
    return mix(a, b, part.y);
}

// What of sun or a lamp is seen, of materials that receive no shadows all.
float received(float visible, LitPoint p)
{
    return ((WAYS & LIGHTS_UNSHADOWED) != 0u || USES_unlit_shadowed != 0u) && p.unshadowed ? 1.0 : visible;
}

// What of a shadow falls on the light that skin carries past its terminator: none. All that is turned away
// lies in its own shadow, and would end where the light begins to bleed.
float shadow_on_model(LitPoint p, float nl, float visible)
{
    const bool bleeds = (LAYERS & LAYERS_SKIN) != 0u && p.curvature > 0.0 && nl < 0.0;
    return bleeds ? 1.0 : visible;
}

// .. and on what comes through: closed things are in their own shadow behind; towards their terminator it
// comes on by and by.
float shadow_on_glow(LitPoint p, float nl, float visible)
{
    return shadow_through(p.translucency, nl > 0.0 ? visible * min(4.0 * nl, 1.0) : visible);
}

// The answer of the surface below its film of water, and the film's.
vec3 filmed_light(LitPoint p, vec3 l)
{
    const vec3 below = model_light(p, l);
    if (FILM == 0u) return below;
    return under_film(below, p.film, p.view, l);
}

// The answer to a light of which so much is seen, and what comes through.
vec3 shadowed_light(LitPoint p, vec3 l, float visible)
{
    const float nl = dot(p.normal, l);
    vec3 radiance = filmed_light(p, l) * shadow_on_model(p, nl, visible);
    if (BLEEDS && p.translucency.strength > 0.0) {
        radiance += p.translucency.color * (light_through(p.translucency, p.normal, p.view, l) *
                                            shadow_on_glow(p, nl, visible));
    }
    return radiance;
}

vec4 ltc_matrix(float roughness, float nv)
{
    const float last = float(LTC_TABLE_SIDE - 1);
    const vec2 at = ltc_place(roughness, nv) * last;
    const vec2 low = min(floor(at), vec2(last - 1.0));
    const vec2 part = at - low;
    const int first = int(low.x) * LTC_TABLE_SIDE + int(low.y);
    const vec4 a = mix(texelFetch(ltc_matrices, first), texelFetch(ltc_matrices, first + 1), part.y);
    const vec4 b = mix(texelFetch(ltc_matrices, first + LTC_TABLE_SIDE),
                       texelFetch(ltc_matrices, first + LTC_TABLE_SIDE + 1), part.y);
    return mix(a, b, part.x);
}

// Where the shadows of a lamp begin.
float light_near_m(LightRow light)
{
    return in_lantern(light) ? LANTERN_HALF_M : LAMP_MAP_NEAR_M;
}

// What facets of a lobe send on to each other, so much of it, beside another lobe.
Lobe with_again_of(Lobe lobe, Lobe from, float share)
{
    lobe.again = from.again * share;
    lobe.steep = from.steep * share;
    lobe.loss = from.loss;
    return lobe;
}

// The same surface without its highlight, but for what goes on between facets.
//   highlight  share of it
LitPoint matt_part(LitPoint p, float highlight)
{
    LitPoint q = p;
    q.specular = vec3(0.0);
    q.lobe = with_again_of(make_lobe(p.normal, p.view, p.diffuse * (1.0 - p.layers.transmitted), vec3(0.0),
                                     p.roughness * p.roughness), p.lobe, highlight);
    q.second.lobe.again *= highlight;
    q.second.lobe.steep *= highlight;
    q.second.lobe.lit = 0.0;
    q.second.lobe.f0 = vec3(0.0);
    return q;
}

// A lobe of GGX is what the model mirrors.
bool mirrors_as_ggx(uint model)
{
    return model == uint(LIGHTING_MODEL_STANDARD) || model == uint(LIGHTING_MODEL_LAYERED) ||
           model == uint(LIGHTING_MODEL_BURLEY) || model == uint(LIGHTING_MODEL_SKIN);
}

// How much of a glowing surface is a highlight here. The pass of reflections shows the rest, as far as it shows
// the picture: sharp mirrors see the pane itself.
float glow_highlight(float roughness)
{
    return IMAGE_BASED_LIGHT != 0u && PICTURE != 0u ? glow_share(roughness) : 1.0;
}

// Of a light that tells its share of highlights: LIGHT_GLOWS as a surface that glows.
float highlight_share(float told, float roughness)
{
    return told < 0.0 ? glow_highlight(roughness) : told;
}

// Once for all lamps.
ShapedLobes shaped_lobes(LitPoint p)
{
    ShapedLobes lobes;
    if ((WAYS & LIGHTS_LTC) != 0u || RECTANGLES != 0u) {
        lobes.surface = surface_frame(p.normal, p.view);
        const vec3 n = p.lobe.normal;
        const float nv = clamp(dot(n, p.view), 0.0, 1.0);
        if (TWO_LOBES) {
            const vec3 other = p.second.lobe.normal;
            lobes.lobe = lobe_frame(surface_frame(n, p.view), ltc_matrix(p.roughness, nv));
            lobes.second_lobe = lobe_frame(surface_frame(other, p.view), ltc_matrix(p.second.roughness, clamp(dot(other, p.view), 0.0, 1.0)));
            lobes.second_sum = split_sum(other, p.view, p.second.roughness);
        } else {
            lobes.lobe = lobe_frame(lobes.surface, ltc_matrix(p.roughness, nv));
        }
        lobes.split_sum = split_sum(n, p.view, p.roughness);
    }
    if (FILM != 0u && ((WAYS & LIGHTS_LTC) != 0u || RECTANGLES != 0u)) {
        const float nv = clamp(dot(p.film.normal, p.view), 0.0, 1.0);
        const vec2 sum = split_sum(p.film.normal, p.view, p.film.roughness);
        lobes.film = lobe_frame(surface_frame(p.film.normal, p.view), ltc_matrix(p.film.roughness, nv));
        lobes.film_keeps = 1.0 - p.film.share * water_fresnel(nv);
        lobes.film_mirrors = (kWaterF0 * sum.x + sum.y) * p.film.share;
    }
    return lobes;
}

// What the surface below answers to a shape, and the film's highlight.
//   in_film  the shape's irradiance where the film's lobe is a cosine
//   l        towards the middle of what is seen
vec3 film_over(LitPoint p, vec3 in_film, vec3 l, vec3 below, float highlight)
{
    return below * ((1.0 - p.film.share * water_fresnel(dot(p.film.normal, l))) * p.shaped.film_keeps) +
           vec3(p.shaped.film_mirrors * (cosine_share(in_film) * highlight * p.film.lit));
}

// What a lobe mirrors of all around, with what goes along it from facet to facet.
vec3 mirrored_in_all(vec3 f0, Lobe lobe, vec2 sum)
{
    return mirrored_by(f0, sum) + lobe.again * (lobe.loss.along * sqrt(lost_at(lobe.loss, lobe.nv)) * (sum.x + sum.y));
}

// Whence most of that comes which a lobe mirrors of a shape, from its irradiance where the lobe is a cosine.
vec3 toward_lobe(Frame3 lobe, vec3 in_lobe)
{
    const vec3 toward = cross(lobe.y, lobe.z) * in_lobe.x + cross(lobe.z, lobe.x) * in_lobe.y + cross(lobe.x, lobe.y) * in_lobe.z;
    return normalize(toward * (dot(lobe.x, cross(lobe.y, lobe.z)) < 0.0 ? -1.0 : 1.0));
}

// With the colour of a thin film there.
LitPoint filmed_in_lobe(LitPoint p, vec3 in_lobe)
{
    if ((LAYERS & LAYERS_IRIDESCENT) == 0u) return p;
    return dot(in_lobe, in_lobe) > 1.0e-14 ? filmed_toward(p, toward_lobe(p.shaped.lobe, in_lobe)) : p;
}

// Highlight of GGX's lobes of a shape that glows or is a lamp.
//   in_lobe    its irradiance where the lobe is a cosine
//   in_second  the same of the second lobe; counts where there is one
vec3 shape_highlight(LitPoint p, vec3 in_lobe, vec3 in_second, float highlight)
{
    const float nv = clamp(dot(p.normal, p.view), 0.0, 1.0);
    const float kept = 1.0 - p.layers.coat * coat_fresnel(nv);
    vec3 mirrored = mirrored_in_all(p.specular, p.lobe, p.shaped.split_sum) * cosine_share(in_lobe);
    if (TWO_LOBES) {
        const vec3 other = mirrored_in_all(p.specular, p.second.lobe, p.shaped.second_sum) * cosine_share(in_second);
        mirrored = mix(mirrored, other, p.second.share);
    }
    return mirrored * (highlight * kept);
}

// By linearly transformed cosines. Highlights of other shapes than GGX's, of coats, fibres and hair, are
// those of a light in the direction of the irradiance, blurred by its size.
vec3 shape_light(LitPoint p, Outline o, float highlight, float visible)
{
    const float specular = highlight_share(highlight, p.roughness);
    const Frame3 surface = p.shaped.surface;
    const vec3 f = outline_irradiance(o, surface);
    const float size = length(f);
    if (size < 1.0e-7) return vec3(0.0);
    const float seen = cosine_share(f);
    const vec3 to_it = (surface.x * f.x + surface.y * f.y + surface.z * f.z) / size;
    // Where the horizon cuts it, from the middle of what is left.
    const float wide = sqrt(min(size, 1.0));
    const float nl = dot(p.normal, to_it);
    const float cosine = max(nl, 0.25 * wide);
    vec3 l = to_it;
    if (cosine > nl) l = normalize(l + p.normal * (cosine - nl));
    const float irradiance = kPi * seen / max(dot(p.normal, l), 1.0e-3);
    const bool ggx = mirrors_as_ggx(p.model) && p.layers.anisotropy <= 0.0;
    const float alpha = min(p.roughness * p.roughness + 0.5 * wide, 1.0);
    LitPoint q = matt_part(p, highlight < 0.0 ? 1.0 : highlight);
    if (!ggx) {
        q.roughness = sqrt(alpha);
        q.specular = p.specular * specular;
        q.lobe = with_again_of(make_lobe(p.normal, p.view, p.diffuse * (1.0 - p.layers.transmitted), q.specular, alpha), q.lobe, 1.0);
    }
    if (p.layers.coat > 0.0) {
        const float coat = p.layers.coat_roughness * p.layers.coat_roughness;
        q.layers.coat_roughness = sqrt(min(coat + 0.5 * wide, 1.0));
        q.layers.coat_spared = 1.0 - highlight_share(highlight, p.layers.coat_roughness);
    }
    vec3 radiance = model_light(q, l) * irradiance;
    if (p.layers.transmitted > 0.0) {
        radiance += p.layers.through * (p.layers.transmitted * cosine_share(vec3(f.xy, -f.z)));
    }
    if (ggx && p.lobe.lit > 0.0 && specular > 0.0) {
        vec3 in_second = vec3(0.0);
        if (TWO_LOBES) in_second = outline_irradiance(o, p.shaped.second_lobe);
        const vec3 in_lobe = outline_irradiance(o, p.shaped.lobe);
        radiance += shape_highlight(filmed_in_lobe(p, in_lobe), in_lobe, in_second, specular);
    }
    if (FILM != 0u)
        radiance = film_over(p, outline_irradiance(o, p.shaped.film), l, radiance, highlight_share(highlight, p.film.roughness));
    radiance *= visible;
    if (BLEEDS && p.translucency.strength > 0.0) {
        radiance += p.translucency.color * (light_through(p.translucency, p.normal, p.view, to_it) *
                                            shadow_on_glow(p, nl, visible) * kPi * size);
    }
    if ((LAYERS & LAYERS_SKIN) != 0u && p.curvature > 0.0) {
        // Its diffuse part by the middle of the light, past the horizon too.
        radiance += p.lobe.diffuse * (kPi * size) *
                    (skin_lookup(nl, p.curvature) * shadow_on_model(p, nl, visible) -
                     skin_lookup(dot(p.normal, l), p.curvature) * (visible * seen / (size * max(dot(p.normal, l), 1.0e-3))));
    }
    return radiance;
}

// From the point that is nearest to what is mirrored, as Lux 2.02: `strength` is that of the middle.
vec3 nearest_area_light(LitPoint p, vec3 centre, vec3 half_axis, vec4 size, vec3 strength, float visible)
{
    const vec3 mirrored = reflect(-p.view, p.lobe.normal);
    const float alpha = max(p.roughness * p.roughness, 0.05);
    const NearestLight at = nearest_light(centre, half_axis, size.x, mirrored, alpha);
    LitPoint bright = p;
    bright.albedo = vec3(0.0);
    bright.diffuse = vec3(0.0);
    bright.layers.sheen = vec3(0.0);
    bright.layers.through = vec3(0.0);
    bright.roughness = sqrt(alpha);
    bright.lobe = make_lobe(p.lobe.normal, p.view, vec3(0.0), p.specular, alpha);
    const float highlight = highlight_share(size.z, p.roughness);
    LitPoint matt = matt_part(p, highlight);
    matt.layers.coat_spared = 1.0;  // the bright part has the coat's
    if (GATHERS != 0u && p.gathers == GATHERS_DIFFUSE) bright.gathers = GATHERS_REST;
    if (GATHERS != 0u && p.gathers == GATHERS_SPECULAR) matt.gathers = GATHERS_REST;
    return (shadowed_light(matt, nearest_on_axis(centre, half_axis), visible) +
            model_light(bright, at.direction) * (at.energy * highlight * visible)) *
           strength;
}

// A lamp with a size: `size` is its texel 4.
vec3 area_light(LitPoint p, LightRow light, vec3 centre, float reach_m, vec4 size, float visible)
{
    const vec4 color = light.color;
    const vec4 axis = light.axis;
    const vec3 across = light.across.xyz;
    const float far = length(centre);
    const vec3 l = centre / max(far, 1.0e-4);
    const bool spot = color.w > -1.5;
    float cone = 1.0;
    if (spot) cone = spot_attenuation(dot(axis.xyz, -l), axis.w, color.w);
    vec3 shines = color.rgb * cone;
    if ((WAYS & (LIGHTS_PROFILE | LIGHTS_LANTERN)) != 0u) shines *= light_profile(light, -l, far);
    const vec3 half_axis = spot ? vec3(0.0) : across * size.y;
    if ((WAYS & LIGHTS_NEAREST) != 0u) {
        return nearest_area_light(p, centre, half_axis, size,
                                  shines * light_attenuation(far, reach_m), visible);
    }
    Outline o;
    if (color.w < LIGHT_POINT - 0.5) {
        vec3 half_v = across;
        if (dot(centre, cross(axis.xyz, half_v)) >= 0.0) {  // it is turned away
            if (color.w > LIGHT_BOTH_SIDES + 0.5) return vec3(0.0);
            half_v = -half_v;
        }
        o = rectangle_outline(centre, axis.xyz, half_v);
    } else if (spot) {
        if (dot(centre, axis.xyz) >= 0.0) return vec3(0.0);
        o = disc_outline(centre, across * size.x, cross(axis.xyz, across) * size.x);
    } else {
        o = tube_outline(centre - half_axis, centre + half_axis, size.x);
    }
    const float q = far / reach_m;
    const float window = clamp(1.0 - q * q * q * q, 0.0, 1.0);
    return shape_light(p, o, size.z, visible) * shines * window;
}

// A glowing rectangle: exact for a matt surface that sees all of it; mirrored by linearly transformed cosines, in
// lobes of GGX and in a film of water. Other lobes mirror it as a light in the direction of the irradiance, blurred by
// its size.
vec3 rectangle_light(LitPoint p, LightRow light, vec3 centre, vec4 color)
{
    const vec3 half_u = light.axis.xyz;
    vec3 half_v = light.across.xyz;
    if (dot(centre, cross(half_u, half_v)) >= 0.0) {  // it is turned away
        if (color.w > LIGHT_BOTH_SIDES + 0.5) return vec3(0.0);
        half_v = -half_v;
    }
    const vec3 f = rectangle_irradiance(centre, half_u, half_v);
    const float size = length(f);
    if (size < 1.0e-7) return vec3(0.0);
    vec3 l = f / size;
    const float nl = dot(p.normal, l);
    const float seen = sphere_form_factor(size, nl);
    if (seen <= 0.0) return vec3(0.0);
    // Where the horizon cuts it, from the middle of what is left.
    const float wide = sqrt(min(size, 1.0));
    const float cosine = max(nl, 0.25 * wide);
    if (cosine > nl) l = normalize(l + p.normal * (cosine - nl));
    const float alpha = p.roughness * p.roughness;
    const float blurred = min(alpha + 0.5 * wide, 1.0);
    const bool ggx = mirrors_as_ggx(p.model) && p.layers.anisotropy <= 0.0;
    const float highlight = glow_highlight(p.roughness);
    LitPoint q = matt_part(p, 1.0);
    if (!ggx) {
        q.roughness = sqrt(blurred);
        q.specular = p.specular * highlight;
        q.lobe = with_again_of(make_lobe(p.normal, p.view, p.diffuse * (1.0 - p.layers.transmitted), q.specular,
                                         blurred), q.lobe, 1.0);
    }
    if (p.layers.coat > 0.0) {
        const float coat = p.layers.coat_roughness * p.layers.coat_roughness;
        q.layers.coat_roughness = sqrt(min(coat + 0.5 * wide, 1.0));
        q.layers.coat_spared = 1.0 - glow_highlight(p.layers.coat_roughness);
    }
    vec3 radiance = model_light(q, l) * (kPi * seen / max(dot(p.normal, l), 1.0e-3));
    if (ggx && p.lobe.lit > 0.0 && highlight > 0.0) {
        const vec3 in_lobe = rectangle_irradiance(through(p.shaped.lobe, centre), through(p.shaped.lobe, half_u),
                                                  through(p.shaped.lobe, half_v));
        vec3 in_second = vec3(0.0);
        if (TWO_LOBES)
            in_second = rectangle_irradiance(through(p.shaped.second_lobe, centre), through(p.shaped.second_lobe, half_u),
                                             through(p.shaped.second_lobe, half_v));
        radiance += shape_highlight(filmed_in_lobe(p, in_lobe), in_lobe, in_second, highlight);
    }
    const float q2 = dot(centre, centre) * light.inverse_reach2;
    const vec3 shines = color.rgb * clamp(1.0 - light.size.y * q2 * q2, 0.0, 1.0);
    if (FILM == 0u) return radiance * shines;
    const vec3 in_film = rectangle_irradiance(through(p.shaped.film, centre), through(p.shaped.film, half_u),
                                              through(p.shaped.film, half_v));
    return film_over(p, in_film, l, radiance, glow_highlight(p.film.roughness)) * shines;
}

// Place of the surface that a neighbour sees; the own one where it sees none.
vec3 place_beside(ivec2 texel, ivec2 offset, vec3 own)
{
    const ivec2 at = clamp(texel + offset, ivec2(0), frame.size - 1);
    const float depth = texelFetch(depth_rows, row_texel(at, frame.size)).r;
    return depth > 0.0 ? pixel_position(frame, vec2(at) + 0.5, depth) : own;
}

// Change of the normal a metre, from the pixels beside: of skin that has no map of it.
float seen_curvature(ivec2 texel, vec3 position, vec3 normal)
{
    float bends = 0.0;
    for (int k = 0; k < 2; ++k) {
        const ivec2 offset = k == 0 ? ivec2(1, 0) : ivec2(0, 1);
        const ivec2 at = clamp(texel + offset, ivec2(0), frame.size - 1);
        const vec3 way = place_beside(texel, offset, position) - position;
        const vec3 other = octahedral_decode(texelFetch(gbuffer_normals, row_texel(at, frame.size)).xy);
        const float apart = length(way);
        // Not over an edge.
        if (apart > 0.0 && apart < 0.05) bends = max(bends, length(other - normal) / apart);
    }
    return bends;
}

// The rows of a material behind those of coat, sheen and anisotropy. glow: what weather leaves of light from
// within.
void later_layers(inout LitPoint p, int at, LayerShares share, float first_share, float metallic, float bare, float open,
                  float glow, float view_m, ivec2 texel)
{
    const vec4 third = texelFetch(layers_table, at + 2);
    const vec4 sixth = texelFetch(layers_table, at + 5);
    if ((LAYERS & LAYERS_SCATTER) != 0u) {
        const float nv = clamp(dot(p.normal, p.view), 0.0, 1.0);
        const vec4 seventh = texelFetch(layers_table, at + 6);
        // Of two sets each by its share, as Lux mixes all three.
        const float first = seventh.w > 0.0 ? first_share : 1.0;
        const vec3 color = mix(texelFetch(layers_table, at + 7).rgb, sixth.rgb, first);
        const vec2 shape = mix(seventh.yz, third.yz, first);
        p.albedo = scattered_albedo(p.albedo, color * ((1.0 - metallic) * open), shape.x, shape.y, nv);
        p.diffuse = p.albedo *
                    (1.0 - max(p.specular.r, max(p.specular.g, p.specular.b)));
    }
    float near = 1.0;
    if ((LAYERS & LAYERS_SKIN) != 0u && p.model == uint(LIGHTING_MODEL_SKIN)) {
        // At 20 m it is the standard model.
        near = clamp((20.0 - view_m) / 8.0, 0.0, 1.0);
        const float scale = texelFetch(layers_table, at + 6).x;
        float curvature = sixth.w * share.curvature;
        if (scale > 0.0) curvature += scale * seen_curvature(texel, p.position, p.normal);
        p.curvature = clamp(curvature, 0.0, 1.0) * near * bare;
    }
    if ((LAYERS & LAYERS_HAIR) != 0u) p.hair_shift = third.w;
    if ((LAYERS & LAYERS_TRANSLUCENT) != 0u) {
        const vec4 fourth = texelFetch(layers_table, at + 3);
        const vec4 fifth = texelFetch(layers_table, at + 4);
        const bool skin = p.model == uint(LIGHTING_MODEL_SKIN);
        p.translucency = Translucency(fourth.x * glow * near * share.translucency * first_share, fourth.y, fourth.z, fourth.w, fifth.w,
                                      skin ? fifth.rgb : fifth.rgb * p.diffuse);
    }
}

// What this sample of an anisotropic surface mirrors.   bent: what it does without chance
vec3 grained_mirror(LitPoint p, vec3 bent, float view_m, ivec2 texel)
{
    const float wide = grain_alpha(p.roughness * p.roughness, p.layers.anisotropy) * frame.grain_dither.x;
    const ivec2 pixel = picture_pixel(texel);
    const vec2 chance = vec2(dither(pixel, frame.sample_index), fract(dither(pixel.yx + 37, 0u) + 0.5698403 * float(frame.sample_index)));
    const float slope = seen_slope(chance, wide, vec2(dot(p.view, p.layers.tangent), dot(p.view, p.normal)));
    const vec3 drawn = grain_normal(p.normal, p.layers.tangent, p.view, slope);
    const float share = grain_share(frame.grain_dither, view_m);
    return share <= 0.0 ? bent : normalize(mix(bent, drawn, share));
}

// What of the mirrored sky the mesh itself hides, though the normal map would show it (Russell 2014; with
// the fade of Lux 2.02).
float horizon_occlusion(LitPoint p, vec3 mirror_normal, ivec2 texel)
{
    const vec3 right = place_beside(texel, ivec2(1, 0), p.position) - p.position;
    const vec3 left = p.position - place_beside(texel, ivec2(-1, 0), p.position);
    const vec3 down = place_beside(texel, ivec2(0, 1), p.position) - p.position;
    const vec3 up = p.position - place_beside(texel, ivec2(0, -1), p.position);
    // The nearer neighbour of each pair lies on the same surface.
    const vec3 u = dot(right, right) < dot(left, left) || dot(left, left) == 0.0 ? right : left;
    const vec3 v = dot(down, down) < dot(up, up) || dot(up, up) == 0.0 ? down : up;
    vec3 flat_normal = cross(v, u);
    const float size = length(flat_normal);
    if (size < 1.0e-12) return 1.0;
    flat_normal /= size;
    if (dot(flat_normal, p.view) < 0.0) flat_normal = -flat_normal;
    return clamp(1.0 + frame.horizon_fade * dot(reflect(-p.view, mirror_normal), flat_normal), 0.0, 1.0);
}

#endif
