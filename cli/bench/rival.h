#ifndef PETRICHOR_CLI_BENCH_RIVAL_H
#define PETRICHOR_CLI_BENCH_RIVAL_H

#include <string>

#include "cli/bench/measure.h"

namespace petrichor::cli {

/// Another program to time beside ours.
struct Rival {
    std::string name;     ///< of its row
    std::string command;  ///< for the shell, with its redirections
};

/// From "NAME=COMMAND"; the command may hold further '='. Throws Error when either is missing or
/// the name holds anything but letters, digits, '_', '-' and '.'.
Rival parse_rival(const std::string& text);

/// CPU time of the command and of all it started, and time by the clock, from its start to its end;
/// what it reads from the terminal or prints goes nowhere. Medians of `repeat` runs after one that
/// is not counted; a command of more than 20 CPU seconds is run once.
///
/// Ctrl-C or SIGTERM meanwhile ends the command and everything it started, then this program.
///   throws  Error when it cannot be started or fails, with the last line it wrote to stderr
Cost time_rival(const Rival& rival, int repeat);

/// The same for one run, which is counted.
Cost run_once(const Rival& rival);

}  // namespace petrichor::cli

#endif
