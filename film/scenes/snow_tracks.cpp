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
// Of what is pressed away, that leaves: tyres throw it aside, soles pack it.
constexpr double kThrownByTyres = 1.0;
constexpr double kThrownByFeet = 0.8;
constexpr double kRim = 0.12;       // height of rims over the depth
constexpr double kDeep_m = 0.05;    // whose slopes are drawn
constexpr double kGauge_m = 1.6;
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

    // What a press of `amount` leaves at a texel; thrown: the part of it that leaves; rim: how high it
    // is thrown up beside it.
    void press(int x, int y, double share, double thrown, double amount, double groove, double rim)
    {
        const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) +
                       static_cast<std::size_t>(x);
        const double deep = share * amount;
        const double gone = deep * thrown;
        const double high = amount < 0.3 ? rim * (1.0 - amount / 0.3) : 0.0;
        if (gone > static_cast<double>(pressed[i])) {
            pressed[i] = static_cast<float>(gone);
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

double left_at(const TrackWay& track, std::size_t i)
{
    return track.left.empty() ? 1.0 : track.left[i];
}

// Where a bent way turns at each of its points: pieces meet there without gaps and overlaps.
std::vector<glm::dvec2> turns_of(const std::vector<glm::dvec2>& way)
{
    std::vector<glm::dvec2> turns(way.size(), glm::dvec2(0.0));
    glm::dvec2 before(0.0);
    for (std::size_t i = 0; i + 1 < way.size(); ++i) {
        const glm::dvec2 step = way[i + 1] - way[i];
        const double length = glm::length(step);
        const glm::dvec2 along = length > 1e-9 ? step / length : before;
        turns[i] = before + along;
        // It goes back the way it came.
        if (!(glm::length(turns[i]) > 0.2)) turns[i] = along;
        before = along;
    }
    if (!way.empty()) turns.back() = before;
    return turns;
}

void draw_tyres(Field& field, const TrackWay& track)
{
    const std::vector<glm::dvec2>& way = track.points;
    const std::vector<glm::dvec2> turns = turns_of(way);
    const double half = 0.5 * track.width_m;
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
                       if (glm::dot(q, turns[i]) < -0.01 || glm::dot(p - way[i + 1], turns[i + 1]) > 0.01) return;
                       const double left = left_at(track, i) +
                                           (left_at(track, i + 1) - left_at(track, i)) * std::clamp(s / length, 0.0, 1.0);
                       const double side = q.x * along.y - q.y * along.x;
                       const double from = std::abs(std::abs(side) - 0.5 * track.gauge_m);
                       const double amount = 1.0 - smooth(half - 0.02, half + 0.01, from);
                       // Bars of the tread, slanting to both sides of each tyre.
                       const double bars = (gone + s + 0.7 * from) / 0.055;
                       const double groove =
                           0.22 * smooth(0.55, 0.75, std::abs(2.0 * (bars - std::floor(bars)) - 1.0));
                       const double out = (from - half - 0.035) / 0.03;
                       field.press(x, y, share * left, kThrownByTyres, amount, groove,
                                   kRim * share * left * portable_exp(-out * out));
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

// toe: where it points, unit; size: 1 as long as 28 cm.
void print(Field& field, const glm::dvec2& middle, const glm::dvec2& toe, double size, double share)
{
    field.over(middle, middle, 0.25 * size, [&](int x, int y, const glm::dvec2& p) {
        const glm::dvec2 q = (p - middle) / size;
        const double v = glm::dot(q, toe), u = q.x * toe.y - q.y * toe.x;
        const double ring = foot(v / 1.22, u / 1.35);
        field.press(x, y, share, kThrownByFeet, foot(v, u), 0.0, kRim * share * ring);
    });
}

void draw_feet(Field& field, const TrackWay& track)
{
    const std::vector<glm::dvec2>& way = track.points;
    const double size = track.width_m / 0.10;
    const double share = (1.0 - kFreshDensity / kFootDensity) * track.depth;
    if (track.one_print) {
        const glm::dvec2 step = way.back() - way.front();
        const double length = glm::length(step);
        if (length > 1e-9) print(field, 0.5 * (way.front() + way.back()), step / length, size, share * left_at(track, 0));
        return;
    }
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
            const double remains = left_at(track, i) + (left_at(track, i + 1) - left_at(track, i)) * (left / length);
            print(field, middle, toe, size, share * remains);
        }
        left -= length;
    }
}

