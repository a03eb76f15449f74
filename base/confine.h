#ifndef PETRICHOR_BASE_CONFINE_H
#define PETRICHOR_BASE_CONFINE_H

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace petrichor {

// The inside of a helper program (base/limited_child.h is the outside). Library petrichor_helper.

/// What confine() could do on this machine, the strongest first.
enum class Confinement : std::uint32_t {
    Seccomp = 1,  ///< the kernel refuses every call but those that compute: no file, no socket, no
                  ///< program, no other process
    Landlock,     ///< no file can be opened; sockets and other processes remain
    None,         ///< the limits of memory and time only
};

/// "seccomp: no files, no network, no programs", for the report of what works.
std::string confinement_text(Confinement confinement);

/// Gives up, for ever, everything that reading a file in memory does not need. Call it when the
/// libraries are loaded (dlopen opens files) and before the first byte of the input is looked at.
/// Calls that are refused fail with EPERM. Threads may be started; descriptors that are open stay.
Confinement confine();

/// Limits the address space to `bytes` above what is mapped now. Call it after loading libraries.
void limit_memory(std::uint64_t bytes);

/// From now on this process may use `seconds` more of CPU time; then the kernel ends it.
void limit_cpu(unsigned seconds);

/// What run_helper() hands to the work.
struct HelperInput {
    std::span<const std::byte> bytes;    ///< standard input, mapped read-only
    std::vector<std::string> arguments;  ///< after the program's name, without --memory=N
};

/// The main() of a helper: calls `load` (may open what it likes), confines itself, maps its input,
/// calls `work` and writes what it returns to standard output. Exit status 0; 2 with the reason on
/// standard error, its fix on the next line, for every exception.
int run_helper(int argc, char** argv,
               const std::function<std::vector<std::byte>(const HelperInput&)>& work,
               const std::function<void()>& load = {});

}  // namespace petrichor

#endif
