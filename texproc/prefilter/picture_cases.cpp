// Which pictures are taken: views, lights, and what is tried under them.
#include <cmath>
#include <iterator>
#include <numbers>
#include <random>
#include <string>

#include "texproc/prefilter/picture.h"

namespace petrichor::texproc {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

}  // namespace

PictureOptions reference_pictures()
{
    PictureOptions o;
    o.views = {{.name = "floor"}};
    o.lights = {{.name = "sun ahead", .to_light = {0.15f, 1.0f, 0.42f}},
                {.name = "sun from the left", .to_light = {-0.6f, 0.8f, 1.0f}},
                {.name = "sun behind", .to_light = {0.6f, -0.8f, 0.7f}},
                {.name = "window ahead", .to_light = {0.15f, 1.0f, 0.42f}, .alpha = 0.1f}};
    o.cases = {{0, 0, false}, {0, 1, false}, {0, 2, false}, {0, 3, false}, {0, 0, true}};
    return o;
}

PictureOptions design_pictures(bool quick, SurfaceClass surface)
{
    PictureOptions o;
    o.frames = 2;
    o.samples = quick ? 5 : 8;
    o.seed = 77;
    o.views = {{.name = "near",
                .height_m = 1.2,
                .pitch_deg = 20.0,
                .width = 110,
                .rows = 56,
                .step_right_m = 0.006,
                .step_ahead_m = 0.017},
               {.name = "far",
                .height_m = 2.6,
                .pitch_deg = 13.0,
                .field_of_view_deg = 40.0,
                .width = 110,
                .rows = 48,
                .step_right_m = 0.011,
                .step_ahead_m = 0.031},
               {.name = "down",
                .height_m = 4.0,
                .pitch_deg = 70.0,
                .field_of_view_deg = 50.0,
                .width = 80,
                .rows = 48,
                .step_right_m = 0.007,
                .step_ahead_m = 0.013}};
    if (quick) {
        o.lights = {{.name = "ahead, low", .to_light = {-0.25f, 1.0f, 0.30f}},
                    {.name = "ahead, high", .to_light = {0.3f, 1.0f, 0.8f}},
                    {.name = "from the right", .to_light = {1.0f, 0.1f, 0.6f}},
                    {.name = "behind", .to_light = {-0.5f, -0.9f, 0.9f}}};
    } else {
        // What is fitted is seen from 9 to 60 degrees, and pixels here are as large as in the other views.
        o.views.back().pitch_deg = 52.0;
        o.views.back().field_of_view_deg = 22.0;
        // As fine as a large picture, but less of it.
        o.views.push_back({.name = "part",
                           .height_m = 1.7,
                           .pitch_deg = 15.0,
                           .field_of_view_deg = 12.0,
                           .width = 100,
                           .rows = 64,
                           .step_right_m = 0.005,
                           .step_ahead_m = 0.019});
        // Plain trilinear filtering, of which little is enough.
        PictureView one_tap = o.views.front();
        one_tap.name += ", one tap";
        one_tap.rows = 40;
        one_tap.taps = 1;
        o.views.push_back(one_tap);
        // A ring of suns, low and high in turn, another ahead.
        constexpr float kRing[][3] = {
            {0.26f, 0.97f, 0.45f},  {0.83f, 0.56f, 1.1f},    {0.97f, -0.26f, 0.45f},
            {0.56f, -0.83f, 1.1f},  {-0.26f, 0.97f, 1.1f},   {-0.83f, 0.56f, 0.45f},
            {-0.97f, -0.26f, 1.1f}, {-0.56f, -0.83f, 0.45f}, {-0.1f, 1.0f, 0.3f}};
        // Beside half of them there is a sky on paint; on metal, which would be black without, beside
        // all but two ahead.
        constexpr float kSky[] = {0.0f, 0.07f, 0.0f, 0.16f, 0.0f, 0.12f, 0.0f, 0.09f, 0.08f};
        constexpr float kMetalSky[] = {0.08f, 0.07f, 0.11f, 0.16f, 0.0f, 0.12f, 0.13f, 0.09f, 0.0f};
        for (const auto& sky_of : {kSky, kMetalSky})
            for (std::size_t i = 0; i < std::size(kRing); ++i)
                o.lights.push_back({.name = "sun " + std::to_string(i),
                                    .to_light = {kRing[i][0], kRing[i][1], kRing[i][2]},
                                    .sky = sky_of[i]});
        o.lights.push_back({.name = "sky", .sun = 0.0f, .sky = 1.0f});
    }
    o.lights.push_back({.name = "window", .to_light = {-0.1f, 1.0f, 0.5f}, .alpha = 0.12f});
    const int lights = static_cast<int>(o.lights.size()), views = static_cast<int>(o.views.size());
    if (quick) {
        for (int view = 0; view < views; ++view)
            for (int light = 0; light < lights; ++light) o.cases.push_back({view, light, false});
        return o;
    }
    constexpr int kDown = 2, kOneTap = 4, kSuns = 9, kSkyAlone = 2 * kSuns, kWindow = kSkyAlone + 1;
    for (int view = 0; view < views; ++view) {
        const auto add = [&](int light, bool some, bool metal) {
            if (view != kOneTap || some) o.cases.push_back({view, light, metal});
        };
        if (surface != SurfaceClass::Metal) {
            for (int sun = 0; sun < kSuns; ++sun) add(sun, sun % 2 == 1 || sun == 0, false);
            add(kWindow, true, false);
            // From above the sky lights all slopes of paint alike: an error that nobody sees.
            if (view != kDown) add(kSkyAlone, false, false);
        }
        if (surface != SurfaceClass::Paint) {
            for (int sun = 0; sun < kSuns; ++sun) add(kSuns + sun, sun % 3 == 2, true);
            add(kSkyAlone, false, true);
        }
    }
    return o;
}

