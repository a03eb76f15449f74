// A leaf with everything: cut out, seen from both sides, with a relief and two sets of textures.
#include <algorithm>
#include <cmath>
#include <functional>

#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

class Cutout : public GpuTest {};

Texture texture_of(const std::function<glm::ivec4(int, int)>& texel)
{
    Texture texture;
    texture.name = "made up";
    texture.format = TexelFormat::Rgba8Unorm;
    texture.width = texture.height = 64;
    texture.mips.emplace_back();
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            for (int c = 0; c < 4; ++c)
                texture.mips[0].push_back(static_cast<std::byte>(texel(x, y)[c]));
        }
    }
    return texture;
}

// The left half of the texture is a hole; of the right half, the upper part is of the second set.
std::vector<Texture> textures()
{
    return {texture_of([](int x, int) { return glm::ivec4(255, 255, 255, x < 32 ? 0 : 255); }),
            texture_of([](int, int y) { return glm::ivec4(y < 32 ? 0 : 255); }),
            texture_of([](int, int) { return glm::ivec4(0); })};
}

Material leaf()
{
    Material m = plain_material(glm::vec3(0.9f, 0.05f, 0.05f));
    m.base_color_texture.texture = 0;
    m.alpha_mode = AlphaMode::Mask;
    m.double_sided = true;
    m.second.use = scene::SecondSetUse::Mix;
    m.second.mix_mask.texture = 1;
    m.second.color = glm::vec3(0.05f, 0.05f, 0.9f);
    return m;
}

Scene standing(const Material& material)
{
    return scene_of({quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0})}, {material});
}

Frame seen_from(const glm::vec3& eye, SurfacePath path = SurfacePath::Fragment)
{
    Frame frame;
    frame.camera = look(eye, {0, 0, 0}, 0.9f);
    frame.settings.width = frame.settings.height = 64;
    frame.settings.samples = 1;
    frame.settings.surface_path = path;
    frame.settings.aovs = {"base_color", "normal", "depth"};
    return frame;
}

bool there(const RenderResult& r, int x, int y)
{
    return std::isfinite(aov(r, "depth", x, y));
}

TEST_F(Cutout, IsSeenFromBothSidesWithBothSets)
{
    renderer->load(standing(leaf()), textures());
    for (const SurfacePath path : {SurfacePath::Fragment, SurfacePath::Visibility}) {
        for (const float side : {1.0f, -1.0f}) {
            const RenderResult r = renderer->render(seen_from({0, 0, 3.0f * side}, path));
            const int leafy = side > 0 ? 42 : 22, hole = side > 0 ? 22 : 42;
            EXPECT_TRUE(there(r, leafy, 32)) << side;
            EXPECT_FALSE(there(r, hole, 32)) << side;
            // v grows upwards here: the mask of the first set lies above.
            EXPECT_GT(aov(r, "base_color", leafy, 24, 0), 0.5f) << side;
            EXPECT_GT(aov(r, "base_color", leafy, 40, 2), 0.5f) << side;
            EXPECT_NEAR(aov(r, "normal", leafy, 32, 2), side, 0.01f) << "towards the eye";
        }
    }
}

// A tree of alpha as a texture has it: a triangle, and smaller levels that are its means.
Texture drawn_tree()
{
    Texture texture = texture_of([](int x, int y) { return glm::ivec4(255, 255, 255, std::abs(2 * x - 63) < y ? 255 : 0); });
    for (int side = 32; side >= 1; side /= 2) {
        const std::vector<std::byte> finer = texture.mips.back();
        std::vector<std::byte>& level = texture.mips.emplace_back();
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; ++x) {
                for (std::size_t c = 0; c < 4; ++c) {
                    int sum = 0;
                    for (int k = 0; k < 4; ++k)
                        sum += static_cast<int>(finer[4 * static_cast<std::size_t>((2 * y + k / 2) * 2 * side + 2 * x + k % 2) + c]);
                    level.push_back(static_cast<std::byte>((sum + 2) / 4));
                }
            }
        }
    }
    return texture;
}

