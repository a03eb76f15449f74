#include "gpu/frame/metering.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/gtc/packing.hpp>

#include "formulas/light/exposure.h"

namespace petrichor::gpu {

namespace {

constexpr int kLongSide = 96;
constexpr int kLowStop = -24;
constexpr int kStops = 41;
constexpr int kStepsAStop = 8;
constexpr std::uint64_t kSurface = 4;
constexpr std::uint64_t kSky = 1;
constexpr float kSnowStops = 1.3f, kSnowFieldStops = 0.7f;  // by eye
constexpr float kDayEv100 = 10.0f, kNightEv100 = 4.0f;
constexpr float kClear = 0.3f, kOvercast = 0.9f;
constexpr float kInTheSun = 0.4f;  // of flat_stops() that is left under a clear sky; by eye
constexpr float kStormStops = 0.7f;  // by eye

// 2^(k/8) / 2: where a mantissa of 0.5..1 passes into the next eighth of a stop.
constexpr std::array<float, kStepsAStop> kEighths{0.5f,         0.545253866f, 0.594603558f,
                                                  0.648419777f, 0.707106781f, 0.771105413f,
                                                  0.840896415f, 0.917004043f};

// The step of a luminance > 0, found by comparisons alone: no logarithm differs between machines.
int step_of(float luminance)
{
    int exponent = 0;
    const float mantissa = std::frexp(luminance, &exponent);  // 0.5..1
    int eighth = 0;
    while (eighth + 1 < kStepsAStop && mantissa >= kEighths[static_cast<std::size_t>(eighth + 1)])
        ++eighth;
    const int step = (exponent - 1 - kLowStop) * kStepsAStop + eighth;
    return std::clamp(step, 0, kStops * kStepsAStop - 1);
}

}  // namespace

std::vector<std::string> metering_aovs(MeterOf what)
{
    if (what == MeterOf::Exposure) return {"snow"};
    return {"snow", "base_color", "diffuse_direct", "diffuse_indirect"};
}

std::shared_ptr<const PlaceWeather> no_places()
{
    static const std::shared_ptr<const PlaceWeather> none = [] {
        auto shape = std::make_shared<PlaceShape>();
        shape->table.emplace_back(0u);
        auto place = std::make_shared<PlaceWeather>();
        place->shape = std::move(shape);
        place->levels_m = {0.0f};
        return place;
    }();
    return none;
}

Frame metering_frame(const Frame& frame, MeterOf what)
{
    Frame small = frame;
    FrameSettings& s = small.settings;
    const int longer = std::max(s.width, s.height);
    const auto scaled = [longer](int side) {
        return longer <= kLongSide ? side : std::max(1, (side * kLongSide + longer / 2) / longer);
    };
    s.width = scaled(s.width);
    s.height = scaled(s.height);
    s.samples = 1;
    small.shutter.clear();
    small.lens.radius_m = 0.0f;
    s.aovs = metering_aovs(what);
    s.coarse_shadows = true;
    // The exposure alone has the pipelines of the frame itself; what is scattered is written by others.
    s.any_light = what != MeterOf::Exposure;
    s.falling = false;  // so small a picture hardly has any
    // What is unlit is divided by the exposure: it must not be metered by itself.
    s.exposure = 1e12f;
    s.exposure_bias_stops = 0.0f;
    return small;
}

std::optional<float> metered_ev100(const std::vector<std::uint16_t>& beauty,
                                   std::span<const float> snow, float cloud, float rain)
{
    std::array<std::uint64_t, kStops * kStepsAStop> counts{};
    std::uint64_t total = 0;
    std::uint64_t white = 0;  // in 255ths of the weight
    for (std::size_t i = 0; i + 3 < beauty.size(); i += 4) {
        const float luminance = 0.2126f * glm::unpackHalf1x16(beauty[i]) +
                                0.7152f * glm::unpackHalf1x16(beauty[i + 1]) +
                                0.0722f * glm::unpackHalf1x16(beauty[i + 2]);
        // The smallest half of one channel is 2^-24.
        if (!(luminance > 1e-7f && std::isfinite(luminance))) continue;
        const std::uint64_t weight = beauty[i + 3] != 0 ? kSurface : kSky;
        counts[static_cast<std::size_t>(step_of(luminance))] += weight;
        total += weight;
        if (i / 4 < snow.size())
            white += weight * static_cast<std::uint64_t>(std::lround(std::clamp(snow[i / 4], 0.0f, 1.0f) * 255.0f));
    }
    if (total == 0) return std::nullopt;
    // In twentieths of the weight: 5 % at both ends is one of them. A step may be cut in two.
    const std::uint64_t low = total;
    const std::uint64_t high = 19 * total;
    std::uint64_t before = 0;
    std::uint64_t sum = 0;  // of twentieths of weight times twice the middle of the step
    for (std::size_t step = 0; step < counts.size(); ++step) {
        const std::uint64_t after = before + 20 * counts[step];
        const std::uint64_t from = std::max(before, low);
        const std::uint64_t to = std::min(after, high);
        if (to > from) sum += (to - from) * (2 * step + 1);
        before = after;
    }
    const double steps = static_cast<double>(sum) / static_cast<double>(2 * (high - low));
    const auto stops = static_cast<float>(kLowStop + steps / kStepsAStop);
    const float ev100 = stops + 3.0f;  // ev100_of_luminance(2^stops)
    // The step that 19 twentieths do not pass.
    std::uint64_t seen = 0;
    std::size_t bright = 0;
    while (bright + 1 < counts.size() && (seen += 20 * counts[bright]) < high) ++bright;
    const double above = (static_cast<double>(bright) + 0.5 - steps) / kStepsAStop;
    const auto share = static_cast<float>(static_cast<double>(white) / (255.0 * static_cast<double>(total)));
    const float day = std::clamp((ev100 - kNightEv100) / (kDayEv100 - kNightEv100), 0.0f, 1.0f);
    const float grey =
        kInTheSun + (1.0f - kInTheSun) * std::clamp((cloud - kClear) / (kOvercast - kClear), 0.0f, 1.0f);
    const float snow_stops = (kSnowStops + kSnowFieldStops * share) * share;
    const float storm_stops = kStormStops * std::clamp(rain, 0.0f, 1.0f) * (grey - kInTheSun) / (1.0f - kInTheSun);
    return ev100 + (storm_stops - snow_stops - grey * shared::flat_stops(static_cast<float>(above))) * day;
}

std::optional<glm::vec3> metered_light(const MeteredSurfaces& surfaces)
{
    constexpr float kLeastAlbedo = 0.03f;
    constexpr float kSnowAlbedo = 0.9f;
    const glm::dvec3 kLuminance(0.2126, 0.7152, 0.0722);
    const std::size_t pixels = surfaces.snow.size();
    std::vector<glm::dvec3> lights;
    double sum = 0.0;
    for (std::size_t i = 0; i < pixels; ++i) {
        const auto at = [i](std::span<const float> numbers) {
            return glm::vec3(numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]);
        };
        const glm::vec3 albedo = glm::mix(at(surfaces.base_color), glm::vec3(kSnowAlbedo),
                                          std::clamp(surfaces.snow[i], 0.0f, 1.0f));
        if (!(std::min({albedo.x, albedo.y, albedo.z}) >= kLeastAlbedo)) continue;
        const glm::dvec3 light =
            glm::dvec3(at(surfaces.scattered_direct) + at(surfaces.scattered_indirect)) / glm::dvec3(albedo);
        const double luminance = glm::dot(light, kLuminance);
        if (!(luminance > 0.0 && std::isfinite(luminance))) continue;
        lights.push_back(light);
        sum += luminance;
    }
    if (lights.empty()) return std::nullopt;
    const double mean = sum / static_cast<double>(lights.size());
    glm::dvec3 colour(0.0);
    for (const glm::dvec3& light : lights) colour += light / std::max(glm::dot(light, kLuminance), mean);
    return glm::vec3(colour / glm::dot(colour, kLuminance));
}

}  // namespace petrichor::gpu
