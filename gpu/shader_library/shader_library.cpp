#include "gpu/shader_library/shader_library.h"

#include <algorithm>
#include <map>
#include <set>

#include "base/error.h"
#include "gpu/compiler/compiler.h"
#include "gpu/shader_library/tokens.h"

namespace petrichor::gpu {
namespace {

constexpr const char* kBridge = "base/interop.h";
constexpr const char* kProbe = "formulas/formula_probe.h";
constexpr const char* kPrefix = "petrichor_";
constexpr const char* kNumberPrefix = "PETRICHOR_";

[[noreturn]] void refuse(const std::string& file, const std::string& line, const char* why)
{
    throw Error(file + ": " + why + ": " + line, "Keep to the common subset of base/interop.h.");
}

// What stands in place of a name; with `call` nothing does, nor of what follows it in parentheses.
struct Replacement {
    std::string name;
    bool call = false;
};

// Follows includes and conditions, and takes macros out.
class Flattener {
public:
    Flattener(std::span<const ShaderText> texts, ShaderLanguage language)
    {
        for (const ShaderText& one : texts) by_name_[one.name] = &one.text;
        if (language == ShaderLanguage::Hlsl) defined_.insert("PETRICHOR_HLSL");
    }

    void add(const std::string& name)
    {
        if (name.ends_with(".h") && !seen_.insert(name).second) return;
        const auto found = by_name_.find(name);
        if (found == by_name_.end()) throw Error("no text " + name, "Report this.");
        const std::vector<std::string> lines = lines_of(*found->second);
        // Whole headers first, so that each file stands in one piece below its name.
        for (const std::string& line : lines) {
            if (const std::string header = included(line); header.ends_with(".h")) add(header);
        }
        if (name != kBridge && name.ends_with(".h")) text_ += "\n// ---- " + name + "\n\n";
        std::vector<Condition> open;
        for (const std::string& line : lines) {
            const bool live = std::all_of(open.begin(), open.end(), [](const Condition& c) { return c.live; });
            if (!line.starts_with("#")) {
                // What the bridge says is for those who write formulas.
                if (live && !(name == kBridge && line.starts_with("//"))) text_ += line + "\n";
            } else if (!is_condition(name, line, open) && live) {
                directive(name, line);
            }
        }
        if (!open.empty()) refuse(name, "#endif", "a condition does not end");
    }

    const std::string& text() const { return text_; }
    const std::map<std::string, Replacement>& replacements() const { return replacements_; }
    const std::set<std::string>& numbers() const { return numbers_; }

private:
    struct Condition {
        bool live = false;  // its text is taken
        bool met = false;   // this or one before it was
    };

    static std::vector<std::string> lines_of(const std::string& text)
    {
        std::vector<std::string> lines;
        for (std::size_t at = 0; at < text.size();) {
            const std::size_t end = std::min(text.find('\n', at), text.size());
            lines.push_back(text.substr(at, end - at));
            at = end + 1;
        }
        return lines;
    }

    // "" of what is no #include "...".
    static std::string included(const std::string& line)
    {
        const std::size_t quote = line.find('"');
        if (!line.starts_with("#include ") || quote == std::string::npos) return "";
        return line.substr(quote + 1, line.rfind('"') - quote - 1);
    }

    bool is_condition(const std::string& file, const std::string& line, std::vector<Condition>& open) const
    {
        const Tokens words = tokens_of(line.substr(1));
        const std::string what = words.empty() ? "" : words[0].text;
        if (what == "ifdef" || what == "ifndef") {
            if (words.size() < 2) refuse(file, line, "no name");
            const bool met = (defined_.count(words[1].text) != 0) == (what == "ifdef");
            open.push_back({met, met});
            return true;
        }
        if (what == "if") refuse(file, line, "a condition that is not read here");
        if (what != "elif" && what != "else" && what != "endif") return false;
        if (open.empty()) refuse(file, line, "no condition is open");
        if (what == "endif") {
            open.pop_back();
            return true;
        }
        bool met = what == "else";
        for (std::size_t i = 1; i + 2 < words.size(); ++i) {  // defined(A) || defined(B)
            met = met || (words[i].text == "defined" && defined_.count(words[i + 2].text) != 0);
        }
        open.back() = {met && !open.back().met, met || open.back().met};
        return true;
    }

