#ifndef PETRICHOR_TEXPROC_STUDY_PROTOCOL_H
#define PETRICHOR_TEXPROC_STUDY_PROTOCOL_H

#include <functional>
#include <string>
#include <vector>

#include "texproc/study/score.h"
#include "texproc/study/scored_maps.h"

namespace petrichor::texproc {

// How good a rule is, over several materials (docs/textures.md, 6): fine and
// coarse levels apart, several rolls of each map, under the sun and under a window.

/// A rule as it ships.
struct Variant {
    std::string name;
    PrefilterOptions options;  ///< without the design light, which is that of the score
    int bits = 16;             ///< of the files: 8 or 16
};

/// Every rule, and "overlap" in all its outputs. bits: of the files.
std::vector<Variant> protocol_variants(int bits);

struct ProtocolOptions {
    int seeds = 3;  ///< each rolls the maps and draws other texels and points
    int texels = 64;
    int points = 1024;
    std::vector<float> lights{0.0f, 0.1f};
    /// 8: level 0 is rounded before anything looks at it, as the file holds it that an engine reads.
    int bits = 16;
    int threads = 0;
    /// Also rows for the best elliptic lobes (ScoreOptions::best_ellipse): "best ellipse, found" on
    /// other points, and "best ellipse, bound".
    bool best_ellipse = false;
    /// Also rows for the best lobes that files of these bits can hold (ScoreOptions::best_codes): "best codes"
    /// of normals as long as rules write them, and "best codes of any length".
    bool best_codes = false;
    std::function<void(const std::string&)> progress{};  ///< what is being scored
};
/// One seed, 24 texels, 512 points.
ProtocolOptions quick_protocol();

/// The score of one variant on one material under one light, mean over the seeds.
struct ProtocolRow {
    std::string material, variant;
    float light = 0.0f;
    Score score;
};

/// Scores all variants on the same texels and points. Only the texels that are scored are fitted.
std::vector<ProtocolRow> run_protocol(const std::vector<ScoredMaps>& materials,
                                      const std::vector<Variant>& variants,
                                      const ProtocolOptions& options = {});

/// One variant over all materials: of the gap in percent the worst, the mean and the pooled one
/// (sum of gains / sum of rooms) over the materials with room; the worst excess over the best lobe
/// of all materials and of those without room; how many levels are above plain by more than 0.005.
struct ProtocolSummary {
    std::string variant;
    float light = 0.0f;
    bool fine = true;
    int with_room = 0;
    double worst_gap = 0.0, mean_gap = 0.0, pooled_gap = 0.0;
    double worst_excess = -2.0, worst_excess_without_room = -2.0;
    double worst_over_plain = -2.0;
    int levels_over_plain = 0;
    std::string worst_material;
};
std::vector<ProtocolSummary> summarize(const std::vector<ProtocolRow>& rows);

/// The summaries as a Markdown table.
std::string to_markdown(const std::vector<ProtocolSummary>& summaries);
/// One row a material and range, one column a variant: the gap, or in brackets the excess.
std::string to_markdown_by_material(const std::vector<ProtocolRow>& rows);
/// Every level of every row.
std::string to_csv(const std::vector<ProtocolRow>& rows);

}  // namespace petrichor::texproc

#endif
