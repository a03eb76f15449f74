#include "weather/models/physical/physical.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "weather/models/physical/detail/cell_steps.h"
#include "weather/physics/constants.h"

namespace petrichor::weather {

namespace {

constexpr std::size_t kCheckpointEvery = 24;

void require(bool good, const char* name, double found, const char* accepted)
{
    if (good) return;
    throw Error(std::string("physical model: ") + name + " must be " + accepted + ", got " +
                    std::to_string(found),
                std::string("Set ") + name + " to a value in the accepted range.");
}

}  // namespace

void check_params(const PhysicalParams& p)
{
    check_surface(p.surface);
    require(p.step_s >= 1.0 && p.step_s <= 86400.0, "step_s", p.step_s, "in 1..86400");
    require(p.substep_s >= 1.0 && p.substep_s <= 86400.0, "substep_s", p.substep_s, "in 1..86400");
    require(p.step_s / p.substep_s <= 1000.0, "substep_s", p.substep_s,
            "at least a thousandth of step_s");
    require(p.sky_view >= 0.0 && p.sky_view <= 1.0, "sky_view", p.sky_view, "in 0..1");
    require(p.precip_factor >= 0.0 && p.precip_factor <= 100.0, "precip_factor", p.precip_factor,
            "in 0..100");
    check_horizon(p.horizon);
    check_events(p.events);
    require(p.canopy_vai >= 0.0 && p.canopy_vai <= 20.0, "canopy_vai", p.canopy_vai, "in 0..20");
    require(std::isnan(p.deep_temp_k) || (p.deep_temp_k > 200.0 && p.deep_temp_k < 330.0),
            "deep_temp_k", p.deep_temp_k, "in 200..330");
    const SnowParams& s = p.snow;
    require(s.max_layers >= 1 && s.max_layers <= 3, "snow.max_layers", s.max_layers, "1, 2 or 3");
    require(s.albedo_min >= 0.0 && s.albedo_min <= 1.0, "snow.albedo_min", s.albedo_min, "in 0..1");
    require(s.albedo_max >= s.albedo_min && s.albedo_max <= 1.0, "snow.albedo_max", s.albedo_max,
            "from albedo_min to 1");
    require(s.albedo_cold_h > 0.0, "snow.albedo_cold_h", s.albedo_cold_h, "above 0");
    require(s.albedo_melting_h > 0.0, "snow.albedo_melting_h", s.albedo_melting_h, "above 0");
    require(s.albedo_refresh_kg_m2 > 0.0, "snow.albedo_refresh_kg_m2", s.albedo_refresh_kg_m2,
            "above 0");
    require(s.irreducible_water >= 0.0 && s.irreducible_water < 1.0, "snow.irreducible_water",
            s.irreducible_water, "in [0, 1)");
    require(s.cover_depth_m > 0.0, "snow.cover_depth_m", s.cover_depth_m, "above 0");
    require(s.roughness_m >= 1e-6 && s.roughness_m <= 0.5, "snow.roughness_m", s.roughness_m,
            "in 1e-6..0.5");
    require(s.emissivity > 0.0 && s.emissivity <= 1.0, "snow.emissivity", s.emissivity,
            "in (0, 1]");
    require(s.new_density_factor > 0.0 && s.new_density_factor <= 5.0, "snow.new_density_factor",
            s.new_density_factor, "in (0, 5]");
    require(s.viscosity_pa_s >= 1e5 && s.viscosity_pa_s <= 1e10, "snow.viscosity_pa_s",
            s.viscosity_pa_s, "in 1e5..1e10");
    require(s.viscosity_density_m3_kg >= 0.0 && s.viscosity_density_m3_kg <= 0.1,
            "snow.viscosity_density_m3_kg", s.viscosity_density_m3_kg, "in 0..0.1");
    require(s.viscosity_wetness >= 0.0 && s.viscosity_wetness <= 1e4, "snow.viscosity_wetness",
            s.viscosity_wetness, "in 0..1e4");
    require(s.constant_density_kg_m3 >= 10.0 && s.constant_density_kg_m3 <= 900.0,
            "snow.constant_density_kg_m3", s.constant_density_kg_m3, "in 10..900");
    require(p.exchange.min_wind_m_s > 0.0 && p.exchange.min_wind_m_s < 50.0,
            "exchange.min_wind_m_s", p.exchange.min_wind_m_s, "above 0");
    require(p.exchange.max_unstable >= 1.0, "exchange.max_unstable", p.exchange.max_unstable,
            "1 or more");
    require(p.exchange.max_richardson >= 0.0, "exchange.max_richardson", p.exchange.max_richardson,
            "0 or more");
    require(p.exchange.rain_heat >= 0.0 && p.exchange.rain_heat <= 1.0, "exchange.rain_heat",
            p.exchange.rain_heat, "in 0..1");
    require(p.phase.all_rain_k > p.phase.all_snow_k, "phase.all_rain_k", p.phase.all_rain_k,
            "above phase.all_snow_k");
}

namespace {

// Only the columns that the model reads.
std::shared_ptr<const ForcingTable> needed_columns(const ForcingTable& table)
{
    const auto copy = std::make_shared<ForcingTable>();
    ForcingTable& out = *copy;
    out.site = table.site;
    out.time_us = table.time_us;
    for (const Field f :
         {Field::AirTemp, Field::RelHumidity, Field::Wind, Field::Pressure, Field::Shortwave,
          Field::Longwave, Field::NetShortwave, Field::Precip, Field::Rain, Field::Snow}) {
        out[f] = table[f];
    }
    return copy;
}

}  // namespace

struct PhysicalTimeline::Impl {
    std::shared_ptr<const ForcingTable> table;
    PhysicalParams params;
    detail::StepPlan plan;
    detail::CellConstants constants;
    detail::StepConstants step_constants;
    detail::StepConstants tail_constants;  // the last step may be shorter
    detail::CellPlace<double> place;
    detail::AdvanceCell advance_cell = detail::fastest_advance_cell();
    std::size_t first_step = 0;          // where the checkpoints begin
    std::vector<CellState> checkpoints;  // before steps first_step, first_step + 24, ..