    void directive(const std::string& file, const std::string& line)
    {
        if (const std::string name = included(line); !name.empty()) {
            add(name);
        } else if (line.starts_with("#define ")) {
            define(file, line);
        } else {
            refuse(file, line, "not read here");
        }
    }

    void define(const std::string& file, const std::string& line)
    {
        Tokens words = tokens_of(line.substr(8));
        if (words.back().kind == Token::Comment) words.pop_back();
        if (words.empty()) refuse(file, line, "no name");
        const std::string name = words[0].text;
        defined_.insert(name);
        if (words.size() == 1) {
            replacements_[name] = {};
        } else if (words[1].text == "(" && words[1].space.empty()) {
            std::size_t close = 2;
            while (close < words.size() && words[close].text != ")") ++close;
            const std::size_t other = close + 1;
            // Nothing, or the same call of another: splat3(x) vec3(x).
            bool same = words.size() == other + close + 1;
            for (std::size_t i = 1; same && i <= close; ++i) same = words[other + i].text == words[i].text;
            if (words.size() != other && !same) refuse(file, line, "a macro that does more than rename");
            replacements_[name] = same ? Replacement{words[other].text} : Replacement{"", true};
        } else if (file == kBridge) {
            words.erase(words.begin());
            words[0].space.clear();
            replacements_[name] = {text_of(words)};
        } else {
            numbers_.insert(name);
            text_ += line + "\n";
        }
    }

    std::map<std::string, const std::string*> by_name_;
    std::set<std::string> defined_;
    std::set<std::string> seen_;
    std::set<std::string> numbers_;
    std::map<std::string, Replacement> replacements_;
    std::string text_;
};

// Tokens without some: what comes next on the line takes the place of what goes.
class Thinned {
public:
    void keep(Token token)
    {
        const bool new_line = token.space.find('\n') != std::string::npos;
        if (gone_ && !new_line) token.space = space_;
        gone_ = false;
        tokens_.push_back(std::move(token));
    }
    void drop(const Token& token)
    {
        if (!gone_ || token.space.find('\n') != std::string::npos) space_ = token.space;
        gone_ = true;
    }
    Tokens tokens() && { return std::move(tokens_); }

private:
    Tokens tokens_;
    std::string space_;
    bool gone_ = false;
};

// The parenthesis that closes the call of the name at `at`.
std::size_t end_of_call(const Tokens& tokens, std::size_t at)
{
    int depth = 0;
    for (std::size_t i = at + 1; i < tokens.size(); ++i) {
        if (tokens[i].text == "(") ++depth;
        if (tokens[i].text == ")" && --depth == 0) return i;
    }
    throw Error(tokens[at].text + ": no call", "Report this.");
}

Tokens replaced(const Tokens& tokens, const std::map<std::string, Replacement>& by)
{
    Thinned out;
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        const Token& one = tokens[i];
        const auto found = by.find(one.text);
        const bool member = i > 0 && tokens[i - 1].text == ".";
        if (one.kind != Token::Word || member || found == by.end()) {
            out.keep(one);
        } else if (found->second.call) {
            i = end_of_call(tokens, i);
        } else if (found->second.name.empty()) {
            out.drop(one);
        } else {
            out.keep({one.kind, one.space, found->second.name});
        }
    }
    return std::move(out).tokens();
}

// Which tokens are inside of functions, and which declare the members of structs.
enum class Place : char { Global, Function, Member };
std::vector<Place> places_of(const Tokens& tokens)
{
    std::vector<Place> places;
    int depth = 0;
    bool in_struct = false;
    for (const Token& one : tokens) {
        if (one.text == "}") --depth;
        if (depth == 0 && one.text == "struct") in_struct = true;
        if (depth == 0 && one.text == ";") in_struct = false;
        places.push_back(depth == 0 ? Place::Global : in_struct ? Place::Member : Place::Function);
        if (one.text == "{") ++depth;
    }
    return places;
}

// Functions, structs and constants that a text declares.
std::set<std::string> global_names(const Tokens& tokens, const std::vector<Place>& places)
{
    std::set<std::string> names;
    bool said = false;  // of this declaration
    int parentheses = 0;
    for (std::size_t i = 0; i + 1 < tokens.size(); ++i) {
        if (places[i] != Place::Global) continue;
        const std::string& next = tokens[i + 1].text;
        if (tokens[i].text == "struct") {
            names.insert(next);
            said = true;
        } else if (tokens[i].kind == Token::Word && !said && (next == "(" || next == "=" || next == "[")) {
            names.insert(tokens[i].text);
            said = true;
        }
        if (tokens[i].text == "(") ++parentheses;
        if (tokens[i].text == ")") --parentheses;
        if (parentheses == 0 && (tokens[i].text == ";" || tokens[i].text == "}")) said = false;
    }
    return names;
}

void name_apart(Tokens& tokens, const std::vector<Place>& places, const std::set<std::string>& names,
                const std::set<std::string>& numbers)
{
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        Token& one = tokens[i];
        if (one.kind != Token::Word || (i > 0 && tokens[i - 1].text == ".")) continue;
        const std::string next = i + 1 < tokens.size() ? tokens[i + 1].text : "";
        const bool declares_member = places[i] == Place::Member && (next == ";" || next == "[");
        if (declares_member) continue;
        if (numbers.count(one.text) != 0) {
            one.text = kNumberPrefix + one.text;
        } else if (names.count(one.text) != 0) {
            one.text = kPrefix + one.text;
        }
    }
}

