#include "weather/patches/patch_weather.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <utility>

#include "base/error.h"
#include "weather/models/physical/detail/parameter_hash.h"
#include "weather/models/physical/physical_grid.h"
#include "weather/patches/detail/patch_steps.h"

namespace petrichor::weather {

namespace {

using detail::PatchLive;
using detail::PatchTables;

constexpr std::size_t kMostCheckpoints = 6;
constexpr std::size_t kCheckpointEvery = 24;  // steps, at first; doubled when there are too many
constexpr double kBare_kg_m2 = 0.01;          // of snow: nothing
constexpr double kDarkSky = 0.2;              // of the scout in the yard
constexpr std::uint64_t kMagic = 0x3443544150525450ull;  // "PTRPATC4"

void check(const PatchParams& p)
{
    const auto require = [](bool good, const char* name, double found, const char* accepted) {
        if (good) return;
        throw Error(std::string("weather of patches: ") + name + " must be " + accepted + ", got " +
                        std::to_string(found),
                    std::string("Set ") + name + " to a value in the accepted range.");
    };
    require(std::isfinite(p.north_deg), "north_deg", p.north_deg, "finite");
    require(p.spin_up_days >= 0.0 && p.spin_up_days <= 3660.0, "spin_up_days", p.spin_up_days,
            "in 0..3660");
    require(std::isfinite(p.wind_from_deg), "wind_from_deg", p.wind_from_deg, "finite");
    require(p.room_temp_k >= 180.0 && p.room_temp_k <= 350.0, "room_temp_k", p.room_temp_k,
            "in 180..350");
    require(p.outside_albedo >= 0.0 && p.outside_albedo <= 1.0, "outside_albedo", p.outside_albedo,
            "in 0..1");
    require(p.outside_snow_albedo >= 0.0 && p.outside_snow_albedo <= 1.0, "outside_snow_albedo",
            p.outside_snow_albedo, "in 0..1");
    require(p.threads >= 1 && p.threads <= 1024, "threads", p.threads, "in 1..1024");
}

// The last step before `until` at which nothing lay in the open nor in a yard without sun; `until`
// itself where nothing lies then, 0 where something always did.
std::size_t last_bare_step(const ForcingTable& table, const PatchParams& params,
                           const Surface& surface, std::size_t until)
{
    if (until == 0) return 0;
    GridParams grid{params.model, {surface}, 1};
    grid.model.canopy_vai = 0.0;
    const double at_m = std::isnan(table.site.elevation_m) ? 0.0 : table.site.elevation_m;
    GridCell cells[2];
    cells[0].elevation_m = cells[1].elevation_m = at_m;
    cells[1].sky_view = kDarkSky;
    cells[1].shortwave_factor = 0.0;
    PhysicalGrid scouts(table, grid, cells);
    std::size_t bare = 0;
    for (std::size_t step = 1; step <= until; ++step) {
        scouts.advance(1);
        const bool covered = diagnostics(scouts.state(0)).swe_kg_m2 > kBare_kg_m2 ||
                             diagnostics(scouts.state(1)).swe_kg_m2 > kBare_kg_m2;
        if (!covered) bare = step;
    }
    return bare;
}

void append(std::vector<std::byte>& to, const void* from, std::size_t bytes)
{
    const std::size_t end = to.size();
    to.resize(end + bytes);
    if (bytes > 0) std::memcpy(to.data() + end, from, bytes);
}
template <class T>
void append_row(std::vector<std::byte>& to, const std::vector<T>& row)
{
    append(to, row.data(), row.size() * sizeof(T));
}

class Bytes {
public:
    explicit Bytes(std::span<const std::byte> all) : left_(all) {}
    void take(void* to, std::size_t bytes)
    {
        if (bytes > left_.size()) {
            throw Error("weather of patches: the saved state is too short",
                        "Save it again with this scene and weather file.");
        }
        std::memcpy(to, left_.data(), bytes);
        left_ = left_.subspan(bytes);
    }
    template <class T>
    void take_row(std::vector<T>& row)
    {
        take(row.data(), row.size() * sizeof(T));
    }
    bool empty() const { return left_.empty(); }

private:
    std::span<const std::byte> left_;
};

}  // namespace

struct PatchWeather::Impl {
    ForcingTable table;
    PatchParams params;
    Ponds ponds;
    PatchTables tables;
    detail::StepPlan plan;
    detail::GroupSteps whole, tail;
    std::size_t first_step = 0;
    PatchLive initial;
    double initially_kg = 0.0;
    std::map<std::size_t, PatchLive> checkpoints;  // by step
    std::size_t every = kCheckpointEvery;
    PatchLive live;  // at the beginning of `step`
    std::size_t step = 0;
    PatchLive moment;  // at time_us
    std::int64_t time_us = 0;
    detail::PatchScratch scratch;
    std::uint64_t identity = 0;

