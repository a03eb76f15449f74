#include "weather/readers/json.h"

#include "base/error.h"
#include "weather/readers/text.h"

namespace petrichor::weather {

namespace {

class Parser {
public:
    explicit Parser(std::string_view text) : text_(text) {}

    Json whole()
    {
        Json value = parse(0);
        skip();
        if (at_ < text_.size()) fail("more text after the end of the value");
        return value;
    }

private:
    [[noreturn]] void fail(const std::string& why) const
    {
        throw Error("weather: JSON line " + std::to_string(line_) + ": " + why + " near '" +
                        shown(text_.substr(at_, 24)) + "'",
                    "Download the file again; it is cut short or damaged.");
    }
    void skip()
    {
        while (at_ < text_.size()) {
            const char c = text_[at_];
            if (c == '\n')
                ++line_;
            else if (c != ' ' && c != '\t' && c != '\r')
                break;
            ++at_;
        }
    }
    bool take(char c)
    {
        skip();
        if (at_ >= text_.size() || text_[at_] != c) return false;
        ++at_;
        return true;
    }
    std::string string()
    {
        if (!take('"')) fail("a text in quotes is missing");
        std::string out;
        while (at_ < text_.size() && text_[at_] != '"') {
            char c = text_[at_++];
            if (c == '\n') fail("a line ends inside a text");
            if (c != '\\') {
                out += c;
                continue;
            }
            if (at_ >= text_.size()) break;
            c = text_[at_++];
            switch (c) {
                case 'n':
                    out += '\n';
                    break;
                case 't':
                    out += '\t';
                    break;
                case 'u':
                    at_ = at_ + 4 <= text_.size() ? at_ + 4 : text_.size();
                    out += '?';
                    break;
                default:
                    out += c;
            }
        }
        if (at_ >= text_.size()) fail("a text is not closed");
        ++at_;
        return out;
    }
    Json parse(int depth)
    {
        if (depth > 32) fail("values are nested more than 32 deep");
        skip();
        if (at_ >= text_.size()) fail("the text ends where a value should be");
        Json value;
        value.line = line_;
        const char c = text_[at_];
        if (c == '{') {
            ++at_;
            value.kind = Json::Kind::Object;
            if (take('}')) return value;
            do {
                skip();
                std::string key = string();
                if (!take(':')) fail("a colon is missing");
                value.members.push_back({std::move(key), parse(depth + 1)});
            } while (take(','));
            if (!take('}')) fail("a closing brace is missing");
        } else if (c == '[') {
            ++at_;
            value.kind = Json::Kind::Array;
            if (take(']')) return value;
            do {
                value.items.push_back(parse(depth + 1));
            } while (take(','));
            if (!take(']')) fail("a closing bracket is missing");
        } else if (c == '"') {
            value.kind = Json::Kind::String;
            value.text = string();
        } else {
            std::size_t end = at_;
            while (end < text_.size() &&
                   text_.substr(end, 1).find_first_of(",]} \t\r\n") == std::string_view::npos)
                ++end;
            const auto word = text_.substr(at_, end - at_);
            if (word == "true" || word == "false") {
                value.kind = Json::Kind::Bool;
                value.flag = word == "true";
            } else if (word != "null" && word != "NaN") {
                const auto number = to_number(word);
                if (!number) fail("this is not a number, true, false or null");
                value.kind = Json::Kind::Number;
                value.number = *number;
            }
            at_ = end;
        }
        return value;
    }

    std::string_view text_;
    std::size_t at_ = 0;
    std::size_t line_ = 1;
};

}  // namespace

const Json* Json::find(std::string_view key) const
{
    for (const auto& [name, value] : members) {
        if (name == key) return &value;
    }
    return nullptr;
}

Json parse_json(std::string_view text)
{
    return Parser(text).whole();
}

}  // namespace petrichor::weather
