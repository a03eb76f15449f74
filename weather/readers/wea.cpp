// WEA, the weather of Radiance and Daysim: place, latitude, longitude (west positive), time_zone
// (degrees, west positive), site_elevation, then month, day, hour (the middle of its interval) and
// two radiations: direct normal and diffuse horizontal (units 1), or direct and diffuse horizontal
// (units 2). It has sun only: give it together with a file that has the rest.
#include <algorithm>
#include <cmath>

#include "weather/physics/solar.h"
#include "weather/readers/formats.h"
#include "weather/readers/text.h"

namespace petrichor::weather {

namespace {

constexpr long long kYear = 2019;  // the format names none

void read(std::string_view text, RowCollector& rows, const ReadOptions& options)
{
    Lines lines(text);
    Site& site = rows.site();
    double zone_h = 0.0, units = 1.0;
    std::vector<std::string_view> w;
    rows.note(ReadNote::Kind::Time, 0, "time", "the format names no year: placed in 2019");
    rows.report().typical_year = true;
    while (const auto line = lines.next()) {
        words(*line, w, 16);
        if (w.empty()) continue;
        const double value = w.size() > 1 ? to_number(w[1]).value_or(kMissing) : kMissing;
        const bool number = !std::isnan(value);
        if (w[0] == "place") {
            site.name = shown(trimmed(trimmed(*line).substr(5)));
        } else if (w[0] == "latitude" && number) {
            site.latitude_deg = value;
        } else if (w[0] == "longitude" && number) {
            site.longitude_deg = -value;
        } else if (w[0] == "time_zone" && number) {
            zone_h = std::abs(value) <= 210.0 ? -value / 15.0 : 0.0;
            site.utc_offset_h = zone_h;
        } else if (w[0] == "site_elevation" && number) {
            site.elevation_m = value;
        } else if (w[0] == "weather_data_file_units" && number) {
            units = value;
        } else {
            double v[5];
            for (std::size_t i = 0; i < 5; ++i)
                v[i] = i < w.size() ? to_number(w[i]).value_or(kMissing) : kMissing;
            std::optional<std::int64_t> midnight;
            if (v[0] >= 1.0 && v[0] <= 12.0 && v[1] >= 1.0 && v[1] <= 31.0)
                midnight = us_from_civil(
                    {kYear, static_cast<int>(v[0]), static_cast<int>(v[1]), 0, 0, 0.0});
            if (!midnight || !(v[2] >= 0.0 && v[2] <= 24.0)) {
                rows.bad_row(lines.number(), "time",
                             "'" + shown(*line) + "' is not month, day, hour and two radiations");
                continue;
            }
            const double direct = v[3], diffuse = v[4];
            const std::int64_t us =
                *midnight + static_cast<std::int64_t>(std::llround((v[2] - zone_h) * 3600e6));
            if (!rows.begin_row(us, lines.number())) continue;
            if (std::isnan(direct) || std::isnan(diffuse)) {
                rows.unreadable(Field::Shortwave, *line);
                continue;
            }
            const double latitude = std::isnan(options.site.latitude_deg)
                                        ? site.latitude_deg
                                        : options.site.latitude_deg;
            const double longitude = std::isnan(options.site.longitude_deg)
                                         ? site.longitude_deg
                                         : options.site.longitude_deg;
            double flat = direct;
            if (units == 1.0) {
                rows.set(Field::Direct, direct);
                // Where no place on Earth is meant, the sun is not asked: the reading ends with that error.
                const bool placed = std::abs(latitude) <= 90.0 && std::abs(longitude) <= 360.0;
                flat = placed ? direct * std::max(0.0, sun_direction(us, latitude, longitude).up)
                              : kMissing;
            }
            rows.set(Field::Diffuse, diffuse);
            if (!std::isnan(flat)) rows.set(Field::Shortwave, flat + diffuse);
        }
    }
}

bool recognise(const FileHead& head)
{
    return head.begins("place ") && head.lines.size() >= 6 &&
           trimmed(head.lines[1]).rfind("latitude", 0) == 0;
}

}  // namespace

extern const Reader wea_reader;
const Reader wea_reader{"WEA", "sun of Radiance and Daysim", recognise, read};

}  // namespace petrichor::weather
