#ifndef PETRICHOR_WEATHER_READERS_METAR_GROUPS_H
#define PETRICHOR_WEATHER_READERS_METAR_GROUPS_H

#include <string_view>

#include "weather/readers/metar.h"

// Groups that reports and forecasts share. Each take_* looks at one token, puts what it says into
// the report and returns whether the token was of its kind. Source: WMO-No. 306, FM 15 and FM 51;
// remarks: FMH-1, chapter 12.
namespace petrichor::weather {

/// 24015G25KT, VRB03MPS, /////KT, 00000KT
bool take_wind(std::string_view token, MetarReport& report);
/// 10SM, 1/2SM, M1/4SM, P6SM, 9999, 0800, 8000NW, 9999NDV, CAVOK. `whole_miles` is the 1 of "1
/// 1/2SM".
bool take_visibility(std::string_view token, MetarReport& report, double whole_miles);
/// FEW030, BKN010CB, OVC///, VV002, SKC, NSC, ...: the largest fraction stays
bool take_cloud(std::string_view token, MetarReport& report);
/// 12/07, M01/M13, M41/, //// in place of T and dew point
bool take_temperature(std::string_view token, MetarReport& report);
/// Q1013, A2992, Q////
bool take_pressure(std::string_view token, MetarReport& report);
/// -RA, +SHSN, FZDZ, VCSH, RASN, TS, BR, ...: rates are added up
bool take_weather(std::string_view token, MetarReport& report);
/// R88/290050, R33/CLRD//, R24/P6000FT (visual range), 88290050 (old form)
bool take_runway(std::string_view token, MetarReport& report);
/// Groups after RMK: Tsnnnsnnn, Pnnnn, 6nnnn, 4/sss
void take_remark(std::string_view token, MetarReport& report);

bool all_digits(std::string_view text);
/// Value of at most six digits; the text must be all_digits.
int digits_value(std::string_view text);
bool ends_with(std::string_view text, std::string_view end);
/// Without the = that ends a report and the $ of a station in need of care.
std::string_view without_end(std::string_view token);
/// Whether the text is ddhhmm or ddhhmmZ with a day, hour and minute that exist somewhere.
bool is_day_time(std::string_view text);

}  // namespace petrichor::weather

#endif