    detail::StepWalk walk_from(std::size_t step) const
    {
        return {*table, plan, step, sun_use(), params.horizon};
    }
    detail::SunUse sun_use() const
    {
        return params.sky_view < 1.0 || !params.horizon.empty() ? detail::SunUse::Direction
                                                                : detail::SunUse::FlatOpenGround;
    }
    // Takes steps from .. to, which `walk` gives, with the events in them.
    void advance(CellState& cell, detail::StepWalk& walk, std::size_t from, std::size_t to) const
    {
        std::array<detail::StepForcing, kCheckpointEvery> steps;
        const std::size_t last = plan.count - 1;
        auto event = from < to ? first_event_after(plan.begin_of(from)) : params.events.end();
        for (std::size_t i = from; i < to;) {
            std::size_t end = i == last ? to : std::min({to, last, i + steps.size()});
            if (event != params.events.end()) end = std::min(end, step_before(event->time_us) + 1);
            for (std::size_t j = i; j < end; ++j) steps[j - i] = walk.next();
            advance_cell(cell, place, steps.data(), end - i, constants,
                         i == last ? tail_constants : step_constants);
            i = end;
            const std::int64_t now_us = i < plan.count ? plan.begin_of(i) : plan.end_us;
            for (; event != params.events.end() && event->time_us <= now_us; ++event)
                apply_event(cell, *event);
        }
    }
    std::vector<RoadEvent>::const_iterator first_event_after(std::int64_t time_us) const
    {
        return std::upper_bound(params.events.begin(), params.events.end(), time_us,
                                [](std::int64_t t, const RoadEvent& e) { return t < e.time_us; });
    }
    // The step at whose end an event happens: that which a time falls into, its end included.
    std::size_t step_before(std::int64_t time_us) const
    {
        return std::min(static_cast<std::size_t>((time_us - plan.begin_us - 1) / plan.length_us),
                        plan.count - 1);
    }
    // Index of the step that holds a time within the run.
    std::size_t step_of(std::int64_t time_us) const
    {
        return std::min(static_cast<std::size_t>((time_us - plan.begin_us) / plan.length_us),
                        plan.count - 1);
    }
    // The last checkpoint at or before a step.
    std::size_t checkpoint_before(std::size_t step) const
    {
        return std::min((step - first_step) / kCheckpointEvery, checkpoints.size() - 1);
    }
    std::size_t step_of_checkpoint(std::size_t point) const
    {
        return first_step + point * kCheckpointEvery;
    }

