#ifndef PETRICHOR_FILM_TOML_QUESTIONS_H
#define PETRICHOR_FILM_TOML_QUESTIONS_H

#include <map>
#include <string>
#include <vector>

namespace petrichor::film {

/// What a reader wants to know of a value: the only telling of a key's type and range is the call that reads it.
struct Question {
    enum class Kind {
        Number,   ///< low to high
        Integer,  ///< low to high
        Boolean,
        Text,
        Choice,   ///< one of words
        Numbers,  ///< count of them, low to high
        Keyed,    ///< a number, or [[time_s, number], ...]
        KeyedNumbers,
        Array,    ///< elements are asked as KEY[]
        Table,    ///< of words; entries are asked as KEY.word
    };
    Kind kind = Kind::Text;
    double low = 0.0;
    double high = 0.0;
    std::size_t count = 0;
    std::vector<std::string> words = {};

    bool operator==(const Question&) const = default;
};

/// Notes what values of TOML are asked on this thread while it lives, by key ("camera.keys[].time_s").
class Questions {
public:
    Questions();
    ~Questions();
    Questions(const Questions&) = delete;
    Questions& operator=(const Questions&) = delete;

    const std::map<std::string, std::vector<Question>>& asked() const { return asked_; }

private:
    friend void note_question(const std::string& key, Question question);
    std::map<std::string, std::vector<Question>> asked_;
    Questions* before_;
};

/// Nothing unless a Questions lives.
void note_question(const std::string& key, Question question);

}  // namespace petrichor::film

#endif
