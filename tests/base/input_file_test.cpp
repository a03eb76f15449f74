#include "base/input_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <fstream>

#include "base/error.h"

namespace petrichor {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class InputFiles : public testing::Test {
protected:
    InputFiles() { fs::create_directories(folder); }
    ~InputFiles() override { fs::remove_all(folder); }
    fs::path folder = fs::path(testing::TempDir()) / ("input-" + std::to_string(::getpid()));

    static std::string problem(const fs::path& path, std::uint64_t most = 100)
    {
        try {
            return "read " + read_file(path, "thing", most);
        } catch (const Error& error) {
            return error.what();
        }
    }
};

TEST_F(InputFiles, RegularFilesAreRead)
{
    std::ofstream(folder / "a") << "hello";
    fs::create_symlink("a", folder / "link");
    EXPECT_EQ(problem(folder / "a"), "read hello");
    EXPECT_EQ(problem(folder / "link"), "read hello");
    EXPECT_THAT(problem(folder / "a", 4), HasSubstr("over the limit of 4"));
    EXPECT_THAT(problem(folder / "none"), HasSubstr("there is no such file"));
}

// Each of these would hang or never end when it is simply opened and read.
TEST_F(InputFiles, NothingElseIsOpened)
{
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    EXPECT_THAT(problem(folder / "pipe"), HasSubstr("it is a named pipe, not a file"));
    EXPECT_THAT(problem("/dev/zero"), HasSubstr("it is a device, not a file"));
    EXPECT_THAT(problem(folder), HasSubstr("it is a folder, not a file"));
    fs::create_symlink("/dev/zero", folder / "link");
    EXPECT_THAT(problem(folder / "link"), HasSubstr("it is a device, not a file"));
    fs::create_symlink("loop", folder / "loop");
    EXPECT_THAT(problem(folder / "loop"), HasSubstr("it cannot be opened"));
}

TEST_F(InputFiles, ReadingStopsWhenAsked)
{
    std::ofstream(folder / "a") << std::string(10 << 20, 'x');
    int asked = 0;
    EXPECT_THROW(read_file(folder / "a", "thing", 1 << 30, [&] { return ++asked > 3; }),
                 Interrupted);
    EXPECT_EQ(asked, 4);
}

TEST_F(InputFiles, NamesInMessagesArePrintable)
{
    EXPECT_THAT(problem(folder / "\x1b[2Jx\xff"), HasSubstr("\\x1b[2Jx\\xff: there is no such"));
}

}  // namespace
}  // namespace petrichor
