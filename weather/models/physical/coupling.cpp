#include "weather/models/physical/coupling.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/error.h"
#include "weather/forcing/cut_forcing.h"
#include "weather/physics/constants.h"
#include "weather/physics/detail/portable_math.h"

namespace petrichor::weather {
namespace {

using Flux = RadiationCorrection::Flux;

constexpr std::int64_t kHour_us = 3600LL * kMicrosPerSecond;
constexpr double kStep_s = 600.0;
constexpr double kDay_w_m2 = 100.0;
constexpr int kHalvings = 40;
constexpr double kMoved_k = 1e-6;  // by all that a factor can do

void require(bool good, const char* name, double found, const char* accepted)
{
    if (good) return;
    throw Error(std::string("coupling: ") + name + " must be " + accepted + ", got " +
                    std::to_string(found),
                "Give some hours.");
}

std::int64_t us_of(double hours)
{
    return static_cast<std::int64_t>(std::llround(hours * 3600e6));
}

// The measurements that a window is made of: first and last of those that can be used.
struct Window {
    std::size_t first = 0, last = 0;
    bool found = false;
};

Window window_of(const RoadTemperatures& measured, const CouplingParams& coupling)
{
    Window w;
    const auto usable = [&](std::size_t i) {
        return measured.surface_c[i] > -90.0 && measured.surface_c[i] < 100.0;
    };
    const std::size_t count = std::min(measured.time_us.size(), measured.surface_c.size());
    std::size_t oldest = count;
    for (std::size_t i = 0; i < count; ++i) {
        if (!usable(i)) continue;
        oldest = std::min(oldest, i);
        w.last = i;
    }
    if (oldest == count) return w;
    const std::int64_t begin_us = std::max(measured.time_us[w.last] - us_of(coupling.window_h),
                                           measured.time_us[oldest] + us_of(coupling.settling_h));
    w.first = w.last;
    while (w.first > 0 && measured.time_us[w.first - 1] >= begin_us) --w.first;
    while (!usable(w.first)) ++w.first;
    w.found = measured.time_us[w.last] - measured.time_us[w.first] >= kHour_us;
    return w;
}

double sun_of(const ForcingTable& table, std::int64_t time_us)
{
    return value_at(table, table.has(Field::NetShortwave) ? Field::NetShortwave : Field::Shortwave,
                    time_us);
}

// The surface at the end of the window under a factor.
class Trial {
public:
    Trial(const ForcingTable& table, const PhysicalParams& params, const RoadTemperatures& measured,
          std::size_t first, const RadiationCorrection& correction)
        : table_(cut_forcing(table, correction.begin_us, correction.end_us)),
          params_(params),
          start_(observed_start(
              table_, params,
              {measured.time_us.first(first + 1), measured.surface_c.first(first + 1),
               measured.subsurface_c.first(std::min(first + 1, measured.subsurface_c.size())),
               measured.subsurface_depth_m})),
          tried_(correction)
    {
        params_.step_s = std::min(params_.step_s, kStep_s);
        params_.substep_s = std::min(params_.substep_s, params_.step_s);
    }
    double end_c(double factor)
    {
        tried_.factor = factor;
        ForcingTable corrected = table_;
        correct_radiation(corrected, tried_);
        const PhysicalTimeline run(corrected, params_, start_, tried_.begin_us);
        return run.state_at(tried_.end_us).surface_temp_c;
    }

private:
    ForcingTable table_;
    PhysicalParams params_;
    CellState start_;
    RadiationCorrection tried_;
};

}  // namespace

RadiationCorrection couple_radiation(const ForcingTable& table, const PhysicalParams& params,
                                     const RoadTemperatures& measured,
                                     const CouplingParams& coupling)
{
    const auto hours = [](double h) { return h >= 0.0 && h <= 48.0; };
    require(hours(coupling.window_h), "window_h", coupling.window_h, "in 0..48");
    require(hours(coupling.settling_h), "settling_h", coupling.settling_h, "in 0..48");
    require(coupling.relaxation_h > 0.0 && coupling.relaxation_h <= 1000.0, "relaxation_h",
            coupling.relaxation_h, "above 0, at most 1000");
    RadiationCorrection c;
    c.relaxation_h = coupling.relaxation_h;
    const Window window = window_of(measured, coupling);
    if (!window.found) return c;
    c.begin_us = measured.time_us[window.first];
    c.end_us = measured.time_us[window.last];
    const bool day = sun_of(table, c.begin_us) > 0.0 && sun_of(table, c.end_us) > kDay_w_m2 &&
                     sun_of(table, c.end_us + kHour_us) > 0.0;
    c.flux = day ? Flux::Shortwave : Flux::Longwave;
    double low = day ? kLeastShortwaveFactor : kLeastLongwaveFactor;
    double high = day ? kMostShortwaveFactor : kMostLongwaveFactor;
    const double goal_c = measured.surface_c[window.last];
    Trial trial(table, params, measured, window.first, c);
    c.missed_k = c.left_k = trial.end_c(1.0) - goal_c;
    const double coldest_c = trial.end_c(low), warmest_c = trial.end_c(high);
    if (!(warmest_c - coldest_c > kMoved_k)) {
        c.flux = Flux::None;
        return c;
    }
    c.at_bound = !(goal_c > coldest_c && goal_c < warmest_c);
    c.factor = goal_c <= coldest_c ? low : high;
    for (int i = 0; !c.at_bound && i < kHalvings; ++i) {
        c.factor = 0.5 * (low + high);
        (trial.end_c(c.factor) < goal_c ? low : high) = c.factor;
    }
    c.left_k = trial.end_c(c.factor) - goal_c;
    return c;
}

double correction_at(const RadiationCorrection& c, std::int64_t time_us)
{
    if (c.flux == Flux::None || time_us <= c.end_us) return c.factor;
    const double later_h = static_cast<double>(time_us - c.end_us) / static_cast<double>(kHour_us);
    return 1.0 + (c.factor - 1.0) * detail::exponential(-later_h / c.relaxation_h);
}

void correct_radiation(ForcingTable& table, const RadiationCorrection& c)
{
    if (c.flux == Flux::None) return;
    const auto scale = [&](Field field) {
        std::vector<double>& v = table[field];
        for (std::size_t i = 0; i < v.size(); ++i) v[i] *= correction_at(c, table.time_us[i]);
    };
    if (c.flux == Flux::Longwave) {
        scale(Field::Longwave);
        return;
    }
    for (const Field f : {Field::Shortwave, Field::NetShortwave, Field::Direct, Field::Diffuse})
        scale(f);
}

std::string to_text(const RadiationCorrection& c)
{
    if (c.flux == Flux::None) {
        return "no radiation is corrected by the measured road: that takes an hour of its "
               "temperatures, after those of the settling";
    }
    char line[300], left[60] = "";
    if (c.at_bound) std::snprintf(left, sizeof left, " but for %+.1f K", c.left_k);
    std::snprintf(line, sizeof line,
                  "%s x %.2f over the last %.1f h brings the modelled road to the measured one%s "
                  "(%+.1f K without); half of it is gone every %.1f h from there",
                  c.flux == Flux::Shortwave ? "sunlight" : "longwave from the sky", c.factor,
                  static_cast<double>(c.end_us - c.begin_us) / static_cast<double>(kHour_us), left,
                  c.missed_k, c.relaxation_h * 0.6931471805599453);
    return line;
}

}  // namespace petrichor::weather
