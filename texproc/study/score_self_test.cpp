#include <algorithm>
#include <cmath>

#include "texproc/prefilter/detail/input.h"
#include "texproc/study/detail/yardstick.h"
#include "texproc/study/score.h"

namespace petrichor::texproc {

using namespace detail;

namespace {

// A map of normals with Gaussian slopes, as floats.
void gaussian_map(int size, double sigma, float p, RawImage& normal, RawImage& roughness)
{
    Image n(size, size, 3, ColorSpace::Data);
    Random random{42};
    for (std::size_t i = 0; i < n.pixels.size(); i += 3) {
        const double r = sigma * std::sqrt(-2.0 * std::log(1.0 - random()));
        const double phi = 6.283185307179586 * random();
        const Direction d = normalized(
            {static_cast<float>(r * std::cos(phi)), static_cast<float>(r * std::sin(phi)), 1.0f});
        n.pixels[i] = 0.5f + 0.5f * d.x;
        n.pixels[i + 1] = 0.5f + 0.5f * d.y;
        n.pixels[i + 2] = 0.5f + 0.5f * d.z;
    }
    normal = to_raw(n, PixelType::F32);
    roughness = to_raw(Image(size, size, 1, ColorSpace::Data, p), PixelType::F32);
}

}  // namespace

std::vector<SelfCheck> score_self_test()
{
    std::vector<SelfCheck> checks;
    RawImage normal, roughness;
    gaussian_map(32, 0.0, 0.25f, normal, roughness);
    for (const char* rule : {"none", "moments", "lux-formula", "median", "overlap"}) {
        PrefilterOptions options;
        options.rule = rule;
        const Prefiltered flat = prefilter_raw(normal, roughness, options);
        const Score s = score(normal, roughness, flat, options);
        double worst = 0.0;
        for (const LevelScore& l : s.levels) worst = std::max(worst, l.tested);
        checks.push_back({std::string("flat map, ") + rule, worst, 0.0, 0.02});
    }
    // The projected density of half-vectors of a footprint integrates to 1.
    gaussian_map(64, 0.25, 0.25f, normal, roughness);
    const MapSurface surface = make_surface(ref(normal), ref(roughness), {});
    std::vector<SurfaceRow> rows(64);
    for (int y = 0; y < 64; ++y) fetch(surface, y, rows[static_cast<std::size_t>(y)]);
    const Footprint whole = footprints(64, 1)[0];
    Cells cells;
    Means means;
    gather(rows, 0, whole, whole, cells, means);
    const Direction mean = normalized({means.nx, means.ny, means.nz});
    Samples samples;
    Random random{7};
    place_points(cells, mean, {0.0039f, 0.09f}, 4096, random, samples);
    const SamplesView s = samples.view();
    double density = 0.0;
    for (int k = 0; k < s.per_view; ++k) {  // view 0: 4 (v.h) = 4 h_z, all h up
        if (s.hz[k] > 1e-3f && s.weight[k] > 0.0f) {
            density += static_cast<double>(s.weight[k] / (4.0f * s.hz[k]) * s.density[k]);
        }
    }
    checks.push_back({"density of the reference", density, 0.98, 1.005});
    // Gaussian slopes 0.25 over alpha 0.0625: where the rules come out.
    const auto alpha_of = [&](const char* rule) {
        PrefilterOptions options;
        options.rule = rule;
        const float p = prefilter_raw(normal, roughness, options).roughness.back().pixels[0];
        return static_cast<double>(p) * static_cast<double>(p);
    };
    checks.push_back({"alpha of lean", alpha_of("lean"), 0.349, 0.369});
    checks.push_back({"alpha of vmf", alpha_of("vmf"), 0.319, 0.339});
    checks.push_back({"alpha of median", alpha_of("median"), 0.277, 0.297});
    checks.push_back({"alpha of lux-formula", alpha_of("lux-formula"), 0.105, 0.125});
    checks.push_back({"alpha of overlap", alpha_of("overlap"), 0.287, 0.327});
    return checks;
}

}  // namespace petrichor::texproc
