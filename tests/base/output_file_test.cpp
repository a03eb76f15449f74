#include "base/output_file.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <set>
#include <sstream>
#include <thread>

#include "base/error.h"

namespace petrichor {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class OutputFiles : public testing::Test {
protected:
    OutputFiles() { fs::create_directories(folder); }
    ~OutputFiles() override { fs::remove_all(folder); }
    fs::path folder = fs::path(testing::TempDir()) / ("output-" + std::to_string(::getpid()));

    std::set<std::string> names() const
    {
        std::set<std::string> found;
        for (const auto& entry : fs::directory_iterator(folder))
            found.insert(entry.path().filename().string());
        return found;
    }
    std::string content(const std::string& name) const
    {
        std::ifstream in(folder / name);
        std::ostringstream text;
        text << in.rdbuf();
        return text.str();
    }
    std::string problem(const fs::path& path) const
    {
        try {
            write_text_file(path, "new");
        } catch (const Error& error) {
            return error.what();
        }
        return "written";
    }
};

TEST_F(OutputFiles, AppearWholeOrNotAtAll)
{
    write_text_file(folder / "a/b.txt", "one");
    write_text_file(folder / "b.txt", "two");
    {
        OutputFile file(folder / "b.txt");
        file.write("half");
        EXPECT_EQ(file.temporary().extension(), ".txt");
        EXPECT_EQ(content("b.txt"), "two");
    }
    EXPECT_EQ(names(), (std::set<std::string>{"a", "b.txt"}));
}

TEST_F(OutputFiles, LinksAndDevicesAreNotReplaced)
{
    write_text_file(folder / "victim", "precious");
    fs::create_symlink("victim", folder / "link");
    EXPECT_THAT(problem(folder / "link"), HasSubstr("is a link"));
    fs::create_directories(folder / "sub");
    EXPECT_THAT(problem(folder / "sub"), HasSubstr("is a folder"));
    EXPECT_THAT(problem("/dev/null"), HasSubstr("is a device"));
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    EXPECT_THAT(problem(folder / "pipe"), HasSubstr("is a device or a pipe"));
    EXPECT_EQ(content("victim"), "precious");
    EXPECT_TRUE(fs::is_symlink(folder / "link"));
}

// A program is killed while it writes; the next one takes its file away. What a living program
// writes, in this process or another, stays.
TEST_F(OutputFiles, DeadWritersAreTidiedUpAndLivingOnesLeftAlone)
{
    int ready[2];
    ASSERT_EQ(::pipe(ready), 0);
    const auto writer = [&] {
        const pid_t child = ::fork();
        if (child == 0) {
            const OutputFile file(folder / "frame.png");
            const ScratchFolder scratch(folder);
            std::ofstream(scratch.path() / "part") << "x";
            if (::write(ready[1], "x", 1) != 1) ::_exit(1);
            ::pause();
            ::_exit(0);
        }
        char byte = 0;
        EXPECT_EQ(::read(ready[0], &byte, 1), 1);
        return child;
    };
    const pid_t dead = writer(), alive = writer();
    EXPECT_EQ(names().size(), 4u);
    remove_dead_temporaries(folder);
    EXPECT_EQ(names().size(), 4u) << "both are alive";
    ::kill(dead, SIGKILL);
    ::waitpid(dead, nullptr, 0);
    write_text_file(folder / "next.txt", "the next program");
    remove_dead_temporaries(folder);
    EXPECT_EQ(names().size(), 3u) << "two of the living one, and next.txt";
    ::kill(alive, SIGKILL);
    ::waitpid(alive, nullptr, 0);
    remove_dead_temporaries(folder);
    EXPECT_EQ(names(), (std::set<std::string>{"next.txt"}));
    ::close(ready[0]);
    ::close(ready[1]);
}

TEST_F(OutputFiles, AFullDiskLeavesNothing)
{
    const pid_t child = ::fork();
    if (child == 0) {
        ::signal(SIGXFSZ, SIG_IGN);
        const rlimit small{1000, 1000};
        ::setrlimit(RLIMIT_FSIZE, &small);
        try {
            write_text_file(folder / "big.txt", std::string(5000, 'x'));
        } catch (const Error& error) {
            ::_exit(std::string(error.what()).find("limit on the size") != std::string::npos ? 7
                                                                                             : 1);
        }
        ::_exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(WEXITSTATUS(status), 7);
    EXPECT_TRUE(names().empty());
}

TEST_F(OutputFiles, AScratchFolderPublishesAllOrNothing)
{
    fs::create_directories(folder / "b");  // where the second file should go
    {
        ScratchFolder scratch(folder);
        for (const char* name : {"a", "b"}) std::ofstream(scratch.path() / name) << name;
        EXPECT_THROW(scratch.publish({"a", "b"}), Error);
    }
    EXPECT_EQ(names(), (std::set<std::string>{"b"}));
}

// A program that is ended while two files that belong together appear.
TEST_F(OutputFiles, WhatIsKeptTogetherAppearsTogether)
{
    const pid_t child = ::fork();
    if (child == 0) {
        const OutputFile pending(folder / "pending");
        std::thread publisher([this] {
            const KeptTogether together;
            write_text_file(folder / "picture", "1");
            std::this_thread::sleep_for(std::chrono::milliseconds(40));
            write_text_file(folder / "list", "2");
        });
        while (!fs::exists(folder / "picture")) std::this_thread::yield();
        remove_own_temporaries();
        ::_exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(names(), (std::set<std::string>{"list", "picture"}));
}

TEST_F(OutputFiles, ManyWritersTidyingAtOnceLoseNothing)
{
    std::vector<std::thread> writers;
    for (int w = 0; w < 4; ++w) {
        writers.emplace_back([&, w] {
            for (int i = 0; i < 50; ++i) {
                write_text_file(folder / (std::to_string(w) + "-" + std::to_string(i)), "x");
                remove_dead_temporaries(folder);
            }
        });
    }
    for (std::thread& writer : writers) writer.join();
    EXPECT_EQ(names().size(), 200u);
}

}  // namespace
}  // namespace petrichor
