#include "weather/filling/cloud_of_rows.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include "weather/physics/cloud_of_air.h"
#include "weather/physics/detail/formulas.h"
#include "weather/physics/humidity.h"
#include "weather/physics/longwave.h"
#include "weather/physics/solar.h"

namespace petrichor::weather {
namespace {

constexpr double kFalls_kg_m2_s = 0.1 / 3600.0;
constexpr double kFog_m = 1000.0;
constexpr double kLowSun = 0.17;
constexpr std::int64_t kWindow_us = 6LL * 3600 * 1000000;
// Of Kasten & Czeplak 1980: cloud takes 0.75 N^3.4 of the sun.
constexpr double kTaken = 3.4;

enum class From : std::uint8_t { Nothing, File, Sun, Sky };

class Rows {
public:
    Rows(const ForcingTable& table, const std::vector<double>& sine, bool sun_is_known,
         const std::vector<double>& measured_air_k)
        : table_(table), sine_(sine), measured_air_k_(measured_air_k), sun_is_known_(sun_is_known), cloud_(table.rows(), kMissing), from_(table.rows(), From::Nothing)
    {
        for (std::size_t i = 0; i < table.rows(); ++i) from_[i] = tell(i, sun_is_known);
    }

    std::vector<double> fill(CloudFills& fills)
    {
        const std::size_t n = cloud_.size();
        for (std::size_t begin = 0; begin < n;) {
            if (from_[begin] != From::Nothing) {
                count(from_[begin++], 1, fills);
                continue;
            }
            std::size_t end = begin;
            while (end < n && from_[end] == From::Nothing) ++end;
            between(begin, end, fills);
            begin = end;
        }
        for (std::size_t i = 0; i < n; ++i) {
            if (from_[i] == From::File || !falls_or_fog(i)) continue;
            cloud_[i] = 1.0;
            ++fills.falling;
        }
        return std::move(cloud_);
    }

private:
    From tell(std::size_t i, bool sun_is_known)
    {
        const double sw = table_[Field::Shortwave][i];
        const double lw = table_[Field::Longwave][i];
        if (!std::isnan(table_[Field::Cloud][i])) {
            cloud_[i] = table_[Field::Cloud][i];
            return From::File;
        }
        if (!std::isnan(sw) && sine_[i] > kLowSun && sun_is_known) {
            const double diffuse = table_.has(Field::Diffuse) ? table_[Field::Diffuse][i] : kMissing;
            cloud_[i] = std::isnan(diffuse) || !(sw > 0.0) ? cloud_fraction_of(sw, sine_[i])
                                                           : cloud_fraction_of_diffuse(diffuse / sw);
            return From::Sun;
        }
        if (std::isnan(sw) && !std::isnan(lw)) {
            const double t = table_[Field::AirTemp][i];
            cloud_[i] =
                cloud_of_longwave(t, vapour_pressure_pa(t, table_[Field::RelHumidity][i]), lw,
                                  emissivity_of_row(table_, i));
            return From::Sky;
        }
        return From::Nothing;
    }

    // Of the clear sky's sun, from row `at` on by `step`, what clouds took of it.
    double taken_near(std::size_t at, int step) const
    {
        double light = 0.0, taken = 0.0;
        for (std::size_t i = at;; i += static_cast<std::size_t>(step)) {
            if (i >= cloud_.size() ||  // which is below 0, too
                std::llabs(table_.time_us[i] - table_.time_us[at]) > kWindow_us)
                break;
            if (from_[i] != From::Sun) continue;
            const double clear = clear_sky_w_m2(sine_[i]);
            light += clear;
            taken += clear * (cloud_[i] > 0.0 ? detail::power(cloud_[i], kTaken) : 0.0);
        }
        return taken / light;
    }

    void between(std::size_t begin, std::size_t end, CloudFills& fills)
    {
        const bool before = begin > 0, after = end < cloud_.size();
        const bool sun_before = before && from_[begin - 1] == From::Sun;
        const bool sun_after = after && from_[end] == From::Sun;
        if (sun_before || (sun_after && !before)) {
            const double evening = sun_before ? taken_near(begin - 1, -1) : taken_near(end, 1);
            const double morning = sun_after ? taken_near(end, 1) : evening;
            const std::int64_t from = table_.time_us[before ? begin - 1 : begin];
            const std::int64_t to = table_.time_us[after ? end : end - 1];
            for (std::size_t i = begin; i < end; ++i) {
                const double x = to > from ? static_cast<double>(table_.time_us[i] - from) /
                                                 static_cast<double>(to - from)
                                           : 0.0;
                const double taken = evening + (morning - evening) * x;
                cloud_[i] = taken > 0.0 ? detail::power(taken, 1.0 / kTaken) : 0.0;
            }
            count(From::Sun, end - begin, fills);
            return;
        }
        if (!before) {
            const std::vector<double> air =
                cloud_of_air({table_.time_us, table_[Field::RelHumidity], measured_air_k_,
                              sun_is_known_ ? std::span<const double>(sine_)
                                            : std::span<const double>()});
            std::copy_n(air.begin(), end, cloud_.begin());
            count(From::Nothing, end, fills);
            return;
        }
        std::fill(cloud_.begin() + static_cast<std::ptrdiff_t>(begin),
                  cloud_.begin() + static_cast<std::ptrdiff_t>(end), cloud_[begin - 1]);
        count(from_[begin - 1] == From::Sky ? From::Sky : From::Nothing, end - begin, fills);
    }

    bool falls_or_fog(std::size_t row) const
    {
        return falls_in(table_, row) ||
               (table_.has(Field::Visibility) && table_[Field::Visibility][row] < kFog_m);
    }

    static void count(From from, std::size_t rows, CloudFills& fills)
    {
        if (from == From::Sun) fills.from_sun += rows;
        if (from == From::Sky) fills.from_sky += rows;
        if (from == From::Nothing) fills.from_air += rows;
    }

    const ForcingTable& table_;
    const std::vector<double>& sine_;
    const std::vector<double>& measured_air_k_;
    bool sun_is_known_;
    std::vector<double> cloud_;
    std::vector<From> from_;
};

}  // namespace

bool falls_in(const ForcingTable& table, std::size_t row)
{
    for (const Field f : {Field::Precip, Field::Rain, Field::Snow})
        if (table.has(f) && table[f][row] >= kFalls_kg_m2_s) return true;
    return false;
}

double emissivity_of_row(const ForcingTable& table, std::size_t row)
{
    const double longitude_deg = table.site.longitude_deg;
    return std::isnan(longitude_deg) ? 0.0 : emissivity_of_hour(table.time_us[row], longitude_deg);
}

std::vector<double> cloud_of_rows(const ForcingTable& table, const std::vector<double>& sine,
                                  bool sun_is_known, const std::vector<double>& measured_air_k,
                                  CloudFills& fills)
{
    return Rows(table, sine, sun_is_known, measured_air_k).fill(fills);
}

}  // namespace petrichor::weather
