#ifndef PETRICHOR_CLI_TEXTURE_SCORE_PROTOCOL_H
#define PETRICHOR_CLI_TEXTURE_SCORE_PROTOCOL_H

#include <cstdint>
#include <string>
#include <vector>

#include "texproc/codecs/files/io.h"
#include "texproc/study/protocol.h"

namespace petrichor::cli {

/// `score --protocol` and `score --picture`: every rule on several materials.
struct ProtocolRequest {
    std::string effort;              ///< full or quick; empty: not asked for
    std::string pictures;            ///< the same, or drawn, for lit pictures
    int drawn_seed = 1;              ///< --picture drawn: of its views and lights
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
    bool best_codes = false;           ///< rows for the best lobes that files of these bits can hold
    std::string csv;                   ///< every level or case of every row
    int lobes = 1;                     ///< --picture: of a texel, by the rule picture in full
    std::string sheet;                 ///< --picture: a PNG of plain mips, the rules and the truth
};

/// The materials that a request names. Throws Error when there are none.
std::vector<texproc::ScoredMaps> requested_materials(const ProtocolRequest& request,
                                                     const texproc::ReadOptions& reading);
/// The rules that a request names.
std::vector<texproc::Variant> requested_variants(const ProtocolRequest& request);

/// Reads the sets, scores, prints the table on stdout and what is being done on stderr.
void run_score_protocol(const ProtocolRequest& request, const texproc::ReadOptions& reading,
                        int threads);

}  // namespace petrichor::cli

#endif
