#ifndef PETRICHOR_WEATHER_READERS_REPORT_LINES_H
#define PETRICHOR_WEATHER_READERS_REPORT_LINES_H

#include <cstddef>
#include <string>
#include <string_view>

namespace petrichor::weather {

/// Part of a line that belongs to reports, and the date that stands with it.
struct DatedText {
    std::string stamp{};  ///< YYYYMMDDhhmm, or nothing
    std::string_view text{};
    bool whole = false;  ///< the report begins and ends here
};

/// How archives wrap METAR: bare lines; lines below "2024/01/31 18:53"; tables with a column
/// "metar" or "raw_text" beside one of times (Iowa Environmental Mesonet, Aviation Weather Center);
/// rows "EDDF,2024,01,31,18,50,METAR .." (Ogimet).
class ReportLines {
public:
    /// Looks for the header of a table at the beginning of a text.
    explicit ReportLines(std::string_view text);
    bool is_table() const { return report_ != kNone; }
    DatedText of(std::string_view line) const;

private:
    static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
    std::size_t report_ = kNone, time_ = kNone;
};

/// Whether a line is a row of the Ogimet kind.
bool is_ogimet_row(std::string_view line);

}  // namespace petrichor::weather

#endif