    Impl(ForcingTable source, PatchSet set, const PatchParams& wanted, Ponds pond_shapes)
        : table(std::move(source)),
          params(wanted),
          ponds(std::move(pond_shapes)),
          tables(make_tables(table, std::move(set), params)),
          plan(detail::make_step_plan(
              table, static_cast<std::int64_t>(std::llround(params.model.step_s * 1e6)))),
          whole(detail::make_group_steps(tables, seconds(0), params.model.substep_s)),
          tail(detail::make_group_steps(tables, seconds(plan.count - 1), params.model.substep_s)),
          scratch(tables)
    {
        detail::ParameterHash hash;
        for (const WeatherPatch& p : tables.set.patches) {
            hash.add(p.normal.x, p.normal.y, p.normal.z, p.area_m2, p.height_m,
                     static_cast<double>(p.kind), p.sky_share, p.patch_share,
                     static_cast<double>(p.runs_to));
        }
        hash.add(static_cast<double>(plan.begin_us), static_cast<double>(plan.end_us),
                 params.north_deg, static_cast<double>(tables.set.links.size()));
        for (const auto& around : tables.set.upwind)
            for (const Upwind& one : around)
                hash.add(static_cast<double>(one.distance_m), static_cast<double>(one.height_m));
        for (const double t : table[Field::AirTemp]) hash.add(t);
        for (const PatchTap& tap : params.taps) {
            hash.add(tap.flow_kg_s, tap.temp_k, static_cast<double>(tap.from_us),
                     static_cast<double>(tap.to_us));
            for (const TapStretch& stretch : tap.stretches) {
                hash.add(static_cast<double>(stretch.runs_to), stretch.spill_m);
                for (const std::uint32_t patch : stretch.way) hash.add(static_cast<double>(patch));
            }
        }
        identity = hash.value();
    }

    static PatchTables make_tables(const ForcingTable& table, PatchSet set, const PatchParams& p)
    {
        check(p);
        check_patches(set);
        check_taps(p.taps, set);
        if (table.rows() == 0 || !table.has(Field::Longwave) || !table.has(Field::Precip)) {
            throw Error("weather of patches: the forcing table is not complete",
                        "Call fill_forcing on the table first.");
        }
        const double deep = std::isnan(p.model.deep_temp_k)
                                ? kZeroCelsiusK + detail::yearly_wave(table).mean_c
                                : p.model.deep_temp_k;
        return detail::make_patch_tables(std::move(set), p, table.site, deep);
    }

    double seconds(std::size_t i) const { return static_cast<double>(plan.length_of(i)) * 1e-6; }

    std::size_t step_of(std::int64_t us) const
    {
        if (us <= plan.begin_us) return 0;
        return std::min(static_cast<std::size_t>((us - plan.begin_us) / plan.length_us),
                        plan.count);
    }

