#include "weather/physics/cell_state.h"

#include <bit>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "base/error.h"
#include "weather/physics/constants.h"
#include "weather/physics/detail/slush_kernel.h"

namespace petrichor::weather {

namespace {

constexpr const char* kHeader = "petrichor-cell-3";

std::uint64_t fnv(std::uint64_t hash, const CellState& state)
{
    double numbers[kCellNumbers];
    std::memcpy(numbers, &state, sizeof state);
    for (const double number : numbers) {
        // -0.0 and 0.0 are the same state.
        auto bits = std::bit_cast<std::uint64_t>(number + 0.0);
        for (int i = 0; i < 8; ++i) {
            hash = (hash ^ (bits & 0xff)) * 1099511628211ull;
            bits >>= 8;
        }
    }
    return hash;
}

}  // namespace

CellDiagnostics diagnostics(const CellState& c)
{
    CellDiagnostics d;
    double heat = 0.0, ice = 0.0;
    for (std::size_t i = 0; i < kSnowLayers; ++i) {
        d.snow_depth_m += c.snow_thickness[i];
        ice += c.snow_ice[i];
        d.snow_liquid_kg_m2 += c.snow_liquid[i];
        heat += c.snow_ice[i] * c.snow_temp_c[i];
    }
    d.swe_kg_m2 = ice + d.snow_liquid_kg_m2;
    if (d.snow_depth_m > 0.0) d.snow_density_kg_m3 = d.swe_kg_m2 / d.snow_depth_m;
    d.snow_temp_k = kZeroCelsiusK + (ice > 0.0 ? heat / ice : 0.0);
    d.surface_water_kg_m2 = c.film + c.crack + c.puddle;
    d.surface_ice_kg_m2 = c.film_ice + c.crack_ice + c.puddle_ice;
    return d;
}

Cover cover_of(const CellState& c, double film_capacity_kg_m2)
{
    const double ice = c.snow_ice[0] + c.snow_ice[1] + c.snow_ice[2];
    if (!(ice > 0.0)) return Cover::Bare;
    if (c.film > detail::slush_limit(c)) return Cover::Water;
    return c.film - film_capacity_kg_m2 >= kSlushWater_kg_m2 ? Cover::Slush : Cover::Snow;
}

double stored_mass_kg_m2(const CellState& c)
{
    const CellDiagnostics d = diagnostics(c);
    return d.swe_kg_m2 + d.surface_water_kg_m2 + d.surface_ice_kg_m2 + c.canopy_snow;
}

double mass_balance_kg_m2(const CellState& c, const CellState& initial)
{
    const auto net = [](const CellState& s) {
        return s.total_precip - s.total_evaporation - s.total_sublimation - s.total_drainage -
               s.total_infiltration;
    };
    return (stored_mass_kg_m2(c) - stored_mass_kg_m2(initial)) - (net(c) - net(initial));
}

double energy_residual_rms_w_m2(const CellState& c)
{
    return c.energy_seconds > 0.0 ? std::sqrt(c.energy_residual_squares / c.energy_seconds) : 0.0;
}

std::uint64_t state_hash(const CellState& state)
{
    return fnv(14695981039346656037ull, state);
}

std::uint64_t state_hash(const std::vector<CellState>& states)
{
    std::uint64_t hash = 14695981039346656037ull;
    for (const CellState& state : states) hash = fnv(hash, state);
    return hash;
}

std::string hash_text(std::uint64_t hash)
{
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
    return text;
}

std::string save_state(const CellState& state)
{
    double numbers[kCellNumbers];
    std::memcpy(numbers, &state, sizeof state);
    std::string text = kHeader;
    for (const double number : numbers) {
        text += ' ';
        text += hash_text(std::bit_cast<std::uint64_t>(number));
    }
    return text + " " + hash_text(state_hash(state)) + "\n";
}

CellState load_state(std::string_view text)
{
    const auto refuse = [](const char* why) -> Error {
        return {std::string("state: ") + why,
                "Use a file that --save-state of this version wrote."};
    };
    std::size_t at = std::strlen(kHeader);
    if (text.substr(0, at) != kHeader)
        throw refuse("the text does not begin with petrichor-cell-3");
    double numbers[kCellNumbers + 1];
    for (double& number : numbers) {
        if (at + 17 > text.size() || text[at] != ' ') throw refuse("the text is cut short");
        std::uint64_t bits = 0;
        for (std::size_t i = 1; i <= 16; ++i) {
            const char c = text[at + i];
            int digit = -1;
            if (c >= '0' && c <= '9') digit = c - '0';
            if (c >= 'a' && c <= 'f') digit = c - 'a' + 10;
            if (digit < 0) throw refuse("there is a character that is not a hexadecimal digit");
            bits = bits << 4 | static_cast<std::uint64_t>(digit);
        }
        number = std::bit_cast<double>(bits);
        at += 17;
    }
    CellState state;
    std::memcpy(&state, numbers, sizeof state);
    for (std::size_t i = 0; i < kCellNumbers; ++i) {
        if (!std::isfinite(numbers[i])) throw refuse("a number is not finite");
    }
    if (state_hash(state) != std::bit_cast<std::uint64_t>(numbers[kCellNumbers]))
        throw refuse("the hash does not match");
    return state;
}

}  // namespace petrichor::weather
