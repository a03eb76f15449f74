// A second lobe of a texel: what both mirror is the mix of what each mirrors alone, in every light and weather;
// and a floor of small levels is nearer to what it stands for with two lobes than with one.
#include <array>
#include <cmath>
#include <functional>

#include "formulas/light/second_lobe.h"
#include "formulas/light/two_lobes.h"
#include "tests/gpu/gpu_fixture.h"
#include "texproc/material/chains.h"
#include "texproc/prefilter/prefilter.h"

namespace petrichor::gpu {
namespace {

constexpr int kSize = 40;

std::byte code(float value)
{
    return static_cast<std::byte>(std::lround(255.0f * std::clamp(value, 0.0f, 1.0f)));
}

Texture one_color(std::array<int, 4> texel)
{
    Texture texture;
    texture.name = "one";
    texture.width = texture.height = 1;
    texture.mips.emplace_back();
    for (const int byte : texel) texture.mips[0].push_back(static_cast<std::byte>(byte));
    return texture;
}

scene::TextureUse use_of(int index)
{
    scene::TextureUse use;
    use.texture = index;
    return use;
}

// Codes of two lobes: normal x and y, roughness.
using Codes = std::array<int, 3>;
constexpr Codes kFirst{150, 120, 90}, kSecond{96, 140, 165};
constexpr int kShare = 102;  // 0.4

class TwoLobes : public GpuTest {
protected:
    void SetUp() override
    {
        GpuTest::SetUp();
        frame.camera = look({0, 1.2f, 1.5f}, {0, 0, 0}, 0.7f);
        frame.settings.width = frame.settings.height = kSize;
        frame.settings.samples = 1;
        frame.settings.exposure = 1e-4f;
        frame.settings.ambient_occlusion = false;
        frame.sky.sun_elevation_rad = 0.7f;
        frame.sky.sun_azimuth_rad = 2.9f;
        frame.weather.visibility_m = 1e9f;
    }

    // A plate with the first lobe's normal and roughness, and the second's where `share` is not below 0.
    RenderResult shot(const Codes& first, const Codes& second, int share, float metallic,
                      const std::function<void(Material&)>& change = {})
    {
        Material m = plain_material({0.9f, 0.7f, 0.4f}, 1.0f, metallic);
        m.normal_texture = use_of(0);
        m.metallic_roughness_texture = use_of(1);
        std::vector<Texture> textures{one_color({first[0], first[1], 255, 255}),
                                      one_color({255, first[2], 255, 255})};
        if (share >= 0) {
            m.maps.second_lobe = use_of(2);
            textures.push_back(one_color({second[0], second[1], second[2], share}));
        }
        if (change) change(m);
        Scene scene = scene_of({quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2})}, {m});
        scene.textures.resize(textures.size());
        renderer->load(scene, textures);
        return renderer->render(frame);
    }

    // Both are the same, the second of no share, the first of none: each the picture of one lobe.
    void expect_mix(const char* what, float metallic, float slack, const std::function<void(Material&)>& change = {})
    {
        const RenderResult a = shot(kFirst, kFirst, -1, metallic, change);
        const RenderResult b = shot(kSecond, kSecond, -1, metallic, change);
        const RenderResult both = shot(kFirst, kSecond, kShare, metallic, change);
        const RenderResult twice = shot(kFirst, kFirst, kShare, metallic, change);
        const RenderResult none = shot(kFirst, kSecond, 0, metallic, change);
        const float share = static_cast<float>(kShare) / 255.0f;
        float shown = 0.0f;
        for (int y = 6; y < kSize - 6; y += 3) {
            for (int x = 6; x < kSize - 6; x += 3) {
                const glm::vec3 first = pixel(a, x, y), second = pixel(b, x, y);
                const glm::vec3 mixed = glm::mix(first, second, share);
                EXPECT_LT(glm::length(pixel(both, x, y) - mixed), slack * glm::length(mixed))
                    << what << " at " << x << " " << y;
                EXPECT_LT(glm::length(pixel(twice, x, y) - first), 0.004f * glm::length(first)) << what << ": the same";
                EXPECT_LT(glm::length(pixel(none, x, y) - first), 0.004f * glm::length(first)) << what << ": none";
                shown = std::max(shown, glm::length(first - second) / glm::length(mixed));
            }
        }
        EXPECT_GT(shown, 6.0f * slack) << what << ": one is as the other";
    }
    Frame frame;
};

