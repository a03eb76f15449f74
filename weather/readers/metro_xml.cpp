#include "weather/readers/metro_xml.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "base/error.h"
#include "weather/physics/cloud_of_air.h"
#include "weather/physics/constants.h"
#include "weather/physics/detail/portable_math.h"
#include "weather/physics/humidity.h"
#include "weather/physics/solar.h"
#include "weather/readers/formats.h"
#include "weather/readers/text.h"

namespace petrichor::weather {

namespace {

constexpr std::size_t kMostRows = 1000000;
constexpr double kMetresPerSecond = 1.0 / 3.6;  // of a km/h
constexpr double kHalfCover = 0.5;              // of a sky of which nothing is known

std::size_t line_of(std::string_view text, std::size_t at)
{
    return 1 + static_cast<std::size_t>(std::count(text.begin(), text.begin() + at, '\n'));
}

// The elements of one name, in order. No element of METRo's files is inside one of its own name;
// attributes (<forecast-time viewed="no">) say nothing that matters here.
class Elements {
public:
    Elements(std::string_view text, std::string_view name)
        : text_(text), open_("<" + std::string(name)), close_("</" + std::string(name) + ">")
    {
    }
    std::optional<std::string_view> next()
    {
        std::size_t begin = text_.find(open_, at_);
        while (begin != std::string_view::npos && !ends_name(begin + open_.size()))
            begin = text_.find(open_, begin + open_.size());
        if (begin == std::string_view::npos) return std::nullopt;
        const std::size_t tag_end = text_.find('>', begin);
        begin_ = begin;
        if (tag_end != std::string_view::npos && text_[tag_end - 1] == '/') {
            at_ = tag_end + 1;
            return std::string_view();
        }
        const std::size_t inside = tag_end + 1;
        const std::size_t end =
            tag_end == std::string_view::npos ? tag_end : text_.find(close_, inside);
        if (end == std::string_view::npos) {
            throw Error("METRo: line " + std::to_string(line_of(text_, begin)) + ": " + open_ +
                            "> has no end",
                        "Give the whole file.");
        }
        at_ = end + close_.size();
        return text_.substr(inside, end - inside);
    }
    std::size_t line() const { return line_of(text_, begin_); }

private:
    bool ends_name(std::size_t at) const
    {
        return at < text_.size() && (text_[at] == '>' || text_[at] == '/' || is_blank(text_[at]));
    }

