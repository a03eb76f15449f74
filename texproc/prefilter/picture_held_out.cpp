// Pictures of whole floors from few pixels, drawn anew for every material.
#include <cmath>
#include <iterator>
#include <numbers>
#include <random>
#include <string>

#include "texproc/prefilter/picture.h"

namespace petrichor::texproc {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
// A pixel of twelve each way: so many pictures cost as much as four large ones, and what one of them shows by
// chance counts little among the others under its light.
constexpr int kEvery = 12, kViews = 24;
// One view in so many has pixels so many times as large: levels that a small map shows to nobody else.
constexpr int kLarge = 6;
constexpr double kLargeCovers = 4.0;
// Suns from everywhere in three bands of height, more of them ahead, where highlights are narrow, and windows there.
constexpr int kSides = 32, kAhead = 32, kWindows = 16;
constexpr double kBands[] = {18.0, 30.0, 43.0, 58.0};
constexpr double kAheadWide = 80.0, kMetalSky = 0.1;

}  // namespace

PictureOptions held_out_pictures(SurfaceClass surface, std::uint32_t seed)
{
    std::mt19937 dice(seed);
    const auto between = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(dice()) / 4294967296.0;
    };
    PictureOptions o;
    o.frames = 2;
    o.samples = 12;
    o.seed = seed;
    for (int view = 0; view < kViews; ++view) {
        const double turned = between(0.0, 2.0 * std::numbers::pi), step = between(0.01, 0.03);
        const double height = std::exp2(between(0.0, 1.0)), pitch = between(13.0, 20.0);
        o.views.push_back({.name = "floor " + std::to_string(view + 1),
                           .height_m = height,
                           .pitch_deg = pitch,
                           .field_of_view_deg = between(28.0, 40.0),
                           .width = 300 / kEvery,
                           .rows = 108 / kEvery,
                           .covers = (view % kLarge == kLarge - 1 ? kLargeCovers : 1.0) / kEvery,
                           .step_right_m = step * std::cos(turned),
                           .step_ahead_m = step * std::sin(turned)});
    }
    const auto add = [&](double around, double up, double alpha, double sky) {
        for (const bool metal : {false, true}) {
            if (metal ? surface == SurfaceClass::Paint || alpha > 0.0 : surface == SurfaceClass::Metal) continue;
            const int light = static_cast<int>(o.lights.size());
            for (int i = 0; i < kHeldOutViews; ++i) o.cases.push_back({(light + 5 * i) % kViews, light, metal});
            o.lights.push_back({.name = (alpha > 0.0 ? "window " : "sun ") + std::to_string(light + 1),
                                .to_light = {static_cast<float>(std::sin(around) * std::cos(up)),
                                             static_cast<float>(std::cos(around) * std::cos(up)),
                                             static_cast<float>(std::sin(up))},
                                .alpha = static_cast<float>(alpha),
                                .sky = static_cast<float>(metal && sky == 0.0 ? kMetalSky : sky)});
        }
    };
    const auto add_sun = [&](double around, double up) {
        const bool has_sky = between(0.0, 1.0) < 0.3;
        const double sky = between(0.05, 0.2);
        add(around, up, 0.0, has_sky ? sky : 0.0);
    };
    const double first = between(0.0, 1.0);
    for (std::size_t band = 0; band + 1 < std::size(kBands); ++band) {
        for (int side = 0; side < kSides; ++side) {
            const double turned = first + 0.5 * static_cast<double>(band) + side + between(-0.4, 0.4);
            add_sun(turned * 2.0 * std::numbers::pi / kSides, between(kBands[band], kBands[band + 1]) * kDegree);
        }
    }
    for (int ahead = 0; ahead < kAhead; ++ahead) {
        const double turned = between(0.0, 1.0) + ahead - 0.5 * kAhead;
        add_sun(turned * kAheadWide / kAhead * kDegree, between(15.0, 45.0) * kDegree);
    }
    for (int window = 0; window < kWindows; ++window) {
        const double around = between(-0.5, 0.5) * kAheadWide * kDegree, up = between(16.0, 36.0) * kDegree;
        add(around, up, between(0.08, 0.14), 0.0);
    }
    return o;
}

}  // namespace petrichor::texproc
