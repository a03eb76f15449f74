#ifndef PETRICHOR_GPU_OUTPUTS_AOV_TABLE_H
#define PETRICHOR_GPU_OUTPUTS_AOV_TABLE_H

#include <cstdint>
#include <string>
#include <vector>

namespace petrichor::gpu {

/// How finely an output is kept on disk.
enum class AovPrecision { HALF, FLOAT };

/// One output of the renderer besides the beauty. Labels come from the pixel-centre sample,
/// parts of the light are means over all of them.
struct AovInfo {
    std::string name;      ///< as in --aov
    std::string channels;  ///< EXR channel suffixes, "XYZ"
    std::string unit;      ///< "1" for shares and directions
    AovPrecision precision = AovPrecision::HALF;
    std::string meaning;
};

/// The rows of aov_table_io.h; behind them those of light_parts_io.h and the reflection label.
const std::vector<AovInfo>& aov_table();
/// How many of them are of the G-buffer.
std::size_t gbuffer_aov_count();

/// Row of an output. Throws Error with the names that exist.
std::size_t aov_row(const std::string& name);

}  // namespace petrichor::gpu

#endif
