#include "tests/fuzz/read_bytes.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "base/error.h"
#include "weather/readers/read_weather.h"

namespace petrichor::weather::testing_fuzz {

namespace {

void require(bool good, const std::string& promise)
{
    if (!good) throw std::logic_error("broken promise: " + promise);
}

void check_table(const ForcingTable& table)
{
    require(table.rows() > 0, "a table has rows");
    for (std::size_t i = 1; i < table.rows(); ++i) {
        require(table.time_us[i] > table.time_us[i - 1], "times increase");
    }
    for (const Field field : {Field::AirTemp, Field::RelHumidity, Field::Wind, Field::Pressure,
                              Field::Shortwave, Field::Longwave, Field::Cloud, Field::Precip}) {
        const FieldInfo& info = field_info(field);
        require(table[field].size() == table.rows(), std::string(info.name) + " is complete");
        for (const double value : table[field])
            require(std::isfinite(value), std::string(info.name) + " is finite");
    }
}

}  // namespace

void read_bytes(std::string_view bytes)
{
    try {
        ReadOptions options;
        options.most_bytes = std::size_t{1} << 22;
        const ReadResult result = read_weather(bytes, options);
        check_table(result.table);
        require(!to_text(result.report).empty(), "a report has text");
        require(!to_json(result.report).empty(), "a report has JSON");
    } catch (const Error& error) {
        require(error.what()[0] != '\0' && !error.fix().empty(),
                "an error says what is wrong and what to do");
    }
}

}  // namespace petrichor::weather::testing_fuzz
