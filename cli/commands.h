#ifndef PETRICHOR_CLI_COMMANDS_H
#define PETRICHOR_CLI_COMMANDS_H

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace petrichor::cli {

// One function a command, in cmd_NAME.cpp: declares its options on `app` and sets a callback that
// does the work. A callback throws petrichor::Error for what the user can mend.
void add_bench(CLI::App& app);
void add_doctor(CLI::App& app);
void add_headers(CLI::App& app);
void add_init(CLI::App& app);
/// words: the command line as typed, for the message that says how to go on after Ctrl-C.
void add_render(CLI::App& app, std::vector<std::string> words);
void add_scene(CLI::App& app);
void add_simulate(CLI::App& app);
void add_texture(CLI::App& app);

}  // namespace petrichor::cli

#endif
