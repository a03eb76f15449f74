#ifndef PETRICHOR_CLI_TEXTURE_SCORE_PROTOCOL_H
#define PETRICHOR_CLI_TEXTURE_SCORE_PROTOCOL_H

#include <cstdint>
#include <string>
#include <vector>

#include "texproc/codecs/files/io.h"

namespace petrichor::cli {

/// `score --protocol`: every rule on several materials.
struct ProtocolRequest {
    std::string effort;              ///< full or quick; empty: not asked for
    std::vector<std::string> sets;   ///< roughness maps or folders
    std::vector<std::string> rules;  ///< names of variants to keep; empty: all
    int bits = 16;
    int seeds = 0;                     ///< rolls of every map; 0: as the effort says
    bool hard = true;                  ///< with the materials made from code
    bool puddles = true;               ///< each set with a height map also after rain
    bool patchwork = false;            ///< each set also in patches with the next one
    std::vector<std::uint32_t> fresh;  ///< seeds of sets of materials that no rule was chosen on
    std::vector<std::string> only;     ///< materials whose names hold one of these; empty: all
    bool best_ellipse = false;         ///< rows for the best elliptic lobes there are
    std::string csv;                   ///< every level of every row
};

/// Reads the sets, scores, prints the table on stdout and what is being done on stderr.
void run_score_protocol(const ProtocolRequest& request, const texproc::ReadOptions& reading,
                        int threads);

}  // namespace petrichor::cli

#endif
