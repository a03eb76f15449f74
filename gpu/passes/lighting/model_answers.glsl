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

vec3 model_light(LitPoint p, vec3 to_light)
{
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
