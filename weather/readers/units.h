#ifndef PETRICHOR_WEATHER_READERS_UNITS_H
#define PETRICHOR_WEATHER_READERS_UNITS_H

#include <optional>
#include <string_view>

#include "weather/forcing/forcing.h"

namespace petrichor::weather {

/// How a column of a table becomes a field.
struct ColumnMeaning {
    Field field = Field::AirTemp;
    double scale = 1.0, offset = 0.0;
    bool amount = false;  ///< per interval, kg/m2 after scaling; else an "at" value or a rate
    bool snow_depth_cm = false;
    bool percent_snow = false;     ///< not a field: the snow share of the precipitation column
    bool vapour_pressure = false;  ///< not a field: becomes relative humidity
    /// The unit that was taken as the name says none: "C"; empty where it says one, or there is but one.
    std::string_view assumed_unit{};
};

/// Meaning of a column from its name with the unit inside it ("air_temp_c", "wind (km/h)",
/// "Temperature [°F]"), or from name and unit apart. Letter case is ignored. Nothing when the name
/// is not known.
///   throws  Error when the name is known and the unit is not
std::optional<ColumnMeaning> column_meaning(std::string_view name, std::string_view unit = {});

}  // namespace petrichor::weather

#endif
