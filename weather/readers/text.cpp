#include "weather/readers/text.h"

#include <charconv>
#include <cmath>
#include <cstdio>

namespace petrichor::weather {

std::optional<std::string_view> Lines::next()
{
    if (done_ || (rest_.empty() && number_ > 0)) return std::nullopt;
    if (rest_.empty()) {
        done_ = true;
        return std::nullopt;
    }
    std::size_t end = 0;
    while (end < rest_.size() && rest_[end] != '\n' && rest_[end] != '\r') ++end;
    ++number_;
    if (end == rest_.size()) {
        const auto line = rest_;
        rest_ = {};
        return line;
    }
    const auto line = rest_.substr(0, end);
    const bool pair = rest_[end] == '\r' && end + 1 < rest_.size() && rest_[end + 1] == '\n';
    rest_.remove_prefix(end + (pair ? 2 : 1));
    return line;
}

std::string_view trimmed(std::string_view text)
{
    const auto blank = [](char c) {
        return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\f' || c == '\v';
    };
    while (!text.empty() && blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && blank(text.back())) text.remove_suffix(1);
    return text;
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

std::vector<std::string_view> split(std::string_view line, char separator, std::size_t most)
{
    std::vector<std::string_view> fields;
    std::size_t begin = 0;
    bool quoted = false;
    for (std::size_t i = 0; i <= line.size(); ++i) {
        if (i < line.size() && line[i] == '"') quoted = !quoted;
        if (i < line.size() && (quoted || line[i] != separator)) continue;
        auto field = trimmed(line.substr(begin, i - begin));
        if (field.size() >= 2 && field.front() == '"' && field.back() == '"') {
            field = trimmed(field.substr(1, field.size() - 2));
        }
        fields.push_back(field);
        begin = i + 1;
        if (fields.size() >= most) break;
    }
    return fields;
}

std::vector<std::string_view> words(std::string_view line, std::size_t most)
{
    std::vector<std::string_view> fields;
    std::size_t i = 0;
    while (i < line.size() && fields.size() < most) {
        while (i < line.size() &&
               (line[i] == ' ' || line[i] == '\t' || line[i] == '\r' || line[i] == '\n'))
            ++i;
        std::size_t end = i;
        while (end < line.size() && line[end] != ' ' && line[end] != '\t' && line[end] != '\r' &&
               line[end] != '\n')
            ++end;
        if (end > i) fields.push_back(line.substr(i, end - i));
        i = end;
    }
    return fields;
}

std::optional<double> to_number(std::string_view text)
{
    text = trimmed(text);
    if (!text.empty() && text.front() == '+') text.remove_prefix(1);
    if (text.empty()) return std::nullopt;
    double value = 0.0;
    const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (failed != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
        return std::nullopt;
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

}  // namespace petrichor::weather
