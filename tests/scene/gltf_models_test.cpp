// Loads scenes from the real world and the official conformance cases.
#include <gtest/gtest.h>

#include <ctime>
#include <fstream>
#include <iostream>
#include <map>
#include <regex>

#include "tests/scene/gltf_helpers.h"

namespace petrichor::scene {
namespace {

namespace fs = std::filesystem;
using scene_files::expect_sound;
using scene_files::load_file;
using scene_files::read_file;

struct Counts {
    std::size_t triangles = 0, vertices = 0;
};
Counts count(const Scene& scene)
{
    Counts counts;
    for (const Instance& instance : scene.instances) {
        for (const Primitive& primitive : scene.meshes[instance.mesh].primitives) {
            counts.triangles += primitive.indices.size() / 3;
            counts.vertices += primitive.positions.size();
        }
    }
    return counts;
}

TEST(GltfModels, EveryModelLoads)
{
    NEED_ASSETS(assets);
    std::size_t models = 0;
    for (const auto& entry : fs::recursive_directory_iterator(assets / "models")) {
        const std::string extension = entry.path().extension();
        if (extension != ".gltf" && extension != ".glb") continue;
        SCOPED_TRACE(entry.path().filename().string());
        const std::clock_t start = std::clock();
        const Scene scene = load_file(entry.path());
        const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
        expect_sound(scene);
        const Counts counts = count(scene);
        EXPECT_GT(counts.triangles, 0u);
        std::cout << entry.path().filename().string() << ": " << counts.triangles << " triangles, "
                  << counts.vertices << " vertices, " << scene.textures.size() << " textures, "
                  << seconds << " CPU-s\n";
        for (const std::string& line : scene.warnings) std::cout << "    " << line << "\n";
        ++models;
    }
    EXPECT_GE(models, 12u);
}

// The official cases: every one that the reference validator passes loads, and the others give an
// Error or load (what we do not use we do not refuse), but never anything else.
TEST(GltfConformance, ValidCasesLoadAndInvalidOnesAreAnswered)
{
    NEED_ASSETS(assets);
    std::size_t valid = 0, refused = 0, tolerated = 0;
    for (const auto& entry : fs::recursive_directory_iterator(assets / "bad/gltf-validator")) {
        const std::string extension = entry.path().extension();
        if (extension != ".gltf" && extension != ".glb") continue;
        SCOPED_TRACE(fs::relative(entry.path(), assets).string());
        std::ifstream report(entry.path().string() + ".report.json");
        const std::string text(std::istreambuf_iterator<char>(report), {});
        const bool must_load = std::regex_search(text, std::regex("\"numErrors\"\\s*:\\s*0\\b")) ||
                               entry.path().stem().string().starts_with("valid");
        try {
            expect_sound(load_file(entry.path()));
            ++(must_load ? valid : tolerated);
        } catch (const Error& problem) {
            EXPECT_FALSE(must_load) << problem.what();
            EXPECT_FALSE(problem.fix().empty());
            EXPECT_EQ(std::string(problem.what()).rfind(entry.path().filename().string(), 0), 0u)
                << problem.what();
            ++refused;
        }
    }
    std::cout << valid << " valid cases loaded, " << refused << " invalid ones refused, "
              << tolerated << " loaded\n";
    EXPECT_GE(valid, 51u);
    EXPECT_GE(refused, 47u);
}

TEST(GltfConformance, BrokenScenesAreRefused)
{
    NEED_ASSETS(assets);
    const std::map<std::string, std::string> expected{
        {"IndexOutOfRange/IndexOutOfRange.gltf", "meshes[0].primitives[0].indices: index "},
        {"MissingBin/BoxTextured.gltf", "images[0].uri: no file "},
        {"RecursiveNodes/RecursiveNodes.gltf", "nodes[0].children: is part of a cycle"}};
    for (const auto& [file, message] : expected) {
        SCOPED_TRACE(file);
        try {
            load_file(assets / "bad/gltf" / file);
            ADD_FAILURE() << "must be refused";
        } catch (const Error& problem) {
            EXPECT_NE(std::string(problem.what()).find(message), std::string::npos)
                << problem.what();
        }
    }
}

TEST(GltfConformance, DamagedModelsAreAnswered)
{
    NEED_ASSETS(assets);
    scene_files::Random random{2024};
    for (const char* file : {"models/village/well.glb", "models/village/market_stand_01.glb"}) {
        const std::vector<std::byte> whole = read_file(assets / file);
        for (int round = 0; round < 150; ++round) {
            std::vector<std::byte> damaged = whole;
            if (round % 3 == 0) {
                damaged.resize(random.below(whole.size()));
            } else {
                // Mostly in the JSON text, which comes first.
                const std::size_t reach = round % 3 == 1 ? 12000 : whole.size();
                for (int flip = 0; flip < 4; ++flip) {
                    damaged[random.below(reach)] = static_cast<std::byte>(random.below(256));
                }
            }
            scene_files::expect_answer(damaged,
                                       file + std::string(" round ") + std::to_string(round));
        }
    }
}

// CPU time of the whole load, reading the files included.
TEST(GltfModels, SayHowLongTheyLoad)
{
    NEED_ASSETS(assets);
    const fs::path bench = assets / "../bench/lights10240.glb";
    for (const fs::path& path : {assets / "models/FlightHelmet/FlightHelmet.gltf", bench}) {
        if (!fs::exists(path)) continue;
        const std::clock_t start = std::clock();
        const Scene scene = load_file(path);
        const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
        std::cout << path.filename().string() << ": " << seconds << " CPU-s, "
                  << scene.lights.size() << " lights\n";
        expect_sound(scene);
        RecordProperty(path.stem().string() + "_cpu_s", std::to_string(seconds));
    }
}

}  // namespace
}  // namespace petrichor::scene
