// The examples of docs/gallery.md: each renders, and shows what it is about.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <sstream>
#include <string>

#include "film/jobs/render_job.h"
#include "film/jobs/scene_source.h"
#include "film/scenes/light_bake.h"
#include "tests/gpu/gpu_fixture.h"
#include "tests/support/program.h"

namespace petrichor::film {
namespace {

namespace fs = std::filesystem;
using gpu::luminance;
using gpu::pixel;
using testing_program::Workplace;

constexpr int kWidth = 160, kHeight = 90;
constexpr int kFiner = 8;  // a side, of a fine picture

std::string read_example(const std::string& path)
{
    return testing_program::read_file(fs::path(PETRICHOR_SOURCE_DIR) / path);
}

// Exchanges what must be there.
std::string with(std::string text, const std::string& from, const std::string& to)
{
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

class Gallery : public gpu::GpuTest {
public:
    static gpu::RenderResult picture(const std::string& text, const fs::path& folder, int finer = 1)
    {
        Scenario scenario = parse_scenario(
            with(text, "[output]\n",
                 "[output]\nwidth = " + std::to_string(kWidth * finer) + "\nheight = " +
                     std::to_string(kHeight * finer) + "\nsamples = 2\n"),
            "s.toml");
        scenario.folder = folder;
        Sequence sequence = make_sequence(std::move(scenario));
        load_sequence_scene(sequence, 2);
        RenderRequest request;
        RenderReport report;
        gpu::Renderer renderer = sequence_renderer(sequence, request, report);
        return renderer.render(frame_at(sequence, {0, "", ""}).frame);
    }
    static gpu::RenderResult example(const std::string& text, int finer = 1)
    {
        return picture(text, fs::path(PETRICHOR_SOURCE_DIR) / "data/scenarios", finer);
    }
};

// Balls from smooth to rough: a lamp with a size spreads its highlight, one without is a bright point.
TEST_F(Gallery, AreaLightsHaveTheShapeOfTheirLamps)
{
    const std::string text = read_example("data/scenarios/area-lights.toml");
    // On a ball of plastic and one of metal.
    const auto brightest = [](const gpu::RenderResult& r, int left) {
        float most = 0.0f;
        for (int y = 62; y < 79; ++y)
            for (int x = left; x < left + 16; ++x) most = std::max(most, luminance(pixel(r, x, y)));
        return most;
    };
    const gpu::RenderResult shaped = example(text);
    const gpu::RenderResult points = example(with(text, "area = \"ltc\"", "area = \"off\""));
    for (const int left : {42, 104}) {
        std::printf("  brightest of a ball: %.0f cd/m2 with a size, %.0f of points\n",
                    static_cast<double>(brightest(shaped, left)), static_cast<double>(brightest(points, left)));
        EXPECT_GT(brightest(points, left), 1.1f * brightest(shaped, left));
    }
}

// Redder than the standard model where the light ends, and not where it falls straight.
TEST_F(Gallery, SkinIsRedWhereTheLightEnds)
{
    const std::string text = read_example("data/scenarios/skin.toml");
    const gpu::RenderResult skin = example(text);
    const gpu::RenderResult plain =
        example(with(text, "lighting_model = \"skin\"", "lighting_model = \"standard\""));
    const auto redness = [](const gpu::RenderResult& r, int x, int y) {
        const glm::vec3 c = pixel(r, x, y);
        return c.g > 0.0f ? c.r / c.g : 1.0f;
    };
    float most = 0.0f;
    int redder = 0, head = 0;
    for (int y = 20; y < 60; ++y) {
        for (int x = 64; x < 98; ++x) {
            if (redness(plain, x, y) < 1.15f) continue;  // behind the head
            const float more = redness(skin, x, y) / redness(plain, x, y);
            most = std::max(most, more);
            redder += more > 1.2f ? 1 : 0;
            ++head;
        }
    }
    std::printf("  %d pixels of the head, %d redder, most %.2f times\n", head, redder, static_cast<double>(most));
    ASSERT_GT(head, 500);
    EXPECT_GT(most, 1.4f);
    EXPECT_GT(redder, head / 50);
    EXPECT_LT(redder, head - head / 4);
}

// Each surface of one's own is seen: without them all, what has one looks different.
TEST_F(Gallery, EverySurfaceOfOnesOwnIsSeen)
{
    const std::string text = read_example("data/scenarios/custom-surfaces.toml");
    std::string plain;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with("surface")) plain += line + "\n";
    }
    const gpu::RenderResult all = example(text), none = example(plain);
    struct Place {
        const char* name;
        int left, top, right, low;
    };
    for (const Place& p : {Place{"urn: embers", 30, 25, 43, 40}, Place{"bust: moss", 75, 13, 88, 36},
                           Place{"ring: rust", 116, 22, 133, 38}, Place{"ball 1: embers", 6, 60, 26, 80},
                           Place{"ball 2: moss", 32, 60, 52, 80}, Place{"ball 4: rust", 85, 60, 104, 80},
                           Place{"ball 5: rust", 112, 60, 131, 80}, Place{"floor: swept", 0, 82, 160, 90}}) {
        int changed = 0;
        for (int y = p.top; y < p.low; ++y) {
            for (int x = p.left; x < p.right; ++x) {
                const float a = luminance(pixel(all, x, y)), b = luminance(pixel(none, x, y));
                changed += std::abs(a - b) > 0.08f * std::max(a, b) ? 1 : 0;
            }
        }
        EXPECT_GT(changed, 12) << p.name;
    }
}

// The three fractals of the example stand in every variant of it, take snow, and the bulb's power shrinks over the film.
TEST_F(Gallery, FractalsTakeTheWeather)
{
    Scenario scenario = parse_scenario(
        with(read_example("data/scenarios/fractals.toml"), "[output]\n",
             "[output]\nwidth = 160\nheight = 90\nsamples = 1\naovs = [\"material\", \"snow\", \"film\"]\n"),
        "s.toml");
    scenario.folder = fs::path(PETRICHOR_SOURCE_DIR) / "data/scenarios";
    Sequence sequence = make_sequence(std::move(scenario));
    load_sequence_scene(sequence, 2);
    ASSERT_EQ(sequence.scene.shapes.size(), 3u);
    RenderRequest request;
    RenderReport report;
    gpu::Renderer own = sequence_renderer(sequence, request, report);
    const auto shot = [&](int frame, const char* variant) {
        return own.render(frame_at(sequence, {frame, variant, ""}).frame);
    };
    // Pixels of a shape, and the mean of a label over them.
    const auto seen = [&](const gpu::RenderResult& r, std::size_t shape, const char* label) {
        int pixels = 0;
        float sum = 0.0f;
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                if (gpu::aov(r, "material", x, y) != static_cast<float>(sequence.scene.shapes[shape].material)) continue;
                ++pixels;
                sum += gpu::aov(r, label, x, y);
            }
        }
        return std::make_pair(pixels, pixels > 0 ? sum / static_cast<float>(pixels) : 0.0f);
    };
    const gpu::RenderResult dry = shot(0, "dry"), rain = shot(0, "rain"), snow = shot(0, "snow");
    for (std::size_t i = 0; i < 3; ++i) {
        const auto [pixels, none] = seen(dry, i, "snow");
        std::printf("  %s: %d pixels, snow %.2f, film %.2f\n", sequence.scene.shapes[i].name.c_str(), pixels,
                    static_cast<double>(seen(snow, i, "snow").second), static_cast<double>(seen(rain, i, "film").second));
        EXPECT_GT(pixels, 150);
        EXPECT_LT(none, 0.02f);
        EXPECT_EQ(seen(rain, i, "film").first, pixels);
        EXPECT_GT(seen(snow, i, "snow").first, pixels / 2) << "snow on the ground reaches up to it";
        EXPECT_GT(seen(snow, i, "snow").second, 0.05f);
        EXPECT_LT(seen(snow, i, "snow").second, 0.9f) << "not from below";
        EXPECT_GT(seen(rain, i, "film").second, 0.05f);
    }
    const gpu::RenderResult late = shot(23, "dry");
    int bulb = 0, sponge = 0;
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            const float before = gpu::aov(dry, "material", x, y), after = gpu::aov(late, "material", x, y);
            const auto of = [&](std::size_t shape) { return static_cast<float>(sequence.scene.shapes[shape].material); };
            bulb += before != after && (before == of(0) || after == of(0));
            sponge += before != after && (before == of(1) || after == of(1)) && before != of(0) && after != of(0);
        }
    }
    EXPECT_GT(bulb, 100) << "its form changes";
    EXPECT_EQ(sponge, 0) << "what rests does not";
}

