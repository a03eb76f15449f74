#include "texproc/filter/fitted_depth.h"

#include <cmath>
#include <string>

#include "base/error.h"
#include "texproc/filter/normal.h"

namespace petrichor::texproc {

namespace {

// Variances and covariance of the first channels.
struct Spread {
    double a = 0.0, b = 0.0, both = 0.0;
};

Spread spread_of(const Image& a, const Image& b)
{
    if (a.empty() || a.width != b.width || a.height != b.height) {
        throw Error("texture: maps of " + std::to_string(a.width) + " x " +
                        std::to_string(a.height) + " and " + std::to_string(b.width) + " x " +
                        std::to_string(b.height) + " cannot be compared",
                    "Bring them to one size: petrichor texture convert IN -o OUT --size WxH.");
    }
    const double count = static_cast<double>(a.width) * static_cast<double>(a.height);
    double mean_a = 0.0, mean_b = 0.0;
    const auto each = [&](auto&& take) {
        for (int y = 0; y < a.height; ++y) {
            for (int x = 0; x < a.width; ++x)
                take(static_cast<double>(a.at(x, y, 0)), static_cast<double>(b.at(x, y, 0)));
        }
    };
    each([&](double u, double v) {
        mean_a += u / count;
        mean_b += v / count;
    });
    Spread spread;
    each([&](double u, double v) {
        spread.a += (u - mean_a) * (u - mean_a) / count;
        spread.b += (v - mean_b) * (v - mean_b) / count;
        spread.both += (u - mean_a) * (v - mean_b) / count;
    });
    return spread;
}

double correlation_of(const Spread& spread)
{
    const double scale = std::sqrt(spread.a * spread.b);
    return scale > 1e-12 ? spread.both / scale : 0.0;
}

}  // namespace

FittedDepth fitted_depth(const Image& height, const Image& normal, Edge edge_u, Edge edge_v)
{
    const IntegratedHeight surface = height_from_normal(normal, edge_u, edge_v);
    const Spread spread = spread_of(height, surface.height);
    FittedDepth fitted;
    fitted.agreement = static_cast<float>(correlation_of(spread));
    if (spread.a > 1e-12) fitted.depth = surface.depth * static_cast<float>(spread.both / spread.a);
    return fitted;
}

double correlation(const Image& a, const Image& b)
{
    return correlation_of(spread_of(a, b));
}

}  // namespace petrichor::texproc
