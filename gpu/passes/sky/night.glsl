// Stars and moon, behind air, clouds and fog. Before the include: frame.
//
// The brightest forty stars stand where they are (J2000, from right ascension and declination; w is the
// magnitude); nine thousand fainter ones are scattered by a hash, as many of each magnitude as there
// are (counts grow as 10^(0.51 m) to 6.5).
#ifndef PETRICHOR_NIGHT_GLSL
#define PETRICHOR_NIGHT_GLSL

#include "formulas/noise/noise.h"

#define BRIGHT_STARS 40
const vec4 kBrightStars[BRIGHT_STARS] = vec4[](
    vec4(-0.18746, 0.93920, -0.28769, -1.46),  // Sirius
    vec4(-0.06321, 0.60268, -0.79547, -0.74),  // Canopus
    vec4(-0.37392, -0.31264, -0.87318, -0.27),  // Rigil Kent
    vec4(-0.78380, -0.52699, 0.32854, -0.05),  // Arcturus
    vec4(0.12511, -0.76945, 0.62633, 0.03),  // Vega
    vec4(0.13049, 0.68229, 0.71934, 0.08),  // Capella
    vec4(0.19504, 0.97037, -0.14263, 0.13),  // Rigel
    vec4(-0.41811, 0.90383, 0.09098, 0.34),  // Procyon
    vec4(0.02090, 0.99143, 0.12897, 0.42),  // Betelgeuse
    vec4(0.49268, 0.22378, -0.84094, 0.46),  // Achernar
    vec4(-0.42398, -0.25430, -0.86924, 0.61),  // Hadar
    vec4(0.45921, -0.87485, 0.15419, 0.77),  // Altair
    vec4(-0.44939, -0.05239, -0.89180, 0.76),  // Acrux
    vec4(0.34390, 0.89497, 0.28418, 0.86),  // Aldebaran
    vec4(-0.34481, -0.82643, -0.44510, 0.96),  // Antares
    vec4(-0.91409, -0.35634, -0.19355, 0.97),  // Spica
    vec4(-0.39151, 0.79113, 0.46993, 1.14),  // Pollux
    vec4(0.83735, -0.23360, -0.49425, 1.16),  // Fomalhaut
    vec4(0.45565, -0.53619, 0.71055, 1.25),  // Deneb
    vec4(-0.49378, -0.10433, -0.86331, 1.25),  // Mimosa
    vec4(-0.86449, 0.45787, 0.20740, 1.35),  // Regulus
    vec4(-0.34060, 0.77775, 0.52829, 1.58),  // Castor
    vec4(-0.53801, -0.07363, -0.83971, 1.63),  // Gacrux
    vec4(0.15063, 0.98238, 0.11060, 1.64),  // Bellatrix
    vec4(0.10359, 0.99440, -0.02094, 1.69),  // Alnilam
    vec4(0.08380, 0.99591, -0.03385, 1.77),  // Alnitak
    vec4(0.12182, 0.99254, -0.00524, 2.23),  // Mintaka
    vec4(0.05267, 0.98438, -0.16797, 2.09),  // Saiph
    vec4(-0.45912, 0.11505, 0.88089, 1.79),  // Dubhe
    vec4(-0.53595, 0.13901, 0.83273, 2.37),  // Merak
    vec4(-0.59194, 0.01594, 0.80582, 2.44),  // Phecda
    vec4(-0.54297, -0.03661, 0.83896, 3.31),  // Megrez
    vec4(-0.54429, -0.13075, 0.82865, 1.77),  // Alioth
    vec4(-0.53648, -0.20575, 0.81845, 2.27),  // Mizar
    vec4(-0.58150, -0.29482, 0.75825, 1.86),  // Alkaid
    vec4(0.01018, 0.00794, 0.99992, 1.98),  // Polaris
    vec4(0.54276, 0.09695, 0.83427, 2.24),  // Schedar
    vec4(0.51238, 0.02053, 0.85851, 2.28),  // Caph
    vec4(0.47418, 0.11979, 0.87224, 2.47),  // Navi
    vec4(0.46197, 0.18156, 0.86811, 2.68)  // Ruchbah
);

// Radiance of a star of this magnitude at an angle from it: its light over the width of a pixel. A star
// of magnitude 0 gives 2.54e-6 lux.
float star_radiance(float magnitude, float angle2, float width)
{
    const float w2 = width * width;
    return 2.54e-6 * exp2(-1.3287712 * magnitude) * exp(-0.5 * angle2 / w2) / (6.2831853 * w2);
}

vec3 stars(vec3 direction)
{
    const vec3 d = vec3(dot(frame.stars_x, direction), dot(frame.stars_y, direction),
                        dot(frame.stars_z, direction));
    const float width = 0.6 * frame.pixel_angle;
    const float near = 1.0 - 8.0 * width * width;  // cosine of four widths
    float sum = 0.0;
    for (int i = 0; i < BRIGHT_STARS; ++i) {
        const float c = dot(d, kBrightStars[i].xyz);
        if (c > near) sum += star_radiance(kBrightStars[i].w, 2.0 * (1.0 - c), width);
    }
    // A cell of a cube's face holds one of the others, or none.
    const vec3 a = abs(d);
    const float longest = max(a.x, max(a.y, a.z));
    const int face = a.x == longest ? (d.x > 0.0 ? 0 : 1) : a.y == longest ? (d.y > 0.0 ? 2 : 3)
                                                                           : (d.z > 0.0 ? 4 : 5);
    const vec2 st = (face < 2 ? d.yz : face < 4 ? d.xz : d.xy) / longest;
    const ivec2 cell = ivec2(floor(st * 32.0));
    const uint seed = hash_u3(uint(cell.x + 64), uint(cell.y + 64), uint(face) + 77u);
    const float chance = float(seed & 65535u) / 65536.0;
    if (chance < 0.37) {
        const uint more = hash_u3(seed, 1u, 2u);
        const vec2 at = 0.2 + 0.6 * vec2(more & 1023u, (more >> 10) & 1023u) / 1024.0;
        const vec2 away = (st * 32.0 - vec2(cell) - at) / 32.0 / (1.0 + dot(st, st));
        const float u = (float(more >> 20) + 1.0) / 4096.0;
        const float magnitude = max(6.5 + log2(u) * (0.30103 / 0.51), 2.5);
        sum += star_radiance(magnitude, dot(away, away), width);
    }
    return vec3(sum);
}

// The lit part of its disc.
vec3 moon(vec3 direction)
{
    const float radius = 0.00452;
    const vec3 off = direction - frame.moon_direction;
    if (dot(off, off) >= radius * radius) return vec3(0.0);
    const vec3 across = off / radius;
    const vec3 n = across - frame.moon_direction * sqrt(max(1.0 - dot(across, across), 0.0));
    return frame.moon_radiance * smoothstep(-0.05, 0.12, dot(n, frame.moon_lit_from));
}

vec3 night_lights(vec3 direction)
{
    return stars(direction) + moon(direction);
}

#endif