// Image effects beside off: occlusion takes skylight where balls and plinths stand, nowhere adds any, and leaves the
// middle of the wall alone.
TEST_F(Gallery, OcclusionDarkensWhereThingsMeet)
{
    const std::string text =
        "[scene]\nfile = \"demo:stage\"\n[lights]\nlamps = \"off\"\n[sky]\ncloud_cover = 1.0\n"
        "[weather]\nkeys = [{ time_s = 0.0, temperature_c = 20.0, rainfall = 0.0 }]\n"
        "[render]\nindirect = \"ambient\"\nambient_occlusion = true\n[output]\nframes = 1\n";
    const gpu::RenderResult on = example(text);
    const gpu::RenderResult off = example(with(text, "occlusion = true", "occlusion = false"));
    int darker = 0;
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            const float a = luminance(pixel(on, x, y)), b = luminance(pixel(off, x, y));
            darker += a < 0.9f * b ? 1 : 0;
            EXPECT_LT(a, 1.02f * b + 1.0f) << x << " " << y;
        }
    }
    std::printf("  %d of %d pixels are darker\n", darker, kWidth * kHeight);
    EXPECT_GT(darker, kWidth * kHeight / 200);
    EXPECT_LT(darker, kWidth * kHeight / 3);
    EXPECT_GT(luminance(pixel(on, 110, 12)), 0.9f * luminance(pixel(off, 110, 12)));
}

