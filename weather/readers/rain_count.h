#ifndef PETRICHOR_WEATHER_READERS_RAIN_COUNT_H
#define PETRICHOR_WEATHER_READERS_RAIN_COUNT_H

#include <cstdint>

#include "weather/readers/collector.h"

namespace petrichor::weather {

/// What fell from row to row of a station that writes how much has fallen since a day, month or year
/// began: a count that is lower than before has begun again, from nothing.
class RainCount {
public:
    /// Puts into the current row what fell since the one before; of the first row nothing is known.
    ///   kg_m2  the count; NaN: the row has none
    void put(double kg_m2, std::int64_t time_us, RowCollector& rows)
    {
        if (!(kg_m2 >= 0.0)) {
            rows.missing(Field::Precip);
            return;
        }
        if (known_ && time_us > time_us_)
            rows.fell_before(Field::Precip, kg_m2 < count_ ? kg_m2 : kg_m2 - count_,
                             static_cast<double>(time_us - time_us_) / 3600e6);
        else
            rows.missing(Field::Precip);
        known_ = true;
        count_ = kg_m2;
        time_us_ = time_us;
    }

private:
    bool known_ = false;
    double count_ = 0.0;
    std::int64_t time_us_ = 0;
};

}  // namespace petrichor::weather

#endif
