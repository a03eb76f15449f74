#include "weather/readers/isd_groups.h"

#include <algorithm>
#include <cmath>

#include "weather/physics/constants.h"
#include "weather/readers/metar.h"
#include "weather/readers/tables.h"
#include "weather/readers/text.h"

namespace petrichor::weather {

namespace {

// A coded whole number; nothing for nines only, which mean "missing" at any length.
std::optional<double> coded(std::string_view text)
{
    const auto number = to_integer(text);
    if (!number) return std::nullopt;
    std::string_view digits = trimmed(text);
    if (!digits.empty() && (digits.front() == '+' || digits.front() == '-'))
        digits.remove_prefix(1);
    if (digits.find_first_not_of('9') == digits.npos) return std::nullopt;
    return static_cast<double>(*number);
}

// Oktas, 09 hidden; 10 (partly hidden) and 99 say nothing.
double cloud_of_oktas(std::string_view text)
{
    const auto oktas = to_integer(text);
    if (!oktas || *oktas < 0 || *oktas > 9) return kMissing;
    return std::min(static_cast<double>(*oktas) / 8.0, 1.0);
}

}  // namespace

bool IsdReport::good(std::string_view quality)
{
    const bool bad = quality == "2" || quality == "3" || quality == "6" || quality == "7";
    dropped_ += bad;
    return !bad;
}

void IsdReport::begin()
{
    cloud_ = air_k_ = sea_pa_ = kMissing;
    rain_mm_h_ = snow_mm_h_ = 0.0;
    station_pressure_ = falls_ = total_cloud_ = false;
}

void IsdReport::wind(std::string_view direction, std::string_view type, std::string_view speed,
                     std::string_view quality)
{
    const auto tenths = coded(speed);
    if (!tenths || !good(quality)) {
        rows_.missing(Field::Wind);
        return;
    }
    rows_.set(Field::Wind, *tenths * 0.1);
    if (const auto from = coded(direction); from && type != "C" && type != "V")
        rows_.set(Field::WindFrom, *from);
}

void IsdReport::visibility(std::string_view metres, std::string_view quality)
{
    const auto m = coded(metres);
    if (m && good(quality))
        rows_.set(Field::Visibility, *m);
    else
        rows_.missing(Field::Visibility);
}

void IsdReport::air(std::string_view tenths_c, std::string_view quality)
{
    const auto t = coded(tenths_c);
    if (t && good(quality)) {
        air_k_ = *t * 0.1 + kZeroCelsiusK;
        rows_.set(Field::AirTemp, air_k_);
    } else {
        rows_.missing(Field::AirTemp);
    }
}

void IsdReport::dew(std::string_view tenths_c, std::string_view quality)
{
    const auto t = coded(tenths_c);
    if (t && good(quality))
        rows_.set(Field::DewPoint, *t * 0.1 + kZeroCelsiusK);
    else
        rows_.missing(Field::DewPoint);
}

void IsdReport::sea_level_pressure(std::string_view tenths_hpa, std::string_view quality)
{
    const auto p = coded(tenths_hpa);
    if (p && good(quality)) sea_pa_ = *p * 10.0;
}

void IsdReport::group(std::string_view id, const std::vector<std::string_view>& f)
{
    const auto at = [&](std::size_t i) { return cell_of(f, i); };
    const auto kind = id.substr(0, 2);
    if (kind == "AA") {  // hours, tenths of mm, condition (2: a trace), quality
        const auto hours = coded(at(0)), tenths = coded(at(1));
        if (!hours || *hours < 1.0 || !good(at(3))) return;
        if (tenths || at(2) == "2") {
            rows_.fell_before(Field::Precip, tenths.value_or(0.0) * 0.1, *hours);
            amounts_ = true;
        }
    } else if (kind == "AJ") {  // depth in cm
        const auto cm = coded(at(0));
        if (cm && good(at(2))) rows_.set(Field::SnowDepth, *cm * 0.01);
    } else if (kind == "AW" || kind == "MW") {
        const auto code = to_integer(at(0));
        if (!code || *code < 0 || *code > 99 || !good(at(1))) return;
        const PresentWeather w = weather_of_code(static_cast<int>(*code), kind == "AW");
        falls_ = falls_ || w.falls;
        rain_mm_h_ = std::max(rain_mm_h_, w.rain_mm_h);
        snow_mm_h_ = std::max(snow_mm_h_, w.snow_mm_h);
    } else if (kind == "AU") {
        // Intensity 1 light, 2 moderate, 3 heavy; precipitation 01 drizzle, 02 rain, 03 snow, 04
        // snow grains, 05 ice crystals, 06 ice pellets, 07 hail, 08 small hail.
        const auto what = to_integer(at(2));
        if (!what || *what < 1 || *what > 8) return;
        const auto grade = to_integer(at(0));
        const int code = 10 * (*what == 1   ? 5
                               : *what == 2 ? 6
                                            : 7) +
                         1 + 2 * static_cast<int>(std::clamp(grade.value_or(1), 1LL, 3LL) - 1);
        const PresentWeather w = weather_of_code(code, false);
        falls_ = true;
        rain_mm_h_ = std::max(rain_mm_h_, w.rain_mm_h);
        snow_mm_h_ = std::max(snow_mm_h_, w.snow_mm_h);
    } else if (kind == "GF") {  // total coverage
        const double cloud = cloud_of_oktas(at(0));
        if (!std::isnan(cloud)) {
            cloud_ = cloud;
            total_cloud_ = true;
        }
    } else if (kind == "GA" && !total_cloud_) {  // a layer
        const double cloud = cloud_of_oktas(at(0));
        if (!std::isnan(cloud)) cloud_ = std::isnan(cloud_) ? cloud : std::max(cloud_, cloud);
    } else if (kind == "GD" && !total_cloud_) {  // a layer: clear, few, scattered, broken, overcast
        constexpr double kSky[] = {0.0, 0.1875, 0.4375, 0.75, 1.0, 1.0};
        const auto code = to_integer(at(0));
        if (code && *code >= 0 && *code <= 5) {
            const double cloud = kSky[*code];
            cloud_ = std::isnan(cloud_) ? cloud : std::max(cloud_, cloud);
        }
    } else if (kind == "GH") {  // mean of the hour, tenths of W/m2
        const auto tenths = coded(at(0));
        if (tenths && good(at(1))) rows_.set(Field::Shortwave, *tenths * 0.1);
    } else if (kind == "MA") {  // altimeter setting, then the station's own, tenths of hPa
        const auto altimeter = coded(at(0)), station = coded(at(2));
        if (station && good(at(3))) {
            rows_.set(Field::Pressure, *station * 10.0);
            station_pressure_ = true;
        } else if (altimeter && good(at(1))) {
            const double z = std::isnan(elevation_m_) ? 0.0 : elevation_m_;
            rows_.set(Field::Pressure, *altimeter * 10.0 * std::pow(1.0 - 2.25577e-5 * z, 5.25588));
            station_pressure_ = true;
        }
    }
}

void IsdReport::metar(std::string_view text)
{
    // "MET104MOBOB0 METAR 7026 //008 000000 101404Z AUTO .."
    const auto start = text.find("METAR ");
    const auto speci = text.find("SPECI ");
    const auto at = std::min(start, speci);
    if (at == text.npos) return;
    const auto w = words(text.substr(at + 6, 300), 60);
    std::string plain = "XXXX 010000Z";
    bool body = false;
    for (const auto word : w) {
        if (body) plain.append(" ").append(word);
        body = body || (word.size() == 7 && word.back() == 'Z' && to_integer(word.substr(0, 6)));
    }
    const auto r = parse_metar(plain);
    if (!r) return;
    if (std::isnan(air_k_) && !std::isnan(r->temp_c)) {
        air_k_ = r->temp_c + kZeroCelsiusK;
        rows_.set(Field::AirTemp, air_k_);
        if (!std::isnan(r->dew_c)) rows_.set(Field::DewPoint, r->dew_c + kZeroCelsiusK);
    }
    if (std::isnan(cloud_)) cloud_ = r->cloud;
    if (!falls_ && r->weather_seen && r->rain_mm_h + r->snow_mm_h > 0.0) {
        falls_ = true;
        rain_mm_h_ = r->rain_mm_h;
        snow_mm_h_ = r->snow_mm_h;
    }
    if (!std::isnan(r->snow_depth_m)) rows_.set(Field::SnowDepth, r->snow_depth_m);
}

void IsdReport::end()
{
    if (std::isnan(cloud_))
        rows_.missing(Field::Cloud);
    else
        rows_.set(Field::Cloud, cloud_);
    if (!station_pressure_ && !std::isnan(sea_pa_))
        rows_.set(Field::Pressure, station_pressure_pa(sea_pa_, elevation_m_, air_k_));
    if (falls_) rows_.set(Field::SnowShare, snow_mm_h_ / (rain_mm_h_ + snow_mm_h_));
    rows_.precipitation_seen((rain_mm_h_ + snow_mm_h_) / 3600.0);
}

}  // namespace petrichor::weather
