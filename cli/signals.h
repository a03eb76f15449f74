#ifndef PETRICHOR_CLI_SIGNALS_H
#define PETRICHOR_CLI_SIGNALS_H

#include <functional>
#include <string>

namespace petrichor::cli {

/// Turns Ctrl-C (SIGINT) and SIGTERM into a flag that long work asks for, so that whole frames can
/// be finished. What has not ended 0.25 s later (a driver that compiles, a frame that is half done,
/// a parser) is ended as it is: temporary files are removed, child programs die with this one, exit
/// code 130. A second signal ends the program at once. A file over a size limit or a closed pipe
/// becomes an ordinary write error. The process has one set of signals, so this is the one global
/// of the program.
void watch_for_interrupt();
bool interrupted();

/// What is said when the program is ended as above; asked in another thread, at that moment.
void set_last_words(std::function<std::string()> words);

}  // namespace petrichor::cli

#endif
