// Hashes and dither patterns: every value follows from integers, so that any frame can be made alone.
#ifndef PETRICHOR_NOISE_GLSL
#define PETRICHOR_NOISE_GLSL

uint hash_u(uint x)
{
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    x ^= x >> 16;
    return x;
}

uint hash_u3(uint x, uint y, uint z)
{
    return hash_u(x + hash_u(y + hash_u(z)));
}

float hash_f(uint x)
{
    return float(hash_u(x) >> 8) * (1.0 / 16777216.0);
}

// Well spread over a pixel's neighbours (interleaved gradient) and over samples (golden ratio).
float dither(ivec2 pixel, uint sample_index)
{
    const float spatial =
        fract(52.9829189 * fract(0.06711056 * float(pixel.x) + 0.00583715 * float(pixel.y)));
    return fract(spatial + 0.61803399 * float(sample_index));
}

// Value noise on a lattice that repeats every `period` cells.
float lattice_value(ivec2 cell, int period, uint seed)
{
    const ivec2 wrapped = ivec2(((cell.x % period) + period) % period, ((cell.y % period) + period) % period);
    return hash_f(hash_u3(uint(wrapped.x), uint(wrapped.y), seed));
}

float tileable_noise(vec2 p, int period, uint seed)
{
    const vec2 base = floor(p);
    const vec2 f = p - base;
    const vec2 u = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    const ivec2 cell = ivec2(base);
    const float a = lattice_value(cell, period, seed);
    const float b = lattice_value(cell + ivec2(1, 0), period, seed);
    const float c = lattice_value(cell + ivec2(0, 1), period, seed);
    const float d = lattice_value(cell + ivec2(1, 1), period, seed);
    return mix(mix(a, b, u.x), mix(c, d, u.x), u.y);
}

// uv 0..1 over the tile; `period` cells in the first octave.
float tileable_fbm(vec2 uv, int period, int octaves, uint seed)
{
    float sum = 0.0;
    float weight = 0.5;
    float total = 0.0;
    int cells = period;
    for (int i = 0; i < octaves; ++i) {
        sum += weight * tileable_noise(uv * float(cells), cells, seed + uint(i));
        total += weight;
        weight *= 0.5;
        cells *= 2;
    }
    return sum / total;
}

#endif
