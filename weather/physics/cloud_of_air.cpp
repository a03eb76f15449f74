#include "weather/physics/cloud_of_air.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace petrichor::weather {
namespace {

constexpr double kDry_pct = 45.0, kSaturated_pct = 97.0;
constexpr double kLeast = 0.5;
constexpr std::int64_t kHalfDay_us = 12LL * 3600 * 1000000;

}  // namespace

double cloud_of_humidity(double mean_rel_humidity_pct)
{
    const double x =
        std::clamp((mean_rel_humidity_pct - kDry_pct) / (kSaturated_pct - kDry_pct), 0.0, 1.0);
    return kLeast + (1.0 - kLeast) * x * x;
}

std::vector<double> cloud_of_air(std::span<const std::int64_t> time_us,
                                 std::span<const double> rel_humidity_pct)
{
    std::vector<double> clouds;
    clouds.reserve(time_us.size());
    // Sums up to each row, so that no window depends on the one before it.
    std::vector<double> sum(time_us.size() + 1, 0.0);
    std::vector<std::size_t> known(time_us.size() + 1, 0);
    for (std::size_t i = 0; i < time_us.size(); ++i) {
        const double rh = rel_humidity_pct[i];
        sum[i + 1] = sum[i] + (std::isnan(rh) ? 0.0 : rh);
        known[i + 1] = known[i] + (std::isnan(rh) ? 0 : 1);
    }
    std::size_t first = 0, end = 0;
    for (std::size_t i = 0; i < time_us.size(); ++i) {
        while (time_us[i] - time_us[first] > kHalfDay_us) ++first;
        while (end < time_us.size() && time_us[end] - time_us[i] <= kHalfDay_us) ++end;
        const std::size_t count = known[end] - known[first];
        clouds.push_back(count == 0 ? std::numeric_limits<double>::quiet_NaN()
                                    : cloud_of_humidity((sum[end] - sum[first]) /
                                                        static_cast<double>(count)));
    }
    return clouds;
}

}  // namespace petrichor::weather
