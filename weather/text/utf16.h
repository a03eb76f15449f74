#ifndef PETRICHOR_WEATHER_TEXT_UTF16_H
#define PETRICHOR_WEATHER_TEXT_UTF16_H

#include <string>
#include <string_view>

namespace petrichor::weather {

/// Whether a text begins with the byte order mark of UTF-16, as "Unicode Text" of spreadsheets
/// does.
bool is_utf16(std::string_view bytes);

/// Such a text in UTF-8, without its mark. Halves of pairs become U+FFFD.
///   throws  Error for an odd number of bytes
std::string utf8_of_utf16(std::string_view bytes);

}  // namespace petrichor::weather

#endif
