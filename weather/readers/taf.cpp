#include "weather/readers/taf.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "weather/readers/metar_groups.h"
#include "weather/readers/text.h"

namespace petrichor::weather {

namespace {

constexpr std::int64_t kHour_us = 3600000000LL;

std::optional<TafTime> time_of(int day, int hour, int minute)
{
    if (day < 1 || day > 31 || hour > 24 || minute > 59) return std::nullopt;
    return TafTime{day, hour, minute};
}

struct Span {
    TafTime begin, end;
};

// 0103/0106: day and hour, twice.
std::optional<Span> span_of(std::string_view t)
{
    if (t.size() != 9 || t[4] != '/' || !all_digits(t.substr(0, 4)) || !all_digits(t.substr(5)))
        return std::nullopt;
    const auto begin = time_of(digits_value(t.substr(0, 2)), digits_value(t.substr(2, 2)), 0);
    const auto end = time_of(digits_value(t.substr(5, 2)), digits_value(t.substr(7, 2)), 0);
    if (!begin || !end) return std::nullopt;
    return Span{*begin, *end};
}

// Hours of the old form count from the day on which the validity begins; smaller ones are of the
// next day.
TafTime old_hour(const TafTime& begin, int hour, int minute)
{
    return {begin.day, hour, minute, hour < begin.hour ? 1 : 0};
}

// 010612: day, first and last hour.
std::optional<Span> old_validity(std::string_view t)
{
    if (t.size() != 6 || !all_digits(t)) return std::nullopt;
    const auto begin = time_of(digits_value(t.substr(0, 2)), digits_value(t.substr(2, 2)), 0);
    const int last = digits_value(t.substr(4, 2));
    if (!begin || last > 24) return std::nullopt;
    TafTime end = old_hour(*begin, last, 0);
    if (last == begin->hour) end.days_later = 1;
    return Span{*begin, end};
}

// 0812 after BECMG, TEMPO or PROB in the old form.
std::optional<Span> old_span(std::string_view t, const TafTime& begin)
{
    if (t.size() != 4 || !all_digits(t)) return std::nullopt;
    const int first = digits_value(t.substr(0, 2)), last = digits_value(t.substr(2, 2));
    if (first > 24 || last > 24) return std::nullopt;
    Span span{old_hour(begin, first, 0), old_hour(begin, last, 0)};
    if (last <= first && span.end.days_later == span.begin.days_later) ++span.end.days_later;
    return span;
}

// TX12/0114Z, TNM03/0105Z
std::optional<std::pair<TafTime, double>> extreme_of(std::string_view t)
{
    if (t.substr(0, 2) != "TX" && t.substr(0, 2) != "TN") return std::nullopt;
    const auto slash = t.find('/');
    if (slash == std::string_view::npos) return std::nullopt;
    auto value = t.substr(2, slash - 2);
    const auto at = t.substr(slash + 1, 4);
    const bool minus = !value.empty() && value[0] == 'M';
    if (minus) value.remove_prefix(1);
    if (value.size() > 2 || !all_digits(value) || at.size() != 4 || !all_digits(at))
        return std::nullopt;
    const auto time = time_of(digits_value(at.substr(0, 2)), digits_value(at.substr(2, 2)), 0);
    if (!time) return std::nullopt;
    return std::pair{*time,
                     static_cast<double>(minus ? -digits_value(value) : digits_value(value))};
}

// Puts the groups of a text after the validity into a forecast, token by token.
class GroupReader {
public:
    GroupReader(TafForecast& taf, bool old_form) : taf_(taf), old_(old_form)
    {
        open(TafGroup::Kind::From, 1.0, {taf.begin, taf.end});
    }

    // Whether more tokens belong to the forecast.
    bool take(std::string_view t)
    {
        if (t == "RMK") return false;
        if (t == "CNL") taf_.cancelled = true;
        if (take_time(t) || take_change(t)) return true;
        if (const auto extreme = extreme_of(t)) {
            taf_.temperatures_c.push_back(*extreme);
            return true;
        }
        take_weather_of(t);
        return true;
    }

private:
    TafGroup& group() { return taf_.groups.back(); }
    void open(TafGroup::Kind kind, double share, const Span& span)
    {
        taf_.groups.push_back({});
        group().kind = kind;
        group().share = share;
        group().begin = span.begin;
        group().end = span.end;
        // What FM does not name is not there; what others do not name stays as it is.
        group().weather_named = kind == TafGroup::Kind::From;
        fresh_ = kind != TafGroup::Kind::From;
        whole_miles_ = 0.0;
    }

