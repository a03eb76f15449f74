// libFuzzer target for all weather readers. Build and run:
//   cmake --preset fuzz && cmake --build --preset fuzz --target readers_fuzz
//   mkdir -p found && build/fuzz/tests/fuzz/readers_fuzz found tests/fuzz/corpus
//   -max_total_time=3600 -rss_limit_mb=2048
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/read_bytes.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    petrichor::weather::testing_fuzz::read_bytes({reinterpret_cast<const char*>(data), size});
    return 0;
}
