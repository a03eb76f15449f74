#ifndef PETRICHOR_WEATHER_PATCHES_PATCH_WEATHER_H
#define PETRICHOR_WEATHER_PATCHES_PATCH_WEATHER_H

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "weather/forcing/forcing.h"
#include "weather/models/physical/physical.h"
#include "weather/patches/patches.h"
#include "weather/patches/taps.h"

namespace petrichor::weather {

/// Of the water over a pond: how deep it is in the mean, and how much of its surface is this pond's.
struct PondShape {
    double depth_m = 0.0;  ///< ice counted as the water that it is
    double area_m2 = 0.0;
};

/// Water that stands in ponds, kept by whoever knows their shape. Called once a step, by one
/// thread: takes what ran in (m3, by pond), lets the level fall by `loss_m` (by pond), changes
/// `volume_m3` and returns what ran over and out of the scene, and what was lost, m3. Must depend
/// on its arguments alone.
struct PondStep {
    double out_m3 = 0.0, lost_m3 = 0.0;
};
struct Ponds {
    std::vector<double> volume_m3;  ///< at the start; as many numbers as the callback likes
    std::function<PondStep(std::span<double> volume_m3, std::span<const double> in_m3,
                           std::span<const double> loss_m)>
        step;
    std::function<double(std::span<const double> volume_m3)> stored_m3;
    /// By pond; depth times area adds up to stored_m3. Without it ponds do not freeze.
    std::function<std::vector<PondShape>(std::span<const double> volume_m3)> shape;
    /// By pond, world y; without it taps fill the first pond that they come to.
    std::function<std::vector<float>(std::span<const double> volume_m3)> level_m;
};

struct PatchParams {
    PhysicalParams model;        ///< its surface, sky_view and canopy are not used
    double north_deg = 0.0;      ///< azimuth, clockwise from the scene's -z, of true north
    double spin_up_days = 14.0;  ///< >= 0, before the first moment or the last bare ground
    /// Where the file gives no direction of the wind.
    double wind_from_deg = 240.0;
    double room_temp_k = 293.15;  ///< of houses behind their walls: the set point of ISO 13790
    double outside_albedo = 0.2, outside_snow_albedo = 0.6;  ///< of the ground beyond the scene
    std::vector<PatchTap> taps;  ///< water that is let in
    int threads = 1;             ///< >= 1; the result does not depend on it
};

/// State of a patch at a moment. Masses per m2 of patch surface.
struct PatchState {
    CellState cell;
    double hoar_kg_m2 = 0.0;      ///< frost that has grown and is still there
    double run_on_kg_m2_s = 0.0;  ///< water that came from patches above, mean of the last hour
    double rain_share = 1.0;      ///< of the rain on open flat ground that meets it: R_n / R
    double wind_factor = 1.0;     ///< wind here over wind in the open
    double shortwave_w_m2 = 0.0;  ///< that arrives
    double longwave_w_m2 = 0.0;
};

/// The books of a scene since the start of a run, kg. Closed when
///   fallen + let in + initially stored == stored + evaporated + sublimated + soaked + out
struct PatchLedger {
    double initially = 0.0, fallen = 0.0, let_in = 0.0;  // the last by taps
    double stored = 0.0, in_ponds = 0.0;
    double evaporated = 0.0, sublimated = 0.0, soaked = 0.0, out = 0.0, lost_from_ponds = 0.0;
    TapHeat tap_heat;
    double residual() const
    {
        return (initially + fallen + let_in) -
               (stored + in_ponds + evaporated + sublimated + soaked + out + lost_from_ponds);
    }
};

/// The physical model on every patch of a scene, under one weather file: sun through the patch's
/// own visibility, anisotropic sky, heat and reflected light of the patches it sees, shelter from
/// wind and rain, run-off, splashes, snow that slides.
///
/// A step of the model is an hour. The run starts `spin_up_days` before the last time before `from`
/// at which two scouts (in the open, and in the darkest yard) were free of snow, so that what lies
/// at `from` does not depend on the start. Moments are then reached in any order from checkpoints,
/// and a time within a step by a shorter last step: the same bits for any order and any number of
/// threads.
class PatchWeather {
public:
    /// `table` must have been through fill_forcing. Takes the whole run up to `from_us`.
    ///   throws  Error for parameters or patches out of range
    PatchWeather(ForcingTable table, PatchSet set, const PatchParams& params, std::int64_t from_us,
                 Ponds ponds = {});
    PatchWeather(PatchWeather&&) noexcept;
    PatchWeather& operator=(PatchWeather&&) noexcept;
    ~PatchWeather();

    std::size_t patches() const;
    /// When the run starts and ends. Moments before the start give its initial state.
    std::int64_t begin_us() const;
    std::int64_t end_us() const;

    /// Goes to a moment; what follows describes it.
    void go_to(std::int64_t utc_us);
    PatchState state(std::size_t patch) const;
    /// Of level ground in the open, of the kind that most level ground of the scene is made of.
    PatchState open() const;
    std::uint32_t open_kind() const;
    std::span<const double> pond_volumes_m3() const;
    /// Heat of the water over each pond (pond_ice.h), J/kg; 0 where none stands. Ice floats: levels and
    /// volumes hold it as the water that it is.
    std::span<const double> pond_heat_j_kg() const;
    PatchLedger ledger() const;
    /// Hash of all that the moment holds, in the order of the patches.
    std::uint64_t hash() const;

    /// The moment as bytes, and back: going on gives the same bits. `restore` throws Error for
    /// bytes of another run.
    std::vector<std::byte> save() const;
    void restore(std::span<const std::byte> saved);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace petrichor::weather

#endif
