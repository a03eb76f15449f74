#include "film/scenario/scenario.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <sstream>

#include "base/error.h"
#include "film/scenario/material_keys.h"
#include "film/scenario/starter.h"

namespace petrichor::film {
namespace {

using testing::HasSubstr;

struct Message {
    std::string problem;
    std::string fix;
};

Message error_of(const std::string& text)
{
    try {
        parse_scenario(text, "s.toml");
    } catch (const Error& error) {
        return {error.what(), error.fix()};
    }
    return {"no error", ""};
}

TEST(Scenario, EmptyTextGivesTheDefaults)
{
    const Scenario scenario = parse_scenario("", "s.toml");
    EXPECT_EQ(scenario.output.width, 640);
    EXPECT_EQ(scenario.output.height, 360);
    EXPECT_EQ(scenario.output.frames, 48);
    EXPECT_FALSE(scenario.weather.given());
}

TEST(Scenario, ReadsEveryKindOfValue)
{
    const Scenario scenario = parse_scenario(R"(
[scene]
file = "town.glb"
[camera]
interpolation = "linear"
keys = [{ time_s = 0, position_m = [1, 2, 3], look_at_m = [0, 0, 0] },
        { time_s = 4.5, position_m = [1, 2, 4], look_at_m = [0, 0, 0], fov_degrees = 30 }]
[sun]
elevation_degrees = [[0, 40], [10, -5.5]]
[lights]
lamps = "dusk"
[output]
width = 320
aovs = ["depth", "wetness"]
[weather]
preset = "storm"
[materials."*brick*"]
porosity = 0.7
water_accumulation = [0, 1, 0.5, 1]
[materials."glass"]
sheltered = true
)",
                                             "s.toml");
    EXPECT_EQ(scenario.scene.file, "town.glb");
    ASSERT_EQ(scenario.camera.keys.size(), 2u);
    EXPECT_EQ(scenario.camera.interpolation, Interpolation::Linear);
    EXPECT_EQ(scenario.camera.keys[1].fov_degrees, 30.0);
    EXPECT_EQ(scenario.camera.keys[1].position_m->z, 4.0);
    ASSERT_EQ(scenario.sun.elevation_degrees.keys.size(), 2u);
    EXPECT_EQ(scenario.sun.elevation_degrees.keys[1].value, -5.5);
    EXPECT_EQ(scenario.lights.lamps, Lamps::Dusk);
    EXPECT_EQ(scenario.output.width, 320);
    EXPECT_THAT(scenario.output.aovs, testing::ElementsAre("depth", "wetness"));
    EXPECT_TRUE(scenario.weather.given());
    ASSERT_EQ(scenario.materials.size(), 2u);
    EXPECT_EQ(scenario.materials[0].glob, "*brick*");
    EXPECT_EQ(scenario.materials[0].values.size(), 2u);
}

TEST(Scenario, FogEndsBehindItsBeginning)
{
    const auto read = [](const char* keys) {
        return parse_scenario(std::string("[fog]\nmode = \"linear\"\n") + keys, "s.toml");
    };
    EXPECT_THROW(read("start_m = 50\nend_m = 10\n"), Error);
    EXPECT_THROW(read("start_m = 100\n"), Error) << "the end is 100 by itself";
    EXPECT_THROW(read("start_m = [[0, 5], [10, 80]]\nend_m = 60\n"), Error);
    EXPECT_NO_THROW(read("start_m = 5\nend_m = 60\n"));
}

TEST(Scenario, ATrackLeadsSomewhere)
{
    const auto with = [](const std::string& points) {
        return error_of("[ground]\ntracks = [{ kind = \"feet\", points_m = " + points + " }]\n");
    };
    for (const char* points : {"[]", "[[0, 0, 1]]", "[[0, 0, 1], [0, 0, 1]]"})
        EXPECT_THAT(with(points).problem, HasSubstr("two different points")) << points;
    EXPECT_EQ(with("[[0, 0, 1], [2, 0, 1]]").problem, "no error");
}

TEST(Scenario, ProbesAreAWordOrAList)
{
    const auto of = [](const std::string& value) { return "[render]\nprobes = " + value + "\n"; };
    EXPECT_TRUE(parse_scenario("", "s.toml").render.probes.automatic);
    const ScenarioProbes off = parse_scenario(of("\"off\""), "s.toml").render.probes;
    EXPECT_FALSE(off.automatic);
    EXPECT_TRUE(off.places.empty());
    const ScenarioProbes own =
        parse_scenario(of("[{ position_m = [1, 2, 3], low_m = [0, 0, 0], high_m = [4, 4, 4], "
                          "importance = 2, intensity = 0.5 }]"),
                       "s.toml")
            .render.probes;
    ASSERT_EQ(own.places.size(), 1u);
    EXPECT_EQ(own.places[0].high_m.y, 4.0f);
    EXPECT_EQ(own.places[0].importance, 2.0f);
    EXPECT_THAT(error_of(of("\"on\"")).problem, HasSubstr("\"auto\" or \"off\""));
    EXPECT_THAT(error_of(of("[{ low_m = [0, 0, 0] }]")).problem, HasSubstr("position_m"));
    EXPECT_THAT(error_of(of("[{ position_m = [9, 0, 0], high_m = [1, 1, 1] }]")).problem,
                HasSubstr("between low_m and high_m"));
    EXPECT_THAT(error_of(of("[{ position_m = [0, 0, 0], radius = 1 }]")).problem, HasSubstr("radius"));
    std::string nine = "[";
    for (int i = 0; i < 9; ++i) nine += "{ position_m = [0, 0, 0] }, ";
    EXPECT_THAT(error_of(of(nine + "]")).problem, HasSubstr("at most 8 probes"));
}

TEST(Scenario, AMisspeltKeyNamesLineAndNearest)
{
    const Message message = error_of("[output]\nframes = 3\nwidht = 64\n");
    EXPECT_THAT(message.problem, HasSubstr("s.toml:3"));
    EXPECT_THAT(message.problem, HasSubstr("\"widht\""));
    EXPECT_THAT(message.problem, HasSubstr("Did you mean \"width\"?"));
    EXPECT_THAT(message.fix, HasSubstr("samples"));
}

TEST(Scenario, MisspeltTablesAndMaterialKeysToo)
{
    EXPECT_THAT(error_of("[outptu]\nframes = 3\n").problem, HasSubstr("Did you mean \"output\"?"));
    EXPECT_THAT(error_of("\n[materials.x]\nporosty = 1\n").problem, HasSubstr("s.toml:3"));
    EXPECT_THAT(error_of("[materials.x]\nporosty = 1\n").problem,
                HasSubstr("Did you mean \"porosity\"?"));
    EXPECT_THAT(error_of("frames = 3\n").problem, HasSubstr("s.toml:1"));
    EXPECT_THAT(error_of("[camera]\nkeys = [{ time_s = 0, position = [0, 0, 0] }]\n").problem,
                HasSubstr("Did you mean \"position_m\"?"));
}

struct BadValue {
    const char* name;
    const char* text;
    const char* expected;
};
void PrintTo(const BadValue& value, std::ostream* out)
{
    *out << value.name;
}

class ScenarioBadValue : public testing::TestWithParam<BadValue> {};
TEST_P(ScenarioBadValue, NamesPlaceFoundAndAccepted)
{
    const Message message = error_of(GetParam().text);
    EXPECT_THAT(message.problem, HasSubstr("s.toml:2")) << message.problem;
    EXPECT_THAT(message.problem, HasSubstr(GetParam().expected));
    EXPECT_FALSE(message.fix.empty());
}
INSTANTIATE_TEST_SUITE_P(
    Table, ScenarioBadValue,
    testing::Values(
        BadValue{"zero_width", "[output]\nwidth = 0", "a whole number from 1 to 16384, got 0"},
        BadValue{"fraction", "[output]\nframes = 2.5", "a whole number"},
        BadValue{"text_for_number", "[output]\nfps = \"12\"", "a number from"},
        BadValue{"not_finite", "[output]\nfps = nan", "a number from"},
        BadValue{"choice", "[lights]\nlamps = \"maybe\"", "\"on\" or \"off\" or \"dusk\""},
        BadValue{"unordered_keys", "[sun]\nelevation_degrees = [[3, 1], [2, 1]]",
                 "later than the key before"},
        BadValue{"short_point", "[camera]\nposition_m = [1, 2]", "an array of 3 numbers"},
        BadValue{"half_a_camera_key", "[camera]\nkeys = [{ time_s = 1, position_m = [1, 2, 3] }]",
                 "look_at_m"},
        BadValue{"material_range", "[materials.x]\nporosity = 2", "from 0 to 1, or -1, got 2"},
        BadValue{"not_a_table", "\noutput = 3", "a table"},
        BadValue{"syntax", "[output]\nwidth = = 3", "not valid TOML"}),
    [](const auto& test) { return test.param.name; });

TEST(Scenario, TheStarterParsesAsItStands)
{
    const Scenario scenario = parse_scenario(starter_scenario("mine", "a.glb"), "mine.toml");
    EXPECT_EQ(scenario.scene.file, "a.glb");
    EXPECT_TRUE(scenario.weather.given());
    EXPECT_TRUE(scenario.materials.empty());
}

TEST(Scenario, TheStarterNamesEveryKey)
{
    const std::string text = starter_scenario("mine", "a.glb");
    for (const ScenarioKey& key : scenario_keys()) {
        EXPECT_THAT(text, HasSubstr(key.name + " = ")) << key.table;
        EXPECT_FALSE(key.meaning.empty()) << key.name;
        EXPECT_FALSE(table_meaning(key.table).empty()) << key.table;
    }
}

// [weather.artist] with every number of the model; uncommented it is accepted.
TEST(Scenario, TheStarterNamesEveryParameterOfTheModel)
{
    const std::string text = starter_scenario("mine", "a.glb");
    const std::size_t at = text.find("# [weather.artist]\n");
    ASSERT_NE(at, std::string::npos);
    std::string table = "[weather]\nfile = \"a.epw\"\nmodel = \"artist\"\n";
    std::istringstream lines(text.substr(at, text.find("\n\n", at) - at));
    for (std::string line; std::getline(lines, line);) {
        if (line.find(" = ") != line.npos || line.find('[') == 2) table += line.substr(2) + "\n";
    }
    for (const auto& parameter : weather::artist_parameters())
        EXPECT_THAT(table, HasSubstr("\n" + std::string(parameter.name) + " = "));
    const Scenario scenario = parse_scenario(table, "s.toml");
    ASSERT_TRUE(scenario.weather.artist.has_value());
    EXPECT_EQ(scenario.weather.artist->params.accumulation_rate_snow,
              weather::ArtistParams{}.accumulation_rate_snow);
}

// Each documented example is accepted by itself, whatever its table holds besides.
TEST(Scenario, EveryDocumentedKeyIsAccepted)
{
    ASSERT_GT(scenario_keys().size(), 50u);
    std::set<std::string> seen;
    for (const ScenarioKey& key : scenario_keys()) {
        EXPECT_TRUE(seen.insert(key.table + "." + key.name).second)
            << key.name << " is there twice";
        const bool by_name = key.table == "materials" || key.table == "lamps" || key.table == "decals" ||
                             key.table == "nodes" || key.table == "shapes";
        const std::string table = by_name ? key.table + ".\"*\"" : key.table;
        const std::string head =
            "[" + table + "]\n" + (key.name == "cookie_size_m" ? "cookie = \"leaves.png\"\n" : "") +
                                 (key.name == "white_balance_strength" ? "white_balance_k = \"auto\"\n" : "") +
                                 (key.name.starts_with("ocio_") && key.name != "ocio_config" ? "ocio_config = \"c.ocio\"\n" : "");
        std::string text = head + key.name + " = " + key.example + "\n";
        if (key.name == "position_m") text += "look_at_m = [0, 0, 0]\n";
        if (key.name == "look_at_m") text += "position_m = [0, 0, 0]\n";
        const bool of_keys =
            key.name == "interpolation" || key.name == "duration_s" || key.name == "loop";
        if (key.table == "weather" && of_keys)
            text += "keys = [{ time_s = 0, temperature_c = 1, rainfall = 0 }]\n";
        EXPECT_NO_THROW(parse_scenario(text, "s.toml")) << text;
        if (key.keyed) {
            const std::string value = key.example.starts_with("[[") ? "1.0" : key.example;
            EXPECT_NO_THROW(parse_scenario(head + key.name + " = [[0, " + value + "], [2.5, " + value + "]]\n",
                                           "s.toml"))
                << key.name;
        }
    }
}

TEST(Scenario, ASizeOfNoPictureIsRefused)
{
    EXPECT_THROW(parse_scenario("[sun]\ncookie_size_m = 3.0\n", "s.toml"), Error);
    const Scenario s = parse_scenario("[sun]\ncookie = \"a.png\"\ncookie_size_m = 3.0\n", "s.toml");
    EXPECT_EQ(s.sun.cookie, "a.png");
    EXPECT_EQ(value_at(s.sun.cookie_size_m, 0.0), 3.0);
    const Scenario two = parse_scenario(
        "[sun]\ncookie = \"a.png\"\ncookie_size_m = 3.0\n[[variant]]\nname = \"bare\"\n"
        "sun = { cookie = \"\" }\n[[variant]]\nname = \"leaves\"\n",
        "s.toml");
    EXPECT_EQ(two.variants.at(0).conditions.sun.cookie, "");
    EXPECT_EQ(two.variants.at(1).conditions.sun.cookie, "a.png");
}

}  // namespace
}  // namespace petrichor::film
