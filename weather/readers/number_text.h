#ifndef PETRICHOR_WEATHER_READERS_NUMBER_TEXT_H
#define PETRICHOR_WEATHER_READERS_NUMBER_TEXT_H

#include <string>

namespace petrichor::weather {

/// A number as messages about a file say it: six digits.
std::string number_text(double value);

}  // namespace petrichor::weather

#endif
