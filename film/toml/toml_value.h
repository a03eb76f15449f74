#ifndef PETRICHOR_FILM_TOML_TOML_VALUE_H
#define PETRICHOR_FILM_TOML_TOML_VALUE_H

#include <toml++/toml.h>

#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "film/toml/keyed.h"

namespace petrichor::film {

/// One value of a TOML file on its way in: every reader checks type and range, and throws Error
/// with "file:line: table.key", the value found and the values accepted.
class TomlValue {
public:
    TomlValue(const toml::node& node, std::string file, std::string key)
        : node_(&node), file_(std::move(file)), key_(std::move(key))
    {
    }

    bool is_array() const { return node_->is_array(); }
    double number(double low, double high) const;
    int integer(int low, int high) const;
    bool boolean() const;
    std::string text() const;
    bool is_text() const;  ///< of any content
    /// Index of the word in `words`.
    int choice(const std::vector<std::string>& words) const;
    std::vector<double> numbers(std::size_t count, double low, double high) const;
    glm::dvec3 point() const;
    std::vector<std::string> texts() const;
    /// A number, or [[time_s, value], ...] with ascending times.
    KeyedNumber keyed(double low, double high) const;
    /// `count` numbers over time: [a, b, ..], or [[time_s, [a, b, ..]], ...]; one number: as
    /// keyed().
    std::vector<KeyedNumber> keyed_numbers(std::size_t count, double low, double high) const;
    Interpolation interpolation() const;
    /// Elements of an array, each under the name key[i].
    std::vector<TomlValue> elements() const;
    /// Entries of a table, each under the name key.name; names not in `known` are errors.
    std::vector<std::pair<std::string, TomlValue>> entries(
        const std::vector<std::string>& known) const;

    std::string place() const;  ///< "file:line"
    /// Throws Error: "file:line: key must be EXPECTED, got FOUND".
    [[noreturn]] void refuse(const std::string& expected) const;

private:
    const toml::node* node_;
    std::string file_;
    std::string key_;
};

/// Parses TOML; a syntax error becomes an Error with file and line. At most 8 MiB, 64 brackets
/// around a value and 64 parts of a key, which is checked before the parser sees the text.
toml::table parse_toml(std::string_view text, const std::string& file);

/// The text of a TOML file for parse_toml(). Throws Error: missing, not a regular file, too large.
std::string read_toml_text(const std::filesystem::path& path, std::string_view what);

/// A TOML string that means `text`: in quotes, with escapes. Throws Error when it is not UTF-8.
std::string toml_quoted(std::string_view text);

/// Throws Error for a name that does not exist at a place, with the nearest that does.
[[noreturn]] void refuse_name(const std::string& place, const std::string& what,
                              const std::string& name, const std::vector<std::string>& known);

}  // namespace petrichor::film

#endif
