#ifndef PETRICHOR_WEATHER_PATCHES_MOVING_SNOW_H
#define PETRICHOR_WEATHER_PATCHES_MOVING_SNOW_H

namespace petrichor::weather {

/// Force along a slope that its wet base does not hold, over the weight of the pack:
/// sin(tilt) - tan(rest) cos(tilt), 0 up to the angle of rest. Both 0..90 degrees.
double slide_pull(double tilt_deg, double rest_deg);

/// Friction velocity over snow 1 mm rough, m/s, of the wind at 10 m: 0.4 U / ln(10 / 0.001).
double snow_friction_m_s(double wind_10m_m_s);

/// Snow that jumps along the ground through a metre across the wind, kg m-1 s-1; Pomeroy & Gray
/// 1990. 0 up to the threshold.
///   both friction velocities, m/s, the threshold above 0
double saltation_kg_m_s(double friction_m_s, double threshold_m_s, double air_density_kg_m3);

/// Of the snow that the wind brings over an obstacle: the share that comes down in a metre, so far
/// behind it. Heaped most at two heights, little at its foot, where the air turns, and 98 % within twelve;
/// all of it adds up to 1. s = distance / height: s exp(-s / 2) / (4 height), a form of ours through
/// what is said of solid fences.
///   distance_m  >= 0, infinite: 0; height_m >= 0, 0: no obstacle, 0
///   source      Tabler 2003, Controlling blowing and drifting snow with snow fences and road design,
///               NCHRP 20-7(147): drifts behind solid fences end at 10 to 12 heights
double lee_share_1_m(double distance_m, double height_m);

}  // namespace petrichor::weather

#endif
