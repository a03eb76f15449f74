#include "texproc/prefilter/detail/overlap.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>

#include "texproc/prefilter/rules.h"
#include "texproc/study/score.h"

namespace petrichor::texproc {
namespace {

using namespace detail;

struct Maps {
    RawImage normal, roughness;
};

// slopes(x, y) -> {slope x, slope y, p}
template <class Slopes>
Maps make_maps(int width, int height, const Slopes& slopes)
{
    Image n(width, height, 3, ColorSpace::Data), r(width, height, 1, ColorSpace::Data);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const std::array<float, 3> s = slopes(x, y);
            const float length = std::sqrt(1.0f + s[0] * s[0] + s[1] * s[1]);
            n.at(x, y, 0) = 0.5f - 0.5f * s[0] / length;
            n.at(x, y, 1) = 0.5f - 0.5f * s[1] / length;
            n.at(x, y, 2) = 0.5f + 0.5f / length;
            r.at(x, y, 0) = s[2];
        }
    }
    return {to_raw(n, PixelType::F32), to_raw(r, PixelType::F32)};
}

std::uint32_t hash(int x, int y)
{
    std::uint32_t h =
        static_cast<std::uint32_t>(x) * 0x9e3779b9u ^ static_cast<std::uint32_t>(y) * 0x85ebca6bu;
    h ^= h >> 15;
    h *= 0x2c1b3c6du;
    h ^= h >> 12;
    h *= 0x297a2d39u;
    return h ^ (h >> 15);
}

float uniform(int x, int y, int which)
{
    return static_cast<float>(hash(x + 4099 * which, y) >> 8) / 16777216.0f;
}

float gaussian(int x, int y, int which)
{
    return std::sqrt(-2.0f * std::log(1.0f - uniform(x, y, 2 * which))) *
           std::cos(6.2831853f * uniform(x, y, 2 * which + 1));
}

Maps two_gloss(int size)
{
    return make_maps(size, size, [](int x, int y) {
        return std::array<float, 3>{0.02f * gaussian(x, y, 0), 0.02f * gaussian(x, y, 1),
                                    (x / 7 + y / 5) % 3 ? 0.15f : 0.8f};
    });
}
Maps grooves(int size)
{
    return make_maps(size, size, [](int x, int y) {
        return std::array<float, 3>{(x / 2) % 2 ? 0.6f : -0.6f, 0.02f * gaussian(x, y, 0), 0.25f};
    });
}
Maps bumps(int size)
{
    return make_maps(size, size, [](int x, int y) {
        return std::array<float, 3>{0.25f * gaussian(x, y, 0), 0.25f * gaussian(x, y, 1), 0.25f};
    });
}
Maps brushed(int size)
{
    return make_maps(size, size, [](int x, int y) {
        return std::array<float, 3>{0.4f * gaussian(x, 0, 0), 0.01f * gaussian(x, y, 1), 0.25f};
    });
}

Score scored(const Maps& maps, PrefilterOptions options, int bits = 16, float light = 0.0f)
{
    options.design_light = light;
    Prefiltered chain = prefilter_raw(maps.normal, maps.roughness, options);
    quantize(chain, bits);
    ScoreOptions scoring;
    scoring.texels = 12;
    scoring.points = 256;
    scoring.light = light;
    return score(maps.normal, maps.roughness, chain, options, scoring);
}

TEST(Yardstick, MeasuresItself)
{
    for (const SelfCheck& check : score_self_test()) {
        EXPECT_TRUE(check.good()) << check.name << " " << check.value << " not in " << check.low
                                  << ".." << check.high;
    }
}

struct Case {
    const char* name;
    Maps (*maps)(int);
    double joint_fine, joint_coarse;  // least share of the room closed, per cent
};
void PrintTo(const Case& c, std::ostream* out)
{
    *out << c.name;
}

class Overlap : public testing::TestWithParam<Case> {};

// The promises of the default: closes the room, and is on no level worse than plain mips.
TEST_P(Overlap, ClosesTheRoomAndNeverLosesToPlain)
{
    const Case& c = GetParam();
    PrefilterOptions options;
    options.rule = "overlap";
    for (const float light : {0.0f, 0.1f}) {
        const Score s = scored(c.maps(64), options, 16, light);
        for (const LevelScore& l : s.levels) {
            EXPECT_LE(l.tested, l.plain + 0.005) << "level " << l.level << " light " << light;
        }
        if (s.fine().room() >= 0.02) {
            EXPECT_GE(s.fine().gap(), c.joint_fine) << to_text(s);
        }
        if (s.coarse().room() >= 0.02) {
            EXPECT_GE(s.coarse().gap(), c.joint_coarse) << to_text(s);
        }
    }
}