    void begin(std::shared_ptr<const ForcingTable> source, const PhysicalParams& wanted)
    {
        check_params(wanted);
        if (source->rows() == 0 || !source->has(Field::Longwave) || !source->has(Field::Precip)) {
            throw Error("physical model: the forcing table is not complete",
                        "Call fill_forcing on the table first.");
        }
        if (!wanted.horizon.empty() &&
            (std::isnan(source->site.latitude_deg) || std::isnan(source->site.longitude_deg))) {
            throw Error(
                "physical model: a horizon without a place: where the sun stands is not known",
                "Give latitude and longitude.");
        }
        table = std::move(source);
        params = wanted;
        const double deep = std::isnan(params.deep_temp_k)
                                ? kZeroCelsiusK + detail::yearly_wave(*table).mean_c
                                : params.deep_temp_k;
        constants = detail::make_cell_constants(params, table->site, deep);
        place = detail::station_place(params.sky_view * horizon_sky_view(params.horizon),
                                      params.precip_factor);
        plan = detail::make_step_plan(*table,
                                      static_cast<std::int64_t>(std::llround(params.step_s * 1e6)));
        const auto seconds = [&](std::size_t step) {
            return static_cast<double>(plan.length_of(step)) * 1e-6;
        };
        step_constants = detail::make_step_constants(constants, seconds(0), params.substep_s);
        tail_constants =
            detail::make_step_constants(constants, seconds(plan.count - 1), params.substep_s);
    }
    void run(CellState cell, std::size_t from)
    {
        first_step = from;
        // What is done at the very beginning belongs to no step.
        for (auto e = params.events.begin(); from == 0 && e != params.events.end(); ++e)
            if (e->time_us == plan.begin_us) apply_event(cell, *e);
        checkpoints.reserve((plan.count - from) / kCheckpointEvery + 1);
        auto walk = walk_from(from);
        for (std::size_t i = from; i < plan.count; i += kCheckpointEvery) {
            checkpoints.push_back(cell);
            advance(cell, walk, i, std::min(i + kCheckpointEvery, plan.count));
        }
        if ((plan.count - from) % kCheckpointEvery == 0) checkpoints.push_back(cell);
    }
    // The piece of step i up to a time inside it.
    void advance_partly(CellState& cell, std::size_t i, std::int64_t time_us) const
    {
        const std::int64_t begin_us = plan.begin_of(i);
        const auto piece = detail::make_step_forcing(*table, begin_us, time_us - begin_us,
                                                     sun_use(), params.horizon);
        advance_cell(cell, place, &piece, 1, constants,
                     detail::make_step_constants(constants, piece.dt_s, params.substep_s));
        for (auto e = first_event_after(begin_us);
             e != params.events.end() && e->time_us <= time_us; ++e)
            apply_event(cell, *e);
    }
};

PhysicalTimeline::PhysicalTimeline(const ForcingTable& table, const PhysicalParams& params)
    : PhysicalTimeline(needed_columns(table), params)
{
}

PhysicalTimeline::PhysicalTimeline(std::shared_ptr<const ForcingTable> table,
                                   const PhysicalParams& params)
    : impl_(std::make_unique<Impl>())
{
    impl_->begin(std::move(table), params);
    impl_->run(detail::initial_cell(*impl_->table, impl_->constants), 0);
}

PhysicalTimeline::PhysicalTimeline(const ForcingTable& table, const PhysicalParams& params,
                                   const CellState& state, std::int64_t at_us)
    : impl_(std::make_unique<Impl>())
{
    impl_->begin(needed_columns(table), params);
    const detail::StepPlan& plan = impl_->plan;
    const std::int64_t since = at_us - plan.begin_us;
    if (since < 0 || at_us > plan.end_us || (since % plan.length_us != 0 && at_us != plan.end_us)) {
        throw Error(
            "physical model: the saved state is not at a step of this run",
            "Continue with the same weather file and step, from a time at which a step begins.");
    }
    impl_->run(state, at_us == plan.end_us ? plan.count
                                           : static_cast<std::size_t>(since / plan.length_us));
}

PhysicalTimeline::PhysicalTimeline(PhysicalTimeline&&) noexcept = default;
PhysicalTimeline& PhysicalTimeline::operator=(PhysicalTimeline&&) noexcept = default;
PhysicalTimeline::~PhysicalTimeline() = default;

std::int64_t PhysicalTimeline::begin_us() const
{
    return steps() > 0 ? impl_->plan.begin_of(impl_->first_step) : impl_->plan.end_us;
}

std::int64_t PhysicalTimeline::end_us() const
{
    return impl_->plan.end_us;
}

std::size_t PhysicalTimeline::steps() const
{
    return impl_->plan.count - impl_->first_step;
}

CellState PhysicalTimeline::state_at(std::int64_t time_us) const
{
    if (time_us <= begin_us() || steps() == 0) return impl_->checkpoints.front();
    const bool whole = time_us >= end_us();
    const std::size_t target = whole ? impl_->plan.count : impl_->step_of(time_us);
    const std::size_t point = impl_->checkpoint_before(target);
    CellState cell = impl_->checkpoints[point];
    const std::size_t from = impl_->step_of_checkpoint(point);
    auto walk = impl_->walk_from(from);
    impl_->advance(cell, walk, from, target);
    if (!whole && time_us > impl_->plan.begin_of(target))
        impl_->advance_partly(cell, target, time_us);
    return cell;
}

std::vector<CellState> PhysicalTimeline::series(std::int64_t from_us, std::int64_t to_us,
                                                std::int64_t every_us) const
{
    if (every_us <= 0) {
        throw Error("physical model: the interval of a series must be above 0",
                    "Give --every a positive time.");
    }
    std::vector<CellState> out;
    if (to_us < from_us) return out;
    out.reserve(static_cast<std::size_t>((to_us - from_us) / every_us) + 1);
    // One walk through the steps; a time inside a step is a side branch.
    std::size_t at = impl_->first_step;
    CellState cell = impl_->checkpoints.front();
    auto walk = impl_->walk_from(at);
    for (std::int64_t t = from_us; t <= to_us; t += every_us) {
        if (t <= begin_us() || steps() == 0) {
            out.push_back(impl_->checkpoints.front());
            continue;
        }
        const bool whole = t >= end_us();
        const std::size_t target = whole ? impl_->plan.count : impl_->step_of(t);
        const std::size_t point = impl_->checkpoint_before(target);
        if (impl_->step_of_checkpoint(point) > at) {
            at = impl_->step_of_checkpoint(point);
            cell = impl_->checkpoints[point];
            walk = impl_->walk_from(at);
        }
        impl_->advance(cell, walk, at, std::max(at, target));
        at = std::max(at, target);
        out.push_back(cell);
        if (!whole && t > impl_->plan.begin_of(target))
            impl_->advance_partly(out.back(), target, t);
    }
    return out;
}

}  // namespace petrichor::weather
