#ifndef PETRICHOR_TEXPROC_PREFILTER_DETAIL_LOOK_PRICE_H
#define PETRICHOR_TEXPROC_PREFILTER_DETAIL_LOOK_PRICE_H

#include <cstddef>
#include <span>
#include <vector>

#include "texproc/prefilter/picture.h"

namespace petrichor::texproc::detail {

/// What pictures of held_out_pictures() cost: their mean change of RMSE against plain mips, and a price for each light
/// that is worse in the mean of its kHeldOutViews views, and for each view. The price of a light begins gently, a
/// little before it is worse, so that it has a slope everywhere.
///
///   changes  of the cases: change_of() their RMSE
///   slope    by how much more it costs for more of each; as many
double look_price(std::span<const double> changes, std::span<double> slope);

/// And what those of worst_lights() cost beside that, which are no part of the mean: each light for what it is worse by
/// than plain mips in the mean of its views, and the more for each per cent the worse it is. It sets in as gently.
double worst_price(std::span<const double> changes, std::span<double> slope);

/// Steps of the numbers for which the forms cost least by look_price() and by their flicker (kFlickerWeight), as far as
/// is found by going downhill from no step at all; each within low..high. Of levels that the pictures do not see they are those of the level beside them.
///
///   plain     scores of plain mips, a row a case
///   sought    so many of the cases, the last ones, are of worst_lights() (worst_price(); their flicker is free)
///   of_level  numbers of a level; those of one level stand before those of the next
std::vector<float> cheapest_steps(const PictureForms& forms, const std::vector<PictureScore>& plain,
                                  std::span<const float> low, std::span<const float> high, std::size_t of_level,
                                  std::size_t sought = 0);

}  // namespace petrichor::texproc::detail

#endif
