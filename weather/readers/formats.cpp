#include "weather/readers/formats.h"

#include <algorithm>

#include "weather/readers/text.h"

namespace petrichor::weather {

// The one list. Its order matters: see weather_readers().
#define PETRICHOR_WEATHER_READERS(add)                                                          \
    add(metro) add(pvgis_json) add(visual_crossing_json) add(openweather_json)                  \
        add(nasa_power_json) add(wunderground_json) add(open_meteo_json) add(smet) add(nsrdb)   \
            add(epw) add(pvgis)                                                                 \
            add(midc) add(tmy3) add(tmy2) add(wea) add(open_meteo_csv) add(visual_crossing)     \
                add(openweather) add(nasa_power) add(fluxnet) add(meteo_france)                 \
                    add(meteo_france_synop) add(meteoswiss) add(weatherlink)                    \
                        add(ecowitt) add(wunderground) add(geosphere) add(seklima)              \
                        add(gsod) add(global_hourly) add(lcd) add(ghcnh)  \
                            add(dwd) add(environment_canada) add(meteostat) add(iem) add(isd)   \
                                add(metar) add(ghcn_daily) add(surfrad) add(umep) add(uscrn)    \
                                    add(isd_lite) add(fsm) add(forcing_csv)

#define PETRICHOR_DECLARE(name) extern const Reader name##_reader;
PETRICHOR_WEATHER_READERS(PETRICHOR_DECLARE)
#undef PETRICHOR_DECLARE

std::span<const Reader* const> weather_readers()
{
#define PETRICHOR_POINT(name) &name##_reader,
    static constexpr const Reader* kAll[] = {PETRICHOR_WEATHER_READERS(PETRICHOR_POINT)};
#undef PETRICHOR_POINT
    return kAll;
}

FileHead::FileHead(std::string_view whole) : text(whole.substr(0, 1 << 16))
{
    Lines all(text);
    while (lines.size() < 40) {
        const auto line = all.next();
        if (!line) break;
        if (!trimmed(*line).empty()) lines.push_back(*line);
    }
    if (lines.empty()) lines.push_back(text.substr(0, 0));
    first = lower(trimmed(lines.front()));
    first.erase(std::remove(first.begin(), first.end(), '"'), first.end());
}

bool FileHead::begins(std::string_view prefix) const
{
    return trimmed(lines.front()).substr(0, prefix.size()) == prefix;
}

bool FileHead::has_columns(std::initializer_list<std::string_view> names) const
{
    return std::all_of(names.begin(), names.end(), [&](std::string_view name) {
        constexpr std::string_view kEnds = ",;|\t";
        for (std::size_t at = first.find(name); at != first.npos; at = first.find(name, at + 1)) {
            const std::size_t end = at + name.size();
            const bool left = at == 0 || kEnds.find(first[at - 1]) != kEnds.npos;
            const bool right = end == first.size() || kEnds.find(first[end]) != kEnds.npos;
            if (left && right) return true;
        }
        return false;
    });
}

bool all_numbers(const std::vector<std::string_view>& fields)
{
    return std::all_of(fields.begin(), fields.end(),
                       [](std::string_view f) { return to_number(f).has_value(); });
}

void TypicalYear::watch(long long row_year, int row_month)
{
    if (first_ == 0)
        first_ = row_year;
    else if (row_year != last_ && !(row_year == last_ + 1 && row_month == 1 && last_month_ == 12))
        typical = true;
    last_ = row_year;
    last_month_ = row_month;
}

void TypicalYear::decide(RowCollector& rows)
{
    year = is_leap_year(first_) ? first_ + 1 : first_;
    if (typical) {
        rows.report().typical_year = true;
        rows.note(ReadNote::Kind::Time, 0, "time",
                  std::string("typical year: months of different years, placed in ")
                      .append(std::to_string(year)));
    }
}

}  // namespace petrichor::weather
