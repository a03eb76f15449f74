#include "cli/report/time_axis.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "cli/report/plot_axes.h"
#include "weather/readers/text.h"

namespace petrichor::cli {
namespace {

constexpr const char* kMonths[] = {"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                   "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};
constexpr double kDay_s = 86400.0;

struct Calendar {
    std::int64_t start_us;
    double first_s, last_s;

    double seconds(std::int64_t us) const { return static_cast<double>(us - start_us) * 1e-6; }
    std::int64_t us(double seconds_in) const
    {
        return start_us + static_cast<std::int64_t>(std::llround(seconds_in * 1e6));
    }
    bool inside(double time_s) const { return time_s >= first_s - 1e-6 && time_s <= last_s + 1e-6; }
};

std::string clock_text(const weather::CivilTime& t)
{
    char text[16];
    std::snprintf(text, sizeof text, "%02d:%02d", t.hour, t.minute);
    return text;
}

std::string day_text(const weather::CivilTime& t)
{
    return std::to_string(t.day) + " " + kMonths[t.month - 1];
}

// Round times of the day; midnight shows the date.
std::vector<TimeTick> clock_ticks(const Calendar& c, double step_s)
{
    std::vector<TimeTick> ticks;
    const std::int64_t step = static_cast<std::int64_t>(step_s * 1e6);
    const std::int64_t first = c.us(c.first_s);
    for (std::int64_t us = (first + step - 1) / step * step; c.inside(c.seconds(us)); us += step) {
        const auto civil = weather::civil_from_us(us);
        ticks.push_back({c.seconds(us), civil.hour == 0 && civil.minute == 0 ? day_text(civil)
                                                                             : clock_text(civil)});
    }
    return ticks;
}

// Every `step` days of a month, counted from the 1st; none so late that the next month's first
// crowds it.
std::vector<TimeTick> day_ticks(const Calendar& c, int step)
{
    std::vector<TimeTick> ticks;
    constexpr std::int64_t kDay_us = 86400LL * 1000000;
    for (std::int64_t us = (c.us(c.first_s) + kDay_us - 1) / kDay_us * kDay_us;
         c.inside(c.seconds(us)); us += kDay_us) {
        const auto civil = weather::civil_from_us(us);
        const bool crowded = step > 1 && civil.day > 31 - step;
        if ((civil.day - 1) % step == 0 && !crowded)
            ticks.push_back({c.seconds(us), day_text(civil)});
    }
    return ticks;
}

std::vector<TimeTick> month_ticks(const Calendar& c, int step)
{
    std::vector<TimeTick> ticks;
    const auto begin = weather::civil_from_us(c.us(c.first_s));
    long long month = begin.year * 12 + begin.month - 1;
    month -= month % step;
    for (;; month += step) {
        const long long year = month / 12;
        const int index = static_cast<int>(month % 12);
        const double at =
            c.seconds(weather::days_from_civil(year, index + 1, 1) * 86400LL * 1000000);
        if (at > c.last_s + 1e-6) break;
        if (c.inside(at)) ticks.push_back({at, index == 0 ? std::to_string(year) : kMonths[index]});
    }
    return ticks;
}

}  // namespace

std::vector<TimeTick> elapsed_ticks(double first_s, double last_s, int most)
{
    const auto times = axis_ticks(first_s, last_s, most, true);
    const double spacing = times.size() > 1 ? times[1] - times[0] : 1.0;
    std::vector<TimeTick> ticks;
    for (double time : times) ticks.push_back({time, time_label(time, spacing)});
    return ticks;
}

std::vector<TimeTick> calendar_ticks(std::int64_t start_us, double first_s, double last_s, int most)
{
    const Calendar c{start_us, first_s, last_s};
    const double span = last_s - first_s;
    if (span < 60.0 || most < 1) return elapsed_ticks(first_s, last_s, most);
    std::vector<TimeTick> ticks;
    const auto fits = [&](double step_s) { return span / step_s <= most; };
    for (double minutes : {1., 2., 5., 10., 15., 30., 60., 120., 180., 360., 720.}) {
        if (ticks.empty() && fits(60.0 * minutes)) ticks = clock_ticks(c, 60.0 * minutes);
    }
    for (int days : {1, 2, 5, 10, 15}) {
        if (ticks.empty() && fits(kDay_s * days)) ticks = day_ticks(c, days);
    }
    for (int months : {1, 2, 3, 6, 12, 24, 60, 120, 600, 1200}) {
        if (ticks.empty() && fits(30.4 * kDay_s * months)) ticks = month_ticks(c, months);
    }
    if (ticks.empty()) return elapsed_ticks(first_s, last_s, most);
    // Under hours the day once, where the first is no midnight; else the year once, where no tick says it.
    TimeTick& first = ticks.front();
    const auto civil = weather::civil_from_us(c.us(first.time_s));
    const bool said = std::any_of(ticks.begin(), ticks.end(), [](const TimeTick& t) {
        return t.label.size() == 4 && t.label[0] <= '9';
    });
    if (first.label == clock_text(civil))
        first.label += " " + day_text(civil);
    else if (!said)
        first.label += " " + std::to_string(civil.year);
    return ticks;
}

}  // namespace petrichor::cli
