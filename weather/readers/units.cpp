#include "weather/readers/units.h"

#include <string>

#include "base/error.h"
#include "weather/physics/constants.h"
#include "weather/readers/text.h"

namespace petrichor::weather {

namespace {

enum class Quantity {
    Temperature,
    Percent,
    Speed,
    Pressure,
    Flux,
    Fraction,
    Precipitation,
    Degrees,
    Length,
    Water
};

struct Name {
    const char* name;
    Field field;
    Quantity quantity;
};
// Longer names first where one begins with another.
constexpr Name kNames[] = {
    {"wind_direction_10m", Field::WindFrom, Quantity::Degrees},
    {"winddirection_10m", Field::WindFrom, Quantity::Degrees},
    {"wind_direction", Field::WindFrom, Quantity::Degrees},
    {"wind_from", Field::WindFrom, Quantity::Degrees},
    {"wind_dir", Field::WindFrom, Quantity::Degrees},
    {"winddir", Field::WindFrom, Quantity::Degrees},
    {"wind_speed_10m", Field::Wind, Quantity::Speed},
    {"windspeed_10m", Field::Wind, Quantity::Speed},
    {"wind_speed", Field::Wind, Quantity::Speed},
    {"windspeed", Field::Wind, Quantity::Speed},
    {"wind", Field::Wind, Quantity::Speed},
    {"ws", Field::Wind, Quantity::Speed},
    {"dew_point_2m", Field::DewPoint, Quantity::Temperature},
    {"dewpoint_2m", Field::DewPoint, Quantity::Temperature},
    {"dew_point", Field::DewPoint, Quantity::Temperature},
    {"dewpoint", Field::DewPoint, Quantity::Temperature},
    {"air_temperature", Field::AirTemp, Quantity::Temperature},
    {"air_temp", Field::AirTemp, Quantity::Temperature},
    {"temperature_2m", Field::AirTemp, Quantity::Temperature},
    {"temperature", Field::AirTemp, Quantity::Temperature},
    {"temp_air", Field::AirTemp, Quantity::Temperature},
    {"airtc", Field::AirTemp, Quantity::Temperature},
    {"t_air", Field::AirTemp, Quantity::Temperature},
    {"tair", Field::AirTemp, Quantity::Temperature},
    {"temp", Field::AirTemp, Quantity::Temperature},
    {"relative_humidity_2m", Field::RelHumidity, Quantity::Percent},
    {"relativehumidity_2m", Field::RelHumidity, Quantity::Percent},
    {"relative_humidity", Field::RelHumidity, Quantity::Percent},
    {"rel_humidity", Field::RelHumidity, Quantity::Percent},
    {"humidity", Field::RelHumidity, Quantity::Percent},
    {"rh", Field::RelHumidity, Quantity::Percent},
    {"surface_pressure", Field::Pressure, Quantity::Pressure},
    {"station_pressure", Field::Pressure, Quantity::Pressure},
    {"air_pressure", Field::Pressure, Quantity::Pressure},
    {"barometric_pressure", Field::Pressure, Quantity::Pressure},
    {"pressure", Field::Pressure, Quantity::Pressure},
    {"bp", Field::Pressure, Quantity::Pressure},
    {"sw_down", Field::Shortwave, Quantity::Flux},
    {"sw_in", Field::Shortwave, Quantity::Flux},
    {"swdown", Field::Shortwave, Quantity::Flux},
    {"shortwave_radiation", Field::Shortwave, Quantity::Flux},
    {"shortwave", Field::Shortwave, Quantity::Flux},
    {"global_radiation", Field::Shortwave, Quantity::Flux},
    {"global_horizontal_irradiance", Field::Shortwave, Quantity::Flux},
    {"solar_radiation", Field::Shortwave, Quantity::Flux},
    {"solar_irradiance", Field::Shortwave, Quantity::Flux},
    {"solar", Field::Shortwave, Quantity::Flux},
    {"slrw", Field::Shortwave, Quantity::Flux},
    {"ghi", Field::Shortwave, Quantity::Flux},
    {"sw_net", Field::NetShortwave, Quantity::Flux},
    {"sw", Field::Shortwave, Quantity::Flux},
    {"net_solar", Field::NetShortwave, Quantity::Flux},
    {"net_shortwave", Field::NetShortwave, Quantity::Flux},
    {"lw_down", Field::Longwave, Quantity::Flux},
    {"lw_in", Field::Longwave, Quantity::Flux},
    {"lwdown", Field::Longwave, Quantity::Flux},
    {"longwave_radiation", Field::Longwave, Quantity::Flux},
    {"longwave", Field::Longwave, Quantity::Flux},
    {"thermal", Field::Longwave, Quantity::Flux},
    {"lw", Field::Longwave, Quantity::Flux},
    {"direct_normal_irradiance", Field::Direct, Quantity::Flux},
    {"dni", Field::Direct, Quantity::Flux},
    {"diffuse_radiation", Field::Diffuse, Quantity::Flux},
    {"dhi", Field::Diffuse, Quantity::Flux},
    {"cloud_fraction", Field::Cloud, Quantity::Fraction},
    {"cloud_cover", Field::Cloud, Quantity::Fraction},
    {"cloudcover", Field::Cloud, Quantity::Fraction},
    {"cloud", Field::Cloud, Quantity::Fraction},
    {"snow_depth", Field::SnowDepth, Quantity::Length},
    {"snow_height", Field::SnowDepth, Quantity::Length},
    {"snow_water_equivalent", Field::SnowWater, Quantity::Water},
    {"snow_water", Field::SnowWater, Quantity::Water},
    {"swe", Field::SnowWater, Quantity::Water},
    {"surface_temperature", Field::SurfaceTemp, Quantity::Temperature},
    {"surface_temp", Field::SurfaceTemp, Quantity::Temperature},
    {"sw_up", Field::Reflected, Quantity::Flux},
    {"snow_share", Field::SnowShare, Quantity::Fraction},
    {"visibility", Field::Visibility, Quantity::Length},
    {"precip_total", Field::Precip, Quantity::Precipitation},
    {"precipitation", Field::Precip, Quantity::Precipitation},
    {"precip", Field::Precip, Quantity::Precipitation},
    {"snowfall", Field::Snow, Quantity::Precipitation},
    {"snow", Field::Snow, Quantity::Precipitation},
    {"rainfall", Field::Rain, Quantity::Precipitation},
    {"rain", Field::Rain, Quantity::Precipitation},
    // German tables.
    {"windgeschwindigkeit", Field::Wind, Quantity::Speed},
    {"windrichtung", Field::WindFrom, Quantity::Degrees},
    {"lufttemperatur", Field::AirTemp, Quantity::Temperature},
    {"au\xC3\x9F" "entemperatur", Field::AirTemp, Quantity::Temperature},
    {"aussentemperatur", Field::AirTemp, Quantity::Temperature},
    {"temperatur", Field::AirTemp, Quantity::Temperature},
    {"taupunkttemperatur", Field::DewPoint, Quantity::Temperature},
    {"taupunkt", Field::DewPoint, Quantity::Temperature},
    {"relative_luftfeuchtigkeit", Field::RelHumidity, Quantity::Percent},
    {"relative_luftfeuchte", Field::RelHumidity, Quantity::Percent},
    {"relative_feuchte", Field::RelHumidity, Quantity::Percent},
    {"luftfeuchtigkeit", Field::RelHumidity, Quantity::Percent},
    {"luftfeuchte", Field::RelHumidity, Quantity::Percent},
    {"luftdruck", Field::Pressure, Quantity::Pressure},
    {"globalstrahlung", Field::Shortwave, Quantity::Flux},
    {"diffusstrahlung", Field::Diffuse, Quantity::Flux},
    {"gegenstrahlung", Field::Longwave, Quantity::Flux},
    {"bew\xC3\xB6lkung", Field::Cloud, Quantity::Fraction},
    {"bew\xF6lkung", Field::Cloud, Quantity::Fraction},
    {"bewoelkung", Field::Cloud, Quantity::Fraction},
    {"bedeckungsgrad", Field::Cloud, Quantity::Fraction},
    {"schneeh\xC3\xB6he", Field::SnowDepth, Quantity::Length},
    {"schneeh\xF6he", Field::SnowDepth, Quantity::Length},
    {"schneehoehe", Field::SnowDepth, Quantity::Length},
    {"sichtweite", Field::Visibility, Quantity::Length},
    {"niederschlagsmenge", Field::Precip, Quantity::Precipitation},
    {"niederschlag", Field::Precip, Quantity::Precipitation},
    {"regen", Field::Rain, Quantity::Precipitation},
};

// Letters and digits only, lower case: "W/m²", "W m-2" and "w_m2" are the same unit.
std::string plain_unit(std::string_view unit)
{
    std::string out;
    for (std::size_t i = 0; i < unit.size(); ++i) {
        const char c = unit[i];
        if (c >= 'A' && c <= 'Z')
            out += static_cast<char>(c - 'A' + 'a');
        else if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'))
            out += c;
        else if (c == '%')
            out += "pct";
        else if (static_cast<unsigned char>(c) == 0xB2)
            out += '2';  // the last byte of a superscript two
    }
    return out;
}

bool unit_factor(Quantity quantity, const std::string& u, ColumnMeaning& m)
{
    const auto is = [&](std::initializer_list<const char*> names) {
        for (const char* n : names) {
            if (u == n) return true;
        }
        return false;
    };
    switch (quantity) {
        case Quantity::Temperature:
            if (is({"k", "kelvin"})) return true;
            if (is({"", "c", "degc", "celsius"})) {
                m.offset = kZeroCelsiusK;
                return true;
            }
            if (is({"f", "degf", "fahrenheit"})) {
                m.scale = 5.0 / 9.0;
                m.offset = kZeroCelsiusK - 32.0 * 5.0 / 9.0;
                return true;
            }
            return false;
        case Quantity::Percent:
            if (is({"", "pct", "percent"})) return true;
            if (is({"1", "fraction"})) {
                m.scale = 100.0;
                return true;
            }
            return false;
        case Quantity::Speed:
            if (is({"", "ms", "ms1", "mps"})) return true;
            if (is({"kmh", "kmh1", "kph"}))
                m.scale = 1.0 / 3.6;
            else if (is({"mph", "mpmph"}))
                m.scale = 0.44704;
            else if (is({"kn", "kt", "kts", "knots"}))
                m.scale = 1852.0 / 3600.0;
            else
                return false;
            return true;
        case Quantity::Pressure:
            if (is({"", "pa"})) return true;
            if (is({"hpa", "mbar", "mb"}))
                m.scale = 100.0;
            else if (is({"kpa"}))
                m.scale = 1000.0;
            else if (is({"inhg"}))
                m.scale = 3386.389;
            else
                return false;
            return true;
        case Quantity::Flux:
            if (is({"", "wm2", "wm-2"})) return true;
            // What came in over the interval.
            m.amount = true;
            if (is({"jm2"})) return true;
            if (is({"kjm2"}))
                m.scale = 1e3;
            else if (is({"mjm2"}))
                m.scale = 1e6;
            else if (is({"jcm2"}))
                m.scale = 1e4;
            else if (is({"whm2"}))
                m.scale = 3600.0;
            else if (is({"kwhm2"}))
                m.scale = 3.6e6;
            else
                return false;
            return true;
        case Quantity::Fraction:
            if (is({"", "fraction", "1"})) return true;
            if (is({"pct", "percent"}))
                m.scale = 0.01;
            else if (is({"tenths"}))
                m.scale = 0.1;
            else if (is({"oktas", "okta", "achtel"}))
                m.scale = 0.125;
            else
                return false;
            return true;
        case Quantity::Degrees:
            return is({"", "deg", "degrees", "degree"});
        case Quantity::Length:
            if (is({"", "m", "metre", "meter"})) return true;
            if (is({"km"}))
                m.scale = 1000.0;
            else if (is({"cm"}))
                m.scale = 0.01;
            else if (is({"mm"}))
                m.scale = 0.001;
            else if (is({"ft"}))
                m.scale = 0.3048;
            else
                return false;
            return true;
        case Quantity::Water:
            return is({"", "mm", "kgm2"});
        case Quantity::Precipitation:
            if (is({"kgm2s", "kgm2s1", "mms"})) return true;
            if (is({"mmh", "mmh1", "mmhr", "kgm2h"})) {
                m.scale = 1.0 / 3600.0;
                return true;
            }
            m.amount = true;
            if (is({"", "mm", "kgm2", "lm2"})) return true;
            // Snow in centimetres or inches is fresh snow: 7 cm of it hold 10 mm of water (the
            // convention of weather services).
            if (is({"cm"}) && m.field == Field::Snow)
                m.scale = 10.0 / 7.0;
            else if (is({"inch", "in"}) && m.field == Field::Snow)
                m.scale = 25.4 / 7.0;
            else if (is({"inch", "in"}))
                m.scale = 25.4;
            else if (is({"m"}))
                m.scale = 1000.0;
            else if (is({"cm"}))
                m.scale = 10.0;
            else
                return false;
            return true;
    }
    return false;
}

// What a name without a unit is taken for.
std::string_view unit_unsaid(Quantity quantity)
{
    switch (quantity) {
        case Quantity::Temperature: return "C";
        case Quantity::Speed: return "m/s";
        case Quantity::Pressure: return "Pa";
        case Quantity::Flux: return "W/m2";
        case Quantity::Fraction: return "a share of 1";
        case Quantity::Precipitation: return "mm";
        case Quantity::Length: return "m";
        case Quantity::Water: return "mm of water";
        case Quantity::Percent:
        case Quantity::Degrees: break;
    }
    return {};
}

}  // namespace

std::optional<ColumnMeaning> column_meaning(std::string_view name, std::string_view unit)
{
    std::string low = lower(trimmed(name));
    std::string given(unit);
    // "wind (km/h)" and "wind [km/h]"
    const auto open = low.find_first_of("([");
    if (open != std::string::npos) {
        const auto close = low.find_last_of(")]");
        if (close != std::string::npos && close > open)
            given = low.substr(open + 1, close - open - 1);
        low = std::string(trimmed(low.substr(0, open)));
    }
    for (char& c : low) {
        if (c == ' ' || c == '-') c = '_';
    }
    // Loggers say how they made one value of many: a mean, a sample, a sum.
    for (const char* how : {"_avg", "_mean", "_smp", "_tot", "_sum"}) {
        if (low.size() > std::string_view(how).size() && low.ends_with(how)) {
            low.resize(low.size() - std::string_view(how).size());
            break;
        }
    }
    ColumnMeaning m;
    if (low == "percent_snow") {
        m.percent_snow = true;
        return m;
    }
    if (low.rfind("vapor_pressure", 0) == 0 || low.rfind("vapour_pressure", 0) == 0) {
        if (low.find("deficit") != std::string::npos) return std::nullopt;
        m.vapour_pressure = true;
        return m;
    }
    if (low == "snow" && given.empty()) {
        throw Error("weather: column 'snow' says neither whether it is what fell nor its unit",
                    "Name it snowfall_mm (water), snowfall_cm (fresh snow) or snow_depth_cm.");
    }
    // Short names stand for many things: a unit must say which.
    if (given.empty()) {
        for (const char* n : {"sw", "lw", "ws", "bp", "tair", "t_air", "solar"})
            if (low == n) return std::nullopt;
    }
    for (const Name& known : kNames) {
        const std::string_view n = known.name;
        if (low.rfind(n, 0) != 0) continue;
        const std::string_view rest = std::string_view(low).substr(n.size());
        // What follows the name is the unit, or it is another word.
        if (!rest.empty() && rest.front() != '_') continue;
        m = {};
        m.field = known.field;
        const std::string u = plain_unit(rest.empty() ? std::string_view(given) : rest.substr(1));
        if (unit_factor(known.quantity, u, m)) {
            if (u.empty()) m.assumed_unit = unit_unsaid(known.quantity);
            return m;
        }
        if (!rest.empty()) continue;  // "precip_temp": a longer, unknown name
        throw Error(
            "weather: column '" + shown(name) + "': the unit '" + shown(given) + "' is not known",
            "Write the unit as in air_temp_c, wind_m_s, pressure_pa, precip_mm or (km/h).");
    }
    return std::nullopt;
}

}  // namespace petrichor::weather
