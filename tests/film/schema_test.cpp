// The schema of scenarios: what it allows and refuses is what the reader does.
#include "film/scenario/schema.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "film/scenario/scenario.h"
#include "film/toml/questions.h"
#include "film/toml/toml_value.h"

namespace petrichor::film {
namespace {

using nlohmann::json;

json as_json(const toml::node& node)
{
    if (const auto* array = node.as_array()) {
        json all = json::array();
        for (const auto& element : *array) all.push_back(as_json(element));
        return all;
    }
    if (const auto* table = node.as_table()) {
        json all = json::object();
        for (const auto& [key, value] : *table) all[std::string(key.str())] = as_json(value);
        return all;
    }
    if (node.is_boolean()) return *node.value<bool>();
    if (node.is_integer()) return *node.value<std::int64_t>();
    if (node.is_floating_point()) return *node.value<double>();
    return *node.value<std::string>();
}

bool has_type(const json& value, const std::string& type)
{
    if (type == "object") return value.is_object();
    if (type == "array") return value.is_array();
    if (type == "string") return value.is_string();
    if (type == "boolean") return value.is_boolean();
    if (type == "integer") return value.is_number_integer();
    return type == "number" && value.is_number();
}

// The words of draft 7 that the schema uses. Empty: valid; else where it is not.
std::string fault(const json& schema, const json& value, const json& root, const std::string& path = "")
{
    if (schema.contains("$ref")) {
        const json::json_pointer at(schema["$ref"].get<std::string>().substr(1));
        return fault(root.at(at), value, root, path);
    }
    if (schema.contains("anyOf")) {
        std::string last;
        for (const json& one : schema["anyOf"]) {
            last = fault(one, value, root, path);
            if (last.empty()) return "";
        }
        return last;
    }
    if (schema.contains("type") && !has_type(value, schema["type"])) return path + " is no " + schema["type"].dump();
    if (schema.contains("enum") && std::find(schema["enum"].begin(), schema["enum"].end(), value) == schema["enum"].end())
        return path + " is no word of " + schema["enum"].dump();
    if (schema.contains("minimum") && value < schema["minimum"]) return path + " is low";
    if (schema.contains("maximum") && value > schema["maximum"]) return path + " is high";
    if (value.is_array()) {
        if (schema.contains("minItems") && value.size() < schema["minItems"]) return path + " is short";
        if (schema.contains("maxItems") && value.size() > schema["maxItems"]) return path + " is long";
        for (std::size_t i = 0; i < value.size() && schema.contains("items"); ++i) {
            const json& items = schema["items"];
            const std::string found =
                fault(items.is_array() ? items.at(i) : items, value[i], root, path + "[" + std::to_string(i) + "]");
            if (!found.empty()) return found;
        }
    }
    if (!value.is_object()) return "";
    for (const auto& [name, entry] : value.items()) {
        const json properties = schema.value("properties", json::object());
        const json others = schema.value("additionalProperties", json(true));
        if (!properties.contains(name) && others == false) return path + "." + name + " is unknown";
        const json& one = properties.contains(name) ? properties[name] : others;
        if (!one.is_object()) continue;
        const std::string found = fault(one, entry, root, path + "." + name);
        if (!found.empty()) return found;
    }
    for (const json& name : schema.value("required", json::array())) {
        if (!value.contains(name.get<std::string>())) return path + " lacks " + name.dump();
    }
    return "";
}

const json& schema()
{
    static const json one = json::parse(scenario_schema());
    return one;
}

std::string fault_of(const std::string& text)
{
    return fault(schema(), as_json(parse_toml(text, "s.toml")), schema());
}

bool reader_takes(const std::string& text)
{
    try {
        parse_scenario(text, "s.toml");
    } catch (const Error&) {
        return false;
    }
    return true;
}

TEST(ScenarioSchema, KnowsATypeOfEveryKeyAndExplainsIt)
{
    for (const ScenarioKey& key : scenario_keys()) {
        const json& table = schema()["definitions"][key.table];
        const json& object = table.contains("properties") ? table : table["additionalProperties"];
        ASSERT_TRUE(object["properties"].contains(key.name)) << key.table << "." << key.name;
        const json& one = object["properties"][key.name];
        EXPECT_TRUE(one.contains("type") || one.contains("enum") || one.contains("anyOf")) << key.table << "." << key.name;
        EXPECT_EQ(one["description"], key.meaning);
    }
}

// All that the project ships, and each documented example.
TEST(ScenarioSchema, AllowsWhatIsThere)
{
    int files = 0;
    for (const char* folder : {"data/scenarios", "docs/pictures"}) {
        for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(PETRICHOR_SOURCE_DIR) / folder)) {
            if (entry.path().extension() != ".toml") continue;
            EXPECT_EQ(fault_of(read_toml_text(entry.path(), "scenario")), "") << entry.path();
            ++files;
        }
    }
    EXPECT_GT(files, 10);
    for (const ScenarioKey& key : scenario_keys()) {
        const json& table = schema()["definitions"][key.table];
        const std::string head = table.contains("properties") ? "[" + key.table + "]\n" : "[" + key.table + ".x]\n";
        EXPECT_EQ(fault_of(head + key.name + " = " + key.example + "\n"), "") << key.table;
    }
}

