#ifndef PETRICHOR_WEATHER_MODELS_ARTIST_TIMELINE_H
#define PETRICHOR_WEATHER_MODELS_ARTIST_TIMELINE_H

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "weather/models/artist/model.h"

namespace petrichor::weather {

/// Microseconds since the start of the run.
using TimeUs = std::int64_t;

/// Nearest microsecond. `seconds` within +-9e9 (285 years); throws Error otherwise and for NaN.
TimeUs to_time_us(double seconds);
inline double to_seconds(TimeUs time)
{
    return static_cast<double>(time) * 1e-6;
}

/// What a channel does between two keys.
enum class Interpolation {
    Hold,    ///< keeps the value of the last key
    Linear,  ///< straight lines
    Smooth,  ///< cubic through every key, flat at the ends and at extremes, never overshoots
};
/// "hold", "linear", "smooth"; nothing for any other word.
std::optional<Interpolation> interpolation_named(std::string_view name);
std::string_view name_of(Interpolation interpolation);

/// Change a second just before and just after a key of a Smooth channel; NaN: chosen as for Smooth.
struct KeySlopes {
    double in = std::numeric_limits<double>::quiet_NaN();
    double out = std::numeric_limits<double>::quiet_NaN();
};

/// One number over time. Before the first key it has the first value, after the last the last.
struct Channel {
    std::vector<TimeUs> times;   ///< strictly increasing
    std::vector<double> values;  ///< one a time
    Interpolation interpolation = Interpolation::Hold;
    std::vector<KeySlopes> slopes = {};  ///< of the first keys, as far as they are given

    bool empty() const { return times.empty(); }
};
/// The least and the largest value that a channel ever has. Throws Error for an empty channel.
struct ChannelRange {
    double low = 0.0;
    double high = 0.0;
};
ChannelRange range_of(const Channel& channel);

/// A channel that never changes.
Channel constant_channel(double value);

/// The value in force from `time_us` on: a Hold channel has already jumped at its key.
/// `time_us` may lie between two microseconds. Throws Error for an empty channel.
double value_at(const Channel& channel, double time_us);

/// The value in force until `time_us`: a Hold channel has not yet jumped at its key. The same as
/// value_at elsewhere, and at or before the first key.
double value_before(const Channel& channel, double time_us);

/// A channel just after a time as c0 + c1 x + c2 x^2 + c3 x^3, x in seconds after that time; good
/// until the next key of the channel.
struct ChannelCubic {
    double c[4] = {0.0, 0.0, 0.0, 0.0};
};
ChannelCubic cubic_at(const Channel& channel, double time_us);

/// What drives the artist model: the two inputs, and any of its parameters by their names in
/// ArtistParams (and "script_controlled": 0 off, anything else on).
struct Timeline {
    Channel temperature_c;
    Channel rainfall;  ///< 0..1
    std::map<std::string, Channel, std::less<>> parameters{};
    /// States set by hand, 0..1, by the names of hand_set_states(). They count while script control
    /// is off, each from its first key on; when the script takes over again it goes on from them.
    std::map<std::string, Channel, std::less<>> states{};

    /// Time of the last key of any channel; 0 without keys.
    TimeUs end() const;
};

/// Throws Error when a channel is not as Channel says (order, lengths, finite values), when a
/// parameter has a name that ArtistParams has not, or when an input has no key.
void check_timeline(const Timeline& timeline);

/// A state that can be set by hand: all but rain, snowfall and water (docs/lux.md, 1).
struct HandSetState {
    std::string_view name;
    double ArtistState::*member;
};
std::span<const HandSetState> hand_set_states();

/// `state` with what is set by hand at a time (or, `before`, until it); the caller has found script
/// control to be off.
ArtistState hand_set(const Timeline& timeline, ArtistState state, double time_us,
                     bool before = false);

/// The parameters in force from (or, `before`, until) a time: `base`, with what the timeline keys.
ArtistParams params_at(const Timeline& timeline, const ArtistParams& base, double time_us);
ArtistParams params_before(const Timeline& timeline, const ArtistParams& base, double time_us);

}  // namespace petrichor::weather

#endif
