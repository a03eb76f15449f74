#ifndef PETRICHOR_CLI_TEXTURE_SCORE_PICTURE_H
#define PETRICHOR_CLI_TEXTURE_SCORE_PICTURE_H

#include "cli/texture/score_protocol.h"

namespace petrichor::cli {

/// Renders every material under every rule, lit and moving, and prints on stdout how far the
/// pictures are from the truth, against plain mips (texproc/prefilter/picture.h). Says on stderr
/// what is being done.
void run_score_picture(const ProtocolRequest& request, const texproc::ReadOptions& reading,
                       int threads);

}  // namespace petrichor::cli

#endif
