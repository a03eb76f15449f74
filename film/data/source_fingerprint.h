#ifndef PETRICHOR_FILM_DATA_SOURCE_FINGERPRINT_H
#define PETRICHOR_FILM_DATA_SOURCE_FINGERPRINT_H

namespace petrichor::film {

/// Fingerprint of the program's sources that decide what generated scenes and finished textures
/// look like: part of every key of the cache (base/content_cache.h), so that a program never finds
/// what another version made.
const char* source_fingerprint();

}  // namespace petrichor::film

#endif
