#ifndef PETRICHOR_BASE_WORDS_H
#define PETRICHOR_BASE_WORDS_H

#include <string>
#include <string_view>
#include <vector>

namespace petrichor {

/// The candidate with the fewest edits (insert, delete, replace, swap of neighbours; letter case
/// and
/// '-' against '_' are free), or "" when none is near: more than a third of the letters would
/// change.
std::string nearest_word(std::string_view word, const std::vector<std::string>& candidates);

/// " Did you mean \"x\"?" for the nearest candidate, or "".
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

/// "a, b, c" for messages.
std::string join_words(const std::vector<std::string>& words, std::string_view separator = ", ");

/// True when `text` matches `pattern` with * (any run) and ? (any one); letter case is ignored.
bool glob_matches(std::string_view pattern, std::string_view text);

/// `text` fit for a terminal, a log or JSON: control characters and bytes that are not UTF-8 become
/// \x1b and the like, everything else stays. Names that files bring along go through this before
/// they are printed.
std::string printable(std::string_view text);

/// True when `text` is well-formed UTF-8 (no surrogates, nothing beyond U+10FFFF, no long forms).
bool is_utf8(std::string_view text);

/// The shortest decimal text that reads back as the same number: "0.1", "-3", "1e-20".
std::string number_text(double value);
std::string number_text(float value);

}  // namespace petrichor

#endif
