#ifndef PETRICHOR_GPU_FRAME_METERING_H
#define PETRICHOR_GPU_FRAME_METERING_H

#include <optional>
#include <span>
#include <vector>

#include "gpu/frame/frame.h"

namespace petrichor::gpu {

/// The small frame that is rendered in place of `frame` to meter it: its longer side at most 96
/// pixels, one sample in their centres, one map of the sun's shadows, no outputs besides the picture but
/// how much snow lies where.
Frame metering_frame(const Frame& frame);

/// EV100 (formulas/light/exposure.h) of a picture of RGBA half bits, cd/m2; alpha 0 is sky.
///
/// A histogram of luminance in steps of an eighth of a stop, 2^-24 to 2^17 cd/m2; a pixel of a
/// surface counts four times as one of the sky; the darkest and the brightest 5 % of the weight are
/// left out, and the mean of the logarithms of the rest is what is metered. All counts are
/// integers: the order of pixels does not matter. Black and non-finite pixels do not count;
/// nothing: none does.
///
/// What is flat, where the brightest 5 % are less than two stops above that mean, is metered lower by
/// flat_stops() of formulas/light/exposure.h, by day; below EV100 10 less, from 4 on not at all: a night
/// stays a night. Under less than nine tenths of cloud it is less, too, and from three on 0.4 of it: a plain in
/// the sun is even, and no grey day.
///
///   snow  0..1 of each pixel, none: no snow. A meter takes white for grey; as a photographer adds a stop or two for a
///         snow field, what is metered falls by 1.3 stops times the share of the surfaces that is snow, by day, too.
///   cloud  0..1 of the sky
std::optional<float> metered_ev100(const std::vector<std::uint16_t>& beauty,
                                   std::span<const float> snow = {}, float cloud = 1.0f);

}  // namespace petrichor::gpu

#endif
