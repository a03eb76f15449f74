#include "film/toml/toml_value.h"

#include <cmath>
#include <sstream>

#include "base/error.h"
#include "base/words.h"

namespace petrichor::film {
namespace {

std::string shown(const toml::node& node)
{
    std::ostringstream out;
    node.visit([&](const auto& value) { out << value; });
    std::string text = out.str();
    for (char& c : text) {
        if (c == '\n') c = ' ';
    }
    if (text.size() > 60) text = text.substr(0, 57) + "...";
    return text;
}

}  // namespace

std::string TomlValue::place() const
{
    return file_ + ":" + std::to_string(node_->source().begin.line);
}

void TomlValue::refuse(const std::string& expected) const
{
    throw Error(place() + ": " + key_ + " must be " + expected + ", got " + shown(*node_),
                "Correct this line; `petrichor init` writes a file that explains every key.");
}

double TomlValue::number(double low, double high) const
{
    const auto value = node_->value<double>();
    const bool is_number = node_->is_integer() || node_->is_floating_point();
    if (!is_number || !value || !(*value >= low && *value <= high)) {
        refuse("a number from " + number_text(low) + " to " + number_text(high));
    }
    return *value;
}

int TomlValue::integer(int low, int high) const
{
    const auto value = node_->value<std::int64_t>();
    if (!node_->is_integer() || !value || *value < low || *value > high) {
        refuse("a whole number from " + std::to_string(low) + " to " + std::to_string(high));
    }
    return static_cast<int>(*value);
}

bool TomlValue::boolean() const
{
    if (!node_->is_boolean()) refuse("true or false");
    return *node_->value<bool>();
}

std::string TomlValue::text() const
{
    if (!node_->is_string()) refuse("a text in quotes");
    return *node_->value<std::string>();
}

int TomlValue::choice(const std::vector<std::string>& words) const
{
    if (node_->is_string()) {
        const std::string found = *node_->value<std::string>();
        for (std::size_t i = 0; i < words.size(); ++i) {
            if (words[i] == found) return static_cast<int>(i);
        }
    }
    refuse(std::string(1, '"').append(join_words(words, "\" or \"")).append(1, '"'));
}

std::vector<TomlValue> TomlValue::elements() const
{
    const toml::array* array = node_->as_array();
    if (!array) refuse("an array");
    std::vector<TomlValue> values;
    for (std::size_t i = 0; i < array->size(); ++i) {
        values.emplace_back(*array->get(i), file_, key_ + "[" + std::to_string(i) + "]");
    }
    return values;
}

std::vector<double> TomlValue::numbers(std::size_t count, double low, double high) const
{
    const toml::array* array = node_->as_array();
    if (!array || array->size() != count)
        refuse("an array of " + std::to_string(count) + " numbers");
    std::vector<double> values;
    for (const TomlValue& element : elements()) values.push_back(element.number(low, high));
    return values;
}

glm::dvec3 TomlValue::point() const
{
    const auto values = numbers(3, -1e6, 1e6);
    return {values[0], values[1], values[2]};
}

std::vector<std::string> TomlValue::texts() const
{
    std::vector<std::string> values;
    for (const TomlValue& element : elements()) values.push_back(element.text());
    return values;
}

KeyedNumber TomlValue::keyed(double low, double high) const
{
    KeyedNumber number;
    if (!node_->is_array()) {
        number.keys.push_back({0.0, this->number(low, high)});
        return number;
    }
    for (const TomlValue& element : elements()) {
        const toml::array* pair = element.node_->as_array();
        if (!pair || pair->size() != 2) element.refuse("a pair [time_s, value]");
        const auto both = element.elements();
        const NumberKey key{both[0].number(-1e9, 1e9), both[1].number(low, high)};
        if (!number.keys.empty() && key.time_s <= number.keys.back().time_s) {
            element.refuse("later than the key before it");
        }
        number.keys.push_back(key);
    }
    if (number.keys.empty()) refuse("a number or at least one [time_s, value]");
    return number;
}

std::vector<KeyedNumber> TomlValue::keyed_numbers(std::size_t count, double low, double high) const
{
    if (count == 1) return {keyed(low, high)};
    std::vector<KeyedNumber> channels(count);
    const toml::array* array = node_->as_array();
    if (!array || array->empty() || !array->get(0)->is_array()) {
        const auto values = numbers(count, low, high);
        for (std::size_t i = 0; i < count; ++i) channels[i].keys.push_back({0.0, values[i]});
        return channels;
    }
    for (const TomlValue& element : elements()) {
        const toml::array* pair = element.node_->as_array();
        if (!pair || pair->size() != 2)
            element.refuse("a pair [time_s, [" + std::to_string(count) + " numbers]]");
        const auto both = element.elements();
        const double time_s = both[0].number(-1e9, 1e9);
        const auto values = both[1].numbers(count, low, high);
        if (!channels[0].keys.empty() && time_s <= channels[0].keys.back().time_s)
            element.refuse("later than the key before it");
        for (std::size_t i = 0; i < count; ++i) channels[i].keys.push_back({time_s, values[i]});
    }
    return channels;
}

Interpolation TomlValue::interpolation() const
{
    static constexpr Interpolation kMeanings[] = {Interpolation::Hold, Interpolation::Linear,
                                                  Interpolation::Smooth};
    return kMeanings[choice({"hold", "linear", "smooth"})];
}

std::vector<std::pair<std::string, TomlValue>> TomlValue::entries(
    const std::vector<std::string>& known) const
{
    const toml::table* table = node_->as_table();
    if (!table) refuse("a table");
    std::vector<std::pair<std::string, TomlValue>> found;
    for (const auto& [key, node] : *table) {
        const std::string name(key.str());
        bool exists = false;
        for (const std::string& word : known) exists = exists || word == name;
        const TomlValue value(node, file_, key_ + "." + name);
        if (!exists) refuse_name(value.place(), "key in " + key_, name, known);
        found.emplace_back(name, value);
    }
    return found;
}

toml::table parse_toml(std::string_view text, const std::string& file)
{
    try {
        return toml::parse(text, file);
    } catch (const toml::parse_error& error) {
        throw Error(file + ":" + std::to_string(error.source().begin.line) +
                        ": not valid TOML: " + std::string(error.description()),
                    "Correct this line; strings need quotes, tables are written [name].");
    }
}

void refuse_name(const std::string& place, const std::string& what, const std::string& name,
                 const std::vector<std::string>& known)
{
    throw Error(place + ": unknown " + what + ": \"" + name + "\"." + did_you_mean(name, known),
                "Use one of: " + join_words(known) + ".");
}

}  // namespace petrichor::film
