// Reads every #include of the project and checks it against the map of rooms, so that an arrow
// between two rooms cannot grow by accident.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

const std::set<std::string> kRooms{"base", "weather", "texproc", "gpu", "cli", "tests"};

// A formula header is one that compiles both as C++ and as GLSL.
bool is_formula(const std::string& path)
{
    return path.find("/formulas/") != std::string::npos;
}

struct Include {
    std::string file;  // relative to the root
    std::string room;
    std::string target;  // as written
    bool quoted = false;
};

std::vector<Include> read_includes()
{
    std::vector<Include> found;
    const fs::path root = PETRICHOR_SOURCE_DIR;
    const std::regex line_with_include(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"])");
    for (const std::string& room : kRooms) {
        for (const auto& entry : fs::recursive_directory_iterator(root / room)) {
            const std::string extension = entry.path().extension();
            if (extension != ".h" && extension != ".cpp" && extension != ".glsl") continue;
            std::ifstream in(entry.path());
            std::string line;
            while (std::getline(in, line)) {
                std::smatch match;
                if (!std::regex_search(line, match, line_with_include)) continue;
                found.push_back({fs::relative(entry.path(), root).string(), room, match[2].str(),
                                 match[1].str() == "\""});
            }
        }
    }
    return found;
}

std::string room_of(const std::string& target)
{
    const std::string first = target.substr(0, target.find('/'));
    return kRooms.count(first) ? first : "";
}

// Why this include is not allowed, or nothing.
std::string objection(const Include& include)
{
    const std::string to = room_of(include.target);
    if (include.quoted && to.empty()) return "is not a path from the repository root";
    if (to.empty() || to == include.room) return "";
    if (to == "tests" || to == "cli") {
        return include.room == "tests" && to == "cli" ? "" : "nobody may see " + to;
    }
    if (include.room == "tests") return "";
    if (to == "base") return "";
    const bool private_header = include.target.find("/detail/") != std::string::npos;
    if (include.room == "cli") return private_header ? "detail/ is private to its room" : "";
    if (include.room == "gpu" && is_formula(include.target)) return "";
    return include.room + " may not see " + to;
}

TEST(Arrows, EveryIncludeFollowsTheMapOfRooms)
{
    const auto includes = read_includes();
    ASSERT_GT(includes.size(), 40u) << "the scan found too little to mean anything";
    for (const Include& include : includes) {
        const std::string problem = objection(include);
        EXPECT_TRUE(problem.empty())
            << include.file << " includes \"" << include.target << "\": " << problem;
    }
}

// Libraries stay behind the room that owns them.
TEST(Arrows, LibrariesStayInTheirRooms)
{
    const std::map<std::string, std::set<std::string>> owners{
        {"vulkan/", {"gpu"}}, {"OpenImageIO/", {"texproc"}}, {"OpenEXR/", {"texproc"}},
        {"CLI/", {"cli"}},    {"tiny_gltf.h", {"gpu"}},      {"glslang/", {"gpu"}},
        {"toml++/", {"cli"}},
    };
    for (const Include& include : read_includes()) {
        if (include.room == "tests") continue;
        for (const auto& [prefix, rooms] : owners) {
            if (include.target.rfind(prefix, 0) != 0) continue;
            EXPECT_TRUE(rooms.count(include.room))
                << include.file << " includes " << include.target;
        }
    }
}

// Public headers compile fast: heavy libraries are for .cpp files and detail/.
TEST(Arrows, PublicHeadersAreLight)
{
    for (const Include& include : read_includes()) {
        const fs::path file = include.file;
        if (file.extension() != ".h" || include.room == "tests") continue;
        if (include.file.find("/detail/") != std::string::npos) continue;
        if (include.file.find("/passes/") != std::string::npos) continue;
        for (const char* heavy : {"vulkan/", "OpenImageIO/", "OpenEXR/", "CLI/",
                                  "nlohmann/json.hpp", "toml++/", "tiny_gltf.h"}) {
            EXPECT_NE(include.target.rfind(heavy, 0), 0u)
                << include.file << " includes " << include.target;
        }
    }
}

// The rules themselves: an arrow that must not exist is refused.
TEST(Arrows, AForbiddenArrowIsRefused)
{
    EXPECT_EQ(objection({"gpu/a.cpp", "gpu", "weather/artist/model.h", true}),
              "gpu may not see weather");
    EXPECT_EQ(objection({"gpu/a.cpp", "gpu", "weather/formulas/water.h", true}), "");
    EXPECT_EQ(objection({"weather/a.cpp", "weather", "texproc/files/io.h", true}),
              "weather may not see texproc");
    EXPECT_NE(objection({"cli/a.cpp", "cli", "gpu/detail/device.h", true}), "");
    EXPECT_NE(objection({"gpu/a.cpp", "gpu", "device.h", true}), "");
    EXPECT_EQ(objection({"tests/gpu/a.cpp", "tests", "gpu/detail/device.h", true}), "");
}

}  // namespace
