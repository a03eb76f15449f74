#include "texproc/generate/generate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <vector>

#include "base/error.h"
#include "texproc/generate/detail/colonies.h"
#include "texproc/generate/noise.h"

namespace petrichor::texproc {

void PrintTo(const MaterialKindInfo& info, std::ostream* out)
{
    *out << info.name;
}

namespace {

constexpr int kSize = 192;

std::vector<std::pair<const char*, const Image*>> images_of(const MaterialMaps& maps)
{
    return {{"albedo", &maps.albedo},          {"normal", &maps.normal},
            {"height", &maps.height},          {"roughness", &maps.roughness},
            {"occlusion", &maps.occlusion},    {"metallic", &maps.metallic},
            {"puddle_mask", &maps.puddle_mask}};
}

bool same_bits(const Image& a, const Image& b)
{
    return a.pixels.size() == b.pixels.size() &&
           std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(float)) == 0;
}

class Material : public testing::TestWithParam<MaterialKindInfo> {};

TEST_P(Material, IsTheSameForAnyThreadCount)
{
    const MaterialMaps one = generate_material(GetParam().kind, kSize, 7, 1);
    for (const int threads : {2, 8}) {
        const MaterialMaps many = generate_material(GetParam().kind, kSize, 7, threads);
        const auto a = images_of(one);
        const auto b = images_of(many);
        for (std::size_t i = 0; i < a.size(); ++i) {
            EXPECT_TRUE(same_bits(*a[i].second, *b[i].second)) << a[i].first << " x " << threads;
        }
        EXPECT_EQ(one.height_scale_m, many.height_scale_m);
    }
}

TEST_P(Material, ChangesWithTheSeed)
{
    const MaterialMaps a = generate_material(GetParam().kind, 64, 1, 1);
    const MaterialMaps b = generate_material(GetParam().kind, 64, 2, 1);
    EXPECT_FALSE(same_bits(a.height, b.height));
    EXPECT_FALSE(same_bits(a.albedo, b.albedo));
}

// The mean step between column pairs: across the seam it must look like any other place.
double seam_excess(const Image& image, bool across_columns)
{
    const int n = image.width;
    std::vector<double> steps;
    for (int i = 0; i < n; ++i) {
        double sum = 0.0;
        for (int j = 0; j < n; ++j) {
            for (int c = 0; c < image.channels; ++c) {
                const float a = across_columns ? image.at(i, j, c) : image.at(j, i, c);
                const int next = (i + 1) % n;
                const float b = across_columns ? image.at(next, j, c) : image.at(j, next, c);
                sum += std::abs(static_cast<double>(a) - static_cast<double>(b));
            }
        }
        steps.push_back(sum / (n * image.channels));
    }
    const double seam = steps.back();
    steps.pop_back();
    return seam - *std::max_element(steps.begin(), steps.end());
}

TEST_P(Material, HasNoSeam)
{
    const MaterialMaps maps = generate_material(GetParam().kind, kSize, 3, 2);
    for (const auto& [name, image] : images_of(maps)) {
        EXPECT_LE(seam_excess(*image, true), 1e-3) << name << ", left to right";
        EXPECT_LE(seam_excess(*image, false), 1e-3) << name << ", top to bottom";
    }
}

TEST_P(Material, StaysInRange)
{
    const MaterialMaps maps = generate_material(GetParam().kind, kSize, 5, 2);
    for (const auto& [name, image] : images_of(maps)) {
        ASSERT_EQ(image->width, kSize) << name;
        ASSERT_EQ(image->height, kSize) << name;
        const bool color = image == &maps.albedo || image == &maps.normal;
        ASSERT_EQ(image->channels, color ? 3 : 1) << name;
        for (const float v : image->pixels) ASSERT_TRUE(v >= 0.0f && v <= 1.0f) << name << " " << v;
    }
    EXPECT_EQ(maps.albedo.space, ColorSpace::Linear);
    EXPECT_EQ(maps.normal.space, ColorSpace::Data);
    EXPECT_GT(maps.tile_m, 0.0f);
    EXPECT_GT(maps.height_scale_m, 0.0f);
    EXPECT_LT(maps.height_scale_m, 0.1f);
}

TEST_P(Material, NormalsAreTheGradientOfTheHeight)
{
    const MaterialMaps maps = generate_material(GetParam().kind, kSize, 11, 2);
    const double texel_m = static_cast<double>(maps.tile_m) / kSize;
    const auto height_m = [&](int x, int y) {
        return static_cast<double>(maps.height.at(wrap_index(x, kSize), wrap_index(y, kSize), 0)) *
               static_cast<double>(maps.height_scale_m);
    };
    for (int y = 0; y < kSize; y += 3) {
        for (int x = 0; x < kSize; x += 3) {
            std::array<double, 3> n{};
            double length = 0.0;
            for (int c = 0; c < 3; ++c) {
                n[static_cast<std::size_t>(c)] =
                    2.0 * static_cast<double>(maps.normal.at(x, y, c)) - 1.0;
                length += n[static_cast<std::size_t>(c)] * n[static_cast<std::size_t>(c)];
            }
            ASSERT_NEAR(length, 1.0, 1e-5);
            ASSERT_GT(n[2], 0.0);
            // y is up the picture, rows go down.
            const double slope_x = (height_m(x + 1, y) - height_m(x - 1, y)) / (2.0 * texel_m);
            const double slope_y = (height_m(x, y - 1) - height_m(x, y + 1)) / (2.0 * texel_m);
            ASSERT_NEAR(-n[0] / n[2], slope_x, 2e-4 * (1.0 + std::abs(slope_x)));
            ASSERT_NEAR(-n[1] / n[2], slope_y, 2e-4 * (1.0 + std::abs(slope_y)));
        }
    }
}

TEST_P(Material, HeightUsesItsRange)
{
    const MaterialMaps maps = generate_material(GetParam().kind, kSize, 1, 2);
    std::vector<float> sorted = maps.height.pixels;
    std::sort(sorted.begin(), sorted.end());
    EXPECT_FLOAT_EQ(sorted.front(), 0.0f);
    EXPECT_FLOAT_EQ(sorted.back(), 1.0f);
    // Not a plane with a spike: the middle 98 % cover a fair part of the range.
    const std::size_t n = sorted.size();
    EXPECT_GT(sorted[n * 99 / 100] - sorted[n / 100], 0.2f);
}

TEST_P(Material, PuddleMaskIsSmoothAndHasBothEnds)
{
    const MaterialMaps maps = generate_material(GetParam().kind, kSize, 1, 2);
    const auto [low, high] =
        std::minmax_element(maps.puddle_mask.pixels.begin(), maps.puddle_mask.pixels.end());
    EXPECT_LT(*low, 0.2f);
    EXPECT_GT(*high, 0.8f);
    for (int y = 0; y < kSize; ++y) {
        for (int x = 1; x < kSize; ++x) {
            ASSERT_LT(std::abs(maps.puddle_mask.at(x, y, 0) - maps.puddle_mask.at(x - 1, y, 0)),
                      0.15f);
        }
    }
}

TEST_P(Material, IsFoundByName)
{
    ASSERT_TRUE(find_material_kind(GetParam().name).has_value());
    EXPECT_EQ(*find_material_kind(GetParam().name), GetParam().kind);
    EXPECT_FALSE(GetParam().meaning.empty());
}

// No parameter is without effect, at either end of what it accepts.
TEST_P(Material, EveryParameterChangesIt)
{
    constexpr int kSmall = 96;
    for (const MaterialParameter& parameter : GetParam().parameters) {
        MaterialRecipe recipe{GetParam().kind, kSmall, 3, 2, {}, {}};
        // Some need something to act on.
        if (GetParam().kind == MaterialKind::Mud && parameter.name == "plate_m") recipe.values["cracks"] = 0.9f;
        // Grains and gaps of millimetres are too fine for few texels.
        if (parameter.name == "grain_m" || parameter.name == "gap_m") recipe.values["tile_m"] = 0.15f;
        if (GetParam().kind == MaterialKind::Asphalt || GetParam().kind == MaterialKind::Gravel ||
            GetParam().kind == MaterialKind::Soil || GetParam().kind == MaterialKind::Mud)
            recipe.values["tile_m"] = 0.4f;
        if (GetParam().kind == MaterialKind::Plank && parameter.name == "gap_m") recipe.values["board_m"] = 0.05f;
        const MaterialMaps usual = generate_material(recipe);
        EXPECT_LE(parameter.low, parameter.usual) << parameter.name;
        EXPECT_GE(parameter.high, parameter.usual) << parameter.name;
        EXPECT_FALSE(parameter.meaning.empty()) << parameter.name;
        for (const float value : {parameter.low, parameter.high}) {
            if (value == parameter.usual) continue;
            recipe.values[parameter.name] = value;
            const MaterialMaps other = generate_material(recipe);
            bool changed = other.height_scale_m != usual.height_scale_m;
            const auto a = images_of(usual), b = images_of(other);
            for (std::size_t i = 0; i < a.size(); ++i) {
                changed = changed || !same_bits(*a[i].second, *b[i].second);
                for (const float v : b[i].second->pixels)
                    ASSERT_TRUE(v >= 0.0f && v <= 1.0f) << parameter.name << " = " << value << ": " << b[i].first;
            }
            EXPECT_TRUE(changed) << parameter.name << " = " << value;
        }
    }
}

TEST_P(Material, TakesTheColorThatIsAsked)
{
    MaterialRecipe recipe{GetParam().kind, 96, 3, 2, {}, glm::vec3(0.20f, 0.15f, 0.11f)};
    const MaterialMaps maps = generate_material(recipe);
    for (std::size_t c = 0; c < 3; ++c) {
        double sum = 0.0;
        for (std::size_t k = c; k < maps.albedo.pixels.size(); k += 3) sum += static_cast<double>(maps.albedo.pixels[k]);
        const double asked = static_cast<double>((*recipe.color)[static_cast<int>(c)]);
        EXPECT_NEAR(sum * 3.0 / static_cast<double>(maps.albedo.pixels.size()), asked, 0.01 * asked);
    }
}

INSTANTIATE_TEST_SUITE_P(Kinds, Material, testing::ValuesIn(material_kinds()),
                         [](const auto& test) { return test.param.name; });

// What water and snow need from the cobbles: tops high, joints deep and narrower than the tops.
TEST(Generate, CobbleJointsLieDeepBelowTheStones)
{
    const MaterialMaps maps = generate_material(MaterialKind::Cobble, 384, 1, 2);
    std::vector<float> sorted = maps.height.pixels;
    std::sort(sorted.begin(), sorted.end());
    const auto at = [&](double share) {
        return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
    };
    EXPECT_LT(at(0.10), 0.25f);
    EXPECT_GT(at(0.70), 0.60f);
    EXPECT_GT(maps.height_scale_m, 0.018f);
    EXPECT_LT(maps.height_scale_m, 0.032f);
}

TEST(Generate, OcclusionDarkensWhatLiesLow)
{
    const MaterialMaps maps = generate_material(MaterialKind::Cobble, 384, 1, 2);
    double low = 0.0, high = 0.0;
    int low_count = 0, high_count = 0;
    for (std::size_t k = 0; k < maps.height.pixels.size(); ++k) {
        if (maps.height.pixels[k] < 0.2f) {
            low += static_cast<double>(maps.occlusion.pixels[k]);
            ++low_count;
        } else if (maps.height.pixels[k] > 0.7f) {
            high += static_cast<double>(maps.occlusion.pixels[k]);
            ++high_count;
        }
    }
    ASSERT_GT(low_count, 0);
    ASSERT_GT(high_count, 0);
    EXPECT_LT(low / low_count, high / high_count - 0.15);
}

TEST(Generate, MetalsAreMetalAndStonesAreNot)
{
    const auto mean = [](const Image& image) {
        double sum = 0.0;
        for (const float v : image.pixels) sum += static_cast<double>(v);
        return sum / static_cast<double>(image.pixels.size());
    };
    EXPECT_GT(mean(generate_material(MaterialKind::MetalPlate, 128, 1, 1).metallic), 0.8);
    EXPECT_EQ(mean(generate_material(MaterialKind::Cobble, 128, 1, 1).metallic), 0.0);
    EXPECT_EQ(mean(generate_material(MaterialKind::Plank, 128, 1, 1).metallic), 0.0);
}

double mean_of(const Image& image)
{
    double sum = 0.0;
    for (const float v : image.pixels) sum += static_cast<double>(v);
    return sum / static_cast<double>(image.pixels.size());
}

double share_below(const Image& image, float limit)
{
    const auto below = std::count_if(image.pixels.begin(), image.pixels.end(), [&](float v) { return v < limit; });
    return static_cast<double>(below) / static_cast<double>(image.pixels.size());
}

TEST(Generate, LengthsAreMetres)
{
    // A painted line is as wide as is asked.
    const auto white = [](float line_m) {
        const MaterialMaps road = generate_material({MaterialKind::Asphalt, 512, 1, 2,
                                                     {{"tile_m", 2.0f}, {"wear", 0.0f}, {"cracks", 0.0f}, {"marking_m", line_m}}, {}});
        int count = 0;
        for (std::size_t k = 0; k < road.albedo.pixels.size(); k += 3) count += road.albedo.pixels[k] > 0.35f ? 1 : 0;
        return 2.0 * count / (512.0 * 512.0);
    };
    EXPECT_EQ(white(0.0f), 0.0);
    EXPECT_NEAR(white(0.12f), 0.12, 0.012);
    EXPECT_NEAR(white(0.30f), 0.30, 0.02);
    // Wider joints take their share of the setts.
    const auto low = [](float joint_m) {
        const MaterialMaps setts = generate_material({MaterialKind::Cobble, 384, 1, 2, {{"joint_m", joint_m}}, {}});
        return share_below(setts.height, 0.3f);
    };
    EXPECT_GT(low(0.030f), 1.5 * low(0.011f));
    // A drift of half a metre is ten times one of five centimetres, whatever lies on it.
    const auto snow = [](float drift_m) {
        return generate_material({MaterialKind::Snow, 128, 1, 2, {{"drift_m", drift_m}, {"ripples", 0.0f}}, {}}).height_scale_m;
    };
    EXPECT_NEAR(snow(0.4f) / snow(0.04f), 10.0, 1.5);
    // Twice the relief, twice the height; none, a plane.
    const auto relief = [](float factor) {
        return generate_material({MaterialKind::Slate, 128, 1, 2, {{"relief", factor}}, {}}).height_scale_m;
    };
    EXPECT_NEAR(relief(2.0f), 2.0f * relief(1.0f), 1e-5f);
    EXPECT_EQ(relief(0.0f), 0.0f);
}

TEST(Generate, BootsPressTheSnowWhereTheyStep)
{
    const auto snow = [](float trails) {
        return generate_material({MaterialKind::Snow, 512, 1, 2,
                                  {{"drift_m", 0.0f}, {"ripples", 0.0f}, {"footprints", trails}}, {}});
    };
    const MaterialMaps trodden = snow(1.0f), untrodden = snow(0.0f);
    EXPECT_LT(untrodden.height_scale_m, 0.015f);
    EXPECT_GT(trodden.height_scale_m, 0.035f);
    EXPECT_LT(trodden.height_scale_m, 0.080f);
    // Two metres are six steps; a sole of 0.31 m by 0.10 m is 0.024 m2.
    const double pressed_m2 = 4.0 * share_below(trodden.height, (0.030f - 0.004f) / trodden.height_scale_m);
    EXPECT_NEAR(pressed_m2, 6 * 0.024, 0.05);
    // Packed snow is darker and smoother than what lies about it.
    double packed = 0.0, loose = 0.0;
    int packed_count = 0, loose_count = 0;
    for (std::size_t k = 0; k < trodden.height.pixels.size(); ++k) {
        const bool low = trodden.height.pixels[k] * trodden.height_scale_m < 0.020f;
        (low ? packed : loose) += static_cast<double>(trodden.roughness.pixels[k]);
        ++(low ? packed_count : loose_count);
    }
    EXPECT_LT(packed / packed_count, loose / loose_count - 0.1);
}

TEST(Generate, OctavesDoNotShareTheirLattice)
{
    // On its lattice gradient noise is 0; where all octaves were, the zeros would stand in rows.
    detail::MaterialSurface surface;
    surface.size = 512;
    surface.seed = 5;
    surface.threads = 2;
    for (std::uint32_t salt = 1; salt < 6; ++salt) {
        const std::vector<float> noise = detail::noise_layer(surface, {1.0f / 16.0f, 1.0f / 16.0f, 4, 0.5f, salt});
        double all = 0.0, lattice = 0.0;
        for (const float v : noise) all += std::abs(static_cast<double>(v));
        for (std::size_t j = 0; j < 16; ++j)
            for (std::size_t i = 0; i < 16; ++i) lattice += std::abs(static_cast<double>(noise[j * 32 * 512 + i * 32]));
        EXPECT_GT(lattice / 256.0, 0.5 * all / static_cast<double>(noise.size())) << salt;
    }
}

TEST(Generate, ColoniesRepeatWithTheTileAndFillTheirShare)
{
    detail::MaterialSurface surface;
    surface.tile_m = 0.7f;
    surface.size = 256;
    surface.seed = 3;
    const detail::Colonies colonies(surface, 0.05f, 4);
    int inside[3] = {};
    for (int k = 0; k < 4000; ++k) {
        const float x = 0.7f * hash_unit(hash_u32(static_cast<std::uint32_t>(2 * k))),
                    y = 0.7f * hash_unit(hash_u32(static_cast<std::uint32_t>(2 * k + 1)));
        const detail::ColonyAt a = colonies.at(x, y, 0.6f), b = colonies.at(x + 0.7f, y - 0.7f, 0.6f);
        EXPECT_EQ(a.id, b.id);
        EXPECT_NEAR(a.inside, b.inside, 1e-3f * (1.0f + std::abs(a.inside)));
        const float shares[3] = {0.0f, 0.3f, 0.6f};
        for (int s = 0; s < 3; ++s) inside[s] += colonies.at(x, y, shares[s]).inside > 0.0f ? 1 : 0;
    }
    EXPECT_EQ(inside[0], 0);
    EXPECT_GT(inside[1], 100);
    EXPECT_NEAR(inside[2], 2.0 * inside[1], 0.5 * inside[1]);
}

TEST(Generate, GravelHasTheStonesThatAreAsked)
{
    // Larger stones: fewer steps of the surface from texel to texel.
    const auto rough = [](float stone_m) {
        const MaterialMaps maps = generate_material({MaterialKind::Gravel, 512, 1, 2, {{"stone_m", stone_m}}, {}});
        double steps = 0.0;
        for (int y = 0; y < 512; ++y) {
            for (int x = 1; x < 512; ++x) {
                const bool a = maps.height.at(x, y, 0) > 0.5f, b = maps.height.at(x - 1, y, 0) > 0.5f;
                steps += a != b ? 1.0 : 0.0;
            }
        }
        return steps;
    };
    const double coarse = rough(0.10f), usual = rough(0.05f);
    EXPECT_GT(usual, 1.5 * coarse);
    EXPECT_LT(usual, 3.0 * coarse);
}

TEST(Generate, WaterDarkensAndSmooths)
{
    for (const MaterialKind kind : {MaterialKind::Cobble, MaterialKind::Mud, MaterialKind::Plank}) {
        const MaterialMaps dry = generate_material({kind, 128, 1, 2, {}, {}});
        const MaterialMaps damp = generate_material({kind, 128, 1, 2, {{"wetness", 0.5f}}, {}});
        const MaterialMaps wet = generate_material({kind, 128, 1, 2, {{"wetness", 1.0f}}, {}});
        EXPECT_LT(mean_of(damp.albedo), 0.95 * mean_of(dry.albedo));
        EXPECT_LT(mean_of(wet.albedo), 0.95 * mean_of(damp.albedo));
        EXPECT_LT(mean_of(wet.roughness), mean_of(damp.roughness) - 0.02);
        EXPECT_TRUE(same_bits(dry.height, wet.height));
    }
}

TEST(Generate, RefusesWhatNoKindHas)
{
    EXPECT_THROW(generate_material({MaterialKind::Brick, 64, 1, 1, {{"joints_m", 0.01f}}, {}}), Error);
    EXPECT_THROW(generate_material({MaterialKind::Brick, 64, 1, 1, {{"joint_m", 1.0f}}, {}}), Error);
    EXPECT_THROW(generate_material({MaterialKind::Brick, 64, 1, 1, {{"joint_m", NAN}}, {}}), Error);
    try {
        generate_material({MaterialKind::Brick, 64, 1, 1, {{"joints_m", 0.01f}}, {}});
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("joint_m"), std::string::npos) << error.what();
    }
}

