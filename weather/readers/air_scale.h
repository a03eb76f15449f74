#ifndef PETRICHOR_WEATHER_READERS_AIR_SCALE_H
#define PETRICHOR_WEATHER_READERS_AIR_SCALE_H

#include <cstddef>

namespace petrichor::weather {

/// In which scale a file writes temperatures, for services that let people choose and do not write
/// down what they chose. Humidity is the vapour at the dew point over that at the air temperature,
/// which holds in one scale alone.
class AirScale {
public:
    enum class Scale { Unknown, Celsius, Fahrenheit, Kelvin };
    /// A row, as the file has it. Rows near saturation say nothing and do not count.
    void add(double air, double dew, double humidity_pct);
    /// Unknown with fewer than five rows that tell, or where no scale, or more than one, fits
    /// within 3 % of humidity.
    Scale scale() const;

private:
    std::size_t rows_ = 0;
    double off_pct_[3] = {0.0, 0.0, 0.0};  // sums of what each scale misses the humidity by
};

/// From a scale to K: value * scale + offset.
struct ToKelvin {
    double scale = 1.0, offset = 0.0;
};
ToKelvin to_kelvin(AirScale::Scale scale);

}  // namespace petrichor::weather

#endif
