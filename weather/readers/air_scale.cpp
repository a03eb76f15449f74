#include "weather/readers/air_scale.h"

#include <cmath>

#include "weather/physics/constants.h"
#include "weather/physics/humidity.h"

namespace petrichor::weather {

namespace {

constexpr AirScale::Scale kScales[] = {AirScale::Scale::Celsius, AirScale::Scale::Fahrenheit,
                                       AirScale::Scale::Kelvin};

}  // namespace

ToKelvin to_kelvin(AirScale::Scale scale)
{
    switch (scale) {
        case AirScale::Scale::Fahrenheit:
            return {5.0 / 9.0, kZeroCelsiusK - 32.0 * 5.0 / 9.0};
        case AirScale::Scale::Kelvin:
            return {};
        default:
            return {1.0, kZeroCelsiusK};
    }
}

void AirScale::add(double air, double dew, double humidity_pct)
{
    constexpr double kApart = 2.0;  // so near to saturation every scale fits
    if (!(air - dew >= kApart && humidity_pct > 0.0 && humidity_pct <= 100.0)) return;
    ++rows_;
    for (int i = 0; i < 3; ++i) {
        const ToKelvin k = to_kelvin(kScales[i]);
        const double air_k = air * k.scale + k.offset, dew_k = dew * k.scale + k.offset;
        // What no air has is as far off as can be.
        const bool possible = air_k > 180.0 && air_k < 335.0 && dew_k > 150.0;
        const double made_pct =
            possible ? 100.0 * saturation_pressure_water_pa(dew_k) /
                           saturation_pressure_water_pa(air_k)
                     : 200.0;
        off_pct_[i] += std::abs(made_pct - humidity_pct);
    }
}

AirScale::Scale AirScale::scale() const
{
    constexpr std::size_t kFew = 5;
    constexpr double kFits_pct = 3.0;
    if (rows_ < kFew) return Scale::Unknown;
    Scale found = Scale::Unknown;
    for (int i = 0; i < 3; ++i) {
        if (off_pct_[i] > kFits_pct * static_cast<double>(rows_)) continue;
        if (found != Scale::Unknown) return Scale::Unknown;
        found = kScales[i];
    }
    return found;
}

}  // namespace petrichor::weather
