#include "weather/readers/metar_groups.h"

#include <cmath>

namespace petrichor::weather {

namespace {

bool letters(std::string_view t)
{
    for (const char c : t) {
        if (c < 'A' || c > 'Z') return false;
    }
    return !t.empty();
}

}  // namespace

bool all_digits(std::string_view t)
{
    for (const char c : t) {
        if (c < '0' || c > '9') return false;
    }
    return !t.empty();
}
int digits_value(std::string_view t)
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
    if (!(all_digits(from) || from == "VRB" || from == "///")) return false;
    body.remove_prefix(3);
    if (!body.empty() && body[0] == 'P') body.remove_prefix(1);
    const auto gust_at = body.find('G');
    const auto speed = body.substr(0, gust_at);
    if (all_digits(from) && digits_value(from) <= 360) r.wind_from_deg = digits_value(from);
    if (all_digits(speed) && speed.size() <= 3) r.wind_m_s = digits_value(speed) * factor;
    if (gust_at != std::string_view::npos && all_digits(body.substr(gust_at + 1)))
        r.gust_m_s = digits_value(body.substr(gust_at + 1)) * factor;
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
            if (!all_digits(top) || !all_digits(bottom) || digits_value(bottom) == 0) return false;
            miles = static_cast<double>(digits_value(top)) / digits_value(bottom);
        } else {
            if (!all_digits(body)) return false;
            miles = digits_value(body);
        }
        r.visibility_m = (whole_miles + miles) * 1609.344;
        return true;
    }
    if (t.size() >= 4 && all_digits(t.substr(0, 4)) && (t.size() == 4 || letters(t.substr(4)))) {
        const int metres = digits_value(t.substr(0, 4));
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
    const bool height = t.size() >= 6 && (all_digits(t.substr(3, 3)) || t.substr(3, 3) == "///");
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
        if (!all_digits(v) || v.size() > 2) return kMissing;
        return minus ? -digits_value(v) : digits_value(v);
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
    if (!all_digits(t.substr(1))) return false;
    const double pa =
        t[0] == 'Q' ? digits_value(t.substr(1)) * 100.0 : digits_value(t.substr(1)) * 33.86389;
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

std::optional<RoadCondition> condition_of(const RunwayState& runway)
{
    const bool part = runway.extent == 1 || runway.extent == 2;
    if (runway.cleared || part || runway.deposit < 0) return std::nullopt;
    constexpr RoadCondition kOf[10] = {
        RoadCondition::Dry,       RoadCondition::Wet,       RoadCondition::Wet,
        RoadCondition::Frost,     RoadCondition::IceOrSnow, RoadCondition::IceOrSnow,
        RoadCondition::WaterAndSnow, RoadCondition::IceOrSnow, RoadCondition::IceOrSnow,
        RoadCondition::IceOrSnow};
    return kOf[runway.deposit];
}

// R88/290050, R33/CLRD//, R24/P6000FT (visual range), 88290050 (old form)
bool take_runway(std::string_view t, MetarReport& r)
{
    std::string_view state;
    RunwayState runway;
    if (t.size() >= 4 && t[0] == 'R' && all_digits(t.substr(1, 2))) {
        const auto slash = t.find('/');
        if (slash == std::string_view::npos || slash > 4) return false;
        runway.runway = digits_value(t.substr(1, 2));
        state = t.substr(slash + 1);
        if (state == "SNOCLO") return true;
    } else if (t.size() == 8 && all_digits(t.substr(0, 2)) && !all_digits(t)) {
        runway.runway = digits_value(t.substr(0, 2));
        state = t.substr(2);
    } else if (t.size() == 8 && all_digits(t)) {
        runway.runway = digits_value(t.substr(0, 2));
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
    if (all_digits(depth)) {
        const int d = digits_value(depth);
        if (d <= 90)
            runway.depth_mm = d;
        else if (d >= 92 && d <= 98)
            runway.depth_mm = (d - 90) * 50.0;  // 92 is 10 cm .. 98 is 40 cm
    }
    if (all_digits(brake) && digits_value(brake) <= 90)
        runway.friction = digits_value(brake) / 100.0;
    r.runways.push_back(runway);
    return true;
}

void take_remark(std::string_view t, MetarReport& r)
{
    if (t.size() == 9 && t[0] == 'T' && all_digits(t.substr(1))) {
        const auto value = [](std::string_view v) {
            return (v[0] == '1' ? -0.1 : 0.1) * digits_value(v.substr(1));
        };
        r.temp_c = value(t.substr(1, 4));
        r.dew_c = value(t.substr(5, 4));
    } else if (t.size() == 5 && t[0] == 'T' && all_digits(t.substr(1))) {
        r.temp_c = (t[1] == '1' ? -0.1 : 0.1) * digits_value(t.substr(2));
    } else if (t.size() == 5 && t[0] == 'P' && all_digits(t.substr(1))) {
        r.hour_precip_mm = digits_value(t.substr(1)) * 0.254;
    } else if (t.size() == 5 && t[0] == '6' && all_digits(t.substr(1))) {
        r.six_hour_precip_mm = digits_value(t.substr(1)) * 0.254;
    } else if (t.size() == 5 && t.substr(0, 2) == "4/" && all_digits(t.substr(2))) {
        r.snow_depth_m = digits_value(t.substr(2)) * 0.0254;
    }
}

std::string_view without_end(std::string_view t)
{
    while (!t.empty() && (t.back() == '=' || t.back() == '$')) t.remove_suffix(1);
    return t;
}

const char* deposit_name(int deposit)
{
    constexpr const char* kNames[] = {"clear and dry",  "damp",       "wet",   "rime or frost",
                                      "dry snow",       "wet snow",   "slush", "ice",
                                      "compacted snow", "frozen ruts"};
    return deposit >= 0 && deposit <= 9 ? kNames[deposit] : "not reported";
}

bool is_day_time(std::string_view t)
{
    if (t.size() == 7 && t[6] == 'Z') t.remove_suffix(1);
    return t.size() == 6 && all_digits(t) && digits_value(t.substr(0, 2)) >= 1 &&
           digits_value(t.substr(0, 2)) <= 31 && digits_value(t.substr(2, 2)) <= 24 &&
           digits_value(t.substr(4, 2)) <= 59;
}

}  // namespace petrichor::weather
