#include "cli/bench/rival.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/signalfd.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <memory>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/interrupted.h"

namespace petrichor::cli {
namespace {

constexpr double kLongMs = 20e3;  // a warm-up changes nothing
constexpr int kNotFound = 127;    // of the shell
constexpr int kNotAProgram = 126;

class Descriptor {
public:
    explicit Descriptor(int number) : number_(number) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor()
    {
        if (number_ >= 0) ::close(number_);
    }
    int number() const { return number_; }

private:
    int number_;
};

// Holds Ctrl-C and SIGTERM back until its end: whoever sent one is served then.
class HeldSignals {
public:
    HeldSignals() : pending_(prepare()) {}
    HeldSignals(const HeldSignals&) = delete;
    HeldSignals& operator=(const HeldSignals&) = delete;
    ~HeldSignals() { ::sigprocmask(SIG_SETMASK, &before_, nullptr); }
    const sigset_t& before() const { return before_; }
    int readable_when_sent() const { return pending_.number(); }

private:
    int prepare()
    {
        sigset_t held;
        sigemptyset(&held);
        sigaddset(&held, SIGINT);
        sigaddset(&held, SIGTERM);
        ::sigprocmask(SIG_BLOCK, &held, &before_);
        return ::signalfd(-1, &held, SFD_CLOEXEC);
    }
    sigset_t before_{};
    Descriptor pending_;
};

Error cannot_start(const Rival& rival)
{
    return {"bench: cannot start rival '" + rival.name + "': " + std::strerror(errno),
            "Close some programs and try again."};
}

// In a process group of its own, so that all of it can be ended together.
pid_t start(const Rival& rival, int error_output, const sigset_t& signals)
{
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, error_output, 2);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK);
    posix_spawnattr_setsigmask(&attributes, &signals);
    std::string shell = "sh", option = "-c", command = rival.command;
    char* arguments[] = {shell.data(), option.data(), command.data(), nullptr};
    pid_t child = 0;
    errno = ::posix_spawn(&child, "/bin/sh", &actions, &attributes, arguments, environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    if (errno != 0) throw cannot_start(rival);
    return child;
}

struct Ending {
    int status = 0;
    rusage usage{};        // of the command and of what it waited for
    bool stopped = false;  // this program was asked to end
};

Ending wait_for(pid_t child, const HeldSignals& signals)
{
    // The C library of Debian 12 declares pidfd_open() for C only.
    const Descriptor process(static_cast<int>(::syscall(SYS_pidfd_open, child, 0)));
    pollfd events[] = {{process.number(), POLLIN, 0}, {signals.readable_when_sent(), POLLIN, 0}};
    // An old kernel has no such descriptor: signals then wait for the command's own end.
    if (process.number() >= 0) {
        while (::poll(events, 2, -1) < 0 && errno == EINTR) {
        }
    }
    Ending ending;
    ending.stopped = events[1].revents != 0;
    if (ending.stopped) ::kill(-child, SIGTERM);
    while (::wait4(child, &ending.status, 0, &ending.usage) < 0 && errno == EINTR) {
    }
    return ending;
}

double milliseconds(const timeval& time)
{
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-3 * static_cast<double>(time.tv_usec);
}

std::string last_line(std::FILE* file)
{
    std::rewind(file);
    std::string last, line;
    for (int c = std::fgetc(file); c != EOF; c = std::fgetc(file)) {
        if (c != '\n') {
            line += static_cast<char>(c);
        } else if (!line.empty()) {
            last = std::exchange(line, {});
        }
    }
    return line.empty() ? last : line;
}

void check_ending(const Rival& rival, int status, std::FILE* error_output)
{
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
    const std::string named = "bench: rival '" + rival.name + "' ";
    const std::string last = last_line(error_output);
    const std::string words = last.empty() ? "" : ": " + last;
    if (!WIFEXITED(status)) {
        throw Error(named + "was ended by signal " + std::to_string(WTERMSIG(status)) + words,
                    "Run its command by itself to see why: " + rival.command);
    }
    const int code = WEXITSTATUS(status);
    if (code == kNotFound || code == kNotAProgram) {
        throw Error(named + (code == kNotFound ? "was not found" : "is not a program") + words,
                    "Give the path of a program after '" + rival.name + "='.");
    }
    throw Error(named + "failed with exit code " + std::to_string(code) + words,
                "Run its command by itself to see why: " + rival.command);
}

}  // namespace

Rival parse_rival(const std::string& text)
{
    const std::size_t equals = text.find('=');
    const std::string name = text.substr(0, equals);
    const bool plain = name.find_first_not_of(
                           "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                           "0123456789_-.") == std::string::npos;
    if (equals == std::string::npos || name.empty() || !plain ||
        text.find_first_not_of(" \t\n", equals + 1) == std::string::npos) {
        throw Error("bench: --rival must be NAME=COMMAND, got '" + text + "'",
                    "Name it with letters, digits, '_', '-' or '.', as in "
                    "--rival \"FSM2=./FSM2 < nlst.txt\".");
    }
    return {name, text.substr(equals + 1)};
}

Cost run_once(const Rival& rival)
{
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> error_output(std::tmpfile(), std::fclose);
    if (!error_output) throw cannot_start(rival);
    Ending ending;
    Cost cost = timed([&] {
        const HeldSignals signals;
        ending = wait_for(start(rival, ::fileno(error_output.get()), signals.before()), signals);
    });
    if (ending.stopped) throw Interrupted("interrupted while rival '" + rival.name + "' ran");
    check_ending(rival, ending.status, error_output.get());
    cost.cpu_ms = milliseconds(ending.usage.ru_utime) + milliseconds(ending.usage.ru_stime);
    cost.peak_mib = static_cast<double>(ending.usage.ru_maxrss) / 1024.0;
    return cost;
}

Cost time_rival(const Rival& rival, int repeat)
{
    const Cost first = run_once(rival);
    if (first.cpu_ms > kLongMs) return first;
    std::vector<Cost> costs;
    for (int i = 0; i < repeat; ++i) costs.push_back(run_once(rival));
    return median_of_costs(costs);
}

}  // namespace petrichor::cli
