// Columns of a file that are of no use: unknown names, values of another quantity, nothing but zeros.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/error.h"
#include "weather/physics/constants.h"
#include "weather/physics/humidity.h"
#include "weather/readers/collector.h"
#include "weather/readers/number_text.h"
#include "weather/readers/text.h"

namespace petrichor::weather {

namespace {

// Words that names of weather columns are made of.
bool speaks_of_weather(std::string_view name)
{
    const std::string low = lower(name);
    for (const char* word :
         {"temp",   "snow",  "rain",  "precip", "wind",  "gust",      "radiat",   "irradi", "press",
          "humid",  "cloud", "dew",   "solar",  "depth", "shortwave", "longwave", "swe",    "prcp",
          "albedo", "vapo",  "sleet", "hail",   "ice",   "frost",     "visib",    "flux",
          "niederschl", "regen", "schnee", "feucht", "luftdr", "strahl", "taupunkt"}) {
        if (low.find(word) != std::string::npos) return true;
    }
    // Short words, and units that little else has: sw, T2, rh_2m; sw_w_m2, p_hPa.
    std::string token, letters;
    const auto speaks = [](const std::string& t) {
        for (const char* word :
             {"sw", "lw",   "swd", "lwd", "swin", "lwin", "swdown", "lwdown", "rg",   "rh", "tp", "u10", "v10",
              "d2m", "ssrd", "strd", "tcc", "wspd", "dwpt", "rhum", "pres",
              "ta", "tair", "t2m", "ghi", "dni",  "dhi",  "par",    "hpa",    "mbar", "degc"})
            if (t == word) return true;
        return false;
    };
    for (const char c : low + " ") {
        const bool word = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
        if (word) {
            token += c;
            letters += c;
            continue;
        }
        if (speaks(token)) return true;
        token.clear();
    }
    return letters.size() > 3 && (letters.ends_with("wm2") || letters.ends_with("mmh"));
}

}  // namespace

void RowCollector::unknown_column(std::string_view name, const std::vector<std::string>& ignored)
{
    const std::string low = lower(trimmed(name));
    const bool left_out = std::any_of(ignored.begin(), ignored.end(), [&](const std::string& word) {
        return word == "all" || lower(word) == low;
    });
    std::string text = low.empty() ? "a column without a name" : shown(trimmed(name));
    (speaks_of_weather(name) && !left_out ? strange_columns_ : other_columns_)
        .push_back(std::move(text));
}

void RowCollector::unread_columns(const std::vector<std::string>& names)
{
    constexpr std::size_t kMostNamed = 30;
    std::string text;
    std::size_t named = 0;
    for (const std::string& name : names) {
        const bool tells = names.size() <= kMostNamed || speaks_of_weather(name);
        if (!tells || named == kMostNamed || trimmed(name).empty()) continue;
        text.append(named++ ? ", " : "").append(shown(trimmed(name)));
    }
    if (named == 0) return;
    if (named < names.size()) text += " and " + std::to_string(names.size() - named) + " more";
    note(ReadNote::Kind::Info, 1, "columns", "not read: " + text);
}

void RowCollector::check_columns()
{
    const auto list = [](const std::vector<std::string>& names) {
        std::string out;
        for (const std::string& name : names) out.append(out.empty() ? "" : ", ").append(name);
        return out;
    };
    if (!strange_columns_.empty()) {
        throw Error("weather: " + report_.format + ": not understood: " + list(strange_columns_),
                    "Name the column as in air_temp_c, rel_humidity_pct, wind_m_s, precip_mm, "
                    "snow_depth_m, sw_down_w_m2, or leave it out: --ignore " +
                        (strange_columns_.size() == 1 &&
                                 strange_columns_.front().find(' ') == std::string::npos
                             ? strange_columns_.front()
                             : "all") +
                        ".");
    }
    if (!other_columns_.empty())
        note(ReadNote::Kind::Info, line_, "columns",
             "not known, not used: " + list(other_columns_));
}

// Values of which most cannot be are of another quantity or unit than their name says.
void RowCollector::refuse_misnamed() const
{
    constexpr std::size_t kFew = 10;
    for (std::size_t f = 0; f < kFieldCount; ++f) {
        const FieldInfo& info = field_info(static_cast<Field>(f));
        if (info.observed || report_of_[f] == 0) continue;
        const FieldReport& r = report_.fields[report_of_[f] - 1];
        const std::size_t words = unreadable_[f].count;
        if (words >= kFew && words > r.present) {
            throw Error("weather: " + report_.format + ": " + info.name + ": '" +
                            unreadable_text_[f] + "' in line " +
                            std::to_string(unreadable_[f].first_line) + " and " +
                            std::to_string(words - 1) + " more of " +
                            std::to_string(words + r.present) + " cells are not numbers",
                        "Write numbers as 1013.25, without marks between thousands.");
        }
        const std::size_t odd = refused_[f].count;
        if (odd < kFew || odd <= r.present) continue;
        throw Error("weather: " + report_.format + ": " + info.name + ": " + std::to_string(odd) +
                        " of " + std::to_string(odd + r.present) + " values are outside " +
                        number_text(info.low) + ".." + number_text(info.high) + " " + info.unit +
                        ", from line " + std::to_string(refused_[f].first_line) + " on (" +
                        number_text(refused_[f].low) + " to " + number_text(refused_[f].high) + ")",
                    "Correct the name or the unit of the column, or leave it out with --ignore "
                    "where the format is a free table.");
    }
    const auto& humidity = values_[static_cast<std::size_t>(Field::RelHumidity)];
    std::size_t known = 0;
    double most = 0.0;
    for (const double percent : humidity) {
        if (std::isnan(percent)) continue;
        ++known;
        most = std::max(most, percent);
    }
    if (known >= kFew && most > 0.0 && most <= 1.0) {
        throw Error("weather: " + report_.format + ": rel_humidity: no value of " +
                        std::to_string(known) + " is above " + number_text(most) +
                        " %: they are shares of 1",
                    "Name the column rel_humidity_fraction, or give percent.");
    }
}

// Air holds no more vapour than saturated: a dew point above its temperature is another column.
void RowCollector::refuse_warm_dew() const
{
    constexpr std::size_t kFew = 10;
    constexpr double kErrors_k = 1.0;
    const auto& air = values_[static_cast<std::size_t>(Field::AirTemp)];
    const auto& dew = values_[static_cast<std::size_t>(Field::DewPoint)];
    std::size_t known = 0, above = 0;
    for (std::size_t i = 0; i < std::min(air.size(), dew.size()); ++i) {
        if (std::isnan(air[i]) || std::isnan(dew[i])) continue;
        ++known;
        above += dew[i] > air[i] + kErrors_k;
    }
    if (above < kFew || above * 2 <= known) return;
    throw Error("weather: " + report_.format + ": the dew point is above the air temperature in " +
                    std::to_string(above) + " of " + std::to_string(known) + " rows",
                "Correct the names or the units of the two columns, or leave one out with --ignore "
                "where the format is a free table.");
}

// No air on earth was ever as damp as a dew point of 36 C (35 C: Dhahran 2003): such temperatures are in another
// scale, or the humidity is another column.
void RowCollector::refuse_impossible_damp() const
{
    constexpr std::size_t kFew = 10;
    constexpr double kDampest_pa = 5950.0;  // vapour at 36 C
    const auto& air = values_[static_cast<std::size_t>(Field::AirTemp)];
    const auto& damp = values_[static_cast<std::size_t>(Field::RelHumidity)];
    std::size_t known = 0, beyond = 0;
    for (std::size_t i = 0; i < std::min(air.size(), damp.size()); ++i) {
        if (std::isnan(air[i]) || std::isnan(damp[i])) continue;
        ++known;
        beyond += air[i] > 309.0 && vapour_pressure_pa(air[i], damp[i]) > kDampest_pa;
    }
    if (beyond < kFew || beyond * 20 <= known) return;
    throw Error("weather: " + report_.format + ": in " + std::to_string(beyond) + " of " +
                    std::to_string(known) +
                    " rows the air would be damper than any on earth (a dew point above 36 C)",
                "Say the unit of the temperature in its name (air_temp_f), or correct that of the humidity.");
}

// A column of nothing but zeros was not measured: a year without rain, days without sun or wind.
namespace {

bool is_temperature(Field field)
{
    return field == Field::AirTemp || field == Field::DewPoint;
}
// A temperature that was 0 in the file, of either scale.
bool is_zero_degrees(double temp_k)
{
    return std::abs(temp_k - kZeroCelsiusK) < 1e-6 || std::abs(temp_k - 255.3722222) < 1e-4;
}

constexpr double kFarFromZero_k = 8.0, kNeighboursApart_k = 8.0;
constexpr std::int64_t kNeighbours_us = 3 * 3600LL * 1000000;

}  // namespace

// Exactly 0 for a row between two on the same side that are 8 K and more from it, and nearer to each other (all
// three chosen): a sensor that said nothing. Air does not fall and rise again by that in a row.
void RowCollector::drop_lone_zeros()
{
    for (const Field field : {Field::AirTemp, Field::DewPoint}) {
        auto& v = values_[static_cast<std::size_t>(field)];
        std::size_t lone = 0, first = 0;
        for (std::size_t i = 1; i + 1 < v.size(); ++i) {
            if (!is_zero_degrees(v[i]) || times_[i + 1] - times_[i - 1] > 2 * kNeighbours_us) continue;
            const double before = v[i - 1] - v[i], after = v[i + 1] - v[i];
            const bool far = (before >= kFarFromZero_k && after >= kFarFromZero_k) ||
                             (before <= -kFarFromZero_k && after <= -kFarFromZero_k);
            if (!far || std::abs(before - after) > kNeighboursApart_k) continue;
            if (lone++ == 0) first = i;
            v[i] = kMissing;
        }
        if (lone == 0) continue;
        FieldReport& f = report_.fields[report_index(field)];
        f.present -= lone;
        f.out_of_range += lone;
        note(ReadNote::Kind::OutOfRange, 0, field_info(field).name,
             std::to_string(lone) + (lone == 1 ? " value" : " values") +
                 " of exactly 0 (the first at " + iso_from_us(times_[first]) +
                 ") between values 8 K and more away: a sensor that said nothing, taken as missing");
    }
}

void RowCollector::drop_empty_columns()
{
    const double days =
        times_.size() < 2 ? 0.0 : static_cast<double>(times_.back() - times_.front()) / 86400e6;
    const auto all_zero = [&](Field field) {
        const auto& v = values_[static_cast<std::size_t>(field)];
        bool any = false;
        for (const double x : v) {
            if (std::isnan(x)) continue;
            if (x != 0.0 && !(is_temperature(field) && is_zero_degrees(x))) return false;
            any = true;
        }
        for (const Fallen& f : fallen_) {
            if (f.field != field) continue;
            if (f.amount != 0.0) return false;
            any = true;
        }
        return any;
    };
    const auto not_measured = [&](Field field, const char* with) {
        values_[static_cast<std::size_t>(field)].clear();
        std::erase_if(fallen_, [&](const Fallen& f) { return f.field == field; });
        FieldReport& f = report_.fields[report_index(field)];
        note(ReadNote::Kind::Warning, 0, f.name,
             std::string("nothing but 0 in ")
                 .append(std::to_string(f.present))
                 .append(" rows")
                 .append(with)
                 .append(": taken as not measured"));
        f.present = 0;
    };
    struct Rule {
        Field field;
        double days;  // so long it may be 0
    };
    constexpr Rule kRules[] = {{Field::AirTemp, 2.0},      {Field::DewPoint, 2.0},
                               {Field::Precip, 60.0},     {Field::Shortwave, 3.0},
                               {Field::Longwave, 1.0},    {Field::Wind, 3.0},
                               {Field::RelHumidity, 1.0}, {Field::Direct, 20.0},
                               {Field::Diffuse, 3.0},     {Field::WindFrom, 3.0},
                               {Field::Cloud, 60.0},      {Field::Visibility, 3.0}};
    for (const Rule& rule : kRules) {
        if (days < rule.days || !all_zero(rule.field)) continue;
        if (is_temperature(rule.field)) {
            // Made-up weather may stand at the freezing point: it is kept, and told.
            const FieldReport& f = report_.fields[report_index(rule.field)];
            note(ReadNote::Kind::Warning, 0, f.name,
                 std::string("nothing but 0 degrees in ")
                     .append(std::to_string(f.present))
                     .append(" rows: no thermometer measures that"));
            continue;
        }
        not_measured(rule.field, "");
    }
    // No snow in a summer is a measurement; none on any of sixty days and more, ten of them of frost, is a
    // column that nobody filled in.
    constexpr double kDays = 60.0, kFrostDays = 10.0, kFrost_k = kZeroCelsiusK - 1.0;
    const auto& air = values_[static_cast<std::size_t>(Field::AirTemp)];
    const auto cold = std::count_if(air.begin(), air.end(), [](double k) { return k < kFrost_k; });
    const double frost_days = air.empty() ? 0.0 : days * static_cast<double>(cold) / static_cast<double>(air.size());
    if (days < kDays || frost_days < kFrostDays || !all_zero(Field::SnowDepth)) return;
    char with[60];
    std::snprintf(with, sizeof with, " with %.0f days of frost", frost_days);
    not_measured(Field::SnowDepth, with);
}

}  // namespace petrichor::weather
