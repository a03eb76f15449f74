#include "texproc/study/score.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "base/error.h"
#include "base/parallel.h"
#include "texproc/filter/area.h"
#include "texproc/prefilter/detail/cells.h"
#include "texproc/prefilter/detail/input.h"
#include "texproc/study/detail/codes_oracle.h"
#include "texproc/study/detail/elliptic_oracle.h"
#include "texproc/study/detail/yardstick.h"

namespace petrichor::texproc {

namespace {

using namespace detail;

constexpr int kMostCells = 6000;

// The lobe that a chain holds at a texel, with the light added.
EllipticLobe stored_lobe(const Prefiltered& chain, std::size_t k, int x, int y,
                         const Direction& mean, const PrefilterOptions& input, float light2)
{
    Direction n = mean;
    if (k < chain.normal.size() && !chain.normal[k].empty()) {
        const float* c = &chain.normal[k].pixels[chain.normal[k].index(x, y, 0)];
        n = {2.0f * c[0] - 1.0f, 2.0f * c[1] - 1.0f, 2.0f * c[2] - 1.0f};
        if (input.green_down) n.y = -n.y;
        n = normalized(n);
    }
    float p = std::clamp(chain.roughness[k].at(x, y, 0), 0.0f, 1.0f);
    if (input.smoothness) p = 1.0f - p;
    if (input.alpha) p = std::sqrt(p);
    float across = p * p;
    EllipticLobe lobe = round_lobe(n, 0.0f);
    float along = across;
    if (k < chain.anisotropy.size() && !chain.anisotropy[k].empty()) {
        const float* a = &chain.anisotropy[k].pixels[chain.anisotropy[k].index(x, y, 0)];
        along = across + a[2] * a[2] * (1.0f - across);
        Direction t{2.0f * a[0] - 1.0f, 2.0f * a[1] - 1.0f, 0.0f};
        if (input.green_down) t.y = -t.y;
        const float lean = dot(t, n);
        t = normalized({t.x - lean * n.x, t.y - lean * n.y, t.z - lean * n.z});
        lobe.tx = t.x, lobe.ty = t.y, lobe.tz = t.z;
        lobe.bx = n.y * t.z - n.z * t.y;
        lobe.by = n.z * t.x - n.x * t.z;
        lobe.bz = n.x * t.y - n.y * t.x;
    }
    lobe.alpha2_x = std::clamp(along * along + light2, kMinAlpha2, 1.0f);
    lobe.alpha2_y = std::clamp(across * across + light2, kMinAlpha2, 1.0f);
    return lobe;
}

struct TexelErrors {
    double plain = 0.0, best = 0.0, reached = 0.0, ellipse = 0.0;
    CodeErrors codes;
    std::vector<Measure> tested;
};

// The best ellipse on the points of the score, and the one that is best on twice as many others.
void add_ellipses(const Cells& cells, const Direction& mean, const std::vector<float>& widths,
                  int points, Random& random, Samples& samples, TexelErrors& errors)
{
    const auto narrowest = static_cast<double>(std::sqrt(widths.front()));
    const std::array<double, kViews> mass = reference_mass(samples);
    const auto error_of = [&](const EllipticLobe& lobe) {
        return measure(samples, mass, lobe).error;
    };
    Samples others;
    place_points(cells, mean, widths, 2 * points, random, others);
    errors.reached =
        error_of(best_elliptic(others, reference_mass(others), cells, mean, narrowest));
    errors.ellipse = std::min({error_of(best_elliptic(samples, mass, cells, mean, narrowest)),
                               errors.best, errors.plain});
    for (const Measure& m : errors.tested) errors.ellipse = std::min(errors.ellipse, m.error);
}

TexelErrors texel_errors(const MapSurface& surface, const Footprint& columns, const Footprint& rows,
                         std::size_t level, int x, int y, const std::vector<Prefiltered>& chains,
                         const PrefilterOptions& input, const ScoreOptions& options)
{
    std::vector<SurfaceRow> fetched(1);
    Cells cells;
    // Row by row, merged on the way: the footprint of the last level is the whole map.
    Cells part;
    Means means, m;
    const Footprint one_row{0, {1.0f}};
    for (std::size_t j = 0; j < rows.weights.size(); ++j) {
        fetch(surface, rows.first + static_cast<int>(j), fetched[0]);
        gather(fetched, 0, columns, one_row, part, m);
        const float w = rows.weights[j];
        means.nx += w * m.nx;
        means.ny += w * m.ny;
        means.nz += w * m.nz;
        means.p += w * m.p;
        for (std::size_t i = 0; i < part.nx.size(); ++i) {
            cells.add(part.nx[i], part.ny[i], part.nz[i], part.alpha2[i], w * part.weight[i]);
        }
        if (cells.count() > 4 * kMostCells) merge(cells, 2 * kMostCells, 2 * kMostCells);
    }
    merge(cells, kMostCells, kMostCells);
    const float light2 = options.light * options.light;
    for (float& a2 : cells.alpha2) a2 = std::clamp(a2 + light2, kMinAlpha2, 1.0f);
    const Direction mean = normalized({means.nx, means.ny, means.nz});
    const float plain2 =
        std::clamp((means.p * means.p) * (means.p * means.p) + light2, kMinAlpha2, 1.0f);

    float narrow2 = plain2, wide2 = plain2;
    std::vector<EllipticLobe> lobes;
    for (const Prefiltered& chain : chains) {
        lobes.push_back(stored_lobe(chain, level, x, y, mean, input, light2));
        narrow2 = std::min({narrow2, lobes.back().alpha2_x, lobes.back().alpha2_y});
        wide2 = std::max({wide2, lobes.back().alpha2_x, lobes.back().alpha2_y});
    }
    for (const float a2 : cells.alpha2) narrow2 = std::min(narrow2, a2);
    Random random{(static_cast<std::uint64_t>(options.seed) << 40) ^ (level << 34) ^
                  (static_cast<std::uint64_t>(y) << 17) ^ static_cast<std::uint64_t>(x)};
    Samples samples;
    const std::vector<float> widths = widths_between(narrow2, wide2);
    place_points(cells, mean, widths, options.points, random, samples);
    const std::array<double, kViews> mass = reference_mass(samples);
    TexelErrors errors;
    errors.plain = measure(samples, mass, round_lobe(mean, plain2)).error;
    errors.best =
        best_error(samples, mass, mean, errors.plain, static_cast<double>(std::sqrt(narrow2)));
    for (const EllipticLobe& lobe : lobes) errors.tested.push_back(measure(samples, mass, lobe));
    if (options.best_ellipse)
        add_ellipses(cells, mean, widths, options.points, random, samples, errors);
    if (options.best_codes > 0) {
        lobes.push_back(round_lobe(mean, plain2));
        errors.codes = best_codes(samples, mass, lobes, static_cast<double>(std::sqrt(narrow2)), light2,
                                  {.bits = options.best_codes,
                                   .smoothness = input.smoothness,
                                   .alpha = input.alpha,
                                   .green_down = input.green_down});
    }
    return errors;
}

RangeScore over(const std::vector<LevelScore>& levels, int first, int last)
{
    RangeScore r;
    r.worst_over_plain = -2.0;
    for (const LevelScore& l : levels) {
        if (l.level < first || l.level > last) continue;
        r.plain += l.plain;
        r.best += l.best;
        r.tested += l.tested;
        r.worst_over_plain = std::max(r.worst_over_plain, l.tested - l.plain);
        ++r.levels;
    }
    if (r.levels) {
        r.plain /= r.levels;
        r.best /= r.levels;
        r.tested /= r.levels;
    }
    return r;
}

}  // namespace

RangeScore Score::fine() const
{
    return over(levels, 1, 5);
}
RangeScore Score::coarse() const
{
    return over(levels, 6, 99);
}

std::vector<std::int64_t> score_texels(LevelSize size, int level, const ScoreOptions& options)
{
    const std::int64_t all = static_cast<std::int64_t>(size.width) * size.height;
    const std::int64_t count = std::min<std::int64_t>(all, options.texels);
    Random random{options.seed * 7919ull + static_cast<std::uint64_t>(level)};
    std::vector<std::int64_t> chosen;
    for (std::int64_t i = 0; i < count; ++i) {
        const double at = (static_cast<double>(i) + random()) / static_cast<double>(count);
        chosen.push_back(
            std::min(all - 1, static_cast<std::int64_t>(at * static_cast<double>(all))));
    }
    return chosen;
}

std::vector<Score> score_all(const RawImage& normal, const RawImage& roughness,
                             const std::vector<Prefiltered>& chains, const PrefilterOptions& input,
                             const ScoreOptions& options)
{
    if (options.texels < 1 || options.points < 8 || options.points > 65536) {
        throw Error("score: texels must be at least 1 and points in 8..65536",
                    "Use the defaults: 32 texels, 512 points.");
    }
    const MapSurface surface = make_surface(ref(normal), ref(roughness), input);
    const std::vector<LevelSize> sizes = level_sizes(surface.width, surface.height);
    for (const Prefiltered& chain : chains) {
        for (std::size_t k = 1; k < chain.roughness.size(); ++k) {
            const Image& r = chain.roughness[k];
            if (r.empty()) continue;
            if (k >= sizes.size() || r.width != sizes[k].width || r.height != sizes[k].height) {
                throw Error(
                    "score: level " + std::to_string(k) + " is " + std::to_string(r.width) + " x " +
                        std::to_string(r.height) + ", which is not a mip level of " +
                        std::to_string(surface.width) + " x " + std::to_string(surface.height),
                    "Name the levels by number, 0 the largest: each is half of the one before.");
            }
        }
    }
    std::vector<Score> scores(chains.size());
    for (std::size_t k = 1; k < sizes.size() && static_cast<int>(k) <= options.max_level; ++k) {
        if (std::any_of(chains.begin(), chains.end(), [&](const Prefiltered& c) {
                return k >= c.roughness.size() || c.roughness[k].empty();
            })) {
            continue;
        }
        const int width = sizes[k].width, height = sizes[k].height;
        const std::vector<Footprint> columns = footprints(surface.width, width);
        const std::vector<Footprint> rows = footprints(surface.height, height);
        const std::vector<std::int64_t> chosen =
            score_texels(sizes[k], static_cast<int>(k), options);
        std::vector<TexelErrors> errors(chosen.size());
        parallel_for(chosen.size(), options.threads, [&](std::size_t i) {
            const int x = static_cast<int>(chosen[i] % width),
                      y = static_cast<int>(chosen[i] / width);
            errors[i] =
                texel_errors(surface, columns[static_cast<std::size_t>(x)],
                             rows[static_cast<std::size_t>(y)], k, x, y, chains, input, options);
        });
        for (std::size_t c = 0; c < chains.size(); ++c) {
            LevelScore level;
            level.level = static_cast<int>(k);
            double square = 0.0;
            const double n = static_cast<double>(errors.size());
            for (const TexelErrors& e : errors) {
                level.plain += e.plain / n;
                level.best += e.best / n;
                level.reached += e.reached / n;
                level.ellipse += e.ellipse / n;
                level.codes += e.codes.any / n;
                level.long_codes += e.codes.kept / n;
                level.tested += e.tested[c].error / n;
                level.energy += e.tested[c].energy / n;
                const double d = e.tested[c].error - e.best;
                square += d * d / n;
            }
            const double mean = level.tested - level.best;
            level.spread = std::sqrt(std::max(0.0, square - mean * mean) / n);
            scores[c].levels.push_back(level);
        }
    }
    return scores;
}

Score score(const RawImage& normal, const RawImage& roughness, const Prefiltered& chain,
            const PrefilterOptions& input, const ScoreOptions& options)
{
    return score_all(normal, roughness, {chain}, input, options).front();
}

void quantize(Prefiltered& chain, int bits)
{
    const float top = bits == 8 ? 255.0f : 65535.0f;
    for (Image& image : chain.normal) {
        if (bits == 8 && !image.empty())
            image = to_image(to_raw(image, PixelType::U8, Rounding::Ordered), ColorSpace::Data);
    }
    for (auto* images : {&chain.normal, &chain.roughness, &chain.anisotropy, &chain.second.normal,
                         &chain.second.roughness, &chain.second.share}) {
        for (Image& image : *images) {
            for (float& v : image.pixels) {
                v = std::floor(std::clamp(v, 0.0f, 1.0f) * top + 0.5f) / top;
            }
        }
    }
}

std::string to_text(const Score& s)
{
    const bool ellipse = !s.levels.empty() && s.levels.front().ellipse > 0.0;
    std::string text = "level   plain    best    this     gap  energy";
    text += ellipse ? "   best ellipse: found, bound\n" : "\n";
    char line[160];
    const auto gap = [](double plain, double best, double tested) {
        char t[32];
        if (plain - best < kSmallestRoom) {
            std::snprintf(t, sizeof t, "(%+.3f)", tested - best);
        } else {
            std::snprintf(t, sizeof t, "%.0f %%", 100.0 * (plain - tested) / (plain - best));
        }
        return std::string(t);
    };
    for (const LevelScore& l : s.levels) {
        std::snprintf(line, sizeof line, "%5d  %6.3f  %6.3f  %6.3f  %8s  %+.3f", l.level, l.plain,
                      l.best, l.tested, gap(l.plain, l.best, l.tested).c_str(), l.energy);
        text += line;
        if (ellipse) {
            std::snprintf(line, sizeof line, "   %8s  %8s", gap(l.plain, l.best, l.reached).c_str(),
                          gap(l.plain, l.best, l.ellipse).c_str());
            text += line;
        }
        text += "\n";
    }
    const std::pair<const char*, RangeScore> ranges[] = {{"1-5", s.fine()}, {"6+", s.coarse()}};
    for (const auto& [name, r] : ranges) {
        if (!r.levels) continue;
        std::snprintf(line, sizeof line, "%5s  %6.3f  %6.3f  %6.3f  %8s  over plain %+.3f\n", name,
                      r.plain, r.best, r.tested, gap(r.plain, r.best, r.tested).c_str(),
                      r.worst_over_plain);
        text += line;
    }
    return text;
}

}  // namespace petrichor::texproc