    // The time that follows BECMG, TEMPO or PROB; without one they hold throughout.
    bool take_time(std::string_view t)
    {
        if (!fresh_) return false;
        auto span = span_of(t);
        if (!span && old_) span = old_span(t, taf_.begin);
        if (!span) return false;
        group().begin = span->begin;
        group().end = span->end;
        fresh_ = false;
        return true;
    }

    bool take_change(std::string_view t)
    {
        const Span whole{taf_.begin, taf_.end};
        if (t.substr(0, 2) == "FM" && all_digits(t.substr(2))) {
            std::optional<TafTime> at;
            if (t.size() == 8) {
                at = time_of(digits_value(t.substr(2, 2)), digits_value(t.substr(4, 2)),
                             digits_value(t.substr(6, 2)));
            } else if (old_ && t.size() == 6 && digits_value(t.substr(2, 2)) <= 24) {
                at = old_hour(taf_.begin, digits_value(t.substr(2, 2)),
                              digits_value(t.substr(4, 2)) % 60);
            }
            if (!at) return false;
            open(TafGroup::Kind::From, 1.0, {*at, taf_.end});
            return true;
        }
        if (t == "BECMG") {
            open(TafGroup::Kind::Becoming, 1.0, whole);
            return true;
        }
        if (t.size() == 6 && t.substr(0, 4) == "PROB" && all_digits(t.substr(4))) {
            open(TafGroup::Kind::Passing, digits_value(t.substr(4)) / 100.0, whole);
            return true;
        }
        if (t == "TEMPO" || t == "INTER") {
            const double share = t == "TEMPO" ? 0.5 : 0.25;
            const bool after_prob = fresh_ && group().kind == TafGroup::Kind::Passing;
            if (after_prob)
                group().share *= share;  // PROB30 TEMPO
            else
                open(TafGroup::Kind::Passing, share, whole);
            return true;
        }
        return false;
    }

    void take_weather_of(std::string_view t)
    {
        fresh_ = false;
        MetarReport& weather = group().weather;
        if (t == "NSW") {
            group().weather_named = true;
            return;
        }
        if (t.size() <= 2 && all_digits(t)) {  // the 1 of 1 1/2SM
            whole_miles_ = digits_value(t);
            return;
        }
        if (t.size() == 10 && t.substr(0, 3) == "QNH" && t.substr(7) == "INS" &&
            all_digits(t.substr(3, 4))) {
            weather.qnh_pa = digits_value(t.substr(3, 4)) * 33.86389;
            return;
        }
        if (take_visibility(t, weather, whole_miles_)) {
            if (t == "CAVOK") group().weather_named = true;
            whole_miles_ = 0.0;
        } else if (!take_wind(t, weather) && !take_pressure(t, weather) &&
                   !take_cloud(t, weather) && take_weather(t, weather)) {
            group().weather_named = true;
        }
    }