TEST(Noise, BordersOfCellsAreAsFarAsTheySay)
{
    // Walking towards a border by what it says never crosses it; stepping past it does, somewhere.
    for (int k = 0; k < 300; ++k) {
        const float x = 0.617f * static_cast<float>(k), y = 0.283f * static_cast<float>(k);
        const CellBorder here = cell_border(x, y, 64, 64, 5);
        EXPECT_EQ(here.id, cell_noise(x, y, 64, 64, 5).id);
        EXPECT_EQ(here.id, cell_border(x + 64.0f, y - 64.0f, 64, 64, 5).id);
        bool left = false;
        for (int a = 0; a < 64; ++a) {
            const float angle = 0.0981748f * static_cast<float>(a);
            const auto at = [&](float r) {
                return cell_noise(x + r * std::cos(angle), y + r * std::sin(angle), 64, 64, 5).id;
            };
            EXPECT_EQ(at(0.98f * here.distance), here.id);
            left = left || at(1.03f * here.distance + 0.002f) != here.id;
        }
        EXPECT_TRUE(left);
    }
}

// What is on one side of a border knows it by the same place as what is on the other.
TEST(Noise, BothSidesOfABorderHaveOneMiddle)
{
    int crossed = 0, same = 0;
    for (int k = 0; k < 4000; ++k) {
        const float x = 0.0137f * static_cast<float>(k), y = 0.0091f * static_cast<float>(k);
        const CellBorder here = cell_border(x, y, 64, 64, 5), there = cell_border(x + 0.01f, y, 64, 64, 5);
        if (here.id == there.id) continue;
        ++crossed;
        same += std::abs(here.middle_x - there.middle_x) + std::abs(here.middle_y - there.middle_y) < 1e-4f;
        // It lies within reach of both cells.
        EXPECT_LT(std::abs(here.middle_x - x) + std::abs(here.middle_y - y), 3.0f);
    }
    EXPECT_GT(crossed, 40);
    EXPECT_GE(same, crossed * 9 / 10) << "but where three cells meet";
}

