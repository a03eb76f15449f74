#include "cli/bench/skill/longwave.h"

#include <cmath>

#include "weather/physics/constants.h"

namespace petrichor::cli {

using weather::Field;
using weather::ForcingTable;

namespace {

constexpr std::size_t kFewHours = 50;
constexpr double kSun_w_m2 = 300.0, kClear = 0.3;  // 0.3 of cloud takes a hundredth of the sun
constexpr double kFalls_kg_m2_s = 0.5 / 3600.0;

// The measured longwave over that of a black sky as warm as the air, less 1, in damp hours with
// rain or snow: low cloud then, which is nearly black. What is far from 0 is the instrument's.
ErrorSum sky_of_falling_hours(const ForcingTable& made, const ForcingTable& raw)
{
    ErrorSum sum;
    if (!raw.has(Field::RelHumidity)) return sum;
    for (std::size_t i = 0; i < raw.rows(); ++i) {
        double falls = 0.0;
        for (const Field f : {Field::Precip, Field::Rain, Field::Snow})
            if (raw.has(f) && !std::isnan(raw[f][i])) falls += raw[f][i];
        if (!(falls > kFalls_kg_m2_s && raw[Field::RelHumidity][i] >= 95.0)) continue;
        const double air_k = made[Field::AirTemp][i], square = air_k * air_k;
        sum.add(raw[Field::Longwave][i] / (weather::kStefanBoltzmann * square * square) - 1.0);
    }
    return sum;
}

}  // namespace

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
    const ErrorSum black = sky_of_falling_hours(made, raw);
    ErrorSum all, cloudy, levelled, sunny;
    for (std::size_t i = 0; i < raw.rows(); ++i) {
        const double measured = raw[Field::Longwave][i];
        const double error = made[Field::Longwave][i] - measured;
        all.add(error);
        if (raw.has(Field::Shortwave) && raw[Field::Shortwave][i] > kSun_w_m2 &&
            made[Field::Cloud][i] < kClear)
            sunny.add(error);
        if (made[Field::Cloud][i] < 0.9) continue;
        cloudy.add(error);
        if (black.count() >= kFewHours)
            levelled.add(made[Field::Longwave][i] - measured / (1.0 + black.bias()));
    }
    if (all.count() == 0) return {};
    std::vector<SkillRow> rows{
        {set, "longwave", "W/m2", all.count(), all.rmse(), all.bias(), "RMSE"}};
    if (cloudy.count() > 0) {
        rows.push_back({set, "longwave under cloud", "W/m2", cloudy.count(),
                        std::abs(cloudy.bias()), cloudy.bias(), "|bias|"});
    }
    if (sunny.count() >= kFewHours) {
        rows.push_back({set, "longwave in clear sun", "W/m2", sunny.count(), std::abs(sunny.bias()),
                        sunny.bias(), "|bias|"});
    }
    if (black.count() >= kFewHours) {
        rows.push_back({set, "sky measured in rain, snow", "of a black sky", black.count(),
                        1.0 + black.bias(), black.bias(), "data, no score"});
        rows.push_back({set, "longwave, that sky black", "W/m2", levelled.count(),
                        std::abs(levelled.bias()), levelled.bias(), "|bias|"});
    }
    return rows;
}

}  // namespace petrichor::cli
