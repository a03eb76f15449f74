#include "weather/filling/fill_radiation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "weather/physics/humidity.h"
#include "weather/physics/longwave.h"
#include "weather/physics/solar.h"

namespace petrichor::weather {

namespace {

constexpr std::int64_t kHour_us = 3600LL * 1000000;
constexpr std::int64_t kLongestDivided_us = 48 * kHour_us;
constexpr double kFalls_kg_m2_s = 0.1 / 3600.0;
constexpr double kFog_m = 1000.0;

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

// How many rows were filled in each way.
struct Fills {
    std::size_t cloud_from_sun = 0, cloud_from_sky = 0, cloud_falling = 0, cloud_assumed = 0;
    std::size_t shortwave = 0, longwave = 0;
};

// Cloud of the rows in their order: a night keeps what the day said.
class CloudOfRows {
public:
    CloudOfRows(const ForcingTable& table, bool sun_is_known, double assumed)
        : table_(table), sun_is_known_(sun_is_known), last_(assumed)
    {
    }

    double at(std::size_t row, double sine, Fills& fills)
    {
        const double cloud = table_[Field::Cloud][row];
        const double sw = table_[Field::Shortwave][row];
        const double lw = table_[Field::Longwave][row];
        if (!std::isnan(cloud)) {
            from_ = nullptr;
            return last_ = cloud;
        }
        // What falls comes from a cloud, and fog is one.
        if (falls_or_fog(row)) {
            ++fills.cloud_falling;
            return 1.0;
        }
        // A low sun tells little about clouds.
        if (!std::isnan(sw) && sine > 0.17 && sun_is_known_) {
            from_ = &fills.cloud_from_sun;
            const double diffuse = table_.has(Field::Diffuse) ? table_[Field::Diffuse][row] : kMissing;
            last_ = std::isnan(diffuse) || !(sw > 0.0) ? cloud_fraction_of(sw, sine)
                                                       : cloud_fraction_of_diffuse(diffuse / sw);
        } else if (std::isnan(sw) && !std::isnan(lw)) {
            const double t = table_[Field::AirTemp][row];
            from_ = &fills.cloud_from_sky;
            last_ =
                cloud_of_longwave(t, vapour_pressure_pa(t, table_[Field::RelHumidity][row]), lw);
        }
        ++*(from_ ? from_ : &fills.cloud_assumed);
        return last_;
    }

private:
    bool falls_or_fog(std::size_t row) const
    {
        for (const Field f : {Field::Precip, Field::Rain, Field::Snow})
            if (table_.has(f) && table_[f][row] >= kFalls_kg_m2_s) return true;
        return table_.has(Field::Visibility) && table_[Field::Visibility][row] < kFog_m;
    }

    const ForcingTable& table_;
    bool sun_is_known_;
    double last_;
    std::size_t* from_ = nullptr;
};

}  // namespace

void divide_for_the_sun(ForcingTable& table, ReadReport& report)
{
    if (table.has(Field::Shortwave)) return;
    const std::vector<std::int64_t> was = table.time_us;
    if (was.size() < 2) return;
    // The last row lasts as long as the one before it.
    const std::size_t last = was.size() - 1;
    const auto length_of = [&](std::size_t i) {
        return i < last ? was[i + 1] - was[i] : was[last] - was[last - 1];
    };
    std::size_t rows = 0;
    for (std::size_t i = 0; i <= last; ++i)
        rows += static_cast<std::size_t>(parts_of(length_of(i)));
    if (rows == was.size()) return;

    table.time_us.clear();
    std::array<std::vector<double>, kFieldCount> columns;
    columns.swap(table.columns);
    for (std::size_t i = 0; i <= last; ++i) {
        const std::int64_t parts = parts_of(length_of(i));
        for (std::int64_t part = 0; part < parts; ++part) {
            table.time_us.push_back(was[i] + length_of(i) / parts * part);
            const double x = static_cast<double>(part) / static_cast<double>(parts);
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
    report.add({ReadNote::Kind::Info, 0, field_info(Field::Shortwave).name,
                "no value in the file: its " + std::to_string(was.size()) +
                    " rows are divided into " + std::to_string(rows) +
                    " of at most an hour, for the sun to rise and set"});
}

void fill_radiation(ForcingTable& table, ReadReport& report, const FillOptions& options)
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
    const Observer observer(place ? table.site.latitude_deg : 45.0, place ? table.site.longitude_deg : 0.0);
    Fills fills;
    CloudOfRows clouds(table, place, options.default_cloud);
    for (std::size_t i = 0; i < n; ++i) {
        double sine = 0.0;
        if (std::isnan(cloud[i]) || std::isnan(sw[i]))
            sine = SunNear(table.time_us[i], observer).at(table.time_us[i]).up;
        cloud[i] = clouds.at(i, sine, fills);
        if (std::isnan(sw[i])) {
            sw[i] = cloudy_sky_w_m2(sine, cloud[i]);
            ++fills.shortwave;
        }
        sw[i] = std::max(sw[i], 0.0);
        if (std::isnan(lw[i])) {
            const double t = table[Field::AirTemp][i];
            lw[i] = longwave_from_sky_w_m2(t, vapour_pressure_pa(t, table[Field::RelHumidity][i]),
                                           cloud[i]);
            ++fills.longwave;
        }
    }
    if (!net.empty()) follow_the_sun(net, sw, table.time_us);

    const std::string where = place ? "" : " at 45 N 0 E: the file gives no place";
    const char* cloud_name = field_info(Field::Cloud).name;
    note_filled(report, cloud_name, fills.cloud_from_sun, "from shortwave, kept through the night");
    note_filled(report, cloud_name, fills.cloud_from_sky, "from longwave (Prata 1996)");
    note_filled(report, cloud_name, fills.cloud_falling, "full: something falls, or fog");
    note_filled(report, cloud_name, fills.cloud_assumed, "assumed");
    note_filled(report, field_info(Field::Shortwave).name, fills.shortwave,
                "clear sky (Haurwitz 1945) and cloud (Kasten & Czeplak 1980)" + where +
                    (net.empty() ? "" : "; what the ground takes up is the file's sw_net"));
    note_filled(report, field_info(Field::Longwave).name, fills.longwave,
                "air and cloud (Prata 1996; cloud after Konzelmann et al. 1994)");
}

}  // namespace petrichor::weather
