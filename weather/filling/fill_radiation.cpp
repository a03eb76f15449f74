#include "weather/filling/fill_radiation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "weather/filling/cloud_of_rows.h"
#include "weather/physics/humidity.h"
#include "weather/physics/longwave.h"
#include "weather/physics/solar.h"

namespace petrichor::weather {

namespace {

constexpr std::int64_t kHour_us = 3600LL * 1000000;
constexpr std::int64_t kLongestDivided_us = 48 * kHour_us;
constexpr std::int64_t kLongestGap_us = 100 * 24 * kHour_us;
constexpr std::int64_t kMostInGaps = 10000;  // more than the file has by itself

// Parts into which the interval after a row is divided.
std::int64_t parts_of(std::int64_t length_us)
{
    return length_us > kLongestDivided_us ? 1 : (length_us + kHour_us - 1) / kHour_us;
}

// Means of whole intervals of the file, hour by hour under a sun that rises and sets.
void follow_the_sun(std::vector<double>& net, const std::vector<double>& sun,
                    const std::vector<std::int64_t>& time_us)
{
    // Neighbours with one value mostly come from one row of the file; their mean stays in any case.
    for (std::size_t begin = 0; begin < net.size();) {
        std::size_t end = begin + 1;
        while (end < net.size() && net[end] == net[begin]) ++end;
        double light = 0.0, span = 0.0;
        for (std::size_t i = begin; i < end; ++i) {
            const std::size_t next = std::min(i + 1, net.size() - 1);
            const double length = static_cast<double>(time_us[next] - time_us[i]);
            light += 0.5 * (sun[i] + sun[next]) * length;
            span += length;
        }
        const double mean = net[begin];
        for (std::size_t i = begin; light > 0.0 && i < end; ++i) {
            const std::size_t next = std::min(i + 1, net.size() - 1);
            net[i] = mean * (0.5 * (sun[i] + sun[next]) * span / light);
        }
        begin = end;
    }
}

}  // namespace

void divide_for_the_sun(ForcingTable& table, ReadReport& report, const FillOptions& options)
{
    const bool sun = table.has(Field::Shortwave);
    const std::vector<std::int64_t> was = table.time_us;
    if (was.size() < 2) return;
    // The last row lasts as long as the one before it.
    const std::size_t last = was.size() - 1;
    const auto length_of = [&](std::size_t i) {
        return i < last ? was[i + 1] - was[i] : was[last] - was[last - 1];
    };
    // A row without one value begins a gap (RowCollector): nothing is known until the next one.
    const auto begins_gap = [&](std::size_t i) {
        if (i == last || length_of(i) <= options.longest_gap_us || length_of(i) > kLongestGap_us)
            return false;
        for (std::size_t f = 0; f < kFieldCount; ++f) {
            const auto& column = table.columns[f];
            if (!column.empty() && !field_info(static_cast<Field>(f)).observed &&
                !std::isnan(column[i]))
                return false;
        }
        return true;
    };
    std::vector<std::int64_t> parts(was.size(), 1);
    std::int64_t rows = 0, in_gaps = 0;
    for (std::size_t i = 0; i <= last; ++i) {
        if (!sun) parts[i] = parts_of(length_of(i));
        rows += parts[i];
        if (parts[i] == 1 && begins_gap(i)) in_gaps += (length_of(i) + kHour_us - 1) / kHour_us - 1;
    }
    const bool gaps = in_gaps > 0 && in_gaps <= rows + kMostInGaps;
    for (std::size_t i = 0; gaps && i <= last; ++i)
        if (parts[i] == 1 && begins_gap(i)) parts[i] = (length_of(i) + kHour_us - 1) / kHour_us;
    const std::int64_t divided = rows - static_cast<std::int64_t>(was.size());
    if (divided == 0 && !gaps) return;

    table.time_us.clear();
    std::array<std::vector<double>, kFieldCount> columns;
    columns.swap(table.columns);
    for (std::size_t i = 0; i <= last; ++i) {
        for (std::int64_t part = 0; part < parts[i]; ++part) {
            table.time_us.push_back(was[i] + length_of(i) / parts[i] * part);
            const double x = static_cast<double>(part) / static_cast<double>(parts[i]);
            for (std::size_t f = 0; f < kFieldCount; ++f) {
                const auto& from = columns[f];
                if (from.empty()) continue;
                const FieldInfo& info = field_info(static_cast<Field>(f));
                const bool line = part > 0 && i < last && !info.is_rate;
                // What was observed was not observed in between.
                table.columns[f].push_back(info.observed && part > 0 ? kMissing
                                           : line ? from[i] + (from[i + 1] - from[i]) * x
                                                  : from[i]);
            }
        }
    }
    if (divided > 0)
        report.add({ReadNote::Kind::Info, 0, field_info(Field::Shortwave).name,
                    "no value in the file: its " + std::to_string(was.size()) +
                        " rows are divided into " + std::to_string(rows) +
                        " of at most an hour, for the sun to rise and set"});
    if (gaps)
        report.add({ReadNote::Kind::Info, 0, field_info(Field::Shortwave).name,
                    "gaps are divided into " + std::to_string(in_gaps) +
                        " more rows of at most an hour, for the sun to rise and set in them"});
}

void fill_radiation(ForcingTable& table, ReadReport& report,
                    const std::vector<double>& measured_air_k)
{
    const std::size_t n = table.rows();
    auto& net = table[Field::NetShortwave];
    if (table.has(Field::Shortwave) && !net.empty()) {
        net.clear();
        report.add({ReadNote::Kind::Info, 0, field_info(Field::NetShortwave).name,
                    "not used: the file has sw_down"});
    }
    auto& cloud = table[Field::Cloud];
    auto& sw = table[Field::Shortwave];
    auto& lw = table[Field::Longwave];
    cloud.resize(n, kMissing);
    sw.resize(n, kMissing);
    lw.resize(n, kMissing);
    const bool place =
        !std::isnan(table.site.latitude_deg) && !std::isnan(table.site.longitude_deg);
    const Observer observer(place ? table.site.latitude_deg : 45.0,
                            place ? table.site.longitude_deg : 0.0);
    std::vector<double> sine(n, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
        if (std::isnan(cloud[i]) || std::isnan(sw[i]))
            sine[i] = SunNear(table.time_us[i], observer).at(table.time_us[i]).up;
    }
    CloudFills clouds;
    cloud = cloud_of_rows(table, sine, place, measured_air_k, clouds);
    std::size_t shortwave = 0, longwave = 0;
    for (std::size_t i = 0; i < n; ++i) {
        if (std::isnan(sw[i])) {
            sw[i] = falls_in(table, i) ? rainy_sky_w_m2(sine[i], cloud[i])
                                       : cloudy_sky_w_m2(sine[i], cloud[i]);
            ++shortwave;
        }
        sw[i] = std::max(sw[i], 0.0);
        if (std::isnan(lw[i])) {
            const double t = table[Field::AirTemp][i];
            lw[i] = longwave_from_sky_w_m2(t, vapour_pressure_pa(t, table[Field::RelHumidity][i]),
                                           cloud[i], emissivity_of_row(table, i));
            ++longwave;
        }
    }
    if (!net.empty()) follow_the_sun(net, sw, table.time_us);

    const std::string where = place ? "" : " at 45 N 0 E: the file gives no place";
    const char* cloud_name = field_info(Field::Cloud).name;
    note_filled(report, cloud_name, clouds.from_sun,
                "from shortwave; at night between that of the evening and of the morning");
    note_filled(report, cloud_name, clouds.from_sky, "from longwave (Dilley & O'Brien 1998)");
    note_filled(report, cloud_name, clouds.falling, "full: something falls, or fog");
    note_filled(report, cloud_name, clouds.from_air,
                "from the air of a day: the more the damper it is and the less it warms");
    note_filled(report, field_info(Field::Shortwave).name, shortwave,
                "clear sky (Haurwitz 1945) and cloud (Kasten & Czeplak 1980)" + where +
                    (net.empty() ? "" : "; what the ground takes up is the file's sw_net"));
    note_filled(report, field_info(Field::Longwave).name, longwave,
                "air and cloud (Dilley & O'Brien 1998; cloud after Konzelmann et al. 1994)");
}

}  // namespace petrichor::weather
