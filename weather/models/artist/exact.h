#ifndef PETRICHOR_WEATHER_MODELS_ARTIST_EXACT_H
#define PETRICHOR_WEATHER_MODELS_ARTIST_EXACT_H

#include <cstddef>
#include <memory>
#include <string_view>
#include <vector>

#include "weather/models/artist/model.h"
#include "weather/models/artist/timeline.h"

namespace petrichor::weather {

// The artist model without steps: the limit of step() for ever shorter steps, in closed form.
//
//   Timeline script{.temperature_c = ..., .rainfall = ...};
//   const ArtistTimeline weather(script, params, initial);
//   const ArtistState state = weather.state_at(to_time_us(12.5));     // any time, in any order
//   const ArtistOutputs shown = weather.outputs_at(to_time_us(12.5));
//
// Between two keys temperature and rainfall are polynomials of time, so W is one too; water and
// snow follow from integrals of polynomials and one exponential. Events split the time axis
// exactly: temperature through 0, W reaching 0 or 1, and the turns of the film while it dries and
// is fed by melting snow. Parameters that change smoothly are sampled at the middle of pieces of
// 1/256 s of scaled time and longer, the slower they change: within 4e-5 of the limit.

/// Where an exact run can be taken up again: see ArtistTimeline::checkpoint_at.
struct ArtistCheckpoint {
    TimeUs anchor = 0;         ///< a key, or the start, before the time asked for
    ArtistState anchor_state;  ///< the state there
};

enum class ArtistEventKind {
    TurnsWarm,   ///< temperature rises above 0
    TurnsCold,   ///< temperature falls to 0 or below
    AllLiquid,   ///< W reaches 0
    AllFrozen,   ///< W reaches 1
    RainStarts,  ///< rainfall leaves 0
    RainStops,   ///< rainfall reaches 0: drying begins
};
struct ArtistEvent {
    TimeUs time = 0;  ///< rounded to a microsecond; the solution uses the exact time
    ArtistEventKind kind = ArtistEventKind::TurnsWarm;
};
/// "temperature rises above 0 C", ...
std::string_view name_of(ArtistEventKind kind);

/// The state of the artist model at every time from its start on. Immutable once built: safe to
/// read from any number of threads, the same bits for every order of access and on every machine.
class ArtistTimeline {
public:
    /// Solves the whole timeline, a few microseconds a key. Rainfall below 0 counts as 0 and the
    /// initial state is clamped to 0..1; its `rain`, `snowfall` and `water` follow from the rest.
    ///
    ///   start   time of `initial`; earlier times give the state at the start.
    ///   throws  Error for a bad timeline (check_timeline) and for rates that are negative or not
    ///           finite.
    ArtistTimeline(Timeline timeline, ArtistParams params, const ArtistState& initial,
                   TimeUs start = 0);

    /// The state at any time; after the last key the inputs stay as they are. Pure, about 1 us.
    ///
    /// The inputs are those in force until `time` (a Hold key at 2 s acts after 2 s), as in a step
    /// that ends there; at the start, those from it on. rain + snowfall == rainfall.
    ArtistState state_at(TimeUs time) const;
    /// What shaders see at that time.
    ArtistOutputs outputs_at(TimeUs time) const;

    double temperature_c_at(TimeUs time) const;
    double rainfall_at(TimeUs time) const;
    ArtistParams params_at(TimeUs time) const;

    /// What happens when, in order of time.
    std::vector<ArtistEvent> events() const;

    /// Enough to continue without the past: ArtistTimeline(timeline, params, c.anchor_state,
    /// c.anchor) gives identical bits for `time` and every time after it.
    ArtistCheckpoint checkpoint_at(TimeUs time) const;

    TimeUs start() const { return start_; }
    /// Time of the last key.
    TimeUs end() const { return timeline_.end(); }
    const Timeline& timeline() const { return timeline_; }

private:
    struct Solution;
    std::size_t piece_before(TimeUs time) const;

    Timeline timeline_;
    ArtistParams params_;
    TimeUs start_ = 0;
    std::shared_ptr<const Solution> solution_;  // shared: copies of a timeline are cheap
};

}  // namespace petrichor::weather

#endif
