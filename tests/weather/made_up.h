// Made-up weather for tests of the physical model.
#ifndef PETRICHOR_TESTS_WEATHER_MADE_UP_H
#define PETRICHOR_TESTS_WEATHER_MADE_UP_H

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "weather/forcing/forcing.h"
#include "weather/physics/constants.h"
#include "weather/physics/detail/formulas.h"
#include "weather/physics/detail/portable_math.h"
#include "weather/physics/humidity.h"
#include "weather/physics/solar.h"

namespace petrichor::weather::testing_weather {

inline constexpr std::int64_t kHourUs = 3600000000LL;

// A year of made-up weather that visits everything: frost, snow, rain on snow, freezing rain, melt,
// dry heat.
inline ForcingTable rough_year(std::size_t hours = 8760)
{
    ForcingTable t;
    t.site.latitude_deg = 46;
    t.site.longitude_deg = 8;
    t.site.elevation_m = 600;
    std::uint64_t state = 7;
    const auto random = [&] {
        state = state * 6364136223846793005ull + 1442695040888963407ull;
        return static_cast<double>(state >> 40) / static_cast<double>(1 << 24);
    };
    double wet = 0, spell = 0;
    for (std::size_t i = 0; i < hours; ++i) {
        const double h = static_cast<double>(i);
        if (i % 12 == 0) {
            wet = random() < 0.25 ? random() * 2e-3 : 0;
            spell = 12 * (random() - 0.5);
        }
        t.time_us.push_back(1420070400LL * 1000000 + static_cast<std::int64_t>(i) * kHourUs);
        t[Field::AirTemp].push_back(280 - 12 * detail::sine_cosine(2 * kPi * h / 8766).cos -
                                    4 * detail::sine_cosine(2 * kPi * h / 24).cos + spell);
        t[Field::RelHumidity].push_back(wet > 0 ? 95 : 60 + 30 * random());
        t[Field::Wind].push_back(6 * random());
        t[Field::Precip].push_back(wet);
        t[Field::Cloud].push_back(wet > 0 ? 1 : random());
        // Made up too, by Prata 1996 and the square of the cloud: what is filled in where a file
        // has none may get better, and the weather of these tests stays what it is.
        const double temp_k = t[Field::AirTemp].back(), cloud = t[Field::Cloud].back();
        const double x =
            46.5 * (0.01 * vapour_pressure_pa(temp_k, t[Field::RelHumidity].back())) / temp_k;
        const double clear = 1.0 - (1.0 + x) * detail::exponential(-std::sqrt(1.2 + 3.0 * x));
        const double sent =
            clear + std::max(0.955 - clear, 0.0) * detail::clamped(cloud * cloud, 0.0, 1.0);
        const std::int64_t now_us = t.time_us.back();
        t[Field::Shortwave].push_back(cloudy_sky_w_m2(
            SunNear(now_us, Observer(t.site.latitude_deg, t.site.longitude_deg)).at(now_us).up,
            cloud));
        t[Field::Longwave].push_back(sent * kStefanBoltzmann * (temp_k * temp_k) *
                                     (temp_k * temp_k));
    }
    ReadReport report;
    fill_forcing(t, report);
    return t;
}

}  // namespace petrichor::weather::testing_weather

#endif
