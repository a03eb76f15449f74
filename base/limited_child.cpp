#include "base/limited_child.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstring>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

#include "base/error.h"
#include "base/sanitized.h"
#include "base/words.h"

namespace petrichor {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::uint64_t kLibraryBytes = 2ull << 30;  // address space that libraries may map
constexpr int kKept = 10;                            // descriptors from here on are closed
constexpr int kSparePlaces = 20;  // where they wait before they get their numbers

// The kernel kills a child when the *thread* that started it ends, so all are started by one that
// ends with the program.
class Starter {
public:
    Starter() : thread_([this] { run(); }) {}
    ~Starter()
    {
        {
            const std::lock_guard lock(guard_);
            closing_ = true;
        }
        changed_.notify_all();
        thread_.join();
    }
    void operator()(const std::function<void()>& work)
    {
        std::unique_lock lock(guard_);
        changed_.wait(lock, [&] { return !work_; });
        bool done = false;
        work_ = [&] {
            work();
            done = true;
        };
        changed_.notify_all();
        changed_.wait(lock, [&] { return done; });
    }

private:
    void run()
    {
        sigset_t all;  // signals are for the program's own threads
        sigfillset(&all);
        pthread_sigmask(SIG_SETMASK, &all, nullptr);
        std::unique_lock lock(guard_);
        for (;;) {
            changed_.wait(lock, [&] { return closing_ || work_; });
            if (closing_) return;
            work_();
            work_ = nullptr;
            changed_.notify_all();
        }
    }
    std::mutex guard_;
    std::condition_variable changed_;
    std::function<void()> work_;
    bool closing_ = false;
    std::thread thread_;
};

// One a process: it stands for the process in the kernel's eyes. After a fork its thread is not
// there any more, so the copy is given up for a new one.
Starter& starter()
{
    static std::mutex guard;
    static std::unique_ptr<Starter> the_starter;
    static pid_t owner = 0;
    const std::lock_guard lock(guard);
    if (owner != ::getpid()) {
        [[maybe_unused]] Starter* without_thread = the_starter.release();
        the_starter = std::make_unique<Starter>();
        owner = ::getpid();
    }
    return *the_starter;
}

struct Plan {
    const char* program = nullptr;
    char* const* arguments = nullptr;
    ChildLimits limits;
    const std::vector<std::pair<int, int>>* descriptors = nullptr;
    pid_t parent = 0;
    int report = -1;  // where errno of a failed start goes
    Trust trust = Trust::None;
};

void limit(int what, std::uint64_t value)
{
    rlimit both{};
    ::getrlimit(static_cast<__rlimit_resource_t>(what), &both);
    const rlim_t wanted = static_cast<rlim_t>(value);
    both.rlim_max = both.rlim_max == RLIM_INFINITY ? wanted : std::min(both.rlim_max, wanted);
    both.rlim_cur = both.rlim_max;
    ::setrlimit(static_cast<__rlimit_resource_t>(what), &both);
}

// In the child, between vfork and exec: it shares our memory, so nothing here allocates or returns.
[[noreturn]] void become(const Plan& plan)
{
    const auto give_up = [&] {
        const int why = errno;
        [[maybe_unused]] const ssize_t told = ::write(plan.report, &why, sizeof why);
        ::_exit(127);
    };
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != plan.parent) ::_exit(127);  // it died before we could ask
    // Ctrl-C in the terminal is for the program, which then ends its children.
    ::setpgid(0, 0);
    for (int number = 1; number < NSIG; ++number) ::signal(number, SIG_DFL);
    sigset_t none;
    sigemptyset(&none);
    ::sigprocmask(SIG_SETMASK, &none, nullptr);
    // First out of the way, then to their places: a place may be the source of another.
    int spare[kKept];
    for (int place = 0; place < kKept; ++place) spare[place] = -1;
    for (const auto& [ours, place] : *plan.descriptors) {
        spare[place] = ::fcntl(ours, F_DUPFD_CLOEXEC, kSparePlaces);
        if (spare[place] < 0) give_up();
    }
    const int report = ::fcntl(plan.report, F_DUPFD_CLOEXEC, kSparePlaces);
    const int nothing = ::open("/dev/null", O_RDWR | O_CLOEXEC);
    const int null_place = nothing < 0 ? -1 : ::fcntl(nothing, F_DUPFD_CLOEXEC, kSparePlaces);
    for (int place = 0; place < kKept; ++place) {
        const int from = spare[place] >= 0 ? spare[place] : place < 3 ? null_place : -1;
        if (from < 0) {
            ::close(place);
        } else if (::dup2(from, place) < 0) {
            give_up();
        }
    }
    if (::close_range(kKept, ~0u, CLOSE_RANGE_CLOEXEC) != 0) {
        for (int fd = kKept; fd < 4096; ++fd) ::fcntl(fd, F_SETFD, FD_CLOEXEC);
    }
    if (plan.trust == Trust::Full) {
        ::execve(plan.program, plan.arguments, environ);
        const int reason = errno;
        [[maybe_unused]] const ssize_t said = ::write(report, &reason, sizeof reason);
        ::_exit(127);
    }
    if (::chdir("/") != 0) give_up();
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_CPU, plan.limits.cpu_seconds + 1ull);
    rlimit cpu{};
    ::getrlimit(RLIMIT_CPU, &cpu);
    cpu.rlim_cur = std::min<rlim_t>(cpu.rlim_max, plan.limits.cpu_seconds);  // says why, then kills
    ::setrlimit(RLIMIT_CPU, &cpu);
    limit(RLIMIT_FSIZE, plan.limits.file_bytes);
    limit(RLIMIT_NOFILE, plan.limits.open_files);
