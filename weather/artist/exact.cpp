#include "weather/artist/exact.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"
#include "weather/artist/detail/polynomial.h"
#include "weather/artist/math.h"

// How a timeline is cut, from coarse to fine:
//
//   keys      of any channel: between two of them every input is a cubic of time
//   samples   only where a parameter changes smoothly: constant parameters, taken at the middle of
//             pieces so short that the second-order error stays far below 1e-4
//   inputs    temperature through 0 and +-40, rainfall through 0
//   phase     W reaches 0 or 1 and stays
//   film      the film of a drying surface turns (snow melts into it): monotone pieces clamp once
//
// A Piece is what is left: no event inside, its state known at its start. A state at any time is
// one search and one evaluation. x is scaled time since the start of the piece, S times seconds.
namespace petrichor::weather {
namespace {

constexpr double kSampleLength_s =
    1.0 / 256.0;                           // of scaled time, where a rate changes by 1 between keys
constexpr double kMostSamples = 200000.0;  // more would cost memory; they become longer instead
constexpr double kAfterLastKey_us = 4.0e15;  // 126 years: events are looked for that far

double saturate(double x)
{
    return std::clamp(x, 0.0, 1.0);
}

Polynomial to_polynomial(const ChannelCubic& cubic, double time_scale)
{
    Polynomial p;
    p.degree = 3;
    for (std::size_t i = 0; i < 4; ++i) p.c[i] = cubic.c[i];
    return stretched(p, 1.0 / time_scale);
}

}  // namespace

// The parameters that the equations use.
struct ArtistTimeline::Rates {
    bool scripted = true;
    double time_scale = 1.0;
    double phase = 1.0;  // P
    double gain_film = 0.0, gain_cracks = 0.0, gain_puddles = 0.0, gain_snow = 0.0;
    double loss_film = 0.0, loss_cracks = 0.0, loss_puddles = 0.0;

    explicit Rates(const ArtistParams& p)
        : scripted(p.script_controlled),
          time_scale(p.time_scale),
          phase(p.water_to_snow_time_scale),
          gain_film(p.accumulation_rate_wetness),
          gain_cracks(p.accumulation_rate_cracks),
          gain_puddles(p.accumulation_rate_puddles),
          gain_snow(p.accumulation_rate_snow),
          loss_film(p.evaporation_rate_wetness),
          loss_cracks(p.evaporation_rate_cracks),
          loss_puddles(p.evaporation_rate_puddles)
    {
    }
    bool operator==(const Rates&) const = default;
    bool still() const { return !scripted || time_scale == 0.0; }
};

struct ArtistTimeline::Piece {
    double start_us = 0.0;
    ChannelCubic temperature_c;  // from start_us on
    ChannelCubic rainfall;
    std::size_t rates = 0;  // index into Solution::rates
    bool key = false;       // starts at a key, so it can be an anchor
    bool warm = false;
    bool beyond_40 = false;  // |T| acts as 40
    bool dry = false;        // rainfall is 0 all along
    bool moving = false;     // W changes
    ArtistState state;       // at start_us
};

struct ArtistTimeline::Solution {
    std::vector<Rates> rates;
    std::vector<Piece> pieces;

    // q = |T|/40 at most 1, R, W as polynomials of x.
    struct Drivers {
        Polynomial drive, rain, frozen;
    };
    Drivers drivers_of(const Piece& piece) const
    {
        const Rates& r = rates[piece.rates];
        Drivers d;
        d.drive = piece.beyond_40 ? constant(1.0)
                                  : (piece.warm ? 0.025 : -0.025) *
                                        to_polynomial(piece.temperature_c, r.time_scale);
        d.rain = piece.dry ? constant(0.0) : to_polynomial(piece.rainfall, r.time_scale);
        d.frozen = constant(piece.state.water_to_snow);
        if (piece.moving) {
            d.frozen = d.frozen + (piece.warm ? -r.phase : r.phase) * integral(d.drive);
        }
        return d;
    }

