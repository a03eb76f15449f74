#ifndef PETRICHOR_WEATHER_READERS_TABLES_H
#define PETRICHOR_WEATHER_READERS_TABLES_H

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "weather/readers/collector.h"
#include "weather/readers/read_weather.h"
#include "weather/readers/text.h"

// What readers of archive tables (a header of fixed names, a row a time) share.
namespace petrichor::weather {

/// How a column of a known name becomes a field.
struct TableColumn {
    std::string_view name;  ///< lower case, as in the header
    Field field;
    double scale = 1.0, offset = 0.0;
    double fell_hours = 0.0;  ///< above 0: an amount, kg/m2 after scaling, of so many hours before
};

/// The names of a header line, lower case, without quotes and blanks around them.
class TableHeader {
public:
    static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
    TableHeader(std::string_view line, char separator);
    /// kNone when there is no such column. Who asks for a column reads it: see unread().
    std::size_t at(std::string_view name) const;
    bool has(std::string_view name) const { return at(name) != kNone; }
    std::size_t size() const { return names_.size(); }
    const std::vector<std::string>& names() const { return names_; }
    /// The columns that nobody has asked for.
    std::vector<std::string> unread() const;

private:
    std::vector<std::string> names_;
    mutable std::vector<bool> asked_;
};

/// The cell of a column, empty where the row or the header has none.
inline std::string_view cell_of(const std::vector<std::string_view>& cells, std::size_t at)
{
    return at < cells.size() ? cells[at] : std::string_view{};
}

/// Reads the rows below a header, and notes the columns that were not read.
///   time_of  when a row is; nothing: a bad row
///   value_of the number of a cell, nothing: the file says that there is none
///   also     called for every accepted row, for what columns alone cannot say; may be empty
struct TableRows {
    char separator = ',';
    std::span<const TableColumn> columns;
    std::function<std::optional<std::int64_t>(const std::vector<std::string_view>&)> time_of;
    std::function<std::optional<double>(std::string_view)> value_of;
    std::function<void(const std::vector<std::string_view>&)> also;
    std::function<bool(const std::vector<std::string_view>&)> skip;  ///< rows that are no weather
};
void read_table_rows(Lines& lines, const TableHeader& header, const TableRows& how,
                     RowCollector& rows);

/// Pressure at a height from that at sea level, Pa: dry air that cools by 6.5 K a kilometre.
double station_pressure_pa(double sea_level_pa, double elevation_m, double air_k);

/// Standard time of the zone that a longitude lies in, whole hours east (Newfoundland's half hour
/// kept): for files that name local standard time and not the zone. Throws Error outside -180..360.
double zone_of_longitude_h(double longitude_deg);

/// Says that a file writes the clock of its place and not which one that is, unless --file-zone does.
void note_unknown_zone(RowCollector& rows, const ReadOptions& options, const char* clock);

/// What present weather in METAR words ("-SN BR", "FZRA") falls as, mm/h.
struct PresentWeather {
    bool falls = false;
    double rain_mm_h = 0.0, snow_mm_h = 0.0;
    double snow_share() const { return falls ? snow_mm_h / (rain_mm_h + snow_mm_h) : kMissing; }
};
PresentWeather present_weather(std::string_view words);
/// The same from WMO codes: table 4677 (manned) or 4680 (automatic), 0..99.
PresentWeather weather_of_code(int code, bool automatic);

/// Cloud from words such as FEW, SCT, BKN, OVC, CLR (FMH-1), or NaN.
double cloud_of_word(std::string_view word);

}  // namespace petrichor::weather

#endif
