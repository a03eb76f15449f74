#include "base/limited_child.h"
#include "base/sanitized.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstring>
#include <fstream>
#include <thread>

#include "base/error.h"

namespace petrichor {
namespace {

using Clock = std::chrono::steady_clock;
using testing::HasSubstr;

HelperJob job()
{
    HelperJob result;
    result.program = PROBE_HELPER;
    result.name = "probe";
    result.limits = {.memory_bytes = 256 << 20, .cpu_seconds = 2};
    result.wall_seconds = 20.0;
    return result;
}

std::string ask(const std::string& word, const HelperJob& how = job())
{
    const auto answer = run_limited(how, std::as_bytes(std::span(word)));
    return std::string(reinterpret_cast<const char*>(answer.data()), answer.size());
}

std::string problem(const std::string& word, const HelperJob& how = job())
{
    try {
        return "answered " + ask(word, how);
    } catch (const Error& error) {
        return error.what() + std::string("|") + error.fix();
    }
}

double seconds_since(Clock::time_point start)
{
    return std::chrono::duration<double>(Clock::now() - start).count();
}

TEST(LimitedChild, AnswersAndComputesAndStartsThreads)
{
    EXPECT_EQ(ask("hello"), "echo hello");
    EXPECT_EQ(ask(""), "echo ");
    EXPECT_EQ(ask("thread"), "allowed");
}

#ifdef PETRICHOR_SECCOMP
TEST(LimitedChild, CannotOpenAFileOrASocketOrStartAProgram)
{
    for (const char* what :
         {"open", "create", "socket", "unix socket", "exec", "fork", "kill", "ptrace", "unlink"}) {
        EXPECT_EQ(ask(what), std::strerror(EPERM)) << what;
    }
}
#endif

TEST(LimitedChild, HasNoEnvironmentNoFilesOfOursAndAGroupOfItsOwn)
{
    ::setenv("PETRICHOR_SECRET", "1", 1);
    const int leaked = ::open("/etc/passwd", O_RDONLY);  // without close-on-exec
    EXPECT_EQ(ask("environment"), "empty");
    EXPECT_EQ(ask("descriptors"), "");
    ::close(leaked);
    const LimitedChild child(PROBE_HELPER, {}, {}, {});
    EXPECT_EQ(::getpgid(child.id()), child.id());
}

TEST(LimitedChild, IsEndedByItsLimits)
{
#ifndef PETRICHOR_SANITIZED  // which has no limit of memory
    EXPECT_THAT(problem("memory"), HasSubstr("more memory than the limit"));
#endif
    EXPECT_THAT(problem("loop"), HasSubstr("more CPU time than its limit"));
    EXPECT_THAT(problem("crash"), HasSubstr("crashed (signal 6)"));
    HelperJob impatient = job();
    impatient.wall_seconds = 0.3;
    EXPECT_THAT(problem("sleep", impatient), HasSubstr("more than 0.3 s"));
    HelperJob small = job();
    small.max_answer_bytes = 1 << 20;
    EXPECT_THAT(problem("much", small), HasSubstr("more than the limit of 1 MiB"));
}

TEST(LimitedChild, PassesItsWordsOnWithoutControlCharacters)
{
    EXPECT_EQ(problem("refuse"), "probe: it is \\x1b[31mred|Paint it.");
}

TEST(LimitedChild, StopsWithinHalfASecond)
{
    std::atomic<bool> stop{false};
    std::thread later([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
        stop = true;
    });
    HelperJob how = job();
    how.stop = [&] { return stop.load(); };
    const auto start = Clock::now();
    EXPECT_THROW(ask("sleep", how), Interrupted);
    EXPECT_LT(seconds_since(start), 0.7);
    later.join();
}

TEST(LimitedChild, MissingProgramsAreNamed)
{
    HelperJob how = job();
    how.program = "/no/such/program";
    EXPECT_THAT(problem("x", how), HasSubstr("/no/such/program: it cannot be started"));
    EXPECT_THROW(find_helper("petrichor-no-such-helper", {}), Error);
}

TEST(LimitedChild, ManyThreadsMayStartOnesAtOnce)
{
    std::vector<std::thread> threads;
    std::atomic<int> good{0};
    for (int i = 0; i < 8; ++i) {
        threads.emplace_back([&, i] {
            for (int k = 0; k < 5; ++k) {
                const std::string word = std::to_string(i) + "-" + std::to_string(k);
                if (ask(word) == "echo " + word) ++good;
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(good, 40);
}

bool is_gone(pid_t process)
{
    std::ifstream status("/proc/" + std::to_string(process) + "/stat");
    std::string id, name, state;
    return !(status >> id >> name >> state) || state == "Z";
}

// A program is killed with SIGKILL while its helper sleeps: the helper goes too.
TEST(LimitedChild, DiesWithItsParent)
{
    int pipe_ends[2];
    ASSERT_EQ(::pipe(pipe_ends), 0);
    const pid_t parent = ::fork();
    if (parent == 0) {
        const std::string word = "sleep";
        const int input = shared_memory_of(std::as_bytes(std::span(word)), "probe");
        const LimitedChild child(PROBE_HELPER, {}, {}, {{input, 0}});
        const pid_t id = child.id();
        if (::write(pipe_ends[1], &id, sizeof id) != sizeof id) ::_exit(1);
        ::sleep(600);
        ::_exit(0);
    }
    pid_t child = 0;
    ASSERT_EQ(::read(pipe_ends[0], &child, sizeof child), static_cast<ssize_t>(sizeof child));
    EXPECT_FALSE(is_gone(child));
    ::kill(parent, SIGKILL);
    ::waitpid(parent, nullptr, 0);
    const auto start = Clock::now();
    while (!is_gone(child) && seconds_since(start) < 5.0)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_TRUE(is_gone(child));
    EXPECT_LT(seconds_since(start), 0.5);
    ::close(pipe_ends[0]);
    ::close(pipe_ends[1]);
}

}  // namespace
}  // namespace petrichor
