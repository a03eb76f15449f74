#ifndef PETRICHOR_WEATHER_MODELS_ARTIST_DETAIL_PIECES_H
#define PETRICHOR_WEATHER_MODELS_ARTIST_DETAIL_PIECES_H

#include <cstddef>
#include <vector>

#include "weather/models/artist/detail/polynomial.h"
#include "weather/models/artist/model.h"
#include "weather/models/artist/timeline.h"

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
namespace petrichor::weather::detail {

// The parameters that the equations use.
struct Rates {
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

struct Piece {
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

struct Solution {
    std::vector<Rates> rates;
    std::vector<Piece> pieces;  // ascending

    /// Adds the pieces from `piece.start_us` to `end_us`: constant rates, no key inside. Returns
    /// the state at the end.
    ArtistState add_interval(Piece piece, double end_us, const Timeline& timeline);
    /// The index of these rates, added when they are not the last ones.
    std::size_t index_of(const Rates& wanted);
    /// Moves a piece along its inputs; it is no key any more.
    static void move_start(Piece& piece, double start_us, const Timeline& timeline);

    /// The state `seconds` after the start of a piece, which must not reach beyond its end.
    ArtistState advance(const Piece& piece, double seconds) const;

private:
    // q = |T|/40 at most 1, R, W as polynomials of x.
    struct Drivers {
        Polynomial drive, rain, frozen;
    };
    Drivers drivers_of(const Piece& piece) const;
    std::vector<double> film_turns(const Piece& piece, double seconds) const;
    double phase_end(const Piece& piece, double seconds) const;
    ArtistState add_cut_at_film_turns(Piece piece, double end_us, const Timeline& timeline);
};

}  // namespace petrichor::weather::detail

#endif