// Five pixels high and of sixteen samples it is the same on both surface paths: samples share the footprint of their pixel where
// holes are cut, too.
TEST_F(Cutout, IsCutAsFinelyOnBothPaths)
{
    Material m = plain_material(glm::vec3(0.0f), 0.9f, 1.0f);  // black, whatever the light
    m.base_color_texture.texture = 0;
    m.alpha_mode = AlphaMode::Mask;
    m.double_sided = true;
    std::vector<std::vector<float>> trees;
    for (const SurfacePath path : {SurfacePath::Fragment, SurfacePath::Visibility}) {
        const auto seen = [&](const glm::vec3& corner) {
            renderer->load(scene_of({quad(corner, {2, 0, 0}, {0, 2, 0})}, {m}), {drawn_tree()});
            Frame frame = seen_from({0, 0, 26.0f}, path);
            frame.settings.samples = 16;
            frame.settings.aovs = {};
            frame.fog.mode = FogMode::Off;
            return renderer->render(frame);
        };
        const RenderResult with = seen({-1, -1, 0}), without = seen({-1, -1, 60});
        // How many pixels of each row it hides.
        std::vector<float>& rows = trees.emplace_back();
        for (int y = 0; y < 64; ++y) {
            float& hidden = rows.emplace_back(0.0f);
            for (int x = 0; x < 64; ++x) hidden += 1.0f - luminance(pixel(with, x, y)) / luminance(pixel(without, x, y));
        }
    }
    EXPECT_GT(*std::max_element(trees[0].begin(), trees[0].end()), 3.0f);
    for (std::size_t y = 0; y < 64; ++y) EXPECT_NEAR(trees[1][y], trees[0][y], 0.1f) << y;
}

// Seen aslant, the hole in the relief is seen where the relief is, on both surface paths.
TEST_F(Cutout, HolesLieInTheRelief)
{
    Material m = leaf();
    m.second.use = scene::SecondSetUse::None;
    m.weather.height.texture = 2;  // 0.3 m below the quad everywhere
    m.weather.height_scale_m = 0.3f;
    const auto edge = [&](scene::Parallax parallax, SurfacePath path) {
        m.weather.parallax = parallax;
        renderer->load(standing(m), textures());
        const RenderResult r = renderer->render(seen_from({2.0f, 0, 2.4f}, path));
        int x = 0;  // where the leaf begins
        while (x < 64 && !there(r, x, 32)) ++x;
        return x;
    };
    const int flat = edge(scene::Parallax::None, SurfacePath::Fragment);
    EXPECT_NEAR(edge(scene::Parallax::None, SurfacePath::Visibility), flat, 1);
    for (const auto parallax : {scene::Parallax::Simple, scene::Parallax::Occlusion}) {
        const int sunk = edge(parallax, SurfacePath::Fragment);
        EXPECT_GT(std::abs(sunk - flat), 2);
        EXPECT_NEAR(edge(parallax, SurfacePath::Visibility), sunk, 1);
    }
}

// A height map whose sampler ends at its edges ends the relief there: a quad has its silhouette, on both surface paths and in its
// shadow. One that repeats goes on.
TEST_F(Cutout, AReliefThatEndsHasItsOwnSilhouette)
{
    Material m = plain_material(glm::vec3(0.5f));
    m.alpha_mode = AlphaMode::Mask;
    m.weather.height.texture = 2;  // 0.3 m below the quad everywhere
    m.weather.height_scale_m = 0.3f;
    m.weather.parallax = scene::Parallax::Occlusion;
    const auto ends = [&](bool u, bool v) {
        std::vector<Texture> all = textures();
        all[2].wrap_u = u ? Wrap::Clamp : Wrap::Repeat;
        all[2].wrap_v = v ? Wrap::Clamp : Wrap::Repeat;
        return all;
    };
    const auto seen = [&](bool u, bool v, SurfacePath path) {
        renderer->load(standing(m), ends(u, v));
        const RenderResult r = renderer->render(seen_from({2.0f, 0, 2.4f}, path));
        int count = 0;
        for (int x = 0; x < 64; ++x) count += there(r, x, 32) ? 1 : 0;
        return count;
    };
    for (const SurfacePath path : {SurfacePath::Fragment, SurfacePath::Visibility}) {
        const int all = seen(false, false, path);
        EXPECT_EQ(seen(false, true, path), all) << "no row is beyond it in the middle";
        EXPECT_LT(seen(true, true, path), all - 2);
        EXPECT_GT(seen(true, true, path), all / 2);
        EXPECT_NEAR(seen(true, true, path), seen(true, false, SurfacePath::Fragment), 1);
    }
    m.alpha_mode = AlphaMode::Opaque;
    EXPECT_EQ(seen(true, true, SurfacePath::Fragment), seen(false, false, SurfacePath::Fragment)) << "what has no holes stays whole";
    m.alpha_mode = AlphaMode::Mask;
    const auto shadow_m = [&](bool u) {
        renderer->load(scene_of({quad({-3, 0, 3}, {6, 0, 0}, {0, 0, -6}, 1), quad({-1, 1, 1}, {2, 0, 0}, {0, 0, -2})},
                                {m, plain_material(glm::vec3(0.8f))}),
                       ends(u, u));
        Frame frame;
        frame.camera = look({-1, 5, 0}, {-1, 0, 0});  // the floor from x -2.5 to 0.5
        frame.camera.orthographic_height_m = 3.0f;
        frame.settings.width = frame.settings.height = 96;
        frame.settings.samples = 1;
        frame.settings.image_based_light = false;
        frame.settings.exposure = 1.0f;
        frame.weather.visibility_m = 1e9f;
        frame.sky.sun_elevation_rad = 0.7853982f;
        frame.sky.sun_azimuth_rad = 1.5707963f;
        const RenderResult r = renderer->render(frame);
        float bright = 0.0f;
        for (int x = 0; x < 40; ++x) bright = std::max(bright, pixel(r, x, 48).g);
        int dark = 0;  // left of the quad itself
        for (int x = 0; x < 46; ++x) dark += pixel(r, x, 48).g < 0.5f * bright ? 1 : 0;
        return 3.0f * static_cast<float>(dark) / 96.0f;
    };
    const float grazing = 1.0f - std::sqrt(0.5f);
    EXPECT_NEAR(shadow_m(false) - shadow_m(true), 0.3f * (1.0f - grazing * grazing), 0.07f);
}

