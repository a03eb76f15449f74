// petrichor texture: everything that turns maps into better maps.
#include "cli/texture/cmd_texture.h"

#include <CLI/CLI.hpp>
#include <csignal>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/words.h"
#include "cli/commands.h"

namespace petrichor::cli {

namespace {

// `petrichor texture prepare`: a word in the place of a command is named, with the one it may stand for.
void check_command(const CLI::App& texture)
{
    if (!texture.get_subcommands().empty()) return;
    std::vector<std::string> names;
    for (const CLI::App* command : texture.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(command->get_name());
    const std::vector<std::string> words = texture.remaining();
    const std::string fix = "Use one of: " + join_words(names) + ".";
    if (words.empty() || words.front().starts_with('-')) throw Error("petrichor texture: a command is missing", fix);
    throw Error("petrichor texture: no command \"" + words.front() + "\"." + did_you_mean(words.front(), names), fix);
}

}  // namespace

void add_texture(CLI::App& app)
{
    CLI::App* texture = app.add_subcommand(
        "texture", "Prepare textures: build, prefilter, pack, mips, compare, ...");
    // A file over a size limit is a write error like a full disk, with a message, not a sudden end.
    texture->preparse_callback([](std::size_t) { std::signal(SIGXFSZ, SIG_IGN); });
    add_texture_build(*texture);
    add_texture_prefilter(*texture);
    add_texture_pack(*texture);
    add_texture_convert(*texture);
    add_texture_workflow(*texture);
    add_texture_score(*texture);
    add_texture_maps(*texture);
    add_texture_compare(*texture);
    add_texture_inspect(*texture);
    add_texture_generate(*texture);
    texture->allow_extras();  // after the commands, which would take it over
    texture->callback([texture] { check_command(*texture); });
}

}  // namespace petrichor::cli