TEST_F(TwoLobes, MirrorTheSunAndTheSkyAsEachAlone)
{
    expect_mix("sun and sky", 1.0f, 0.02f);
    renderer->set_environment(constant_environment(2000.0f));
    expect_mix("an even sky", 1.0f, 0.02f);
}

TEST_F(TwoLobes, MirrorLampsAsEachAlone)
{
    frame.sky.sun_elevation_rad = -0.5f;
    Light lamp;
    lamp.position_m = {-0.3f, 0.8f, -0.6f};
    lamp.intensity = 4000.0f;
    lamp.range_m = 20.0f;
    frame.extra_lights = {lamp};
    expect_mix("a point", 1.0f, 0.02f);
    frame.extra_lights[0].radius_m = 0.25f;
    expect_mix("a ball", 1.0f, 0.03f);
}

// Below a coat too, and on paint but for what is diffuse, which is lit once by the normal between.
TEST_F(TwoLobes, GoWithCoatsAndPaint)
{
    expect_mix("coat", 1.0f, 0.03f, [](Material& m) {
        m.clearcoat = 0.8f;
        m.clearcoat_roughness = 0.2f;
    });
    expect_mix("paint", 0.0f, 0.04f);
}

// Snow covers both alike; a film of water smooths each as it would alone, and lies itself between their normals.
TEST_F(TwoLobes, LieUnderTheWeatherAsEachAlone)
{
    frame.weather.film_albedo = frame.weather.film_smoothness = 0.7f;
    expect_mix("wet", 1.0f, 0.05f);
    frame.weather.film_albedo = frame.weather.film_smoothness = 0.0f;
    frame.weather.snow_amount = 1.0f;
    const RenderResult one = shot(kFirst, kFirst, -1, 1.0f), two = shot(kFirst, kSecond, kShare, 1.0f);
    for (int i = 8; i < kSize - 8; ++i) {
        const glm::vec3 wanted = pixel(one, i, i);
        EXPECT_LT(glm::length(pixel(two, i, i) - wanted), 0.02f * glm::length(wanted)) << "below snow at " << i;
    }
}

// More materials than the G-buffer has numbers for: all that have a second lobe and nothing else share one.
TEST_F(TwoLobes, AnyNumberOfMaterialsMayHaveThem)
{
    std::vector<Material> materials;
    std::vector<Primitive> quads;
    for (std::uint32_t i = 0; i < 300; ++i) {
        Material m = plain_material({0.9f, 0.7f, 0.4f}, 1.0f, 1.0f);
        m.maps.second_lobe = use_of(0);
        materials.push_back(m);
        quads.push_back(quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, i));
    }
    Scene scene = scene_of(quads, materials);
    scene.textures.resize(1);
    renderer->load(scene, {one_color({128, 128, 120, 128})});
    EXPECT_GT(luminance(pixel(renderer->render(frame), kSize / 2, kSize / 2)), 0.0f);
}

// ---- a tile of dented metal under a camera that moves on ---------------------------------------------------

constexpr int kTile = 128;

