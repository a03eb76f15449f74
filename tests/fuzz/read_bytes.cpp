#include "tests/fuzz/read_bytes.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "base/error.h"
#include "weather/readers/horizon_text.h"
#include "weather/readers/metro_xml.h"
#include "weather/readers/read_weather.h"
#include "weather/readers/road_events_text.h"

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

namespace {

template <class Read>
void expect_an_answer(Read&& read)
{
    try {
        read();
    } catch (const Error& error) {
        require(error.what()[0] != '\0' && !error.fix().empty(),
                "an error says what is wrong and what to do");
    }
}

}  // namespace

void read_bytes(std::string_view bytes)
{
    expect_an_answer([&] {
        const Horizon horizon = read_horizon(bytes, "horizon");
        require(horizon_sky_view(horizon) <= 1.0, "a horizon only hides");
    });
    expect_an_answer([&] { check_events(read_road_events(bytes, "events", 3600.0)); });
    if (looks_like_metro(bytes)) {
        expect_an_answer([&] { read_metro_station(bytes); });
        expect_an_answer([&] {
            const MetroObservation o = read_metro_observation(bytes);
            const ForcingTable seen = observed_weather(o, o.table);
            for (const double cover : seen[Field::Cloud])
                require(cover >= 0.0 && cover <= 1.0, "a sky is covered from 0 to 1");
        });
        expect_an_answer([&] { read_metro_roadcast(bytes); });
    }
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
