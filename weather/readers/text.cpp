#include "weather/readers/text.h"

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "weather/forcing/forcing.h"

namespace petrichor::weather {

Lines::Lines(std::string_view text) : text_(text), newline_(text.find('\n'))
{
}

std::optional<std::string_view> Lines::next()
{
    if (at_ >= text_.size()) return std::nullopt;
    if (newline_ != std::string_view::npos && newline_ < at_) newline_ = text_.find('\n', at_);
    ++number_;
    auto line = text_.substr(at_, newline_ - at_);  // to the end when there is no \n
    std::size_t end_length = 1;
    if (const auto cr = line.find('\r'); cr != std::string_view::npos) {
        end_length = at_ + cr + 1 == newline_ ? 2 : 1;
        line = line.substr(0, cr);
    }
    at_ += line.size() + end_length;
    return line;
}

std::string lower(std::string_view text)
{
    std::string out(text);
    for (char& c : out) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return out;
}

std::string shown(std::string_view text)
{
    std::string out;
    for (const char c : text.substr(0, 40)) out += c >= ' ' && c < 0x7f ? c : '?';
    if (text.size() > 40) out += "...";
    return out;
}

namespace {

// Where a character is, eight at a time; fields are short, so this beats a call of memchr.
const char* find_near(const char* at, const char* end, char wanted)
{
    constexpr std::uint64_t kOnes = 0x0101010101010101u, kTops = 0x8080808080808080u;
    if constexpr (std::endian::native == std::endian::little) {
        const std::uint64_t eight = kOnes * static_cast<unsigned char>(wanted);
        for (; end - at >= 8; at += 8) {
            std::uint64_t word = 0;
            std::memcpy(&word, at, 8);
            word ^= eight;  // a byte that matches is now 0; the lowest such byte is found exactly
            const std::uint64_t found = (word - kOnes) & ~word & kTops;
            if (found) return at + std::countr_zero(found) / 8;
        }
    }
    while (at < end && *at != wanted) ++at;
    return at;
}

}  // namespace

void split(std::string_view line, char separator, std::vector<std::string_view>& fields,
           std::size_t most)
{
    fields.clear();
    const char* const end = line.data() + line.size();
    const bool quotes = line.find('"') != std::string_view::npos;
    const char* at = line.data();
    while (fields.size() < most) {
        const char* const begin = at;
        if (quotes) {
            bool quoted = false;
            for (; at < end && (*at != separator || quoted); ++at) quoted ^= *at == '"';
        } else {
            at = find_near(at, end, separator);
        }
        auto field = trimmed({begin, static_cast<std::size_t>(at - begin)});
        if (quotes && field.size() >= 2 && field.front() == '"' && field.back() == '"') {
            field = trimmed(field.substr(1, field.size() - 2));
        }
        fields.push_back(field);
        if (at == end) break;
        ++at;
    }
}

std::vector<std::string_view> split(std::string_view line, char separator, std::size_t most)
{
    std::vector<std::string_view> fields;
    split(line, separator, fields, most);
    return fields;
}

void words(std::string_view line, std::vector<std::string_view>& fields, std::size_t most)
{
    const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; };
    fields.clear();
    std::size_t i = 0;
    while (i < line.size() && fields.size() < most) {
        while (i < line.size() && blank(line[i])) ++i;
        std::size_t end = i;
        while (end < line.size() && !blank(line[end])) ++end;
        if (end > i) fields.push_back(line.substr(i, end - i));
        i = end;
    }
}

std::vector<std::string_view> words(std::string_view line, std::size_t most)
{
    std::vector<std::string_view> fields;
    words(line, fields, most);
    return fields;
}

