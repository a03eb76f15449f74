#include "weather/readers/tables.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/error.h"
#include "weather/physics/constants.h"
#include "weather/readers/metar.h"
#include "weather/readers/table_rows.h"

namespace petrichor::weather {

TableHeader::TableHeader(std::string_view line, char separator)
{
    for (const auto name : split(line, separator, 1024)) names_.push_back(lower(trimmed(name)));
    asked_.assign(names_.size(), false);
}

std::size_t TableHeader::at(std::string_view name) const
{
    const auto found = std::find(names_.begin(), names_.end(), name);
    if (found == names_.end()) return kNone;
    const auto index = static_cast<std::size_t>(found - names_.begin());
    asked_[index] = true;
    return index;
}

std::vector<std::string> TableHeader::unread() const
{
    std::vector<std::string> out;
    for (std::size_t i = 0; i < names_.size(); ++i)
        if (!asked_[i]) out.push_back(names_[i]);
    return out;
}

void read_table_rows(Lines& lines, const TableHeader& header, const TableRows& how,
                     RowCollector& rows)
{
    struct Column {
        const TableColumn* meaning;
        std::size_t at;
    };
    std::vector<Column> columns;
    for (const TableColumn& c : how.columns) {
        if (header.has(c.name)) columns.push_back({&c, header.at(c.name)});
    }
    const DatedRows dated{how.separator, how.time_of, how.skip};
    for_dated_rows(lines, dated, rows, [&](const DatedRow& row) {
        if (!rows.begin_row(row.time_us, row.line)) return;
        for (const Column& c : columns) {
            const auto cell = cell_of(row.cells, c.at);
            put_cell(*c.meaning, cell, how.value_of(cell), rows);
        }
        if (how.also) how.also(row.cells);
    });
    rows.unread_columns(header.unread());
}

double station_pressure_pa(double sea_level_pa, double elevation_m, double air_k)
{
    if (std::isnan(elevation_m)) return sea_level_pa;
    const double t = std::isnan(air_k) ? 288.15 : air_k;
    return sea_level_pa * std::exp(-kGravity_m_s2 * elevation_m /
                                   (kAirGasConstant * (t + 0.5 * kLapseRate_k_m * elevation_m)));
}

double zone_of_longitude_h(double longitude_deg)
{
    if (std::isnan(longitude_deg)) return 0.0;
    if (!(longitude_deg >= -180.0 && longitude_deg <= 360.0)) {
        char said[120];
        std::snprintf(said, sizeof said, "weather: longitude %g is outside -180..360",
                      longitude_deg);
        throw Error(said, "Mend the file, or give the place with --longitude.");
    }
    if (longitude_deg > -59.5 && longitude_deg < -52.0) return -3.5;
    return std::round(longitude_deg / 15.0);
}

void note_unknown_zone(RowCollector& rows, const ReadOptions& options, const char* clock)
{
    if (!std::isnan(options.utc_offset_h)) return;
    rows.note(ReadNote::Kind::Warning, 0, "time",
              std::string("the file's clock is ") + clock +
                  ", whose zone it does not name: taken as UTC; --file-zone HOURS says another");
}

PresentWeather present_weather(std::string_view words)
{
    if (trimmed(words).empty()) return {};
    std::string report = "XXXX 010000Z ";
    report.append(words.substr(0, 80));
    const auto parsed = parse_metar(report);
    if (!parsed || !parsed->weather_seen) return {};
    const double sum = parsed->rain_mm_h + parsed->snow_mm_h;
    return {sum > 0.0, parsed->rain_mm_h, parsed->snow_mm_h};
}

PresentWeather weather_of_code(int code, bool automatic)
{
    constexpr double kDrizzle[] = {0.1, 0.3, 0.8}, kRain[] = {1.0, 4.5, 12.0},
                     kSnow[] = {0.5, 1.5, 3.0};
    const auto rain = [](double mm_h) { return PresentWeather{true, mm_h, 0.0}; };
    const auto snow = [](double mm_h) { return PresentWeather{true, 0.0, mm_h}; };
    const auto both = [](double mm_h) { return PresentWeather{true, 0.5 * mm_h, 0.5 * mm_h}; };
    const int tens = code / 10, ones = code % 10;
    if (automatic) {
        const auto grade = [&](int from) { return std::clamp(ones - from, 0, 2); };
        if (tens == 5) return rain(kDrizzle[ones <= 3 ? grade(1) : grade(4)]);
        if (tens == 6) {
            if (ones >= 7) return both(kRain[grade(7)]);
            return rain(kRain[ones <= 3 ? grade(1) : grade(4)]);
        }
        if (tens == 7) return ones == 8 ? PresentWeather{} : snow(kSnow[ones <= 3 ? grade(1) : 0]);
        if (tens == 8) {
            if (ones >= 5 && ones <= 7) return snow(kSnow[grade(5)]);
            return rain(kRain[grade(1)]);
        }
        if (code == 92 || code == 93 || code == 95) return rain(kRain[1]);
        if (code == 96) return rain(kRain[2]);
        if (code >= 41 && code <= 44) return rain(kRain[code % 2 == 1 ? 0 : 2]);
        if (code >= 45 && code <= 46) return snow(kSnow[code == 45 ? 0 : 2]);
        return {};
    }
    const int grade = std::min(ones / 2, 2);
    if (tens == 5) return rain(kDrizzle[ones >= 6 ? (ones % 2 ? 1 : 0) : grade]);
    if (tens == 6) {
        if (ones >= 8) return both(kRain[ones - 8]);
        return rain(kRain[ones >= 6 ? ones - 6 : grade]);
    }
    if (tens == 7) return ones == 6 ? PresentWeather{} : snow(kSnow[ones < 6 ? grade : 0]);
    if (tens == 8) {
        if (ones <= 2) return rain(kRain[ones]);
        if (ones <= 4) return both(kRain[ones - 3]);
        if (ones <= 6) return snow(kSnow[ones - 5]);
        return snow(kSnow[0]);
    }
    if (tens == 9) return rain(kRain[ones == 2 || ones >= 7 ? 2 : ones == 1 ? 0 : 1]);
    return {};
}

double cloud_of_word(std::string_view word)
{
    const auto kind = word.substr(0, 3);
    if (kind == "CLR" || kind == "SKC" || kind == "NSC" || kind == "NCD") return 0.0;
    if (kind == "FEW") return 0.1875;
    if (kind == "SCT") return 0.4375;
    if (kind == "BKN") return 0.75;
    if (kind == "OVC" || word.substr(0, 2) == "VV") return 1.0;
    return kMissing;
}

}  // namespace petrichor::weather
