#include "cli/signals.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <initializer_list>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>

#include "base/lock_within.h"
#include "base/output_file.h"
#include "cli/exit.h"

namespace petrichor::cli {
namespace {

volatile std::sig_atomic_t stop_requested = 0;
int wake_end = -1;  // the handler writes here, the watching thread reads at the other end

constexpr auto kPatience = std::chrono::milliseconds(250);

struct Words {
    std::mutex guard;
    std::function<std::string()> text;
};
Words& last_words()
{
    static Words* words = new Words;  // used while the process ends
    return *words;
}

void request_stop(int signal)
{
    const int kept = errno;
    stop_requested = 1;
    std::signal(signal, SIG_DFL);  // the next one is not asked to wait
    const char byte = 1;
    [[maybe_unused]] const ssize_t told = ::write(wake_end, &byte, 1);
    errno = kept;
}

// The process is gone when its last thread is, and one of the driver's has the lowest priority: on
// a busy machine it may wait long for its turn to end. Only some users may raise it.
void let_all_threads_end()
{
    std::error_code failed;
    for (std::filesystem::directory_iterator task("/proc/self/task", failed), end;
         !failed && task != end; task.increment(failed)) {
        const long id = std::strtol(task->path().filename().c_str(), nullptr, 10);
        ::setpriority(PRIO_PROCESS, static_cast<id_t>(id), ::getpriority(PRIO_PROCESS, 0));
    }
}

// Work that asks interrupted() ends by itself and the process is gone; the rest is ended here.
void end_what_does_not(int wake)
{
    char byte = 0;
    while (::read(wake, &byte, 1) < 0 && errno == EINTR) {
    }
    std::this_thread::sleep_for(kPatience);
    let_all_threads_end();
    remove_own_temporaries();
    std::string text = "interrupted: what was finished is kept";
    Words& words = last_words();
    if (const auto lock = lock_within(words.guard, std::chrono::milliseconds(20)); lock && words.text)
        text = words.text();
    if (text.empty()) ::_exit(kExitInterrupted);
    text = (::isatty(STDERR_FILENO) == 1 ? "\n" : "") + text + "\n";
    ::fcntl(STDERR_FILENO, F_SETFL, ::fcntl(STDERR_FILENO, F_GETFL) | O_NONBLOCK);
    [[maybe_unused]] const ssize_t said = ::write(STDERR_FILENO, text.data(), text.size());
    ::_exit(kExitInterrupted);
}

}  // namespace

void watch_for_interrupt()
{
    std::signal(SIGXFSZ, SIG_IGN);
    std::signal(SIGPIPE, SIG_IGN);
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) == 0) {
        wake_end = ends[1];
        ::fcntl(wake_end, F_SETFL, O_NONBLOCK);
        sigset_t all, before;  // signals are for the other threads
        sigfillset(&all);
        pthread_sigmask(SIG_SETMASK, &all, &before);
        std::thread(end_what_does_not, ends[0]).detach();
        pthread_sigmask(SIG_SETMASK, &before, nullptr);
    }
    struct sigaction action = {};
    action.sa_handler = request_stop;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    for (const int signal : {SIGINT, SIGTERM}) {
        // Also where a shell started us in the background with SIGINT ignored: who sends one means
        // it.
        sigaction(signal, &action, nullptr);
    }
}

bool interrupted()
{
    return stop_requested != 0;
}

void set_last_words(std::function<std::string()> words)
{
    const std::lock_guard lock(last_words().guard);
    last_words().text = std::move(words);
}

}  // namespace petrichor::cli
