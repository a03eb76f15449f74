#include "weather/models/artist/from_forcing.h"

#include "base/error.h"
#include "weather/physics/constants.h"

namespace petrichor::weather {

namespace {

// A value equal to both its neighbours is on the line between them: long dry spells are one piece.
void add_key(Channel& channel, TimeUs time, double value)
{
    const std::size_t n = channel.values.size();
    const bool held = channel.interpolation == Interpolation::Hold;
    if (held && n >= 1 && channel.values[n - 1] == value) return;
    if (!held && n >= 2 && channel.values[n - 1] == value && channel.values[n - 2] == value) {
        channel.times.back() = time;
        return;
    }
    channel.times.push_back(time);
    channel.values.push_back(value);
}

}  // namespace

Channel channel_of_field(const ForcingTable& table, Field field, double scale, double offset)
{
    const auto& values = table[field];
    if (table.rows() == 0 || values.size() != table.rows()) {
        throw Error(
            std::string("weather: the table has no complete column ") + field_info(field).name,
            "Call fill_forcing on the table first.");
    }
    Channel channel;
    channel.interpolation = Interpolation::Linear;
    for (std::size_t i = 0; i < values.size(); ++i)
        add_key(channel, table.time_us[i] - table.time_us.front(), values[i] * scale + offset);
    return channel;
}

Timeline artist_keys(const ForcingTable& table, const MappingParams& mapping)
{
    Timeline timeline;
    timeline.temperature_c = channel_of_field(table, Field::AirTemp, 1.0, -kZeroCelsiusK);
    const auto& precip = table[Field::Precip];
    if (precip.size() != table.rows())
        throw Error("weather: the table has no complete column precip",
                    "Call fill_forcing on the table first.");
    for (std::size_t i = 0; i < precip.size(); ++i) {
        add_key(timeline.rainfall, table.time_us[i] - table.time_us.front(),
                rainfall_of_rate(mapping, precip[i] * 3600.0));
    }
    return timeline;
}

}  // namespace petrichor::weather