TEST(ScenarioSchema, RefusesWhatTheReaderRefuses)
{
    const char* wrong[] = {
        "[camera]\nfov = 40.0\n",
        "[camera]\nfov_degrees = 400.0\n",
        "[camera]\nposition_m = [0.0, 1.0]\n",
        "[camera]\nkeys = [{ time_s = 0.0, position = [0, 0, 0] }]\n",
        "[camera]\nexposure = \"bright\"\n",
        "[sun]\nelevation_degrees = [[0.0, 95.0]]\n",
        "[sun]\nsource = \"moon\"\n",
        "[render]\ntone_map = 3\n",
        "[render]\nprobes = [{ at = [0, 0, 0] }]\n",
        "[output]\nwidth = 64.5\n",
        "[output]\npng = \"yes\"\n",
        "[weather]\nkeys = [{ time_s = 0, temperature_c = 300, rainfall = 0 }]\n",
        "[weather]\nkeys = [{ time_s = 0, temperature_c = 3, rainfall = 0, snowfall = 1 }]\n",
        "[weather]\nfile = \"a\"\nartist = { initial = { snow = 2 } }\n",
        "[weather]\nfile = \"a\"\nartist = { time_scale = -1 }\n",
        "[materials.x]\nroughness_factor = 1.5\n",
        "[materials.x]\nbase_color_factor = [1, 1, 1]\n",
        "[materials.x]\nsecond_set = \"three\"\n",
        "[nodes.x]\ncolor = 1\n",
        "[ground]\ntracks = [{ kind = \"ski\", points_m = [[0, 0, 0], [1, 0, 0]] }]\n",
        "[grund]\npatches = true\n",
        "[[variant]]\nsky = { turbidity = 3 }\n",
        "[[variant]]\nname = \"a\"\nrender = { adaptive = 0 }\n",
    };
    for (const char* text : wrong) {
        EXPECT_NE(fault_of(text), "") << text;
        EXPECT_FALSE(reader_takes(text)) << text;
    }
}

TEST(Questions, AreNotedWhileSomebodyListens)
{
    const toml::table table = parse_toml("a = [[0, 1], [2, 3]]\n", "t");
    const TomlValue value(*table.get("a"), "t", "a");
    value.keyed(0.0, 4.0);
    const Questions listener;
    EXPECT_TRUE(listener.asked().empty());
    {
        const Questions inner;
        value.keyed(0.0, 4.0);
        EXPECT_EQ(inner.asked().at("a").front().kind, Question::Kind::Keyed);
        EXPECT_EQ(inner.asked().at("a").front().high, 4.0);
        EXPECT_TRUE(inner.asked().contains("a[][]"));
    }
    EXPECT_TRUE(listener.asked().empty());
    value.elements();
    EXPECT_EQ(listener.asked().size(), 1u);
}

}  // namespace
}  // namespace petrichor::film
