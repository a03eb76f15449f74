// Cubics between keys.
#ifndef PETRICHOR_BASE_CUBIC_H
#define PETRICHOR_BASE_CUBIC_H

namespace petrichor {

/// Hermite's cubic over a segment of `length`; u: 0 at its start, 1 at its end. Slopes are per unit of
/// length.
template <class Value>
Value hermite(const Value& from, const Value& to, const Value& slope_from, const Value& slope_to,
              double length, double u)
{
    const double u2 = u * u;
    const double u3 = u2 * u;
    return (2.0 * u3 - 3.0 * u2 + 1.0) * from + (u3 - 2.0 * u2 + u) * length * slope_from +
           (3.0 * u2 - 2.0 * u3) * to + (u3 - u2) * length * slope_to;
}

/// Slope at a key between two segments, for a curve that never overshoots: 0 at a local extreme, else the
/// weighted harmonic mean of the secants (Fritsch and Butland 1984; the region is that of Fritsch and
/// Carlson 1980).
inline double monotone_slope(double length_before, double secant_before, double length_after,
                             double secant_after)
{
    if (!(secant_before * secant_after > 0.0)) return 0.0;
    const double weight_before = 2.0 * length_after + length_before;
    const double weight_after = length_after + 2.0 * length_before;
    return (weight_before + weight_after) /
           (weight_before / secant_before + weight_after / secant_after);
}

}  // namespace petrichor

#endif
