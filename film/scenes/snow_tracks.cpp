#include "film/scenes/snow_tracks.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/hash.h"
#include "base/portable_math.h"

namespace petrichor::film {
namespace {

constexpr double kFreshDensity = 100.0;  // kg/m3
constexpr double kFootDensity = 400.0;
constexpr double kTyreDensity = 550.0;
constexpr double kRim = 0.12;       // height of rims over the depth
constexpr double kDeep_m = 0.05;    // whose slopes are drawn
constexpr double kStep_m = 0.75;
constexpr double kStride_m = 0.09;  // of a foot beside the middle
constexpr int kPieces = 12;         // between two points of a way
constexpr int kMostTexels = 1920;
constexpr int kMargin = 64;

double smooth(double low, double high, double x)
{
    const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

// A way through all points, bent smoothly (Catmull & Rom 1974), from above.
std::vector<glm::dvec2> way_of(const std::vector<glm::dvec3>& points)
{
    const auto at = [&](std::ptrdiff_t i) {
        const auto last = static_cast<std::ptrdiff_t>(points.size()) - 1;
        const glm::dvec3& p = points[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i, 0, last))];
        return glm::dvec2(p.x, p.z);
    };
    std::vector<glm::dvec2> way{at(0)};
    for (std::ptrdiff_t i = 0; i + 1 < static_cast<std::ptrdiff_t>(points.size()); ++i) {
        const glm::dvec2 a = at(i), b = at(i + 1);
        const glm::dvec2 from = 0.5 * (b - at(i - 1)), to = 0.5 * (at(i + 2) - a);
        for (int k = 1; k <= kPieces; ++k) {
            const double t = static_cast<double>(k) / kPieces;
            const double t2 = t * t, t3 = t2 * t;
            way.push_back((2 * t3 - 3 * t2 + 1) * a + (t3 - 2 * t2 + t) * from +
                          (3 * t2 - 2 * t3) * b + (t3 - t2) * to);
        }
    }
    return way;
}

double width_of(const ScenarioTrack& track)
{
    return track.width_m > 0.0 ? track.width_m : track.tyre ? 0.22 : 0.10;
}

// The snow from above: how far it is pressed, and how high it stands over fresh snow, in depths.
struct Field {
    gpu::TrackMap map;
    std::vector<float> pressed, height;

    // What a press of `amount` leaves at a texel; rim: how high it is thrown up beside it.
    void press(int x, int y, double share, double amount, double groove, double rim)
    {
        const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) +
                       static_cast<std::size_t>(x);
        const double deep = share * amount;
        const double high = amount < 0.3 ? rim * (1.0 - amount / 0.3) : 0.0;
        if (deep > static_cast<double>(pressed[i])) {
            pressed[i] = static_cast<float>(deep);
            height[i] = std::min(height[i], static_cast<float>(high - deep * (1.0 - groove)));
        } else if (pressed[i] <= 0.0f) {
            height[i] = std::max(height[i], static_cast<float>(high));
        }
    }

    // Calls f(x, y, p) for the texels within `reach` of the box of two points.
    template <class F>
    void over(const glm::dvec2& a, const glm::dvec2& b, double reach_m, const F& f)
    {
        const auto texel = static_cast<double>(map.texel_m);
        const glm::dvec2 corner(map.corner_m);
        const glm::dvec2 low = (glm::min(a, b) - reach_m - corner) / texel;
        const glm::dvec2 high = (glm::max(a, b) + reach_m - corner) / texel;
        const int right = std::min(static_cast<int>(high.x), map.width - 2);
        const int down = std::min(static_cast<int>(high.y), map.height - 2);
        for (int y = std::max(static_cast<int>(low.y), 1); y <= down; ++y) {
            for (int x = std::max(static_cast<int>(low.x), 1); x <= right; ++x)
                f(x, y, corner + (glm::dvec2(x, y) + 0.5) * texel);
        }
    }
};

void draw_tyres(Field& field, const ScenarioTrack& track, const std::vector<glm::dvec2>& way)
{
    const double half = 0.5 * width_of(track);
    const double share = (1.0 - kFreshDensity / kTyreDensity) * track.depth;
    double gone = 0.0;
    for (std::size_t i = 0; i + 1 < way.size(); ++i) {
        const glm::dvec2 step = way[i + 1] - way[i];
        const double length = glm::length(step);
        if (!(length > 1e-9)) continue;
        const glm::dvec2 along = step / length;
        field.over(way[i], way[i + 1], 0.5 * track.gauge_m + half + 0.15,
                   [&](int x, int y, const glm::dvec2& p) {
                       const glm::dvec2 q = p - way[i];
                       const double s = glm::dot(q, along);
                       if (s < -0.01 || s > length + 0.01) return;
                       const double side = q.x * along.y - q.y * along.x;
                       const double from = std::abs(std::abs(side) - 0.5 * track.gauge_m);
                       const double amount = 1.0 - smooth(half - 0.02, half + 0.01, from);
                       // Bars of the tread, slanting to both sides of each tyre.
                       const double bars = (gone + s + 0.7 * from) / 0.055;
                       const double groove =
                           0.22 * smooth(0.55, 0.75, std::abs(2.0 * (bars - std::floor(bars)) - 1.0));
                       const double out = (from - half - 0.035) / 0.03;
                       field.press(x, y, share, amount, groove,
                                   kRim * share * portable_exp(-out * out));
                   });
        gone += length;
    }
}

