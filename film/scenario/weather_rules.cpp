#include "film/scenario/rule_tables.h"

namespace petrichor::film {
namespace {

// Keys of [weather] that weather_script_from reads and checks.
void read_by_the_script(Scenario&, const TomlValue&)
{
}

}  // namespace

std::vector<Rule> weather_rules()
{
    return {
        {{"weather", "preset", "\"rain-then-snow\"",
          "a name that `petrichor doctor` lists, or a .toml file with a [weather] table", false,
          true},
         [](Scenario& s, const TomlValue& v) {
             s.weather.preset = v.text();
             if (s.weather.preset.empty()) v.refuse("the name of a preset or a file");
         }},
        {{"weather", "file", "\"denver.epw\"",
          "or a weather file (EPW, METAR, CSV, .. as `petrichor simulate` reads): sun, clouds, "
          "wind "
          "and sight follow it"},
         [](Scenario& s, const TomlValue& v) {
             s.weather.file = v.text();
             if (s.weather.file.empty()) v.refuse("the name of a weather file");
         }},
        {{"weather", "model", "\"auto\"",
          "physical (SI: energy and water balance), artist (0..1), or auto: physical for a file"},
         [](Scenario& s, const TomlValue& v) {
             s.weather.model = static_cast<WeatherModel>(v.choice({"auto", "artist", "physical"}));
         }},
        {{"weather", "start", "\"01-10\"",
          "when in the file the clock's 0 s is: ISO 8601 (without a zone by the clock of its place), month and "
          "day, or seconds; else its first row"},
         [](Scenario& s, const TomlValue& v) { s.weather.start = v.text(); }},
        {{"weather", "end", "\"01-12\"", "and when the film ends, unless output.duration_s says"},
         [](Scenario& s, const TomlValue& v) { s.weather.end = v.text(); }},
        {{"weather", "hours_per_second", "1.0",
          "hours of the file for a second of the clock, 0.0001 to 10000"},
         [](Scenario& s, const TomlValue& v) { s.weather.hours_per_second = v.number(1e-4, 1e4); }},
        {{"weather", "surface", "\"asphalt\"",
          "of the physical model: concrete, paving_stones, cobblestone, brick, soil, grass, .."},
         [](Scenario& s, const TomlValue& v) { s.weather.site.surface = v.text(); }},
        {{"weather", "spin_up_days", "30.0",
          "the physical model begins this long before `start`; else with the file's first row"},
         [](Scenario& s, const TomlValue& v) { s.weather.spin_up_days = v.number(0.0, 36500.0); }},
        {{"weather", "max_gap_days", "60.0",
          "longest time between two rows of the file; longer ones are refused"},
         [](Scenario& s, const TomlValue& v) { s.weather.site.max_gap_days = v.number(0.0, 1e6); }},
        {{"weather", "date_order", "\"dmy\"",
          "or mdy: of dates such as 01/02/2024 where no row of the file shows which"},
         [](Scenario& s, const TomlValue& v) {
             constexpr const char* kOrders[] = {"dmy", "mdy"};
             s.weather.site.date_order = kOrders[v.choice({"dmy", "mdy"})];
         }},
        {{"weather", "latitude_degrees", "45.3", "north; where the file does not say"},
         [](Scenario& s, const TomlValue& v) {
             s.weather.site.latitude_deg = v.number(-90.0, 90.0);
         }},
        {{"weather", "longitude_degrees", "5.77", "east; likewise"},
         [](Scenario& s, const TomlValue& v) {
             s.weather.site.longitude_deg = v.number(-180.0, 360.0);
         }},
        {{"weather", "elevation_m", "1325.0", "above the sea; likewise"},
         [](Scenario& s, const TomlValue& v) {
             s.weather.site.elevation_m = v.number(-450.0, 9000.0);
         }},
        {{"weather", "station", "\"EGLL\"", "of a METAR file; else the one with most reports"},
         [](Scenario& s, const TomlValue& v) { s.weather.site.station = v.text(); }},
        {{"weather", "month", "\"2024-02\"", "of METAR reports, which say only the day"},
         [](Scenario& s, const TomlValue& v) { s.weather.site.month = v.text(); }},
        {{"weather", "keys",
          "[\n"
          "    { time_s = 0.0, temperature_c = 12.0, rainfall = 0.0, cloud_cover = 0.3 },\n"
          "    { time_s = 10.0, rainfall = 0.8, cloud_cover = 0.9, wind_m_s = 6.0, wind_from_deg = "
          "240.0 },\n"
          "    { time_s = 30.0, temperature_c = -6.0, visibility_m = 2000.0 },\n"
          "]",
          "or keys of your own (rainfall 0 to 1, or rain_mm_h; snow below 0 C)"},
         read_by_the_script},
        {{"weather", "interpolation", "\"linear\"", "between these keys: hold, linear or smooth"},
         read_by_the_script},
        {{"weather", "duration_s", "48.0", "of these keys; else to the last"}, read_by_the_script},
        {{"weather", "loop", "false", "begin these keys again when they end, for ever"},
         read_by_the_script},
    };
}

}  // namespace petrichor::film
