#ifndef PETRICHOR_CLI_SIGNALS_H
#define PETRICHOR_CLI_SIGNALS_H

#include <string>

namespace petrichor::cli {

/// Turns Ctrl-C (SIGINT) and SIGTERM into a flag that long work asks for, so that whole frames can
/// be finished. What has not ended 0.4 s later (a driver that compiles, a frame that is half done,
/// a parser) is ended as it is: temporary files are removed, child programs die with this one, exit
/// code 130. A second signal ends the program at once. A file over a size limit or a closed pipe
/// becomes an ordinary write error. The process has one set of signals, so this is the one global
/// of the program.
void watch_for_interrupt();
bool interrupted();

/// What to say when the program is ended as above: how to go on.
void set_way_to_go_on(std::string text);

}  // namespace petrichor::cli

#endif
