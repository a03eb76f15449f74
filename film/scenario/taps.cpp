#include "film/scenario/taps.h"

namespace petrichor::film {
namespace {

constexpr double kFarthest_m = 1e6, kLongest_s = 1e10;
constexpr double kMostLitresMin = 1e6;  // of a river

}  // namespace

std::vector<ScenarioTap> read_taps(const TomlValue& value)
{
    std::vector<ScenarioTap> taps;
    for (const TomlValue& one : value.elements()) {
        ScenarioTap tap;
        bool placed = false, flows = false;
        for (const auto& [name, entry] :
             one.entries({"x_z_m", "litres_per_min", "temperature_c", "from_s", "to_s"})) {
            if (name == "x_z_m") {
                const auto n = entry.numbers(2, -kFarthest_m, kFarthest_m);
                tap.x_z_m = {n[0], n[1]};
                placed = true;
            } else if (name == "litres_per_min") {
                tap.litres_per_min = entry.number(0.0, kMostLitresMin);
                flows = true;
            } else if (name == "temperature_c") {
                tap.temperature_c = entry.number(0.0, 100.0);
            } else if (name == "from_s") {
                tap.from_s = entry.number(-kLongest_s, kLongest_s);
            } else {
                tap.to_s = entry.number(-kLongest_s, kLongest_s);
            }
        }
        if (!placed || !flows) one.refuse("a table with x_z_m and litres_per_min");
        if (tap.from_s && tap.to_s && *tap.to_s < *tap.from_s)
            one.refuse("a table with to_s at from_s or later");
        taps.push_back(tap);
    }
    return taps;
}

std::vector<glm::dvec3> read_drains(const TomlValue& value)
{
    std::vector<glm::dvec3> drains;
    for (const TomlValue& one : value.elements()) {
        glm::dvec3 drain{0.0};
        bool placed = false;
        for (const auto& [name, entry] : one.entries({"x_z_m", "radius_m"})) {
            if (name == "x_z_m") {
                const auto n = entry.numbers(2, -kFarthest_m, kFarthest_m);
                drain.x = n[0];
                drain.y = n[1];
                placed = true;
            } else {
                drain.z = entry.number(0.0, kFarthest_m);
            }
        }
        if (!placed) one.refuse("a table with x_z_m");
        drains.push_back(drain);
    }
    return drains;
}

}  // namespace petrichor::film
