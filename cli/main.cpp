// The program: reads the command line, runs one command, turns exceptions into exit codes
// (0 done, 2 the user can mend it, 70 our fault, 130 interrupted).
#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/words.h"
#include "cli/commands.h"
#include "cli/exit.h"

namespace {

using namespace petrichor;

// A first word that is no command is a slip of the finger: say which one was meant.
void check_command(const CLI::App& app, const std::string& word)
{
    if (word.empty() || word[0] == '-') return;
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
        if (command->get_name() == word) return;
        names.push_back(command->get_name());
    }
    throw Error("petrichor: no command \"" + word + "\"." + petrichor::did_you_mean(word, names),
                "Use one of: " + petrichor::join_words(names) + ".");
}

}  // namespace

int main(int argc, char** argv)
{
    CLI::App app{"Weather for physically based surfaces.", "petrichor"};
    app.require_subcommand(1);
    app.set_version_flag("--version", "petrichor " PETRICHOR_VERSION);
    app.footer(
        "Try: petrichor render            the demo street, into petrichor-demo/\n"
        "     petrichor COMMAND --help    options and an example");
    cli::add_render(app, std::vector<std::string>(argv, argv + argc));
    cli::add_bench(app);
    cli::add_doctor(app);
    cli::add_init(app);
    cli::add_scene(app);
    cli::add_simulate(app);
    cli::add_texture(app);
    try {
        if (argc > 1) check_command(app, argv[1]);
        app.parse(argc, argv);
        return cli::kExitDone;
    } catch (const CLI::Success& done) {  // --help, --version
        return app.exit(done);
    } catch (const CLI::ParseError& wrong) {
        std::cerr << "error petrichor: " << wrong.what()
                  << "\n  Run with --help to see what is accepted.\n";
        return cli::kExitUser;
    } catch (const cli::ExitCode& exit) {
        return exit.code;
    } catch (const petrichor::Interrupted& stop) {
        std::cerr << stop.what() << "\n";
        return cli::kExitInterrupted;
    } catch (const Error& error) {
        std::cerr << "error " << error.what() << "\n  " << error.fix() << "\n";
        return cli::kExitUser;
    } catch (const std::exception& error) {
        std::cerr << "internal error: " << error.what()
                  << "\n  This is a fault of petrichor; please report the command and this line.\n";
        return cli::kExitOurs;
    }
}
