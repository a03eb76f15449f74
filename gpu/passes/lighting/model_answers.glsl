// What the lighting models answer, by the number of the surface's.

// Numbers from here on mean a model and layers.
const uint LIGHTING_MODEL_COUNT = 0u
#define ROW(number_, name_) + 1u
LIGHTING_MODELS(ROW)
#undef ROW
;

// The answer of the surface's model. A model that nothing in the picture has is not compiled.
const bool ONE_MODEL = (0u
#define ROW(number_, name_) + USES_##name_
LIGHTING_MODELS(ROW)
#undef ROW
) == 1u;

bool model_gathers(uint model)
{
    bool gathers = false;
#define ROW(number_, name_) gathers = gathers || model == uint(number_);
    GATHERING_LIGHTING_MODELS(ROW)
#undef ROW
    return gathers;
}

vec3 model_compose(LitPoint p, LightSum sum)
{
    vec3 radiance = vec3(0.0);
#define ROW(number_, name_)                                                \
    if (USES_##name_ != 0u && p.model == uint(number_)) {                  \
        radiance = name_##_compose(p, sum);                                \
    }
    GATHERING_LIGHTING_MODELS(ROW)
#undef ROW
    return radiance;
}

// One part of what a light adds to the sum.
vec3 model_gather(LitPoint p, vec3 to_light)
{
    LightSum one = LightSum(vec3(0.0), vec3(0.0));
    if (p.gathers == GATHERS_REST) return vec3(0.0);
#define ROW(number_, name_)                                                \
    if (USES_##name_ != 0u && p.model == uint(number_)) {                  \
        one = name_##_gather(p, to_light);                                 \
    }
    GATHERING_LIGHTING_MODELS(ROW)
#undef ROW
    return p.gathers == GATHERS_DIFFUSE ? one.diffuse : one.specular;
}

// Of what facets send on to each other: a film's colour there is the mean over all cosines.
vec3 sent_on_f0(LitPoint p, vec3 f0)
{
    if ((LAYERS & LAYERS_IRIDESCENT) == 0u || p.thin_film.share <= 0.0) return f0;
    const float seen = clamp(dot(p.normal, p.view), 0.02, 1.0);
    return clamp(f0 + filmed_mean_f0(p.thin_film) - filmed_f0(p.thin_film, seen), vec3(-0.05), vec3(1.0));
}

// A thin film as a light shows it that comes from there: coloured by the half vector. What is left to be scattered goes by it.
// What facets send on to each other has its own colour already.
LitPoint filmed_toward(LitPoint p, vec3 to_light)
{
    if ((LAYERS & LAYERS_IRIDESCENT) == 0u) return p;
    const float seen = clamp(dot(p.normal, p.view), 0.02, 1.0);
    const float asked = clamp(sqrt(0.5 + 0.5 * dot(p.view, to_light)), 0.02, 1.0);
    const vec3 change = p.thin_film.share > 0.0 ? filmed_f0(p.thin_film, asked) - filmed_f0(p.thin_film, seen) : vec3(0.0);
    const vec3 before = p.specular;
    // Without a highlight it stays so.
    if (before.r + before.g + before.b > 0.0) p.specular = clamp(before + change, vec3(0.0), vec3(1.0));
    p.lobe.f0 = p.lobe.lit > 0.0 ? clamp(p.lobe.f0 + change, vec3(0.0), vec3(1.0)) : p.lobe.f0;
    p.second.lobe.f0 = p.second.lobe.lit > 0.0 ? clamp(p.second.lobe.f0 + change, vec3(0.0), vec3(1.0)) : p.second.lobe.f0;
    const float left = (1.0 - max(p.specular.r, max(p.specular.g, p.specular.b))) /
                       max(1.0 - max(before.r, max(before.g, before.b)), 1.0e-3);
    p.diffuse *= left;
    p.lobe.diffuse *= left;
    p.layers.through *= left;
    return p;
}

vec3 model_light(LitPoint p, vec3 to_light)
{
    if (USES_unlit_shadowed != 0u && p.gathers == GATHERS_FALLING) return vec3(max(dot(p.normal, to_light), 0.0));
    p = filmed_toward(p, to_light);
    if (GATHERS != 0u && p.gathers != GATHERS_NOTHING_FIRST) return model_gather(p, to_light);
    vec3 radiance = vec3(0.0);
#define ROW(number_, name_)                                                \
    if (USES_##name_ != 0u && (ONE_MODEL || p.model == uint(number_))) {   \
        radiance = name_##_light(p, to_light);                             \
    }
    LIGHTING_MODELS(ROW)
#undef ROW
    return radiance;
}

Reflected model_surround(LitPoint p, Surroundings s)
{
    Reflected reflected = Reflected(vec3(0.0), vec3(0.0));
#define ROW(number_, name_)                                                \
    if (USES_##name_ != 0u && (ONE_MODEL || p.model == uint(number_))) {   \
        reflected = name_##_surround(p, s);                                \
    }
    LIGHTING_MODELS(ROW)
#undef ROW
    return reflected;
}

vec3 model_own(LitPoint p)
{
    vec3 radiance = vec3(0.0);
#define ROW(number_, name_)                                                \
    if (USES_##name_ != 0u && (ONE_MODEL || p.model == uint(number_))) {   \
        radiance = name_##_own(p);                                         \
    }
    LIGHTING_MODELS(ROW)
#undef ROW
    return radiance;
}
