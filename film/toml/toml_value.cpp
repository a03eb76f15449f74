#include "film/toml/toml_value.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "base/error.h"
#include "base/input_file.h"
#include "base/words.h"
#include "film/toml/questions.h"

namespace petrichor::film {
namespace {

std::string shown(const toml::node& node)
{
    if (const auto* number = node.as_floating_point()) return number_text(number->get());
    std::ostringstream out;
    node.visit([&](const auto& value) { out << value; });
    std::string text = out.str();
    for (char& c : text) {
        if (c == '\n') c = ' ';
    }
    if (text.size() > 60) text = text.substr(0, 57) + "...";
    return text;
}

// A limit may be a float that became a double.
std::string limit_text(double limit)
{
    const auto rounded = static_cast<float>(limit);
    return static_cast<double>(rounded) == limit ? number_text(rounded) : number_text(limit);
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
    note_question(key_, {.kind = Question::Kind::Number, .low = low, .high = high});
    const auto value = node_->value<double>();
    const bool is_number = node_->is_integer() || node_->is_floating_point();
    if (!is_number || !value || !(*value >= low && *value <= high)) {
        refuse("a number from " + limit_text(low) + " to " + limit_text(high));
    }
    return *value;
}

int TomlValue::integer(int low, int high) const
{
    note_question(key_, {.kind = Question::Kind::Integer, .low = static_cast<double>(low), .high = static_cast<double>(high)});
    const auto value = node_->value<std::int64_t>();
    if (!node_->is_integer() || !value || *value < low || *value > high) {
        refuse("a whole number from " + std::to_string(low) + " to " + std::to_string(high));
    }
    return static_cast<int>(*value);
}

bool TomlValue::boolean() const
{
    note_question(key_, {.kind = Question::Kind::Boolean});
    if (!node_->is_boolean()) refuse("true or false");
    return *node_->value<bool>();
}

std::string TomlValue::text() const
{
    note_question(key_, {.kind = Question::Kind::Text});
    if (!node_->is_string()) refuse("a text in quotes");
    return *node_->value<std::string>();
}

bool TomlValue::is_text() const
{
    return node_->is_string();
}

int TomlValue::choice(const std::vector<std::string>& words) const
{
    note_question(key_, {.kind = Question::Kind::Choice, .words = words});
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
    note_question(key_, {.kind = Question::Kind::Array});
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
    note_question(key_, {.kind = Question::Kind::Numbers, .low = low, .high = high, .count = count});
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
    note_question(key_, {.kind = Question::Kind::Keyed, .low = low, .high = high});
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
    note_question(key_,
                  {.kind = Question::Kind::KeyedNumbers, .low = low, .high = high, .count = count});
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
    note_question(key_, {.kind = Question::Kind::Table, .words = known});
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

namespace {

constexpr std::size_t kMostBytes = 8 << 20;
constexpr int kDeepest = 64;  // brackets around a value; parts of a key

// The parser recurses into brackets and makes a table of every part of a key, which are then let go
// by recursion too: a hostile file would run out of stack. One pass over the text, strings and
// comments left out, before it gets there.
class NestingCheck {
public:
    NestingCheck(std::string_view text, const std::string& file) : text_(text), file_(file) {}

    void run()
    {
        while (at_ < text_.size()) {
            const char c = text_[at_];
            if (c == '#') {
                at_ = std::min(text_.find('\n', at_), text_.size());
            } else if (c == '"' || c == '\'') {
                skip_string(c);
            } else {
                if (c == '\n') ++line_;
                if (c == '[' || c == '{') ++depth_;
                if ((c == ']' || c == '}') && depth_ > 0) --depth_;
                if (c == '.') ++parts_;
                if (std::string_view("\n=,[]{}").find(c) != std::string_view::npos) parts_ = 0;
                if (depth_ > kDeepest) refuse("brackets nested deeper than ");
                if (parts_ >= kDeepest) refuse("a key of more parts than ");
                ++at_;
            }
        }
    }

private:
    void skip_string(char quote)
    {
        const std::string three(3, quote);
        const bool many_lines = text_.substr(at_, 3) == three;
        at_ += many_lines ? 3 : 1;
        while (at_ < text_.size()) {
            const char c = text_[at_];
            if (c == '\n') {
                if (!many_lines) return;  // not closed: the parser says so
                ++line_;
            }
            if (c == '\\' && quote == '"') {
                at_ += 2;
            } else if (many_lines ? text_.substr(at_, 3) == three : c == quote) {
                at_ += many_lines ? 3 : 1;
                while (many_lines && at_ < text_.size() && text_[at_] == quote) ++at_;
                return;
            } else {
                ++at_;
            }
        }
    }
    [[noreturn]] void refuse(const std::string& what) const
    {
        throw Error(file_ + ":" + std::to_string(line_) + ": " + what + std::to_string(kDeepest),
                    "Correct this line; no file of petrichor needs more than a few.");
    }

    std::string_view text_;
    const std::string& file_;
    std::size_t at_ = 0;
    int line_ = 1, depth_ = 0, parts_ = 0;
};

}  // namespace

toml::table parse_toml(std::string_view text, const std::string& file)
{
    if (text.size() > kMostBytes) {
        throw Error(
            file + ": it has " + std::to_string(text.size()) + " bytes, at most " +
                std::to_string(kMostBytes) + " are read as TOML",
            "Check that it is the file you mean; weather of many hours belongs into a CSV.");
    }
    NestingCheck(text, file).run();
    try {
        return toml::parse(text, file);
    } catch (const toml::parse_error& error) {
        throw Error(file + ":" + std::to_string(error.source().begin.line) +
                        ": not valid TOML: " + std::string(error.description()),
                    "Correct this line; strings need quotes, tables are written [name].");
    }
}

std::string read_toml_text(const std::filesystem::path& path, std::string_view what)
{
    return read_file(path, what, kMostBytes);
}

std::string toml_quoted(std::string_view text)
{
    if (!is_utf8(text)) {
        throw Error("\"" + printable(text) + "\" is not UTF-8, which is all that TOML can hold",
                    "Rename the file, or name a link to it.");
    }
    std::string quoted = "\"";
    for (const char c : text) {
        const auto code = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') {
            quoted += {'\\', c};
        } else if (code < 0x20 || code == 0x7f) {
            char escape[8];
            std::snprintf(escape, sizeof escape, "\\u%04X", code);
            quoted += escape;
        } else {
            quoted += c;
        }
    }
    return quoted + "\"";
}

void refuse_name(const std::string& place, const std::string& what, const std::string& name,
                 const std::vector<std::string>& known)
{
    throw Error(place + ": unknown " + what + ": \"" + name + "\"." + did_you_mean(name, known),
                "Use one of: " + join_words(known) + ".");
}

}  // namespace petrichor::film