    std::string_view text_;
    std::string open_, close_;
    std::size_t at_ = 0, begin_ = 0;
};

std::string_view text_of(std::string_view element, std::string_view name)
{
    return trimmed(Elements(element, name).next().value_or(""));
}
double number_of(std::string_view element, std::string_view name)
{
    const std::string_view said = text_of(element, name);
    auto value = to_number(said);
    if (!value && !said.empty()) {
        // Between tags a comma can only be the decimal point.
        std::string point(said);
        std::replace(point.begin(), point.end(), ',', '.');
        value = to_number(point);
        const std::string low = lower(said);
        if (!value && low != "nan" && low != "na" && low != "null" && low != "-")
            throw Error("METRo: <" + std::string(name) + "> holds '" + shown(said) + "', no number",
                        "Write a number, or leave it empty where there is none.");
    }
    if (!value || std::abs(*value) == 999.0 || std::abs(*value) == 9999.0) return kMissing;
    return *value;
}
double within(double value, Field field)
{
    const FieldInfo& info = field_info(field);
    return value >= info.low && value <= info.high ? value : kMissing;
}

void require_root(std::string_view text, const char* root)
{
    if (text.find("<" + std::string(root)) != std::string_view::npos) return;
    throw Error("METRo: the text has no <" + std::string(root) + ">",
                "Give METRo's " + std::string(root) + " file.");
}

// Rows of one kind with their times; rows that do not come later than the one before are dropped.
class TimedRows {
public:
    TimedRows(std::string_view text, const char* element, const char* time)
        : rows_(text, element), element_(element), time_(time)
    {
    }
    std::optional<std::string_view> next()
    {
        while (const auto row = rows_.next()) {
            const auto us = us_from_iso(text_of(*row, time_));
            if (!us) {
                throw Error("METRo: line " + std::to_string(rows_.line()) + ": " + time_ + " '" +
                                shown(text_of(*row, time_)) + "' is not a time",
                            "Write times as 2005-02-24T21:00Z.");
            }
            if (++count_ > kMostRows)
                throw Error("METRo: more than a million rows", "Give a shorter file.");
            if (us_ && *us <= *us_) continue;
            us_ = us;
            return row;
        }
        if (!us_) {
            throw Error("METRo: there is no <" + element_ + ">",
                        "Give a file with at least one <" + element_ + ">.");
        }
        return std::nullopt;
    }
    std::int64_t time_us() const { return *us_; }

private:
    Elements rows_;
    std::string element_, time_;
    std::optional<std::int64_t> us_;
    std::size_t count_ = 0;
};

// Thermal properties that METRo gives its materials, W/m/K and J/m3/K (Crevier & Delage 2001); sand is
// dry here (METRo: 1.0 and 2.0e6).
struct Material {
    const char* name;
    double conductivity, capacity;
};
constexpr Material kMaterials[] = {
    {"asphalt", 0.8, 2.1e6},  {"asphalte", 0.8, 2.1e6}, {"cement", 2.2, 2.1e6},
    {"concrete", 2.2, 2.1e6}, {"ciment", 2.2, 2.1e6},   {"crushedrock", 0.95, 2.1e6},
    {"gravel", 0.95, 2.1e6},  {"gravier", 0.95, 2.1e6}, {"sand", 0.6, 1.6e6},
    {"sable", 0.6, 1.6e6},
};

GroundLayer layer_of(std::string_view element, std::size_t line)
{
    const std::string_view type = text_of(element, "type");
    const auto known = road_layer(type, 0.0);
    const auto own = [&](const char* name, double GroundLayer::*value) {
        const double given = number_of(element, name);
        return std::isnan(given) && known ? (*known).*value : given;
    };
    GroundLayer layer;
    layer.thickness_m = number_of(element, "thickness");
    layer.conductivity_w_m_k = own("conductivity", &GroundLayer::conductivity_w_m_k);
    layer.heat_capacity_j_m3_k = own("capacity", &GroundLayer::heat_capacity_j_m3_k);
    const std::string where = "METRo: line " + std::to_string(line) + ": ";
    if (!(layer.conductivity_w_m_k > 0.0 && layer.heat_capacity_j_m3_k > 0.0)) {
        throw Error(where + "a layer of '" + shown(type) + "'",
                    "Use asphalt, cement (concrete), crushed rock (gravel) or sand, or give "
                    "conductivity and capacity.");
    }
    if (!(layer.thickness_m > 0.0 && layer.thickness_m <= 100.0)) {
        throw Error(where + "a layer's thickness is '" + shown(text_of(element, "thickness")) + "'",
                    "Give a thickness in metres, above 0.");
    }
    return layer;
}

}  // namespace

std::optional<GroundLayer> road_layer(std::string_view material, double thickness_m)
{
    std::string plain;
    for (const char c : lower(trimmed(material)))
        if (c != ' ' && c != '-' && c != '_') plain += c;
    for (const Material& known : kMaterials)
        if (plain == known.name)
            return GroundLayer{thickness_m, known.conductivity, known.capacity};
    return std::nullopt;
}

bool looks_like_metro(std::string_view text)
{
    const std::string_view head = text.substr(0, 2048);
    if (head.find('<') == std::string_view::npos) return false;
    for (const char* root : {"<station>", "<observation>", "<forecast>", "<roadcast>"})
        if (head.find(root) != std::string_view::npos) return true;
    return false;
}

MetroStation read_metro_station(std::string_view text)
{
    require_root(text, "station");
    MetroStation station;
    station.site.name = std::string(text_of(text, "road-station").substr(0, 80));
    station.site.latitude_deg = number_of(text, "latitude");
    station.site.longitude_deg = number_of(text, "longitude");
    if (!(std::abs(station.site.latitude_deg) <= 90.0)) {
        throw Error("METRo: latitude '" + shown(text_of(text, "latitude")) + "'",
                    "Give a latitude in -90..90.");
    }
    // METRo's air is that of 1.5 m, its wind that of 10 m.
    station.site.temp_height_m = 1.5;
    station.bridge = lower(text_of(text, "station-type")) == "bridge";
    if (text_of(text, "sst-sensor-depth-type") == "1") station.subsurface_depth_m = 0.2;
    const double depth_m = number_of(text, "sst-sensor-depth");
    if (depth_m > 0.0 && depth_m < 5.0) station.subsurface_depth_m = depth_m;
    Elements layers(text, "roadlayer");
    while (const auto layer = layers.next())
        station.layers.push_back(layer_of(*layer, layers.line()));
    if (station.layers.empty()) {
        throw Error("METRo: the station has no <roadlayer>",
                    "Give at least one layer with its type and thickness.");
    }
    Elements directions(text, "direction");
    while (const auto direction = directions.next()) {
        const double elevation_deg = number_of(*direction, "elevation");
        if (station.horizon_rad.size() < 3600)
            station.horizon_rad.push_back(
                (std::isnan(elevation_deg) ? 0.0 : std::clamp(elevation_deg, 0.0, 90.0)) * kPi /
                180.0);
    }
    return station;
}

// Zeros of at most an hour between two values that agree: no road freezes to 0.00 and is back so soon.
// Returns how many were made missing.
static std::size_t drop_fallen_to_zero(std::span<const std::int64_t> time_us, std::vector<double>& road_c)
{
    constexpr std::int64_t kLongest_us = 3600LL * kMicrosPerSecond;
    constexpr double kAgree_k = 0.5, kFar_k = 0.75;
    std::size_t dropped = 0;
    for (std::size_t i = 1; i < road_c.size(); ++i) {
        if (road_c[i] != 0.0 || road_c[i - 1] == 0.0) continue;
        std::size_t end = i;
        while (end < road_c.size() && road_c[end] == 0.0) ++end;
        if (end == road_c.size()) break;
        const double before = road_c[i - 1], after = road_c[end];
        const bool blip = time_us[end] - time_us[i - 1] <= kLongest_us &&
                          std::abs(after - before) <= kAgree_k && std::abs(before) >= kFar_k &&
                          std::abs(after) >= kFar_k;
        for (; blip && i < end; ++i, ++dropped) road_c[i] = kMissing;
        i = end;
    }
    return dropped;
}

MetroObservation read_metro_observation(std::string_view text)
{
    require_root(text, "observation");
    MetroObservation out;
    TimedRows rows(text, "measure", "observation-time");
    while (const auto row = rows.next()) {
        ForcingTable& t = out.table;
        t.time_us.push_back(rows.time_us());
        const auto kelvin = [&](const char* name) { return number_of(*row, name) + kZeroCelsiusK; };
        t[Field::AirTemp].push_back(within(kelvin("at"), Field::AirTemp));
        t[Field::DewPoint].push_back(within(kelvin("td"), Field::DewPoint));
        t[Field::Wind].push_back(within(number_of(*row, "ws") * kMetresPerSecond, Field::Wind));
        const auto road = [&](const char* name) {
            const double c = number_of(*row, name);
            return c > -90.0 && c < 100.0 ? c : kMissing;
        };
        out.surface_c.push_back(road("st"));
        out.subsurface_c.push_back(road("sst"));
        const double falls = number_of(*row, "pi");
        out.falling.push_back(falls == 0.0 || falls == 1.0 ? falls : kMissing);
    }
    for (std::vector<double>* road_c : {&out.surface_c, &out.subsurface_c})
        out.fallen_to_zero += drop_fallen_to_zero(out.table.time_us, *road_c);
    return out;
}

// Rain of a measured row, kg m-2 s-1: the station's word before the forecast's. It tells no amount,
// and may stand at 1 for half a day in dry air: rain is what falls warmer than 2 C (phase.all_rain_c)
// into air that it has nearly filled with vapour.
static double rain_of(const MetroObservation& observed, std::size_t row, double forecast_kg_m2_s)
{
    constexpr double kLightRain_kg_m2_s = 1.0 / 3600.0, kAllRain_k = kZeroCelsiusK + 2.0,
                     kNearSaturation_k = 2.0;
    const double falls = observed.falling[row];
    if (falls == 0.0) return 0.0;
    const double air_k = observed.table[Field::AirTemp][row],
                 dew_k = observed.table[Field::DewPoint][row];
    if (falls == 1.0 && air_k > kAllRain_k && air_k - dew_k <= kNearSaturation_k)
        return std::max(kLightRain_kg_m2_s, forecast_kg_m2_s);
    return forecast_kg_m2_s;
}

// Whether a row of a forecast has a clear sky out of which 0.1 mm/h and more fall: some who make
// forecasts leave their cloud at 0.
static bool cloud_left_out(const ForcingTable& forecast, std::size_t row)
{
    constexpr double kFalls_kg_m2_s = 0.0999 / 3600.0;
    const auto of = [&](Field f) { return forecast.has(f) ? forecast[f][row] : 0.0; };
    return of(Field::Cloud) == 0.0 && of(Field::Rain) + of(Field::Snow) >= kFalls_kg_m2_s;
}

static double forecast_cover(const ForcingTable& forecast, std::size_t row)
{
    if (!forecast.has(Field::Cloud)) return kMissing;
    return cloud_left_out(forecast, row) ? 1.0 : forecast[Field::Cloud][row];
}

// Cover with which a forecast begins: the mean of its first hours, one of which alone may be wrong.
static double first_cover(const ForcingTable& forecast)
{
    constexpr auto kFirst_us = static_cast<std::int64_t>(kFirstCloud_h * 3600e6);
    double sum = 0.0;
    std::size_t known = 0;
    for (std::size_t i = 0;
         i < forecast.rows() && forecast.time_us[i] - forecast.time_us[0] < kFirst_us; ++i) {
        const double cover = forecast_cover(forecast, i);
        if (std::isnan(cover)) continue;
        sum += cover;
        ++known;
    }
    return known > 0 ? sum / static_cast<double>(known) : kMissing;
}

// Of the sun's elevation; none where the table has no place.
static std::vector<double> sine_of_rows(const ForcingTable& table)
{
    std::vector<double> sine;
    const Site& site = table.site;
    if (std::isnan(site.latitude_deg) || std::isnan(site.longitude_deg)) return sine;
    const Observer observer(site.latitude_deg, site.longitude_deg);
    for (const std::int64_t us : table.time_us)
        sine.push_back(SunNear(us, observer).at(us).up);
    return sine;
}

ForcingTable observed_weather(const MetroObservation& observed, const ForcingTable& forecast)
{
    ForcingTable t = observed.table;
    t.site = forecast.site;
    const double first = first_cover(forecast);
    const auto kept = [](std::int64_t later_us, double memory_h) {
        return detail::exponential(static_cast<double>(-later_us) / (memory_h * 3600e6));
    };
    std::vector<double> humidity;
    for (std::size_t i = 0; i < t.rows(); ++i)
        humidity.push_back(
            rel_humidity_of_dew_point_pct(t[Field::AirTemp][i], t[Field::DewPoint][i]));
    const std::vector<double> sine = sine_of_rows(t);
    const std::vector<double> air =
        cloud_of_air({t.time_us, humidity, t[Field::AirTemp], sine});
    std::optional<std::int64_t> fell_us;
    for (std::size_t i = 0; i < t.rows(); ++i) {
        const std::int64_t now_us = t.time_us[i];
        double cover = std::isnan(air[i]) ? kHalfCover : air[i];
        const auto next =
            std::upper_bound(forecast.time_us.begin(), forecast.time_us.end(), now_us);
        const auto row = std::max<std::ptrdiff_t>(next - forecast.time_us.begin() - 1, 0);
        const std::int64_t before_us =
            forecast.rows() > 0 ? std::max<std::int64_t>(forecast.time_us[0] - now_us, 0) : 0;
        const double said =
            before_us > 0 ? first : forecast_cover(forecast, static_cast<std::size_t>(row));
        const double worth =
            before_us > 0 ? kForecastCloudWorth * kept(before_us, kForecastCloudMemory_h) : 1.0;
        if (!std::isnan(said)) cover += (said - cover) * worth;
        if (observed.falling[i] == 1.0) fell_us = now_us;
        if (fell_us) cover += (1.0 - cover) * kept(now_us - *fell_us, kRainCloudMemory_h);
        t[Field::Cloud].push_back(cover);
        const bool forecasts = forecast.has(Field::Rain) && now_us >= forecast.time_us[0];
        t[Field::Rain].push_back(
            rain_of(observed, i,
                    forecasts ? forecast[Field::Rain][static_cast<std::size_t>(row)] : 0.0));
        t[Field::Snow].push_back(0.0);
        if (forecast.has(Field::Pressure))
            t[Field::Pressure].push_back(value_at(forecast, Field::Pressure, now_us));
    }
    for (std::size_t i = 0; i < forecast.rows(); ++i) {
        if (!t.time_us.empty() && forecast.time_us[i] <= t.time_us.back()) continue;
        t.time_us.push_back(forecast.time_us[i]);
        if (forecast.has(Field::Pressure))
            t[Field::Pressure].push_back(forecast[Field::Pressure][i]);
        for (const Field f : {Field::AirTemp, Field::DewPoint, Field::Wind})
            t[f].push_back(forecast.has(f) ? forecast[f][i] : kMissing);
        t[Field::Cloud].push_back(forecast_cover(forecast, i));
        t[Field::Rain].push_back(forecast.has(Field::Rain) ? forecast[Field::Rain][i] : 0.0);
        t[Field::Snow].push_back(0.0);
    }
    return t;
}

ForcingTable read_metro_forecast(std::string_view text)
{
    require_root(text, "forecast");
    ForcingTable t;
    std::vector<double> rain_mm, snow_cm, shortwave, longwave;
    TimedRows rows(text, "prediction", "forecast-time");
    while (const auto row = rows.next()) {
        const auto value = [&](const char* name) { return number_of(*row, name); };
        t.time_us.push_back(rows.time_us());
        t[Field::AirTemp].push_back(within(value("at") + kZeroCelsiusK, Field::AirTemp));
        t[Field::DewPoint].push_back(within(value("td") + kZeroCelsiusK, Field::DewPoint));
        t[Field::Wind].push_back(within(value("ws") * kMetresPerSecond, Field::Wind));
        t[Field::Pressure].push_back(within(value("ap") * 100.0, Field::Pressure));
        t[Field::Cloud].push_back(within(value("cc") / 8.0, Field::Cloud));
        rain_mm.push_back(value("ra"));
        snow_cm.push_back(value("sn"));
        shortwave.push_back(within(value("sf"), Field::Shortwave));
        longwave.push_back(within(value("ir"), Field::Longwave));
    }
    // Amounts count from the beginning; a centimetre of new snow is a millimetre of water.
    const auto rates = [&](const std::vector<double>& sums) {
        std::vector<double> out(sums.size(), 0.0);
        std::optional<std::size_t>
            last;  // row with a sum; those without it divide what fell to the next
        for (std::size_t i = 0; i < sums.size(); ++i) {
            if (std::isnan(sums[i])) continue;
            const double fallen = last ? sums[i] - sums[*last] : 0.0;
            if (fallen > 0.0) {
                const double dt_s = static_cast<double>(t.time_us[i] - t.time_us[*last]) * 1e-6;
                for (std::size_t k = *last; k < i; ++k)
                    out[k] = std::min(fallen / dt_s, field_info(Field::Rain).high);
            }
            last = i;
        }
        return out;
    };
    t[Field::Rain] = rates(rain_mm);
    t[Field::Snow] = rates(snow_cm);
    const auto known = [](const std::vector<double>& v) {
        return std::any_of(v.begin(), v.end(), [](double x) { return !std::isnan(x); });
    };
    if (known(shortwave)) t[Field::Shortwave] = std::move(shortwave);
    if (known(longwave)) t[Field::Longwave] = std::move(longwave);
    return t;
}

MetroRoadcast read_metro_roadcast(std::string_view text)
{
    require_root(text, "roadcast");
    MetroRoadcast out;
    TimedRows rows(text, "prediction", "roadcast-time");
    while (const auto row = rows.next()) {
        const auto value = [&](const char* name) { return number_of(*row, name); };
        out.time_us.push_back(rows.time_us());
        out.air_c.push_back(value("at"));
        out.dew_point_c.push_back(value("td"));
        out.wind_m_s.push_back(value("ws") * kMetresPerSecond);
        out.surface_c.push_back(value("st"));
        out.subsurface_c.push_back(value("sst"));
        out.shortwave_w_m2.push_back(value("sf"));
        out.longwave_w_m2.push_back(value("ir"));
        out.rain_mm_h.push_back(value("qp-ra"));
        out.snow_mm_h.push_back(value("qp-sn"));
        const double condition = value("rc");
        const bool known = condition >= 0.0 && condition <= 99.0;
        out.condition.push_back(known ? static_cast<int>(condition) : 0);
    }
    return out;
}

std::string fallen_to_zero_text(const MetroObservation& observed)
{
    return std::to_string(observed.fallen_to_zero) +
           " values of exactly 0 C between others that agree, 0.75 K and more from it: taken as missing";
}

// The air of a forecast or of what a station measured, as weather.
static bool recognise(const FileHead& head)
{
    const std::string_view text = head.text.substr(0, 4096);
    return text.find("<forecast>") != std::string_view::npos ||
           text.find("<observation>") != std::string_view::npos;
}

static void read_metro(std::string_view text, RowCollector& rows, const ReadOptions&)
{
    const bool forecast = text.substr(0, 4096).find("<forecast>") != std::string_view::npos;
    ForcingTable table;
    if (forecast) {
        table = read_metro_forecast(text);
        std::size_t overcast = 0;
        for (std::size_t i = 0; i < table.rows(); ++i) {
            if (!cloud_left_out(table, i)) continue;
            table[Field::Cloud][i] = 1.0;
            ++overcast;
        }
        if (overcast > 0)
            rows.note(ReadNote::Kind::Warning, 0, "cc",
                      "rain or snow falls out of a clear sky in " + std::to_string(overcast) +
                          " rows: taken as overcast there");
    } else {
        MetroObservation observed = read_metro_observation(text);
        table = std::move(observed.table);
        for (const double c : observed.surface_c)
            table[Field::SurfaceTemp].push_back(c + kZeroCelsiusK);
        if (observed.fallen_to_zero > 0)
            rows.note(ReadNote::Kind::Info, 0, "st, sst", fallen_to_zero_text(observed));
    }
    rows.site().temp_height_m = 1.5;
    rows.times_name_their_zone();  // METRo's are UTC
    for (std::size_t i = 0; i < table.rows(); ++i) {
        if (!rows.begin_row(table.time_us[i], 0)) continue;
        for (std::size_t f = 0; f < kFieldCount; ++f) {
            const auto field = static_cast<Field>(f);
            if (!table.has(field)) continue;
            if (std::isnan(table[field][i]))
                rows.missing(field);
            else
                rows.set(field, table[field][i]);
        }
    }
}

extern const Reader metro_reader;
const Reader metro_reader{"METRo XML", "forecast or observation of METRo (station: --road)",
                          recognise, read_metro};

}  // namespace petrichor::weather
