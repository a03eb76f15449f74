// The inner loops of chain_fit.h: eight lights at once. Built twice, for plain x86-64 and for AVX2;
// both do the same operations on the same eight lanes without fused rounding, so the bits are the
// same.
#ifndef PETRICHOR_TEXPROC_PREFILTER_DETAIL_CHAIN_FIT_KERNEL_H
#define PETRICHOR_TEXPROC_PREFILTER_DETAIL_CHAIN_FIT_KERNEL_H

#include <cstdint>

namespace petrichor::texproc::detail {

inline constexpr int kFitLights = 8;
inline constexpr int kFitMostTaps = 16;
inline constexpr int kFitFrames = 2;  // of a pixel: two places that it sees one after the other

/// An eye far away and the lights that it is tried with. Paint and metal as in lit_floor.h.
struct FitLights {
    float eye[3];
    float lx[kFitLights], ly[kFitLights], lz[kFitLights];
    float hx[kFitLights], hy[kFitLights], hz[kFitLights];  ///< half-vectors
    /// Of the sun: what the highlight mirrors, the part that its base colour takes a share of, and
    /// diffuse light with what the highlight leaves of it, over pi. All 0: no sun.
    float fresnel[kFitLights], fresnel_metal[kFitLights], albedo[kFitLights];
    float alpha2[kFitLights];  ///< of the light, squared
    /// Of the sky: its radiance, F0 and the part of it that is metal, what is diffuse.
    float sky[kFitLights], f0[kFitLights], f0_metal[kFitLights], sky_albedo[kFitLights];
};

/// What the channel of a roughness map means.
struct FitMeaning {
    bool smoothness = false, alpha = false;
};

/// A level while it is fitted: normal, roughness as stored, shares of the base colour of paint and of
/// metal, share of the second lobe; and how the error changes with them, with the share of paint where
/// there are two lobes.
struct FitTexel {
    float n[3], stored, share, metal, of_second, none;
};
struct FitSlope {
    float n[3], stored, metal, of_second, share, none;
};
/// A second lobe, and how the error changes with it.
struct FitLobe {
    float n[3], stored;
};
struct FitLevel {
    int width, height;
    const FitTexel* texels;
    FitSlope* slopes;              ///< null: not fitted
    const FitLobe* second = nullptr;  ///< null, as on the other level: one lobe
    FitLobe* second_slopes = nullptr;
};

/// A way in which pixels see the map: one eye, one size of a pixel.
struct FitView {
    FitLights lights;
    float exposure[kFitLights];
    float weight[kFitLights];   ///< of squared errors
    float flicker[kFitLights];  ///< of the squares of what differs between the moments of a pixel
    int taps;  ///< 1 to kFitMostTaps
    float step_u,
        step_v;   ///< from one sample of the filter to the next, of the map's width and height
    float share;  ///< of the coarser level
};

/// One pixel at one moment: its middle, 0..1 of the map, and what a display would show, 0..65535
/// for 0..1.
struct FitPixel {
    float u, v;
    std::uint16_t shown[kFitLights];
};

/// A step of Adam for the texels of a level; `full` and `full_square`: what its means lack at the start.
struct FitMove {
    float rate, scale, keep, keep_square, full, full_square;
    float least_second;                 ///< the share of either lobe stays above
    bool joint, metal, second, paint;   ///< what moves beside roughness: normals; and with them these
};
inline constexpr int kFitSlots = 4;  ///< slopes are summed apart: the sums do not depend on threads
/// Of a level, from one of its texels on; second...: null with one lobe.
struct FitMoved {
    FitTexel* texels;
    FitSlope *mean, *square;
    FitLobe *second, *second_mean, *second_square;
    FitSlope* slopes[kFitSlots];
    FitLobe* second_slopes[kFitSlots];
};

struct ChainFitKernel {
    /// Mean radiance of `count` texels towards the eye: normals, perceptual roughness; shares 1.
    void (*mean_light)(const FitLights& lights, const float* nx, const float* ny, const float* nz,
                       const float* p, int count, float* out);
    /// What the filter and one shading make of the pixels, as shown, without clipping or root:
    /// radiance times exposure. out: kFitLights a pixel.
    void (*seen)(const FitView& view, const FitMeaning& meaning, const FitLevel& fine,
                 const FitLevel& coarse, const FitPixel* pixels, int count, float* out);
    /// Adds to the slopes of both levels how the error changes with their texels, by both weights.
    /// count: a multiple of kFitFrames.
    void (*add_slopes)(const FitView& view, const FitMeaning& meaning, const FitLevel& fine,
                       const FitLevel& coarse, const FitPixel* pixels, int count);
    /// Moves `count` texels downhill and takes their slopes back to 0.
    void (*move)(const FitMove& how, const FitMoved& level, int count);
};

/// The kernel for this processor.
const ChainFitKernel& chain_fit_kernel();
extern const ChainFitKernel kChainFitKernelBase;
extern const ChainFitKernel kChainFitKernelAvx2;

}  // namespace petrichor::texproc::detail

#endif
