#ifndef PETRICHOR_WEATHER_READERS_JOIN_H
#define PETRICHOR_WEATHER_READERS_JOIN_H

#include <string>
#include <string_view>
#include <vector>

#include "weather/readers/read_weather.h"

namespace petrichor::weather {

struct NamedText {
    std::string name;  ///< of the file, for messages
    std::string_view text;
};

/// Reads several weather files of one place as one series, in order of time: months of a year, days
/// of reports.
///
/// Kinds may differ. The site is that of the first file. A column that one file lacks is filled
/// there like any other missing value. With one file the same as read_weather.
/// Files over the same time may hold different quantities; their columns are put side by side.
///   throws  Error as read_weather (with the file's name), and when two files overlap and hold the
///           same quantity
ReadResult read_weather_files(const std::vector<NamedText>& files, const ReadOptions& options = {});

}  // namespace petrichor::weather

#endif