    void begin(std::int64_t from_us)
    {
        const std::size_t wanted = step_of(from_us);
        const Surface& ground = tables.kind_of(tables.twin).surface;
        const std::size_t bare = last_bare_step(table, params, ground, wanted);
        const auto spin = static_cast<std::size_t>(
            std::llround(params.spin_up_days * 86400.0 / params.model.step_s));
        first_step = bare > spin ? bare - spin : 0;
        const std::int64_t at_us = plan.begin_of(first_step);
        initial.blocks.resize(tables.blocks());
        std::vector<CellState> start;
        for (const detail::PatchGroup& group : tables.groups)
            start.push_back(tables.set.kinds[group.kind].room_behind
                                ? detail::initial_wall(table, group.constants, at_us)
                                : detail::initial_cell(table, group.constants, at_us));
        for (std::size_t b = 0; b < tables.blocks(); ++b)
            for (std::size_t lane = 0; lane < detail::kPatchLanes; ++lane)
                detail::put_cell(initial.blocks[b], lane, start[tables.group_of_block[b]]);
        const double air_k = value_at(table, Field::AirTemp, at_us);
        initial.radiosity.assign(tables.slots(), kStefanBoltzmann * air_k * air_k * air_k * air_k);
        initial.hoar.assign(tables.slots(), 0.0);
        initial.slid_hours.assign(tables.slots(), 0.0);
        initial.pond_m3 = ponds.volume_m3;
        initial.pond_heat_j_kg.assign(tables.set.ponds, 0.0);
        for (auto* row : {&initial.run_on_kg_m2_s, &initial.rain_share, &initial.wind_factor,
                          &initial.shortwave_w_m2, &initial.longwave_w_m2})
            row->assign(tables.slots(), 0.0f);
        live = initial;
        step = first_step;
        initially_kg = stored_kg(initial) + ponds_kg(initial);
        advance_to(wanted);
        checkpoints[step] = live;
    }

    void advance_to(std::size_t target)
    {
        for (; step < target; ++step) {
            const auto sky = detail::make_sky_step(table, params, plan.begin_of(step),
                                                   plan.length_of(step), false);
            detail::advance_patches(live, tables, sky, step + 1 == plan.count ? tail : whole,
                                    params, ponds, scratch);
        }
    }

    // The last state at or before a step.
    void rewind_to(std::size_t target)
    {
        auto after = checkpoints.upper_bound(target);
        const bool none = after == checkpoints.begin();
        const std::size_t at = none ? first_step : std::prev(after)->first;
        if (step <= target && step >= at) return;
        live = none ? initial : std::prev(after)->second;
        step = at;
    }

    void keep_checkpoint()
    {
        if (step <= checkpoints.rbegin()->first || step % every != 0) return;
        checkpoints[step] = live;
        if (checkpoints.size() <= kMostCheckpoints) return;
        every *= 2;
        // The first one stays: it is where the moments begin.
        for (auto it = std::next(checkpoints.begin()); it != checkpoints.end();)
            it = it->first % every == 0 ? std::next(it) : checkpoints.erase(it);
    }

    void go_to(std::int64_t us)
    {
        const std::size_t target = std::max(step_of(us), first_step);
        rewind_to(target);
        while (step < target) {
            advance_to(std::min(target, (step / every + 1) * every));
            keep_checkpoint();
        }
        moment = live;
        const std::int64_t begin_us = plan.begin_of(target);
        time_us = std::clamp(us, plan.begin_of(first_step), plan.end_us);
        if (target == plan.count || time_us <= begin_us) {
            show_shares();
            return;
        }
        const auto sky = detail::make_sky_step(table, params, begin_us, time_us - begin_us, true);
        const auto piece =
            detail::make_group_steps(tables, sky.forcing.dt_s, params.model.substep_s);
        detail::advance_patches(moment, tables, sky, piece, params, ponds, scratch);
    }

