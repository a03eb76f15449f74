#include "film/scenario/weather_script.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "base/error.h"
#include "base/words.h"
#include "film/scenario/weather_table.h"
#include "weather/models/physical/mapping.h"

namespace petrichor::film {
namespace {

using weather::Channel;

// A quantity that a key may name.
struct Quantity {
    std::string name;
    double low = 0.0;
    double high = 0.0;
    std::string channel = {};             ///< another name's channel, for a quantity in SI ...
    double (*to_unit)(double) = nullptr;  ///< ... and how it becomes 0..1 there
};

// Part C's maps, on asphalt.
double depth_share(double depth_m)
{
    return depth_m * 1e3 / weather::Surface{}.puddles.depth_mm;
}

std::vector<Quantity> quantities()
{
    std::vector<Quantity> all{{"temperature_c", -100.0, 60.0},    {"rainfall", 0.0, 1.0},
                              {"cloud_cover", 0.0, 1.0},          {"wind_m_s", 0.0, 80.0},
                              {"wind_from_deg", -3600.0, 3600.0}, {"visibility_m", 20.0, 2.0e5},
                              {"sun_elevation_deg", -90.0, 90.0},
                              {"sun_azimuth_deg", -3600.0, 3600.0}};
    for (const auto& parameter : weather::artist_parameters()) {
        all.push_back({std::string(parameter.name), parameter.low, parameter.high});
    }
    all.push_back({"script_controlled", 0.0, 1.0});
    for (const auto& state : weather::hand_set_states())
        all.push_back({std::string(state.name), 0.0, 1.0});
    all.push_back({"rain_mm_h", 0.0, 50.0, "rainfall",
                   [](double v) { return weather::rainfall_of_rate({}, v); }});
    all.push_back(
        {"film_mm", 0.0, 9.5, "wetness", [](double v) { return weather::wetness_of_film({}, v); }});
    all.push_back(
        {"snow_depth_m", 0.0, 1.9, "snow", [](double v) { return weather::snow_of_depth({}, v); }});
    all.push_back({"puddle_depth_m", 0.0, 0.015, "puddles", depth_share});
    return all;
}

// Where a quantity of the file goes.
Channel& channel_of(WeatherScript& script, const std::string& name)
{
    if (name == "temperature_c") return script.timeline.temperature_c;
    if (name == "rainfall") return script.timeline.rainfall;
    if (name == "cloud_cover") return script.sky.cloud_cover;
    if (name == "wind_m_s") return script.sky.wind_m_s;
    if (name == "wind_from_deg") return script.sky.wind_from_deg;
    if (name == "visibility_m") return script.sky.visibility_m;
    if (name == "sun_elevation_deg") return script.sun_elevation_deg;
    if (name == "sun_azimuth_deg") return script.sun_azimuth_deg;
    for (const auto& state : weather::hand_set_states()) {
        if (state.name == name) return script.timeline.states[name];
    }
    return script.timeline.parameters[name];
}

struct SlopedNumber {
    double value = 0.0;
    weather::KeySlopes slopes;
};

// v, [v, slope] or [v, slope_in, slope_out]; a slope is a change a second.
SlopedNumber sloped_number(const TomlValue& value, const Quantity& quantity,
                           weather::Interpolation interpolation)
{
    if (!value.is_array()) return {value.number(quantity.low, quantity.high), {}};
    const auto elements = value.elements();
    if (elements.size() != 2 && elements.size() != 3)
        value.refuse("a number, [value, slope] or [value, slope_in, slope_out]");
    if (interpolation != weather::Interpolation::Smooth)
        value.refuse("a number alone: only keys with interpolation = \"smooth\" have slopes");
    if (quantity.to_unit || quantity.name == "script_controlled")
        value.refuse("a number alone: " + quantity.name + " takes no slopes");
    return {elements[0].number(quantity.low, quantity.high),
            {elements[1].number(-1e9, 1e9), elements.back().number(-1e9, 1e9)}};
}

// Slopes of one's own may carry a quantity out of its range between its keys.
void check_ranges(const TomlValue& keys, const std::vector<Quantity>& known,
                  const std::vector<std::string>& started, WeatherScript& script)
{
    for (const std::string& name : started) {
        const auto quantity = std::find_if(known.begin(), known.end(),
                                           [&](const Quantity& q) { return q.name == name; });
        const auto range = weather::range_of(channel_of(script, name));
        constexpr double kRounding = 1e-9;
        if (range.low >= quantity->low - kRounding && range.high <= quantity->high + kRounding)
            continue;
        keys.refuse("gentler in its slopes: between its keys " + name + " reaches " +
                    number_text(range.low) + " to " + number_text(range.high) +
                    ", and may be " + number_text(quantity->low) + " to " +
                    number_text(quantity->high));
    }
}

void read_keys(const TomlValue& keys, weather::Interpolation interpolation, WeatherScript& script)
{
    const std::vector<Quantity> known = quantities();
    std::vector<std::string> names{"time_s"};
    for (const Quantity& quantity : known) names.push_back(quantity.name);
    std::vector<std::string> started;  // channels that hold keys of the file, not their default
    std::optional<weather::TimeUs> last;
    for (const TomlValue& key : keys.elements()) {
        const auto entries = key.entries(names);
        std::optional<weather::TimeUs> time;
        for (const auto& [name, value] : entries) {
            if (name == "time_s") time = weather::to_time_us(value.number(0.0, 1e9));
        }
        if (!time) key.refuse("a table with time_s");
        if (last && *time <= *last) key.refuse("later than the key before it");
        last = time;
        for (const auto& [name, value] : entries) {
            if (name == "time_s") continue;
            const std::string& key_name = name;
            const auto quantity = std::find_if(
                known.begin(), known.end(), [&](const Quantity& q) { return q.name == key_name; });
            const std::string& target = quantity->to_unit ? quantity->channel : key_name;
            Channel& channel = channel_of(script, target);
            if (std::find(started.begin(), started.end(), target) == started.end()) {
                started.push_back(target);
                const bool hold = name == "script_controlled";  // a switch
                channel = {.times = {},
                           .values = {},
                           .interpolation = hold ? weather::Interpolation::Hold : interpolation};
            }
            if (!channel.times.empty() && channel.times.back() == *time)
                key.refuse("one of " + target + " and the same in SI, not both");
            channel.times.push_back(*time);
            const SlopedNumber number = sloped_number(value, *quantity, interpolation);
            channel.values.push_back(quantity->to_unit ? quantity->to_unit(number.value)
                                                       : number.value);
            channel.slopes.push_back(number.slopes);
        }
    }
    check_ranges(keys, known, started, script);
    for (const char* needed : {"temperature_c", "rainfall"}) {
        if (std::find(started.begin(), started.end(), needed) == started.end()) {
            keys.refuse(std::string("an array in which at least one key has ") + needed);
        }
    }
    script.duration_s = weather::to_seconds(*last);
}

std::vector<weather::CurveKey> read_curve(const TomlValue& curve)
{
    std::vector<weather::CurveKey> keys;
    for (const TomlValue& element : curve.elements()) {
        const auto n = element.numbers(4, -HUGE_VAL, HUGE_VAL);
        if (!keys.empty() && n[0] <= keys.back().time)
            element.refuse("later than the key before it");
        keys.push_back({n[0], n[1], n[2], n[3]});
    }
    if (keys.empty()) curve.refuse("at least one [t, v, slope_in, slope_out]");
    return keys;
}

weather::ArtistState read_initial(const TomlValue& table, weather::ArtistState state)
{
    using S = weather::ArtistState;
    static const std::vector<std::pair<std::string, double S::*>> kMembers{
        {"wetness", &S::wetness}, {"cracks", &S::cracks}, {"puddles", &S::puddles},
        {"water", &S::water},     {"snow", &S::snow},     {"water_to_snow", &S::water_to_snow}};
    std::vector<std::string> names;
    for (const auto& member : kMembers) names.push_back(member.first);
    bool water_given = false;
    for (const auto& [name, value] : table.entries(names)) {
        for (const auto& member : kMembers) {
            if (member.first == name) state.*member.second = value.number(0.0, 1.0);
        }
        water_given = water_given || name == "water";
    }
    if (!water_given) state.water = std::max(state.cracks, state.puddles);
    return state;
}

}  // namespace

ArtistSettings artist_settings_from(const TomlValue& artist, ArtistSettings settings)
{
    std::vector<std::string> names{"script_controlled", "water_to_snow_curve", "initial"};
    for (const auto& parameter : weather::artist_parameters()) {
        names.emplace_back(parameter.name);
    }
    for (const auto& [name, value] : artist.entries(names)) {
        if (name == "script_controlled") {
            settings.params.script_controlled = value.boolean();
        } else if (name == "water_to_snow_curve") {
            settings.params.water_to_snow_curve = read_curve(value);
        } else if (name == "initial") {
            settings.initial = read_initial(value, settings.initial);
        } else {
            for (const auto& parameter : weather::artist_parameters()) {
                if (parameter.name != name) continue;
                // The sliders' ranges are advice; the model takes more, but nothing negative.
                const bool height = parameter.name == "snow_start_height_m";
                settings.params.*parameter.member =
                    value.number(height ? -20000.0 : 0.0, std::max(1000.0, parameter.high));
            }
        }
    }
    return settings;
}

WeatherScript weather_script_from(const TomlValue& weather_table)
{
    WeatherScript script;
    auto interpolation = weather::Interpolation::Linear;
    std::optional<double> duration_s;
    std::optional<TomlValue> keys;
    for (const auto& [name, value] : weather_table.entries(
             {"model", "interpolation", "duration_s", "loop", "keys", "artist"})) {
        if (name == "model") {
            value.choice({"artist", "auto"});
        } else if (name == "interpolation") {
            interpolation = *weather::interpolation_named(std::vector<std::string>{
                "hold", "linear",
                "smooth"}[static_cast<std::size_t>(value.choice({"hold", "linear", "smooth"}))]);
        } else if (name == "duration_s") {
            duration_s = value.number(0.0, 1e9);
        } else if (name == "loop") {
            script.loop = value.boolean();
        } else if (name == "keys") {
            keys = value;
        } else {
            const ArtistSettings settings = artist_settings_from(value);
            script.params = settings.params;
            script.initial = settings.initial;
        }
    }
    if (!keys || keys->elements().empty()) {
        weather_table.refuse(
            "a table with keys = [{time_s = 0, temperature_c = .., rainfall = ..}]");
    }
    read_keys(*keys, interpolation, script);
    if (duration_s) script.duration_s = *duration_s;
    return script;
}

WeatherScript read_weather_script(std::string_view toml_text, const std::string& file)
{
    const toml::table root = parse_toml(toml_text, file);
    const toml::node* table = root.get("weather");
    if (!table) {
        throw Error(file + ": no [weather] table",
                    "Add [weather] with keys, or name a preset of data/weather.");
    }
    WeatherScript script = weather_script_from(TomlValue(*table, file, "weather"));
    if (const auto name = root["name"].value<std::string>()) script.name = *name;
    if (const auto text = root["description"].value<std::string>()) script.description = *text;
    return script;
}

ArtistSettings read_artist_settings(std::string_view toml_text, const std::string& file,
                                    double time_scale)
{
    const toml::table root = parse_toml(toml_text, file);
    ArtistSettings settings;
    settings.params.time_scale = time_scale;
    for (const auto& [key, node] : root) {
        const std::string name(key.str());
        const TomlValue value(node, file, name);
        if (name == "site") continue;
        if (name != "artist") refuse_name(value.place(), "table", name, {"artist", "site"});
        settings = artist_settings_from(value, settings);
    }
    return settings;
}

}  // namespace petrichor::film
