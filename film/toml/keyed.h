#ifndef PETRICHOR_FILM_TOML_KEYED_H
#define PETRICHOR_FILM_TOML_KEYED_H

#include <glm/glm.hpp>
#include <vector>

namespace petrichor::film {

enum class Interpolation {
    Hold,    ///< the last key at or before the time
    Linear,  ///< straight lines
    Smooth,  ///< cubic; numbers never overshoot their keys, paths keep their speed through a key
};

struct NumberKey {
    double time_s = 0.0;
    double value = 0.0;
};

/// A number that may change over time. Times ascend strictly; before the first key and after the
/// last the value is that key's.
struct KeyedNumber {
    std::vector<NumberKey> keys;
    Interpolation interpolation = Interpolation::Smooth;

    bool given() const { return !keys.empty(); }
};

/// The value at a time; `otherwise` when there are no keys. Smooth is the monotone cubic of Fritsch
/// and Carlson 1980 (harmonic means), so the value stays between its neighbouring keys.
double value_at(const KeyedNumber& number, double time_s, double otherwise = 0.0);

struct PathKey {
    double time_s = 0.0;
    glm::dvec3 point{0.0};
};

/// A point on a path through keys; smooth is the Catmull-Rom spline for unequal times, which passes
/// through every key with a steady velocity. Times ascend strictly; at least one key.
glm::dvec3 point_at(const std::vector<PathKey>& keys, Interpolation interpolation, double time_s);

}  // namespace petrichor::film

#endif
