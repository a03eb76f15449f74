#include "cli/texture/prefilter_timings.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <vector>

namespace petrichor::cli {

namespace {

// Bytes read and written a second by a plain copy of what does not fit a cache.
double copy_bandwidth()
{
    constexpr std::size_t kBytes = 64u << 20;
    std::vector<char> from(kBytes, 1), to(kBytes, 2);
    double least_ms = 1e9;
    for (int round = 0; round < 3; ++round) {
        from[static_cast<std::size_t>(round)] = 3;
        least_ms =
            std::min(least_ms, timed([&] { std::memcpy(to.data(), from.data(), kBytes); }).wall_ms);
    }
    return to[0] == 3 ? 2.0 * kBytes / (1e-3 * std::max(1e-3, least_ms)) : 0.0;
}

std::string line(const char* phase, const Cost& cost)
{
    char text[80];
    std::snprintf(text, sizeof text, "%-7s %7.2f CPU-s %7.2f s", phase, 1e-3 * cost.cpu_ms,
                  1e-3 * cost.wall_ms);
    return text;
}

}  // namespace

std::string to_text(const PrefilterTimings& t)
{
    const double seconds = std::max(1e-6, 1e-3 * t.kernel.wall_ms);
    const double moved = static_cast<double>(t.bytes) / seconds;
    const double copied = copy_bandwidth();
    char kernel[200];
    std::snprintf(
        kernel, sizeof kernel,
        ": %.1f Mtexel, %.0f CPU-ns each; %.2f GB/s of maps, %.1f %% of the %.1f GB/s that "
        "memory copies",
        1e-6 * static_cast<double>(t.texels),
        1e6 * t.kernel.cpu_ms / static_cast<double>(std::max<std::size_t>(1, t.texels)),
        1e-9 * moved, 100.0 * moved / std::max(1.0, copied), 1e-9 * copied);
    return line("read", t.read) + "\n" + line("kernel", t.kernel) + kernel + "\n" +
           line("write", t.write) + "\n";
}

}  // namespace petrichor::cli
