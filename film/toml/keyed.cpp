#include "film/toml/keyed.h"

#include <cassert>
#include <cstddef>

namespace petrichor::film {
namespace {

// Index of the segment that holds the time, or where the time lies outside the keys.
template <class Key>
std::size_t segment_of(const std::vector<Key>& keys, double time_s)
{
    std::size_t i = 0;
    while (i + 2 < keys.size() && keys[i + 1].time_s <= time_s) ++i;
    return i;
}

template <class Value>
Value hermite(const Value& from, const Value& to, const Value& slope_from, const Value& slope_to,
              double length, double u)
{
    const double u2 = u * u;
    const double u3 = u2 * u;
    return (2.0 * u3 - 3.0 * u2 + 1.0) * from + (u3 - 2.0 * u2 + u) * length * slope_from +
           (3.0 * u2 - 2.0 * u3) * to + (u3 - u2) * length * slope_to;
}

// Fritsch and Carlson: zero at extremes and ends, else the weighted harmonic mean of the secants.
double monotone_slope(const std::vector<NumberKey>& keys, std::size_t i)
{
    if (i == 0 || i + 1 == keys.size()) return 0.0;
    const double before_s = keys[i].time_s - keys[i - 1].time_s;
    const double after_s = keys[i + 1].time_s - keys[i].time_s;
    const double before = (keys[i].value - keys[i - 1].value) / before_s;
    const double after = (keys[i + 1].value - keys[i].value) / after_s;
    if (before * after <= 0.0) return 0.0;
    const double weight_before = 2.0 * after_s + before_s;
    const double weight_after = after_s + 2.0 * before_s;
    return (weight_before + weight_after) / (weight_before / before + weight_after / after);
}

glm::dvec3 path_slope(const std::vector<PathKey>& keys, std::size_t i)
{
    if (i == 0 || i + 1 == keys.size()) return glm::dvec3(0.0);
    return (keys[i + 1].point - keys[i - 1].point) / (keys[i + 1].time_s - keys[i - 1].time_s);
}

}  // namespace

double value_at(const KeyedNumber& number, double time_s, double otherwise)
{
    const auto& keys = number.keys;
    if (keys.empty()) return otherwise;
    if (time_s <= keys.front().time_s) return keys.front().value;
    if (time_s >= keys.back().time_s) return keys.back().value;
    const std::size_t i = segment_of(keys, time_s);
    if (number.interpolation == Interpolation::Hold) return keys[i].value;
    const double length = keys[i + 1].time_s - keys[i].time_s;
    const double u = (time_s - keys[i].time_s) / length;
    if (number.interpolation == Interpolation::Linear) {
        return keys[i].value + (keys[i + 1].value - keys[i].value) * u;
    }
    return hermite(keys[i].value, keys[i + 1].value, monotone_slope(keys, i),
                   monotone_slope(keys, i + 1), length, u);
}

glm::dvec3 point_at(const std::vector<PathKey>& keys, Interpolation interpolation, double time_s)
{
    assert(!keys.empty());
    if (time_s <= keys.front().time_s) return keys.front().point;
    if (time_s >= keys.back().time_s) return keys.back().point;
    const std::size_t i = segment_of(keys, time_s);
    if (interpolation == Interpolation::Hold) return keys[i].point;
    const double length = keys[i + 1].time_s - keys[i].time_s;
    const double u = (time_s - keys[i].time_s) / length;
    if (interpolation == Interpolation::Linear)
        return glm::mix(keys[i].point, keys[i + 1].point, u);
    return hermite(keys[i].point, keys[i + 1].point, path_slope(keys, i), path_slope(keys, i + 1),
                   length, u);
}

}  // namespace petrichor::film
