// petrichor texture: everything that turns maps into better maps.
#include "cli/texture/cmd_texture.h"

#include <CLI/CLI.hpp>
#include <csignal>

#include "cli/commands.h"

namespace petrichor::cli {

void add_texture(CLI::App& app)
{
    CLI::App* texture = app.add_subcommand(
        "texture", "Prepare textures: build, prefilter, pack, mips, compare, ...");
    texture->require_subcommand(1);
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
}

}  // namespace petrichor::cli
