#include "weather/packed/detail/point_names.h"

#include <string>

#include "weather/readers/text.h"

namespace petrichor::weather::packed::detail {

namespace {

struct Name {
    const char* name;
    What what;
};
// Short names, lower case.
constexpr Name kNames[] = {
    {"t2m", What::AirTemp},
    {"2t", What::AirTemp},
    {"2m_temperature", What::AirTemp},
    {"tair", What::AirTemp},
    {"tas", What::AirTemp},
    {"airtemp", What::AirTemp},
    {"air_temperature", What::AirTemp},
    {"temp", What::AirTemp},
    {"t2", What::AirTemp},
    {"tmp_2maboveground", What::AirTemp},
    {"d2m", What::DewPoint},
    {"2d", What::DewPoint},
    {"dpt_2maboveground", What::DewPoint},
    {"qair", What::SpecificHumidity},
    {"huss", What::SpecificHumidity},
    {"spechum", What::SpecificHumidity},
    {"q2", What::SpecificHumidity},
    {"2sh", What::SpecificHumidity},
    {"sh2", What::SpecificHumidity},
    {"hurs", What::RelHumidity},
    {"relhum", What::RelHumidity},
    {"rh", What::RelHumidity},
    {"r2", What::RelHumidity},
    {"2r", What::RelHumidity},
    {"rel_hum", What::RelHumidity},
    {"wind", What::Wind},
    {"wss", What::Wind},
    {"sfcwind", What::Wind},
    {"windspd", What::Wind},
    {"wind_speed", What::Wind},
    {"si10", What::Wind},
    {"10si", What::Wind},
    {"u10", What::WindEast},
    {"10u", What::WindEast},
    {"uas", What::WindEast},
    {"ugrd_10maboveground", What::WindEast},
    {"v10", What::WindNorth},
    {"10v", What::WindNorth},
    {"vas", What::WindNorth},
    {"vgrd_10maboveground", What::WindNorth},
    {"wind_dir", What::WindFrom},
    {"winddir", What::WindFrom},
    {"sp", What::Pressure},
    {"psurf", What::Pressure},
    {"ps", What::Pressure},
    {"airpres", What::Pressure},
    {"psfc", What::Pressure},
    {"pres_surface", What::Pressure},
    {"ssrd", What::Shortwave},
    {"swdown", What::Shortwave},
    {"rsds", What::Shortwave},
    {"swradatm", What::Shortwave},
    {"sw_in", What::Shortwave},
    {"dswrf_surface", What::Shortwave},
    {"dswrf", What::Shortwave},
    {"sdswrf", What::Shortwave},
    {"avg_sdswrf", What::Shortwave},
    {"msdwswrf", What::Shortwave},
    {"ssr", What::NetShortwave},
    {"strd", What::Longwave},
    {"lwdown", What::Longwave},
    {"rlds", What::Longwave},
    {"lwradatm", What::Longwave},
    {"lw_in", What::Longwave},
    {"glw", What::Longwave},
    {"dlwrf_surface", What::Longwave},
    {"dlwrf", What::Longwave},
    {"sdlwrf", What::Longwave},
    {"avg_sdlwrf", What::Longwave},
    {"msdwlwrf", What::Longwave},
    {"tcc", What::Cloud},
    {"clt", What::Cloud},
    {"tcdc", What::Cloud},
    {"tcdc_entireatmosphere", What::Cloud},
    {"cloud_cover", What::Cloud},
    {"tp", What::Precip},
    {"pptrate", What::Precip},
    {"pr", What::Precip},
    {"precip", What::Precip},
    {"prate", What::Precip},
    {"mtpr", What::Precip},
    {"avg_tprate", What::Precip},
    {"tprate", What::Precip},
    {"rainnc", What::Precip},
    {"apcp_surface", What::Precip},
    {"rainc", What::PrecipMore},
    {"rainf", What::Rain},
    {"rainfall", What::Rain},
    {"snowf", What::Snow},
    {"prsn", What::Snow},
    {"sf", What::Snow},
    {"snowfall", What::Snow},
    {"snownc", What::Snow},
    {"sde", What::SnowDepth},
    {"snd", What::SnowDepth},
    {"snowh", What::SnowDepth},
    {"snow_depth", What::SnowDepth},
    {"snod_surface", What::SnowDepth},
    {"sd", What::SnowWater},
    {"snw", What::SnowWater},
    {"swe", What::SnowWater},
    {"weasd_surface", What::SnowWater},
    {"skt", What::SurfaceTemp},
    {"tsk", What::SurfaceTemp},
    {"ts", What::SurfaceTemp},
    {"tss", What::SurfaceTemp},
    {"rsus", What::Reflected},
    {"sw_out", What::Reflected},
    {"vis", What::Visibility},
    {"vis_surface", What::Visibility},
    {"z", What::Height},
    {"orog", What::Height},
    {"hgt", What::Height},
    {"hgt_surface", What::Height},
    {"elevation", What::Height},
    {"altitude", What::Height},
    {"elev", What::Height},
};
constexpr Name kStandardNames[] = {
    {"air_temperature", What::AirTemp},
    {"dew_point_temperature", What::DewPoint},
    {"specific_humidity", What::SpecificHumidity},
    {"relative_humidity", What::RelHumidity},
    {"wind_speed", What::Wind},
    {"eastward_wind", What::WindEast},
    {"northward_wind", What::WindNorth},
    {"wind_from_direction", What::WindFrom},
    {"surface_air_pressure", What::Pressure},
    {"air_pressure", What::Pressure},
    {"surface_downwelling_shortwave_flux_in_air", What::Shortwave},
    {"surface_downwelling_longwave_flux_in_air", What::Longwave},
    {"surface_upwelling_shortwave_flux_in_air", What::Reflected},
    {"cloud_area_fraction", What::Cloud},
    {"precipitation_flux", What::Precip},
    {"precipitation_amount", What::Precip},
    {"rainfall_flux", What::Rain},
    {"snowfall_flux", What::Snow},
    {"surface_snow_thickness", What::SnowDepth},
    {"surface_snow_amount", What::SnowWater},
    {"surface_temperature", What::SurfaceTemp},
    {"surface_altitude", What::Height},
};

}  // namespace

std::optional<What> what_of(const PointVariable& v)
{
    const std::string name = lower(v.name), standard = lower(v.standard_name);
    for (const Name& n : kNames) {
        if (name == n.name) return n.what;
    }
    for (const Name& n : kStandardNames) {
        if (standard == n.name) return n.what;
    }
    return std::nullopt;
}

}  // namespace petrichor::weather::packed::detail
