// petrichor texture compare: how far two pictures or two normal maps are apart.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <iostream>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/error.h"
#include "cli/exit.h"
#include "cli/texture/cmd_texture.h"
#include "cli/texture/maps/files.h"
#include "texproc/filter/normal.h"
#include "texproc/material/pack.h"
#include "texproc/study/compare/inspect.h"
#include "texproc/study/compare/metrics.h"

namespace petrichor::cli {

namespace {

using texproc::RawImage;

struct Arguments {
    std::string a, b, out, kind = "auto";
    bool psnr_only = false;
    double ppd = 67.0206, fail_flip = -1.0, fail_psnr = -1.0;
    bool json = false;
    int threads = 0;
    texproc::ReadOptions reading;
};

// Numbers as they are stored; floats are taken as linear light and encoded, so that FLIP and PSNR
// of an EXR speak of what is seen.
Image codes_of(const RawImage& raw, const std::string& name)
{
    const bool floats = raw.type == texproc::PixelType::F16 || raw.type == texproc::PixelType::F32;
    Image image = texproc::to_image(raw, ColorSpace::Data);
    if (floats) {
        std::size_t beyond = 0;
        for (float& v : image.pixels) {
            beyond += v < 0.0f || v > 1.0f;
            v = texproc::linear_to_srgb(std::clamp(v, 0.0f, 1.0f));
        }
        // Two pictures that are brighter than that everywhere would be equal.
        if (beyond > 0) {
            std::cerr << "note: " << name << ": " << beyond << " of " << image.pixels.size()
                      << " numbers lie beyond 0..1 and are compared as 0 or 1\n";
        }
    }
    return image;
}

Image rgb_of(const Image& image)
{
    Image out(image.width, image.height, 3, image.space);
    const std::size_t step = static_cast<std::size_t>(image.channels);
    for (std::size_t i = 0; i < out.pixels.size() / 3; ++i) {
        for (std::size_t c = 0; c < 3; ++c)
            out.pixels[3 * i + c] = image.pixels[i * step + (step >= 3 ? c : 0)];
    }
    return out;
}

// Four channels whose last says nothing: opaque everywhere, but for the few codes that lossy blocks
// are off by.
bool has_idle_alpha(const RawImage& image)
{
    constexpr float kOpaque = 250.0f / 255.0f;
    if (image.channels != 4) return false;
    const Image alpha = texproc::to_image(texproc::channel_of(image, 3), ColorSpace::Data);
    return std::all_of(alpha.pixels.begin(), alpha.pixels.end(),
                       [](float a) { return a >= kOpaque; });
}

// Texture files have no three channels: opaque alpha beside none is no difference.
void drop_idle_alpha(RawImage& image, const RawImage& other)
{
    if (other.channels != 3 || !has_idle_alpha(image)) return;
    RawImage rgb = image;
    rgb.channels = 3;
    rgb.channel_names.clear();
    const std::size_t texel = 4 * size_of(image.type), kept = 3 * size_of(image.type);
    rgb.bytes.resize(image.bytes.size() / texel * kept);
    for (std::size_t i = 0; i * texel < image.bytes.size(); ++i) {
        std::copy_n(image.bytes.begin() + static_cast<std::ptrdiff_t>(i * texel), kept,
                    rgb.bytes.begin() + static_cast<std::ptrdiff_t>(i * kept));
    }
    image = std::move(rgb);
}

bool looks_normal(const RawImage& image)
{
    return image.channels >= 3 && texproc::inspect(image).meaning == texproc::Meaning::Normal;
}

// BC5 keeps x and y of a normal map: beside one with three channels, z is what a shader makes of
// them.
void rebuild_z(RawImage& image, const RawImage& other, const std::string& kind)
{
    const bool normal = kind == "normal" || (kind == "auto" && looks_normal(other));
    if (image.channels != 2 || other.channels != 3 || !normal) return;
    image = texproc::to_raw(
        texproc::from_layout(texproc::to_image(image, ColorSpace::Data), texproc::NormalLayout::Rg),
        texproc::PixelType::U16);
}

std::string number(double value)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.4f", value);
    return std::isinf(value) ? "equal" : text;
}

std::string decibels(double value)
{
    return number(value) + (std::isinf(value) ? "" : " dB");
}

[[noreturn]] void refuse_difference(const Arguments& a)
{
    throw Error("texture compare: " + a.a + " and " + a.b + " differ by more than was allowed",
                "Look at the numbers above, or loosen --fail-flip or --fail-psnr.");
}

void run(const Arguments& a)
{
    RawImage raw_a = read_map(a.a, a.reading), raw_b = read_map(a.b, a.reading);
    drop_idle_alpha(raw_a, raw_b);
    drop_idle_alpha(raw_b, raw_a);
    rebuild_z(raw_a, raw_b, a.kind);
    rebuild_z(raw_b, raw_a, a.kind);
    if (raw_a.width != raw_b.width || raw_a.height != raw_b.height ||
        raw_a.channels != raw_b.channels) {
        const auto shape = [](const std::string& name, const RawImage& i) {
            return name + " is " + std::to_string(i.width) + " x " + std::to_string(i.height) +
                   " with " + std::to_string(i.channels) + " channels";
        };
        throw Error("texture compare: " + shape(a.a, raw_a) + ", " + shape(a.b, raw_b),
                    "Compare images of one size; FILE:r compares one channel.");
    }
    const bool normals = a.kind == "normal" || (a.kind == "auto" && looks_normal(raw_a));
    const Image ia = normals ? texproc::to_image(raw_a, ColorSpace::Data) : codes_of(raw_a, a.a);
    const Image ib = normals ? texproc::to_image(raw_b, ColorSpace::Data) : codes_of(raw_b, a.b);
    const std::vector<double> db = texproc::psnr(ia, ib);
    const auto psnr_json =
        std::isinf(db.back()) ? nlohmann::ordered_json() : nlohmann::ordered_json(db.back());
    if (a.psnr_only) {
        a.json
            ? std::printf("%s\n", nlohmann::ordered_json{{"psnr_db", psnr_json}}
                                      .dump(1, ' ', false, nlohmann::json::error_handler_t::replace)
                                      .c_str())
            : std::printf("psnr     %s\n", decibels(db.back()).c_str());
        if (a.fail_psnr >= 0.0 && db.back() < a.fail_psnr) refuse_difference(a);
        return;
    }
    const double similarity = texproc::ssim(ia, ib, a.threads),
                 largest = texproc::largest_difference(ia, ib);
    nlohmann::ordered_json json{{"kind", normals ? "normal" : "color"},
                                {"width", ia.width},
                                {"height", ia.height},
                                {"channels", ia.channels},
                                {"psnr_db", psnr_json},
                                {"ssim", similarity},
                                {"largest", largest}};
    Image picture;
    double mean_flip = 0.0;
    if (!a.json) {
        std::printf("%s, %d x %d, %d channels\n", normals ? "normal maps" : "pictures", ia.width,
                    ia.height, ia.channels);
        std::printf("psnr     %s", decibels(db.back()).c_str());
        for (std::size_t c = 0; db.size() > 2 && c + 1 < db.size(); ++c)
            std::printf("%s%s", c ? ", " : "   by channel ", number(db[c]).c_str());
        std::printf("\nssim     %.5f\nlargest  %.5f\n", similarity, largest);
    }
    if (normals) {
        texproc::AngularError angle = texproc::angular_error(rgb_of(ia), rgb_of(ib));
        json["angle_degrees"] = {
            {"mean", angle.mean_degrees}, {"p95", angle.p95_degrees}, {"max", angle.max_degrees}};
        if (!a.json)
            std::printf("angle    mean %.3f, p95 %.3f, max %.3f degrees\n", angle.mean_degrees,
                        angle.p95_degrees, angle.max_degrees);
        picture = std::move(angle.degrees);
        for (float& v : picture.pixels) v /= 20.0f;  // light yellow at 20 degrees
    } else {
        texproc::Flip flip = texproc::flip(rgb_of(ia), rgb_of(ib), a.ppd, a.threads);
        mean_flip = flip.mean;
        json["flip"] = {{"mean", flip.mean},
                        {"p95", flip.p95},
                        {"max", flip.max},
                        {"pixels_per_degree", a.ppd}};
        if (!a.json)
            std::printf("flip     mean %.5f, p95 %.4f, max %.4f\n", flip.mean, flip.p95, flip.max);
        picture = std::move(flip.error);
    }
    if (a.json)
        std::printf("%s\n",
                    json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
    if (!a.out.empty()) texproc::write_image(a.out, texproc::error_colors(picture));
    const bool worse = (a.fail_flip >= 0.0 && mean_flip > a.fail_flip) ||
                       (a.fail_psnr >= 0.0 && db.back() < a.fail_psnr);
    if (worse) refuse_difference(a);
}

}  // namespace

void add_texture_compare(CLI::App& texture)
{
    auto a = std::make_shared<Arguments>();
    CLI::App* app = texture.add_subcommand("compare", "PSNR, SSIM, FLIP, angles between normals");
    app->add_option("reference", a->a, "FILE or FILE:g (one channel)")->required();
    app->add_option("test", a->b, "the other one, of the same size")->required();
    auto* out =
        app->add_option("-o,--out", a->out,
                        "picture of the difference: FLIP, or angle (light yellow at 20 degrees)");
    app->add_option("--kind", a->kind, "auto, color or normal")
        ->check(CLI::IsMember({"auto", "color", "normal"}))
        ->capture_default_str();
    app->add_option("--ppd", a->ppd, "FLIP: pixels a degree of the eye; 67 is a monitor on a desk")
        ->capture_default_str();
    auto* fail_flip =
        app->add_option("--fail-flip", a->fail_flip, "exit 2 when the mean FLIP is above this");
    app->add_option("--fail-psnr", a->fail_psnr, "exit 2 when the PSNR in dB is below this");
    app->add_flag("--psnr-only", a->psnr_only, "no SSIM, no FLIP: quick on large images")
        ->excludes(out)
        ->excludes(fail_flip);
    app->add_flag("--json", a->json, "for machines");
    app->add_option("--threads", a->threads, "0: all cores; the numbers do not depend on it");
    app->add_option("--max-pixels", a->reading.max_pixels, "refuse larger inputs")
        ->capture_default_str();
    app->footer("Example:\n  petrichor texture compare wall.png wall_bc7.dds -o difference.png");
    app->callback([a] { run(*a); });
}

}  // namespace petrichor::cli
