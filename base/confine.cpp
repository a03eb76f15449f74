#include "base/confine.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fstream>
#include <new>
#include <stdexcept>

#include "base/error.h"
#include "base/sanitized.h"

#if __has_include(<linux/landlock.h>)
#include <linux/landlock.h>
#endif
#ifdef PETRICHOR_SECCOMP
#include <sched.h>
#include <seccomp.h>
#endif

namespace petrichor {

namespace {

// No path may be opened, read or written any more. Needs Linux 5.13 with Landlock switched on.
bool landlock()
{
#if defined(LANDLOCK_ACCESS_FS_EXECUTE) && defined(SYS_landlock_create_ruleset)
    landlock_ruleset_attr rules{};
    rules.handled_access_fs =
        LANDLOCK_ACCESS_FS_EXECUTE | LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_READ_FILE |
        LANDLOCK_ACCESS_FS_READ_DIR | LANDLOCK_ACCESS_FS_REMOVE_DIR |
        LANDLOCK_ACCESS_FS_REMOVE_FILE | LANDLOCK_ACCESS_FS_MAKE_CHAR |
        LANDLOCK_ACCESS_FS_MAKE_DIR | LANDLOCK_ACCESS_FS_MAKE_REG | LANDLOCK_ACCESS_FS_MAKE_SOCK |
        LANDLOCK_ACCESS_FS_MAKE_FIFO | LANDLOCK_ACCESS_FS_MAKE_BLOCK | LANDLOCK_ACCESS_FS_MAKE_SYM;
    const long set =
        ::syscall(SYS_landlock_create_ruleset, &rules, sizeof rules.handled_access_fs, 0);
    if (set < 0) return false;
    const long done = ::syscall(SYS_landlock_restrict_self, set, 0);
    ::close(static_cast<int>(set));
    return done == 0;
#else
    return false;
#endif
}

#ifdef PETRICHOR_SECCOMP
// The calls that computing needs: memory, threads, clocks, and work on descriptors that are open.
constexpr int kAllowed[] = {SCMP_SYS(read),
                            SCMP_SYS(readv),
                            SCMP_SYS(pread64),
                            SCMP_SYS(preadv),
                            SCMP_SYS(write),
                            SCMP_SYS(writev),
                            SCMP_SYS(pwrite64),
                            SCMP_SYS(lseek),
                            SCMP_SYS(close),
                            SCMP_SYS(fstat),
                            SCMP_SYS(fstat64),
                            SCMP_SYS(ftruncate),
                            SCMP_SYS(ftruncate64),
                            SCMP_SYS(dup),
                            SCMP_SYS(poll),
                            SCMP_SYS(ppoll),
                            SCMP_SYS(recvmsg),
                            SCMP_SYS(sendmsg),
                            SCMP_SYS(memfd_create),
                            SCMP_SYS(brk),
                            SCMP_SYS(mmap),
                            SCMP_SYS(mmap2),
                            SCMP_SYS(munmap),
                            SCMP_SYS(mremap),
                            SCMP_SYS(madvise),
                            SCMP_SYS(futex),
                            SCMP_SYS(set_robust_list),
                            SCMP_SYS(rseq),
                            SCMP_SYS(sched_yield),
                            SCMP_SYS(sched_getaffinity),
                            SCMP_SYS(getcpu),
                            SCMP_SYS(getpid),
                            SCMP_SYS(gettid),
                            SCMP_SYS(getrandom),
                            SCMP_SYS(clock_gettime),
                            SCMP_SYS(clock_getres),
                            SCMP_SYS(gettimeofday),
                            SCMP_SYS(time),
                            SCMP_SYS(clock_nanosleep),
                            SCMP_SYS(nanosleep),
                            SCMP_SYS(getrusage),
                            SCMP_SYS(getrlimit),
                            SCMP_SYS(ugetrlimit),
                            SCMP_SYS(sysinfo),
                            SCMP_SYS(uname),
                            SCMP_SYS(rt_sigaction),
                            SCMP_SYS(rt_sigprocmask),
                            SCMP_SYS(rt_sigreturn),
                            SCMP_SYS(sigaltstack),
                            SCMP_SYS(restart_syscall),
#ifdef PETRICHOR_SANITIZED
                            SCMP_SYS(pipe),
                            SCMP_SYS(pipe2),
#endif
                            SCMP_SYS(exit),
                            SCMP_SYS(exit_group)};

bool seccomp()
{
    struct Filter {
        scmp_filter_ctx at = seccomp_init(SCMP_ACT_ERRNO(EPERM));
        ~Filter()
        {
            if (at) seccomp_release(at);
        }
    } filter;
    if (!filter.at) return false;
    bool good = true;
    for (const int call : kAllowed)
        good = good && seccomp_rule_add(filter.at, SCMP_ACT_ALLOW, call, 0) == 0;
    // Threads, not processes; the newer call hides its flags, so the C library is told to use the
    // older.
    const auto threads = static_cast<scmp_datum_t>(CLONE_THREAD);
    good = good && seccomp_rule_add(filter.at, SCMP_ACT_ALLOW, SCMP_SYS(clone), 1,
                                    SCMP_A0(SCMP_CMP_MASKED_EQ, threads, threads)) == 0;
    good = good && seccomp_rule_add(filter.at, SCMP_ACT_ERRNO(ENOSYS), SCMP_SYS(clone3), 0) == 0;
    // Memory that was written never becomes code.
    const auto executable = static_cast<scmp_datum_t>(PROT_EXEC);
    good = good && seccomp_rule_add(filter.at, SCMP_ACT_ALLOW, SCMP_SYS(mprotect), 1,
                                    SCMP_A2(SCMP_CMP_MASKED_EQ, executable, 0)) == 0;
    // The C library's fstat: no name, only a descriptor (a name needs its pointer, which is not
    // seen here; with AT_EMPTY_PATH a name would still only be looked at, never opened).
    const auto empty = static_cast<scmp_datum_t>(AT_EMPTY_PATH);
    good = good && seccomp_rule_add(filter.at, SCMP_ACT_ALLOW, SCMP_SYS(newfstatat), 1,
                                    SCMP_A3(SCMP_CMP_MASKED_EQ, empty, empty)) == 0;
    // Its own soft limits, below the hard ones of the start: process 0 is itself.
    good = good && seccomp_rule_add(filter.at, SCMP_ACT_ALLOW, SCMP_SYS(prlimit64), 1,
                                    SCMP_A0(SCMP_CMP_EQ, 0)) == 0;
    good =
        good && seccomp_rule_add(filter.at, SCMP_ACT_ALLOW, SCMP_SYS(tgkill), 1,
                                 SCMP_A0(SCMP_CMP_EQ, static_cast<scmp_datum_t>(::getpid()))) == 0;
    good = good && seccomp_rule_add(filter.at, SCMP_ACT_ALLOW, SCMP_SYS(fcntl), 1,
                                    SCMP_A1(SCMP_CMP_EQ, F_GETFL)) == 0;
    good = good && seccomp_rule_add(filter.at, SCMP_ACT_ALLOW, SCMP_SYS(fcntl), 1,
                                    SCMP_A1(SCMP_CMP_EQ, F_DUPFD_CLOEXEC)) == 0;
    return good && seccomp_load(filter.at) == 0;
}
#else
bool seccomp()
{
    return false;
}
#endif

}  // namespace

std::string confinement_text(Confinement confinement)
{
    switch (confinement) {
        case Confinement::Seccomp:
            return "seccomp: no files, no network, no programs";
        case Confinement::Landlock:
            return "Landlock: no files; the network is not shut";
        case Confinement::None:
            break;
    }
    return "limits of memory and time only";
}

Confinement confine()
{
    ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
    const bool no_files = landlock();
    if (seccomp()) return Confinement::Seccomp;
    return no_files ? Confinement::Landlock : Confinement::None;
}

void limit_memory(std::uint64_t bytes)
{
    std::uint64_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    rlimit limit{};
    ::getrlimit(RLIMIT_AS, &limit);
#ifdef PETRICHOR_SANITIZED
    bytes = RLIM_INFINITY / 2;
#endif
    const rlim_t wanted = pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)) + bytes;
    limit.rlim_cur = limit.rlim_max == RLIM_INFINITY ? wanted : std::min(limit.rlim_max, wanted);
    limit.rlim_max = limit.rlim_cur;
    ::setrlimit(RLIMIT_AS, &limit);
    rlimit no_core{0, 0};
    ::setrlimit(RLIMIT_CORE, &no_core);
}

