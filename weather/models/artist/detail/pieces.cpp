#include "weather/models/artist/detail/pieces.h"

#include <algorithm>
#include <cmath>

#include "weather/models/artist/detail/math.h"

namespace petrichor::weather::detail {
namespace {

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

Solution::Drivers Solution::drivers_of(const Piece& piece) const
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
ArtistState Solution::advance(const Piece& piece, double seconds) const
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
        s.snow = saturate(piece.state.snow * portable_exp(-4.0 * r.phase * integral(liquid)(x)));
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
std::vector<double> Solution::film_turns(const Piece& piece, double seconds) const
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
double Solution::phase_end(const Piece& piece, double seconds) const
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
ArtistState Solution::add_cut_at_film_turns(Piece piece, double end_us, const Timeline& timeline)
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

void Solution::move_start(Piece& piece, double start_us, const Timeline& timeline)
{
    piece.start_us = start_us;
    piece.temperature_c = cubic_at(timeline.temperature_c, start_us);
    piece.rainfall = cubic_at(timeline.rainfall, start_us);
    piece.key = false;
}

// Constant rates, no key inside: cuts at the events of the inputs, then of the phase.
ArtistState Solution::add_interval(Piece piece, double end_us, const Timeline& timeline)
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

std::size_t Solution::index_of(const Rates& wanted)
{
    if (rates.empty() || !(rates.back() == wanted)) rates.push_back(wanted);
    return rates.size() - 1;
}

}  // namespace petrichor::weather::detail
