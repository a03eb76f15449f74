#include "texproc/prefilter/rules.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace petrichor::texproc {

const std::vector<Rule>& rules()
{
    static const std::vector<Rule> all{
        {"picture", RuleKind::Picture,
         "looks most like its footprint, diffuse and specular, lit and shown (default)"},
        {"overlap", RuleKind::Search, "the lobe of largest overlap; re-aims normals"},
        {"student-t", RuleKind::Cells, "maximum likelihood fit of the lobe; re-aims normals"},
        {"median", RuleKind::Cells, "the radius that holds half of the footprint's half-vectors"},
        {"lean", RuleKind::Cells, "slope variance about the mean normal"},
        {"vmf", RuleKind::Moments, "von Mises-Fisher, each texel shortened by its own lobe"},
        {"toksvig", RuleKind::Moments, "length of the mean normal, as a Blinn-Phong power"},
        {"moments", RuleKind::Moments, "alpha^2 + 2 / kappa from mean alpha^2"},
        {"unreal", RuleKind::Moments, "as Unreal Engine bakes it"},
        {"godot", RuleKind::Moments, "as Godot's roughness limiter"},
        {"filament", RuleKind::Moments, "as Filament's roughness-prefilter, main"},
        {"filament-1.9", RuleKind::Moments, "as Filament 1.9.25"},
        {"lux", RuleKind::Moments, "Lux 2.02, code for code (square powers of two)"},
        {"lux-formula", RuleKind::Moments, "the formula of Lux on exact footprints of any size"},
        {"none", RuleKind::Moments, "plain mips"},
    };
    return all;
}

const Rule& rule_named(const std::string& name)
{
    std::string known;
    for (const Rule& rule : rules()) {
        if (rule.name == name) return rule;
        known += (known.empty() ? "" : ", ") + rule.name;
    }
    throw Error("prefilter: there is no rule '" + name + "'", "Use one of: " + known + ".");
}

float inverse_kappa(float length)
{
    const float r = std::clamp(length, 1e-4f, 1.0f);
    return std::max(0.0f, (1.0f - r * r) / (3.0f * r - r * r * r));
}

float rule_roughness(const std::string& rule, float p, float alpha2, float length, float lobe)
{
    const float v = inverse_kappa(length);
    const auto stored = [](float value) { return std::clamp(value, 0.0f, 1.0f); };
    const auto from_alpha2 = [&](float a2) {
        return stored(std::sqrt(std::sqrt(std::max(0.0f, a2))));
    };
    if (rule == "moments") return from_alpha2(alpha2 + 2.0f * v);
    if (rule == "lux-formula") return stored(std::sqrt(p * p + v));
    if (rule == "filament") return stored(std::sqrt(p * p + 2.0f * v));
    if (rule == "filament-1.9") return stored(std::sqrt(p * p + 0.5f * v));
    if (rule == "godot") return stored(std::sqrt(p * p + std::min(0.75f * v, 0.16f)));
    if (rule == "vmf") {
        const float r = std::clamp(lobe, 1e-4f, 1.0f);
        return from_alpha2(2.0f * (1.0f - r * r) / (3.0f * r - r * r * r));
    }
    const float a2 = std::max((p * p) * (p * p), 1e-6f);
    const float r = std::clamp(length, 1e-4f, 1.0f);
    if (rule == "toksvig") {
        const float power = 2.0f / a2 - 2.0f;
        const float shrunk = power > 0.0f ? 1.0f / (1.0f / power + (1.0f - r) / r) : 0.0f;
        return from_alpha2(2.0f / (shrunk + 2.0f));
    }
    if (rule == "unreal") {
        // The engine multiplies the variance by its "composite power", 1 unless an artist sets it.
        const float variance = std::max(0.0f, (1.0f - r) / r - 4e-5f);
        const float b = 2.0f * variance * (a2 - 1.0f);
        return from_alpha2((b - a2) / (b - 1.0f));
    }
    return stored(p);
}

}  // namespace petrichor::texproc
