#include "texproc/prefilter.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/error.h"
#include "texproc/area.h"
#include "texproc/lux.h"

namespace petrichor::texproc {

namespace {

std::string size_text(const Image& image)
{
    return std::to_string(image.width) + " x " + std::to_string(image.height);
}

void check(const Image& normal, const Image& roughness)
{
    if (normal.empty() || roughness.empty()) {
        throw Error("prefilter: an input is empty", "Pass a normal map and a roughness map.");
    }
    if (normal.width != roughness.width || normal.height != roughness.height) {
        throw Error("prefilter: the normal map is " + size_text(normal) + ", the roughness map " +
                        size_text(roughness),
                    "Resample one of them: both must have the same size.");
    }
    if (normal.channels < 3) {
        throw Error("prefilter: the normal map has " + std::to_string(normal.channels) +
                        " channels, 3 are needed",
                    "Rebuild z from x and y first (petrichor texture normal).");
    }
    if (roughness.channels != 1) {
        throw Error("prefilter: the roughness map has " + std::to_string(roughness.channels) +
                        " channels, 1 is needed",
                    "Choose the channel that holds it.");
    }
    const auto finite = [](float v) { return std::isfinite(v); };
    if (!std::all_of(normal.pixels.begin(), normal.pixels.end(), finite) ||
        !std::all_of(roughness.pixels.begin(), roughness.pixels.end(), finite)) {
        throw Error("prefilter: an input holds values that are not numbers",
                    "Repair the NaN or infinite pixels first.");
    }
}

// Level 0 as what filters linearly: unit normal, perceptual roughness, alpha squared.
Image moments_of(const Image& normal, const Image& roughness, bool smoothness)
{
    Image m(normal.width, normal.height, 5, ColorSpace::Data);
    const std::size_t step = static_cast<std::size_t>(normal.channels);
    for (std::size_t i = 0; i < roughness.pixels.size(); ++i) {
        const float* c = &normal.pixels[i * step];
        const float x = 2.0f * c[0] - 1.0f, y = 2.0f * c[1] - 1.0f, z = 2.0f * c[2] - 1.0f;
        const float length = std::sqrt(x * x + y * y + z * z);
        float* to = &m.pixels[i * 5];
        const bool fine = length > 1e-6f;
        to[0] = fine ? x / length : 0.0f;
        to[1] = fine ? y / length : 0.0f;
        to[2] = fine ? z / length : 1.0f;
        const float r = std::clamp(roughness.pixels[i], 0.0f, 1.0f);
        const float p = smoothness ? 1.0f - r : r;
        to[3] = p;
        to[4] = (p * p) * (p * p);
    }
    return m;
}

float rough_of(const std::string& rule, const float* m, float length)
{
    if (rule == "none") return m[3];
    const float l = std::clamp(length, 1e-4f, 1.0f - 1e-6f);
    const float v = length >= 1.0f - 1e-6f ? 0.0f : (1.0f - l * l) / (3.0f * l - l * l * l);
    if (rule == "lux-formula") return std::min(1.0f, std::sqrt(m[3] * m[3] + v));
    return std::sqrt(std::sqrt(std::min(1.0f, m[4] + 2.0f * v)));
}

std::uint8_t code(float v) { return static_cast<std::uint8_t>(std::clamp(v, 0.0f, 1.0f) * 255.0f + 0.5f); }

// The compatible rule works on 8-bit codes and knows smoothness only.
void lux_roughness(const Image& normal, const PrefilterOptions& options, Prefiltered& out)
{
    const int size = normal.width;
    if (normal.height != size) {
        throw Error("lux: the compatible rule needs square maps of a power of two, got " +
                        size_text(normal),
                    "Use the rule lux-formula (same formula, exact footprints) or moments.");
    }
    const std::size_t texels = normal.pixels.size() / static_cast<std::size_t>(normal.channels);
    std::vector<std::uint8_t> x(texels), y(texels);
    for (std::size_t i = 0; i < texels; ++i) {
        x[i] = code(normal.pixels[i * static_cast<std::size_t>(normal.channels)]);
        y[i] = code(normal.pixels[i * static_cast<std::size_t>(normal.channels) + 1]);
    }
    std::vector<std::vector<std::uint8_t>> mips;
    for (std::size_t k = 1; k < out.roughness.size(); ++k) {
        std::vector<std::uint8_t>& level = mips.emplace_back();
        for (const float r : out.roughness[k].pixels) {
            level.push_back(code(options.smoothness ? r : 1.0f - r));
        }
    }
    const auto filtered = lux_smoothness_mips(x, y, mips, size);
    for (std::size_t k = 1; k < out.roughness.size(); ++k) {
        for (std::size_t i = 0; i < filtered[k - 1].size(); ++i) {
            const float s = static_cast<float>(filtered[k - 1][i]) / 255.0f;
            out.roughness[k].pixels[i] = options.smoothness ? s : 1.0f - s;
        }
    }
}

}  // namespace

const std::vector<std::string>& prefilter_rules()
{
    static const std::vector<std::string> rules{"none", "moments", "lux", "lux-formula"};
    return rules;
}

Prefiltered prefilter(const Image& normal, const Image& roughness, const PrefilterOptions& options)
{
    const auto& rules = prefilter_rules();
    if (std::find(rules.begin(), rules.end(), options.rule) == rules.end()) {
        std::string known;
        for (const std::string& rule : rules) known += (known.empty() ? "" : ", ") + rule;
        throw Error("prefilter: there is no rule '" + options.rule + "'", "Use one of: " + known + ".");
    }
    check(normal, roughness);
    Image level0 = moments_of(normal, roughness, options.smoothness);
    const std::vector<Image> levels = area_levels(level0, options.threads);
    Prefiltered out;
    out.roughness.push_back(roughness);
    Image& top = out.normal.emplace_back(normal.width, normal.height, 3, ColorSpace::Data);
    for (std::size_t i = 0; i < roughness.pixels.size(); ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            top.pixels[3 * i + k] = 0.5f + 0.5f * level0.pixels[5 * i + k];
        }
    }
    level0 = Image();
    const std::string rule = options.rule == "lux" ? "none" : options.rule;
    for (const Image& level : levels) {
        Image& n = out.normal.emplace_back(level.width, level.height, 3, ColorSpace::Data);
        Image& r = out.roughness.emplace_back(level.width, level.height, 1, ColorSpace::Data);
        for (std::size_t i = 0; i < r.pixels.size(); ++i) {
            const float* m = &level.pixels[5 * i];
            const float length = std::sqrt(m[0] * m[0] + m[1] * m[1] + m[2] * m[2]);
            const bool fine = length > 1e-6f;
            for (std::size_t k = 0; k < 3; ++k) {
                const float unit = fine ? m[k] / length : (k == 2 ? 1.0f : 0.0f);
                n.pixels[3 * i + k] = 0.5f + 0.5f * unit;
            }
            const float p = rough_of(rule, m, length);
            r.pixels[i] = options.smoothness ? 1.0f - p : p;
        }
    }
    if (options.rule == "lux") lux_roughness(normal, options, out);
    return out;
}

}  // namespace petrichor::texproc
