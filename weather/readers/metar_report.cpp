// Groups of METAR and TAF. Each take_* looks at one token and returns whether it was its group.
#include <cmath>

#include "weather/readers/metar.h"
#include "weather/readers/text.h"

namespace petrichor::weather {

namespace {

bool digits(std::string_view t)
{
    for (const char c : t) {
        if (c < '0' || c > '9') return false;
    }
    return !t.empty();
}
bool letters(std::string_view t)
{
    for (const char c : t) {
        if (c < 'A' || c > 'Z') return false;
    }
    return !t.empty();
}
int number(std::string_view t)
{
    int v = 0;
    for (const char c : t.substr(0, 6)) v = v * 10 + (c - '0');
    return v;
}
bool ends_with(std::string_view t, std::string_view end)
{
    return t.size() >= end.size() && t.substr(t.size() - end.size()) == end;
}

// 24015G25KT, VRB03MPS, /////KT, 00000KT
bool take_wind(std::string_view t, MetarReport& r)
{
    double factor = 0.0;
    std::size_t unit = 0;
    if (ends_with(t, "KT"))
        factor = 1852.0 / 3600.0, unit = 2;
    else if (ends_with(t, "MPS"))
        factor = 1.0, unit = 3;
    else if (ends_with(t, "KMH"))
        factor = 1.0 / 3.6, unit = 3;
    else
        return false;
    auto body = t.substr(0, t.size() - unit);
    if (body.size() < 5) return false;
    const auto from = body.substr(0, 3);
    if (!(digits(from) || from == "VRB" || from == "///")) return false;
    body.remove_prefix(3);
    if (!body.empty() && body[0] == 'P') body.remove_prefix(1);
    const auto gust_at = body.find('G');
    const auto speed = body.substr(0, gust_at);
    if (digits(from) && number(from) <= 360) r.wind_from_deg = number(from);
    if (digits(speed) && speed.size() <= 3) r.wind_m_s = number(speed) * factor;
    if (gust_at != std::string_view::npos && digits(body.substr(gust_at + 1)))
        r.gust_m_s = number(body.substr(gust_at + 1)) * factor;
    return true;
}

// 10SM, 1/2SM, M1/4SM, P6SM, 9999, 0800, 8000NW, 9999NDV, CAVOK
bool take_visibility(std::string_view t, MetarReport& r, double whole_miles)
{
    if (t == "CAVOK") {
        r.visibility_m = 10000.0;
        r.cloud = 0.0;
        return true;
    }
    if (ends_with(t, "SM")) {
        auto body = t.substr(0, t.size() - 2);
        if (!body.empty() && (body[0] == 'M' || body[0] == 'P')) body.remove_prefix(1);
        const auto slash = body.find('/');
        double miles = 0.0;
        if (slash != std::string_view::npos) {
            const auto top = body.substr(0, slash), bottom = body.substr(slash + 1);
            if (!digits(top) || !digits(bottom) || number(bottom) == 0) return false;
            miles = static_cast<double>(number(top)) / number(bottom);
        } else {
            if (!digits(body)) return false;
            miles = number(body);
        }
        r.visibility_m = (whole_miles + miles) * 1609.344;
        return true;
    }
    if (t.size() >= 4 && digits(t.substr(0, 4)) && (t.size() == 4 || letters(t.substr(4)))) {
        const int metres = number(t.substr(0, 4));
        const double v = metres == 9999 ? 10000.0 : metres;
        // A second group is a minimum in some direction: the first, prevailing one stays.
        if (std::isnan(r.visibility_m)) r.visibility_m = v;
        return true;
    }
    return t == "////" || t == "/////SM" || t == "////SM";
}

bool take_cloud(std::string_view t, MetarReport& r)
{
    const auto grow = [&](double fraction) {
        r.cloud = std::isnan(r.cloud) ? fraction : std::max(r.cloud, fraction);
    };
    if (t == "CLR" || t == "SKC" || t == "NSC" || t == "NCD") {
        grow(0.0);
        return true;
    }
    const auto kind = t.substr(0, 3);
    const bool height = t.size() >= 6 && (digits(t.substr(3, 3)) || t.substr(3, 3) == "///");
    if (kind == "FEW" && height)
        grow(0.19);
    else if (kind == "SCT" && height)
        grow(0.44);
    else if (kind == "BKN" && height)
        grow(0.75);
    else if (kind == "OVC" && height)
        grow(1.0);
    else if (t.substr(0, 2) == "VV" && t.size() == 5)
        grow(1.0);
    else
        return t.size() >= 6 && (t.substr(0, 3) == "///");
    return true;
}

// 12/07, M01/M13, M41/, ////, 01/M00
bool take_temperature(std::string_view t, MetarReport& r)
{
    const auto slash = t.find('/');
    if (slash == std::string_view::npos || t.size() > 7) return false;
    const auto value = [](std::string_view v) -> double {
        const bool minus = !v.empty() && v[0] == 'M';
        if (minus) v.remove_prefix(1);
        if (!digits(v) || v.size() > 2) return kMissing;
        return minus ? -number(v) : number(v);
    };
    const auto left = t.substr(0, slash), right = t.substr(slash + 1);
    const bool good_left = left == "//" || !std::isnan(value(left));
    const bool good_right =
        right.empty() || right == "//" || right == "XX" || !std::isnan(value(right));
    if (!good_left || !good_right) return false;
    r.temp_c = value(left);
    r.dew_c = value(right);
    return true;
}

bool take_pressure(std::string_view t, MetarReport& r)
{
    if (t.size() != 5 || (t[0] != 'Q' && t[0] != 'A')) return false;
    if (t.substr(1) == "////") return true;
    if (!digits(t.substr(1))) return false;
    const double pa = t[0] == 'Q' ? number(t.substr(1)) * 100.0 : number(t.substr(1)) * 33.86389;
    if (std::isnan(r.qnh_pa)) r.qnh_pa = pa;
    return true;
}

// -RA, +SHSN, FZDZ, VCSH, RASN, TS, BR, ..
bool take_weather(std::string_view t, MetarReport& r)
{
    auto body = t;
    int strength = 1;
    if (!body.empty() && (body[0] == '-' || body[0] == '+')) {
        strength = body[0] == '-' ? 0 : 2;
        body.remove_prefix(1);
    }
    bool near = false;
    if (body.substr(0, 2) == "VC") {
        near = true;
        body.remove_prefix(2);
    }
    if (body.size() < 2 || body.size() > 8 || body.size() % 2 != 0) return false;
    constexpr const char* kCodes[] = {"MI", "PR", "BC", "DR", "BL", "SH", "TS", "FZ", "DZ", "RA",
                                      "SN", "SG", "IC", "PL", "GR", "GS", "UP", "BR", "FG", "FU",
                                      "VA", "DU", "SA", "HZ", "PY", "PO", "SQ", "FC", "SS", "DS"};
    int rains = 0, drizzles = 0, snows = 0;
    bool blowing = false;
    for (std::size_t i = 0; i < body.size(); i += 2) {
        const auto code = body.substr(i, 2);
        bool known = false;
        for (const char* k : kCodes) known = known || code == k;
        if (!known) return false;
        if (code == "BL" || code == "DR") blowing = true;
        if (code == "RA" || code == "UP") ++rains;
        if (code == "DZ") ++drizzles;
        if (code == "SN" || code == "SG" || code == "PL" || code == "GR" || code == "GS" ||
            code == "IC")
            ++snows;
    }
    if (near || blowing) return true;
    constexpr double kRain[] = {1.0, 4.5, 12.0}, kDrizzle[] = {0.1, 0.3, 0.8},
                     kSnow[] = {0.5, 1.5, 3.0};
    const int kinds = (rains > 0) + (drizzles > 0) + (snows > 0);
    if (kinds == 0) return true;
    // A mixture shares its strength.
    r.rain_mm_h +=
        ((rains > 0 ? kRain[strength] : 0.0) + (drizzles > 0 ? kDrizzle[strength] : 0.0)) / kinds;
    r.snow_mm_h += (snows > 0 ? kSnow[strength] : 0.0) / kinds;
    r.weather_seen = true;
    return true;
}

// R88/290050, R33/CLRD//, R24/P6000FT (visual range), 88290050 (old form)
bool take_runway(std::string_view t, MetarReport& r)
{
    std::string_view state;
    RunwayState runway;
    if (t.size() >= 4 && t[0] == 'R' && digits(t.substr(1, 2))) {
        const auto slash = t.find('/');
        if (slash == std::string_view::npos || slash > 4) return false;
        runway.runway = number(t.substr(1, 2));
        state = t.substr(slash + 1);
        if (state == "SNOCLO") return true;
    } else if (t.size() == 8 && digits(t.substr(0, 2)) && !digits(t)) {
        runway.runway = number(t.substr(0, 2));
        state = t.substr(2);
    } else if (t.size() == 8 && digits(t)) {
        runway.runway = number(t.substr(0, 2));
        state = t.substr(2);
    } else {
        return false;
    }
    if (state.substr(0, 4) == "CLRD") {
        runway.cleared = true;
        runway.deposit = 0;
        r.runways.push_back(runway);
        return true;
    }
    // Visual range: metres or feet, with P, M, V and a tendency.
    const bool six = state.size() == 6;
    bool plain = six;
    for (const char c : state.substr(0, 6)) plain = plain && ((c >= '0' && c <= '9') || c == '/');
    if (!plain) return !state.empty();
    if (state[0] != '/') runway.deposit = state[0] - '0';
    if (state[1] != '/') runway.extent = state[1] - '0';
    const auto depth = state.substr(2, 2), brake = state.substr(4, 2);
    if (digits(depth)) {
        const int d = number(depth);
        if (d <= 90)
            runway.depth_mm = d;
        else if (d >= 92 && d <= 98)
            runway.depth_mm = (d - 90) * 50.0;  // 92 is 10 cm .. 98 is 40 cm
    }
    if (digits(brake) && number(brake) <= 90) runway.friction = number(brake) / 100.0;
    r.runways.push_back(runway);
    return true;
}

void take_remark(std::string_view t, MetarReport& r)
{
    if (t.size() == 9 && t[0] == 'T' && digits(t.substr(1))) {
        const auto value = [](std::string_view v) {
            return (v[0] == '1' ? -0.1 : 0.1) * number(v.substr(1));
        };
        r.temp_c = value(t.substr(1, 4));
        r.dew_c = value(t.substr(5, 4));
    } else if (t.size() == 5 && t[0] == 'T' && digits(t.substr(1))) {
        r.temp_c = (t[1] == '1' ? -0.1 : 0.1) * number(t.substr(2));
    } else if (t.size() == 5 && t[0] == 'P' && digits(t.substr(1))) {
        r.hour_precip_mm = number(t.substr(1)) * 0.254;
    } else if (t.size() == 5 && t[0] == '6' && digits(t.substr(1))) {
        r.six_hour_precip_mm = number(t.substr(1)) * 0.254;
    } else if (t.size() == 5 && t.substr(0, 2) == "4/" && digits(t.substr(2))) {
        r.snow_depth_m = number(t.substr(2)) * 0.0254;
    }
}

std::string_view without_end(std::string_view t)
{
    while (!t.empty() && (t.back() == '=' || t.back() == '$')) t.remove_suffix(1);
    return t;
}

}  // namespace

const char* deposit_name(int deposit)
{
    constexpr const char* kNames[] = {"clear and dry",  "damp",       "wet",   "rime or frost",
                                      "dry snow",       "wet snow",   "slush", "ice",
                                      "compacted snow", "frozen ruts"};
    return deposit >= 0 && deposit <= 9 ? kNames[deposit] : "not reported";
}

std::optional<MetarReport> parse_metar(std::string_view text)
{
    const auto tokens = words(text, 200);
    if (tokens.empty()) return std::nullopt;
    MetarReport r;
    r.station = std::string(without_end(tokens[0]));
    if (r.station.size() != 4) return std::nullopt;
    std::size_t i = 1;
    if (i < tokens.size() && without_end(tokens[i]) == "NIL") {
        r.nil = true;
        return r;
    }
    if (i >= tokens.size()) return std::nullopt;
    const auto when = without_end(tokens[i]);
    if (when.size() != 7 || when[6] != 'Z' || !digits(when.substr(0, 6))) return std::nullopt;
    r.day = number(when.substr(0, 2));
    r.hour = number(when.substr(2, 2));
    r.minute = number(when.substr(4, 2));
    if (r.day < 1 || r.day > 31 || r.hour > 24 || r.minute > 59) return std::nullopt;
    ++i;
    enum { Body, Remarks, Trend } part = Body;
    double whole_miles = 0.0;
    for (; i < tokens.size(); ++i) {
        const auto t = without_end(tokens[i]);
        if (t.empty()) continue;
        if (t == "NIL") {
            r.nil = true;
            return r;
        }
        if (t == "RMK")
            part = Remarks;
        else if (part != Remarks && (t == "NOSIG" || t == "BECMG" || t == "TEMPO")) {
            part = Trend;
        } else if (part == Remarks) {
            take_remark(t, r);
        } else if (part == Trend) {
            take_runway(t, r);
        } else {
            if (t == "AUTO" || t == "COR" || t.substr(0, 2) == "RE" || t == "TSNO" || t == "NDV" ||
                t == "WS" || t == "ALL" || t == "RWY")
                continue;
            if (digits(t) && t.size() <= 2 && i + 1 < tokens.size() &&
                ends_with(without_end(tokens[i + 1]), "SM")) {
                whole_miles = number(t);
                continue;
            }
            if (t.size() == 7 && t[3] == 'V' && digits(t.substr(0, 3)) && digits(t.substr(4)))
                continue;  // 350V050
            if (take_wind(t, r) || take_temperature(t, r) || take_pressure(t, r) ||
                take_visibility(t, r, whole_miles) || take_cloud(t, r) || take_runway(t, r) ||
                take_weather(t, r)) {
                if (ends_with(t, "SM")) whole_miles = 0.0;
                continue;
            }
            if (t.find_first_not_of('/') == std::string_view::npos) continue;
            if (r.not_understood.size() < 8) r.not_understood.emplace_back(shown(t));
        }
    }
    return r;
}

std::optional<TafForecast> parse_taf(std::string_view text)
{
    auto tokens = words(text, 400);
    std::size_t i = 0;
    while (i < tokens.size() && (tokens[i] == "AMD" || tokens[i] == "COR" || tokens[i] == "TAF"))
        ++i;
    if (i >= tokens.size() || tokens[i].size() != 4) return std::nullopt;
    TafForecast taf;
    taf.station = std::string(tokens[i++]);
    if (i < tokens.size() && tokens[i].size() == 7 && tokens[i][6] == 'Z') ++i;
    const auto span = [](std::string_view t, std::int64_t& begin, std::int64_t& end) {
        if (t.size() != 9 || t[4] != '/' || !digits(t.substr(0, 4)) || !digits(t.substr(5)))
            return false;
        begin = number(t.substr(0, 2)) * 24 + number(t.substr(2, 2));
        end = number(t.substr(5, 2)) * 24 + number(t.substr(7, 2));
        if (end < begin)
            end += 31 * 24;  // over the end of the month: corrected by the reader of days
        return true;
    };
    if (i >= tokens.size() || !span(without_end(tokens[i]), taf.begin_hours, taf.end_hours))
        return std::nullopt;
    ++i;
    TafPeriod now;
    now.from_hours = taf.begin_hours;
    bool passing = false;
    TafPeriod dummy;
    const auto close = [&] { taf.periods.push_back(now); };
    for (; i < tokens.size(); ++i) {
        const auto t = without_end(tokens[i]);
        if (t.empty()) continue;
        if (t == "RMK") break;
        std::int64_t begin = 0, end = 0;
        if (t.size() == 8 && t.substr(0, 2) == "FM" && digits(t.substr(2))) {
            close();
            passing = false;
            now = {};
            now.from_hours = number(t.substr(2, 2)) * 24 + number(t.substr(4, 2));
        } else if (t == "BECMG") {
            close();
            passing = false;
            // What is not named stays; a new weather group replaces the old one.
            now.weather.rain_mm_h = now.weather.snow_mm_h = 0.0;
            now.weather.weather_seen = false;
            now.weather.cloud = kMissing;
            now.weather.visibility_m = kMissing;
            if (i + 1 < tokens.size() && span(without_end(tokens[i + 1]), begin, end)) {
                now.from_hours = end;
                ++i;
            }
        } else if (t == "TEMPO" || t.substr(0, 4) == "PROB") {
            passing = true;
            dummy = {};
            ++taf.passing;
        } else if (span(t, begin, end)) {
            continue;
        } else if ((t.substr(0, 2) == "TX" || t.substr(0, 2) == "TN") &&
                   t.find('/') != std::string_view::npos) {
            const auto slash = t.find('/');
            auto v = t.substr(2, slash - 2);
            const bool minus = !v.empty() && v[0] == 'M';
            if (minus) v.remove_prefix(1);
            const auto at = t.substr(slash + 1);
            if (digits(v) && v.size() <= 2 && at.size() >= 4 && digits(at.substr(0, 4))) {
                taf.temperatures_c.emplace_back(
                    number(at.substr(0, 2)) * 24 + number(at.substr(2, 2)),
                    minus ? -number(v) : number(v));
            }
        } else {
            MetarReport& r = passing ? dummy.weather : now.weather;
            if (!(take_wind(t, r) || take_pressure(t, r) || take_visibility(t, r, 0.0) ||
                  take_cloud(t, r) || take_weather(t, r)))
                continue;
        }
    }
    close();
    return taf;
}

}  // namespace petrichor::weather