// How far a foot presses at a place of it: 1 in the middle .. 0 beside it. v: along, u: across.
double foot(double v, double u)
{
    const auto part = [&](double middle, double length, double width) {
        const double a = (v - middle) / length, b = u / width;
        return 1.0 - smooth(0.75, 1.15, std::sqrt(a * a + b * b));
    };
    return std::max({part(0.055, 0.085, 0.05), part(-0.095, 0.05, 0.037), part(-0.03, 0.07, 0.028)});
}

void draw_feet(Field& field, const ScenarioTrack& track, const std::vector<glm::dvec2>& way)
{
    const double size = width_of(track) / 0.10;
    const double share = (1.0 - kFreshDensity / kFootDensity) * track.depth;
    double left = 0.5 * kStep_m;
    int number = 0;
    for (std::size_t i = 0; i + 1 < way.size(); ++i) {
        const glm::dvec2 step = way[i + 1] - way[i];
        const double length = glm::length(step);
        if (!(length > 1e-9)) continue;
        const glm::dvec2 along = step / length;
        for (; left < length; left += kStep_m, ++number) {
            // No two steps are alike.
            const auto chance = [&](double salt) {
                return portable_sin_cos(91.7 * number + 37.3 * salt).sine;
            };
            const double side = number % 2 == 0 ? 1.0 : -1.0;
            const SinCos turn = portable_sin_cos(side * 0.12 + 0.08 * chance(1.0));
            const glm::dvec2 out(along.y, -along.x);
            const glm::dvec2 middle = way[i] + along * (left + 0.03 * chance(2.0)) +
                                      out * (side * kStride_m * size + 0.015 * chance(3.0));
            const glm::dvec2 toe = along * turn.cosine + out * turn.sine;
            field.over(middle, middle, 0.25 * size, [&](int x, int y, const glm::dvec2& p) {
                const glm::dvec2 q = (p - middle) / size;
                const double v = glm::dot(q, toe), u = q.x * toe.y - q.y * toe.x;
                const double ring = foot(v / 1.22, u / 1.35);
                field.press(x, y, share, foot(v, u), 0.0, kRim * share * ring);
            });
        }
        left -= length;
    }
}

gpu::TrackMap area_of(const std::vector<ScenarioTrack>& tracks)
{
    glm::dvec3 low(1e30), high(-1e30);
    for (const ScenarioTrack& track : tracks) {
        const double beside = 0.5 * track.gauge_m + width_of(track) + 0.5;
        for (const glm::dvec3& p : track.points_m) {
            low = glm::min(low, p - beside);
            high = glm::max(high, p + beside);
        }
    }
    // Smooth ways swing out between their points.
    const glm::dvec3 more = 0.08 * (high - low);
    low -= more;
    high += more;
    const double side = std::max(high.x - low.x, high.z - low.z);
    gpu::TrackMap map;
    map.texel_m = static_cast<float>(std::max(0.01, side / kMostTexels));
    const auto texel = static_cast<double>(map.texel_m);
    const auto texels = [&](double length) {
        return (static_cast<int>(length / texel) / kMargin + 1) * kMargin + 2 * kMargin;
    };
    map.width = texels(high.x - low.x);
    map.height = texels(high.z - low.z);
    map.corner_m = glm::vec2(glm::dvec2(low.x, low.z) - kMargin * texel);
    double bottom = 1e30, top = -1e30;
    for (const ScenarioTrack& track : tracks) {
        for (const glm::dvec3& p : track.points_m) {
            bottom = std::min(bottom, p.y);
            top = std::max(top, p.y);
        }
    }
    map.low_m = static_cast<float>(bottom - 0.6);
    map.high_m = static_cast<float>(top + 0.6);
    return map;
}

std::byte code(double value)
{
    return static_cast<std::byte>(static_cast<int>(std::clamp(value, 0.0, 1.0) * 255.0 + 0.5));
}

}  // namespace

gpu::TrackMap draw_tracks(const std::vector<ScenarioTrack>& tracks)
{
    if (tracks.empty()) return {};
    Field field;
    field.map = area_of(tracks);
    const auto width = static_cast<std::size_t>(field.map.width);
    const auto count = width * static_cast<std::size_t>(field.map.height);
    field.pressed.assign(count, 0.0f);
    field.height.assign(count, 0.0f);
    for (const ScenarioTrack& track : tracks) {
        const auto way = way_of(track.points_m);
        track.tyre ? draw_tyres(field, track, way) : draw_feet(field, track, way);
    }
    const double scale = kDeep_m / (2.0 * static_cast<double>(field.map.texel_m));
    const auto slope = [&](std::size_t i, std::size_t step) {
        if (i < step || i + step >= count) return 128.0 / 255.0;
        const auto difference = static_cast<double>(field.height[i + step] - field.height[i - step]);
        return 128.0 / 255.0 + 0.25 * std::clamp(scale * difference, -1.9, 1.9);
    };
    field.map.rgba.reserve(4 * count);
    for (std::size_t i = 0; i < count; ++i) {
        field.map.rgba.push_back(code(static_cast<double>(field.pressed[i])));
        field.map.rgba.push_back(code(slope(i, 1)));
        field.map.rgba.push_back(code(slope(i, width)));
        field.map.rgba.push_back(std::byte{255});
    }
    return std::move(field.map);
}

std::string tracks_fingerprint(const std::vector<ScenarioTrack>& tracks)
{
    if (tracks.empty()) return "";
    Hasher hasher;
    for (const ScenarioTrack& track : tracks) {
        hasher.add(track.tyre);
        for (const double value : {track.width_m, track.gauge_m, track.depth}) hasher.add(value);
        hasher.add(track.points_m.size());
        for (const glm::dvec3& p : track.points_m) {
            for (const double value : {p.x, p.y, p.z}) hasher.add(value);
        }
    }
    return hasher.text();
}

}  // namespace petrichor::film
