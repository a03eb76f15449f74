#include "weather/models/artist/timeline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/error.h"

namespace petrichor::weather {
namespace {

constexpr double kAutomatic = std::numeric_limits<double>::quiet_NaN();

// Index of the key in force at `time_us`; 0 before the first. `strictly` excludes a key at the
// time.
std::size_t key_in_force(const Channel& channel, double time_us, bool strictly)
{
    const auto& times = channel.times;
    const auto after =
        strictly
            ? std::lower_bound(times.begin(), times.end(), time_us,
                               [](TimeUs key, double t) { return static_cast<double>(key) < t; })
            : std::upper_bound(times.begin(), times.end(), time_us,
                               [](double t, TimeUs key) { return t < static_cast<double>(key); });
    return after == times.begin() ? 0 : static_cast<std::size_t>(after - times.begin()) - 1;
}

double key_time(const Channel& channel, std::size_t i)
{
    return static_cast<double>(channel.times[i]);
}

KeySlopes given_slopes(const Channel& channel, std::size_t i)
{
    return i < channel.slopes.size() ? channel.slopes[i] : KeySlopes{};
}

// Value change per second at key i of a Smooth channel: as given, else from it and its neighbours.
double smooth_slope(const Channel& channel, std::size_t i, double given)
{
    if (!std::isnan(given)) return given;
    const std::size_t first = i == 0 ? 0 : i - 1;
    const std::size_t last = std::min(i + 1, channel.times.size() - 1);
    std::vector<CurveKey> keys;
    for (std::size_t k = first; k <= last; ++k) {
        keys.push_back(
            {(key_time(channel, k) - key_time(channel, i)) * 1e-6, channel.values[k], 0.0, 0.0});
    }
    return automatic_tangents(std::move(keys))[i - first].slope_out;
}

double interpolated(const Channel& channel, double time_us, bool strictly)
{
    if (channel.empty()) {
        throw Error("timeline: a channel has no keys", "Give it at least one key.");
    }
    const std::size_t i = key_in_force(channel, time_us, strictly);
    const double since_us = time_us - key_time(channel, i);
    if (channel.interpolation == Interpolation::Hold || since_us <= 0.0 ||
        i + 1 == channel.times.size()) {
        return channel.values[i];
    }
    const ChannelCubic cubic = cubic_at(channel, key_time(channel, i));
    const double x = since_us * 1e-6;
    return ((cubic.c[3] * x + cubic.c[2]) * x + cubic.c[1]) * x + cubic.c[0];
}

void check_channel(const Channel& channel, const std::string& name, bool needed)
{
    if (channel.times.size() != channel.values.size()) {
        throw Error("timeline: " + name + " has " + std::to_string(channel.times.size()) +
                        " times and " + std::to_string(channel.values.size()) + " values",
                    "Give each key one time and one value.");
    }
    if (needed && channel.empty()) {
        throw Error("timeline: " + name + " has no keys", "Give it at least one key.");
    }
    if (channel.slopes.size() > channel.times.size()) {
        throw Error("timeline: " + name + " has more slopes than keys", "Give each key one pair.");
    }
    for (const KeySlopes& slopes : channel.slopes) {
        if (std::isinf(slopes.in) || std::isinf(slopes.out)) {
            throw Error("timeline: a slope of " + name + " is not finite",
                        "Give a slope a second, or leave it out.");
        }
    }
    for (std::size_t i = 0; i < channel.times.size(); ++i) {
        if (!std::isfinite(channel.values[i])) {
            throw Error("timeline: " + name + " is not a finite number at " +
                            std::to_string(to_seconds(channel.times[i])) + " s",
                        "Give every key a finite value.");
        }
        if (i > 0 && channel.times[i] <= channel.times[i - 1]) {
            throw Error("timeline: keys of " + name + " are not in order at " +
                            std::to_string(to_seconds(channel.times[i])) + " s",
                        "Sort the keys by time and remove duplicates.");
        }
    }
}

ArtistParams with_channels(const Timeline& timeline, ArtistParams params, double time_us,
                           bool strictly)
{
    for (const auto& [name, channel] : timeline.parameters) {
        if (name == "script_controlled") {
            params.script_controlled = interpolated(channel, time_us, strictly) != 0.0;
            continue;
        }
        for (const ArtistParameter& parameter : artist_parameters()) {
            if (parameter.name == name) {
                params.*parameter.member = interpolated(channel, time_us, strictly);
            }
        }
    }
    return params;
}

}  // namespace

TimeUs to_time_us(double seconds)
{
    if (!(std::abs(seconds) <= 9e9)) {
        throw Error("time: " + std::to_string(seconds) + " s is not within +-9e9 s",
                    "Count times in seconds from the start of the run.");
    }
    return static_cast<TimeUs>(std::llround(seconds * 1e6));
}

std::optional<Interpolation> interpolation_named(std::string_view name)
{
    for (auto kind : {Interpolation::Hold, Interpolation::Linear, Interpolation::Smooth}) {
        if (name == name_of(kind)) return kind;
    }
    return std::nullopt;
}

std::string_view name_of(Interpolation interpolation)
{
    switch (interpolation) {
        case Interpolation::Linear:
            return "linear";
        case Interpolation::Smooth:
            return "smooth";
        case Interpolation::Hold:
            break;
    }
    return "hold";
}

ChannelRange range_of(const Channel& channel)
{
    if (channel.empty()) {
        throw Error("timeline: a channel has no keys", "Give it at least one key.");
    }
    const auto [low, high] = std::minmax_element(channel.values.begin(), channel.values.end());
    ChannelRange range{*low, *high};
    for (std::size_t i = 0; i + 1 < channel.times.size(); ++i) {
        const ChannelCubic cubic = cubic_at(channel, key_time(channel, i));
        const double span = (key_time(channel, i + 1) - key_time(channel, i)) * 1e-6;
        // Where the derivative c1 + 2 c2 x + 3 c3 x^2 is zero.
        const double a = 3.0 * cubic.c[3], b = cubic.c[2], c = cubic.c[1];
        const double root = b * b - a * c;
        if (root < 0.0) continue;
        const double q = -(b + std::copysign(std::sqrt(root), b));
        for (const double x : {a != 0.0 ? q / a : -1.0, q != 0.0 ? c / q : -1.0}) {
            if (!(x > 0.0 && x < span)) continue;
            const double value = ((cubic.c[3] * x + cubic.c[2]) * x + cubic.c[1]) * x + cubic.c[0];
            range.low = std::min(range.low, value);
            range.high = std::max(range.high, value);
        }
    }
    return range;
}

Channel constant_channel(double value)
{
    return {.times = {0}, .values = {value}, .interpolation = Interpolation::Hold};
}

double value_at(const Channel& channel, double time_us)
{
    return interpolated(channel, time_us, false);
}

double value_before(const Channel& channel, double time_us)
{
    return interpolated(channel, time_us, true);
}

ChannelCubic cubic_at(const Channel& channel, double time_us)
{
    if (channel.empty()) {
        throw Error("timeline: a channel has no keys", "Give it at least one key.");
    }
    const std::size_t i = key_in_force(channel, time_us, false);
    ChannelCubic cubic{{channel.values[i], 0.0, 0.0, 0.0}};
    const double since_us = time_us - key_time(channel, i);
    if (channel.interpolation == Interpolation::Hold || since_us < 0.0 ||
        i + 1 == channel.times.size()) {
        return cubic;
    }
    const bool smooth = channel.interpolation == Interpolation::Smooth;
    const double out = smooth ? given_slopes(channel, i).out : kAutomatic;
    const double in = smooth ? given_slopes(channel, i + 1).in : kAutomatic;
    const bool automatic = std::isnan(out) && std::isnan(in);
    if (automatic && channel.values[i] == channel.values[i + 1]) return cubic;
    const double span = (key_time(channel, i + 1) - key_time(channel, i)) * 1e-6;
    const double secant = (channel.values[i + 1] - channel.values[i]) / span;
    if (channel.interpolation == Interpolation::Linear) {
        cubic.c[1] = secant;
    } else {
        const double left = smooth_slope(channel, i, out);
        const double right = smooth_slope(channel, i + 1, in);
        cubic.c[1] = left;
        cubic.c[2] = (3.0 * secant - 2.0 * left - right) / span;
        cubic.c[3] = (left + right - 2.0 * secant) / (span * span);
    }
    // Taylor's shift from the key to the time asked for.
    const double x = since_us * 1e-6;
    for (int low = 0; low < 3; ++low) {
        for (int k = 2; k >= low; --k) cubic.c[k] += x * cubic.c[k + 1];
    }
    return cubic;
}

TimeUs Timeline::end() const
{
    TimeUs last = 0;
    const auto extend = [&](const Channel& channel) {
        if (!channel.empty()) last = std::max(last, channel.times.back());
    };
    extend(temperature_c);
    extend(rainfall);
    for (const auto& [name, channel] : parameters) extend(channel);
    for (const auto& [name, channel] : states) extend(channel);
    return last;
}

void check_timeline(const Timeline& timeline)
{
    check_channel(timeline.temperature_c, "temperature_c", true);
    check_channel(timeline.rainfall, "rainfall", true);
    for (const auto& entry : timeline.parameters) {
        const std::string& name = entry.first;
        const Channel& channel = entry.second;
        const auto known = artist_parameters();
        if (name != "script_controlled" &&
            std::none_of(known.begin(), known.end(),
                         [&](const ArtistParameter& p) { return p.name == name; })) {
            throw Error("timeline: no parameter is named " + name,
                        "Use a name of ArtistParams, for example time_scale.");
        }
        check_channel(channel, name, true);
    }
    for (const auto& entry : timeline.states) {
        const auto known = hand_set_states();
        if (std::none_of(known.begin(), known.end(),
                         [&](const HandSetState& s) { return s.name == entry.first; })) {
            throw Error("timeline: no state that can be set by hand is named " + entry.first,
                        "Use wetness, cracks, puddles, snow or water_to_snow.");
        }
        check_channel(entry.second, entry.first, true);
    }
}

std::span<const HandSetState> hand_set_states()
{
    using S = ArtistState;
    static constexpr std::array<HandSetState, 5> kStates{{{"wetness", &S::wetness},
                                                          {"cracks", &S::cracks},
                                                          {"puddles", &S::puddles},
                                                          {"snow", &S::snow},
                                                          {"water_to_snow", &S::water_to_snow}}};
    return kStates;
}

ArtistState hand_set(const Timeline& timeline, ArtistState state, double time_us, bool before)
{
    for (const auto& [name, channel] : timeline.states) {
        const double first = key_time(channel, 0);
        if (before ? time_us <= first : time_us < first) continue;
        for (const HandSetState& s : hand_set_states()) {
            if (s.name == name) state.*s.member = interpolated(channel, time_us, before);
        }
    }
    return state;
}

ArtistParams params_at(const Timeline& timeline, const ArtistParams& base, double time_us)
{
    return with_channels(timeline, base, time_us, false);
}

ArtistParams params_before(const Timeline& timeline, const ArtistParams& base, double time_us)
{
    return with_channels(timeline, base, time_us, true);
}

}  // namespace petrichor::weather
