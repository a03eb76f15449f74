#ifndef PETRICHOR_WEATHER_PHYSICS_STORES_H
#define PETRICHOR_WEATHER_PHYSICS_STORES_H

#include <cstddef>
#include <span>
#include <vector>

namespace petrichor::weather {

/// How much water a relief holds at each level: the hypsometric curve.
///
/// F(z) is the share of the cell lower than z, 0 <= z <= depth. Water standing at level h holds
/// V(h) = integral of F from 0 to h, so V'(h) = F(h): a loss of e kg/m2 from the wet area lowers
/// the level by exactly e (as 1 kg/m2 is 1 mm), whatever the relief.
///
/// The table has F at equal steps of z and is linear between; an empty table means uniform heights,
/// F = z / depth, V = h^2 / (2 depth).
struct Hypsometry {
    double depth_mm = 1.0;  ///< > 0
    std::vector<double>
        area_fraction;  ///< F at 0, depth/n, .., depth; non-decreasing in 0..1; or empty
    std::vector<double> volume_mm;  ///< V at the same places, made by make_hypsometry

    double capacity_kg_m2() const;
};

/// Curve of a height map. `heights` are 0 (low) .. 1 (high) in any order and need not be sorted.
///
///   depth_mm  range from the lowest to the highest point, > 0
///   steps     2..256 pieces of the curve
///   throws    Error when heights are empty or not finite, or depth is not positive
Hypsometry make_hypsometry(std::span<const float> heights, double depth_mm, int steps = 32);
/// Uniform heights.
Hypsometry uniform_hypsometry(double depth_mm);

/// Level in mm that holds a volume in kg/m2 of the whole cell; 0..depth. Inverse of stored_kg_m2.
double water_level_mm(const Hypsometry& relief, double stored_kg_m2);
/// Volume at a level.
double stored_kg_m2(const Hypsometry& relief, double level_mm);
/// Share of the cell that is under water at a level.
double wet_area(const Hypsometry& relief, double level_mm);

}  // namespace petrichor::weather

#endif
