#include "weather/models/physical/physical_grid_checkpoint.h"

#include <bit>
#include <cstring>

#include "base/error.h"

namespace petrichor::weather {

namespace {

constexpr std::string_view kHeader = "petrichor-grid-2\n";

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

std::string save_grid(const PhysicalGrid& grid, const RunIdentity& identity)
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

std::size_t load_grid(PhysicalGrid& grid, const RunIdentity& identity, std::string_view bytes)
{
    if (bytes.substr(0, kHeader.size()) != kHeader)
        throw refused("it is no checkpoint of a grid of this version");
    std::string_view rest = bytes.substr(kHeader.size());
    const RunIdentity saved{take_number(rest), take_number(rest), take_number(rest)};
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
