// The program: reads the command line, runs one command, turns exceptions into exit codes
// (0 done, 2 the user can mend it, 70 our fault, 130 interrupted).
#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>

#include "base/error.h"
#include "cli/commands.h"

int main(int argc, char** argv)
{
    CLI::App app{"Weather for physically based surfaces."};
    app.require_subcommand(1);
    petrichor::cli::add_texture(app);
    try {
        app.parse(argc, argv);
        return 0;
    } catch (const CLI::Success& done) {  // --help
        return app.exit(done);
    } catch (const CLI::ParseError& wrong) {
        app.exit(wrong);
        return 2;
    } catch (const petrichor::Error& error) {
        std::cerr << "error " << error.what() << "\n  " << error.fix() << "\n";
        return 2;
    } catch (const std::exception& error) {
        std::cerr << "internal error: " << error.what() << "\n";
        return 70;
    }
}