Image dents()
{
    Image normals(kTile, kTile, 3, ColorSpace::Data);
    const auto height = [](int x, int y) {
        float h = 0.0f;
        const float step = 6.2831853f / kTile;
        for (int k = 0; k < 12; ++k) {
            const int fx = (k * 7) % 11 - 5, fy = (k * 5) % 13 - 6;
            h += std::sin(step * static_cast<float>(fx * x + fy * y) + 1.7f * static_cast<float>(k)) /
                 (2.0f + std::hypot(static_cast<float>(fx), static_cast<float>(fy)));
        }
        return 3.0f * h;
    };
    for (int y = 0; y < kTile; ++y) {
        for (int x = 0; x < kTile; ++x) {
            const glm::vec3 n = glm::normalize(
                glm::vec3(height(x - 1, y) - height(x + 1, y), height(x, y + 1) - height(x, y - 1), 2.0f));
            for (int c = 0; c < 3; ++c) normals.at(x, y, c) = 0.5f + 0.5f * n[c];
        }
    }
    return normals;
}

// Stripes of two glosses.
Image glosses()
{
    Image roughness(kTile, kTile, 1, ColorSpace::Data);
    for (int y = 0; y < kTile; ++y)
        for (int x = 0; x < kTile; ++x) roughness.at(x, y, 0) = x / 8 % 2 == 0 ? 0.25f : 0.6f;
    return roughness;
}

Texture levels_of(const char* name, int count, const std::function<glm::vec4(int level, std::size_t texel)>& texel)
{
    Texture texture;
    texture.name = name;
    texture.width = texture.height = kTile;
    for (int k = 0; k < count; ++k) {
        const auto side = static_cast<std::size_t>(std::max(kTile >> k, 1));
        auto& mip = texture.mips.emplace_back();
        for (std::size_t i = 0; i < side * side; ++i) {
            const glm::vec4 v = texel(k, i);
            for (int c = 0; c < 4; ++c) mip.push_back(code(v[c]));
        }
    }
    return texture;
}

class TwoLobesOnATile : public TwoLobes {
protected:
    // normal, surface, second lobe where there is one
    std::vector<Texture> textures(const texproc::Prefiltered& chain)
    {
        const int count = static_cast<int>(chain.normal.size());
        std::vector<Texture> all{
            levels_of("normal", count, [&](int k, std::size_t i) {
                const float* n = &chain.normal[static_cast<std::size_t>(k)].pixels[3 * i];
                return glm::vec4(n[0], n[1], n[2], 1.0f);
            }),
            levels_of("surface", count, [&](int k, std::size_t i) {
                return glm::vec4(1.0f, chain.roughness[static_cast<std::size_t>(k)].pixels[i], 1.0f, 1.0f);
            })};
        if (chain.second.share.empty()) return all;
        all.push_back(levels_of("second", count, [&](int level, std::size_t i) {
            const auto k = static_cast<std::size_t>(level);
            const Image& n = k == 0 ? chain.normal[0] : chain.second.normal[k];
            const Image& r = k == 0 ? chain.roughness[0] : chain.second.roughness[k];
            return glm::vec4(n.pixels[3 * i], n.pixels[3 * i + 1], r.pixels[i],
                             k == 0 ? 0.5f : chain.second.share[k].pixels[i]);
        }));
        return all;
    }

    // Frames of a camera that goes on, as a display shows them.
    std::vector<std::vector<float>> film(const std::vector<Texture>& maps, int times, int samples)
    {
        Material m = plain_material({0.9f, 0.8f, 0.6f}, 1.0f, 1.0f);
        m.normal_texture = use_of(0);
        m.metallic_roughness_texture = use_of(1);
        if (maps.size() > 2) m.maps.second_lobe = use_of(2);
        for (scene::TextureUse* use : {&m.normal_texture, &m.metallic_roughness_texture, &m.maps.second_lobe})
            use->scale = glm::vec2(20.0f);
        Scene scene = scene_of({quad({-10, 0, 10}, {20, 0, 0}, {0, 0, -20})}, {m});
        scene.textures.resize(maps.size());
        renderer->load(scene, maps);
        frame.settings.width = kWide * times;
        frame.settings.height = kHigh * times;
        frame.settings.samples = samples;
        std::vector<std::vector<float>> shown;
        for (int f = 0; f < kFrames; ++f) {
            const float way = 0.037f * static_cast<float>(f);
            frame.camera = look({way, 2.0f, 4.0f + 0.5f * way}, {way, 0.0f, 1.2f + 0.5f * way}, 0.5f);
            const RenderResult r = renderer->render(frame);
            auto& picture = shown.emplace_back();
            for (int y = 0; y < kHigh; ++y) {
                for (int x = 0; x < kWide; ++x) {
                    glm::vec3 sum(0.0f);
                    for (int j = 0; j < times * times; ++j)
                        sum += pixel(r, x * times + j % times, y * times + j / times);
                    picture.push_back(luminance(sum) / static_cast<float>(times * times));
                }
            }
        }
        return shown;
    }

