#ifndef PETRICHOR_WEATHER_PACKED_ARCHIVE_H
#define PETRICHOR_WEATHER_PACKED_ARCHIVE_H

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace petrichor::weather::packed {

bool is_gzip(std::span<const std::byte> bytes);
bool is_zip(std::span<const std::byte> bytes);

/// The content of a gzip file (all its members), at most `most` bytes.
///   throws  Error when it is damaged or larger
std::vector<std::byte> gunzipped(std::span<const std::byte> bytes, std::size_t most);

struct Entry {
    std::string name;
    std::vector<std::byte> bytes;
};
/// The files of a zip archive, stored or deflated, in its order; folders are left out.
///   most     bytes of all of them together
///   throws   Error when it is damaged, encrypted, larger, has more than 1000 entries or none
std::vector<Entry> unzipped(std::span<const std::byte> bytes, std::size_t most);

}  // namespace petrichor::weather::packed

#endif
