#ifndef PETRICHOR_WEATHER_PHYSICS_AIR_H
#define PETRICHOR_WEATHER_PHYSICS_AIR_H

namespace petrichor::weather {

// What the air between the camera and the surface looks like.

/// Which contrast a visibility stands for. Files that state a visibility must state which.
enum class VisibilityKind {
    Contrast2Percent,  ///< Koschmieder: extinction 3.912 / V
    Optical5Percent,   ///< meteorological optical range: 2.996 / V
};
/// Extinction coefficient, 1/m; visibility > 0. The functions are each other's inverse.
double extinction_1_m(double visibility_m, VisibilityKind kind);
double visibility_m(double extinction_1_m, VisibilityKind kind);

/// Drops of rain by size, Marshall & Palmer 1948: N(D) = 8000 exp(-slope D).
struct RainDrops {
    double slope_1_mm = 0.0;        ///< 4.1 R^-0.21
    double per_m3 = 0.0;            ///< 8000 / slope
    double mean_diameter_mm = 0.0;  ///< 1 / slope
};
/// rate_mm_h > 0.
RainDrops rain_drops(double rate_mm_h);
/// Terminal speed of a drop, Atlas et al. 1973: 9.65 - 10.3 exp(-0.6 D), not below 0.
double drop_fall_speed_m_s(double diameter_mm);

}  // namespace petrichor::weather

#endif