    // At the very beginning of a step nothing runs: what the weather then is, without its effect.
    void show_shares()
    {
        const std::size_t at = std::min(step, plan.count - 1);
        const auto sky =
            detail::make_sky_step(table, params, plan.begin_of(at), plan.length_of(at), true);
        PatchLive probe = moment;
        detail::advance_patches(probe, tables, sky, at + 1 == plan.count ? tail : whole, params,
                                ponds, scratch);
        moment.rain_share = probe.rain_share;
        moment.wind_factor = probe.wind_factor;
        moment.shortwave_w_m2 = probe.shortwave_w_m2;
        moment.longwave_w_m2 = probe.longwave_w_m2;
    }

    double ponds_kg(const PatchLive& at) const
    {
        return ponds.stored_m3 ? ponds.stored_m3(at.pond_m3) * 1e3 : 0.0;
    }
    double stored_kg(const PatchLive& at) const
    {
        double sum = 0.0;
        for (std::size_t i = 0; i < tables.twin; ++i)
            sum += stored_mass_kg_m2(cell(at, i)) * tables.set.patches[i].area_m2;
        return sum;
    }
    CellState cell(const PatchLive& at, std::size_t patch) const
    {
        const std::size_t slot = tables.slot_of_patch[patch];
        return detail::cell_in(at.blocks[slot / detail::kPatchLanes], slot % detail::kPatchLanes);
    }
};

PatchWeather::PatchWeather(ForcingTable table, PatchSet set, const PatchParams& params,
                           std::int64_t from_us, Ponds ponds)
    : impl_(std::make_unique<Impl>(std::move(table), std::move(set), params, std::move(ponds)))
{
    impl_->begin(from_us);
    impl_->go_to(from_us);
}

PatchWeather::PatchWeather(PatchWeather&&) noexcept = default;
PatchWeather& PatchWeather::operator=(PatchWeather&&) noexcept = default;
PatchWeather::~PatchWeather() = default;

std::size_t PatchWeather::patches() const
{
    return impl_->tables.twin;
}
std::int64_t PatchWeather::begin_us() const
{
    return impl_->plan.begin_of(impl_->first_step);
}
std::int64_t PatchWeather::end_us() const
{
    return impl_->plan.end_us;
}

void PatchWeather::go_to(std::int64_t utc_us)
{
    impl_->go_to(utc_us);
}

PatchState PatchWeather::state(std::size_t patch) const
{
    const PatchLive& at = impl_->moment;
    const std::size_t slot = impl_->tables.slot_of_patch[patch];
    PatchState out;
    out.cell = impl_->cell(at, patch);
    out.hoar_kg_m2 = at.hoar[slot];
    out.run_on_kg_m2_s = static_cast<double>(at.run_on_kg_m2_s[slot]);
    out.rain_share = static_cast<double>(at.rain_share[slot]);
    out.wind_factor = static_cast<double>(at.wind_factor[slot]);
    out.shortwave_w_m2 = static_cast<double>(at.shortwave_w_m2[slot]);
    out.longwave_w_m2 = static_cast<double>(at.longwave_w_m2[slot]);
    return out;
}

PatchState PatchWeather::open() const
{
    return state(impl_->tables.twin);
}

std::uint32_t PatchWeather::open_kind() const
{
    return impl_->tables.set.patches[impl_->tables.twin].kind;
}

std::span<const double> PatchWeather::pond_volumes_m3() const
{
    return impl_->moment.pond_m3;
}

std::span<const double> PatchWeather::pond_heat_j_kg() const
{
    return impl_->moment.pond_heat_j_kg;
}

PatchLedger PatchWeather::ledger() const
{
    const Impl& m = *impl_;
    PatchLedger books;
    books.initially = m.initially_kg;
    books.stored = m.stored_kg(m.moment);
    books.in_ponds = m.ponds_kg(m.moment);
    books.out = m.moment.out_kg;
    books.let_in = m.moment.let_in_kg;
    books.tap_heat = m.moment.tap_heat;
    books.lost_from_ponds = m.moment.pond_lost_kg;
    for (std::size_t i = 0; i < m.tables.twin; ++i) {
        const CellState c = m.cell(m.moment, i);
        const double area = m.tables.set.patches[i].area_m2;
        books.fallen += c.total_precip * area;
        books.evaporated += c.total_evaporation * area;
        books.sublimated += c.total_sublimation * area;
        books.soaked += c.total_infiltration * area;
    }
    return books;
}

std::uint64_t PatchWeather::hash() const
{
    const Impl& m = *impl_;
    detail::ParameterHash hash;
    for (std::size_t i = 0; i < m.tables.twin; ++i) {
        const CellState c = m.cell(m.moment, i);
        double numbers[kCellNumbers];
        std::memcpy(numbers, &c, sizeof c);
        for (const double n : numbers) hash.add(n);
        hash.add(m.moment.hoar[m.tables.slot_of_patch[i]]);
        hash.add(m.moment.slid_hours[m.tables.slot_of_patch[i]]);
        hash.add(m.moment.radiosity[m.tables.slot_of_patch[i]]);
    }
    for (const double v : m.moment.pond_m3) hash.add(v);
    for (const double v : m.moment.pond_heat_j_kg) hash.add(v);
    hash.add(m.moment.out_kg, m.moment.pond_lost_kg, m.moment.let_in_kg);
    return hash.value();
}

std::vector<std::byte> PatchWeather::save() const
{
    const Impl& m = *impl_;
    std::vector<std::byte> out;
    const std::uint64_t head[] = {kMagic, m.identity, m.step,
                                  static_cast<std::uint64_t>(m.time_us)};
    append(out, head, sizeof head);
    const double books[] = {m.live.out_kg, m.live.pond_lost_kg, m.live.let_in_kg, m.initially_kg};
    append(out, books, sizeof books);
    append(out, &m.live.tap_heat, sizeof m.live.tap_heat);
    append_row(out, m.live.blocks);
    append_row(out, m.live.radiosity);
    append_row(out, m.live.hoar);
    append_row(out, m.live.slid_hours);
    append_row(out, m.live.pond_m3);
    append_row(out, m.live.pond_heat_j_kg);
    append_row(out, m.live.run_on_kg_m2_s);
    return out;
}

void PatchWeather::restore(std::span<const std::byte> saved)
{
    Impl& m = *impl_;
    Bytes bytes(saved);
    std::uint64_t head[4];
    bytes.take(head, sizeof head);
    if (head[0] != kMagic || head[1] != m.identity || head[2] > m.plan.count) {
        throw Error("weather of patches: the saved state is of another scene or weather file",
                    "Continue with the scene and the weather file that it was saved with.");
    }
    PatchLive live = m.initial;
    double books[4];
    bytes.take(books, sizeof books);
    live.out_kg = books[0];
    live.pond_lost_kg = books[1];
    live.let_in_kg = books[2];
    bytes.take(&live.tap_heat, sizeof live.tap_heat);
    bytes.take_row(live.blocks);
    bytes.take_row(live.radiosity);
    bytes.take_row(live.hoar);
    bytes.take_row(live.slid_hours);
    bytes.take_row(live.pond_m3);
    bytes.take_row(live.pond_heat_j_kg);
    bytes.take_row(live.run_on_kg_m2_s);
    if (!bytes.empty()) {
        throw Error("weather of patches: the saved state is too long",
                    "Save it again with this scene and weather file.");
    }
    m.live = std::move(live);
    m.step = static_cast<std::size_t>(head[2]);
    m.initially_kg = books[3];
    m.checkpoints.clear();
    m.checkpoints[m.step] = m.live;
    m.every = kCheckpointEvery;
    m.go_to(static_cast<std::int64_t>(head[3]));
}

}  // namespace petrichor::weather
