// Tables whose columns are named with their units: "Temp - F", "Wind(m/s)".
#ifndef PETRICHOR_WEATHER_READERS_NAMED_QUANTITIES_H
#define PETRICHOR_WEATHER_READERS_NAMED_QUANTITIES_H

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "weather/readers/table_rows.h"
#include "weather/readers/tables.h"

namespace petrichor::weather {

struct QuantityUnit {
    const char* name;
    double scale, offset;  ///< to SI: scale * number + offset
};
struct NamedQuantity {
    const char* name;
    Field field;
    std::span<const QuantityUnit> units;
    bool sea_level = false;  ///< a pressure brought down to the sea
};
struct QuantityColumn {
    std::size_t at;
    const NamedQuantity* quantity;
    double scale, offset;
};

struct NameAndUnit {
    std::string name, unit;
};

/// The columns of a header that are of one of the quantities, whose names are lower case; of several
/// for one field the first of them counts.
///   parts   of a column, name and unit
///   reader  who reads, and what mends a unit that is not known: for the error
///   throws  Error for a unit that is not known; light in lux or foot-candles is left unread, as it is
///           no sunlight
std::vector<QuantityColumn> quantity_columns(const TableHeader& header,
                                             std::span<const NamedQuantity> quantities,
                                             const std::function<NameAndUnit(const std::string&)>& parts,
                                             std::string_view reader, std::string_view fix);

}  // namespace petrichor::weather

#endif
