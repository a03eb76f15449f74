// A thin film over a surface: light mirrored above and below it interferes, which colours it (Belcour and
// Barla 2017, A Practical Extension to Microfacet Theory for the Modeling of Varying Iridescence, as
// KHR_materials_iridescence has it).
#ifndef PETRICHOR_FORMULAS_LIGHT_IRIDESCENCE_H
#define PETRICHOR_FORMULAS_LIGHT_IRIDESCENCE_H

#include "base/interop.h"
#include "formulas/light/brdf.h"

SHARED_BEGIN

// Reflectance at normal incidence of the boundary between two indices of refraction.
SHARED_FN float boundary_f0(float n, float outside)
{
    const float r = (n - outside) / (n + outside);
    return r * r;
}

// The index of refraction, in air, of what mirrors so much.
SHARED_FN float index_of_f0(float f0)
{
    const float r = sqrt(clamp(f0, 0.0f, 0.9999f));
    return (1.0f + r) / (1.0f - r);
}

// What the eye makes of fringes: Fourier transform of the colour matching functions as Gaussians, linear
// Rec.709. opd_nm: difference of the optical paths; shift: of the phase, radians.
SHARED_FN vec3 fringe_color(float opd_nm, vec3 shift)
{
    const float phase = 2.0f * kPi * opd_nm * 1.0e-9f;
    const float p2 = phase * phase;
    // Square root of 2 pi times the variance, over the sum of the eye's response.
    const float x = 5.4856e-13f / 1.0685e-7f * sqrt(2.0f * kPi * 4.3278e9f) *
                        cos(1.6810e6f * phase + shift.x) * exp(-4.3278e9f * p2) +
                    9.7470e-14f / 1.0685e-7f * sqrt(2.0f * kPi * 4.5282e9f) *
                        cos(2.2399e6f * phase + shift.x) * exp(-4.5282e9f * p2);
    const float y = 4.4201e-13f / 1.0685e-7f * sqrt(2.0f * kPi * 9.3046e9f) *
                    cos(1.7953e6f * phase + shift.y) * exp(-9.3046e9f * p2);
    const float z = 5.2481e-13f / 1.0685e-7f * sqrt(2.0f * kPi * 6.6121e9f) *
                    cos(2.2084e6f * phase + shift.z) * exp(-6.6121e9f * p2);
    return vec3(3.2404542f * x - 1.5371385f * y - 0.4985314f * z,
                -0.9692660f * x + 1.8760108f * y + 0.0415560f * z,
                0.0556434f * x - 0.2040259f * y + 1.0572252f * z);
}

// Reflectance in air at that cosine of a film of an index and a thickness over a base that mirrors f0 without
// it. A film of no thickness is none.
SHARED_FN vec3 thin_film_fresnel(float film_ior, float thickness_nm, vec3 f0, float cosine)
{
    if (thickness_nm <= 0.0f) return schlick_fresnel(f0, cosine);
    const float t = clamp(thickness_nm / 0.03f, 0.0f, 1.0f);
    const float n = mix(1.0f, film_ior, t * t * (3.0f - 2.0f * t));
    const float inside2 = 1.0f - (1.0f - cosine * cosine) / (n * n);
    if (inside2 < 0.0f) return splat3(1.0f);
    const float inside = sqrt(inside2);
    const float above = boundary_f0(n, 1.0f);
    const float m = 1.0f - cosine;
    const float r12 = above + (1.0f - above) * (m * m * m * m * m);
    const float t121 = 1.0f - r12;
    const vec3 base = vec3(index_of_f0(f0.x), index_of_f0(f0.y), index_of_f0(f0.z));
    const vec3 below = vec3(boundary_f0(base.x, n), boundary_f0(base.y, n), boundary_f0(base.z, n));
    const vec3 r23 = schlick_fresnel(below, inside);
    // Half a wave is lost on the way back from the thinner medium: at the film's top from within, and
    // at a base that is thinner than the film.
    const float top = n < 1.0f ? 0.0f : kPi;
    const vec3 shift = splat3(top) + vec3(base.x < n ? kPi : 0.0f, base.y < n ? kPi : 0.0f,
                                        base.z < n ? kPi : 0.0f);
    const float opd_nm = 2.0f * n * thickness_nm * inside;
    const vec3 r123 = clamp(r23 * r12, splat3(0.0f), splat3(0.9999f));
    const vec3 root = sqrt(r123);
    const vec3 series = r23 * (t121 * t121) / (splat3(1.0f) - r123);
    vec3 sum = splat3(r12) + series;
    vec3 c = (series - splat3(t121)) * root;
    sum = sum + c * fringe_color(opd_nm, shift) * 2.0f;
    c = c * root;
    sum = sum + c * fringe_color(2.0f * opd_nm, shift * 2.0f) * 2.0f;
    return max(sum, splat3(0.0f));
}

// The reflectance at normal incidence that shows at this cosine what the film mirrors there: within 0..1.
SHARED_FN vec3 thin_film_f0(float film_ior, float thickness_nm, vec3 f0, float cosine)
{
    const vec3 seen = thin_film_fresnel(film_ior, thickness_nm, f0, cosine);
    const float m = 1.0f - cosine;
    const float edge = min(m * m * m * m * m, 0.9999f);
    return clamp((seen - splat3(edge)) / (1.0f - edge), splat3(0.0f), splat3(1.0f));
}

// A film over a surface, as lamps ask for it: it has the colour that goes with the half vector.
struct ThinFilm {
    float share;  // of the surface that it covers, 0..1
    float ior;
    float thickness_nm;
    vec3 f0;      // of the surface below
};

// What schlick_fresnel() wants at that cosine.
SHARED_FN vec3 filmed_f0(ThinFilm film, float cosine)
{
    return film.f0 + (thin_film_f0(film.ior, film.thickness_nm, film.f0, cosine) - film.f0) * film.share;
}

// What shows in the mean over the hemisphere, by cosine, told as schlick_fresnel() wants it, which may be a little below zero: what light
// has that goes on between facets. By Gauss and Jacobi's four points; up to 1.2 um at most 0.014 off (Iridescence.ItsMeanIsThatOfAllCosines).
SHARED_FN vec3 filmed_mean_f0(ThinFilm film)
{
    const vec3 mean = 0.0623619420f * thin_film_fresnel(film.ior, film.thickness_nm, film.f0, 0.1397598643f) +
                      0.2596950952f * thin_film_fresnel(film.ior, film.thickness_nm, film.f0, 0.4164095676f) +
                      0.4069291360f * thin_film_fresnel(film.ior, film.thickness_nm, film.f0, 0.7231569864f) +
                      0.2710138268f * thin_film_fresnel(film.ior, film.thickness_nm, film.f0, 0.9428958039f);
    return film.f0 + (min((mean * 21.0f - splat3(1.0f)) * (1.0f / 20.0f), splat3(1.0f)) - film.f0) * film.share;
}

SHARED_END

#endif