std::byte code(double value)
{
    return static_cast<std::byte>(static_cast<int>(std::clamp(value, 0.0, 1.0) * 255.0 + 0.5));
}

}  // namespace

TrackWay listed_way(const ScenarioTrack& track)
{
    TrackWay way;
    way.tyre = track.tyre;
    way.width_m = width_of(track);
    way.gauge_m = track.gauge_m.value_or(kGauge_m);
    way.depth = track.depth;
    way.points = way_of(track.points_m);
    return way;
}

gpu::TrackMap track_area(const std::vector<ScenarioTrack>& listed, const std::vector<TrackWay>& others)
{
    glm::dvec3 low(1e30), high(-1e30);
    double bottom = 1e30, top = -1e30;
    for (const ScenarioTrack& track : listed) {
        const double beside = 0.5 * track.gauge_m.value_or(kGauge_m) + width_of(track) + 0.5;
        for (const glm::dvec3& p : track.points_m) {
            low = glm::min(low, p - beside);
            high = glm::max(high, p + beside);
            bottom = std::min(bottom, p.y);
            top = std::max(top, p.y);
        }
    }
    // Smooth ways swing out between their points.
    if (low.x <= high.x) {
        const glm::dvec3 more = 0.08 * (high - low);
        low -= more;
        high += more;
    }
    for (const TrackWay& way : others) {
        const double beside = 0.5 * way.gauge_m + way.width_m + 0.5;
        for (const glm::dvec2& p : way.points) {
            low = glm::min(low, glm::dvec3(p.x, way.low_y_m, p.y) - beside);
            high = glm::max(high, glm::dvec3(p.x, way.high_y_m, p.y) + beside);
        }
        bottom = std::min(bottom, way.low_y_m);
        top = std::max(top, way.high_y_m);
    }
    gpu::TrackMap map;
    if (!(low.x <= high.x)) return map;
    const double side = std::max(high.x - low.x, high.z - low.z);
    map.texel_m = static_cast<float>(std::max(0.01, side / kMostTexels));
    const auto texel = static_cast<double>(map.texel_m);
    const auto texels = [&](double length) {
        return (static_cast<int>(length / texel) / kMargin + 1) * kMargin + 2 * kMargin;
    };
    map.width = texels(high.x - low.x);
    map.height = texels(high.z - low.z);
    map.corner_m = glm::vec2(glm::dvec2(low.x, low.z) - kMargin * texel);
    map.low_m = static_cast<float>(bottom - 0.6);
    map.high_m = static_cast<float>(top + 0.6);
    return map;
}

gpu::TrackMap draw_tracks(const std::vector<ScenarioTrack>& tracks)
{
    std::vector<TrackWay> ways;
    for (const ScenarioTrack& track : tracks)
        if (!track.points_m.empty()) ways.push_back(listed_way(track));
    return draw_ways(track_area(tracks, {}), ways);
}

gpu::TrackMap draw_ways(gpu::TrackMap area, const std::vector<TrackWay>& ways)
{
    if (area.width == 0) return area;
    Field field;
    field.map = std::move(area);
    const auto width = static_cast<std::size_t>(field.map.width);
    const auto count = width * static_cast<std::size_t>(field.map.height);
    field.pressed.assign(count, 0.0f);
    field.height.assign(count, 0.0f);
    for (const TrackWay& way : ways) {
        if (way.points.empty()) continue;
        way.tyre ? draw_tyres(field, way) : draw_feet(field, way);
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
        for (const double value : {track.width_m, track.gauge_m.value_or(-1.0), track.depth}) hasher.add(value);
        for (const std::string& node : track.nodes) hasher.add(node);
        hasher.add(track.points_m.size());
        for (const glm::dvec3& p : track.points_m) {
            for (const double value : {p.x, p.y, p.z}) hasher.add(value);
        }
    }
    return hasher.text();
}

std::string ways_fingerprint(const std::vector<TrackWay>& ways)
{
    Hasher hasher;
    for (const TrackWay& way : ways) {
        hasher.add(way.tyre);
        hasher.add(way.one_print);
        for (const double value : {way.width_m, way.gauge_m, way.depth, way.low_y_m, way.high_y_m}) hasher.add(value);
        hasher.add(way.points.size());
        for (const glm::dvec2& p : way.points) {
            hasher.add(p.x);
            hasher.add(p.y);
        }
        for (const double value : way.left) hasher.add(value);
    }
    return hasher.text();
}

}  // namespace petrichor::film
