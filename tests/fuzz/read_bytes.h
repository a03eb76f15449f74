#ifndef PETRICHOR_TESTS_FUZZ_READ_BYTES_H
#define PETRICHOR_TESTS_FUZZ_READ_BYTES_H

#include <string_view>

namespace petrichor::weather::testing_fuzz {

/// Reads any bytes as a weather file and holds the result to what the readers promise: either an
/// Error with something to say, or a complete table with increasing times. Throws std::logic_error
/// when neither is so.
void read_bytes(std::string_view bytes);

}  // namespace petrichor::weather::testing_fuzz

#endif