Tokens without_local_const(const Tokens& tokens, const std::vector<Place>& places)
{
    Thinned out;
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        if (tokens[i].text == "const" && places[i] == Place::Function) {
            out.drop(tokens[i]);
        } else {
            out.keep(tokens[i]);
        }
    }
    return std::move(out).tokens();
}

// One empty line at most.
std::string packed_lines(const std::string& text)
{
    std::string packed;
    for (const char c : text) {
        if (c == '\n' && packed.ends_with("\n\n")) continue;
        packed += c;
    }
    return packed;
}

bool is_formula(const ShaderText& text)
{
    return text.name.starts_with("formulas/") && text.name.ends_with(".h") && text.name != kProbe;
}

}  // namespace

std::string flattened_texts(std::span<const ShaderText> texts, const std::vector<std::string>& roots,
                            ShaderLanguage language)
{
    Flattener flat(texts, language);
    for (const std::string& root : roots) flat.add(root);
    Tokens tokens = replaced(tokens_of(flat.text()), flat.replacements());
    std::vector<Place> places = places_of(tokens);
    name_apart(tokens, places, global_names(tokens, places), flat.numbers());
    if (language == ShaderLanguage::Glsl) tokens = without_local_const(tokens, places);
    return packed_lines(text_of(tokens) + "\n");
}

std::string shader_library(ShaderLanguage language)
{
    std::vector<std::string> roots;
    for (const ShaderText& one : embedded_texts()) {
        if (is_formula(one)) roots.push_back(one.name);
    }
    std::sort(roots.begin(), roots.end());
    const bool hlsl = language == ShaderLanguage::Hlsl;
    return std::string("// The formulas of Petrichor " PETRICHOR_VERSION ", as ") + (hlsl ? "HLSL" : "GLSL") +
           " for the shaders of any engine: weather on surfaces, light, colours.\n"
           "// Made by `petrichor headers`; licence: Apache 2.0. How to call it: docs/shaders.md of Petrichor.\n"
           "//\n"
           "// SI units, y up, linear Rec.709 colours. Names of functions, structs and constants begin with petrichor_;\n"
           "// comments leave that out. Nothing here needs a texture, a buffer or a matrix.\n"
           "#ifndef PETRICHOR_SHADER_LIBRARY\n"
           "#define PETRICHOR_SHADER_LIBRARY\n\n" +
           flattened_texts(embedded_texts(), roots, language) + "\n#endif\n";
}

std::vector<ShaderText> formula_headers()
{
    std::vector<ShaderText> headers;
    for (const ShaderText& one : embedded_texts()) {
        const bool own = one.name.starts_with("formulas/") && one.name.ends_with(".inc");
        if (is_formula(one) || own || one.name == kBridge) headers.push_back(one);
    }
    return headers;
}

}  // namespace petrichor::gpu