PictureOptions drawn_pictures(std::uint32_t seed)
{
    std::mt19937 dice(seed);
    const auto between = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(dice()) / 4294967296.0;
    };
    PictureOptions o;
    o.frames = 4;
    o.samples = 10;
    o.seed = seed;
    constexpr int kViews = 4;
    for (int view = 0; view < kViews; ++view) {
        const std::string number = std::to_string(view + 1);
        const double turned = between(0.0, 2.0 * std::numbers::pi), step = between(0.01, 0.03);
        const double pitch = between(11.0, 50.0), field_of_view = between(20.0, 40.0);
        constexpr int kWidth = 200;
        // As far as its middle pixel is 4 to 16 mm wide: nearer there are no levels to see.
        const double pixel = 2.0 * std::tan(0.5 * field_of_view * kDegree) / kWidth;
        const double distance_m = 0.004 * std::exp2(between(0.0, 2.0)) / pixel;
        o.views.push_back({.name = "view " + number,
                           .height_m = distance_m * std::sin(pitch * kDegree),
                           .pitch_deg = pitch,
                           .field_of_view_deg = field_of_view,
                           .width = kWidth,
                           .rows = 80,
                           .step_right_m = step * std::cos(turned),
                           .step_ahead_m = step * std::sin(turned)});
        // Two lights on paint, one on metal, which would be black under a sun alone from most sides.
        for (const bool metal : {false, false, true}) {
            const double around = between(0.0, 2.0 * std::numbers::pi);
            const double up = between(15.0, 65.0) * std::numbers::pi / 180.0;
            const bool window = !metal && between(0.0, 1.0) < 0.25;
            const bool sky = metal || (!window && between(0.0, 1.0) < 0.5);
            const std::string name = (window ? "window " : "sun ") + std::to_string(o.lights.size() + 1);
            o.cases.push_back({view, static_cast<int>(o.lights.size()), metal});
            o.lights.push_back({.name = name,
                                .to_light = {static_cast<float>(std::cos(around) * std::cos(up)),
                                             static_cast<float>(std::sin(around) * std::cos(up)),
                                             static_cast<float>(std::sin(up))},
                                .alpha = window ? static_cast<float>(between(0.08, 0.14)) : 0.0f,
                                .sky = sky ? static_cast<float>(between(0.05, 0.2)) : 0.0f});
        }
    }
    return o;
}

