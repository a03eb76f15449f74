#include "film/weather/times.h"

#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "weather/readers/text.h"

namespace petrichor::film {
namespace {

[[noreturn]] void refuse_duration(std::string_view text, const std::string& option)
{
    throw Error(option + ": \"" + std::string(text) +
                    "\" is not a time span above 0, like 0.5, 1/60, 30min, 6h or 1d",
                "Give a decimal number or a fraction of two whole numbers, with s, min, h or d "
                "behind it if you like.");
}

// A whole number of at most nine digits, or -1.
std::int64_t whole(std::string_view digits)
{
    std::int64_t value = -1;
    const auto result = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    const bool good = result.ec == std::errc() && result.ptr == digits.data() + digits.size() &&
                      digits.size() <= 9 && digits.front() != '-';
    return good ? value : -1;
}

// Numerator 0 when the text is not a fraction.
Fraction fraction_from(std::string_view text)
{
    const std::size_t stroke = text.find('/');
    const std::size_t point = text.find('.');
    if (text.empty()) return {0, 1};
    if (stroke != text.npos) {
        if (stroke == 0 || stroke + 1 == text.size()) return {0, 1};
        return {whole(text.substr(0, stroke)), whole(text.substr(stroke + 1))};
    }
    if (point == text.npos) return {whole(text), 1};
    const std::string_view decimals = text.substr(point + 1);
    if ((point == 0 && decimals.empty()) || decimals.size() > 9) return {0, 1};
    Fraction fraction;
    for (std::size_t i = 0; i < decimals.size(); ++i) fraction.denominator *= 10;
    const std::int64_t before = point > 0 ? whole(text.substr(0, point)) : 0;
    const std::int64_t after = decimals.empty() ? 0 : whole(decimals);
    fraction.numerator = before < 0 || after < 0 ? -1 : before * fraction.denominator + after;
    return fraction;
}

// "01-15" and "01-15T12:00": a month and a day without a year.
bool is_month_and_day(std::string_view text)
{
    const auto digit = [&](std::size_t i) { return text[i] >= '0' && text[i] <= '9'; };
    return text.size() >= 5 && digit(0) && digit(1) && text[2] == '-' && digit(3) && digit(4) &&
           (text.size() == 5 || text[5] == 'T' || text[5] == ' ');
}

// "30min", "6h": in seconds, as fraction_from. Nothing without a unit.
std::optional<Fraction> span_with_unit(std::string_view text)
{
    constexpr std::array<std::pair<std::string_view, std::int64_t>, 4> kUnits{
        {{"min", 60}, {"h", 3600}, {"d", 86400}, {"s", 1}}};
    for (const auto& [unit, seconds] : kUnits) {
        if (text.size() <= unit.size() || text.substr(text.size() - unit.size()) != unit) continue;
        Fraction fraction =
            fraction_from(weather::trimmed(text.substr(0, text.size() - unit.size())));
        fraction.numerator *= seconds;
        return fraction;
    }
    return std::nullopt;
}

}  // namespace

Fraction parse_fraction(std::string_view text, const std::string& option)
{
    const Fraction fraction = fraction_from(text);
    if (fraction.numerator <= 0 || fraction.denominator <= 0) refuse_duration(text, option);
    return fraction;
}

Fraction parse_duration(std::string_view text, const std::string& option)
{
    if (const auto span = span_with_unit(text)) {
        if (span->numerator <= 0 || span->denominator <= 0) refuse_duration(text, option);
        return *span;
    }
    return parse_fraction(text, option);
}

double parse_time(const std::string& text, const std::string& option,
                  std::optional<std::int64_t> start_us, double offset_s)
{
    if (const auto seconds = weather::to_number(text)) {
        if (*seconds >= 0.0 && *seconds <= 9e9) return *seconds;
        throw Error(option + ": times are seconds from 0 up, got " + text,
                    "Give a time from the start of the run.");
    }
    if (const auto span = span_with_unit(text); span && span->numerator > 0 && span->denominator > 0)
        return span->value();
    const auto seconds_of = [&](std::int64_t us) {
        return static_cast<double>(us - *start_us) * 1e-6;
    };
    if (!start_us) {
        if (weather::us_from_iso(text) || is_month_and_day(text)) {
            throw Error(option + ": \"" + text + "\" is a date, but keys count seconds",
                        "Give seconds from the start of the run.");
        }
        throw Error(option + ": \"" + text + "\" is neither seconds nor a span as 6h or 1d",
                    "Give seconds from the start of the run.");
    }
    if (is_month_and_day(text)) {
        const long long year =
            weather::civil_from_us(*start_us + static_cast<std::int64_t>(offset_s * 1e6)).year;
        for (const long long y : {year, year + 1}) {
            const auto us = weather::us_from_iso(std::to_string(y) + "-" + text, offset_s);
            if (us && *us >= *start_us) return seconds_of(*us);
            // The first hours of 1 January may lie before the first row, where the file's clock is
            // behind UTC.
            if (us && *us > *start_us - 86400LL * 1000000) return 0.0;
        }
    } else if (const auto us = weather::us_from_iso(text, offset_s)) {
        return seconds_of(*us);
    }
    throw Error(option + ": \"" + text +
                    "\" is neither seconds, a span as 6h or 1d, nor a date as 2005-12-01, 2005-12-01T06:00 or 12-01",
                "The weather begins at " + weather::iso_from_us(*start_us, offset_s) + ".");
}

}  // namespace petrichor::film