// A tile that repeats may not have one blotch that is seen from afar.
TEST(Generate, RustLiesAllOverTheTile)
{
    constexpr int kSquares = 4, kSide = 256;
    for (const std::uint32_t seed : {1u, 2u, 3u, 4u}) {
        const MaterialMaps sheet = generate_material({MaterialKind::MetalPlate, kSide, seed, 2, {{"rust", 0.55f}}, {}});
        std::array<double, kSquares * kSquares> share{};
        double mean = 0.0;
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x) {
                const double rusty = sheet.metallic.at(x, y, 0) < 0.5f ? 1.0 : 0.0;
                share[static_cast<std::size_t>(y * kSquares / kSide * kSquares + x * kSquares / kSide)] += rusty;
                mean += rusty / (kSquares * kSquares);
            }
        EXPECT_GT(mean, 0.2 * kSide * kSide / (kSquares * kSquares));
        for (const double rusty : share) {
            EXPECT_LT(rusty, 1.75 * mean) << seed;
            EXPECT_GT(rusty, 0.5 * mean) << seed;
        }
    }
}

TEST(Generate, WearTakesThePaintOff)
{
    const auto red = [](float wear) {  // primer and rust
        const MaterialMaps iron = generate_material({MaterialKind::PaintedIron, 256, 1, 2, {{"wear", wear}}, {}});
        int count = 0;
        for (std::size_t k = 0; k < iron.albedo.pixels.size(); k += 3)
            count += iron.albedo.pixels[k] > 1.6f * iron.albedo.pixels[k + 2] ? 1 : 0;
        return static_cast<double>(count) / (256.0 * 256.0);
    };
    const double little = red(0.0f), some = red(0.5f), much = red(1.0f);
    EXPECT_LT(little, 0.01);
    EXPECT_GT(some, little + 0.01);
    EXPECT_GT(much, 2.0 * some);
}

