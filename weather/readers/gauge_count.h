#ifndef PETRICHOR_WEATHER_READERS_GAUGE_COUNT_H
#define PETRICHOR_WEATHER_READERS_GAUGE_COUNT_H

#include <bit>
#include <cstddef>
#include <cstdint>

namespace petrichor::weather {

/// A gauge's count since some beginning never falls and mostly rises; amounts of hours fall again. One
/// of each day (month, year) falls where a day begins, whichever clock it keeps, and nowhere else.
class GaugeCount {
public:
    void add(double value, std::int64_t time_us)
    {
        constexpr std::int64_t kHour_us = 3600LL * 1000000, kDay_us = 24 * kHour_us;
        const std::int64_t day = time_us / kDay_us, hour = time_us % kDay_us / kHour_us;
        if (seen_ > 0 && value < last_) {
            ++falls_;
            at_midnight_ = at_midnight_ && day != day_;
            fall_hours_ |= 1u << hour;
        }
        if (seen_ > 0 && value > last_) {
            ++rises_;
            rise_hours_ |= 1u << hour;
        }
        still_ += seen_ > 0 && value > 0.0 && value == last_;
        last_ = value;
        day_ = day;
        ++seen_;
    }
    bool counts_up() const { return counts() && falls_ == 0; }
    bool counts_up_by_day() const
    {
        const bool one_hour = std::popcount(fall_hours_) == 1 && falls_ >= 2;
        const bool many = std::popcount(rise_hours_) >= (rises_ >= 10 ? 4 : 3);
        return counts() && many && falls_ > 0 && (at_midnight_ || one_hour);
    }

private:
    // Amounts of hours do not stand at one value for half a day, but a count does while it is dry.
    bool counts() const
    {
        return seen_ >= 24 && (rises_ >= 10 || (rises_ >= 3 && still_ >= 12));
    }

    std::size_t seen_ = 0, falls_ = 0, rises_ = 0, still_ = 0;
    std::uint32_t fall_hours_ = 0, rise_hours_ = 0;  // of the day, a bit each
    std::int64_t day_ = 0;
    bool at_midnight_ = true;
    double last_ = 0.0;
};

}  // namespace petrichor::weather

#endif
