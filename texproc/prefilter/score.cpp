#include "texproc/prefilter/score.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <mutex>

#include "base/error.h"
#include "texproc/area.h"
#include "texproc/prefilter/detail/cells.h"
#include "texproc/detail/input.h"
#include "texproc/prefilter/detail/lobe_tools.h"
#include "texproc/detail/parallel.h"

namespace petrichor::texproc {

namespace {

using namespace detail;

constexpr int kMostCells = 6000;
constexpr double kSmallestRoom = 0.02;

struct Random {
    std::uint64_t state;
    double operator()()
    {
        state += 0x9e3779b97f4a7c15ull;
        std::uint64_t z = state;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
        z ^= z >> 31;
        return static_cast<double>(z >> 11) / 9007199254740992.0;
    }
};

double halton(int index, int base)
{
    double value = 0.0, share = 1.0 / base;
    for (int i = index + 1; i > 0; i /= base, share /= base) value += share * (i % base);
    return value;
}

double ggx(double alpha2, const Direction& n, double hx, double hy, double hz)
{
    const double c = static_cast<double>(n.x) * hx + static_cast<double>(n.y) * hy +
                     static_cast<double>(n.z) * hz;
    if (c <= 0.0) return 0.0;
    const double sx = static_cast<double>(n.y) * hz - static_cast<double>(n.z) * hy;
    const double sy = static_cast<double>(n.z) * hx - static_cast<double>(n.x) * hz;
    const double sz = static_cast<double>(n.x) * hy - static_cast<double>(n.y) * hx;
    const double t = sx * sx + sy * sy + sz * sz + alpha2 * c * c;
    return c * alpha2 / (3.141592653589793 * t * t);
}

// Widths from the narrowest to the widest lobe that may be tested, at most a factor of 4 in alpha
// apart: between two that are further apart a lobe could hide where no point lies, and look half as
// bad as it is.
std::vector<float> widths_between(float narrow2, float wide2)
{
    const float ratio = std::sqrt(wide2 / narrow2);
    const int steps = std::max(1, static_cast<int>(std::ceil(std::log(ratio) / std::log(4.0f))));
    std::vector<float> widths;
    for (int i = 0; i <= steps; ++i) {
        widths.push_back(narrow2 *
                         std::pow(wide2 / narrow2, static_cast<float>(i) / static_cast<float>(steps)));
    }
    return widths;
}

// The points of one texel: half-vectors from the footprint (half) and from lobes about the mean
// normal of these widths, weighted by one over the density of the mixture.
void place_points(const Cells& cells, const Direction& mean, const std::vector<float>& widths,
                  int points, Random& random, Samples& samples)
{
    const int n = (points + kLanes - 1) / kLanes * kLanes;
    samples.resize(n);
    const SamplesView s = samples.view();
    const double shift[3] = {random(), random(), random()};
    std::vector<float> cumulated(cells.weight.size());
    float whole = 0.0f;
    for (std::size_t i = 0; i < cumulated.size(); ++i) cumulated[i] = whole += cells.weight[i];
    const auto moved = [&](int index, int base, int which) {
        const double v = halton(index, base) + shift[which];
        return v - std::floor(v);
    };
    for (int k = 0; k < n; ++k) {
        Direction normal = mean;
        float alpha2 = widths[static_cast<std::size_t>(k / 2) % widths.size()];
        // Each kind of point counts its own lattice: taking every other point of one sequence
        // would take one half of the square.
        int index = k / 2 / static_cast<int>(widths.size());
        if (k % 2 == 0) {
            index = k / 2;
            const float target = static_cast<float>(moved(index, 5, 2)) * whole;
            const auto found = std::upper_bound(cumulated.begin(), cumulated.end(), target);
            const std::size_t cell = std::min(cumulated.size() - 1,
                                              static_cast<std::size_t>(found - cumulated.begin()));
            normal = {cells.nx[cell], cells.ny[cell], cells.nz[cell]};
            alpha2 = cells.alpha2[cell];
        }
        const double u = std::min(0.999999, moved(index, 2, 0));
        const double phi = 6.283185307179586 * moved(index, 3, 1);
        const double tan2 = static_cast<double>(alpha2) * u / (1.0 - u);
        const float c = static_cast<float>(1.0 / std::sqrt(1.0 + tan2));
        const float r = static_cast<float>(std::sqrt(tan2)) * c;
        const float x = r * static_cast<float>(std::cos(phi));
        const float y = r * static_cast<float>(std::sin(phi));
        const Frame f = frame_about(normal);
        s.hx[k] = f.t.x * x + f.b.x * y + f.n.x * c;
        s.hy[k] = f.t.y * x + f.b.y * y + f.n.y * c;
        s.hz[k] = f.t.z * x + f.b.z * y + f.n.z * c;
    }
    for (int v = 0; v < kViews; ++v) {
        const float* view = kViewDirections[v];
        for (int k = 0; k < n; ++k) {
            const int at = v * n + k;
            s.hx[at] = s.hx[k];
            s.hy[at] = s.hy[k];
            s.hz[at] = s.hz[k];
            const float vh = view[0] * s.hx[k] + view[1] * s.hy[k] + view[2] * s.hz[k];
            s.lx[at] = 2.0f * vh * s.hx[k] - view[0];
            s.ly[at] = 2.0f * vh * s.hy[k] - view[1];
            s.lz[at] = 2.0f * vh * s.hz[k] - view[2];
            s.weight[at] = vh > 0.0f && s.lz[at] > 0.0f ? 4.0f * vh : 0.0f;
        }
    }
    lobe_kernel().shade(cells.view(), s);
    for (int at = 0; at < kViews * n; ++at) {
        const double hx = static_cast<double>(s.hx[at]), hy = static_cast<double>(s.hy[at]),
                     hz = static_cast<double>(s.hz[at]);
        double density = 0.5 * static_cast<double>(s.density[at]);
        for (const float width : widths) {
            density += 0.5 / static_cast<double>(widths.size()) *
                       ggx(static_cast<double>(width), mean, hx, hy, hz);
        }
        s.weight[at] = density > 0.0
                           ? static_cast<float>(static_cast<double>(s.weight[at]) / (density * n))
                           : 0.0f;
    }
}

EllipticLobe round_lobe(const Direction& n, float alpha2)
{
    const Frame f = frame_about(n);
    return {n.x, n.y, n.z, f.t.x, f.t.y, f.t.z, f.b.x, f.b.y, f.b.z, alpha2, alpha2};
}

struct Measure {
    double error = 0.0, energy = 0.0;
};

// Mean over the views of the misplaced light, and the light itself relative to the reference.
Measure measure(Samples& samples, const std::array<double, kViews>& mass, const EllipticLobe& lobe)
{
    float difference[kViews], energy[kViews];
    lobe_kernel().differences(samples.view(), lobe, difference, energy);
    Measure m;
    int views = 0;
    for (std::size_t v = 0; v < kViews; ++v) {
        if (!(mass[v] > 1e-6)) continue;
        m.error += std::min(2.0, static_cast<double>(difference[v]) / mass[v]);
        m.energy += static_cast<double>(energy[v]) / mass[v] - 1.0;
        ++views;
    }
    if (views) {
        m.error /= views;
        m.energy /= views;
    }
    return m;
}

// The best isotropic alpha about the mean normal: a scan in log alpha, then golden section.
double best_error(Samples& samples, const std::array<double, kViews>& mass, const Direction& mean,
                  double plain_error, double narrowest)
{
    const auto error = [&](double log_alpha) {
        const double a = std::exp(log_alpha);
        return measure(samples, mass, round_lobe(mean, static_cast<float>(a * a))).error;
    };
    const double low = std::log(std::max(1e-3, 0.7 * narrowest)), high = 0.0;
    constexpr int kSteps = 24;
    double best = 3.0, at = low;
    for (int i = 0; i <= kSteps; ++i) {
        const double x = low + (high - low) * i / kSteps;
        const double e = error(x);
        if (e < best) best = e, at = x;
    }
    double a = at - (high - low) / kSteps, b = std::min(high, at + (high - low) / kSteps);
    const double ratio = 0.6180339887498949;
    double c = b - ratio * (b - a), d = a + ratio * (b - a);
    double ec = error(c), ed = error(d);
    for (int i = 0; i < 14; ++i) {
        if (ec < ed) {
            b = d, d = c, ed = ec;
            c = b - ratio * (b - a);
            ec = error(c);
        } else {
            a = c, c = d, ec = ed;
            d = a + ratio * (b - a);
            ed = error(d);
        }
    }
    return std::min({best, ec, ed, plain_error});
}

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
    double plain = 0.0, best = 0.0;
    std::vector<Measure> tested;
};

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
        if (cells.count() > 4 * kMostCells) merge(cells, 2 * kMostCells);
    }
    merge(cells, kMostCells);
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
    place_points(cells, mean, widths_between(narrow2, wide2), options.points, random, samples);
    const SamplesView s = samples.view();
    std::array<double, kViews> mass{};
    for (int v = 0; v < kViews; ++v) {
        for (int k = v * s.per_view; k < (v + 1) * s.per_view; ++k) {
            mass[static_cast<std::size_t>(v)] +=
                static_cast<double>(s.weight[k]) * static_cast<double>(s.radiance[k]);
        }
    }
    TexelErrors errors;
    errors.plain = measure(samples, mass, round_lobe(mean, plain2)).error;
    errors.best = best_error(samples, mass, mean, errors.plain,
                             static_cast<double>(std::sqrt(narrow2)));
    for (const EllipticLobe& lobe : lobes) errors.tested.push_back(measure(samples, mass, lobe));
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