namespace {

// A short decimal such as -12.5: its digits are a whole number below 2^53 and so is the power of
// ten, thus one division rounds once and gives the very double that from_chars gives. Returns NaN
// for anything else (exponents, 16 digits or more, no digit before or after the point).
double short_decimal(const char* at, const char* end)
{
    constexpr double kPower[] = {1e0, 1e1, 1e2,  1e3,  1e4,  1e5,  1e6, 1e7,
                                 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14};
    const bool minus = *at == '-';
    at += minus;
    const char* const begin = at;
    std::int64_t digits = 0;
    const auto take_digits = [&] {
        for (; at < end; ++at) {
            const unsigned digit = static_cast<unsigned char>(*at) - unsigned{'0'};
            if (digit > 9) break;
            digits = digits * 10 + digit;
        }
    };
    if (end - begin > 16) return kMissing;
    take_digits();
    if (at == begin || (at == end && at - begin > 15)) return kMissing;
    double value = static_cast<double>(digits);
    if (at < end) {
        const char* const point = at++;
        if (*point != '.' || at == end) return kMissing;
        take_digits();
        if (at < end) return kMissing;
        value = static_cast<double>(digits) / kPower[end - point - 1];
    }
    return minus ? -value : value;
}

// Apart, so that its many registers do not slow down the short ones.
[[gnu::noinline]] double any_decimal(const char* at, const char* end)
{
    double value = 0.0;
    const auto [stop, failed] = std::from_chars(at, end, value);
    return failed == std::errc{} && stop == end && std::isfinite(value) ? value : kMissing;
}

}  // namespace

std::optional<double> to_number(std::string_view text)
{
    const char* at = text.data();
    const char* end = at + text.size();
    while (at < end && is_blank(*at)) ++at;
    while (at < end && is_blank(end[-1])) --end;
    if (at < end && *at == '+') ++at;
    if (at == end) return std::nullopt;
    double value = short_decimal(at, end);
    if (std::isnan(value)) value = any_decimal(at, end);
    if (std::isnan(value)) return std::nullopt;
    return value;
}

std::optional<long long> to_integer(std::string_view text)
{
    text = trimmed(text);
    if (!text.empty() && text.front() == '+') text.remove_prefix(1);
    long long value = 0;
    const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (text.empty() || failed != std::errc{} || end != text.data() + text.size())
        return std::nullopt;
    return value;
}

