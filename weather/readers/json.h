#ifndef PETRICHOR_WEATHER_READERS_JSON_H
#define PETRICHOR_WEATHER_READERS_JSON_H

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace petrichor::weather {

/// A JSON value, as far as weather files need it. Depth is limited to 32, so damaged input cannot
/// exhaust the stack.
struct Json {
    enum class Kind { Null, Bool, Number, String, Array, Object };
    Kind kind = Kind::Null;
    double number = 0.0;
    bool flag = false;
    std::string text;
    std::vector<Json> items;
    struct Member;  // named type: a pair of an incomplete type is one that Clang cannot hold
    std::vector<Member> members;
    std::size_t line = 1;  ///< where it begins

    /// Member of an object, or null.
    const Json* find(std::string_view key) const;
};

struct Json::Member {
    std::string name;
    Json value;
};

/// Parses a whole text.
///   throws  Error with the line of the first mistake
Json parse_json(std::string_view text);

}  // namespace petrichor::weather

#endif