void limit_cpu(unsigned seconds)
{
    rusage used{};
    ::getrusage(RUSAGE_SELF, &used);
    rlimit limit{};
    ::getrlimit(RLIMIT_CPU, &limit);
    const rlim_t wanted =
        static_cast<rlim_t>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) + seconds + 1;
    limit.rlim_cur = limit.rlim_max == RLIM_INFINITY ? wanted : std::min(limit.rlim_max, wanted);
    ::setrlimit(RLIMIT_CPU, &limit);
}

int run_helper(int argc, char** argv,
               const std::function<std::vector<std::byte>(const HelperInput&)>& work,
               const std::function<void()>& load)
{
    const auto say = [](const std::string& problem, const std::string& fix) {
        const std::string text = problem + "\n" + fix;
        [[maybe_unused]] const ssize_t told = ::write(2, text.data(), text.size());
        ::_exit(2);  // without the exit handlers of libraries that may be in any state
    };
    try {
        HelperInput input;
        std::uint64_t memory = 1ull << 30;
        for (int i = 1; i < argc; ++i) {
            const std::string word = argv[i];
            if (word.rfind("--memory=", 0) == 0) {
                memory = std::strtoull(word.c_str() + 9, nullptr, 10);
            } else {
                input.arguments.push_back(word);
            }
        }
        struct stat status {};
        if (::fstat(0, &status) != 0 || !S_ISREG(status.st_mode)) {
            throw Error("it is not a regular file",
                        "This program is started by petrichor; it has no use by hand.");
        }
        if (load) load();
        limit_memory(memory);
        confine();
        if (status.st_size > 0) {
            const auto size = static_cast<std::size_t>(status.st_size);
            void* at = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, 0, 0);
            if (at == MAP_FAILED) throw std::bad_alloc();
            input.bytes = {static_cast<const std::byte*>(at), size};
        }
        const std::vector<std::byte> answer = work(input);
        for (std::size_t done = 0; done < answer.size();) {
            const ssize_t n = ::write(1, answer.data() + done, answer.size() - done);
            if (n < 0 && errno == EINTR) continue;
            if (n <= 0) ::_exit(3);
            done += static_cast<std::size_t>(n);
        }
        ::_exit(0);
    } catch (const Error& error) {
        say(error.what(), error.fix());
    } catch (const std::bad_alloc&) {
        say("it needs more memory than the limit", "Use a smaller file.");
    } catch (const std::exception& error) {
        say(error.what(), "");
    }
    return 2;
}

}  // namespace petrichor
