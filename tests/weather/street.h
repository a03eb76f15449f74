// Patches one by one, and weather that stays as it is.
#ifndef PETRICHOR_TESTS_WEATHER_STREET_H
#define PETRICHOR_TESTS_WEATHER_STREET_H

#include <cstddef>
#include <cstdint>

#include "tests/weather/made_up.h"
#include "weather/patches/patch_weather.h"
#include "weather/physics/constants.h"

namespace petrichor::weather::testing_weather {

// A street for the tests: patches are added one by one, without links.
struct Street {
    PatchSet set;

    Street()
    {
        for (const char* name : {"asphalt", "grass", "roof_metal", "brick"}) {
            PatchKind kind;
            kind.surface = surface_preset(name);
            set.kinds.push_back(kind);
        }
        set.kinds[2].slides_above_deg = 15.0;
        set.link_begin = {0};
    }
    WeatherPatch& add(const Direction& normal = {}, std::uint32_t kind = 0)
    {
        WeatherPatch p;
        p.normal = normal;
        p.kind = kind;
        p.visible = open_sky(normal);
        set.patches.push_back(p);
        set.link_begin.push_back(static_cast<std::uint32_t>(set.links.size()));
        return set.patches.back();
    }
};

inline ForcingTable steady(std::size_t hours, double air_c, double rain_mm_h, double wind, double from,
                    double cloud = 1.0, std::int64_t begin_us = 1420070400LL * 1000000)
{
    ForcingTable t;
    t.site = {46.0, 8.0, 600.0};
    for (std::size_t i = 0; i < hours; ++i) {
        t.time_us.push_back(begin_us + static_cast<std::int64_t>(i) * kHourUs);
        t[Field::AirTemp].push_back(kZeroCelsiusK + air_c);
        t[Field::RelHumidity].push_back(85);
        t[Field::Wind].push_back(wind);
        t[Field::WindFrom].push_back(from);
        t[Field::Precip].push_back(rain_mm_h / 3600.0);
        t[Field::Cloud].push_back(cloud);
    }
    ReadReport report;
    fill_forcing(t, report);
    return t;
}

// After a change of air or precipitation: radiation that goes with it.
inline void refill(ForcingTable& t)
{
    t[Field::Longwave].clear();
    t[Field::Shortwave].clear();
    ReadReport report;
    fill_forcing(t, report);
}

}  // namespace petrichor::weather::testing_weather

#endif
