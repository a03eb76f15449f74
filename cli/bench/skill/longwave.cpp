#include "cli/bench/skill/longwave.h"

#include <cmath>

namespace petrichor::cli {

using weather::Field;
using weather::ForcingTable;

ForcingTable without_longwave(const ForcingTable& raw)
{
    ForcingTable table = raw;
    table[Field::Longwave].clear();
    weather::ReadReport report;
    weather::fill_forcing(table, report);
    return table;
}

std::vector<SkillRow> longwave_rows(const std::string& set, const ForcingTable& raw)
{
    if (!raw.has(Field::Longwave)) return {};
    const ForcingTable made = without_longwave(raw);
    if (made.rows() != raw.rows()) return {};  // rows were divided: nothing to set side by side
    ErrorSum all, cloudy;
    for (std::size_t i = 0; i < raw.rows(); ++i) {
        const double error = made[Field::Longwave][i] - raw[Field::Longwave][i];
        all.add(error);
        if (made[Field::Cloud][i] >= 0.9) cloudy.add(error);
    }
    if (all.count() == 0) return {};
    std::vector<SkillRow> rows{
        {set, "longwave", "W/m2", all.count(), all.rmse(), all.bias(), "RMSE"}};
    if (cloudy.count() > 0) {
        rows.push_back({set, "longwave under cloud", "W/m2", cloudy.count(),
                        std::abs(cloudy.bias()), cloudy.bias(), "|bias|"});
    }
    return rows;
}

}  // namespace petrichor::cli
