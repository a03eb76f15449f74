#ifndef PETRICHOR_TEXPROC_STUDY_SCORE_H
#define PETRICHOR_TEXPROC_STUDY_SCORE_H

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "base/image.h"
#include "texproc/filter/area.h"
#include "texproc/image/raw_image.h"
#include "texproc/prefilter/prefilter.h"

namespace petrichor::texproc {

// The yardstick (docs/textures.md, 5): how far the light of one mip texel is from the mean
// light of the texels of level 0 under it, over five views, as the share of light that is misplaced
// (0..2).

/// Below this room a gap is a ratio of two noises.
inline constexpr double kSmallestRoom = 0.02;

struct ScoreOptions {
    float light = 0.0f;  ///< alpha that widens every lobe on both sides: 0 the sun, 0.1 a window
    int texels = 32;     ///< stratified mip texels a level
    int points = 512;    ///< half-vectors a texel
    std::uint32_t seed = 1;
    int threads = 0;
    int max_level = 99;
    /// Also the best elliptic lobe, searched all over: what no anisotropic output can beat. Slow.
    bool best_ellipse = false;
    /// Above 0: also the best lobe that files of so many bits can hold at all. Slow.
    int best_codes = 0;
};

/// Errors of one level, means over its texels.
struct LevelScore {
    int level = 0;
    double plain = 0.0;   ///< E of the plain mip
    double best = 0.0;    ///< E of the best isotropic lobe about the mean normal
    double tested = 0.0;  ///< E of the chain
    double energy = 0.0;  ///< light of the tested lobe / light of the reference, - 1
    double spread = 0.0;  ///< standard error of (tested - best) over the texels
    /// With best_ellipse. reached: E of the ellipse that is best on other points; ellipse: of the
    /// one that is best on the very points of the score, below which no lobe can come.
    double reached = 0.0, ellipse = 0.0;
    /// With best_codes: E of the best codes on the very points of the score, normals of any length, and as
    /// long as rules write them.
    double codes = 0.0, long_codes = 0.0;
};

/// Means over a range of levels, each level of equal weight.
struct RangeScore {
    double plain = 0.0, best = 0.0, tested = 0.0;
    double worst_over_plain = 0.0;  ///< largest tested - plain of a level
    int levels = 0;

    double room() const { return plain - best; }
    /// Share of the room closed, in percent; only where has_room() does it mean anything.
    double gap() const { return 100.0 * (plain - tested) / room(); }
    double excess() const { return tested - best; }
    bool has_room() const { return room() >= kSmallestRoom; }
};

struct Score {
    std::vector<LevelScore> levels;
    RangeScore fine() const;    ///< levels 1 to 5
    RangeScore coarse() const;  ///< levels 6 and up
};

/// Scores a chain against level 0. `input` says how to read level 0 and, with the same meaning, the
/// chain; levels of the chain that are empty are skipped. chain.normal may be empty: then the mean
/// normals are used. Throws Error when sizes do not fit.
Score score(const RawImage& normal, const RawImage& roughness, const Prefiltered& chain,
            const PrefilterOptions& input, const ScoreOptions& options = {});

/// Scores several chains on the same texels and points, which makes differences much tighter.
std::vector<Score> score_all(const RawImage& normal, const RawImage& roughness,
                             const std::vector<Prefiltered>& chains, const PrefilterOptions& input,
                             const ScoreOptions& options = {});

/// The texels of a level that a score looks at, as y * width + x: strata of equal texel counts in
/// row order, one at random in each.
std::vector<std::int64_t> score_texels(LevelSize size, int level, const ScoreOptions& options);

/// Rounds a chain as a file of 8 or 16 bits does.
void quantize(Prefiltered& chain, int bits);

/// One line a level and the two ranges, for people.
std::string to_text(const Score& score);

/// What the yardstick must measure of itself: names, values, bounds.
struct SelfCheck {
    std::string name;
    double value = 0.0, low = 0.0, high = 0.0;
    bool good() const { return value >= low && value <= high; }
};
std::vector<SelfCheck> score_self_test();

}  // namespace petrichor::texproc

#endif