// A lattice over a floor under a slanted light: its shadow begins where the light meets the relief, which lies 0.3 m
// below the lattice everywhere.
TEST_F(Cutout, ShadowsHaveTheHolesOfTheRelief)
{
    Material m = leaf();
    m.second.use = scene::SecondSetUse::None;
    m.weather.height.texture = 2;
    m.weather.height_scale_m = 0.3f;
    constexpr int kSide = 128;
    const auto edge = [&](scene::Parallax parallax, bool lamp) {
        m.weather.parallax = parallax;
        renderer->load(scene_of({quad({-3, 0, 3}, {6, 0, 0}, {0, 0, -6}, 1),
                                 quad({-1, 1, 1}, {2, 0, 0}, {0, 0, -2})},
                                {m, plain_material(glm::vec3(0.8f))}),
                       textures());
        Frame frame;
        // Two metres of the floor, beside the lattice: x from -2 to 0.
        frame.camera = look({-1, 5, 0}, {-1, 0, 0});
        frame.camera.orthographic_height_m = 2.0f;
        frame.settings.width = frame.settings.height = kSide;
        frame.settings.samples = 1;
        frame.settings.image_based_light = false;
        frame.settings.exposure = 1.0f;
        frame.weather.visibility_m = 1e9f;
        frame.sky.sun_elevation_rad = 0.7853982f;
        frame.sky.sun_azimuth_rad = 1.5707963f;
        if (lamp) {
            frame.sky.sun_elevation_rad = -1.0f;
            Light light;
            light.position_m = {6, 7, 0};  // 45 degrees at the edge of the hole
            light.intensity = 1e5f;
            frame.extra_lights = {light};
        }
        const RenderResult r = renderer->render(frame);
        // Where the row in the middle turns dark, metres, from light that comes through the hole.
        int x = 56;
        const float bright = pixel(r, x, kSide / 2).g;
        EXPECT_GT(bright, 0.0f);
        while (x < kSide && pixel(r, x, kSide / 2).g > 0.5f * bright) ++x;
        return -2.0f + 2.0f * static_cast<float>(x) / kSide;
    };
    // Reach of a ray at 45 degrees, shortened as parallax shortens it.
    const float grazing = 1.0f - std::sqrt(0.5f);
    const float shift = 0.3f * (1.0f - grazing * grazing);
    for (const bool lamp : {false, true}) {
        const float flat = edge(scene::Parallax::None, lamp);
        EXPECT_NEAR(flat, -1.0f, lamp ? 0.1f : 0.04f);
        for (const auto parallax : {scene::Parallax::Simple, scene::Parallax::Occlusion})
            EXPECT_NEAR(edge(parallax, lamp) - flat, shift, lamp ? 0.1f : 0.04f) << lamp;
    }
}

}  // namespace
}  // namespace petrichor::gpu
