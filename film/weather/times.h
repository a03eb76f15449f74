#ifndef PETRICHOR_FILM_WEATHER_TIMES_H
#define PETRICHOR_FILM_WEATHER_TIMES_H

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace petrichor::film {

/// A positive number of seconds without rounding: 1/60 is 1/60.
struct Fraction {
    std::int64_t numerator = 1;
    std::int64_t denominator = 1;

    double value() const
    {
        return static_cast<double>(numerator) / static_cast<double>(denominator);
    }
};
/// "0.25", "2", "1/60"; at most 9 digits on either side of the stroke or point. Throws Error that
/// names `option` for anything else, and for zero.
Fraction parse_fraction(std::string_view text, const std::string& option);

/// The same with an optional unit: "90", "1/60", "30min", "6h", "1d", "0.5 s".
Fraction parse_duration(std::string_view text, const std::string& option);

/// A time of a run, in seconds from its start.
///
/// Numbers are seconds; "6h" and "1d" are spans from the start, too. With `start_us` (microseconds since 1970 of second 0) also dates in ISO
/// 8601
/// ("2005-12-01", "2005-12-01T06:00+01:00"; without a zone `offset_s` ahead of UTC), and month and
/// day alone ("01-15", "01-15T12:00"): the first such day from the start on, for typical years.
///   throws  Error that names `option`, and says when dates cannot be used
double parse_time(const std::string& text, const std::string& option,
                  std::optional<std::int64_t> start_us, double offset_s = 0.0);

}  // namespace petrichor::film

#endif