bool is_leap_year(long long year)
{
    return (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
}

std::int64_t days_from_civil(long long year, int month, int day)
{
    // Years that begin in March put the leap day last; 719468 days from 0000-03-01 to 1970-01-01.
    const long long y = month > 2 ? year : year - 1;
    const long long era = (y >= 0 ? y : y - 399) / 400;
    const long long of_era = y - era * 400;
    const long long of_year = (153 * (month + (month > 2 ? -3 : 9)) + 2) / 5 + day - 1;
    return era * 146097 + of_era * 365 + of_era / 4 - of_era / 100 + of_year - 719468;
}

CivilTime civil_from_us(std::int64_t time_us)
{
    std::int64_t day = time_us / 86400000000LL;
    std::int64_t rest = time_us % 86400000000LL;
    if (rest < 0) {
        rest += 86400000000LL;
        --day;
    }
    CivilTime out;
    // Guess the year, then walk: at most two corrections.
    out.year = 1970 + static_cast<long long>(std::floor(static_cast<double>(day) / 365.2425));
    while (days_from_civil(out.year, 1, 1) > day) --out.year;
    while (days_from_civil(out.year + 1, 1, 1) <= day) ++out.year;
    out.month = 1;
    while (out.month < 12 && days_from_civil(out.year, out.month + 1, 1) <= day) ++out.month;
    out.day = static_cast<int>(day - days_from_civil(out.year, out.month, 1)) + 1;
    out.hour = static_cast<int>(rest / 3600000000LL);
    out.minute = static_cast<int>(rest / 60000000LL % 60);
    out.second = static_cast<double>(rest % 60000000LL) * 1e-6;
    return out;
}

std::optional<std::int64_t> us_from_civil(const CivilTime& t)
{
    if (t.year < 1500 || t.year > 2600 || t.month < 1 || t.month > 12 || t.day < 1)
        return std::nullopt;
    constexpr int kDays[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    const int days = kDays[t.month - 1] + (t.month == 2 && is_leap_year(t.year) ? 1 : 0);
    if (t.day > days || t.hour < 0 || t.hour > 24 || t.minute < 0 || t.minute > 60)
        return std::nullopt;
    if (!(t.second >= 0.0 && t.second < 61.0)) return std::nullopt;
    return days_from_civil(t.year, t.month, t.day) * 86400000000LL + t.hour * 3600000000LL +
           t.minute * 60000000LL + static_cast<std::int64_t>(std::llround(t.second * 1e6));
}

std::optional<std::int64_t> us_from_iso(std::string_view text, double default_offset_s)
{
    text = trimmed(text);
    CivilTime t;
    std::size_t at = 0;
    const auto digits = [&](std::size_t count) -> std::optional<int> {
        if (at + count > text.size()) return std::nullopt;
        int value = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const char c = text[at + i];
            if (c < '0' || c > '9') return std::nullopt;
            value = value * 10 + (c - '0');
        }
        at += count;
        return value;
    };
    const auto skip = [&](char c) {
        if (at < text.size() && text[at] == c) {
            ++at;
            return true;
        }
        return false;
    };
    const auto year = digits(4);
    if (!year) return std::nullopt;
    const bool dashed = skip('-') || skip('/');
    const auto month = digits(2);
    if (dashed && !(skip('-') || skip('/'))) return std::nullopt;
    const auto day = digits(2);
    if (!month || !day) return std::nullopt;
    t.year = *year;
    t.month = *month;
    t.day = *day;
    double offset = default_offset_s;
    if (skip('T') || skip(' ') || skip('t')) {
        const auto hour = digits(2);
        if (!hour) return std::nullopt;
        t.hour = *hour;
        skip(':');
        if (const auto minute = digits(2)) {
            t.minute = *minute;
            skip(':');
            if (const auto second = digits(2)) {
                t.second = *second;
                if (skip('.') || skip(',')) {
                    double unit = 0.1;
                    while (const auto digit = digits(1)) {
                        t.second += *digit * unit;
                        unit *= 0.1;
                    }
                }
            }
        }
        while (skip(' ')) {
        }
        if (skip('Z') || skip('z')) {
            offset = 0.0;
        } else if (at < text.size() && (text[at] == '+' || text[at] == '-')) {
            const double sign = text[at++] == '-' ? -1.0 : 1.0;
            const auto hours = digits(2);
            if (!hours) return std::nullopt;
            skip(':');
            const auto minutes = digits(2);
            // Clocks of places are -12 to +14 h from UTC.
            if (*hours > 14 || minutes.value_or(0) > 59) return std::nullopt;
            offset = sign * (*hours * 3600.0 + minutes.value_or(0) * 60.0);
        } else if (text.substr(at) == "UTC" || text.substr(at) == "GMT") {
            at = text.size();
            offset = 0.0;
        }
    }
    if (at != text.size()) return std::nullopt;
    const auto us = us_from_civil(t);
    if (!us) return std::nullopt;
    return *us - static_cast<std::int64_t>(std::llround(offset * 1e6));
}

std::string iso_from_us(std::int64_t time_us)
{
    const CivilTime t = civil_from_us(time_us);
    char out[48];
    const auto whole = static_cast<int>(t.second);
    const std::int64_t fraction = ((time_us % 1000000) + 1000000) % 1000000;
    int n = std::snprintf(out, sizeof out, "%04lld-%02d-%02dT%02d:%02d:%02d", t.year, t.month,
                          t.day, t.hour, t.minute, whole);
    if (fraction)
        n += std::snprintf(out + n, sizeof out - static_cast<std::size_t>(n), ".%06lld",
                           static_cast<long long>(fraction));
    return std::string(out, static_cast<std::size_t>(n)) + "Z";
}

std::string iso_from_us(std::int64_t time_us, double offset_s)
{
    const auto minutes = static_cast<int>(std::lround(offset_s / 60.0));
    std::string text = iso_from_us(time_us + std::int64_t{minutes} * 60'000'000);
    if (minutes == 0) return text;
    char zone[16];
    std::snprintf(zone, sizeof zone, "%c%02d:%02d", minutes < 0 ? '-' : '+', std::abs(minutes) / 60,
                  std::abs(minutes) % 60);
    text.replace(text.size() - 1, 1, zone);
    return text;
}

}  // namespace petrichor::weather
