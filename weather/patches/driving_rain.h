#ifndef PETRICHOR_WEATHER_PATCHES_DRIVING_RAIN_H
#define PETRICHOR_WEATHER_PATCHES_DRIVING_RAIN_H

#include <array>
#include <cstddef>

#include "weather/patches/visibility.h"

namespace petrichor::weather {

// Rain in wind: where it comes from, what of it meets a plane, what stands in its way, and what it
// does when it lands.

/// Terminal speed of a drop that rain is made of, m/s: Atlas, Srivastava & Sekhon 1973 from 0.5 mm
/// on, 4.5 D - 0.18 for drizzle; D in mm, > 0.05.
double rain_fall_speed_m_s(double diameter_mm);
/// Half of the water of rain of this rate (mm/h, > 0) comes in smaller drops, mm: 1.10 R^0.19.
double median_drop_mm(double rate_mm_h);
/// 10, 25, 50, 75 and 90 % of the water comes in drops below this times the median.
inline constexpr std::array<double, 5> kDropQuantiles{0.53, 0.73, 1.0, 1.34, 1.71};

/// Horizontal flux of water a m/s of wind over the vertical one, s/m: Lacy 1965, 0.222 R^-0.12.
double lacy_s_m(double rate_mm_h);

/// Rain on a plane in the open over rain on flat ground: max(0, n.y - k (n.W) / U), k = a U.
///   normal  unit; wind_x, wind_z: where the air goes, m/s at 10 m
double rain_on_plane(const Direction& normal, double wind_x_m_s, double wind_z_m_s,
                     double rate_mm_h);
/// Air parts around a building: walls take 1/4 at the foot and 3/4 at the top of what the open
/// takes, and a fifth more near an edge.
///   height_share  over the foot, of the height of the building, 0..1
double wall_rain_factor(double height_share, bool near_edge);

/// The directions that rain of a rate comes from in a wind: five sizes, and gusts of 20 degrees to
/// either side (1:2:1).
struct RainFan {
    std::array<VisibleLookup, 15> from;
    std::array<double, 15> weight;  ///< add up to 1
};
RainFan rain_fan(double wind_x_m_s, double wind_z_m_s, double rate_mm_h);
/// Share of that rain that nothing stands in the way of, 0..1.
double rain_share(const VisibleBits& bits, const RainFan& fan);

/// Speed of what drips from a height, m/s: v = vt sqrt(1 - exp(-2 g h / vt^2)), vt 9.14.
double drip_speed_m_s(double height_m);
/// Rain that jumps from the ground to a wall, over the rain on the ground: 0.15 h_f exp(-y / 0.10),
/// nothing above half a metre.
///   hardness  h_f: 1 hard ground, 0.3 grass, 0 snow
double splash_share(double height_m, double hardness);

/// Direction that snow comes from: it falls at 1 m/s and the wind near walls is 0.4 of that at 10
/// m.
Direction snow_direction(double wind_x_m_s, double wind_z_m_s);
/// Share of the fall that holds on a slope of this tilt: 30 degrees 1, 60 degrees 0.
double snow_holds(double tilt_rad);

}  // namespace petrichor::weather

#endif
