#include "cli/texture/sparkle_film.h"

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "base/error.h"
#include "cli/texture/contact_sheet.h"
#include "film/frames/film.h"
#include "texproc/codecs/files/io.h"
#include "texproc/prefilter/picture.h"

namespace petrichor::cli {
namespace {

constexpr int kScale = 2, kGap = 10, kTop = 64, kCaption = 24;
constexpr double kFps = 24.0;

texproc::PictureOptions moving_pictures(int frames, int all_frames, int threads)
{
    texproc::PictureOptions o = texproc::reference_pictures();
    o.frames = frames;
    o.samples = 10;
    o.threads = threads;
    // One repeat of the material in the whole film.
    for (texproc::PictureView& view : o.views) {
        view.step_right_m = 0.0;
        view.step_ahead_m = 1.0 / all_frames;
    }
    return o;
}

Image larger(const Image& small)
{
    Image large(small.width * kScale, small.height * kScale, 1, ColorSpace::Data);
    for (int y = 0; y < large.height; ++y) {
        for (int x = 0; x < large.width; ++x) large.at(x, y, 0) = small.at(x / kScale, y / kScale, 0);
    }
    return large;
}

std::string change(const char* what, double now, double before)
{
    char text[64];
    std::snprintf(text, sizeof text, "%s %+.0f %%", what, before > 0.0 ? 100.0 * (now / before - 1.0) : 0.0);
    return text;
}

std::string in_codes(const texproc::PictureScore& score)
{
    char text[96];
    std::snprintf(text, sizeof text, "plain mips: RMSE %.1f of 255, flicker %.1f", 255.0 * score.rmse,
                  255.0 * score.flicker);
    return text;
}

struct Chains {
    texproc::PictureBench bench;
    texproc::Prefiltered plain, filtered;
    std::vector<texproc::PictureScore> plain_scores, scores;
};

Chains make_chains(const SparkleSheet& sheet, int frames, const std::function<void(double)>& progress)
{
    texproc::PrefilterOptions options;
    options.rule = sheet.rule;
    options.quick = sheet.quick;
    options.design_light = sheet.light;
    options.threads = sheet.threads;
    options.progress = [&](double share) { progress(0.5 * share); };
    Chains chains{texproc::PictureBench(texproc::to_raw(sheet.normal, texproc::PixelType::F32),
                                        texproc::to_raw(sheet.roughness, texproc::PixelType::F32), {},
                                        moving_pictures(frames, sheet.frames, sheet.threads)),
                  {}, texproc::prefilter(sheet.normal, sheet.roughness, options), {}, {}};
    chains.plain.roughness = chains.bench.plain_roughness();
    chains.plain_scores = chains.bench.score(chains.plain);
    chains.scores = chains.bench.score(chains.filtered);
    return chains;
}

Pixels draw_frame(const SparkleSheet& sheet, const Chains& chains, int frame)
{
    const texproc::PictureOptions& options = chains.bench.options();
    const int width = options.views[0].width * kScale, rows = options.views[0].rows * kScale;
    const int cases = static_cast<int>(options.cases.size());
    ContactSheet out(4 * kGap + 3 * width, kTop + cases * (rows + kCaption + kGap));
    out.text(kGap, 26, sheet.title, 20.0, true);
    out.text(kGap, 48,
             "A floor, repeated every metre, under a camera that moves; trilinear with 16 taps along the view.", 13.0,
             false, Anchor::Start, "#4a5057");
    for (int c = 0; c < cases; ++c) {
        const auto which = static_cast<std::size_t>(c);
        const int y = kTop + c * (rows + kCaption + kGap);
        const texproc::PictureScore& plain = chains.plain_scores[which];
        const texproc::PictureScore& ours = chains.scores[which];
        const std::string captions[] = {in_codes(plain),
                                        sheet.rule + ": " + change("RMSE", ours.rmse, plain.rmse) + ", " +
                                            change("flicker", ours.flicker, plain.flicker),
                                        "the truth: " + ours.name};
        const texproc::Prefiltered* made[] = {&chains.plain, &chains.filtered, nullptr};
        for (int k = 0; k < 3; ++k) {
            const int x = kGap + k * (width + kGap);
            out.place(larger(chains.bench.picture(which, frame, made[k])), x, y);
            out.text(x, y + rows + 17, captions[k], 13.0, false, Anchor::Start, "#4a5057");
        }
    }
    return out.pixels();
}

}  // namespace

void write_sparkle_film(const SparkleSheet& sheet, const std::filesystem::path& film,
                        const std::function<void(double)>& progress, const StopRequest& stop)
{
    const bool moves = film.extension() == ".mp4";
    if (!moves && film.extension() != ".png") {
        throw Error("texture inspect: --film " + film.string() + " is neither .mp4 nor .png",
                    "Name a film, wall.mp4, or a strip of its first frame, wall.png.");
    }
    if (moves && film::find_ffmpeg().empty()) {
        throw Error("texture inspect: --film " + film.string() + " needs ffmpeg, which is not installed",
                    "apt-get install ffmpeg, or name a .png for a strip of the first frame.");
    }
    const Chains chains = make_chains(sheet, moves ? sheet.frames : 5, progress);
    if (!moves) {
        const Pixels strip = draw_frame(sheet, chains, 0);
        texproc::write_png8(film, strip.width, strip.height, 3, strip.rgb);
        return;
    }
    film::make_film(
        [&](int f) {
            const Pixels picture = draw_frame(sheet, chains, f);
            const auto bytes = texproc::encode_png8(picture.width, picture.height, 3, picture.rgb);
            progress(0.5 + 0.5 * static_cast<double>(f + 1) / sheet.frames);
            return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        },
        sheet.frames, kFps, film, stop);
}

}  // namespace petrichor::cli
