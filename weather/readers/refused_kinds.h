#ifndef PETRICHOR_WEATHER_READERS_REFUSED_KINDS_H
#define PETRICHOR_WEATHER_READERS_REFUSED_KINDS_H

#include "weather/readers/formats.h"

namespace petrichor::weather {

/// Files that are known by their looks and that nobody can read rightly, since they lack what a
/// reader would have to guess.
///   throws  Error that names the kind, what is lacking, and where to get it
void refuse_known_kinds(const FileHead& head);

}  // namespace petrichor::weather

#endif
