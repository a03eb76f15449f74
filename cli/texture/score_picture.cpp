#include "cli/texture/score_picture.h"

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <iterator>
#include <span>

#include "cli/texture/contact_sheet.h"
#include "texproc/codecs/files/io.h"
#include "texproc/prefilter/picture.h"

namespace petrichor::cli {

namespace {

using texproc::PictureScore;

constexpr double kWorse = 0.02;  // so much more error than plain mips counts as worse

std::string percent(double share)
{
    char text[32];
    std::snprintf(text, sizeof text, "%+.1f %%", 100.0 * share);
    return text;
}

struct Mean {
    double rmse = 0.0, flicker = 0.0;
    int cases = 0;

    void add(double of_rmse, double of_flicker)
    {
        rmse += of_rmse, flicker += of_flicker;
        ++cases;
    }
    std::string text() const
    {
        if (!cases) return "-";
        return percent(rmse / cases) + ", " + percent(flicker / cases);
    }
};

struct Sums {
    Mean all, paint, metal;
    double worst = -1.0;
    int worse = 0;
    std::string worst_case;

    void add(const std::string& material, bool on_metal, const PictureScore& plain, const PictureScore& score)
    {
        if (!(plain.rmse > 0.0) || !(plain.flicker > 0.0)) return;  // nothing to win or lose
        const double change = score.rmse / plain.rmse - 1.0, livelier = score.flicker / plain.flicker - 1.0;
        all.add(change, livelier);
        (on_metal ? metal : paint).add(change, livelier);
        worse += change > kWorse;
        if (change <= worst) return;
        worst = change;
        worst_case = material + ", " + score.name;
    }
};

// Plain mips, the rules and the truth side by side, a row a case.
class Sheet {
public:
    Sheet(const texproc::PictureOptions& pictures, const std::vector<texproc::Variant>& variants,
          std::size_t materials)
        : pictures_(pictures),
          sheet_(static_cast<int>(variants.size() + 2) * (width() + kGap) + kGap,
                 static_cast<int>(materials * pictures.cases.size()) * (height() + kLine) + kGap)
    {
    }

    void add(const std::string& material, const texproc::PictureBench& bench,
             const std::vector<texproc::Variant>& variants,
             const std::vector<texproc::Prefiltered>& chains,
             const std::vector<texproc::Prefiltered>& metals)
    {
        const texproc::Prefiltered plain;
        for (std::size_t c = 0; c < pictures_.cases.size(); ++c) {
            const texproc::PictureCase& which = pictures_.cases[c];
            const std::string light = pictures_.lights[static_cast<std::size_t>(which.light)].name;
            int x = kGap;
            const auto place = [&](const std::string& words, const texproc::Prefiltered* chain) {
                sheet_.text(x, y_ + 32, words);
                sheet_.place(bench.picture(c, 0, chain), x, y_ + kLine - kGap);
                x += width() + kGap;
            };
            // A line of its own: it may be longer than a picture is wide.
            sheet_.text(kGap, y_ + 14, material + ", " + light + (which.metal ? ", metal" : ""));
            place("plain mips", &plain);
            for (std::size_t i = 0; i < variants.size(); ++i) 
                place(variants[i].name, which.metal ? &metals[i] : &chains[i]);
            place("truth", nullptr);
            y_ += height() + kLine;
        }
    }

    void write(const std::string& path) const
    {
        const Pixels pixels = sheet_.pixels();
        texproc::write_png8(path, pixels.width, pixels.height, 3, pixels.rgb);
    }

private:
    static constexpr int kGap = 8, kLine = 48;
    int width() const
    {
        int most = 0;
        for (const texproc::PictureView& view : pictures_.views) most = std::max(most, view.width);
        return most;
    }
    int height() const
    {
        int most = 0;
        for (const texproc::PictureView& view : pictures_.views) most = std::max(most, view.rows);
        return most;
    }

