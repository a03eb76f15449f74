#include "texproc/gltf/json_text.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "base/error.h"

namespace petrichor::texproc {

namespace {

constexpr int kDeepest = 200;

std::string in_quotes(std::string_view value)
{
    std::string to = "\"";
    for (const char c : value) {
        if (c == '"' || c == '\\') {
            to += '\\';
            to += c;
        } else if (static_cast<unsigned char>(c) < 0x20) {
            constexpr char kHex[] = "0123456789abcdef";
            to += "\\u00";
            to += kHex[(c >> 4) & 15];
            to += kHex[c & 15];
        } else {
            to += c;
        }
    }
    return to + "\"";
}

void put_utf8(std::string& to, std::uint32_t code)
{
    if (code < 0x80) {
        to += static_cast<char>(code);
        return;
    }
    const int more = code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;
    constexpr std::uint32_t kLead[4] = {0, 0xc0, 0xe0, 0xf0};
    to += static_cast<char>(kLead[more] | (code >> (6 * more)));
    for (int i = more; i-- > 0;) to += static_cast<char>(0x80 | ((code >> (6 * i)) & 0x3f));
}

}  // namespace

class JsonReader {
public:
    explicit JsonReader(std::shared_ptr<const std::string> text)
        : text_(std::move(text)), rest_(*text_)
    {
    }

    JsonText whole()
    {
        JsonText value = read(0);
        skip_spaces();
        if (at_ != rest_.size()) fail("there is more after the end");
        return value;
    }

private:
    [[noreturn]] void fail(const std::string& what) const
    {
        throw Error("glTF: its JSON is damaged at byte " + std::to_string(at_) + ": " + what,
                    "Copy the file again, or export the scene again.");
    }
    void skip_spaces()
    {
        while (at_ < rest_.size() && (rest_[at_] == ' ' || rest_[at_] == '\t' ||
                                      rest_[at_] == '\n' || rest_[at_] == '\r'))
            ++at_;
    }
    char peek() const { return at_ < rest_.size() ? rest_[at_] : '\0'; }
    void take(char c)
    {
        if (peek() != c) fail(std::string("'") + c + "' is missing");
        ++at_;
    }
    void take_word(std::string_view word)
    {
        if (rest_.substr(at_, word.size()) != word) fail("an unknown word");
        at_ += word.size();
    }

    JsonText read(int depth)
    {
        if (depth > kDeepest) fail("it is nested too deeply");
        skip_spaces();
        const std::size_t start = at_;
        JsonText value;
        value.changed_ = false;
        value.text_ = text_;
        switch (peek()) {
            case '{':
                read_object(value, depth);
                break;
            case '[':
                read_array(value, depth);
                break;
            case '"':
                value.kind_ = JsonText::Kind::String;
                string();
                break;
            case 't':
                value.kind_ = JsonText::Kind::Bool;
                take_word("true");
                break;
            case 'f':
                value.kind_ = JsonText::Kind::Bool;
                take_word("false");
                break;
            case 'n':
                take_word("null");
                break;
            default:
                value.kind_ = JsonText::Kind::Number;
                while (at_ < rest_.size() && std::string_view("+-.eE0123456789").find(rest_[at_]) !=
                                                 std::string_view::npos)
                    ++at_;
                if (at_ == start) fail("a value is missing");
        }
        value.source_ = rest_.substr(start, at_ - start);
        return value;
    }

    void read_object(JsonText& value, int depth)
    {
        value.kind_ = JsonText::Kind::Object;
        take('{');
        skip_spaces();
        while (peek() != '}') {
            if (!value.items_.empty()) take(',');
            skip_spaces();
            value.keys_.push_back(string());
            skip_spaces();
            take(':');
            value.items_.push_back(read(depth + 1));
            skip_spaces();
        }
        take('}');
    }

    void read_array(JsonText& value, int depth)
    {
        value.kind_ = JsonText::Kind::Array;
        take('[');
        skip_spaces();
        while (peek() != ']') {
            if (!value.items_.empty()) take(',');
            value.items_.push_back(read(depth + 1));
            skip_spaces();
        }
        take(']');
    }

    std::uint32_t four_digits()
    {
        std::uint32_t code = 0;
        for (int i = 0; i < 4; ++i, ++at_) {
            const std::size_t digit =
                std::string_view("0123456789abcdef").find(static_cast<char>(peek() | 0x20));
            if (digit == std::string_view::npos || peek() == '\0') fail("a broken \\u");
            code = code << 4 | static_cast<std::uint32_t>(digit);
        }
        return code;
    }