    // The closed form. Warm, with J the integral of 1 - W:  S = S0 exp(-4 P J); what melts goes to
    // the film. Cold, with u = P times the integral of W, at most M0 = max(C0, U0): all water
    // freezes at the same speed and S gains the integral of (M0 - u) du.
    ArtistState advance(const Piece& piece, double seconds) const
    {
        const Rates& r = rates[piece.rates];
        ArtistState s = piece.state;
        if (r.still() || !(seconds > 0.0)) return s;
        const double x = r.time_scale * seconds;
        const Drivers d = drivers_of(piece);
        s.water_to_snow = saturate(d.frozen(x));
        if (piece.warm) {
            const Polynomial liquid = constant(1.0) - d.frozen;
            const double fallen = piece.dry ? 0.0 : integral(d.rain * liquid)(x);
            const double dried = piece.dry ? integral(d.drive)(x) : 0.0;
            s.snow =
                saturate(piece.state.snow * portable_exp(-4.0 * r.phase * integral(liquid)(x)));
            const double melted = piece.state.snow - s.snow;
            s.cracks = saturate(s.cracks + r.gain_cracks * fallen - r.loss_cracks * dried);
            s.puddles = saturate(s.puddles + r.gain_puddles * fallen - r.loss_puddles * dried);
            s.wetness = saturate(s.wetness + r.gain_film * fallen + melted - r.loss_film * dried);
        } else {
            const double snowed = piece.dry ? 0.0 : integral(d.rain * d.frozen)(x);
            const double freeze = r.phase * integral(d.frozen)(x);
            const double most = std::max(s.cracks, s.puddles);
            const double u = std::min(freeze, most);
            s.snow = saturate(s.snow + r.gain_snow * snowed + (most - 0.5 * u) * u);
            s.cracks = saturate(s.cracks - freeze);
            s.puddles = saturate(s.puddles - freeze);
            s.wetness = saturate(s.wetness - freeze);
        }
        s.water = std::max(s.cracks, s.puddles);
        return s;
    }

    // Where the film of a warm, dry piece turns within `seconds`: zeros of the rate
    // g = 4 P (1 - W) S - Em q. The sign of g is that of ln(4 P (1 - W) S) - ln(Em q), whose
    // derivative times q (1 - W) is a polynomial; between its zeros g changes sign at most once.
    std::vector<double> film_turns(const Piece& piece, double seconds) const
    {
        const Rates& r = rates[piece.rates];
        if (r.still() || !piece.warm || !piece.dry || r.loss_film == 0.0 || r.phase == 0.0 ||
            piece.state.snow == 0.0) {
            return {};
        }
        const Drivers d = drivers_of(piece);
        const Polynomial liquid = constant(1.0) - d.frozen;
        const Polynomial melt_path = integral(liquid);
        const auto rate = [&](double x) {
            return 4.0 * r.phase * liquid(x) * piece.state.snow *
                       portable_exp(-4.0 * r.phase * melt_path(x)) -
                   r.loss_film * d.drive(x);
        };
        const Polynomial bend = (piece.moving ? r.phase * (d.drive * d.drive) : constant(0.0)) -
                                4.0 * r.phase * (liquid * liquid * d.drive) -
                                derivative(d.drive) * liquid;
        const double length = r.time_scale * seconds;
        std::vector<double> bounds = sign_changes(bend, 0.0, length);
        bounds.insert(bounds.begin(), 0.0);
        bounds.push_back(length);
        std::vector<double> turns;
        for (std::size_t i = 0; i + 1 < bounds.size(); ++i) {
            // Just inside: where the air passes 0 C with W = 1 both terms start from 0.
            const double inside = bounds[i] + 1e-6 * std::min(1.0, bounds[i + 1] - bounds[i]);
            const double left = rate(inside);
            const double right = rate(bounds[i + 1]);
            if ((left < 0.0 && right > 0.0) || (left > 0.0 && right < 0.0)) {
                turns.push_back(bisect(rate, inside, bounds[i + 1]) / r.time_scale);
            }
        }
        return turns;
    }

