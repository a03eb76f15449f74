#include "cli/simulate/grid_progress.h"

#include <bit>

#include "base/error.h"

namespace petrichor::cli {

std::string save_progress(const weather::PhysicalGrid& grid, const weather::RunIdentity& identity,
                          const GridProgress& progress)
{
    std::string bytes = weather::save_grid(grid, identity);
    weather::put_number(bytes, std::bit_cast<std::uint64_t>(progress.every_s));
    weather::put_number(bytes, progress.rows.size());
    weather::put_number(bytes, progress.rows.empty() ? 0 : progress.rows.front().size());
    for (const auto& row : progress.rows) {
        for (const double v : row) weather::put_number(bytes, std::bit_cast<std::uint64_t>(v));
    }
    return bytes;
}

GridProgress load_progress(weather::PhysicalGrid& grid, const weather::RunIdentity& identity,
                           double every_s, std::size_t columns, std::string_view bytes)
{
    bytes.remove_prefix(weather::load_grid(grid, identity, bytes));
    GridProgress progress{.every_s = std::bit_cast<double>(weather::take_number(bytes)),
                          .rows = {}};
    const std::uint64_t rows = weather::take_number(bytes), width = weather::take_number(bytes);
    if (progress.every_s != every_s) {
        throw Error("grid: this checkpoint has rows every " + std::to_string(progress.every_s) +
                        " s, not every " + std::to_string(every_s) + " s",
                    "Resume with the --every of the first run.");
    }
    if ((rows > 0 && width != columns) || bytes.size() / 8 / columns < rows) {
        throw Error(
            "grid: this checkpoint cannot be used: its rows are cut short or of another version",
            "Give a file that --checkpoint wrote.");
    }
    progress.rows.resize(rows);
    for (auto& row : progress.rows) {
        row.resize(columns);
        for (double& v : row) v = std::bit_cast<double>(weather::take_number(bytes));
    }
    return progress;
}

}  // namespace petrichor::cli
