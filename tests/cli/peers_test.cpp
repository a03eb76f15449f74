// `petrichor bench --compare`: a peer stands for itself here, a program called blender that writes
// what it is told.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "base/error.h"
#include "cli/bench/peers.h"
#include "texproc/codecs/files/io.h"

namespace petrichor::cli {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// A ball of light somewhere on grey ground.
Image scene_at(float x)
{
    Image image(160, 96, 3, ColorSpace::Data, 0.2f);
    for (int row = 0; row < image.height; ++row) {
        for (int column = 0; column < image.width; ++column) {
            const float away =
                std::hypot(static_cast<float>(column) - x, static_cast<float>(row) - 48.0f);
            for (int c = 0; c < 3; ++c) image.at(column, row, c) += away < 30.0f ? 0.7f : 0.0f;
        }
    }
    return image;
}

void write_picture(const fs::path& file, const Image& image)
{
    std::vector<std::uint8_t> codes;
    for (const float value : image.pixels)
        codes.push_back(static_cast<std::uint8_t>(255.0f * value));
    texproc::write_png8(file, image.width, image.height, 3, codes);
}

class Peers : public testing::Test {
protected:
    Peers() : folder_(fs::path(testing::TempDir()) / ("petrichor_peers_test_" + std::to_string(::getpid())))
    {
        fs::remove_all(folder_);
        fs::create_directories(folder_ / "bin");
        old_path_ = std::getenv("PATH");
        // Without the folders of a real one: what these tests need of them is linked.
        for (const char* tool : {"sh", "cp", "cat", "timeout", "sleep"}) {
            for (const char* where : {"/usr/bin", "/bin"}) {
                if (fs::exists(fs::path(where) / tool) && !fs::exists(folder_ / "bin" / tool)) {
                    fs::create_symlink(fs::path(where) / tool, folder_ / "bin" / tool);
                }
            }
        }
        ::setenv("PATH", (folder_ / "bin").c_str(), 1);
    }
    ~Peers() override
    {
        ::setenv("PATH", old_path_.c_str(), 1);
        fs::remove_all(folder_);
    }

    // Arguments end with REPEAT PICTURE REPORT, as those of data/peers.
    void install_blender(const std::string& body)
    {
        const fs::path program = folder_ / "bin" / "blender";
        std::ofstream(program) << "#!/bin/sh\nwhile [ $# -gt 2 ]; do shift; done\n" << body << "\n";
        fs::permissions(program, fs::perms::owner_all);
    }
    std::vector<PeerRow> run(int limit_s = 30)
    {
        return compare_peers({.scene = "scene.glb",
                              .width = 160,
                              .height = 96,
                              .repeat = 1,
                              .modules = folder_,
                              .pictures = {},
                              .limit_s = limit_s},
                             scene_at(50.0f));
    }
    fs::path folder_;
    std::string old_path_;
};

constexpr const char* kTimes =
    "echo '{\"version\": \"9\", \"cpu_ms\": [3, 50, 4], \"wall_ms\": [2, 9, 1]}' > \"$2\"";

TEST_F(Peers, AreNamedWithHowToInstallThem)
{
    const std::vector<PeerRow> rows = run();
    ASSERT_EQ(rows.size(), 4u);
    EXPECT_THAT(rows[0].note, HasSubstr("npm install --prefix"));
    EXPECT_THAT(rows[0].note, HasSubstr("three"));
    EXPECT_THAT(rows[3].note, HasSubstr("apt install blender"));
    for (const PeerRow& row : rows) EXPECT_FALSE(row.cost) << row.name;
}

TEST_F(Peers, CountWhenTheyDrewTheSameScene)
{
    write_picture(folder_ / "same.png", scene_at(52.0f));
    install_blender("cp " + (folder_ / "same.png").string() + " \"$1\"; " + kTimes);
    const PeerRow cycles = run().back();
    ASSERT_TRUE(cycles.cost) << cycles.note;
    EXPECT_EQ(cycles.cost->cpu_ms, 4.0);
    EXPECT_EQ(cycles.cost->wall_ms, 2.0);
    EXPECT_EQ(cycles.version, "9");
    EXPECT_GT(cycles.likeness.value_or(0.0), 0.95);
    EXPECT_EQ(cycles.note, "");
    EXPECT_THAT(peers_text({.cpu_ms = 2.0, .wall_ms = 1.0}, {cycles}), HasSubstr("2.00 x"));
}

TEST_F(Peers, DoNotCountWhenTheyDrewNothingOrSomethingElse)
{
    Image black(160, 96, 3, ColorSpace::Data, 0.0f);
    for (const Image& other : {black, scene_at(120.0f)}) {
        write_picture(folder_ / "other.png", other);
        install_blender("cp " + (folder_ / "other.png").string() + " \"$1\"; " + kTimes);
        const PeerRow cycles = run().back();
        EXPECT_LT(cycles.likeness.value_or(1.0), kSameScene);
        EXPECT_THAT(cycles.note, HasSubstr("does not count"));
        EXPECT_THAT(peers_text({.cpu_ms = 2.0}, {cycles}), testing::Not(HasSubstr("2.00 x")));
    }
    install_blender(kTimes);
    EXPECT_THAT(run().back().note, HasSubstr("no picture"));
}

TEST_F(Peers, ThatFailOrHangSayWhy)
{
    install_blender("echo 'no camera in it' >&2; exit 1");
    EXPECT_THAT(run().back().note, HasSubstr("no camera in it"));
    install_blender("exit 0");
    EXPECT_THAT(run().back().note, HasSubstr("no times"));
    install_blender("sleep 20");
    EXPECT_THAT(run(1).back().note, HasSubstr("ended after 1 s"));
}

TEST(Likeness, ForgivesToneMappingAndNotAnotherPlace)
{
    const Image ours = scene_at(50.0f);
    Image curved = ours;
    for (float& value : curved.pixels) value = std::sqrt(value);
    EXPECT_GT(likeness(ours, curved), 0.98);
    EXPECT_LT(likeness(ours, scene_at(100.0f)), 0.5);
    EXPECT_THROW(likeness(ours, Image(8, 8, 3, ColorSpace::Data)), Error);
}

}  // namespace
}  // namespace petrichor::cli
