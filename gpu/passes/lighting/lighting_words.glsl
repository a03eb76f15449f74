// Light of the sky and the probes, read by all lanes of a CPU at once (gpu/frame/lane_words.glsl). Their arrays are asked
// with numbers for indices alone, so that they are values.
#ifndef PETRICHOR_LIGHTING_WORDS_GLSL
#define PETRICHOR_LIGHTING_WORDS_GLSL

const int kSkyLightWords = 62;
const int kProbeWords = 48;

layout(binding = LIGHTING_SKY_LIGHT, scalar) uniform Sky { SkyLight sky_block; };
layout(binding = LIGHTING_SKY_LIGHT, scalar) uniform SkyWords { uint sky_words[kSkyLightWords]; };
layout(binding = LIGHTING_PROBES, scalar) uniform Probes { ProbeSpread probes_block[LIGHTING_MOST_PROBES]; };
layout(binding = LIGHTING_PROBES, scalar) uniform ProbeWords { uint probe_words[LIGHTING_MOST_PROBES * kProbeWords]; };
SkyLight sky_light;
ProbeSpread probes[LIGHTING_MOST_PROBES];

LANE_WORDS(sky, kSkyLightWords)
LANE_WORDS(probe, LIGHTING_MOST_PROBES * kProbeWords)

void read_sky_light()
{
    if (LANES == 0u) {
        sky_light = sky_block;
        return;
    }
    int at = 0;
#define BAND(K) sky_take(at, sky_light.harmonics[K]);
    BAND(0) BAND(1) BAND(2) BAND(3) BAND(4) BAND(5) BAND(6) BAND(7) BAND(8)
#undef BAND
#define AXIS(K) sky_take(at, sky_light.missed[K]);
    AXIS(0) AXIS(1) AXIS(2) AXIS(3) AXIS(4) AXIS(5)
#undef AXIS
    sky_take(at, sky_light.exposure);
    sky_take(at, sky_light.illuminance);
}

void probe_take(inout int at, out ProbeSpread v)
{
    probe_take(at, v.centre);
    probe_take(at, v.low);
    probe_take(at, v.high);
#define BAND(K) probe_take(at, v.bands[K]);
    BAND(0) BAND(1) BAND(2) BAND(3) BAND(4) BAND(5) BAND(6) BAND(7) BAND(8)
#undef BAND
}

// As many as there are.
void read_probes()
{
    if (LANES == 0u) {
        probes = probes_block;
        return;
    }
    int at = 0;
#define PROBE(I) if (PROBES > uint(I)) probe_take(at, probes[I]);
    PROBE(0) PROBE(1) PROBE(2) PROBE(3) PROBE(4) PROBE(5) PROBE(6) PROBE(7)
#undef PROBE
}

#endif
