#include "weather/readers/days.h"

#include <cmath>

#include "weather/physics/constants.h"

namespace petrichor::weather {

void put_days(const DaysOfWeather& days, double zone_h, RowCollector& rows)
{
    rows.note(ReadNote::Kind::Info, 0, "",
              "daily values: temperature swings from its minimum at 6 to its maximum at 15 "
              "o'clock, precipitation is spread over the day");
    for (const auto& [us, day] : days) {
        const auto next = days.find(us + 86400000000LL);
        double low = day.low_c, high = day.high_c;
        if (std::isnan(low) && !std::isnan(day.mean_c)) low = day.mean_c;
        if (std::isnan(high) && !std::isnan(day.mean_c)) high = day.mean_c;
        if (std::isnan(low)) low = high;
        if (std::isnan(high)) high = low;
        const double low_after =
            next == days.end() || std::isnan(next->second.low_c) ? low : next->second.low_c;
        for (int i = 0; i < 8; ++i) {
            const double hour = 3.0 * i;
            if (!rows.begin_row(us + static_cast<std::int64_t>((hour - zone_h) * 3600e6), day.line))
                continue;
            if (std::isnan(low))
                rows.missing(Field::AirTemp);
            else {
                // Half a cosine up from 6 to 15, half a cosine down from 15 to 6 of the next day.
                double t = 0.0;
                if (hour < 6.0)
                    t = low + 0.5 * (high - low) * (1.0 + std::cos(kPi * (hour + 9.0) / 15.0));
                else if (hour <= 15.0)
                    t = low + 0.5 * (high - low) * (1.0 - std::cos(kPi * (hour - 6.0) / 9.0));
                else
                    t = low_after +
                        0.5 * (high - low_after) * (1.0 + std::cos(kPi * (hour - 15.0) / 15.0));
                rows.set(Field::AirTemp, t + kZeroCelsiusK);
                // Air that cools below the dew point of the day's mean loses what it cannot hold.
                if (!std::isnan(day.dew_c))
                    rows.set(Field::DewPoint, std::fmin(day.dew_c, t) + kZeroCelsiusK);
            }
            if (std::isnan(day.precip_mm))
                rows.missing(Field::Precip);
            else
                rows.set(Field::Precip, day.precip_mm / 86400.0);
            if (!std::isnan(day.snow_share)) rows.set(Field::SnowShare, day.snow_share);
            if (!std::isnan(day.wind_m_s)) rows.set(Field::Wind, day.wind_m_s);
            if (!std::isnan(day.depth_m)) rows.set(Field::SnowDepth, day.depth_m);
            if (!std::isnan(day.pressure_pa)) rows.set(Field::Pressure, day.pressure_pa);
            if (!std::isnan(day.visibility_m)) rows.set(Field::Visibility, day.visibility_m);
        }
    }
}

}  // namespace petrichor::weather
