#include "weather/readers/named_quantities.h"

#include <algorithm>

#include "base/error.h"

namespace petrichor::weather {
namespace {

// Light as eyes see it, which is no sunlight in W/m2.
bool is_of_sight(std::string_view unit)
{
    return unit == "lux" || unit == "klux" || unit == "lx" || unit == "klx" || unit == "fc" || unit == "kfc";
}

}  // namespace

std::vector<QuantityColumn> quantity_columns(const TableHeader& header,
                                             std::span<const NamedQuantity> quantities,
                                             const std::function<NameAndUnit(const std::string&)>& parts,
                                             std::string_view reader, std::string_view fix)
{
    std::vector<QuantityColumn> out;
    for (const NamedQuantity& q : quantities) {
        if (std::any_of(out.begin(), out.end(),
                        [&](const QuantityColumn& c) { return c.quantity->field == q.field; }))
            continue;
        for (const std::string& column : header.names()) {
            const NameAndUnit named = parts(column);
            if (named.name != q.name) continue;
            const auto& unit = named.unit;
            const auto known = std::find_if(q.units.begin(), q.units.end(),
                                            [&](const QuantityUnit& u) { return unit == u.name; });
            if (known == q.units.end() && q.field == Field::Shortwave && is_of_sight(unit)) continue;
            if (known == q.units.end())
                throw Error("weather: " + std::string(reader) + ": the unit '" + shown(unit) +
                                "' of column '" + shown(column) + "' is not known",
                            std::string(fix));
            out.push_back({header.at(column), &q, known->scale, known->offset});
            break;
        }
    }
    return out;
}

}  // namespace petrichor::weather
