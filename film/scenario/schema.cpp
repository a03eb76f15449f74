#include "film/scenario/schema.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "base/error.h"
#include "film/scenario/scenario.h"
#include "film/toml/questions.h"
#include "film/toml/toml_value.h"
#include "scene/material_table.h"

namespace petrichor::film {
namespace {

using Json = nlohmann::ordered_json;
using Asked = std::map<std::string, std::vector<Question>>;
using Kind = Question::Kind;

bool by_name(const std::string& table)
{
    return table == "materials" || table == "nodes" || table == "decals" || table == "shapes" || table == "lamps";
}

// Reading a file of one key tells what is asked of its value, whatever comes of it.
void ask(const std::string& table, const std::string& key, const std::string& value, Asked& all)
{
    const std::string head = "[" + table + (by_name(table) ? ".x" : "") + "]\n";
    Questions questions;
    try {
        parse_scenario(head + key + " = " + value + "\n", "schema");
    } catch (const Error&) {
        // A value that is refused was asked for before.
    }
    for (const auto& [path, list] : questions.asked()) {
        std::vector<Question>& known = all[path];
        for (const Question& one : list) {
            if (std::find(known.begin(), known.end(), one) == known.end()) known.push_back(one);
        }
    }
}

const std::vector<Question>& questions_at(const Asked& asked, const std::string& path)
{
    static const std::vector<Question> none;
    const auto found = asked.find(path);
    return found == asked.end() ? none : found->second;
}

// Path of a key of a table: "sun.turbidity", "[materials.\"x\"].roughness_factor".
std::string path_of(const std::string& table, const std::string& key)
{
    return (by_name(table) ? "[" + table + ".\"x\"]" : table) + "." + key;
}

Asked asked_of(const std::string& table, const std::string& key, const std::string& example)
{
    Asked asked;
    for (const std::string& value : {example, std::string("\"?\""), std::string("0"), std::string("true"),
                                     std::string("[0]"), std::string("[{}]"), std::string("{}")}) {
        ask(table, key, value, asked);
    }
    const std::string path = path_of(table, key);
    for (const std::string& place : {path, path + "[]"}) {
        const auto list = questions_at(asked, place);
        for (const Question& one : list) {
            for (const std::string& word : one.words) {
                if (one.kind != Kind::Table) continue;
                for (const char* value : {"0", "[0]", "{}"}) {
                    std::string text = "{" + word + " = " + value + "}";
                    // Keys of the weather are read when they have a time.
                    if (table == "weather" && key == "keys" && word != "time_s") text.insert(1, "time_s = 0, ");
                    ask(table, key, place == path ? text : "[" + text + "]", asked);
                }
            }
        }
    }
    return asked;
}

Json number(const Question& q, bool whole)
{
    constexpr double kAny = 3e38;
    Json json{{"type", whole ? "integer" : "number"}};
    if (q.low > -kAny) json["minimum"] = q.low;
    if (q.high < kAny) json["maximum"] = q.high;
    return json;
}

Json many(const Json& each, std::size_t least, std::size_t most)
{
    return {{"type", "array"}, {"items", each}, {"minItems", least}, {"maxItems", most}};
}

Json over_time(const Json& value)
{
    return {{"type", "array"},
            {"description", "[[time_s, value], ...]"},
            {"items", {{"type", "array"}, {"items", Json::array({Json{{"type", "number"}}, value})},
                       {"minItems", 2}, {"maxItems", 2}}},
            {"minItems", 1}};
}

Json value_at_path(const Asked& asked, const std::string& path);

Json table_of(const Asked& asked, const std::string& path, const std::vector<std::string>& words)
{
    Json properties = Json::object();
    for (const std::string& word : words) properties[word] = value_at_path(asked, path + "." + word);
    return {{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
}

// What a question allows, each an alternative; a question that another one asks on its way adds nothing.
void add_alternatives(const Asked& asked, const std::string& path, const Question& q, bool composed,
                      std::vector<Json>& all)
{
    switch (q.kind) {
        case Kind::Number:
            if (!composed) all.push_back(number(q, false));
            break;
        case Kind::Integer:
            all.push_back(number(q, true));
            break;
        case Kind::Boolean:
            all.push_back({{"type", "boolean"}});
            break;
        case Kind::Text:
            all.push_back({{"type", "string"}});
            break;
        case Kind::Choice:
            all.push_back({{"enum", q.words}});
            break;
        case Kind::Numbers:
            if (!composed) all.push_back(many(number(q, false), q.count, q.count));
            break;
        case Kind::Keyed:
            all.push_back(number(q, false));
            all.push_back(over_time(number(q, false)));
            break;
        case Kind::KeyedNumbers: {
            const Json value = many(number(q, false), q.count, q.count);
            all.push_back(value);
            all.push_back(over_time(value));
            break;
        }
        case Kind::Array:
            if (!composed)
                all.push_back({{"type", "array"}, {"items", value_at_path(asked, path + "[]")}});
            break;
        case Kind::Table:
            all.push_back(table_of(asked, path, q.words));
            break;
    }
}

// Anything where nothing is asked.
Json value_at_path(const Asked& asked, const std::string& path)
{
    const std::vector<Question>& questions = questions_at(asked, path);
    const auto has = [&](std::initializer_list<Kind> kinds) {
        return std::any_of(questions.begin(), questions.end(), [&](const Question& q) {
            return std::find(kinds.begin(), kinds.end(), q.kind) != kinds.end();
        });
    };
    std::vector<Json> all;
    for (const Question& q : questions) {
        const bool composed = q.kind == Kind::Array
                                  ? has({Kind::Numbers, Kind::Keyed, Kind::KeyedNumbers})
                              : q.kind == Kind::Numbers ? has({Kind::KeyedNumbers})
                                                        : has({Kind::Keyed});
        std::vector<Json> more;
        add_alternatives(asked, path, q, composed, more);
        for (Json& one : more) {
            if (std::find(all.begin(), all.end(), one) == all.end()) all.push_back(std::move(one));
        }
    }
    if (all.empty()) return Json::object();
    return all.size() == 1 ? all[0] : Json{{"anyOf", all}};
}

// Materials have ranges of their own for each component.
Json of_material(const scene::MaterialProperty& property)
{
    if (property.kind == scene::PropertyKind::Flag) return {{"type", "boolean"}};
    if (property.kind == scene::PropertyKind::Choice)
        return {{"enum", std::vector<std::string>(property.words.begin(), property.words.end())}};
    Json components = Json::array();
    for (int i = 0; i < property.count; ++i) {
        const Json range = number({.low = property.low[i], .high = property.high[i]}, false);
        components.push_back(std::isnan(property.also) ? range
                                                       : Json{{"anyOf", {range, {{"enum", {property.also}}}}}});
    }
    const auto count = static_cast<std::size_t>(property.count);
    const Json value = property.count == 1 ? components[0] : many(components, count, count);
    return property.keyed ? Json{{"anyOf", {value, over_time(value)}}} : value;
}

Json as_json(const toml::node& node)
{
    if (const auto* array = node.as_array()) {
        Json json = Json::array();
        for (const auto& element : *array) json.push_back(as_json(element));
        return json;
    }
    if (const auto* table = node.as_table()) {
        Json json = Json::object();
        for (const auto& [key, value] : *table) json[std::string(key.str())] = as_json(value);
        return json;
    }
    if (node.is_boolean()) return *node.value<bool>();
    if (node.is_integer()) return *node.value<std::int64_t>();
    if (node.is_floating_point()) return *node.value<double>();
    return node.value<std::string>().value_or("");
}

Json of_key(const ScenarioKey& key)
{
    const scene::MaterialProperty* property =
        key.table == "materials" ? scene::find_property(key.name) : nullptr;
    Json json = property
                    ? of_material(*property)
                    : value_at_path(asked_of(key.table, key.name, key.example), path_of(key.table, key.name));
    json["description"] = key.meaning;
    json["examples"] = Json::array({as_json(*parse_toml("v = " + key.example, "schema").get("v"))});
    return json;
}

// [weather.artist], whose parameters have a table of their own.
Json of_artist()
{
    Asked asked = asked_of("weather", "artist", "{}");
    const std::string initial = "weather.artist.initial";
    const auto list = questions_at(asked, initial);
    for (const Question& one : list) {
        for (const std::string& word : one.words) ask("weather", "artist", "{initial = {" + word + " = 0}}", asked);
    }
    Json json = value_at_path(asked, "weather.artist");
    json["description"] = "how the artist model reacts";
    return json;
}

Json object(const std::string& meaning, Json properties)
{
    return {{"type", "object"},
            {"description", meaning},
            {"properties", std::move(properties)},
            {"additionalProperties", false}};
}

// [[variant]] and [[view]]: a name and tables of the scenario.
Json parts(const std::string& meaning, const std::vector<std::string>& tables)
{
    Json properties{{"name", {{"type", "string"}, {"description", "becomes part of file names"}}}};
    for (const std::string& table : tables) properties[table] = {{"$ref", "#/definitions/" + table}};
    Json part = object(meaning, std::move(properties));
    part["required"] = {"name"};
    return {{"type", "array"}, {"items", part}};
}

}  // namespace

std::string scenario_schema()
{
    Json tables = Json::object();
    for (const ScenarioKey& key : scenario_keys()) tables[key.table][key.name] = of_key(key);
    tables["weather"]["artist"] = of_artist();
    Json definitions = Json::object();
    Json root = Json::object();
    for (auto& [table, properties] : tables.items()) {
        Json one = object(table_meaning(table), std::move(properties));
        definitions[table] =
            by_name(table) ? Json{{"type", "object"}, {"description", table_meaning(table)}, {"additionalProperties", one}}
                           : one;
        root[table] = {{"$ref", "#/definitions/" + table}};
    }
    root["variant"] = parts("The same frames under other conditions.", scenario_variant_tables());
    root["view"] = parts("The same frames from another camera.", {"camera"});
    Json schema{{"$schema", "http://json-schema.org/draft-07/schema#"},
                {"title", "scenario of petrichor"},
                {"type", "object"},
                {"properties", root},
                {"additionalProperties", false},
                {"definitions", definitions}};
    return schema.dump(1) + "\n";
}

}  // namespace petrichor::film
