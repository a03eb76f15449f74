#include "film/jobs/weather_source.h"

#include <filesystem>
#include <memory>
#include <utility>

#include "base/error.h"
#include "base/words.h"
#include "film/data/folders.h"
#include "film/scenario/weather_script.h"
#include "film/toml/toml_value.h"
#include "film/weather/inputs.h"
#include "film/weather/weather_input.h"

namespace petrichor::film {
namespace {

namespace fs = std::filesystem;

WeatherSource from_script(WeatherScript script, std::string name)
{
    WeatherSource source;
    source.name = std::move(name);
    source.duration_s = script.duration_s;
    const auto weather = std::make_shared<const weather::ArtistTimeline>(script.solve());
    const auto shared = std::make_shared<const WeatherScript>(std::move(script));
    source.at = [shared, weather](double time_s) {
        return weather_moment(*shared, *weather, time_s);
    };
    return source;
}

// An hour of a weather file is a second of the film.
constexpr double kFileSpeed = 3600.0;

WeatherSource from_weather_file(const fs::path& file, const std::string& name)
{
    const auto read = read_forcing(read_inputs({file.string()}), {});
    return from_script(faster_script(script_of_forcing(read.table, name), kFileSpeed), name);
}

// A preset by name, else a file beside the scenario or as given.
WeatherSource named(const std::string& asked, const fs::path& folder)
{
    const auto presets = preset_names("weather");
    for (const std::string& preset : presets) {
        if (preset != asked) continue;
        const fs::path file = data_folder() / "weather" / (preset + ".toml");
        return from_script(
            read_weather_script(read_toml_text(file, "weather"), file.filename().string()), preset);
    }
    for (const fs::path& file : {folder / asked, fs::path(asked)}) {
        std::error_code ignored;
        if (!fs::is_regular_file(file, ignored)) continue;
        const std::string name = printable(fs::path(asked).stem().string());
        if (file.extension() == ".toml")
            return from_script(read_weather_script(read_toml_text(file, "weather"), asked), name);
        return from_weather_file(file, name);
    }
    throw Error(
        "weather: \"" + asked + "\" is neither a preset nor a file." + did_you_mean(asked, presets),
        presets.empty() ? "Name a .toml file with a [weather] table, or a weather file."
                        : "Presets: " + join_words(presets) + ".");
}

}  // namespace

WeatherSource weather_source(const Scenario& scenario, const std::string& asked)
{
    if (!asked.empty()) return named(asked, fs::path());
    if (!scenario.weather_preset.empty()) return named(scenario.weather_preset, scenario.folder);
    if (scenario.has_weather) {
        return from_script(read_weather_script(scenario.text, scenario.name),
                           fs::path(scenario.name).stem().string());
    }
    return {"none", 0.0, [](double) { return WeatherMoment{}; }};
}

}  // namespace petrichor::film
