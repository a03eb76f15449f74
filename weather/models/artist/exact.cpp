#include "weather/models/artist/exact.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"
#include "weather/models/artist/detail/pieces.h"

namespace petrichor::weather {

struct ArtistTimeline::Solution : detail::Solution {};

namespace {

using detail::Piece;
using detail::Rates;

constexpr double kSampleLength_s =
    1.0 / 256.0;                           // of scaled time, where a rate changes by 1 between keys
constexpr double kMostSamples = 200000.0;  // more would cost memory; they become longer instead
constexpr double kAfterLastKey_us = 4.0e15;  // 126 years: events are looked for that far

// Keys of all channels after `start`, ascending, with the start before them.
std::vector<TimeUs> knots_of(const Timeline& timeline, TimeUs start)
{
    std::vector<TimeUs> knots{start};
    const auto add = [&](const Channel& channel) {
        for (TimeUs time : channel.times) {
            if (time > start) knots.push_back(time);
        }
    };
    add(timeline.temperature_c);
    add(timeline.rainfall);
    for (const auto& [name, channel] : timeline.parameters) add(channel);
    for (const auto& [name, channel] : timeline.states) add(channel);
    std::sort(knots.begin(), knots.end());
    knots.erase(std::unique(knots.begin(), knots.end()), knots.end());
    return knots;
}

// The largest change of a rate or scale between two knots; 0 when none moves. Channels are monotone
// between their keys.
double largest_change(const Timeline& timeline, double begin_us, double end_us)
{
    double largest = 0.0;
    for (const auto& [name, channel] : timeline.parameters) {
        const bool counts = name.find("rate") != name.npos || name.find("time_scale") != name.npos;
        if (!counts || channel.interpolation == Interpolation::Hold) continue;
        largest = std::max(largest,
                           std::abs(value_before(channel, end_us) - value_at(channel, begin_us)));
    }
    return largest;
}

// The error of a midpoint grows with the square of the piece and in proportion to the change.
double sample_length_s(double change)
{
    return kSampleLength_s / std::sqrt(std::max(change, 1.0 / 256.0));
}

// Rates must not be negative: the closed form relies on monotone pieces.
void check_rates(const ArtistParams& params)
{
    for (const ArtistParameter& parameter : artist_parameters()) {
        const double value = params.*parameter.member;
        const bool rate = parameter.name.find("rate") != parameter.name.npos ||
                          parameter.name.find("time_scale") != parameter.name.npos;
        if (!std::isfinite(value) || (rate && value < 0.0)) {
            throw Error("artist: " + std::string(parameter.name) + " is " + std::to_string(value) +
                            ", expected a number from 0 up",
                        "Use a value in " + std::to_string(parameter.low) + " .. " +
                            std::to_string(parameter.high) + ".");
        }
    }
}

}  // namespace

ArtistTimeline::ArtistTimeline(Timeline timeline, ArtistParams params, const ArtistState& initial,
                               TimeUs start)
    : timeline_(std::move(timeline)), params_(std::move(params)), start_(start)
{
    check_timeline(timeline_);
    check_rates(params_);
    const std::vector<TimeUs> knots = knots_of(timeline_, start);
    for (TimeUs knot : knots) {
        check_rates(weather::params_at(timeline_, params_, static_cast<double>(knot)));
    }
    auto solution = std::make_shared<Solution>();

    ArtistState state = initial;
    for (double ArtistState::*value :
         {&ArtistState::water_to_snow, &ArtistState::wetness, &ArtistState::cracks,
          &ArtistState::puddles, &ArtistState::snow}) {
        state.*value = std::clamp(state.*value, 0.0, 1.0);
    }
    state.water = std::max(state.cracks, state.puddles);
    state.rain = state.snowfall = 0.0;

    const double shortest_s = to_seconds(knots.back() - start) * params_.time_scale / kMostSamples;
    for (std::size_t i = 0; i < knots.size(); ++i) {
        const double begin_us = static_cast<double>(knots[i]);
        const double end_us =
            i + 1 < knots.size() ? static_cast<double>(knots[i + 1]) : begin_us + kAfterLastKey_us;
        int samples = 1;
        const double change =
            i + 1 < knots.size() ? largest_change(timeline_, begin_us, end_us) : 0.0;
        if (change > 0.0) {
            const double scale =
                std::max(weather::params_at(timeline_, params_, begin_us).time_scale,
                         weather::params_before(timeline_, params_, end_us).time_scale);
            samples = static_cast<int>(
                std::clamp(std::ceil(scale * (end_us - begin_us) * 1e-6 /
                                     std::max(sample_length_s(change), shortest_s)),
                           1.0, kMostSamples));
        }
        const bool by_hand = !weather::params_at(timeline_, params_, begin_us).script_controlled;
        if (by_hand) state = hand_set(timeline_, state, begin_us);
        for (int k = 0; k < samples; ++k) {
            const double from_us =
                begin_us + (end_us - begin_us) * (static_cast<double>(k) / samples);
            const double to_us =
                k + 1 == samples ? end_us : begin_us + (end_us - begin_us) * ((k + 1.0) / samples);
            Piece piece;
            Solution::move_start(piece, from_us, timeline_);
            piece.key = k == 0;
            piece.state = state;
            const double middle_us = change > 0.0 ? 0.5 * (from_us + to_us) : from_us;
            piece.rates =
                solution->index_of(Rates(weather::params_at(timeline_, params_, middle_us)));
            state = solution->add_interval(piece, to_us, timeline_);
        }
        if (by_hand) state = hand_set(timeline_, state, end_us, true);
    }
    solution_ = std::move(solution);
}

std::size_t ArtistTimeline::piece_before(TimeUs time) const
{
    const auto& pieces = solution_->pieces;
    const auto after = std::lower_bound(
        pieces.begin(), pieces.end(), static_cast<double>(time),
        [](const Piece& piece, double time_us) { return piece.start_us < time_us; });
    return after == pieces.begin() ? 0 : static_cast<std::size_t>(after - pieces.begin()) - 1;
}

ArtistState ArtistTimeline::state_at(TimeUs time) const
{
    time = std::max(time, start_);
    const Piece& piece = solution_->pieces[piece_before(time)];
    ArtistState state =
        solution_->advance(piece, (static_cast<double>(time) - piece.start_us) * 1e-6);
    const double rainfall = rainfall_at(time);
    if (!params_at(time).script_controlled) {
        state = hand_set(timeline_, state, static_cast<double>(time), time > start_);
        state.rain = state.snowfall = rainfall;
        return state;
    }
    state.snowfall = rainfall * state.water_to_snow;
    state.rain = rainfall - state.snowfall;
    return state;
}

ArtistOutputs ArtistTimeline::outputs_at(TimeUs time) const
{
    return outputs(state_at(time), params_at(time), temperature_c_at(time), rainfall_at(time));
}

// At the start there is no "until": the inputs are those from it on.
double ArtistTimeline::temperature_c_at(TimeUs time) const
{
    const auto t = static_cast<double>(std::max(time, start_));
    return time > start_ ? value_before(timeline_.temperature_c, t)
                         : value_at(timeline_.temperature_c, t);
}

double ArtistTimeline::rainfall_at(TimeUs time) const
{
    const auto t = static_cast<double>(std::max(time, start_));
    return std::max(
        0.0, time > start_ ? value_before(timeline_.rainfall, t) : value_at(timeline_.rainfall, t));
}

ArtistParams ArtistTimeline::params_at(TimeUs time) const
{
    const auto t = static_cast<double>(std::max(time, start_));
    return time > start_ ? params_before(timeline_, params_, t)
                         : weather::params_at(timeline_, params_, t);
}

std::vector<ArtistEvent> ArtistTimeline::events() const
{
    std::vector<ArtistEvent> found;
    const auto& pieces = solution_->pieces;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const Piece& now = pieces[i];
        const TimeUs time = static_cast<TimeUs>(std::llround(now.start_us));
        if (i == 0) {
            if (!now.dry) found.push_back({time, ArtistEventKind::RainStarts});
            continue;
        }
        const Piece& before = pieces[i - 1];
        if (now.warm != before.warm) {
            found.push_back(
                {time, now.warm ? ArtistEventKind::TurnsWarm : ArtistEventKind::TurnsCold});
        }
        if (now.dry != before.dry) {
            found.push_back(
                {time, now.dry ? ArtistEventKind::RainStops : ArtistEventKind::RainStarts});
        }
        if (before.moving && now.state.water_to_snow == 0.0) {
            found.push_back({time, ArtistEventKind::AllLiquid});
        } else if (before.moving && now.state.water_to_snow == 1.0) {
            found.push_back({time, ArtistEventKind::AllFrozen});
        }
    }
    return found;
}

ArtistCheckpoint ArtistTimeline::checkpoint_at(TimeUs time) const
{
    std::size_t i = piece_before(time);
    while (i > 0 && !solution_->pieces[i].key) --i;
    const Piece& piece = solution_->pieces[i];
    return {static_cast<TimeUs>(std::llround(piece.start_us)), piece.state};
}

std::string_view name_of(ArtistEventKind kind)
{
    switch (kind) {
        case ArtistEventKind::TurnsWarm:
            return "temperature rises above 0 \u00b0C";
        case ArtistEventKind::TurnsCold:
            return "temperature falls to 0 \u00b0C or below";
        case ArtistEventKind::AllLiquid:
            return "everything liquid";
        case ArtistEventKind::AllFrozen:
            return "everything frozen";
        case ArtistEventKind::RainStarts:
            return "precipitation starts";
        case ArtistEventKind::RainStops:
            break;
    }
    return "precipitation stops";
}

}  // namespace petrichor::weather