    // When W reaches its bound within `seconds`, or nothing (negative).
    double phase_end(const Piece& piece, double seconds) const
    {
        const Rates& r = rates[piece.rates];
        if (!piece.moving) return -1.0;
        const Polynomial frozen = drivers_of(piece).frozen;
        const double length = r.time_scale * seconds;
        const auto left_over = [&](double x) { return piece.warm ? frozen(x) : 1.0 - frozen(x); };
        if (left_over(length) >= 0.0) return -1.0;
        return bisect(left_over, 0.0, length) / r.time_scale;
    }

    // Adds a piece up to `end_us`, cut where the film turns; returns the state at the end.
    ArtistState add_cut_at_film_turns(Piece piece, double end_us, const Timeline& timeline)
    {
        const double start_us = piece.start_us;
        for (double turn : film_turns(piece, (end_us - start_us) * 1e-6)) {
            const double at_us = start_us + turn * 1e6;
            if (!(at_us > piece.start_us && at_us < end_us)) continue;
            pieces.push_back(piece);
            piece.state = advance(piece, (at_us - piece.start_us) * 1e-6);
            move_start(piece, at_us, timeline);
        }
        pieces.push_back(piece);
        return advance(piece, (end_us - piece.start_us) * 1e-6);
    }

    static void move_start(Piece& piece, double start_us, const Timeline& timeline)
    {
        piece.start_us = start_us;
        piece.temperature_c = cubic_at(timeline.temperature_c, start_us);
        piece.rainfall = cubic_at(timeline.rainfall, start_us);
        piece.key = false;
    }

    // Constant rates, no key inside: cuts at the events of the inputs, then of the phase.
    ArtistState add_interval(Piece piece, double end_us, const Timeline& timeline)
    {
        const double begin_us = piece.start_us;
        const double length_s = (end_us - begin_us) * 1e-6;
        const Polynomial temperature = to_polynomial(piece.temperature_c, 1.0);
        const Polynomial rainfall = to_polynomial(piece.rainfall, 1.0);
        std::vector<double> cuts = sign_changes(rainfall, 0.0, length_s);
        for (double level : {0.0, 40.0, -40.0}) {
            const auto found = sign_changes(temperature - constant(level), 0.0, length_s);
            cuts.insert(cuts.end(), found.begin(), found.end());
        }
        std::sort(cuts.begin(), cuts.end());
        cuts.push_back(length_s);
        for (double cut : cuts) {
            const double cut_us = cut == length_s ? end_us : begin_us + cut * 1e6;
            if (!(cut_us > piece.start_us && cut_us <= end_us)) continue;
            const double middle = 0.5 * ((piece.start_us - begin_us) + (cut_us - begin_us)) * 1e-6;
            piece.warm = temperature(middle) > 0.0;
            piece.beyond_40 = std::abs(temperature(middle)) > 40.0;
            piece.dry = !(rainfall(middle) > 0.0);
            const double w = piece.state.water_to_snow;
            piece.moving = !rates[piece.rates].still() && (piece.warm ? w > 0.0 : w < 1.0);
            const double bound_us =
                piece.start_us + 1e6 * phase_end(piece, (cut_us - piece.start_us) * 1e-6);
            if (bound_us > piece.start_us && bound_us < cut_us) {
                piece.state = add_cut_at_film_turns(piece, bound_us, timeline);
                piece.state.water_to_snow = piece.warm ? 0.0 : 1.0;
                piece.moving = false;
                move_start(piece, bound_us, timeline);
            }
            piece.state = add_cut_at_film_turns(piece, cut_us, timeline);
            move_start(piece, cut_us, timeline);
        }
        return piece.state;
    }

    std::size_t index_of(const Rates& wanted)
    {
        if (rates.empty() || !(rates.back() == wanted)) rates.push_back(wanted);
        return rates.size() - 1;
    }
};

namespace {

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
        state.*value = saturate(state.*value);
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
