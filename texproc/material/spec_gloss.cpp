#include "texproc/material/spec_gloss.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"

namespace petrichor::texproc {

namespace {

constexpr float kDielectric = 0.04f;  // reflectance at normal incidence
constexpr float kLeast = 1e-6f;

void check(const Image& color, const Image& other, int channels, const char* names)
{
    if (color.channels == 3 && other.channels == channels && color.width == other.width &&
        color.height == other.height)
        return;
    const auto text = [](const Image& image) {
        return std::to_string(image.width) + " x " + std::to_string(image.height) + " x " +
               std::to_string(image.channels);
    };
    throw Error(std::string("texture: ") + names + " do not go together: " + text(color) + " and " +
                    text(other) + " (three channels, and " + std::to_string(channels) + ")",
                "Bring them to one size: petrichor texture convert IN -o OUT --size WxH.");
}

float brightness(const float* rgb)
{
    return std::sqrt(0.299f * rgb[0] * rgb[0] + 0.587f * rgb[1] * rgb[1] +
                     0.114f * rgb[2] * rgb[2]);
}

float solve_metallic(float diffuse, float specular, float rest)
{
    if (specular < kDielectric) return 0.0f;
    const float a = kDielectric;
    const float b = diffuse * rest / (1.0f - kDielectric) + specular - 2.0f * kDielectric;
    const float c = kDielectric - specular;
    const float root = std::sqrt(std::max(b * b - 4.0f * a * c, 0.0f));
    return std::clamp((root - b) / (2.0f * a), 0.0f, 1.0f);
}

}  // namespace

MetallicColor to_metallic(const Image& diffuse, const Image& specular)
{
    check(diffuse, specular, 3, "diffuse and specular colour");
    MetallicColor to{Image(diffuse.width, diffuse.height, 3, diffuse.space),
                     Image(diffuse.width, diffuse.height, 1, ColorSpace::Data)};
    for (std::size_t i = 0; i < to.metallic.pixels.size(); ++i) {
        const float *d = &diffuse.pixels[3 * i], *s = &specular.pixels[3 * i];
        const float rest = 1.0f - std::max({s[0], s[1], s[2]});  // what is left to the diffuse
        const float metallic = solve_metallic(brightness(d), brightness(s), rest);
        to.metallic.pixels[i] = metallic;
        for (std::size_t c = 0; c < 3; ++c) {
            const float by_diffuse =
                d[c] * rest / (1.0f - kDielectric) / std::max(1.0f - metallic, kLeast);
            const float by_specular =
                (s[c] - kDielectric * (1.0f - metallic)) / std::max(metallic, kLeast);
            const float mix = metallic * metallic;
            to.base.pixels[3 * i + c] =
                std::clamp((1.0f - mix) * by_diffuse + mix * by_specular, 0.0f, 1.0f);
        }
    }
    return to;
}

SpecularColor to_specular(const Image& base, const Image& metallic)
{
    check(base, metallic, 1, "base colour and metallic");
    SpecularColor to{Image(base.width, base.height, 3, base.space),
                     Image(base.width, base.height, 3, base.space)};
    for (std::size_t i = 0; i < metallic.pixels.size(); ++i) {
        const float m = std::clamp(metallic.pixels[i], 0.0f, 1.0f);
        const float* b = &base.pixels[3 * i];
        float* s = &to.specular.pixels[3 * i];
        for (std::size_t c = 0; c < 3; ++c) s[c] = (1.0f - m) * kDielectric + m * b[c];
        const float rest = std::max(1.0f - std::max({s[0], s[1], s[2]}), kLeast);
        for (std::size_t c = 0; c < 3; ++c) {
            to.diffuse.pixels[3 * i + c] =
                std::clamp(b[c] * (1.0f - kDielectric) * (1.0f - m) / rest, 0.0f, 1.0f);
        }
    }
    return to;
}

}  // namespace petrichor::texproc
