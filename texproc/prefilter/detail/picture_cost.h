#ifndef PETRICHOR_TEXPROC_PREFILTER_DETAIL_PICTURE_COST_H
#define PETRICHOR_TEXPROC_PREFILTER_DETAIL_PICTURE_COST_H

#include <algorithm>
#include <cstddef>
#include <vector>

#include "texproc/prefilter/picture.h"

namespace petrichor::texproc::detail {

// What a picture costs that is farther from the truth than that of plain mips, beside its part of the
// mean: so many times what it is worse by, beyond a share that is let pass. Fewer would let one picture
// pay for the gain of another.
inline constexpr double kWorse = 10.0, kWorseFlicker = 1.0, kWithin = 0.005;
inline constexpr double kNothing = 3e-4;  // an error that nobody sees has no ratio
inline constexpr double kFlickerWeight = 0.3;

inline double change_of(double error, double of_plain)
{
    return (error + kNothing) / (of_plain + kNothing) - 1.0;
}

/// What pictures cost for being worse than those of plain mips: 0 where none is.
inline double penalty_of(const std::vector<PictureScore>& scores, const std::vector<PictureScore>& plain,
                         double worse = kWorse)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < scores.size(); ++i)
        sum += worse * std::max(change_of(scores[i].rmse, plain[i].rmse) - kWithin, 0.0) +
               kWorseFlicker *
                   std::max(change_of(scores[i].flicker, plain[i].flicker) - kWithin, 0.0);
    return sum;
}

/// Mean of the pictures: 0 for plain mips, below it where they are better.
inline double cost_of(const std::vector<PictureScore>& scores, const std::vector<PictureScore>& plain,
                      double worse = kWorse)
{
    double sum = penalty_of(scores, plain, worse);
    for (std::size_t i = 0; i < scores.size(); ++i)
        sum += change_of(scores[i].rmse, plain[i].rmse) +
               kFlickerWeight * change_of(scores[i].flicker, plain[i].flicker);
    return sum / static_cast<double>(scores.size());
}

}  // namespace petrichor::texproc::detail

#endif
