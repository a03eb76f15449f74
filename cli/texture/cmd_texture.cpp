// petrichor texture: everything that turns maps into better maps.
#include "cli/texture/cmd_texture.h"

#include <CLI/CLI.hpp>

#include "cli/commands.h"

namespace petrichor::cli {

void add_texture(CLI::App& app)
{
    CLI::App* texture = app.add_subcommand("texture", "prepare textures: build, prefilter, pack, ...");
    texture->require_subcommand(1);
    add_texture_build(*texture);
    add_texture_prefilter(*texture);
    add_texture_pack(*texture);
    add_texture_convert(*texture);
    add_texture_score(*texture);
    add_texture_maps(*texture);
    add_texture_compare(*texture);
    add_texture_inspect(*texture);
    add_texture_generate(*texture);
}

}  // namespace petrichor::cli
