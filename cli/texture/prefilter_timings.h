#ifndef PETRICHOR_CLI_TEXTURE_PREFILTER_TIMINGS_H
#define PETRICHOR_CLI_TEXTURE_PREFILTER_TIMINGS_H

#include <cstddef>
#include <string>

#include "cli/bench/measure.h"

namespace petrichor::cli {

/// Where a prefilter run spent its time. The decoding process counts in wall time only.
struct PrefilterTimings {
    Cost read, kernel, write;
    std::size_t texels = 0;  ///< of level 0
    std::size_t bytes = 0;   ///< maps read and levels made: what any kernel must move at least
};

/// A line a phase; the kernel's beside what this machine copies in memory (measured here, 64 MiB,
/// best of three, one thread).
std::string to_text(const PrefilterTimings& timings);

}  // namespace petrichor::cli

#endif
