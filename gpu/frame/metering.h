#ifndef PETRICHOR_GPU_FRAME_METERING_H
#define PETRICHOR_GPU_FRAME_METERING_H

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gpu/frame/frame.h"

namespace petrichor::gpu {

/// What a meter is asked for.
enum class MeterOf {
    Exposure,
    ExposureAndLight  ///< the colour of the light, too
};

struct MeterReading {
    std::optional<float> ev100;      ///< of the trimmed mean of the picture's luminance; nothing: it is black
    std::optional<glm::vec3> light;  ///< its colour, linear, of luminance 1; nothing: not asked for, or none
};

/// Places without any weather of their own: a frame with it shows what it shows without, by the pipelines of frames that have
/// weather of places. So what is metered, which has none, makes no pipelines that its picture does not need.
std::shared_ptr<const PlaceWeather> no_places();

/// The small frame that is rendered in place of `frame` to meter it: its longer side at most 96
/// pixels, one sample in their centres, one map of the sun's shadows, no outputs besides the picture but
/// those of metering_aovs().
Frame metering_frame(const Frame& frame, MeterOf what = MeterOf::Exposure);

/// How much snow lies where; for the light what the surfaces scatter of it, too.
std::vector<std::string> metering_aovs(MeterOf what);

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
///         snow field, what is metered falls by (1.3 + 0.7 s) s stops for a share s of snow, by day, too.
///   cloud  0..1 of the sky
///   rain   0..1. Under a closed layer that rains by day what is metered rises by 0.7 stops for the heaviest: a storm is dark, and
///          its clouds stay below white.
std::optional<float> metered_ev100(const std::vector<std::uint16_t>& beauty,
                                   std::span<const float> snow = {}, float cloud = 1.0f,
                                   float rain = 0.0f);

/// What metered_light() takes of a picture: three numbers a pixel each, and one of snow.
struct MeteredSurfaces {
    std::span<const float> scattered_direct, scattered_indirect;  ///< cd/m2, linear
    std::span<const float> base_color;
    std::span<const float> snow;  ///< 0..1
};

/// The colour of the light that falls on what is seen, linear, of luminance 1: what each pixel's surface scatters,
/// divided by its albedo (a snow cover has one of 0.9 in all channels), and the mean of all those colours.
/// A pixel counts by its luminance up to the mean one, so that a bright window is no more than any other pixel and
/// the dark says little. Surfaces with an albedo of less than 0.03 in any channel do not count.
/// Nothing: there is none. A function of the numbers in their order.
std::optional<glm::vec3> metered_light(const MeteredSurfaces& surfaces);

}  // namespace petrichor::gpu

#endif