// Mean light of far grass under the example's sun at that height; near: in a fine picture, which shows the stalks.
float light_of_grass(const std::string& example, const char* elevation, bool near)
{
    std::string text = with(example, "elevation_degrees = 25.0", std::string("elevation_degrees = ") + elevation);
    text = with(text, "[camera]\n", "[camera]\nev100 = 14.0\nbloom = 0.0\n");
    text = with(text, "position_m = [-1.0, 2.2, -8.0], look_at_m = [-3.6, 2.6, 4.0], fov_degrees = 45.0",
                std::string("position_m = [30.0, 25.0, 10.0], look_at_m = [30.0, -0.2, 35.0], fov_degrees = ") +
                    (near ? "3.0" : "45.0"));
    const gpu::RenderResult seen = Gallery::example(text, near ? kFiner : 1);
    const int half_x = near ? seen.width / 2 : 4, half_y = near ? seen.height / 2 : 3;
    double sum = 0.0;
    for (int y = seen.height / 2 - half_y; y < seen.height / 2 + half_y; ++y) {
        for (int x = seen.width / 2 - half_x; x < seen.width / 2 + half_x; ++x)
            sum += static_cast<double>(luminance(pixel(seen, x, y)));
    }
    return static_cast<float>(sum / (4.0 * half_x * half_y));
}

// Slopes that are too small to see take light from each other: the length of their mean normal from a high sun,
// less from a low one and the sky. Plain means know nothing of it.
TEST_F(Gallery, FilteredTexturesAreAsBrightAsWhatTheyStandFor)
{
    const std::string text = read_example("data/scenarios/texture-filtering.toml");
    const std::string plain = with(text, "texture_rule = \"picture\"", "texture_rule = \"none\"");
    double of_filtered = 0.0, of_plain = 0.0;
    for (const char* elevation : {"45.0", "65.0"}) {
        const float truth = light_of_grass(plain, elevation, true);
        const float filtered = light_of_grass(text, elevation, false);
        const float means = light_of_grass(plain, elevation, false);
        std::printf("  sun at %s: %.0f near, %.0f filtered, %.0f plain\n", elevation,
                    static_cast<double>(truth), static_cast<double>(filtered), static_cast<double>(means));
        EXPECT_NEAR(filtered / truth, 1.0f, 0.1f);
        of_filtered += std::pow(static_cast<double>(filtered / truth) - 1.0, 2.0);
        of_plain += std::pow(static_cast<double>(means / truth) - 1.0, 2.0);
    }
    EXPECT_LT(of_filtered, 0.25 * of_plain);
}

// Floor and wall hold the light of the sky, less of it where they meet what stands there; the sun is of the frame.
TEST_F(Gallery, BakedLightLiesBesideTheSun)
{
    const Workplace place("gallery_baked");
    const std::string text = read_example("docs/pictures/baked.toml");
    Scenario scenario = parse_scenario(text, "s.toml");
    scenario.folder = place.path();
    scenario.materials.clear();
    Sequence sequence = make_sequence(std::move(scenario));
    load_sequence_scene(sequence, 2);
    BakeConditions sunny;
    sunny.sky_lux = 14000.0;
    sunny.sun_lux = 90000.0;
    sunny.sun_elevation_degrees = 38.0;
    sunny.sun_azimuth_degrees = 130.0;
    sunny.indirect = true;
    scene::BakeOptions options;
    options.size = 128;
    options.rays = 32;
    std::vector<std::string> notes;
    write_light_maps(place / "maps", sequence.scene, bake_light(sequence.scene, sunny, {}, options, notes));
    const gpu::RenderResult lit =
        picture(with(text, "[output]\n", "[output]\naovs = [\"baked_light\"]\n"), place.path());
    const auto baked = [&](int x, int y) { return gpu::aov(lit, "baked_light", x, y, 1); };
    EXPECT_GT(baked(12, 84), 0.0f);
    EXPECT_EQ(baked(80, 40), 0.0f) << "the plinth has none";
    // The least and the most of the floor's row in front of the plinths.
    float least = 1e9f, most = 0.0f, dark = 1e9f, bright = 0.0f;
    for (int y = 56; y < 86; ++y) {
        for (int x = 4; x < kWidth - 4; ++x) {
            if (!(baked(x, y) > 0.0f)) continue;
            least = std::min(least, baked(x, y));
            most = std::max(most, baked(x, y));
            dark = std::min(dark, luminance(pixel(lit, x, y)));
            bright = std::max(bright, luminance(pixel(lit, x, y)));
        }
    }
    std::printf("  baked %.2f to %.2f, seen %.0f to %.0f cd/m2\n", static_cast<double>(least),
                static_cast<double>(most), static_cast<double>(dark), static_cast<double>(bright));
    EXPECT_LT(least, 0.75f * most);
    EXPECT_LT(dark, 0.4f * bright) << "the sun throws shadows";
}

}  // namespace
}  // namespace petrichor::film
