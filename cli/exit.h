#ifndef PETRICHOR_CLI_EXIT_H
#define PETRICHOR_CLI_EXIT_H

#include <stdexcept>
#include <string>

namespace petrichor::cli {

inline constexpr int kExitDone = 0;
inline constexpr int kExitUser = 2;   ///< the user can mend it
inline constexpr int kExitOurs = 70;  ///< our fault
inline constexpr int kExitInterrupted = 130;

/// Thrown by a command that has said all there is to say and only needs its exit code.
struct ExitCode {
    int code = 0;
};

/// Thrown when Ctrl-C stopped the work; what() says what was kept and how to go on.
class Interrupted : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

}  // namespace petrichor::cli

#endif
