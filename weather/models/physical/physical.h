#ifndef PETRICHOR_WEATHER_MODELS_PHYSICAL_PHYSICAL_H
#define PETRICHOR_WEATHER_MODELS_PHYSICAL_PHYSICAL_H

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "weather/forcing/forcing.h"
#include "weather/models/physical/road_events.h"
#include "weather/physics/cell_state.h"
#include "weather/physics/exchange.h"
#include "weather/physics/horizon.h"
#include "weather/physics/phase.h"
#include "weather/physics/snow.h"
#include "weather/physics/surfaces.h"

namespace petrichor::weather {

/// Everything that is not weather: the defaults suit any site.
///
/// Chosen defaults: three snow layers (night temperatures), overburden settling with Pahaut's new
/// snow (depth), albedo by age (Verseghy), Louis stability with the Richardson number capped at 0.1
/// over everything (without a cap a calm clear night decouples the snow from the air).
struct PhysicalParams {
    Surface surface;
    SnowParams snow;
    ExchangeParams exchange;
    PhaseParams phase;
    double step_s = 3600.0;    ///< 1..86400
    double substep_s = 600.0;  ///< the finest: while a thin snow pack comes or goes
    double deep_temp_k =
        kMissing;                ///< of the ground far below; NaN: yearly mean of the air, fitted
    double sky_view = 1.0;       ///< share of the sky that is seen, 0..1
    double precip_factor = 1.0;  ///< >= 0
    /// Leaves and branches over a m2 of ground, 0..20 m2: they catch snow first and let it go,
    /// slowly in the frost (canopy_interception_kg_m2; forests 1 to 4). The sky they hide is
    /// `sky_view`.
    double canopy_vai = 0.0;
    /// Of one cell: takes the sun's beam while it is behind it, and its share of the sky (times
    /// `sky_view`). For weather measured in the open; grids have horizons of their own.
    Horizon horizon{};
    std::vector<RoadEvent> events{};  ///< of one cell, by time; salt, ploughs
};
/// Throws Error that names the field when a value cannot be used.
void check_params(const PhysicalParams& params);

/// One cell through time: the state at any instant, in any order, always the same bits.
///
/// Construction runs the whole series once and keeps a checkpoint every 24 steps; a state is then a
/// checkpoint plus at most 24 steps. A time inside a step is reached by a shorter last step. Times
/// before the first row give the initial state, times after the last row the final one.
class PhysicalTimeline {
public:
    /// `table` must have been through fill_forcing. Throws Error for parameters out of range.
    PhysicalTimeline(const ForcingTable& table, const PhysicalParams& params);
    /// The same without a copy of the table, which must not change afterwards.
    PhysicalTimeline(std::shared_ptr<const ForcingTable> table, const PhysicalParams& params);
    /// Continues from a state that save_state wrote; `at_us` must be a step of this timeline.
    PhysicalTimeline(const ForcingTable& table, const PhysicalParams& params,
                     const CellState& state, std::int64_t at_us);
    PhysicalTimeline(PhysicalTimeline&&) noexcept;
    PhysicalTimeline& operator=(PhysicalTimeline&&) noexcept;
    ~PhysicalTimeline();

    std::int64_t begin_us() const;
    std::int64_t end_us() const;
    std::size_t steps() const;

    CellState state_at(std::int64_t time_us) const;
    /// States at begin, begin + every, .. end: one pass, the same bits as state_at.
    std::vector<CellState> series(std::int64_t begin_us, std::int64_t end_us,
                                  std::int64_t every_us) const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace petrichor::weather

#endif
