#ifndef PETRICHOR_CLI_TEXTURE_CMD_TEXTURE_H
#define PETRICHOR_CLI_TEXTURE_CMD_TEXTURE_H

namespace CLI {
class App;
}

namespace petrichor::cli {

// One function for each subcommand of `petrichor texture`.
void add_texture_build(CLI::App& texture);
void add_texture_compare(CLI::App& texture);
void add_texture_generate(CLI::App& texture);
void add_texture_inspect(CLI::App& texture);
void add_texture_prefilter(CLI::App& texture);
void add_texture_pack(CLI::App& texture);
void add_texture_convert(CLI::App& texture);
void add_texture_score(CLI::App& texture);
void add_texture_workflow(CLI::App& texture);
void add_texture_maps(CLI::App& texture);  // mips, normal, bake, unpack

}  // namespace petrichor::cli

#endif