RangeScore Score::fine() const { return over(levels, 1, 5); }
RangeScore Score::coarse() const { return over(levels, 6, 99); }

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
                throw Error("score: level " + std::to_string(k) + " is " + std::to_string(r.width) +
                                " x " + std::to_string(r.height) + ", which is not a mip level of " +
                                std::to_string(surface.width) + " x " +
                                std::to_string(surface.height),
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
        const auto [width, height] = sizes[k];
        const std::vector<Footprint> columns = footprints(surface.width, width);
        const std::vector<Footprint> rows = footprints(surface.height, height);
        // Strata of equal texel counts in row order, one texel at random in each.
        const std::int64_t all = static_cast<std::int64_t>(width) * height;
        const std::int64_t count = std::min<std::int64_t>(all, options.texels);
        Random random{options.seed * 7919ull + k};
        std::vector<std::int64_t> chosen;
        for (std::int64_t i = 0; i < count; ++i) {
            const double at = (static_cast<double>(i) + random()) / static_cast<double>(count);
            chosen.push_back(std::min(all - 1, static_cast<std::int64_t>(at * static_cast<double>(all))));
        }
        std::vector<TexelErrors> errors(chosen.size());
        parallel_for(chosen.size(), options.threads, [&](std::size_t i) {
            const int x = static_cast<int>(chosen[i] % width), y = static_cast<int>(chosen[i] / width);
            errors[i] = texel_errors(surface, columns[static_cast<std::size_t>(x)],
                                     rows[static_cast<std::size_t>(y)], k, x, y, chains, input,
                                     options);
        });
        for (std::size_t c = 0; c < chains.size(); ++c) {
            LevelScore level{static_cast<int>(k), 0, 0, 0, 0, 0};
            double square = 0.0;
            const double n = static_cast<double>(errors.size());
            for (const TexelErrors& e : errors) {
                level.plain += e.plain / n;
                level.best += e.best / n;
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
    for (auto* images : {&chain.normal, &chain.roughness, &chain.anisotropy}) {
        for (Image& image : *images) {
            for (float& v : image.pixels) {
                v = std::floor(std::clamp(v, 0.0f, 1.0f) * top + 0.5f) / top;
            }
        }
    }
}

std::string to_text(const Score& s)
{
    std::string text = "level   plain    best    this     gap  energy\n";
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
        std::snprintf(line, sizeof line, "%5d  %6.3f  %6.3f  %6.3f  %8s  %+.3f\n", l.level, l.plain,
                      l.best, l.tested, gap(l.plain, l.best, l.tested).c_str(), l.energy);
        text += line;
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

namespace {

// A map of normals with Gaussian slopes, as floats.
void gaussian_map(int size, double sigma, float p, RawImage& normal, RawImage& roughness)
{
    Image n(size, size, 3, ColorSpace::Data);
    Random random{42};
    for (std::size_t i = 0; i < n.pixels.size(); i += 3) {
        const double r = sigma * std::sqrt(-2.0 * std::log(1.0 - random()));
        const double phi = 6.283185307179586 * random();
        const Direction d = normalized({static_cast<float>(r * std::cos(phi)),
                                        static_cast<float>(r * std::sin(phi)), 1.0f});
        n.pixels[i] = 0.5f + 0.5f * d.x;
        n.pixels[i + 1] = 0.5f + 0.5f * d.y;
        n.pixels[i + 2] = 0.5f + 0.5f * d.z;
    }
    normal = to_raw(n, PixelType::F32);
    roughness = to_raw(Image(size, size, 1, ColorSpace::Data, p), PixelType::F32);
}

}  // namespace

std::vector<SelfCheck> score_self_test()
{
    std::vector<SelfCheck> checks;
    RawImage normal, roughness;
    gaussian_map(32, 0.0, 0.25f, normal, roughness);
    for (const char* rule : {"none", "moments", "lux-formula", "median", "overlap"}) {
        PrefilterOptions options;
        options.rule = rule;
        const Prefiltered flat = prefilter_raw(normal, roughness, options);
        const Score s = score(normal, roughness, flat, options);
        double worst = 0.0;
        for (const LevelScore& l : s.levels) worst = std::max(worst, l.tested);
        checks.push_back({std::string("flat map, ") + rule, worst, 0.0, 0.02});
    }
    // The projected density of half-vectors of a footprint integrates to 1.
    gaussian_map(64, 0.25, 0.25f, normal, roughness);
    const MapSurface surface = make_surface(ref(normal), ref(roughness), {});
    std::vector<SurfaceRow> rows(64);
    for (int y = 0; y < 64; ++y) fetch(surface, y, rows[static_cast<std::size_t>(y)]);
    const Footprint whole = footprints(64, 1)[0];
    Cells cells;
    Means means;
    gather(rows, 0, whole, whole, cells, means);
    const Direction mean = normalized({means.nx, means.ny, means.nz});
    Samples samples;
    Random random{7};
    place_points(cells, mean, {0.0039f, 0.09f}, 4096, random, samples);
    const SamplesView s = samples.view();
    double density = 0.0;
    for (int k = 0; k < s.per_view; ++k) {  // view 0: 4 (v.h) = 4 h_z, all h up
        if (s.hz[k] > 1e-3f && s.weight[k] > 0.0f) {
            density += static_cast<double>(s.weight[k] / (4.0f * s.hz[k]) * s.density[k]);
        }
    }
    checks.push_back({"density of the reference", density, 0.98, 1.005});
    // Gaussian slopes 0.25 over alpha 0.0625: where the rules come out.
    const auto alpha_of = [&](const char* rule) {
        PrefilterOptions options;
        options.rule = rule;
        const float p = prefilter_raw(normal, roughness, options).roughness.back().pixels[0];
        return static_cast<double>(p) * static_cast<double>(p);
    };
    checks.push_back({"alpha of lean", alpha_of("lean"), 0.349, 0.369});
    checks.push_back({"alpha of vmf", alpha_of("vmf"), 0.319, 0.339});
    checks.push_back({"alpha of median", alpha_of("median"), 0.277, 0.297});
    checks.push_back({"alpha of lux-formula", alpha_of("lux-formula"), 0.105, 0.125});
    checks.push_back({"alpha of overlap", alpha_of("overlap"), 0.287, 0.327});
    return checks;
}

}  // namespace petrichor::texproc
