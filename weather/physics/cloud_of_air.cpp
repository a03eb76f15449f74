#include "weather/physics/cloud_of_air.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>
#include <limits>

namespace petrichor::weather {
namespace {

constexpr double kDry_pct = 45.0, kSaturated_pct = 97.0;
constexpr double kOfDryAir = 0.70, kOfSaturatedAir = 0.22;
constexpr double kMiddleRange_k = 8.0, kLess_1_k = 0.025, kMore_1_pct = 0.0046;
constexpr std::int64_t kHour_us = 3600LL * 1000000;
constexpr std::int64_t kDaySide_us = 12 * kHour_us, kHoursSide_us = 5 * kHour_us / 2;
constexpr std::int64_t kLongestStep_us = 3 * kHour_us;  // from which a day's range can be told

// Means over the rows within a time of each: sums up to each row, so that no window depends on the
// one before it.
class Means {
public:
    Means(const AirRows& rows, std::int64_t side_us)
        : rows_(rows), side_us_(side_us), sum_(rows.time_us.size() + 1, 0.0),
          known_(rows.time_us.size() + 1, 0)
    {
        for (std::size_t i = 0; i < rows.time_us.size(); ++i) {
            const double rh = rows.rel_humidity_pct[i];
            sum_[i + 1] = sum_[i] + (std::isnan(rh) ? 0.0 : rh);
            known_[i + 1] = known_[i] + (std::isnan(rh) ? 0 : 1);
        }
    }
    // Of the rows around row i; to be asked for in order. NaN: none is known.
    double around(std::size_t i)
    {
        const auto& time_us = rows_.time_us;
        while (time_us[i] - time_us[first_] > side_us_) ++first_;
        while (end_ < time_us.size() && time_us[end_] - time_us[i] <= side_us_) ++end_;
        const std::size_t count = known_[end_] - known_[first_];
        return count == 0 ? std::numeric_limits<double>::quiet_NaN()
                          : (sum_[end_] - sum_[first_]) / static_cast<double>(count);
    }

private:
    const AirRows& rows_;
    std::int64_t side_us_;
    std::vector<double> sum_;
    std::vector<std::size_t> known_;
    std::size_t first_ = 0, end_ = 0;
};

// Highest less lowest temperature within half a day of each row: of either, the rows that are not
// outdone by a later one wait in a queue, the best in front.
class Ranges {
public:
    explicit Ranges(const AirRows& rows) : rows_(rows) {}
    // As it counts: between it and an ordinary one, by how much of a day it is known of.
    double around(std::size_t i, double ordinary_k)
    {
        const auto& time_us = rows_.time_us;
        const auto& air_k = rows_.air_temp_k;
        for (; end_ < time_us.size() && time_us[end_] - time_us[i] <= kDaySide_us; ++end_) {
            if (std::isnan(air_k[end_])) continue;
            while (!highest_.empty() && air_k[highest_.back()] <= air_k[end_]) highest_.pop_back();
            while (!lowest_.empty() && air_k[lowest_.back()] >= air_k[end_]) lowest_.pop_back();
            highest_.push_back(end_);
            lowest_.push_back(end_);
            if (last_ < end_ && time_us[end_] - time_us[last_] <= kLongestStep_us)
                covered_us_ += time_us[end_] - time_us[last_];
            last_ = end_;
            known_.push_back({time_us[end_], covered_us_});
        }
        for (auto* queue : {&highest_, &lowest_})
            while (!queue->empty() && time_us[i] - time_us[queue->front()] > kDaySide_us)
                queue->pop_front();
        while (!known_.empty() && time_us[i] - known_.front().time_us > kDaySide_us)
            known_.pop_front();
        if (known_.empty()) return ordinary_k;
        const auto covered_us =
            static_cast<double>(known_.back().covered_us - known_.front().covered_us);
        const double counts =
            std::clamp(covered_us / static_cast<double>(kDaySide_us) - 1.0, 0.0, 1.0);
        return ordinary_k +
               counts * (air_k[highest_.front()] - air_k[lowest_.front()] - ordinary_k);
    }

private:
    const AirRows& rows_;
    struct Known {
        std::int64_t time_us, covered_us;  // time in steps short enough, up to it
    };
    std::deque<std::size_t> highest_, lowest_;
    std::deque<Known> known_;
    std::size_t last_ = std::numeric_limits<std::size_t>::max(), end_ = 0;
    std::int64_t covered_us_ = 0;
};

}  // namespace

double ordinary_range_k(double mean_rel_humidity_pct)
{
    return 12.0 - 0.18 * (std::clamp(mean_rel_humidity_pct, 60.0, 100.0) - 60.0);
}

double cloud_of_day(const DayOfAir& day)
{
    const double range_k = std::isnan(day.range_k) ? ordinary_range_k(day.mean_rel_humidity_pct)
                                                   : day.range_k;
    const double x = std::clamp(
        (day.mean_rel_humidity_pct - kDry_pct) / (kSaturated_pct - kDry_pct), 0.0, 1.0);
    return std::clamp(kOfDryAir + kOfSaturatedAir * x * x -
                          kLess_1_k * (range_k - kMiddleRange_k) +
                          kMore_1_pct * day.damper_pct,
                      0.0, 1.0);
}

std::vector<double> cloud_of_air(const AirRows& rows)
{
    std::vector<double> clouds;
    clouds.reserve(rows.time_us.size());
    Means day(rows, kDaySide_us), hours(rows, kHoursSide_us);
    Ranges range(rows);
    for (std::size_t i = 0; i < rows.time_us.size(); ++i) {
        const double of_day = day.around(i), of_hours = hours.around(i);
        const bool sun = !rows.sine.empty() && rows.sine[i] > 0.0 && !std::isnan(of_hours);
        const double range_k = range.around(i, ordinary_range_k(of_day));
        clouds.push_back(std::isnan(of_day)
                             ? of_day
                             : cloud_of_day({.mean_rel_humidity_pct = of_day,
                                             .range_k = range_k,
                                             .damper_pct = sun ? of_hours - of_day : 0.0}));
    }
    return clouds;
}

}  // namespace petrichor::weather
