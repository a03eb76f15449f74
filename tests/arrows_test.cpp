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

// What each room may see besides itself: the map of docs/design.md.
const std::map<std::string, std::set<std::string>> kMaySee{
    {"base", {}},
    {"formulas", {"base"}},
    {"weather", {"base", "formulas"}},
    {"texproc", {"base", "formulas"}},
    {"scene", {"base", "formulas"}},
    {"gpu", {"base", "formulas", "scene"}},
    {"demo", {"base", "formulas", "texproc", "scene"}},
    {"film", {"base", "formulas", "weather", "texproc", "scene", "gpu", "demo"}},
    {"cli", {"base", "formulas", "weather", "texproc", "scene", "gpu", "demo", "film"}},
    {"tests", {"base", "formulas", "weather", "texproc", "scene", "gpu", "demo", "film", "cli"}},
};

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
    for (const auto& [room, sees] : kMaySee) {
        for (const auto& entry : fs::recursive_directory_iterator(root / room)) {
            const std::string extension = entry.path().extension();
            if (extension != ".h" && extension != ".cpp" && extension != ".glsl" &&
                extension != ".inc") {
                continue;
            }
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
    return kMaySee.count(first) ? first : "";
}

bool is_private(const std::string& path)
{
    return path.find("/detail/") != std::string::npos;
}

// Why this include is not allowed, or nothing.
std::string objection(const Include& include)
{
    const std::string to = room_of(include.target);
    if (include.quoted && to.empty()) return "is not a path from the repository root";
    if (to.empty() || to == include.room) return "";
    if (!kMaySee.at(include.room).count(to)) return include.room + " may not see " + to;
    if (include.room != "tests" && is_private(include.target))
        return "detail/ is private to its room";
    return "";
}

// The folder that stands for a file in the graph of folders: detail/ belongs to the folder above
// it.
std::string folder_of(const std::string& path)
{
    std::string folder = fs::path(path).parent_path().generic_string();
    const std::string detail = "/detail";
    if (folder.size() > detail.size() &&
        folder.compare(folder.size() - detail.size(), detail.size(), detail) == 0) {
        folder.resize(folder.size() - detail.size());
    }
    return folder;
}

using FolderGraph = std::map<std::string, std::map<std::string, std::string>>;  // from, to, by

// A way from `from` back to `to` along the arrows, as "a -> b (file)", or nothing.
std::string way_back(const FolderGraph& graph, const std::string& from, const std::string& to,
                     std::set<std::string>& seen)
{
    const auto found = graph.find(from);
    if (found == graph.end()) return "";
    for (const auto& [next, by] : found->second) {
        const std::string step = from + " -> " + next + " (" + by + ")";
        if (next == to) return step;
        if (!seen.insert(next).second) continue;
        const std::string rest = way_back(graph, next, to, seen);
        if (!rest.empty()) return step + ", " + rest;
    }
    return "";
}

std::string first_circle(const FolderGraph& graph)
{
    for (const auto& [folder, arrows] : graph) {
        std::set<std::string> seen{folder};
        const std::string way = way_back(graph, folder, folder, seen);
        if (!way.empty()) return way;
    }
    return "";
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

// Folders form no circles: each can be read, moved and tested knowing only what is below it.
TEST(Arrows, FoldersFormNoCircles)
{
    FolderGraph graph;
    for (const Include& include : read_includes()) {
        if (include.room == "tests" || !include.quoted) continue;
        const std::string from = folder_of(include.file);
        const std::string to = folder_of(include.target);
        if (from != to) graph[from].emplace(to, include.file);
    }
    ASSERT_GT(graph.size(), 20u);
    EXPECT_EQ(first_circle(graph), "");
    EXPECT_NE(first_circle({{"a", {{"b", "a/x.h"}}}, {"b", {{"a", "b/y.h"}}}}), "");
}

// What is installed includes nothing that is not.
TEST(Arrows, PublicHeadersSeeNoPrivateOnes)
{
    for (const Include& include : read_includes()) {
        const fs::path file = include.file;
        if (file.extension() == ".cpp" || include.room == "tests" || include.room == "cli")
            continue;
        if (is_private(include.file) || !include.quoted) continue;
        EXPECT_FALSE(is_private(include.target))
            << include.file << " includes " << include.target << ", which is not installed";
    }
}

// Libraries stay behind the room that owns them.
TEST(Arrows, LibrariesStayInTheirRooms)
{
    const std::map<std::string, std::set<std::string>> owners{
        {"vulkan/", {"gpu"}},
        {"OpenImageIO/", {"texproc"}},
        {"OpenEXR/", {"texproc"}},
        {"CLI/", {"cli"}},
        {"nlohmann/", {"scene", "film", "cli"}},
        {"glslang/", {"gpu"}},
        {"toml++/", {"film", "cli"}},
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
        // Vulkan's C header costs a tenth of a second; film/toml is what wraps the TOML reader.
        const std::string folder = file.parent_path().generic_string();
        if (is_private(include.file) || folder == "gpu/device" || folder == "film/toml") continue;
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
    EXPECT_EQ(objection({"gpu/a.cpp", "gpu", "weather/models/artist/model.h", true}),
              "gpu may not see weather");
    EXPECT_EQ(objection({"gpu/a.cpp", "gpu", "formulas/weather/water.h", true}), "");
    EXPECT_EQ(objection({"weather/a.cpp", "weather", "texproc/codecs/files/io.h", true}),
              "weather may not see texproc");
    EXPECT_EQ(objection({"film/a.cpp", "film", "cli/progress.h", true}), "film may not see cli");
    EXPECT_NE(objection({"cli/a.cpp", "cli", "weather/physics/detail/lanes.h", true}), "");
    EXPECT_NE(objection({"gpu/a.cpp", "gpu", "device.h", true}), "");
    EXPECT_EQ(objection({"tests/gpu/a.cpp", "tests", "weather/physics/detail/lanes.h", true}), "");
}

}  // namespace