TEST_P(Overlap, RoughnessOnlyComesNearTheBestIsotropicLobe)
{
    PrefilterOptions options;
    options.rule = "overlap";
    options.joint = false;
    const Score s = scored(GetParam().maps(64), options);
    if (s.fine().room() >= 0.02) {
        EXPECT_GE(s.fine().gap(), 85.0) << to_text(s);
    }
    if (s.coarse().room() >= 0.02) {
        EXPECT_GE(s.coarse().gap(), 85.0) << to_text(s);
    }
}
INSTANTIATE_TEST_SUITE_P(Maps, Overlap,
                         testing::Values(Case{"two_gloss", two_gloss, 95, 95},
                                         Case{"grooves", grooves, 110, 110},
                                         Case{"bumps", bumps, 95, 95},
                                         Case{"brushed", brushed, 100, 95}),
                         [](const auto& test) { return test.param.name; });

TEST(OverlapAnisotropic, BrushedMetalNeedsAnEllipse)
{
    PrefilterOptions options;
    options.rule = "overlap";
    const double round = scored(brushed(64), options).coarse().tested;
    options.anisotropic = true;
    const Score s = scored(brushed(64), options);
    EXPECT_LT(s.coarse().tested, 0.6 * round) << to_text(s);
}

TEST(OverlapKernel, BothBuildsGiveTheSameBits)
{
    if (&lobe_kernel() == &kLobeKernelBase) GTEST_SKIP() << "this processor has no AVX2";
    Cells cells;
    for (int i = 0; i < 37; ++i) {
        const Direction n = normalized({0.3f * gaussian(i, 1, 0), 0.3f * gaussian(i, 2, 0), 1.0f});
        cells.add(n.x, n.y, n.z, 0.01f + 0.02f * uniform(i, 3, 0), 1.0f / 37.0f);
    }
    Samples a, b;
    a.draw(cells.view(), 320, 5, kLobeKernelBase);
    b.draw(cells.view(), 320, 5, kLobeKernelAvx2);
    EXPECT_EQ(std::memcmp(a.view().radiance, b.view().radiance, 320 * sizeof(float)), 0);
    const float alpha2s[3] = {0.01f, 0.05f, 0.3f};
    float x[kViews * 3], y[kViews * 3];
    kLobeKernelBase.overlaps(a.view(), {0.0f, 0.1f, 0.995f, 0.0f}, alpha2s, 3, x);
    kLobeKernelAvx2.overlaps(b.view(), {0.0f, 0.1f, 0.995f, 0.0f}, alpha2s, 3, y);
    EXPECT_EQ(std::memcmp(x, y, sizeof x), 0);
    EXPECT_GT(x[0], 0.0f);
}

// One lobe goes another way through the samples than many; more cells and samples than one part.
TEST(OverlapKernel, OneLobeAsAmongMany)
{
    Cells cells;
    for (int i = 0; i < 150; ++i) {
        const Direction n = normalized({gaussian(i, 1, 0), gaussian(i, 2, 0), 1.0f});
        cells.add(n.x, n.y, n.z, 0.01f + 0.2f * uniform(i, 3, 0), 1.0f / 150.0f);
    }
    const float alpha2s[3] = {0.01f, 0.05f, 0.3f};
    for (const LobeKernel* kernel : {&kLobeKernelBase, &lobe_kernel()}) {
        for (const int total : {40, 120, 960}) {
            for (const Lobe& lobe :
                 {Lobe{0.0f, 0.1f, 0.995f, 0.0f}, Lobe{0.8f, 0.0f, 0.6f, 0.0f}}) {
                Samples samples;
                samples.draw(cells.view(), total, 5, *kernel);
                float many[kViews * 3], one[kViews];
                kernel->overlaps(samples.view(), lobe, alpha2s, 3, many);
                for (int k = 0; k < 3; ++k) {
                    kernel->overlaps(samples.view(), lobe, alpha2s + k, 1, one);
                    for (int v = 0; v < kViews; ++v) EXPECT_EQ(one[v], many[v * 3 + k]);
                }
            }
        }
    }
}

TEST(OverlapRule, SameBytesForAnyThreadCountAndAnySize)
{
    const Maps maps = make_maps(45, 70, [](int x, int y) {
        return std::array<float, 3>{0.3f * gaussian(x, y, 0), 0.1f * gaussian(x, y, 1), 0.2f};
    });
    PrefilterOptions options;
    options.rule = "overlap";
    options.threads = 1;
    const Prefiltered one = prefilter_raw(maps.normal, maps.roughness, options);
    options.threads = 3;
    const Prefiltered three = prefilter_raw(maps.normal, maps.roughness, options);
    for (std::size_t k = 1; k < one.roughness.size(); ++k) {
        EXPECT_EQ(one.roughness[k].pixels, three.roughness[k].pixels);
        EXPECT_EQ(one.normal[k].pixels, three.normal[k].pixels);
    }
    const Score s = scored(maps, options);
    EXPECT_GE(s.fine().gap(), 90.0) << to_text(s);
}