    TafForecast& taf_;
    bool old_;
    bool fresh_ = false;  // a change word was just read, its time may follow
    double whole_miles_ = 0.0;
};

// The moment with this day of the month that is nearest to another.
std::optional<std::int64_t> nearest(const TafTime& time, std::int64_t near_us)
{
    const CivilTime near = civil_from_us(near_us);
    std::optional<std::int64_t> best;
    for (int month = near.month - 1; month <= near.month + 1; ++month) {
        CivilTime at{near.year + (month > 12) - (month < 1),
                     (month + 11) % 12 + 1,
                     time.day,
                     time.hour,
                     time.minute,
                     0.0};
        auto us = us_from_civil(at);
        if (us) *us += time.days_later * 24 * kHour_us;
        if (us && (!best || std::llabs(*us - near_us) < std::llabs(*best - near_us))) best = us;
    }
    return best;
}

double mixed(double now, double next, double share)
{
    if (std::isnan(next)) return now;
    return std::isnan(now) ? next : now + (next - now) * share;
}

// What a group names replaces a share of what was.
void mix(MetarReport& now, const TafGroup& group, double share)
{
    const MetarReport& next = group.weather;
    now.wind_m_s = mixed(now.wind_m_s, next.wind_m_s, share);
    now.visibility_m = mixed(now.visibility_m, next.visibility_m, share);
    now.cloud = mixed(now.cloud, next.cloud, share);
    now.qnh_pa = mixed(now.qnh_pa, next.qnh_pa, share);
    if (share >= 0.5 && !std::isnan(next.wind_from_deg)) now.wind_from_deg = next.wind_from_deg;
    if (group.weather_named) {
        now.rain_mm_h = mixed(now.rain_mm_h, next.rain_mm_h, share);
        now.snow_mm_h = mixed(now.snow_mm_h, next.snow_mm_h, share);
        now.weather_seen = now.weather_seen || next.weather_seen;
    }
}

// The worse of both in everything.
void worsen(MetarReport& now, const TafGroup& group)
{
    const MetarReport& other = group.weather;
    now.wind_m_s = std::fmax(now.wind_m_s, other.wind_m_s);
    now.visibility_m = std::fmin(now.visibility_m, other.visibility_m);
    now.cloud = std::fmax(now.cloud, other.cloud);
    if (other.rain_mm_h + other.snow_mm_h > now.rain_mm_h + now.snow_mm_h) {
        now.rain_mm_h = other.rain_mm_h;
        now.snow_mm_h = other.snow_mm_h;
        now.weather_seen = true;
    }
}

}  // namespace

std::optional<TafForecast> parse_taf(std::string_view text)
{
    const auto tokens = words(text, 400);
    std::size_t i = 0;
    while (i < tokens.size() && (tokens[i] == "AMD" || tokens[i] == "COR" || tokens[i] == "TAF"))
        ++i;
    if (i >= tokens.size() || tokens[i].size() != 4) return std::nullopt;
    TafForecast taf;
    taf.station = std::string(tokens[i++]);
    if (i < tokens.size() && tokens[i].size() == 7 && is_day_time(tokens[i])) {
        const auto t = tokens[i++];
        taf.issued = {digits_value(t.substr(0, 2)), digits_value(t.substr(2, 2)),
                      digits_value(t.substr(4, 2))};
    }
    while (i < tokens.size() && (tokens[i] == "AMD" || tokens[i] == "COR")) ++i;
    if (i >= tokens.size()) return std::nullopt;
    const auto validity = without_end(tokens[i++]);
    if (validity == "NIL") {
        taf.nil = true;
        return taf;
    }
    auto span = span_of(validity);
    const bool old_form = !span;
    if (!span) span = old_validity(validity);
    if (!span) return std::nullopt;
    taf.begin = span->begin;
    taf.end = span->end;
    GroupReader reader(taf, old_form);
    for (; i < tokens.size(); ++i) {
        const auto t = without_end(tokens[i]);
        if (!t.empty() && !reader.take(t)) break;
    }
    return taf;
}

bool place_taf(TafForecast& taf, std::int64_t near_us)
{
    const auto issued = taf.issued.day ? nearest(taf.issued, near_us) : near_us;
    if (!issued) return false;
    const auto begin = nearest(taf.begin, *issued);
    if (!begin) return false;
    const auto end = nearest(taf.end, *begin + 12 * kHour_us);
    if (!end || *end <= *begin || *end - *begin > 72 * kHour_us) return false;
    taf.issued_us = *issued;
    taf.begin_us = *begin;
    taf.end_us = *end;
    for (TafGroup& group : taf.groups) {
        const auto from = nearest(group.begin, *begin + 12 * kHour_us);
        const auto to = nearest(group.end, *begin + 12 * kHour_us);
        if (!from || !to) return false;
        group.begin_us = std::max(*from, *begin);
        group.end_us = std::max(*to, group.begin_us);
    }
    taf.temperatures_at_us_c.clear();
    for (const auto& [time, celsius] : taf.temperatures_c) {
        if (const auto us = nearest(time, *begin + 12 * kHour_us))
            taf.temperatures_at_us_c.emplace_back(*us, celsius);
    }
    return true;
}

std::vector<std::int64_t> taf_times(const TafForecast& taf)
{
    std::vector<std::int64_t> times;
    for (std::int64_t us = taf.begin_us; us < taf.end_us; us += kHour_us) times.push_back(us);
    for (const TafGroup& group : taf.groups) {
        for (const std::int64_t us : {group.begin_us, group.end_us}) {
            if (us > taf.begin_us && us < taf.end_us) times.push_back(us);
        }
    }
    times.push_back(taf.end_us);
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    return times;
}

MetarReport taf_weather(const TafForecast& taf, std::int64_t from_us, std::int64_t to_us,
                        TafUse use)
{
    MetarReport now;
    const std::int64_t middle_us = from_us + (to_us - from_us) / 2;
    for (const TafGroup& group : taf.groups) {
        if (group.kind == TafGroup::Kind::Passing || group.begin_us > from_us) continue;
        if (group.kind == TafGroup::Kind::From) {
            now = group.weather;
            continue;
        }
        const double length = static_cast<double>(group.end_us - group.begin_us);
        const double since = static_cast<double>(middle_us - group.begin_us);
        mix(now, group, length > 0.0 ? std::clamp(since / length, 0.0, 1.0) : 1.0);
    }
    if (use == TafUse::Prevailing) return now;
    for (const TafGroup& group : taf.groups) {
        if (group.kind != TafGroup::Kind::Passing || group.begin_us > from_us ||
            group.end_us <= from_us)
            continue;
        if (use == TafUse::Worst)
            worsen(now, group);
        else
            mix(now, group, group.share);
    }
    return now;
}

}  // namespace petrichor::weather
