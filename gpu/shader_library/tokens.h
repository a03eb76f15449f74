#ifndef PETRICHOR_GPU_SHADER_LIBRARY_TOKENS_H
#define PETRICHOR_GPU_SHADER_LIBRARY_TOKENS_H

#include <string>
#include <vector>

namespace petrichor::gpu {

/// A piece of a shader's text: a name, a number, one character of punctuation or a comment.
struct Token {
    enum Kind { Word, Number, Mark, Comment };
    Kind kind = Mark;
    std::string space;  ///< spaces and line ends before it
    std::string text;
};
using Tokens = std::vector<Token>;

/// All of a text but the space at its end.
Tokens tokens_of(const std::string& text);
std::string text_of(const Tokens& tokens);

}  // namespace petrichor::gpu

#endif
