// The program: reads the command line, runs one command, turns exceptions into exit codes
// (0 done, 2 the user can mend it, 70 our fault, 130 interrupted).
#include <poll.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <iostream>
#include <streambuf>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/words.h"
#include "cli/commands.h"
#include "cli/exit.h"
#include "cli/signals.h"

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

// Messages name things that files bring along. A terminal would obey control characters in them, so
// they are shown instead; line breaks, and what progress lines use, pass.
class ShownControls : public std::streambuf {
public:
    explicit ShownControls(std::streambuf* to) : to_(to) {}

protected:
    std::streamsize xsputn(const char* text, std::streamsize count) override
    {
        std::string_view rest(text, static_cast<std::size_t>(count));
        while (!rest.empty()) {
            const std::size_t stop = std::min(rest.find_first_of("\n\r\t\x1b"), rest.size());
            if (!put(printable(rest.substr(0, stop)))) return 0;
            rest.remove_prefix(stop);
            if (rest.empty()) break;
            const bool erase_line = rest.substr(0, 3) == "\x1b[K";
            const std::size_t length = erase_line ? 3 : 1;
            const std::string_view own = rest.substr(0, length);
            if (!put(own[0] == '\x1b' && !erase_line ? printable(own) : std::string(own))) return 0;
            rest.remove_prefix(length);
        }
        return count;
    }
    int_type overflow(int_type c) override
    {
        if (traits_type::eq_int_type(c, traits_type::eof())) return traits_type::not_eof(c);
        const char one = traits_type::to_char_type(c);
        // One character of several bytes arrives byte by byte here.
        const bool plain = static_cast<unsigned char>(one) >= 0x80;
        return plain ? to_->sputc(one) : xsputn(&one, 1) == 1 ? c : traits_type::eof();
    }
    int sync() override { return to_->pubsync(); }

private:
    bool put(const std::string& text)
    {
        const auto size = static_cast<std::streamsize>(text.size());
        return to_->sputn(text.data(), size) == size;
    }
    std::streambuf* to_;
};

// Of the command that was called, for those of its words that begin as an option does and are none:
// "; no option \"--sampels\". Did you mean \"--samples\"?"; else "".
std::string meant_options(const CLI::App& app)
{
    const CLI::App* command = &app;
    while (!command->get_subcommands().empty()) command = command->get_subcommands().front();
    std::vector<std::string> options;
    for (const CLI::Option* option : command->get_options()) {
        for (const std::string& name : option->get_lnames()) options.push_back("--" + name);
    }
    std::string said;
    for (const std::string& word : command->remaining()) {
        if (word.rfind("--", 0) != 0) continue;
        const std::string name = word.substr(0, word.find('='));
        const std::string meant = did_you_mean(name, options);
        if (!meant.empty()) said.append("; no option \"").append(name).append("\".").append(meant);
    }
    return said;
}

// What was printed has arrived, or the program did not do what it was asked to. Whoever closed the
// pipe (head, less) knows that already and needs no message.
int with_output_checked(int code)
{
    std::cout.flush();
    errno = 0;
    const bool failed = std::fflush(stdout) != 0 || std::ferror(stdout) || !std::cout;
    int why = errno;
    pollfd pipe{STDOUT_FILENO, 0, 0};
    const bool nobody_reads =
        why == EPIPE || (::poll(&pipe, 1, 0) > 0 && (pipe.revents & POLLERR) != 0);
    bool closed_badly = false;
    if (!failed) {
        // close() is where network disks say that they are full. EBADF: there was no stdout at all.
        closed_badly = ::close(STDOUT_FILENO) != 0 && errno != EBADF && errno != EINTR;
        if (closed_badly) why = errno;
    }
    if (!failed && !closed_badly) return code;
    if (nobody_reads) return code == cli::kExitDone ? cli::kExitPipe : code;
    std::cerr << "error petrichor: what belongs on standard output could not be written"
              << (why != 0 ? std::string(": ") + std::strerror(why) : std::string())
              << "\n  Free the disk that it goes to, or send it elsewhere.\n";
    return cli::kExitUser;
}

int run(int argc, char** argv)
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
    cli::add_headers(app);
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
        std::cerr << "error petrichor: " << wrong.what() << meant_options(app)
                  << "\n  Run with --help to see what is accepted.\n";
        return cli::kExitUser;
    } catch (const cli::ExitCode& exit) {
        return exit.code;
    } catch (const petrichor::Interrupted& stop) {
        cli::set_last_words([] { return std::string(); });  // said here
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

}  // namespace

int main(int argc, char** argv)
{
    static auto* const messages = new ShownControls(std::cerr.rdbuf());  // used while it ends
    std::cerr.rdbuf(messages);
    cli::watch_for_interrupt();
    const int code = with_output_checked(run(argc, argv));
    std::cerr.flush();
    return code;
}
