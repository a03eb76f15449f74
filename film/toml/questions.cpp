#include "film/toml/questions.h"

#include <algorithm>

namespace petrichor::film {
namespace {

thread_local Questions* listener = nullptr;

// Elements of an array are asked alike: keys[3] as keys[].
std::string without_numbers(const std::string& key)
{
    std::string plain;
    for (std::size_t at = 0; at < key.size(); ++at) {
        plain += key[at];
        if (key[at] != '[') continue;
        const std::size_t end = key.find_first_not_of("0123456789", at + 1);
        if (end != std::string::npos && key[end] == ']') at = end - 1;
    }
    return plain;
}

}  // namespace

Questions::Questions() : before_(listener)
{
    listener = this;
}

Questions::~Questions()
{
    listener = before_;
}

void note_question(const std::string& key, Question question)
{
    if (!listener) return;
    std::vector<Question>& all = listener->asked_[without_numbers(key)];
    if (std::find(all.begin(), all.end(), question) == all.end()) all.push_back(std::move(question));
}

}  // namespace petrichor::film
