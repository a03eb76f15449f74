// Comments and documents point at files and at sections of docs/: each must be there, so that a
// move or a rename cannot leave a signpost to nothing.
//
// A file is named by its name, by its path from the root, or by the end of its path; a word in
// capitals stands for any (`cmd_NAME.cpp`). A section is named as `docs/lux.md 4.2` or
// `docs/textures.md, 3`; its heading begins with that number.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace petrichor {
namespace {

namespace fs = std::filesystem;

struct Line {
    std::string where;  // file:line
    std::string text;
};

bool ends_with(const std::string& text, const std::string& end)
{
    return text.size() >= end.size() &&
           text.compare(text.size() - end.size(), end.size(), end) == 0;
}

// Every file of the tree by its path from the root; not what a build or git keeps there.
std::set<std::string> tree()
{
    std::set<std::string> files;
    const fs::path root = PETRICHOR_SOURCE_DIR;
    for (fs::recursive_directory_iterator i(root), end; i != end; ++i) {
        const std::string name = i->path().filename().string();
        const bool hidden = name[0] == '.' && name != ".ci";
        if (i->is_directory() && (hidden || name == "build")) {
            i.disable_recursion_pending();
        } else if (i->is_regular_file()) {
            files.insert(fs::relative(i->path(), root).generic_string());
        }
    }
    return files;
}

// The prose of a line: what follows // in sources and # in build files, all of a document.
std::string prose_of(const std::string& file, const std::string& line)
{
    std::string mark;
    for (const char* source : {".cpp", ".h", ".inc", ".glsl"}) {
        if (ends_with(file, source)) mark = "//";
    }
    if (ends_with(file, ".cmake") || ends_with(file, "CMakeLists.txt")) mark = "#";
    if (mark.empty()) return ends_with(file, ".md") ? line : "";
    const auto at = line.find(mark);
    return at == std::string::npos ? "" : line.substr(at);
}

std::vector<Line> all_prose(const std::set<std::string>& files)
{
    std::vector<Line> prose;
    for (const std::string& file : files) {
        if (file == "tests/docs/references_test.cpp") continue;  // it invents what is not there
        std::ifstream in(fs::path(PETRICHOR_SOURCE_DIR) / file);
        std::string line;
        bool shader = false;  // an example for other engines names files of theirs
        for (int number = 1; std::getline(in, line); ++number) {
            if (line.rfind("```", 0) == 0) shader = line == "```glsl" || line == "```hlsl";
            if (shader) continue;
            const std::string text = prose_of(file, line);
            if (!text.empty()) prose.push_back({file + ":" + std::to_string(number), text});
        }
    }
    return prose;
}

// Words in capitals stand for anything: NAME.glsl, cmd_NAME.cpp.
std::regex pattern_of(const std::string& named)
{
    std::string pattern;
    for (const char c : named)
        pattern += c == '.' || c == '+' ? std::string("\\") + c : std::string(1, c);
    pattern = std::regex_replace(pattern, std::regex("[A-Z]{3,}(?![a-z])"), "[^/]*");
    return std::regex("(.*/)?" + pattern);
}

bool is_there(const std::string& named, const std::set<std::string>& files)
{
    if (files.count(named)) return true;
    if (named == "petrichor.glsl") return true;  // `petrichor headers` writes it
    const std::regex pattern = pattern_of(named);
    for (const std::string& file : files) {
        if (std::regex_match(file, pattern)) return true;
    }
    return false;
}

std::vector<std::string> files_named(const std::string& text)
{
    static const std::regex named(
        R"((^|[^\w/.*{}<>$-])((?:[\w+-]+/)*[\w+-][\w+.-]*\.(?:cpp|h|inc|glsl|md|cmake))(?![\w*]))");
    std::vector<std::string> names;
    for (std::sregex_iterator i(text.begin(), text.end(), named), end; i != end; ++i) {
        const std::string name = (*i)[2].str();
        if (name.size() > 3) names.push_back(name);  // n.h and v.h are products
    }
    return names;
}

struct Section {
    std::string document, number;
};
std::vector<Section> sections_named(const std::string& text)
{
    static const std::regex named(R"((docs/\w+\.md),? (?:section )?(\d+(?:\.\d+)*))");
    std::vector<Section> sections;
    for (std::sregex_iterator i(text.begin(), text.end(), named), end; i != end; ++i) {
        sections.push_back({(*i)[1].str(), (*i)[2].str()});
    }
    return sections;
}

// The numbers that headings of a document begin with: "## 4.2 Water" is 4.2.
std::set<std::string> numbers_in(const std::string& document)
{
    std::set<std::string> numbers;
    std::ifstream in(fs::path(PETRICHOR_SOURCE_DIR) / document);
    const std::regex heading(R"(^#+ (\d+(?:\.\d+)*)\.? .*)");
    std::string line;
    while (std::getline(in, line)) {
        std::smatch found;
        if (std::regex_match(line, found, heading)) numbers.insert(found[1].str());
    }
    return numbers;
}

TEST(References, EveryFileThatProseNamesIsThere)
{
    const auto files = tree();
    std::map<std::string, bool> known;
    std::size_t checked = 0;
    for (const Line& line : all_prose(files)) {
        for (const std::string& name : files_named(line.text)) {
            if (!known.count(name)) known[name] = is_there(name, files);
            EXPECT_TRUE(known[name]) << line.where << " names " << name << ", which is not there";
            ++checked;
        }
    }
    EXPECT_GT(checked, 60u);
}

TEST(References, EverySectionThatProseCitesIsThere)
{
    std::map<std::string, std::set<std::string>> numbers;
    std::size_t checked = 0;
    for (const Line& line : all_prose(tree())) {
        for (const Section& cited : sections_named(line.text)) {
            if (!numbers.count(cited.document))
                numbers[cited.document] = numbers_in(cited.document);
            EXPECT_TRUE(numbers[cited.document].count(cited.number))
                << line.where << " cites " << cited.document << ", section " << cited.number
                << ", which is not there";
            ++checked;
        }
    }
    EXPECT_GT(checked, 8u);
}

// The checks themselves: what does not exist is found.
TEST(References, AnInventedNameIsNoticed)
{
    const std::set<std::string> files{"gpu/passes/flow.comp.glsl", "cli/cmd_doctor.cpp"};
    EXPECT_TRUE(is_there("gpu/passes/flow.comp.glsl", files));
    EXPECT_TRUE(is_there("passes/flow.comp.glsl", files));
    EXPECT_TRUE(is_there("flow.comp.glsl", files));
    EXPECT_TRUE(is_there("cmd_NAME.cpp", files));
    EXPECT_FALSE(is_there("gpu/shaders/flow.comp.glsl", files));
    EXPECT_FALSE(is_there("low.comp.glsl", files));
    EXPECT_FALSE(is_there("rpt_NAME.cpp", files));
    EXPECT_EQ(files_named("// (see gpu/view.h), b/c_test.cpp."),
              (std::vector<std::string>{"gpu/view.h", "b/c_test.cpp"}));
    EXPECT_TRUE(files_named("// 2 (v.h) (n.h), <vulkan.h> and *_kernel.h").empty());
    ASSERT_EQ(sections_named("// docs/lux.md 4.2 and docs/lux.md, 7").size(), 2u);
    EXPECT_EQ(sections_named("// docs/lux.md 4.2.")[0].number, "4.2");
}

}  // namespace
}  // namespace petrichor