#ifndef PETRICHOR_SANITIZED  // which map terabytes
    limit(RLIMIT_AS, plan.limits.memory_bytes + kLibraryBytes);
#endif
    ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
    char* no_environment[] = {nullptr};
    ::execve(plan.program, plan.arguments, no_environment);
    const int why = errno;
    [[maybe_unused]] const ssize_t told = ::write(report, &why, sizeof why);
    ::_exit(127);
}

struct Pipe {
    int read_end = -1, write_end = -1;
    explicit Pipe(std::string_view what)
    {
        int ends[2];
        if (::pipe2(ends, O_CLOEXEC) != 0) {
            throw Error(
                std::string(what) + ": no pipe to a helper program: " + std::strerror(errno),
                "Close some programs, or raise the limit on open files (ulimit -n).");
        }
        read_end = ends[0];
        write_end = ends[1];
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
    ~Pipe()
    {
        close_write();
        ::close(read_end);
    }
    void close_write()
    {
        if (write_end >= 0) ::close(write_end);
        write_end = -1;
    }
};

}  // namespace

std::string ChildEnd::text() const
{
    if (exited) return "gave up (exit status " + std::to_string(code) + ")";
    if (code == SIGXCPU) return "took more CPU time than its limit";
    if (code == SIGXFSZ) return "wrote more than its limit";
    if (code == SIGKILL) return "was ended: too slow, or short of memory";
    return "crashed (signal " + std::to_string(code) + ")";
}

LimitedChild::LimitedChild(const fs::path& program, const std::vector<std::string>& arguments,
                           const ChildLimits& limits,
                           const std::vector<std::pair<int, int>>& descriptors, Trust trust)
{
    const std::string path = fs::absolute(program).string();
    std::string name = program.filename().string();
    std::vector<std::string> words{name};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    Pipe report("helper " + name);
    const Plan plan{path.c_str(), argv.data(),      limits, &descriptors,
                    ::getpid(),   report.write_end, trust};
    pid_t child = -1;
    int failed = 0;
    starter()([&] {
        child =
            ::vfork();  // fork would copy the page tables of a program with gigabytes of textures
        if (child == 0) become(plan);
        if (child < 0) failed = errno;
    });
    report.close_write();
    if (child > 0) {
        ssize_t got = 0;
        do {
            got = ::read(report.read_end, &failed, sizeof failed);
        } while (got < 0 && errno == EINTR);
        if (got != static_cast<ssize_t>(sizeof failed)) failed = 0;
        pid_ = child;
    }
    if (failed != 0) {
        if (child > 0) end(true);
        throw Error("helper " + path + ": it cannot be started: " + std::strerror(failed),
                    "Check that it may be executed, close some programs, or raise the limits on "
                    "processes and open files.");
    }
}

LimitedChild::LimitedChild(LimitedChild&& other) noexcept : pid_(std::exchange(other.pid_, -1))
{
}

LimitedChild& LimitedChild::operator=(LimitedChild&& other) noexcept
{
    std::swap(pid_, other.pid_);
    return *this;
}

LimitedChild::~LimitedChild()
{
    end(true);
}

ChildEnd LimitedChild::end(bool kill)
{
    ChildEnd result;
    if (pid_ <= 0) return result;
    if (kill) ::kill(pid_, SIGKILL);
    int status = 0;
    while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
    }
    pid_ = -1;
    result.exited = WIFEXITED(status);
    result.code = result.exited ? WEXITSTATUS(status) : WTERMSIG(status);
    return result;
}

bool wait_readable(int fd, double seconds, const StopRequest& stop)
{
    const auto until = Clock::now() + std::chrono::duration<double>(seconds);
    for (;;) {
        if (stop && stop()) throw Interrupted("interrupted while a helper program was reading");
        pollfd waiting{fd, POLLIN, 0};
        const int ready = ::poll(&waiting, 1, 50);
        if (ready > 0) return true;
        if (ready < 0 && errno != EINTR) return true;  // reading will say what is wrong
        if (Clock::now() >= until) return false;
    }
}

namespace {

// Reads the answer and the last words side by side: a helper that fills one pipe would wait for
// ever.
struct Collector {
    const HelperJob& job;
    std::vector<std::byte> answer;
    std::string words;
    bool too_much = false, too_slow = false;

