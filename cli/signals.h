#ifndef PETRICHOR_CLI_SIGNALS_H
#define PETRICHOR_CLI_SIGNALS_H

namespace petrichor::cli {

/// Turns Ctrl-C (SIGINT) and SIGTERM into a flag, so that whole frames can be finished; a second
/// one ends the program at once. A file over a size limit or a closed pipe becomes an ordinary
/// write error. The process has one set of signals, so this is the one global of the program.
void watch_for_interrupt();
bool interrupted();

}  // namespace petrichor::cli

#endif
