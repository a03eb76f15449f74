#include "gpu/shader_library/tokens.h"

#include <algorithm>
#include <cctype>

namespace petrichor::gpu {
namespace {

bool in_word(char c)
{
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

bool is_digit(char c)
{
    return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

// Where the token that begins at `at` ends.
std::size_t end_of(const std::string& text, std::size_t at, Token::Kind kind)
{
    const std::size_t size = text.size();
    if (kind == Token::Mark) return at + 1;
    if (kind == Token::Comment) {
        if (text[at + 1] == '/') return std::min(text.find('\n', at), size);
        const std::size_t close = text.find("*/", at + 2);
        return close == std::string::npos ? size : close + 2;
    }
    std::size_t end = at + 1;
    while (end < size) {
        // The sign of an exponent; 0x1e-2 is a difference.
        const bool decimal = kind == Token::Number && !(text[at] == '0' && (text[at + 1] | 32) == 'x');
        const bool sign = decimal && (text[end] == '-' || text[end] == '+') && (text[end - 1] | 32) == 'e';
        if (!in_word(text[end]) && !sign && !(kind == Token::Number && text[end] == '.')) break;
        ++end;
    }
    return end;
}

}  // namespace

Tokens tokens_of(const std::string& text)
{
    Tokens tokens;
    for (std::size_t at = 0;;) {
        const std::size_t begin = std::min(text.find_first_not_of(" \t\r\n", at), text.size());
        if (begin == text.size()) return tokens;
        const char c = text[begin];
        const char next = begin + 1 < text.size() ? text[begin + 1] : ' ';
        Token::Kind kind = Token::Mark;
        if (is_digit(c) || (c == '.' && is_digit(next))) {
            kind = Token::Number;
        } else if (in_word(c)) {
            kind = Token::Word;
        } else if (c == '/' && (next == '/' || next == '*')) {
            kind = Token::Comment;
        }
        const std::size_t end = end_of(text, begin, kind);
        tokens.push_back({kind, text.substr(at, begin - at), text.substr(begin, end - begin)});
        at = end;
    }
}

std::string text_of(const Tokens& tokens)
{
    std::string text;
    for (const Token& one : tokens) text += one.space + one.text;
    return text;
}

}  // namespace petrichor::gpu