    void run(int answer_fd, int words_fd)
    {
        const auto until = Clock::now() + std::chrono::duration<double>(job.wall_seconds);
        pollfd ends[2] = {{answer_fd, POLLIN, 0}, {words_fd, POLLIN, 0}};
        std::vector<std::byte> buffer(1 << 16);
        while (ends[0].fd >= 0 || ends[1].fd >= 0) {
            if (job.stop && job.stop()) throw Interrupted("interrupted while reading " + job.name);
            if (Clock::now() >= until) {
                too_slow = true;
                return;
            }
            if (::poll(ends, 2, 50) <= 0) continue;
            for (pollfd& end : ends) {
                if (end.fd < 0 || end.revents == 0) continue;
                const ssize_t got = ::read(end.fd, buffer.data(), buffer.size());
                if (got < 0 && errno == EINTR) continue;
                if (got <= 0) {
                    end.fd = -1;
                    continue;
                }
                const auto count = static_cast<std::size_t>(got);
                if (&end == &ends[0]) {
                    if (answer.size() + count > job.max_answer_bytes) {
                        too_much = true;
                        return;
                    }
                    answer.insert(answer.end(), buffer.begin(), buffer.begin() + got);
                } else if (words.size() < 4096) {
                    words.append(reinterpret_cast<const char*>(buffer.data()), count);
                }
            }
        }
    }
};

}  // namespace

std::vector<std::byte> run_limited(const HelperJob& job)
{
    Pipe answer(job.name), words(job.name);
    std::vector<std::pair<int, int>> descriptors{{answer.write_end, 1}, {words.write_end, 2}};
    if (job.input >= 0) descriptors.emplace_back(job.input, 0);
    std::vector<std::string> arguments{"--memory=" + std::to_string(job.limits.memory_bytes)};
    arguments.insert(arguments.end(), job.arguments.begin(), job.arguments.end());
    LimitedChild child(job.program, arguments, job.limits, descriptors);
    answer.close_write();
    words.close_write();
    Collector collector{job, {}, {}};
    collector.run(answer.read_end, words.read_end);
    const ChildEnd end = child.end(collector.too_much || collector.too_slow);
    if (collector.too_slow) {
        throw Error(
            job.name + ": reading it took more than " + number_text(job.wall_seconds) + " s",
            "Use a smaller file; check that it is not damaged.");
    }
    if (collector.too_much) {
        throw Error(job.name + ": it holds more than the limit of " +
                        std::to_string(job.max_answer_bytes >> 20) + " MiB",
                    "Use a smaller part of it.");
    }
    if (end.exited && end.code == 0) return std::move(collector.answer);
    const auto line = collector.words.find('\n');
    std::string problem = printable(collector.words.substr(0, line));
    std::string fix = line == std::string::npos ? "" : printable(collector.words.substr(line + 1));
    if (problem.empty() || !end.exited) problem = "the program that reads it " + end.text();
    if (fix.empty())
        fix = "Check that the file opens in another program; fetch it again if it is damaged.";
    throw Error(job.name + ": " + problem, fix);
}

std::vector<std::byte> run_limited(HelperJob job, std::span<const std::byte> bytes)
{
    const int memory = shared_memory_of(bytes, job.name);
    job.input = memory;
    try {
        auto answer = run_limited(job);
        ::close(memory);
        return answer;
    } catch (...) {
        ::close(memory);
        throw;
    }
}

fs::path find_helper(std::string_view name, const std::vector<fs::path>& built)
{
    std::error_code ignored;
    const fs::path here = fs::read_symlink("/proc/self/exe", ignored).parent_path();
    std::vector<fs::path> places{here / name, here / "../libexec/petrichor" / name};
    places.insert(places.end(), built.begin(), built.end());
    std::vector<std::string> looked;
    for (const fs::path& place : places) {
        if (::access(place.c_str(), X_OK) == 0) return place;
        looked.push_back(place.string());
    }
    throw Error("helper: the program " + std::string(name) + " is missing (looked at " +
                    join_words(looked) + ")",
                "Install it beside petrichor: build and install petrichor again.");
}

int shared_memory_of(std::span<const std::byte> bytes, std::string_view what)
{
    const int fd = ::memfd_create("petrichor-bytes", MFD_CLOEXEC);
    int why = fd < 0 ? errno : 0;
    std::size_t done = 0;
    while (why == 0 && done < bytes.size()) {
        const ssize_t n = ::write(fd, bytes.data() + done, bytes.size() - done);
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) {
            why = n < 0 ? errno : ENOSPC;
            break;
        }
        done += static_cast<std::size_t>(n);
    }
    if (why == 0) {
        ::lseek(fd, 0, SEEK_SET);
        return fd;
    }
    if (fd >= 0) ::close(fd);
    if (why == EFBIG) {
        throw Error(std::string(what) + ": its " + std::to_string(bytes.size()) +
                        " bytes are more than this shell's limit on the size of a file",
                    "Raise it: ulimit -f unlimited.");
    }
    throw Error(std::string(what) + ": no shared memory for " + std::to_string(bytes.size()) +
                    " bytes: " + std::strerror(why),
                "Free some memory and try again.");
}

}  // namespace petrichor
