#include "weather/physical_grid_checkpoint.h"

#include <bit>
#include <cstring>

#include "base/error.h"

namespace petrichor::weather {

namespace {

constexpr std::string_view kHeader = "petrichor-grid-1\n";

// FNV-1a over numbers; -0 and 0 differ, as their bits do.
class Hash {
public:
    void add(std::uint64_t bits)
    {
        for (int i = 0; i < 8; ++i) {
            value_ ^= (bits >> (8 * i)) & 0xffu;
            value_ *= 1099511628211u;
        }
    }
    void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }
    void add(const std::vector<double>& numbers)
    {
        add(std::uint64_t{numbers.size()});
        for (const double number : numbers) add(number);
    }
    template <class... Numbers>
    void add_all(Numbers... numbers)
    {
        (add(static_cast<double>(numbers)), ...);
    }
    std::uint64_t value() const { return value_; }

private:
    std::uint64_t value_ = 14695981039346656037u;
};

std::uint64_t hash_of_weather(const ForcingTable& table)
{
    Hash hash;
    for (const std::int64_t us : table.time_us) hash.add(static_cast<std::uint64_t>(us));
    for (const auto& column : table.columns) hash.add(column);
    const Site& site = table.site;
    hash.add_all(site.latitude_deg, site.longitude_deg, site.elevation_m, site.temp_height_m,
                 site.wind_height_m);
    return hash.value();
}

std::uint64_t hash_of_ground(const std::vector<Surface>& surfaces, std::span<const GridCell> cells)
{
    Hash hash;
    for (const Surface& s : surfaces) {
        hash.add_all(s.albedo_dry, s.albedo_wet, s.emissivity, s.roughness_m, s.film_capacity_kg_m2,
                     s.film_rate_1_s, s.conductivity_w_m_k, s.heat_capacity_j_m3_k,
                     s.traffic_loss_1_h, s.traffic_wind_m_s);
        hash.add_all(s.infiltration.first_mm_h, s.infiltration.last_mm_h, s.infiltration.decay_1_h,
                     s.infiltration.recovery_1_h);
        for (const Hypsometry* store : {&s.cracks, &s.puddles}) {
            hash.add(store->depth_mm);
            hash.add(store->area_fraction);
            hash.add(store->volume_mm);
        }
    }
    for (const GridCell& c : cells) {
        hash.add_all(c.elevation_m, c.slope_rad, c.aspect_rad, c.sky_view, c.precip_factor,
                     c.surface, c.air_offset_k, c.wind_factor, c.shortwave_factor,
                     c.longwave_offset_w_m2);
    }
    return hash.value();
}

std::uint64_t hash_of_model(const PhysicalParams& p)
{
    Hash hash;
    hash.add_all(p.step_s, p.substep_s, p.deep_temp_k, p.sky_view, p.precip_factor, p.canopy_vai);
    const SnowParams& s = p.snow;
    hash.add_all(s.max_layers, static_cast<int>(s.new_density), s.constant_density_kg_m3,
                 static_cast<int>(s.settling), s.albedo_max, s.albedo_min, s.albedo_cold_h,
                 s.albedo_melting_h, s.albedo_refresh_kg_m2, s.irreducible_water, s.cover_depth_m,
                 s.roughness_m, s.emissivity);
    hash.add_all(static_cast<int>(p.exchange.stability), p.exchange.max_richardson,
                 p.exchange.min_wind_m_s);
    hash.add_all(static_cast<int>(p.phase.law), p.phase.all_snow_k, p.phase.all_rain_k,
                 p.phase.threshold_k);
    return hash.value();
}

Error refused(const std::string& why, const char* fix = "Give a file that --checkpoint wrote.")
{
    return {"grid: this checkpoint cannot be used: " + why, fix};
}

}  // namespace

void put_number(std::string& bytes, std::uint64_t number)
{
    for (int i = 0; i < 8; ++i) bytes += static_cast<char>(number >> (8 * i) & 0xffu);
}

std::uint64_t take_number(std::string_view& bytes)
{
    if (bytes.size() < 8) throw refused("it is cut short");
    std::uint64_t number = 0;
    for (unsigned i = 0; i < 8; ++i)
        number |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[i])) << (8 * i);
    bytes.remove_prefix(8);
    return number;
}

GridIdentity grid_identity(const ForcingTable& table, const GridParams& params,
                           std::span<const GridCell> cells)
{
    return {hash_of_weather(table), hash_of_ground(params.surfaces, cells),
            hash_of_model(params.model)};
}

std::string save_grid(const PhysicalGrid& grid, const GridIdentity& identity)
{
    const std::vector<CellState> states = grid.save();
    std::string bytes(kHeader);
    bytes.reserve(kHeader.size() + states.size() * sizeof(CellState) + 64);
    for (const std::uint64_t number :
         {identity.weather, identity.ground, identity.model, std::uint64_t{kCellNumbers},
          std::uint64_t{states.size()}, std::uint64_t{grid.step()}})
        put_number(bytes, number);
    for (const CellState& state : states) {
        double numbers[kCellNumbers];
        std::memcpy(numbers, &state, sizeof state);
        for (const double number : numbers) put_number(bytes, std::bit_cast<std::uint64_t>(number));
    }
    put_number(bytes, state_hash(states));
    return bytes;
}

std::size_t load_grid(PhysicalGrid& grid, const GridIdentity& identity, std::string_view bytes)
{
    if (bytes.substr(0, kHeader.size()) != kHeader)
        throw refused("it is no checkpoint of a grid of this version");
    std::string_view rest = bytes.substr(kHeader.size());
    const GridIdentity saved{take_number(rest), take_number(rest), take_number(rest)};
    const char* again = "Resume with the weather files, terrain and options of the first run.";
    if (saved.weather != identity.weather)
        throw refused("it belongs to other weather or another site", again);
    if (saved.ground != identity.ground)
        throw refused("it belongs to another terrain or other surfaces", again);
    if (saved.model != identity.model)
        throw refused("it belongs to another --phase, --dt or other parameters", again);
    const std::uint64_t numbers_a_cell = take_number(rest), cells = take_number(rest),
                        step = take_number(rest);
    if (numbers_a_cell != kCellNumbers || cells != grid.cells() || step > grid.steps())
        throw refused("its states have another shape than those of this version");
    if (rest.size() / sizeof(CellState) < cells) throw refused("it is cut short");
    std::vector<CellState> states(cells);
    for (CellState& state : states) {
        double numbers[kCellNumbers];
        for (double& number : numbers) number = std::bit_cast<double>(take_number(rest));
        std::memcpy(&state, numbers, sizeof state);
    }
    if (take_number(rest) != state_hash(states)) throw refused("it is damaged");
    grid.restore(states, static_cast<std::size_t>(step));
    return bytes.size() - rest.size();
}

}  // namespace petrichor::weather
