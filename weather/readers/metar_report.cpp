// One METAR or SPECI report, token by token.
#include "weather/readers/metar.h"
#include "weather/readers/metar_groups.h"
#include "weather/readers/text.h"

namespace petrichor::weather {

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
    if (when.size() != 7 || !is_day_time(when)) return std::nullopt;
    r.day = digits_value(when.substr(0, 2));
    r.hour = digits_value(when.substr(2, 2));
    r.minute = digits_value(when.substr(4, 2));
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
            if (all_digits(t) && t.size() <= 2 && i + 1 < tokens.size() &&
                ends_with(without_end(tokens[i + 1]), "SM")) {
                whole_miles = digits_value(t);
                continue;
            }
            if (t.size() == 7 && t[3] == 'V' && all_digits(t.substr(0, 3)) &&
                all_digits(t.substr(4)))
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

}  // namespace petrichor::weather
