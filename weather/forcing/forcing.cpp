#include "weather/forcing/forcing.h"

#include <algorithm>

namespace petrichor::weather {

namespace {

constexpr FieldInfo kInfo[kFieldCount] = {
    {"air_temp", "K", 173.15, 333.15, false},
    {"rel_humidity", "%", 0.0, 110.0, false},
    {"wind", "m/s", 0.0, 110.0, false},
    {"pressure", "Pa", 30000.0, 110000.0, false},
    {"sw_down", "W/m2", -15.0, 1600.0, false},
    {"lw_down", "W/m2", 40.0, 700.0, false},
    {"cloud", "1", 0.0, 1.0, false},
    {"precip", "kg m-2 s-1", 0.0, 0.15, true},
    {"rain", "kg m-2 s-1", 0.0, 0.15, true},
    {"snow", "kg m-2 s-1", 0.0, 0.15, true},
    {"dew_point", "K", 143.15, 313.15, false},
    {"wind_from", "deg", 0.0, 360.0, false},
    {"visibility", "m", 0.0, 1.0e6, false},
    {"snow_depth", "m", 0.0, 30.0, false, 0.06, true},
    {"direct", "W/m2", -15.0, 1500.0, false},
    {"diffuse", "W/m2", -15.0, 1300.0, false},
    {"sw_net", "W/m2", -15.0, 1600.0, true},
    {"snow_share", "1", 0.0, 1.0, true},
    {"surface_temp", "K", 173.15, 363.15, false, 0.0, true},
    {"sw_up", "W/m2", -15.0, 1600.0, false, 0.0, true},
    {"snow_water", "kg/m2", 0.0, 15000.0, false, 5.0, true},
    {"road_condition", "", 1.0, 8.0, false, 0.0, true},
    {"wheel_friction", "1", 0.0, 1.0, false, 0.0, true},
};

}  // namespace

const FieldInfo& field_info(Field field)
{
    return kInfo[static_cast<std::size_t>(field)];
}

double value_at(const ForcingTable& table, Field field, std::int64_t time_us)
{
    const auto& v = table[field];
    if (v.empty()) return kMissing;
    const auto& t = table.time_us;
    const auto upper = std::upper_bound(t.begin(), t.end(), time_us);
    if (upper == t.begin()) return v.front();
    if (upper == t.end()) return v.back();
    const auto i = static_cast<std::size_t>(upper - t.begin());
    const double x = static_cast<double>(time_us - t[i - 1]) / static_cast<double>(t[i] - t[i - 1]);
    return v[i - 1] + (v[i] - v[i - 1]) * x;
}

}  // namespace petrichor::weather
