// libFuzzer target for TOML: every file of ours goes through parse_toml(); weather scripts are the
// deepest reader on it.
#include <cstddef>
#include <cstdint>
#include <string>

#include "base/error.h"
#include "film/scenario/weather_script.h"
#include "film/toml/toml_value.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string text(reinterpret_cast<const char*>(data), size);
    try {
        petrichor::film::parse_toml(text, "fuzz");
        petrichor::film::read_weather_script(text, "fuzz");
    } catch (const petrichor::Error&) {
    }
    return 0;
}
