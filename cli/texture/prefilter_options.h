#ifndef PETRICHOR_CLI_TEXTURE_PREFILTER_OPTIONS_H
#define PETRICHOR_CLI_TEXTURE_PREFILTER_OPTIONS_H

#include <filesystem>
#include <string>

#include "cli/texture/maps/files.h"
#include "texproc/prefilter/prefilter.h"

namespace CLI {
class App;
}

namespace petrichor::cli {

/// The maps that `prefilter` and `score` read, and how.
struct PrefilterInput {
    std::string normal, roughness, smoothness, layout = "rgb";
    texproc::PrefilterOptions options;
    texproc::ReadOptions reading;
};

void add_prefilter_input(CLI::App& app, PrefilterInput& input);

struct PrefilterMaps {
    texproc::RawImage normal, map;
    std::filesystem::path map_path;
};
/// Reads both maps at once and completes input.options (channel, smoothness, green). Finds the
/// normal map by name where none was given.
PrefilterMaps read_prefilter_maps(PrefilterInput& input);

}  // namespace petrichor::cli

#endif
