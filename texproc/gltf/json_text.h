#ifndef PETRICHOR_TEXPROC_GLTF_JSON_TEXT_H
#define PETRICHOR_TEXPROC_GLTF_JSON_TEXT_H

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace petrichor::texproc {

/// JSON that is to be changed in places: what nobody edits is written again byte for byte, numbers,
/// spaces and the order of members included.
class JsonText {
public:
    enum class Kind { Null, Bool, Number, String, Object, Array };

    /// Throws Error that names the place.
    static JsonText parse(std::string text);
    static JsonText object();
    static JsonText array();
    static JsonText number(std::size_t value);
    static JsonText string(std::string_view value);

    Kind kind() const { return kind_; }
    std::string dump() const;

    // ---- reading: what is missing or of another kind is absent --------------------------------
    const JsonText* find(std::string_view key) const;  ///< of an object
    std::size_t size() const;                          ///< of an array or object
    const JsonText& at(std::size_t index) const { return items_[index]; }
    const std::vector<std::string>& keys() const { return keys_; }  ///< of the items of an object
    std::optional<double> as_number() const;
    std::optional<std::size_t> as_index() const;  ///< a whole number that is not negative
    std::optional<std::string> as_string() const;

    // ---- editing ------------------------------------------------------------------------------
    /// The member to be changed; a missing one is made, an empty object.
    JsonText& edit(std::string_view key);
    JsonText& edit(std::size_t index);
    void set(std::string_view key, JsonText value);
    bool erase(std::string_view key);
    void append(JsonText value);

private:
    friend class JsonReader;
    void write(std::string& to) const;

    Kind kind_ = Kind::Null;
    bool changed_ = true;
    std::shared_ptr<const std::string> text_;  // of the whole, so that copies stay whole
    std::string_view source_;                  // of this value, where it is unchanged
    std::string made_;                         // the text of a made number or string
    std::vector<std::string> keys_;
    std::vector<JsonText> items_;
};

}  // namespace petrichor::texproc

#endif
