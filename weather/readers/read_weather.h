#ifndef PETRICHOR_WEATHER_READERS_READ_WEATHER_H
#define PETRICHOR_WEATHER_READERS_READ_WEATHER_H

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "weather/forcing/forcing.h"
#include "weather/readers/csv_times.h"
#include "weather/readers/taf.h"

namespace petrichor::weather {

struct Reader;  // formats.h: one kind of weather file

struct ReadOptions {
    Site site{};                    ///< values that are given (not NaN) replace those of the file
    bool heights_given = false;     ///< the site's sensor heights replace those of the file
    std::string station{};          ///< METAR: which station; empty: the one with most reports
    int year = 0, month = 0;        ///< METAR says only the day; 0: January 2020, with a note
    TafUse taf = TafUse::Expected;  ///< TAF: what to make of TEMPO and PROB groups
    std::size_t most_bytes = std::size_t{512} << 20;
    double utc_offset_h = kMissing;     ///< of the file's times, where it names no zone; -14..14
    DateOrder date_order =
        DateOrder::Unknown;  ///< of 01/02/2024; Unknown: as the file shows, else an error
    std::vector<std::string> ignore{};  ///< names of columns that may be left unread, or "all"
    bool fill = true;                   ///< run fill_forcing
    FillOptions filling{};
};

struct ReadResult {
    ForcingTable table;
    ReadReport report;
};

/// The kind of a text, by its first lines.
///   throws  Error when it is empty, binary, or of no known kind (names the kinds)
const Reader& recognise_weather(std::string_view text);

/// Reads a weather file of any known kind. Never opens files; memory is a small multiple of the
/// text.
///   throws  Error for a text that is empty, binary, larger than most_bytes, of unknown kind, or
///   too
///           damaged (lists the problems with line numbers)
ReadResult read_weather(std::string_view text, const ReadOptions& options = {});

}  // namespace petrichor::weather

#endif