TEST(OverlapRule, ALineOfTexelsAndZeroNormalsWork)
{
    Maps maps = make_maps(33, 1, [](int x, int) {
        return std::array<float, 3>{0.5f * gaussian(x, 0, 0), 0.0f, 0.0f};
    });
    std::memset(maps.normal.bytes.data(), 0, 12);  // (-1, -1, -1): points into the surface
    const float half = 0.5f;
    for (int k = 0; k < 3; ++k)
        std::memcpy(&maps.normal.bytes[12 + 4 * static_cast<std::size_t>(k)], &half, 4);
    PrefilterOptions options;
    for (const Rule& rule : rules()) {
        if (rule.name == "lux") continue;
        options.rule = rule.name;
        const Prefiltered out = prefilter_raw(maps.normal, maps.roughness, options);
        ASSERT_EQ(out.roughness.size(), 6u);
        for (const Image& level : out.roughness) {
            for (const float v : level.pixels) EXPECT_TRUE(v >= 0.0f && v <= 1.0f) << rule.name;
        }
        for (const Image& level : out.normal) {
            for (const float v : level.pixels) EXPECT_TRUE(v >= 0.0f && v <= 1.0f) << rule.name;
        }
    }
}

// Merging keeps what a footprint holds: its weight and, to second order, its spread.
TEST(CellsMerge, ConservesWeightAndSpread)
{
    Cells cells;
    for (int i = 0; i < 4096; ++i) {
        const Direction n = normalized({0.3f * gaussian(i, 1, 0), 0.3f * gaussian(i, 2, 0), 1.0f});
        cells.add(n.x, n.y, n.z, 0.0025f, 1.0f / 4096.0f);
    }
    const float before = median_alpha2(cells.view(), {}, lobe_kernel());
    merge(cells, 256);
    EXPECT_LE(cells.count(), 256);
    float weight = 0.0f;
    for (const float w : cells.weight) weight += w;
    EXPECT_NEAR(weight, 1.0f, 1e-4f);
    EXPECT_NEAR(median_alpha2(cells.view(), {}, lobe_kernel()) / before, 1.0f, 0.03f);
}

// The radius that the median rule finds holds half of the half-vectors, by its own formula.
TEST(MedianRule, SolvesItsEquation)
{
    Cells cells;
    for (int i = 0; i < 50; ++i) {
        const Direction n = normalized({0.2f * gaussian(i, 1, 0), 0.5f * gaussian(i, 2, 0), 1.0f});
        cells.add(n.x, n.y, n.z, 0.001f + 0.3f * uniform(i, 5, 0), 0.02f);
    }
    const double x = static_cast<double>(median_alpha2(cells.view(), {}, lobe_kernel()));
    double inside = 0.0;
    for (std::size_t i = 0; i < 50; ++i) {
        const double z = static_cast<double>(cells.nz[i]);
        const double d2 = (1.0 - z * z) / (z * z);
        inside += 0.02 * x / (x + static_cast<double>(cells.alpha2[i]) + d2);
    }
    EXPECT_NEAR(inside, 0.5, 1e-3);
    Cells one;
    one.add(0.0f, 0.0f, 1.0f, 0.04f, 1.0f);
    EXPECT_NEAR(median_alpha2(one.view(), {}, lobe_kernel()), 0.04f, 1e-5f);
}

// One lobe in, the same lobe out.
TEST(StudentT, ASingleLobeComesBack)
{
    Cells cells;
    const Direction n = normalized({0.2f, -0.1f, 1.0f});
    cells.add(n.x, n.y, n.z, 0.01f, 1.0f);
    const RobustFit fit = student_t(cells.view(), {}, 0.3f, 3, 12, false, lobe_kernel());
    EXPECT_NEAR(fit.alpha2, 0.01f, 0.0015f);
    EXPECT_GT(dot(fit.normal, n), 0.99999f);
}

// The table against the closed form at normal incidence: 1 - a^2 ... is 0.306853 (1 - ln 2) at
// alpha 1.
TEST(LobeAlbedo, KnownValues)
{
    EXPECT_NEAR(lobe_albedo(1.0f, 1.0f), 1.0f - std::log(2.0f), 1e-3f);
    EXPECT_NEAR(lobe_albedo(1e-6f, 0.5f), 1.0f, 1e-3f);
    EXPECT_EQ(lobe_albedo(0.1f, 0.0f), 0.0f);
}

}  // namespace
}  // namespace petrichor::texproc
