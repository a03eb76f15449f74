#include "cli/texture/sparkle_sheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "base/error.h"
#include "cli/texture/contact_sheet.h"
#include "texproc/codecs/files/io.h"
#include "texproc/filter/mips.h"
#include "texproc/prefilter/prefilter.h"
#include "texproc/study/compare/shading.h"

namespace petrichor::cli {

namespace {

constexpr int kBall = 190, kGap = 12, kLeft = 150, kTop = 84, kFloorHeight = 250;

std::string percent(double share)
{
    return std::to_string(std::lround(100.0 * share)) + " % of the light misplaced";
}

// One exposure for the whole sheet: the brightest two percent of the references reach white.
float exposure_for(const Image& reference)
{
    std::vector<float> light;
    for (std::size_t i = 1; i < reference.pixels.size(); i += 3) {
        if (reference.pixels[i] > 0.0f) light.push_back(reference.pixels[i]);
    }
    if (light.empty()) return 1.0f;
    const auto at = light.begin() + static_cast<std::ptrdiff_t>(light.size() * 98 / 100);
    std::nth_element(light.begin(), at, light.end());
    return *at > 0.0f ? 0.9f / *at : 1.0f;
}

void expose(Image& image, float exposure)
{
    for (float& v : image.pixels) v *= exposure;
}

// Paper where there is no ball.
void clear_outside(Image& ball)
{
    const float radius2 = 0.25f * static_cast<float>(ball.width * ball.width) * 0.98f;
    for (int y = 0; y < ball.height; ++y) {
        for (int x = 0; x < ball.width; ++x) {
            const float dx = static_cast<float>(x) + 0.5f - 0.5f * static_cast<float>(ball.width);
            const float dy = static_cast<float>(y) + 0.5f - 0.5f * static_cast<float>(ball.width);
            for (int c = 0; c < 3 && dx * dx + dy * dy > radius2; ++c) ball.at(x, y, c) = 1.0f;
        }
    }
}

struct Row {
    const char* name;
    const char* note;
    const texproc::ShadedMaps* maps;
    bool reference;
};

}  // namespace

void write_sparkle_sheet(const SparkleSheet& sheet, const std::filesystem::path& path)
{
    texproc::PrefilterOptions options;
    options.rule = sheet.rule;
    options.quick = sheet.quick;
    options.design_light = sheet.light;
    options.threads = sheet.threads;
    const texproc::Prefiltered chains = texproc::prefilter(sheet.normal, sheet.roughness, options);
    texproc::ShadedMaps plain, filtered;
    filtered.normal = chains.normal;
    filtered.roughness = chains.roughness;
    filtered.normal[0] = sheet.normal;
    filtered.roughness[0] = sheet.roughness;
    if (!sheet.albedo.empty()) filtered.albedo = texproc::mip_chain(sheet.albedo);
    plain.albedo = filtered.albedo;
    plain.normal = texproc::mip_chain(sheet.normal, {.normals = true});
    plain.roughness = texproc::mip_chain(sheet.roughness);

    const Row rows[] = {{"plain mips", "what engines make", &plain, false},
                        {"prefiltered", sheet.rule.c_str(), &filtered, false},
                        {"the truth", "mean of all texels", &filtered, true}};
    std::vector<int> levels;
    for (int k = 0; k + 1 < static_cast<int>(plain.normal.size()) && levels.size() < 6; ++k) {
        if (k != 1) levels.push_back(k);  // 0, 2, 3, 4, 5, 6
    }
    const int columns = static_cast<int>(levels.size());
    const int width = kLeft + columns * (kBall + kGap) + kGap;
    const int floor_top = kTop + 3 * (kBall + 26) + 40, floor_width = width - kLeft - kGap;
    const int height = floor_top + 3 * (kFloorHeight + 26) + 10;
    ContactSheet out(width, height);
    out.text(kGap, 30, sheet.title, 20.0, true);
    out.text(kGap, 52,
             std::to_string(sheet.normal.width) + " x " + std::to_string(sheet.normal.height) +
                 ", " + (sheet.light > 0.0f ? "a wide light" : "the sun") +
                 ". Balls: one pixel shows one texel of the level. Light speckles where there are "
                 "none below: sparkle.",
             13.0, false, Anchor::Start, "#4a5057");
    texproc::ShadingOptions shading;
    shading.light = sheet.light;
    shading.samples = 256;
    shading.threads = sheet.threads;
    const auto x_of = [&](int column) { return kLeft + column * (kBall + kGap); };

    std::vector<Image> truths;
    for (const int level : levels)
        truths.push_back(texproc::shaded_ball(plain, level, kBall, true, shading));
    const float exposure = exposure_for(truths[std::min<std::size_t>(2, truths.size() - 1)]);
    for (int c = 0; c < columns; ++c) {
        const int level = levels[static_cast<std::size_t>(c)];
        out.text(x_of(c) + kBall / 2, kTop - 8,
                 level == 0 ? "level 0, near"
                            : "level " + std::to_string(level) + ", " + std::to_string(1 << level) +
                                  " x as far",
                 13.0, true, Anchor::Middle);
    }
    for (int r = 0; r < 3; ++r) {
        const Row& row = rows[r];
        const int y = kTop + r * (kBall + 26);
        out.text(kGap, y + kBall / 2 - 6, row.name, 15.0, true);
        out.text(kGap, y + kBall / 2 + 14, row.note, 12.0, false, Anchor::Start, "#4a5057");
        for (int c = 0; c < columns; ++c) {
            const std::size_t at = static_cast<std::size_t>(c);
            Image ball = row.reference
                             ? truths[at]
                             : texproc::shaded_ball(*row.maps, levels[at], kBall, false, shading);
            if (!row.reference) {
                out.text(x_of(c) + kBall / 2, y + kBall + 15,
                         percent(texproc::light_error(ball, truths[at])), 12.0, false,
                         Anchor::Middle, "#4a5057");
            }
            expose(ball, exposure);
            clear_outside(ball);
            out.place(ball, x_of(c), y);
        }
    }

    shading.samples = 128;
    const Image floor_truth =
        texproc::shaded_floor(plain, floor_width, kFloorHeight, true, shading);
    const float floor_exposure = exposure_for(floor_truth);
    out.text(kLeft, floor_top - 12,
             "A floor against low light, trilinear with 16 taps along the view:", 13.0, true);
    for (int r = 0; r < 3; ++r) {
        const Row& row = rows[r];
        const int y = floor_top + r * (kFloorHeight + 26);
        Image floor = row.reference ? floor_truth
                                    : texproc::shaded_floor(*row.maps, floor_width, kFloorHeight,
                                                            false, shading);
        out.text(kGap, y + kFloorHeight / 2 - 6, row.name, 15.0, true);
        out.text(kGap, y + kFloorHeight / 2 + 14, row.note, 12.0, false, Anchor::Start, "#4a5057");
        if (!row.reference) {
            out.text(kLeft, y + kFloorHeight + 15,
                     percent(texproc::light_error(floor, floor_truth)), 12.0, false, Anchor::Start,
                     "#4a5057");
        }
        expose(floor, floor_exposure);
        out.place(floor, kLeft, y);
    }
    const Pixels pixels = out.pixels();
    texproc::write_png8(path, pixels.width, pixels.height, 3, pixels.rgb);
}

}  // namespace petrichor::cli