PictureOptions guard_pictures(SurfaceClass surface)
{
    std::mt19937 dice(4001);
    const auto between = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(dice()) / 4294967296.0;
    };
    PictureOptions o;
    o.frames = 2;
    o.samples = 12;
    o.seed = 4001;
    constexpr int kViews = 16, kSuns = 7;
    for (int view = 0; view < kViews; ++view) {
        const double turned = between(0.0, 2.0 * std::numbers::pi), step = between(0.01, 0.03);
        const double lifted = between(0.0, 1.0), pitch = 9.0 + 43.0 * lifted * lifted;  // low ones see most
        const double half_width = std::tan(between(10.0, 20.0) * kDegree);
        // A part of a large picture: a third of its width, its pixels as large.
        constexpr int kWidth = 70, kLargeWidth = 200;
        const double distance_m = 0.004 * std::exp2(between(0.0, 2.3)) * 0.5 * kLargeWidth / half_width;
        o.views.push_back({.name = "guard " + std::to_string(view + 1),
                           .height_m = distance_m * std::sin(pitch * kDegree),
                           .pitch_deg = pitch,
                           .field_of_view_deg = 2.0 * std::atan(half_width * kWidth / kLargeWidth) / kDegree,
                           .width = kWidth,
                           .rows = 32,
                           .step_right_m = step * std::cos(turned),
                           .step_ahead_m = step * std::sin(turned)});
        const double first = between(0.0, 2.0 * std::numbers::pi);
        for (const bool metal : {false, true}) {
            for (int light = 0; light < kSuns + (metal ? 0 : 1); ++light) {
                const bool window = light == kSuns;
                const double around = first + (light + between(0.0, 1.0)) * 2.0 * std::numbers::pi / kSuns;
                const double up = between(15.0, 65.0) * kDegree;
                const bool sky = metal || (!window && between(0.0, 1.0) < 0.4);
                const double sky_radiance = between(0.05, 0.2), alpha = between(0.08, 0.14);
                if (metal ? surface == SurfaceClass::Paint : surface == SurfaceClass::Metal) continue;
                o.cases.push_back({view, static_cast<int>(o.lights.size()), metal});
                o.lights.push_back({.name = (window ? "window " : "sun ") + std::to_string(light + 1),
                                    .to_light = {static_cast<float>(std::cos(around) * std::cos(up)),
                                                 static_cast<float>(std::sin(around) * std::cos(up)),
                                                 static_cast<float>(std::sin(up))},
                                    .alpha = window ? static_cast<float>(alpha) : 0.0f,
                                    .sky = sky ? static_cast<float>(sky_radiance) : 0.0f});
            }
        }
    }
    return o;
}

PictureOptions all_pictures()
{
    PictureOptions o = reference_pictures();
    o.views.push_back({.name = "floor, one tap", .taps = 1});
    o.views.push_back({.name = "from above",
                       .height_m = 6.0,
                       .pitch_deg = 55.0,
                       .width = 200,
                       .rows = 100,
                       .step_right_m = 0.009,
                       .step_ahead_m = 0.013});
    // A sun beside which the sky gives a fifth of the light, and a sky alone.
    constexpr float kBesideSun = 0.1f;
    for (int i = 0; i < 3; ++i) {
        PictureLight day = o.lights[static_cast<std::size_t>(i)];
        day.name += " and sky";
        day.sky = kBesideSun;
        o.lights.push_back(day);
    }
    o.lights.push_back({.name = "sky", .sun = 0.0f, .sky = 1.0f});
    constexpr int kAhead = 4, kLeft = 5, kBehind = 6, kSky = 7;
    for (const PictureCase& c : {PictureCase{0, kLeft, true},
                                 {0, kBehind, true},
                                 {0, kAhead, false},
                                 {0, kSky, false},
                                 {0, kSky, true},
                                 {1, kAhead, false},
                                 {1, kLeft, false},
                                 {1, kBehind, false},
                                 {1, kAhead, true},
                                 {2, kAhead, false},
                                 {2, kLeft, false},
                                 {2, kBehind, false},
                                 {2, kAhead, true}})
        o.cases.push_back(c);
    return o;
}

}  // namespace petrichor::texproc