TEST(Generate, TakesAnySizeInRange)
{
    EXPECT_EQ(generate_material(MaterialKind::Brick, 16, 1, 1).height.width, 16);
    EXPECT_EQ(generate_material(MaterialKind::RoofTile, 101, 1, 3).height.width, 101);
    for (const int size : {0, -4, 15, 8193}) {
        EXPECT_THROW(generate_material(MaterialKind::Brick, size, 1, 1), Error) << size;
    }
}

TEST(Generate, KnowsNoOtherNames)
{
    EXPECT_FALSE(find_material_kind("cobbles").has_value());
    EXPECT_FALSE(find_material_kind("").has_value());
}

TEST(Noise, RepeatsAfterItsPeriod)
{
    for (int k = 0; k < 200; ++k) {
        const float x = 0.37f * static_cast<float>(k);
        const float y = 0.53f * static_cast<float>(k);
        EXPECT_NEAR(gradient_noise(x, y, 5, 7, 3), gradient_noise(x + 5.0f, y - 7.0f, 5, 7, 3),
                    2e-4f);
        const CellPoint a = cell_noise(x, y, 5, 7, 3);
        const CellPoint b = cell_noise(x - 5.0f, y + 7.0f, 5, 7, 3);
        EXPECT_EQ(a.id, b.id);
        EXPECT_NEAR(a.nearest, b.nearest, 1e-4f);
        EXPECT_LE(a.nearest, a.second);
    }
}

TEST(Noise, IsCentredAndBounded)
{
    double sum = 0.0;
    float largest = 0.0f;
    for (int j = 0; j < 300; ++j) {
        for (int i = 0; i < 300; ++i) {
            const float v = gradient_noise(0.173f * static_cast<float>(i),
                                           0.191f * static_cast<float>(j), 1 << 10, 1 << 10, 9);
            sum += static_cast<double>(v);
            largest = std::max(largest, std::abs(v));
        }
    }
    EXPECT_NEAR(sum / 90000.0, 0.0, 0.02);
    EXPECT_LT(largest, 1.9f);
    EXPECT_GT(largest, 0.8f);
}

TEST(Noise, HashesAreSpreadEvenly)
{
    std::array<int, 16> bins{};
    for (int y = 0; y < 128; ++y) {
        for (int x = 0; x < 128; ++x)
            ++bins[static_cast<std::size_t>(hash_unit(hash_cell(x, y, 1)) * 16.0f)];
    }
    for (const int count : bins) EXPECT_NEAR(count, 1024, 140);
}

}  // namespace
}  // namespace petrichor::texproc
