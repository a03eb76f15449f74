#ifndef PETRICHOR_WEATHER_READERS_TEXT_H
#define PETRICHOR_WEATHER_READERS_TEXT_H

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace petrichor::weather {

// Words that all readers share: lines, fields, numbers, calendar. Nothing here allocates per
// character or trusts its input.

/// Lines of a text with their 1-based numbers; accepts \n, \r\n and \r.
class Lines {
public:
    explicit Lines(std::string_view text);
    /// The next line without its end, or nothing.
    std::optional<std::string_view> next();
    std::size_t number() const { return number_; }

private:
    std::string_view text_;
    std::size_t at_ = 0;
    std::size_t newline_ = 0;  // the next \n at or after at_; found once, also in a file of \r
    std::size_t number_ = 0;
};

inline bool is_blank(char c)
{
    return c == ' ' || (c >= '\t' && c <= '\r');
}
inline std::string_view trimmed(std::string_view text)
{
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    return text;
}
std::string lower(std::string_view text);
/// A piece of a file for a message: at most 40 printable characters.
std::string shown(std::string_view text);
/// Fields between separators; quotes protect separators and are removed. At most `most` fields.
std::vector<std::string_view> split(std::string_view line, char separator, std::size_t most = 4096);
/// The same into a vector that is used again for the next line: no allocation a line.
void split(std::string_view line, char separator, std::vector<std::string_view>& fields,
           std::size_t most = 4096);
/// Fields between runs of blanks.
std::vector<std::string_view> words(std::string_view line, std::size_t most = 4096);
void words(std::string_view line, std::vector<std::string_view>& fields, std::size_t most = 4096);
/// The whole text as a finite number (a leading + and surrounding blanks are fine), or nothing.
std::optional<double> to_number(std::string_view text);
std::optional<long long> to_integer(std::string_view text);

bool is_leap_year(long long year);
/// Days since 1970-01-01 of a Gregorian date.
std::int64_t days_from_civil(long long year, int month, int day);
struct CivilTime {
    long long year = 1970;
    int month = 1, day = 1, hour = 0, minute = 0;
    double second = 0.0;
};
CivilTime civil_from_us(std::int64_t time_us);
/// Microseconds since 1970 of a date and time; nothing when the date does not exist (31 April, ..)
/// or the year is outside 1500..2600. Hour 24 means the end of the day.
std::optional<std::int64_t> us_from_civil(const CivilTime& time);
/// ISO 8601 ("2005-10-01T06:30:15.5Z", "+02:00" up to 14 h, a blank for T, no seconds, date only), or nothing.
/// A time without a zone is taken as UTC plus `default_offset_s`.
std::optional<std::int64_t> us_from_iso(std::string_view text, double default_offset_s = 0.0);
/// "2005-10-01T06:30:00Z"; fractions of a second only when there are any.
std::string iso_from_us(std::int64_t time_us);
/// The same on a clock ahead of UTC by whole minutes: "2005-10-01T07:30:00+01:00"; Z where it is not.
std::string iso_from_us(std::int64_t time_us, double offset_s);

}  // namespace petrichor::weather

#endif
