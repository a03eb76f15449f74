// NOAA Climate Reference Network, hourly (38 columns) and every 5 minutes (23): numbers between
// blanks, no header, UTC beside local standard time, values of the interval that ends at the time.
// C, mm, W/m2, %; wind at 1.5 m (5 minutes only). -99 and -9999 are missing.
#include <algorithm>
#include <cmath>

#include "weather/physics/constants.h"
#include "weather/readers/formats.h"
#include "weather/readers/tables.h"

namespace petrichor::weather {

namespace {

struct Layout {
    std::size_t columns;
    std::size_t air, precip, sun, sun_flag, surface, surface_flag, humidity, humidity_flag, wind;
    double hours;
};
constexpr std::size_t kNo = 999;
constexpr Layout kHourly{38, 8, 12, 13, 14, 20, 21, 26, 27, kNo, 1.0};
constexpr Layout kFiveMinutes{23, 8, 9, 10, 11, 12, 14, 15, 16, 21, 1.0 / 12.0};

const Layout* layout_of(std::size_t columns)
{
    for (const Layout* l : {&kHourly, &kFiveMinutes}) {
        if (l->columns == columns) return l;
    }
    return nullptr;
}

std::optional<std::int64_t> time_of(std::string_view date, std::string_view clock)
{
    if (date.size() != 8 || clock.size() != 4) return std::nullopt;
    return us_from_iso(std::string(date) + "T" + std::string(clock));
}

void read(std::string_view text, RowCollector& rows, const ReadOptions&)
{
    Lines lines(text);
    Site& site = rows.site();
    site.temp_height_m = 1.5;
    site.wind_height_m = 1.5;
    rows.means_of_past(Field::Shortwave);
    std::vector<std::string_view> w;
    while (const auto line = lines.next()) {
        words(*line, w, 64);
        if (w.empty()) continue;
        const Layout* l = layout_of(w.size());
        const auto us = l ? time_of(w[1], w[2]) : std::nullopt;
        if (!us) {
            rows.bad_row(lines.number(), l ? "time" : "",
                         l ? "'" + shown(*line) + "' has no date and time"
                           : "has " + std::to_string(w.size()) + " columns, 38 or 23 are needed");
            continue;
        }
        if (rows.rows() == 0) {
            site.name = "WBAN " + shown(w[0]);
            site.longitude_deg = to_number(w[6]).value_or(kMissing);
            site.latitude_deg = to_number(w[7]).value_or(kMissing);
            if (const auto local = time_of(w[3], w[4]))
                site.utc_offset_h = static_cast<double>(*local - *us) / 3600e6;
        }
        if (!rows.begin_row(*us, lines.number())) continue;
        const auto value = [&](std::size_t at, std::size_t flag) -> std::optional<double> {
            const auto number = to_number(w[at]);
            const bool failed = flag != kNo && w[flag] != "0";
            if (failed || (number && *number <= -99.0)) return std::nullopt;
            return number.value_or(kMissing);
        };
        const auto put = [&](Field field, std::size_t at, std::size_t flag, double offset) {
            if (at == kNo) return;
            const auto v = value(at, flag);
            if (!v)
                rows.missing(field);
            else if (std::isnan(*v))
                rows.unreadable(field, w[at]);
            else
                rows.set(field, *v + offset);
        };
        put(Field::AirTemp, l->air, kNo, kZeroCelsiusK);
        put(Field::Shortwave, l->sun, l->sun_flag, 0.0);
        put(Field::SurfaceTemp, l->surface, l->surface_flag, kZeroCelsiusK);
        put(Field::RelHumidity, l->humidity, l->humidity_flag, 0.0);
        put(Field::Wind, l->wind, kNo, 0.0);
        const auto fell = value(l->precip, kNo);
        if (!fell)
            rows.missing(Field::Precip);
        else if (std::isnan(*fell))
            rows.unreadable(Field::Precip, w[l->precip]);
        else
            rows.fell_before(Field::Precip, *fell, l->hours);
    }
}

bool recognise(const FileHead& head)
{
    const auto w = words(head.lines.front(), 64);
    return layout_of(w.size()) && w[0].size() == 5 && time_of(w[1], w[2]) && time_of(w[3], w[4]) &&
           to_number(w[6]) && to_number(w[7]);
}

}  // namespace

extern const Reader uscrn_reader;
const Reader uscrn_reader{"USCRN", "NOAA Climate Reference Network, hourly or 5 minutes", recognise,
                          read};

}  // namespace petrichor::weather
