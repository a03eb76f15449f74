#ifndef PETRICHOR_CLI_EXIT_H
#define PETRICHOR_CLI_EXIT_H

#include "base/interrupted.h"

namespace petrichor::cli {

inline constexpr int kExitDone = 0;
inline constexpr int kExitUser = 2;   ///< the user can mend it
inline constexpr int kExitOurs = 70;  ///< our fault
inline constexpr int kExitInterrupted = 130;
inline constexpr int kExitPipe = 141;  ///< nobody reads standard output any more

/// Thrown by a command that has said all there is to say and only needs its exit code.
struct ExitCode {
    int code = 0;
};

}  // namespace petrichor::cli

#endif
