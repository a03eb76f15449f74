#include "film/toml/keyed.h"

#include <cassert>
#include <cstddef>

#include "base/cubic.h"

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

double slope_at(const std::vector<NumberKey>& keys, std::size_t i)
{
    if (i == 0 || i + 1 == keys.size()) return 0.0;
    const double before_s = keys[i].time_s - keys[i - 1].time_s;
    const double after_s = keys[i + 1].time_s - keys[i].time_s;
    return monotone_slope(before_s, (keys[i].value - keys[i - 1].value) / before_s, after_s,
                          (keys[i + 1].value - keys[i].value) / after_s);
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
    return hermite(keys[i].value, keys[i + 1].value, slope_at(keys, i), slope_at(keys, i + 1),
                   length, u);
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
