#include "gpu/place/place_parts.h"

#include <algorithm>
#include <cassert>

namespace petrichor::gpu {
namespace {

constexpr std::size_t kRows = 2;          // of the table, for the parts of a patch
constexpr std::size_t kCellsAWord = 16;   // two bits each

}  // namespace

void append_parts(std::vector<glm::uvec4>& table, const PlaceParts& parts)
{
    assert(parts.count >= 1 && parts.count <= kMostParts);
    glm::uvec4 cells(0);
    for (std::size_t k = 0; k < parts.of_cell.size(); ++k)
        cells[static_cast<int>(k / kCellsAWord)] |= std::uint32_t{parts.of_cell[k]} << (2 * (k % kCellsAWord));
    table.emplace_back(parts.patch, parts.first, parts.count, 0);
    table.push_back(cells);
}

std::vector<PlaceParts> parts_of(std::span<const glm::uvec4> table, const shared::PatchGrid& grid)
{
    std::vector<PlaceParts> all;
    for (std::size_t row = std::size_t{grid.table_mask} + 1; row + kRows <= table.size(); row += kRows) {
        PlaceParts parts{table[row].x, table[row].y, table[row].z, {}};
        for (std::size_t k = 0; k < parts.of_cell.size(); ++k)
            parts.of_cell[k] = static_cast<std::uint8_t>(
                table[row + 1][static_cast<int>(k / kCellsAWord)] >> (2 * (k % kCellsAWord)) & 3u);
        all.push_back(parts);
    }
    return all;
}

std::uint32_t count_of_parts(std::span<const PlaceParts> all)
{
    std::uint32_t count = 0;
    for (const PlaceParts& parts : all) count = std::max(count, parts.first + parts.count);
    return count;
}

}  // namespace petrichor::gpu
