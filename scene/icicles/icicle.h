#ifndef PETRICHOR_SCENE_ICICLES_ICICLE_H
#define PETRICHOR_SCENE_ICICLES_ICICLE_H

#include <array>
#include <cstddef>

namespace petrichor::scene {

/// Of an icicle's ice; water and bubbles in it are not counted.
inline constexpr double kIcicleDensity_kg_m3 = 917.0;
/// A drop of water hangs at the tip and keeps it as wide (ours, as seen: 4 to 5 mm across).
inline constexpr float kIcicleTip_m = 0.0022f;

/// Radius at a way up from the tip. All icicles have the same profile, of which longer ones show more: the way up grows
/// with the radius to the power of 4/3 (Short, Baygents and Goldstein 2006), by 110 m^(-1/3) (ours): 24 cm are 2.2 cm across.
float icicle_radius_m(float from_tip_m);
/// Ice in one that is so long; 0 and more.
double icicle_volume_m3(double length_m);
/// How long one of that volume is: the inverse.
double icicle_length_m(double volume_m3);
/// What of it air can reach: its side, and the drop at the tip.
double icicle_area_m2(double length_m);

/// How long icicles are at edges that have drained so much, in a frame: of kIcicleClasses areas, 1e-4 m2 and from each to
/// the next kIcicleClassStep times as much.
inline constexpr std::size_t kIcicleClasses = 24;
inline constexpr double kIcicleClassStep = 1.5848931924611136;  // ten to the fifth
struct IcicleLengths {
    std::array<float, kIcicleClasses> length_m{};

    bool any() const;
    bool operator==(const IcicleLengths&) const = default;
};
double icicle_class_m2(std::size_t number);
/// Between two classes linear over the logarithm; below the first as much less as the volume is.
float icicle_length_m(const IcicleLengths& lengths, float drained_m2);

/// Shorter ones are glaze, and not drawn.
inline constexpr float kShortestIcicle_m = 0.008f;
inline constexpr float kLongestIcicle_m = 1.5f;  ///< longer ones break off

}  // namespace petrichor::scene

#endif
