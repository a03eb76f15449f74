#ifndef PETRICHOR_CLI_BENCH_SKILL_BOARD_H
#define PETRICHOR_CLI_BENCH_SKILL_BOARD_H

#include <optional>
#include <string>
#include <vector>

#include "cli/bench/skill/skill_row.h"

namespace petrichor::cli {

/// Another snow model.
struct SkillRival {
    std::string name;     ///< of its column
    std::string command;  ///< for the shell; see the command's help
};
/// What `petrichor bench skill` scores.
struct SkillOptions {
    std::string data = ".";  ///< a folder; everything below it is looked at
    std::string html = {};   ///< a page to write, or empty
    bool json = false;
    std::vector<SkillRival> rivals{};  ///< run once a winter
    std::vector<std::string> settings{};  ///< NAME=NUMBER: constants of the model to try
};

/// What a score is stated to be (stated.cpp).
struct StatedScore {
    const char* set;
    const char* quantity;
    double stated;  ///< at most this, and a margin
    double margin;
    double previous;  ///< of the release before; NaN: it had none
};
/// The stated value of a row, or nothing for data that nobody stated anything about.
std::optional<StatedScore> stated_score(const std::string& set, const std::string& quantity);

/// A line of the board.
struct BoardRow {
    SkillRow ours;
    double degree_day = kNoScore;
    std::vector<double> rivals;  ///< as SkillOptions::rivals
    std::optional<StatedScore> stated;

    bool worse() const { return stated && !(ours.score <= stated->stated + stated->margin); }
};
struct Board {
    std::vector<BoardRow> rows;
    std::vector<std::string> rivals, notes;
};
/// Scores every data set. Throws Error as find_skill_sets, and when a rival fails.
Board skill_board(const SkillOptions& options);

std::string board_text(const Board& board);
std::string board_json(const Board& board);
std::string board_html(const Board& board);

/// Scores, prints, writes the page; false when a score is worse than stated.
bool run_skill_bench(const SkillOptions& options);

}  // namespace petrichor::cli

#endif