    static constexpr int kWide = 96, kHigh = 54, kFrames = 5;
};

struct Error {
    double rmse, flicker;
};

Error error_of(const std::vector<std::vector<float>>& film, const std::vector<std::vector<float>>& truth, float white)
{
    double squares = 0.0, flicker = 0.0;
    const auto show = [&](float light) { return std::pow(std::clamp(light / white, 0.0f, 1.0f), 1.0f / 2.2f); };
    const auto frames = static_cast<double>(film.size());
    for (std::size_t p = 0; p < film[0].size(); ++p) {
        double sum = 0.0, sum2 = 0.0;
        for (std::size_t f = 0; f < film.size(); ++f) {
            const double e = static_cast<double>(show(film[f][p]) - show(truth[f][p]));
            sum += e;
            sum2 += e * e;
        }
        squares += sum2 / frames;
        flicker += std::sqrt(std::max(sum2 / frames - sum * sum / (frames * frames), 0.0));
    }
    const auto pixels = static_cast<double>(film[0].size());
    return {std::sqrt(squares / pixels), flicker / pixels};
}

TEST_F(TwoLobesOnATile, AreNearerToTheTruthThanOneAndThanPlainMips)
{
    const Image normals = dents(), roughness = glosses();
    const auto chain = [&](const char* rule, int lobes) {
        texproc::PrefilterOptions options;
        options.rule = rule;
        options.lobes = lobes;
        options.surface = texproc::SurfaceClass::Metal;
        return texproc::prefilter(normals, roughness, options);
    };
    texproc::Prefiltered plain;
    plain.normal = texproc::plain_levels(normals, "normal", {});
    plain.roughness = texproc::plain_levels(roughness, "scalar", {});
    const std::vector<Texture> truth_maps = textures(plain);
    const auto one_maps = textures(chain("picture", 1)), two_maps = textures(chain("picture", 2));
    for (const float azimuth : {3.0f, 1.4f}) {
        frame.sky.sun_elevation_rad = 0.45f;
        frame.sky.sun_azimuth_rad = azimuth;
        const auto truth = film(truth_maps, 2, 64);
        std::vector<float> sorted = truth[0];
        std::sort(sorted.begin(), sorted.end());
        const float white = sorted[sorted.size() * 97 / 100] / 0.9f;
        const Error mips = error_of(film(truth_maps, 1, 1), truth, white);
        const Error one = error_of(film(one_maps, 1, 1), truth, white);
        const Error two = error_of(film(two_maps, 1, 1), truth, white);
        const auto say = [](const char* name, const Error& e, const Error& plain_error) {
            std::printf("%s: RMSE %.4f (%+.1f %%), flicker %.4f (%+.1f %%)\n", name, e.rmse,
                        100.0 * (e.rmse / plain_error.rmse - 1.0), e.flicker,
                        100.0 * (e.flicker / plain_error.flicker - 1.0));
        };
        say("plain mips", mips, mips);
        say("one lobe", one, mips);
        say("two lobes", two, mips);
        EXPECT_LT(two.rmse, 0.95 * one.rmse);
        EXPECT_LT(two.rmse, 0.9 * mips.rmse);
        EXPECT_LT(two.flicker, 0.97 * one.flicker);
        EXPECT_LT(two.flicker, 0.97 * mips.flicker);
    }
}

}  // namespace
}  // namespace petrichor::gpu
