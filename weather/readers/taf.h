#ifndef PETRICHOR_WEATHER_READERS_TAF_H
#define PETRICHOR_WEATHER_READERS_TAF_H

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "weather/readers/metar.h"

namespace petrichor::weather {

/// A time as forecasts say it: day of a month that they do not name. Hour 24 ends the day.
struct TafTime {
    int day = 0, hour = 0, minute = 0;
    int days_later = 0;  ///< to be added: in the form of before 2008 hours run into the next day
};

/// A group of a forecast: what it says, from when to when.
struct TafGroup {
    enum class Kind : std::uint8_t {
        From,      ///< the first group and FM: everything new, at once
        Becoming,  ///< BECMG: what is named changes, evenly from begin to end, and then stays
        Passing    ///< TEMPO, PROB, INTER: what is named may hold between begin and end
    };
    Kind kind = Kind::From;
    /// Share of a passing group in the expected weather: TEMPO 0.5 (each spell below an hour, below
    /// half of the time together), INTER 0.25, PROB30 0.3, PROB40 0.4, PROB30 TEMPO 0.15, ..
    double share = 1.0;
    TafTime begin, end;
    std::int64_t begin_us = 0, end_us = 0;  ///< after place_taf; From: end_us is not used
    MetarReport weather;                    ///< what is not named is NaN
    bool weather_named = false;  ///< rain and snow are named: a group as -RA, NSW or CAVOK
};

/// A forecast as written.
struct TafForecast {
    std::string station;
    TafTime issued;  ///< day 0 when it does not say
    TafTime begin, end;
    bool nil = false, cancelled = false;
    std::vector<TafGroup> groups;                            ///< the first is the base
    std::vector<std::pair<TafTime, double>> temperatures_c;  ///< TX and TN groups
    long long year = 0;                                      ///< 0 when the file does not say
    int month = 0;
    std::size_t line = 0;

    std::int64_t issued_us = 0, begin_us = 0, end_us = 0;                 ///< after place_taf
    std::vector<std::pair<std::int64_t, double>> temperatures_at_us_c{};  ///< likewise
};

/// Parses a forecast that begins at the station code, without TAF; AMD and COR may come first.
/// Takes validity as 0106/0212 and in the form of before 2008 (010612, with groups as FM0800 and
/// TEMPO 0812). Nothing when there is no station or no validity.
std::optional<TafForecast> parse_taf(std::string_view text);

/// Dates the forecast: its days of a month become times, each nearest to the one that it follows
/// (the issue to `near_us`, the beginning to the issue, the groups to the beginning), so a turn of
/// the month or the year needs no care. False when a day does not exist there or the validity is
/// not above 0 and at most 72 h.
bool place_taf(TafForecast& taf, std::int64_t near_us);

/// What to make of groups that may hold.
enum class TafUse : std::uint8_t {
    Expected,    ///< the mean: rates, wind, sight and cloud mixed by the groups' shares
    Prevailing,  ///< as if they were not there
    Worst        ///< most precipitation and cloud, strongest wind, least sight
};

/// The weather of a placed forecast: its values at `from_us`, its rates over [from_us, to_us),
/// within which no group may begin or end (BECMG is taken at the middle).
MetarReport taf_weather(const TafForecast& taf, std::int64_t from_us, std::int64_t to_us,
                        TafUse use);

/// The times of rows: every whole hour of the validity, its end, and where a group begins or ends
/// in between. Ascending.
std::vector<std::int64_t> taf_times(const TafForecast& taf);

}  // namespace petrichor::weather

#endif