    std::string string()
    {
        std::string to;
        take('"');
        while (peek() != '"') {
            if (at_ >= rest_.size() || static_cast<unsigned char>(peek()) < 0x20)
                fail("a string without its end");
            const char c = rest_[at_++];
            if (c != '\\') {
                to += c;
                continue;
            }
            const char e = peek();
            ++at_;
            switch (e) {
                case 'b':
                    to += '\b';
                    break;
                case 'f':
                    to += '\f';
                    break;
                case 'n':
                    to += '\n';
                    break;
                case 'r':
                    to += '\r';
                    break;
                case 't':
                    to += '\t';
                    break;
                case 'u': {
                    std::uint32_t code = four_digits();
                    if (code >= 0xd800 && code < 0xdc00 && rest_.substr(at_, 2) == "\\u") {
                        at_ += 2;
                        code = 0x10000 + ((code & 0x3ff) << 10) + (four_digits() & 0x3ff);
                    }
                    put_utf8(to, code);
                    break;
                }
                case '"':
                case '\\':
                case '/':
                    to += e;
                    break;
                default:
                    fail("an unknown escape");
            }
        }
        take('"');
        return to;
    }

public:
    static std::string decoded(std::string_view source)
    {
        return JsonReader(std::make_shared<const std::string>(source)).string();
    }

private:
    std::shared_ptr<const std::string> text_;
    std::string_view rest_;
    std::size_t at_ = 0;
};

JsonText JsonText::parse(std::string text)
{
    return JsonReader(std::make_shared<const std::string>(std::move(text))).whole();
}

JsonText JsonText::object()
{
    JsonText made;
    made.kind_ = Kind::Object;
    return made;
}

JsonText JsonText::array()
{
    JsonText made;
    made.kind_ = Kind::Array;
    return made;
}

JsonText JsonText::number(std::size_t value)
{
    JsonText made;
    made.kind_ = Kind::Number;
    made.made_ = std::to_string(value);
    return made;
}

JsonText JsonText::string(std::string_view value)
{
    JsonText made;
    made.kind_ = Kind::String;
    made.made_ = in_quotes(value);
    return made;
}

void JsonText::write(std::string& to) const
{
    if (!changed_) {
        to += source_;
        return;
    }
    switch (kind_) {
        case Kind::Null:
            to += "null";
            return;
        case Kind::Bool:
        case Kind::Number:
        case Kind::String:
            to += made_;
            return;
        case Kind::Object:
        case Kind::Array:
            break;
    }
    to += kind_ == Kind::Object ? '{' : '[';
    for (std::size_t i = 0; i < items_.size(); ++i) {
        if (i) to += ',';
        if (kind_ == Kind::Object) to += in_quotes(keys_[i]) + ":";
        items_[i].write(to);
    }
    to += kind_ == Kind::Object ? '}' : ']';
}

std::string JsonText::dump() const
{
    std::string to;
    write(to);
    return to;
}

const JsonText* JsonText::find(std::string_view key) const
{
    const auto at = std::find(keys_.begin(), keys_.end(), key);
    return at == keys_.end() ? nullptr : &items_[static_cast<std::size_t>(at - keys_.begin())];
}

std::size_t JsonText::size() const
{
    return items_.size();
}

std::optional<double> JsonText::as_number() const
{
    if (kind_ != Kind::Number) return {};
    const std::string text(changed_ ? std::string_view(made_) : source_);
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (end != text.c_str() + text.size()) return {};
    return value;
}

std::optional<std::size_t> JsonText::as_index() const
{
    const std::optional<double> value = as_number();
    if (!value || !(*value >= 0.0 && *value < 4294967296.0)) return {};
    const auto whole = static_cast<std::size_t>(*value);
    if (static_cast<double>(whole) != *value) return {};
    return whole;
}

std::optional<std::string> JsonText::as_string() const
{
    if (kind_ != Kind::String) return {};
    return JsonReader::decoded(changed_ ? std::string_view(made_) : source_);
}

JsonText& JsonText::edit(std::string_view key)
{
    if (!find(key)) set(key, object());
    changed_ = true;
    return items_[static_cast<std::size_t>(std::find(keys_.begin(), keys_.end(), key) -
                                           keys_.begin())];
}

JsonText& JsonText::edit(std::size_t index)
{
    changed_ = true;
    return items_[index];
}

void JsonText::set(std::string_view key, JsonText value)
{
    changed_ = true;
    const auto at = std::find(keys_.begin(), keys_.end(), key);
    if (at != keys_.end()) {
        items_[static_cast<std::size_t>(at - keys_.begin())] = std::move(value);
        return;
    }
    keys_.emplace_back(key);
    items_.push_back(std::move(value));
}

bool JsonText::erase(std::string_view key)
{
    const auto at = std::find(keys_.begin(), keys_.end(), key);
    if (at == keys_.end()) return false;
    changed_ = true;
    items_.erase(items_.begin() + (at - keys_.begin()));
    keys_.erase(at);
    return true;
}

void JsonText::append(JsonText value)
{
    changed_ = true;
    items_.push_back(std::move(value));
}

}  // namespace petrichor::texproc
