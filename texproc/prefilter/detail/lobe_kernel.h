// The inner loops of the lobe fit and of the yardstick: many half-vectors against one or many GGX
// lobes. Built twice, for plain x86-64 and for AVX2; both do the same operations on the same eight
// lanes without fused rounding, so the bits are the same and the faster one is taken.
#ifndef PETRICHOR_TEXPROC_PREFILTER_DETAIL_LOBE_KERNEL_H
#define PETRICHOR_TEXPROC_PREFILTER_DETAIL_LOBE_KERNEL_H

#include <cstddef>

namespace petrichor::texproc::detail {

inline constexpr int kLanes = 8;
inline constexpr int kViews = 5;
inline constexpr float kMinAlpha2 = 1e-6f;  // alpha 0.001: below it single precision means nothing

/// A footprint as lobes: unit normals in the surface frame, alpha squared, weights that sum to 1.
struct CellsView {
    const float* nx;
    const float* ny;
    const float* nz;
    const float* alpha2;
    const float* weight;
    int count;
};

/// Half-vectors with the light that each makes with its view, view after view, `per_view` each (a
/// multiple of kLanes). weight: 4 (v.h) / density / number; 0 for a sample whose half-vector turns
/// away from the view, negative for one whose light comes from below the surface.
struct SamplesView {
    int per_view;
    float *hx, *hy, *hz;
    float* vh2;  ///< 2 (v.h): the light is l = vh2 h - v
    float* weight;
    float* density;        ///< of the half-vector in the footprint: sum of w D (n.h)
    float* radiance;       ///< of the footprint: sum of w f (n.l)
    float *shared, *most;  ///< how overlaps() counts the sample, and how much light at most
};

/// Points of a rank-1 lattice, view after view, `per_view` at most of each; the second coordinate
/// as an angle.
struct LatticeView {
    int per_view;
    const float *u, *cosine, *sine;
};
/// What moves the lattice from texel to texel: a shift of u and a turn of the angle.
struct Turn {
    float shift, cosine, sine;
};

/// One lobe to test; elliptic when alpha2_x and alpha2_y differ, tx ty tz is then its x axis.
struct Lobe {
    float nx, ny, nz;
    float alpha2;  ///< with the light added
};
struct EllipticLobe {
    float nx, ny, nz;
    float tx, ty, tz;
    float bx, by, bz;
    float alpha2_x, alpha2_y;
};

/// Points of the footprint in slope space about some normal, for the robust fit.
struct SlopesView {
    const float* x;
    const float* y;
    const float* weight;  ///< padded with 0 to a multiple of kLanes
    int count;            ///< a multiple of kLanes
};
struct SlopeSums {
    float w, x, y, xx, xy, yy;  ///< sums of w u, w u s, w u (s - c)(s - c)
};

struct LobeKernel {
    /// Half-vectors from the lobes of the footprint: sample k from the cell cell[k]. Fills hx hy
    /// hz, vh2 and weight = +-4 (v.h).
    void (*place)(const CellsView& cells, const Turn& turn, const LatticeView& lattice,
                  const int* cell, const SamplesView& samples);
    /// Fills density and radiance of every sample.
    void (*shade)(const CellsView& cells, const SamplesView& samples);
    /// Divides the weights by density and number, after shade(); fills shared and most.
    void (*weigh)(const SamplesView& samples);
    /// out[v * count + k], for lobes that share a normal: the sum over the samples of view v of
    /// shared min(most, lobe k): 2 weight min(radiance, lobe k) above the horizon and
    /// -weight min(8 radiance, lobe k) below it.
    void (*overlaps)(const SamplesView& samples, const Lobe& lobe, const float* alpha2s, int count,
                     float* out);
    /// out[v]: the same for one elliptic lobe.
    void (*elliptic_overlap)(const SamplesView& samples, const EllipticLobe& lobe, float* out);
    /// Per view: the sum of weight * |radiance - lobe| and of weight * lobe.
    void (*differences)(const SamplesView& samples, const EllipticLobe& lobe, float* difference,
                        float* energy);
    /// One round of reweighting about c with the inverse (i_xx, i_xy, i_yy) of A; see student_t().
    SlopeSums (*reweighted)(const SlopesView& s, float cx, float cy, float i_xx, float i_xy,
                            float i_yy);
    /// Radius of the median rule, see median_alpha2(). s, w: room for the cells, their number
    /// rounded up to a multiple of kLanes.
    float (*median)(const CellsView& cells, float nx, float ny, float nz, float* s, float* w);
};

/// The five views of the yardstick: 0 degrees; 45 at azimuth 20, 110; 70 at azimuth 65, 155. As
/// unit vectors, rounded once here so that every build agrees.
inline constexpr float kViewDirections[kViews][3] = {
    {0.0f, 0.0f, 1.0f},
    {0.66446302f, 0.24184476f, 0.70710678f},
    {-0.24184476f, 0.66446302f, 0.70710678f},
    {0.39713126f, 0.85165074f, 0.34202014f},
    {-0.85165074f, 0.39713126f, 0.34202014f},
};

/// The kernel for this processor.
const LobeKernel& lobe_kernel();
extern const LobeKernel kLobeKernelBase;
extern const LobeKernel kLobeKernelAvx2;

}  // namespace petrichor::texproc::detail

#endif
