#include "film/weather/artist_taps.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <string>

#include "scene/basins/water.h"
#include "weather/physics/constants.h"

namespace petrichor::film {
namespace {

constexpr double kPuddleRain_m = 0.020;  // that full puddles stand for
constexpr double kStep_s = 0.125, kMostSteps = 1024.0;
constexpr double kHour_s = 3600.0;
constexpr int kPieces = 8;  // of a curve between two keys

bool runs_at(const std::vector<TapSpan>& spans, double time_s)
{
    return std::any_of(spans.begin(), spans.end(), [&](const TapSpan& s) {
        return time_s >= s.from_s && time_s < s.to_s;
    });
}

// A channel that is another one while water runs. Jumps take a microsecond.
weather::Channel while_running(const weather::Channel& otherwise, const std::vector<TapSpan>& spans,
                               const std::function<double(double time_us)>& then)
{
    using weather::Interpolation;
    const bool hold = otherwise.interpolation == Interpolation::Hold;
    std::set<weather::TimeUs> times(otherwise.times.begin(), otherwise.times.end());
    for (std::size_t i = 0; !hold && i + 1 < otherwise.times.size(); ++i)
        for (int k = 1; k < kPieces; ++k)
            times.insert(otherwise.times[i] + (otherwise.times[i + 1] - otherwise.times[i]) * k / kPieces);
    for (const TapSpan& span : spans) {
        for (const double edge_s : {span.from_s, span.to_s}) {
            if (!std::isfinite(edge_s)) continue;
            const weather::TimeUs edge = weather::to_time_us(edge_s);
            times.insert(edge);
            times.insert(edge - 1);
        }
    }
    weather::Channel out;
    out.interpolation = hold ? Interpolation::Hold : Interpolation::Linear;
    for (const weather::TimeUs time : times) {
        const auto at = static_cast<double>(time);
        out.times.push_back(time);
        out.values.push_back(runs_at(spans, at * 1e-6) ? then(at) : weather::value_at(otherwise, at));
    }
    return out;
}

}  // namespace

WeatherScript script_below_taps(const WeatherScript& open, WeatherScript here,
                                const std::vector<TapSpan>& spans)
{
    here.timeline.rainfall = while_running(here.timeline.rainfall, spans, [](double) { return 1.0; });
    const weather::Channel air = here.timeline.temperature_c;
    here.timeline.temperature_c = while_running(air, spans, [&](double us) {
        double warmest = weather::value_at(air, us);
        for (const TapSpan& s : spans)
            if (us * 1e-6 >= s.from_s && us * 1e-6 < s.to_s) warmest = std::max(warmest, s.water_c);
        return warmest;
    });
    // No roof keeps this water away.
    for (const weather::ArtistParameter& p : weather::artist_parameters()) {
        if (p.name != "accumulation_rate_wetness" && p.name != "accumulation_rate_cracks" &&
            p.name != "accumulation_rate_puddles")
            continue;
        const auto channel_of = [&](const WeatherScript& script) {
            const auto keyed = script.timeline.parameters.find(p.name);
            return keyed != script.timeline.parameters.end()
                       ? keyed->second
                       : weather::constant_channel(script.params.*p.member);
        };
        const weather::Channel full = channel_of(open);
        here.timeline.parameters[std::string(p.name)] = while_running(
            channel_of(here), spans, [&](double us) { return weather::value_at(full, us); });
    }
    return here;
}

ArtistTaps::ArtistTaps(const std::vector<TapSite>& sites, const scene::Basins& basins,
                       const WeatherScript& script, const KeyedTaps& clock)
{
    if (sites.empty()) return;
    pits_ = basins.pits;
    std::vector<TapSpan> opened;
    double until_s = std::max(script.duration_s, clock.until_s);
    for (const TapSite& site : sites) {
        TapSpan span;
        if (site.from_s) span.from_s = *site.from_s + clock.offset_s;
        if (site.to_s) span.to_s = *site.to_s + clock.offset_s;
        span.water_c = site.tap.temp_k - weather::kZeroCelsiusK;
        opened.push_back(span);
        start_s_ = std::min(start_s_, site.from_s ? span.from_s : start_s_);
        until_s = std::max(until_s, start_s_);
    }
    step_s_ = std::max(kStep_s, (until_s - start_s_) / kMostSteps);
    const auto count = static_cast<std::size_t>(std::ceil((until_s - start_s_) / step_s_));
    const weather::ArtistTimeline weather = script.solve();
    scene::BasinWater water(basins);
    std::vector<double> into(pits_ + 1, 0.0), loss_m(pits_ + 1, 0.0);
    std::vector<std::vector<double>> begun(sites.size());  // stretches, when water first comes to them
    for (std::size_t t = 0; t < sites.size(); ++t)
        begun[t].assign(sites[t].tap.stretches.size(), std::numeric_limits<double>::infinity());
    steps_.assign(1, {});
    for (std::size_t i = 0; i < count; ++i) {
        const double from_s = start_s_ + step_s_ * static_cast<double>(i), to_s = from_s + step_s_;
        std::fill(into.begin(), into.end(), 0.0);
        const std::vector<float> level_m = scene::levels_m(basins, water);
        for (std::size_t t = 0; t < sites.size(); ++t) {
            const double open_s =
                std::min(to_s, opened[t].to_s) - std::max(from_s, opened[t].from_s);
            if (!(open_s > 0.0) || !(sites[t].tap.flow_kg_s > 0.0)) continue;
            std::uint32_t runs_to = weather::kRunsOut;
            for (std::size_t k = 0; k < sites[t].tap.stretches.size(); ++k) {
                const weather::TapStretch& stretch = sites[t].tap.stretches[k];
                if (std::isinf(begun[t][k]))
                    begun[t][k] = k == 0 ? opened[t].from_s : std::max(from_s, opened[t].from_s);
                runs_to = stretch.runs_to;
                const std::size_t label = (runs_to & ~weather::kToPond) + std::size_t{1};
                if (runs_to == weather::kRunsOut ||
                    static_cast<double>(level_m[label]) < stretch.spill_m)
                    break;
            }
            if (runs_to != weather::kRunsOut)
                into[(runs_to & ~weather::kToPond) + std::size_t{1}] +=
                    sites[t].tap.flow_kg_s / weather::kWaterDensity * open_s * kHour_s *
                    clock.hours_per_second;
        }
        scene::pour(basins, water, into);
        const weather::TimeUs middle = weather::to_time_us(0.5 * (from_s + to_s));
        const weather::ArtistParams p = weather.params_at(middle);
        const double celsius = weather.temperature_c_at(middle);
        if (celsius > 0.0 && weather.rainfall_at(middle) == 0.0) {
            const double dries = p.evaporation_rate_puddles * std::min(celsius / 40.0, 1.0) *
                                 p.time_scale * step_s_;
            std::fill(loss_m.begin(), loss_m.end(), std::max(dries, 0.0) * kPuddleRain_m);
            scene::evaporate(basins, water, loss_m);
        }
        Stood stood;
        const std::vector<scene::WaterShape> shapes = scene::water_shapes(basins, water);
        for (std::uint32_t pit = 1; pit < shapes.size(); ++pit) {
            const double m3 = shapes[pit].depth_m * shapes[pit].area_m2;
            if (m3 > 0.0) stood.emplace_back(pit, m3);
        }
        steps_.push_back(std::move(stood));
    }
    for (std::size_t t = 0; t < sites.size(); ++t) {
        for (std::size_t k = 0; k < begun[t].size(); ++k) {
            if (begun[t][k] >= opened[t].to_s || begun[t][k] == std::numeric_limits<double>::infinity())
                continue;
            for (const std::uint32_t patch : sites[t].tap.stretches[k].way)
                wetted_[patch].push_back({begun[t][k], opened[t].to_s, opened[t].water_c});
        }
    }
}

std::vector<double> ArtistTaps::in_pits_m3(double time_s) const
{
    if (steps_.size() < 2) return {};
    const double last = static_cast<double>(steps_.size() - 1);
    const double at = std::clamp((time_s - start_s_) / step_s_, 0.0, last);
    const auto i = static_cast<std::size_t>(std::min(at, last - 1.0));
    const double u = at - static_cast<double>(i);
    if (steps_[i].empty() && steps_[i + 1].empty()) return {};
    std::vector<double> all(pits_ + 1, 0.0);
    for (const auto& [pit, m3] : steps_[i]) all[pit] += (1.0 - u) * m3;
    for (const auto& [pit, m3] : steps_[i + 1]) all[pit] += u * m3;
    return all;
}

}  // namespace petrichor::film
