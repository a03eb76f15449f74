// docs/features.md tells the truth: every key, command and test that it names exists, and a row
// that is said to work names at least one of each kind that it needs.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "film/scenario/scenario.h"
#include "tests/support/program.h"
#include "weather/models/artist/model.h"

namespace petrichor {
namespace {

namespace fs = std::filesystem;

struct Row {
    std::string number, feature, state, use, test, missing;
};

std::string trimmed(const std::string& text)
{
    const auto first = text.find_first_not_of(' ');
    if (first == std::string::npos) return "";
    return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

std::vector<std::string> cells_of(const std::string& line)
{
    std::vector<std::string> cells;
    std::istringstream in(line);
    std::string cell;
    std::getline(in, cell, '|');  // before the first bar
    while (std::getline(in, cell, '|')) cells.push_back(trimmed(cell));
    return cells;
}

std::vector<Row> read_rows()
{
    std::ifstream in(fs::path(PETRICHOR_SOURCE_DIR) / "docs" / "features.md");
    std::vector<Row> rows;
    std::string line;
    while (std::getline(in, line)) {
        const auto cells = cells_of(line);
        if (cells.size() != 6 || cells[0] == "row" || cells[0].find("---") == 0) continue;
        rows.push_back({cells[0], cells[1], cells[2], cells[3], cells[4], cells[5]});
    }
    return rows;
}

// The texts between backticks.
std::vector<std::string> code_spans(const std::string& text)
{
    std::vector<std::string> spans;
    const std::regex span("`([^`]+)`");
    for (std::sregex_iterator i(text.begin(), text.end(), span), end; i != end; ++i) {
        spans.push_back((*i)[1].str());
    }
    return spans;
}

// Every "Suite.Name" of the tests' sources; parametrised and typed ones by their plain names.
std::set<std::string> all_tests()
{
    std::set<std::string> names;
    const std::regex test(R"(^TEST(?:_[FP])?\(\s*(\w+),\s*(\w+)\s*\))");
    for (const auto& entry :
         fs::recursive_directory_iterator(fs::path(PETRICHOR_SOURCE_DIR) / "tests")) {
        if (entry.path().extension() != ".cpp") continue;
        std::ifstream in(entry.path());
        const std::string text{std::istreambuf_iterator<char>(in),
                               std::istreambuf_iterator<char>()};
        std::istringstream lines(text);
        std::string line;
        while (std::getline(lines, line)) {
            if (line.rfind("TEST", 0) == 0 && line.find(')') == std::string::npos) {
                std::string next;
                if (std::getline(lines, next)) line += trimmed(next);
            }
            std::smatch found;
            if (std::regex_search(line, found, test)) {
                names.insert(found[1].str() + "." + found[2].str());
            }
        }
    }
    return names;
}

// "[weather] model, start" names keys of a table of the scenario.
std::string unknown_key(const std::string& span)
{
    const auto close = span.find(']');
    const std::string table = span.substr(1, close - 1);
    std::set<std::string> known;
    for (const auto& key : film::scenario_keys()) {
        if (key.table == table) known.insert(key.name);
    }
    if (table == "weather.artist") {
        for (const auto& parameter : weather::artist_parameters()) known.emplace(parameter.name);
        known.insert({"script_controlled", "water_to_snow_curve", "initial"});
    }
    if (known.empty()) return "no table [" + table + "]";
    std::istringstream names(span.substr(close + 1));
    std::string name;
    while (std::getline(names, name, ',')) {
        name = trimmed(name.substr(0, name.find('=')));
        if (!name.empty() && !known.count(name)) return "no key " + name + " in [" + table + "]";
    }
    return "";
}

// "simulate --ensemble" names a command and options that its --help shows.
std::string unknown_option(const std::string& span)
{
    static std::map<std::string, std::string> help;
    std::istringstream in(span);
    std::vector<std::string> command;
    std::vector<std::string> options;
    for (std::string word; in >> word;) {
        if (word.rfind("--", 0) == 0)
            options.push_back(word.substr(0, word.find('=')));
        else if (options.empty() && std::regex_match(word, std::regex("[a-z]+")))
            command.push_back(word);
    }
    std::string name;
    for (const auto& word : command) name += word + " ";
    if (!help.count(name)) {
        auto words = command;
        words.push_back("--help");
        // What the program says goes through files of that folder: tests run beside each other.
        const testing_program::Workplace place("features-help-" + std::to_string(getpid()));
        const auto run = testing_program::run(words, place);
        help[name] = run.exit_code == 0 ? run.out + run.err : "";
    }
    if (help[name].empty()) return "no command " + name;
    for (const auto& option : options) {
        if (!std::regex_search(help[name], std::regex(option + "(?![a-z-])"))) {
            return name + "has no " + option;
        }
    }
    return "";
}

const std::set<std::string> kCommands{"render", "simulate", "texture", "bench", "init", "doctor", "headers",
                                         "scene"};

TEST(Features, NamesOnlyWhatExists)
{
    const auto rows = read_rows();
    ASSERT_GT(rows.size(), 230u);
    const auto tests = all_tests();
    ASSERT_GT(tests.size(), 300u);
    for (const Row& row : rows) {
        SCOPED_TRACE("row " + row.number + ", " + row.feature);
        EXPECT_TRUE(row.state == "done" || row.state == "part" || row.state == "none") << row.state;
        for (const std::string& span : code_spans(row.use)) {
            if (span[0] == '[') {
                EXPECT_EQ(unknown_key(span), "");
            } else if (kCommands.count(span.substr(0, span.find(' ')))) {
                EXPECT_EQ(unknown_option(span), "");
            }
        }
        for (const std::string& span : code_spans(row.test)) {
            EXPECT_TRUE(tests.count(span)) << "no test " << span;
        }
        if (row.state == "done") {
            EXPECT_FALSE(code_spans(row.test).empty()) << "works, but which test would notice?";
            EXPECT_FALSE(row.use.empty()) << "works, but how is it used?";
        } else {
            EXPECT_FALSE(row.missing.empty()) << "what is missing?";
        }
    }
}

// The checks themselves: what does not exist is found.
TEST(Features, AnInventedNameIsNoticed)
{
    EXPECT_EQ(unknown_key("[output] width, height"), "");
    EXPECT_NE(unknown_key("[output] weight"), "");
    EXPECT_NE(unknown_key("[outputs] width"), "");
    EXPECT_EQ(unknown_option("render --samples 4"), "");
    EXPECT_NE(unknown_option("render --sample"), "");
    EXPECT_NE(unknown_option("paint --samples"), "");
}

}  // namespace
}  // namespace petrichor