    const texproc::PictureOptions& pictures_;
    ContactSheet sheet_;
    int y_ = 0;
};

}  // namespace

void run_score_picture(const ProtocolRequest& request, const texproc::ReadOptions& reading,
                       int threads)
{
    std::vector<texproc::Variant> variants = requested_variants(request);
    std::erase_if(variants, [](const texproc::Variant& v) {
        return v.options.rule == "none" || v.options.rule == "lux" || v.options.anisotropic;
    });
    const std::vector<texproc::ScoredMaps> materials = requested_materials(request, reading);
    texproc::PictureOptions pictures =
        request.pictures == "quick"   ? texproc::reference_pictures()
        : request.pictures == "drawn" ? texproc::drawn_pictures(static_cast<std::uint32_t>(request.drawn_seed))
                                      : texproc::all_pictures();
    pictures.threads = threads;
    Sheet sheet(pictures, variants, request.sheet.empty() ? 0 : materials.size());
    std::vector<Sums> of_rule(variants.size());
    std::vector<std::vector<Sums>> of_material;
    std::string csv = "material,rule,case,rmse,flicker,plain_rmse,plain_flicker\n";
    for (const texproc::ScoredMaps& maps : materials) {
        std::cerr << "score: " << maps.name << "\n";
        const texproc::PictureBench bench(maps.normal, maps.roughness, {}, pictures);
        const std::vector<PictureScore> plain = bench.score({});
        std::vector<texproc::Prefiltered> chains, metals;
        std::vector<Sums>& row = of_material.emplace_back(variants.size());
        for (std::size_t i = 0; i < variants.size(); ++i) {
            texproc::PrefilterOptions options = variants[i].options;
            options.threads = threads;
            options.bits = variants[i].bits == 8 ? 8 : 0;
            const bool by_class = options.rule == "picture" && !options.quick;
            if (by_class) options.surface = texproc::SurfaceClass::Paint;
            if (by_class) options.lobes = request.lobes;
            texproc::Prefiltered chain =
                texproc::prefilter_raw(maps.normal, maps.roughness, options);
            texproc::quantize(chain, variants[i].bits);
            std::vector<PictureScore> scores = bench.score(chain);
            if (by_class) {  // of metal there are levels of their own
                options.surface = texproc::SurfaceClass::Metal;
                texproc::Prefiltered of_metal =
                    texproc::prefilter_raw(maps.normal, maps.roughness, options);
                texproc::quantize(of_metal, variants[i].bits);
                const std::vector<PictureScore> metal = bench.score(of_metal);
                for (std::size_t c = 0; c < scores.size(); ++c)
                    if (pictures.cases[c].metal) scores[c] = metal[c];
                if (!request.sheet.empty()) metals.push_back(std::move(of_metal));
            } else if (!request.sheet.empty()) {
                metals.push_back(chain);
            }
            for (std::size_t c = 0; c < scores.size(); ++c) {
                for (Sums* sums : {&of_rule[i], &row[i]})
                    sums->add(maps.name, pictures.cases[c].metal, plain[c], scores[c]);
                char numbers[96];
                std::snprintf(numbers, sizeof numbers, "%.6f,%.6f,%.6f,%.6f\n", scores[c].rmse,
                              scores[c].flicker, plain[c].rmse, plain[c].flicker);
                csv += "\"" + maps.name + "\"," + variants[i].name + ",\"" + scores[c].name +
                       "\"," + numbers;
            }
            if (!request.sheet.empty()) chains.push_back(std::move(chain));
        }
        if (!request.sheet.empty()) sheet.add(maps.name, bench, variants, chains, metals);
    }
    if (!request.csv.empty()) texproc::write_bytes(request.csv, std::as_bytes(std::span(csv)));
    if (!request.sheet.empty()) sheet.write(request.sheet);
    std::cout << materials.size() << " materials, " << pictures.cases.size()
              << " cases each, against plain mips (below 0 is better)\n\n"
              << "| rule | RMSE, flicker | of paint | of metal | worse by 2 % | worst |\n|---|---|---|---|---|---|\n";
    for (std::size_t i = 0; i < variants.size(); ++i) {
        const Sums& s = of_rule[i];
        std::cout << "| " << variants[i].name << " | " << s.all.text() << " | " << s.paint.text() << " | "
                  << s.metal.text() << " | " << s.worse << " of " << s.all.cases << " | " << percent(s.worst)
                  << " (" << s.worst_case << ") |\n";
    }
    std::cout << "\n| material |";
    std::string rule = "|---|";
    for (const texproc::Variant& v : variants) {
        std::cout << " " << v.name << " |";
        rule += "---|";
    }
    std::cout << "\n" << rule << "\n";
    for (std::size_t m = 0; m < materials.size(); ++m) {
        std::cout << "| " << materials[m].name << " |";
        for (const Sums& s : of_material[m]) std::cout << " " << s.all.text() << " |";
        std::cout << "\n";
    }
}

}  // namespace petrichor::cli
