#ifndef PETRICHOR_TEXPROC_PREFILTER_DETAIL_LOBE_TOOLS_H
#define PETRICHOR_TEXPROC_PREFILTER_DETAIL_LOBE_TOOLS_H

#include <cstdint>
#include <vector>

#include "texproc/prefilter/detail/cells.h"
#include "texproc/prefilter/detail/lobe_kernel.h"

namespace petrichor::texproc::detail {

struct Direction {
    float x = 0.0f, y = 0.0f, z = 1.0f;
};
inline float dot(const Direction& a, const Direction& b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
Direction normalized(Direction d);

/// Two directions that make a right-handed frame with n.
struct Frame {
    Direction n, t, b;
};
Frame frame_about(const Direction& n);

/// How much light one GGX lobe of F = 1 returns in all directions together, seen from n.v = mu:
/// a table over (sqrt(alpha), mu), bilinear.
float lobe_albedo(float alpha2, float mu);
/// The same for one lobe of normal n under the five views.
void lobe_albedo_in_views(float alpha2, const Direction& n, float* out);

/// Half-vectors with their storage.
class Samples {
public:
    /// `total` half-vectors (a multiple of kViews * kLanes) from the footprint's own lobes, each
    /// reflecting its view, shaded and weighted. seed: a hash of level and texel.
    void draw(const CellsView& cells, int total, std::uint32_t seed, const LobeKernel& kernel);
    /// Room for others to fill.
    void resize(int per_view);
    SamplesView view();

private:
    int per_view_ = 0;
    std::vector<float> data_;
    std::vector<int> cell_;
};

/// Radius of the median rule: x with sum of w x / (x + alpha^2 + d^2) = 1/2 about `normal`.
float median_alpha2(const CellsView& cells, const Direction& normal, const LobeKernel& kernel);

/// The median rule's sum: 1/2 where alpha2 is its radius. light2 is added to every alpha^2.
float share_inside(const CellsView& cells, const Direction& normal, float light2, float alpha2);

/// Variance of the slopes about `normal`, both axes together, and the mean slope removed.
float slope_variance(const CellsView& cells, const Direction& normal);

/// The bivariate t of two degrees of freedom (the slopes of GGX) of greatest likelihood.
struct RobustFit {
    Direction normal;
    float alpha2 = 0.0f;                          ///< isotropic
    float a_xx = 0.0f, a_xy = 0.0f, a_yy = 0.0f;  ///< of the elliptic fit, in frame_about(normal)
};
RobustFit student_t(const CellsView& cells, const Direction& start, float start_alpha2, int frames,
                    int rounds, bool elliptic, const LobeKernel& kernel);

}  // namespace petrichor::texproc::detail

#endif
