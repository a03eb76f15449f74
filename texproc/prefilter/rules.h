#ifndef PETRICHOR_TEXPROC_PREFILTER_RULES_H
#define PETRICHOR_TEXPROC_PREFILTER_RULES_H

#include <string>
#include <vector>

namespace petrichor::texproc {

/// How much of a footprint a rule looks at.
enum class RuleKind {
    Moments,  ///< means only: one value from a few numbers
    Cells,    ///< every texel of the footprint
    Search,   ///< a search for the best lobe
    Picture,  ///< a search for the most like picture
};

struct Rule {
    std::string name;
    RuleKind kind;
    std::string note;  ///< one line for --help
};

/// All rules: none, lux, lux-formula, moments, filament, filament-1.9, godot, unreal, toksvig, vmf,
/// lean, median, student-t, overlap, picture.
const std::vector<Rule>& rules();
/// Throws Error that lists the names.
const Rule& rule_named(const std::string& name);

/// Perceptual roughness of a mip texel by one of the rules of kind Moments (docs/textures.md, 2).
///
///   p        plain mean of the perceptual roughness of the footprint, 0..1
///   alpha2   mean of alpha^2 = p^4
///   length   of the mean normal, 0..1
///   lobe     length of the mean of the normals, each shortened by its own lobe (vmf only)
float rule_roughness(const std::string& rule, float p, float alpha2, float length, float lobe);

/// 1 / kappa of a mean normal of this length (Banerjee): (1 - r^2) / (3 r - r^3).
float inverse_kappa(float length);

}  // namespace petrichor::texproc

#endif
