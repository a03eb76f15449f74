// A helper that misbehaves on demand: its input is a word, the answer what came of it.
#include <arpa/inet.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/ptrace.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <new>
#include <string>
#include <thread>
#include <vector>

#include "base/confine.h"
#include "base/error.h"

namespace {

using namespace petrichor;

std::string outcome(long result)
{
    return result >= 0 ? "allowed" : std::strerror(errno);
}

std::string probed(const std::string& word)
{
    if (word == "open") return outcome(::open("/etc/passwd", O_RDONLY));
    if (word == "create") return outcome(::open("/tmp/petrichor-probe", O_CREAT | O_WRONLY, 0600));
    if (word == "socket") return outcome(::socket(AF_INET, SOCK_STREAM, 0));
    if (word == "unix socket") return outcome(::socket(AF_UNIX, SOCK_STREAM, 0));
    if (word == "exec") return outcome(::execl("/bin/true", "true", nullptr));
    if (word == "fork") return outcome(::fork());
    if (word == "kill") return outcome(::kill(::getppid(), 0));
    if (word == "ptrace") return outcome(::ptrace(PTRACE_ATTACH, ::getppid(), nullptr, nullptr));
    if (word == "unlink") return outcome(::unlink("/tmp/petrichor-no-such-file"));
    if (word == "environment") return environ && environ[0] ? environ[0] : "empty";
    if (word == "thread") {
        std::string answer;
        std::thread([&] { answer = "allowed"; }).join();
        return answer;
    }
    if (word == "descriptors") {
        std::string open;
        for (int fd = 3; fd < 1024; ++fd) {
            if (::fcntl(fd, F_GETFL) >= 0) open += std::to_string(fd) + " ";
        }
        return open;
    }
    if (word == "memory") {
        std::vector<std::vector<char>> kept;
        for (;;) kept.emplace_back(64 << 20, 'x');
    }
    if (word == "loop") {
        for (volatile bool on = true; on;) {
        }
    }
    if (word == "sleep") ::sleep(600);
    if (word == "crash") std::abort();
    if (word == "much") return std::string(64 << 20, 'x');
    if (word == "refuse") throw Error("it is \x1b[31mred", "Paint it.");
    return "echo " + word;
}

}  // namespace

int main(int argc, char** argv)
{
    return run_helper(argc, argv, [](const HelperInput& input) {
        const std::string word(reinterpret_cast<const char*>(input.bytes.data()),
                               input.bytes.size());
        const std::string answer = probed(word);
        const auto* bytes = reinterpret_cast<const std::byte*>(answer.data());
        return std::vector<std::byte>(bytes, bytes + answer.size());
    });
}
