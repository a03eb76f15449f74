// Ground seen at a low angle by one sample: by a sampler that looks several times along what is foreshortened, as devices with samplers of
// their own have it, and without, as on a CPU.
#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

constexpr int kWidth = 96, kHeight = 48;
constexpr int kSide = 256;

// Grains of one texel, and levels that are their means.
Texture grains()
{
    std::mt19937 numbers{11};
    Texture texture;
    texture.name = "grains";
    texture.width = texture.height = kSide;
    std::vector<float> level(kSide * kSide);
    for (float& v : level) v = (numbers() & 1u) != 0 ? 230.0f : 20.0f;
    for (int side = kSide; side > 0; side /= 2) {
        texture.mips.emplace_back();
        for (const float v : level) {
            const auto code = static_cast<std::byte>(std::lround(v));
            texture.mips.back().insert(texture.mips.back().end(), {code, code, code, std::byte{255}});
        }
        std::vector<float> half(static_cast<std::size_t>(side * side / 4));
        for (int y = 0; y < side / 2; ++y) {
            for (int x = 0; x < side / 2; ++x) {
                const auto at = [&](int u, int v) { return level[static_cast<std::size_t>(v * side + u)]; };
                half[static_cast<std::size_t>(y * (side / 2) + x)] =
                    0.25f * (at(2 * x, 2 * y) + at(2 * x + 1, 2 * y) + at(2 * x, 2 * y + 1) + at(2 * x + 1, 2 * y + 1));
            }
        }
        level = std::move(half);
    }
    return texture;
}

// The ground, a sixth to a tenth as long as wide in a pixel.
std::vector<float> seen(int anisotropy, int samples)
{
    Renderer renderer(RendererOptions{.device = "", .validation = true, .texture_anisotropy = anisotropy});
    Material m = plain_material(glm::vec3(1.0f), 1.0f);
    m.unlit = true;
    m.base_color_texture.texture = 0;
    Primitive ground = quad({-16, 0, 16}, {32, 0, 0}, {0, 0, -32});
    for (glm::vec2& uv : ground.uv0) uv *= 12.0f;
    Scene scene = scene_of({ground}, {m});
    scene.textures.resize(1);
    renderer.load(scene, {grains()});
    Frame frame;
    frame.camera = look({0, 1, 12}, {0, 0, 4}, 0.12f);
    frame.settings.width = kWidth;
    frame.settings.height = kHeight;
    frame.settings.samples = samples;
    frame.settings.exposure = 1.0f;
    frame.weather.visibility_m = 1e9f;
    const RenderResult r = renderer.render(frame);
    for (const std::string& message : renderer.validation_messages()) ADD_FAILURE() << message;
    std::vector<float> picture;
    for (int y = 4; y < kHeight - 4; ++y) {
        for (int x = 4; x < kWidth - 4; ++x) picture.push_back(pixel(r, x, y).g);
    }
    return picture;
}

// Root of the mean square of differences from the mean, as a share of that.
float contrast(const std::vector<float>& picture)
{
    double mean = 0.0, square = 0.0;
    for (const float v : picture) mean += static_cast<double>(v) / static_cast<double>(picture.size());
    for (const float v : picture) square += std::pow(static_cast<double>(v) / mean - 1.0, 2.0) / static_cast<double>(picture.size());
    return static_cast<float>(std::sqrt(square));
}

float apart(const std::vector<float>& a, const std::vector<float>& b)
{
    double square = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) square += std::pow(static_cast<double>(a[i] - b[i]), 2.0) / static_cast<double>(a.size());
    return static_cast<float>(std::sqrt(square));
}

TEST(StretchedSampling, GroundIsAsSharpAsItsMean)
{
    if (!testing_device::device_is_there()) return;
    const std::vector<float> truth = seen(1, 256);
    const float whole = contrast(truth), square = contrast(seen(1, 1)), stretched = contrast(seen(8, 1));
    RecordProperty("contrast", std::to_string(whole) + " " + std::to_string(square) + " " + std::to_string(stretched));
    EXPECT_LT(square, 0.5f * whole);
    EXPECT_NEAR(stretched, whole, 0.35f * whole);
    // Not sharp alone, but nearer to the mean. That samples shorten less is a matter of the formula (Footprint.ASamplerThatIs..):
    // lavapipe's own filter is as wide whatever gradients it is given.
    EXPECT_LT(apart(seen(8, 1), truth), 0.7f * apart(seen(1, 1), truth));
}

}  // namespace
}  // namespace petrichor::gpu
