#include "weather/readers/report_lines.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "weather/readers/metar_groups.h"
#include "weather/readers/text.h"

namespace petrichor::weather {

namespace {

constexpr std::size_t kOgimetDate = 1, kOgimetReport = 6;

std::string stamp_of(std::optional<std::int64_t> time_us)
{
    if (!time_us) return {};
    std::string digits;
    for (const char c : iso_from_us(*time_us)) {
        if (c >= '0' && c <= '9') digits += c;
    }
    return digits.substr(0, 12);
}

}  // namespace

bool is_ogimet_row(std::string_view line)
{
    if (line.size() < 22 || line[4] != ',' || line[9] != ',') return false;
    const auto f = split(line, ',', kOgimetReport + 1);
    if (f.size() != kOgimetReport + 1 || f[0].size() != 4) return false;
    const std::string_view report = trimmed(f[kOgimetReport]);
    const bool named = report.substr(0, 5) == "METAR" || report.substr(0, 5) == "SPECI" ||
                       report.substr(0, 3) == "TAF";
    return named && f[1].size() == 4 &&
           std::all_of(f.begin() + kOgimetDate, f.begin() + kOgimetReport, all_digits);
}

ReportLines::ReportLines(std::string_view text)
{
    Lines lines(text);
    while (const auto line = lines.next()) {
        const auto header = trimmed(*line);
        if (header.empty() || header.front() == '#') continue;
        const auto names = split(header, ',', 256);
        for (std::size_t i = 0; i < names.size() && names.size() > 1; ++i) {
            const std::string name = lower(trimmed(names[i]));
            if (name == "metar" || name == "raw_text" || name == "rawob") report_ = i;
            if (name == "valid" || name == "valid(utc)" || name == "observation_time" ||
                name == "time" || name == "datetime" || name == "report_time")
                time_ = i;
        }
        return;
    }
}

DatedText ReportLines::of(std::string_view line) const
{
    if (is_table()) {
        const auto cells = split(line, ',', 256);
        if (cells.size() <= report_) return {};
        DatedText out{.text = cells[report_], .whole = true};
        if (time_ < cells.size()) out.stamp = stamp_of(us_from_iso(cells[time_]));
        return out;
    }
    if (is_ogimet_row(line)) {
        const auto f = split(line, ',', kOgimetReport + 1);
        DatedText out{.text = f[kOgimetReport], .whole = true};
        for (std::size_t i = kOgimetDate; i < kOgimetReport; ++i) out.stamp.append(f[i]);
        return out;
    }
    // A line of its own: "2024/01/31 18:53".
    const auto date = trimmed(line);
    if (date.size() == 16 && date[4] == '/' && date[13] == ':') {
        if (const auto us = us_from_iso(date)) return {.stamp = stamp_of(us)};
    }
    return {.text = line};
}

}  // namespace petrichor::weather
