#include "weather/models/artist/fit.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "weather/physics/constants.h"

namespace petrichor::weather {

namespace {

// change = rate * driver, as far as the mask has room: a film that fills within the hour asks for a
// fast rate, not for what is left of the hour.
class LeastSquares {
public:
    void add(double driver, double change, double room)
    {
        if (driver > 0.0) samples_.push_back({driver, change, room});
    }
    FittedRate rate() const
    {
        FittedRate r;
        r.hours = samples_.size();
        if (r.hours == 0) return r;
        double best = squares(0.0);
        const auto try_rate = [&](double rate) {
            const double now = squares(rate);
            if (now >= best) return;
            best = now;
            r.per_hour = rate;
        };
        // The sum has corners where a sample fills up: a scan, then finer about the best.
        for (double rate = kLeast_1_h; rate <= kMost_1_h; rate *= kCoarse) try_rate(rate);
        const double around = r.per_hour;
        for (int i = -kFine; i <= kFine && around > 0.0; ++i)
            try_rate(std::min(kMost_1_h, around * (1.0 + (kCoarse - 1.0) * i / kFine)));
        r.rms_residual = std::sqrt(best / static_cast<double>(r.hours));
        return r;
    }

private:
    static constexpr double kLeast_1_h = 1e-4, kMost_1_h = 50.0, kCoarse = 1.1;
    static constexpr int kFine = 50;
    struct Sample {
        double driver, change, room;
    };
    double squares(double rate) const
    {
        double sum = 0.0;
        for (const Sample& s : samples_) {
            const double error = std::min(rate * s.driver, s.room) - s.change;
            sum += error * error;
        }
        return sum;
    }
    std::vector<Sample> samples_;
};

}  // namespace

ArtistFit fit_artist(const ForcingTable& table, const PhysicalParams& params,
                     const MappingParams& mapping)
{
    const PhysicalTimeline run(table, params);
    const auto step_us = static_cast<std::int64_t>(std::llround(params.step_s * 1e6));
    const auto states = run.series(run.begin_us(), run.end_us(), step_us);
    const double hours = params.step_s / 3600.0;
    LeastSquares wet[3], dry[3], snow;
    for (std::size_t i = 1; i < states.size(); ++i) {
        const WeatherMasks before =
            weather_masks(mapping, params.surface, states[i - 1], params.step_s);
        const WeatherMasks after = weather_masks(mapping, params.surface, states[i], params.step_s);
        const double t_c =
            value_at(table, Field::AirTemp,
                     run.begin_us() + static_cast<std::int64_t>(i) * step_us - step_us / 2) -
            kZeroCelsiusK;
        const double a = std::min(std::abs(t_c) / 40.0, 1.0);
        const double masks_before[3] = {before.wetness, before.cracks, before.puddles};
        const double masks_after[3] = {after.wetness, after.cracks, after.puddles};
        const bool bare = before.snow == 0.0 && after.snow == 0.0;
        for (int m = 0; m < 3; ++m) {
            const double change = masks_after[m] - masks_before[m];
            if (!bare || t_c <= 0.0) continue;
            if (after.rain > 0.0 && masks_before[m] < 0.95)
                wet[m].add(after.rain * hours, change, 1.0 - masks_before[m]);
            if (after.rainfall == 0.0 && masks_before[m] > 0.02)
                dry[m].add(a * hours, -change, masks_before[m]);
        }
        if (after.snowfall > 0.0 && before.snow < 0.95)
            snow.add(after.snowfall * hours, after.snow - before.snow, 1.0 - before.snow);
    }
    ArtistFit fit;
    fit.wetness = wet[0].rate();
    fit.cracks = wet[1].rate();
    fit.puddles = wet[2].rate();
    fit.snow = snow.rate();
    fit.dry_wetness = dry[0].rate();
    fit.dry_cracks = dry[1].rate();
    fit.dry_puddles = dry[2].rate();
    ArtistParams& p = fit.params;
    p.time_scale = 1.0 / 3600.0;
    const auto put = [](double& parameter, const FittedRate& rate) {
        if (rate.hours > 0) parameter = rate.per_hour;
    };
    put(p.accumulation_rate_wetness, fit.wetness);
    put(p.accumulation_rate_cracks, fit.cracks);
    put(p.accumulation_rate_puddles, fit.puddles);
    put(p.accumulation_rate_snow, fit.snow);
    put(p.evaporation_rate_wetness, fit.dry_wetness);
    put(p.evaporation_rate_cracks, fit.dry_cracks);
    put(p.evaporation_rate_puddles, fit.dry_puddles);
    return fit;
}

}  // namespace petrichor::weather
