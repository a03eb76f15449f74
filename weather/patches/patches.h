#ifndef PETRICHOR_WEATHER_PATCHES_PATCHES_H
#define PETRICHOR_WEATHER_PATCHES_PATCHES_H

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "weather/patches/visibility.h"
#include "weather/physics/surfaces.h"

namespace petrichor::weather {

/// Where the water of a patch goes: another patch by its number, a pond, or out of the scene.
inline constexpr std::uint32_t kRunsOut = 0xFFFFFFFFu;
inline constexpr std::uint32_t kToPond = 0x80000000u;  ///< kToPond | number of the pond
inline constexpr std::uint32_t kNoPatch = 0xFFFFFFFFu;

/// What patches are made of.
struct PatchKind {
    Surface surface;
    /// Leaves and other thin things that have the temperature of the air: what they radiate.
    bool like_air = false;
    /// Of roofs: on steeper slopes a pack with a wet base slides, the sooner the steeper. 90: never.
    double slides_above_deg = 90.0;
    /// Falling snow holds by the tilt (snow_holds); on leaves and the like it stays.
    bool holds_by_tilt = true;
    double splash = 1.0;  ///< how hard rain jumps from it, h_f of splash_share
    /// A wall of a house: behind the layers of its surface (0.3 m where it has none) lies a room of
    /// PatchParams::room_temp_k, not the ground; 1.5 W m-2 K-1 or less go through.
    bool room_behind = false;
};

/// A piece of a surface as weather sees it.
struct WeatherPatch {
    Direction normal;        ///< unit, world; y up
    double area_m2 = 1.0;    ///< > 0
    double height_m = 0.0;   ///< world y of its middle
    std::uint32_t kind = 0;  ///< index into PatchSet::kinds
    VisibleBits visible{};
    /// Cosine-weighted shares of its hemisphere: sky, and other patches (below the horizon too).
    /// What is left is open ground beyond the scene. Negative sky_share: by the bits.
    double sky_share = -1.0;
    double patch_share = 0.0;
    double wall_factor = 1.0;  ///< of driving rain: wall_rain_factor; 1 for what is no wall
    std::uint32_t runs_to = kRunsOut;
    double gutter_share = 0.0;  ///< of what runs off, leaves the scene by a gutter
    /// The ground that splashes on it, and how high above that its middle lies.
    std::uint32_t foot = kNoPatch;
    double foot_height_m = 0.0;
};

/// What stands upwind of a patch in one direction: how far off, and how high over the patch.
struct Upwind {
    float distance_m = std::numeric_limits<float>::infinity();  ///< >= 0; infinite: nothing
    float height_m = 0.0f;                                      ///< >= 0
};

/// All patches of a scene.
struct PatchSet {
    std::vector<WeatherPatch> patches;
    std::vector<PatchKind> kinds;
    /// Patches that a patch sees: link_begin[i] .. link_begin[i + 1] of `links`, each of equal
    /// weight; empty rows where it sees none. link_begin has patches.size() + 1 entries.
    std::vector<std::uint32_t> link_begin, links;
    /// Neighbours that a heap of snow slides to, likewise; may be empty altogether.
    std::vector<std::uint32_t> beside_begin, beside;
    std::vector<float> beside_m;  ///< horizontal distance of each neighbour, > 0
    /// Of each patch, by where the wind comes from, as wind_blocking; empty: nobody has looked.
    std::vector<std::array<Upwind, kWindClasses>> upwind;
    std::uint32_t ponds = 0;      ///< how many there are
    /// Infiltration below each pond, mm/h; empty: 0.
    std::vector<double> pond_soaks_mm_h;
};

/// Throws Error that names the patch and the number when something cannot be used.
void check_patches(const PatchSet& set);

}  // namespace petrichor::weather

#endif
