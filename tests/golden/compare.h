#ifndef PETRICHOR_TESTS_GOLDEN_COMPARE_H
#define PETRICHOR_TESTS_GOLDEN_COMPARE_H

#include <cstddef>
#include <string>

#include "tests/golden/picture.h"

namespace petrichor::golden {

/// How far a picture may be from the expected one. Differences are relative:
///
///     |actual - expected| / max(|expected|, scale)
///
/// with scale the mean of |expected| over the channels of one group (R, G, B; one AOV), so that
/// neither the unit (cd/m2, metres, bytes) nor a dark corner decides. The defaults leave room for
/// another driver; on one driver the same code gives the same bits.
struct Tolerance {
    float fail = 0.02f;      ///< a value that differs by more than this counts ...
    float percent = 0.5f;    ///< ... and this share of values may, in percent
    float hard_fail = 1.0f;  ///< not one value may differ by more
};

/// What the tests of a rebuild ask for: not one bit.
inline constexpr Tolerance kExact{0.0f, 0.0f, 0.0f};

struct Comparison {
    std::string mismatch;     ///< other size or channels: what; nothing was compared then
    std::size_t values = 0;   ///< compared
    std::size_t differ = 0;   ///< are not the same number
    std::size_t over = 0;     ///< differ by more than `fail`
    float largest = 0.0f;     ///< relative difference; infinite where only one is finite
    double mean = 0.0;        ///< of the finite relative differences
    std::string worst_place;  ///< "snow.Y at 12, 30: 0.25, expected 0.5"
    Picture relative;         ///< the relative differences, channel by channel

    bool equal() const { return mismatch.empty() && differ == 0; }
};

Comparison compare(const Picture& actual, const Picture& expected, const Tolerance& tolerance);

bool passes(const Comparison& comparison, const Tolerance& tolerance);

/// One line: "equal, 64512 values", or largest, mean, percent and the worst place.
std::string summary(const Comparison& comparison);

/// The largest relative difference of each pixel: black equal, red over `fail`, brighter is worse.
void write_difference_png(const std::filesystem::path& png, const Comparison& comparison,
                          const Tolerance& tolerance);

}  // namespace petrichor::golden

#endif
