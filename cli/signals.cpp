#include "cli/signals.h"

#include <csignal>
#include <initializer_list>

namespace petrichor::cli {
namespace {

volatile std::sig_atomic_t stop_requested = 0;

void request_stop(int signal)
{
    stop_requested = 1;
    std::signal(signal, SIG_DFL);  // the next one is not asked to wait
}

}  // namespace

void watch_for_interrupt()
{
    struct sigaction action = {};
    action.sa_handler = request_stop;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    for (const int signal : {SIGINT, SIGTERM}) {
        // Also where a shell started us in the background with SIGINT ignored: who sends one means
        // it.
        sigaction(signal, &action, nullptr);
    }
    std::signal(SIGXFSZ, SIG_IGN);
    std::signal(SIGPIPE, SIG_IGN);
}

bool interrupted()
{
    return stop_requested != 0;
}

}  // namespace petrichor::cli
