// Windows of a picture: a shifted lens sees the same as the part of a wider picture.
#include "gpu/frame/picture_tile.h"

#include <algorithm>
#include <cmath>

#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

constexpr int kWide = 192, kHigh = 128;

Scene room()
{
    Material glowing = plain_material(glm::vec3(0.1f));
    glowing.emissive = glm::vec3(30.0f, 10.0f, 3.0f);
    Scene scene = scene_of({quad({-8, 0, 4}, {16, 0, 0}, {0, 0, -16}, 0), quad({-2, 0, -3}, {1.4f, 0, 0.4f}, {0, 2.3f, 0}, 1),
                            quad({0.7f, 0, -2}, {0.5f, 0, -0.4f}, {0, 1.1f, 0}, 2), quad({2, 0.2f, -5}, {3, 0, 0}, {0, 4, 0}, 1)},
                           {plain_material({0.5f, 0.4f, 0.3f}), plain_material({0.2f, 0.5f, 0.7f}), glowing});
    Light lamp;
    lamp.kind = LightKind::Point;
    lamp.position_m = {0.3f, 1.7f, -1.2f};
    lamp.intensity = 400.0f;
    scene.lights.push_back(lamp);
    return scene;
}

// Without what looks across the picture.
Frame frame_of(bool orthographic)
{
    Frame frame;
    frame.camera = look({0.4f, 1.5f, 3.0f}, {0.0f, 1.0f, -2.0f}, 0.9f);
    frame.camera.orthographic_height_m = orthographic ? 5.0f : 0.0f;
    frame.camera.shift = {0.1f, -0.2f};
    frame.settings.width = kWide;
    frame.settings.height = kHigh;
    frame.settings.samples = 2;
    frame.settings.adaptive = 0.0f;
    frame.settings.ambient_occlusion = false;
    frame.settings.reflections = false;
    frame.settings.soft_shadows = false;
    frame.settings.exposure = 1e-4f;
    return frame;
}

// The largest difference as a share of the light there.
float difference(const RenderResult& whole, const RenderResult& part, const PictureTile& tile)
{
    float most = 0.0f;
    for (int y = 0; y < tile.height; ++y) {
        for (int x = 0; x < tile.width; ++x) {
            const glm::vec3 a(pixel(whole, tile.x + x, tile.y + y)), b(pixel(part, x, y));
            for (int c = 0; c < 3; ++c) most = std::max(most, std::abs(a[c] - b[c]) / std::max(a[c], 1.0f));
        }
    }
    return most;
}

class PictureTileTest : public GpuTest {};

// Some end within a tile of the passes, wherever that ends.
TEST_F(PictureTileTest, AWindowIsThatPartOfThePicture)
{
    renderer->load(room(), {});
    for (const bool orthographic : {false, true}) {
        Frame frame = frame_of(orthographic);
        const RenderResult whole = renderer->render(frame);
        for (const PictureTile& tile : {PictureTile{0, 0, 96, 64}, PictureTile{96, 0, 96, 64}, PictureTile{64, 64, 128, 64},
                                       PictureTile{0, 0, 106, 60}, PictureTile{64, 32, 97, 93}}) {
            const RenderResult part = renderer->render(frame, tile);
            ASSERT_EQ(part.width, tile.width);
            // Of an edge a sample may fall on the other side.
            std::size_t others = 0;
            for (int y = 0; y < tile.height; ++y) {
                for (int x = 0; x < tile.width; ++x) {
                    const glm::vec3 a(pixel(whole, tile.x + x, tile.y + y)), b(pixel(part, x, y));
                    for (int c = 0; c < 3; ++c) others += std::abs(a[c] - b[c]) > 0.004f * std::max(a[c], 1.0f) ? 1 : 0;
                }
            }
            EXPECT_LE(others, 6u) << orthographic << " " << tile.x << " " << tile.y << ", at most "
                                  << difference(whole, part, tile);
        }
    }
}

// Wind drifts rain below a roof, so far that chance tells it pixel by pixel; the screen's occlusion turns by chance, too.
TEST_F(PictureTileTest, GrainGoesByThePixelOfThePicture)
{
    Scene scene = room();
    scene.meshes[0].primitives.push_back(quad({-3, 2.4f, 1}, {6, 0, 0}, {0, 0, -4}, 0));
    renderer->load(scene, {});
    Frame frame = frame_of(false);
    frame.weather.rain = 1.0f;
    frame.weather.rain_kg_m2_s = 20.0f / 3600.0f;
    frame.weather.film_albedo = frame.weather.film_smoothness = 1.0f;
    frame.weather.air_temperature_k = 285.0f;
    frame.settings.falling = false;
    for (const bool occlusion : {false, true}) {
        frame.settings.ambient_occlusion = occlusion;
        const RenderResult whole = renderer->render(frame);
        const PictureTile tile{64, 32, 128, 96};
        const RenderResult part = renderer->render(frame, tile);
        std::size_t others = 0, pixels = 0;
        for (int y = occlusion ? 48 : 0; y < tile.height; ++y) {  // occlusion looks beyond the window
            for (int x = occlusion ? 48 : 0; x < tile.width; ++x, ++pixels) {
                const glm::vec3 a(pixel(whole, tile.x + x, tile.y + y)), b(pixel(part, x, y));
                others += glm::length(a - b) > 0.01f * std::max(glm::length(a), 1.0f) ? 1 : 0;
            }
        }
        EXPECT_LT(others, pixels / 200) << occlusion;
    }
}

TEST_F(PictureTileTest, ShadowsAreThoseOfThePicture)
{
    renderer->load(room(), {});
    const Frame frame = frame_of(false);
    Frame light = frame;
    light.settings.shadows = false;
    const RenderResult whole = renderer->render(frame), without = renderer->render(light);
    const PictureTile tile{64, 64, 128, 64};
    const RenderResult part = renderer->render(frame, tile);
    double shade = 0.0, apart = 0.0, more = 0.0;
    for (int y = 0; y < tile.height; ++y) {
        for (int x = 0; x < tile.width; ++x) {
            const float a = luminance(pixel(whole, tile.x + x, tile.y + y)), b = luminance(pixel(part, x, y));
            shade += static_cast<double>(std::abs(a - luminance(pixel(without, tile.x + x, tile.y + y))));
            apart += static_cast<double>(std::abs(a - b));
            more += static_cast<double>(b - a);
        }
    }
    EXPECT_GT(shade, 0.0);
    EXPECT_LT(apart, 0.001 * shade);
    EXPECT_LT(std::abs(more), 0.001 * shade);
}

// Depth of field and motion: each sample has a camera of its own.
TEST_F(PictureTileTest, ALensAndAShutterSeeTheSameInAWindow)
{
    renderer->load(room(), {});
    for (const bool moves : {false, true}) {
        Frame frame = frame_of(false);
        frame.settings.samples = 4;
        const RenderResult sharp = renderer->render(frame);
        if (moves) {
            for (int i = 0; i < 4; ++i) {
                frame.shutter.push_back({frame.camera, 0.0, 0.0});
                frame.shutter.back().camera.to_world[3] += glm::vec4(0.04f * static_cast<float>(i), 0.0f, 0.0f, 0.0f);
            }
        } else {
            frame.lens = {0.06f, 3.0f};
        }
        const RenderResult whole = renderer->render(frame);
        const PictureTile tile{64, 32, 128, 96};
        const RenderResult part = renderer->render(frame, tile);
        std::size_t others = 0, blurred = 0;
        for (int y = 0; y < tile.height; ++y) {
            for (int x = 0; x < tile.width; ++x) {
                const glm::vec3 a(pixel(whole, tile.x + x, tile.y + y)), b(pixel(part, x, y)), c(pixel(sharp, tile.x + x, tile.y + y));
                others += glm::length(a - b) > 0.004f * std::max(glm::length(a), 1.0f) ? 1 : 0;
                blurred += glm::length(a - c) > 0.02f * std::max(glm::length(a), 1.0f) ? 1 : 0;
            }
        }
        EXPECT_LE(others, 30u) << moves;
        EXPECT_GT(blurred, 600u) << moves;
    }
}

TEST_F(PictureTileTest, AShiftedLensIsAQuarterOfAWiderPicture)
{
    renderer->load(room(), {});
    Frame frame = frame_of(false);
    frame.settings.shadows = false;  // their maps are those of the camera
    frame.camera.shift = glm::vec2(0.0f);
    const RenderResult whole = renderer->render(frame);
    Frame quarter = frame;
    quarter.camera.vertical_fov_rad = 2.0f * std::atan(0.5f * std::tan(0.45f));
    quarter.camera.shift = {1.0f, 1.0f};
    quarter.settings.width = kWide / 2;
    quarter.settings.height = kHigh / 2;
    const RenderResult part = renderer->render(quarter);
    std::size_t others = 0;
    for (int y = 0; y < kHigh / 2; ++y)
        for (int x = 0; x < kWide / 2; ++x)
            others += glm::length(glm::vec3(pixel(whole, kWide / 2 + x, y)) - glm::vec3(pixel(part, x, y))) >
                              0.004f * std::max(glm::length(glm::vec3(pixel(part, x, y))), 1.0f)
                          ? 1 : 0;
    EXPECT_LE(others, 4u);
}

TEST_F(PictureTileTest, DropsFallInTheSamePlaces)
{
    renderer->load(room(), {});
    Frame frame = frame_of(false);
    frame.weather.rain = 1.0f;
    frame.weather.rain_kg_m2_s = 20.0f / 3600.0f;
    frame.weather.air_temperature_k = 285.0f;
    const RenderResult whole = renderer->render(frame);
    Frame dry = frame;
    dry.settings.falling = false;
    const RenderResult without = renderer->render(dry);
    const PictureTile tile{64, 32, 96, 64};
    const RenderResult part = renderer->render(frame, tile);
    const RenderResult part_without = renderer->render(dry, tile);
    ASSERT_GT(whole.falling.drawn, 100u);
    EXPECT_EQ(part.falling.drawn, whole.falling.drawn);
    double streaks = 0.0, apart = 0.0;
    for (int y = 0; y < tile.height; ++y) {
        for (int x = 0; x < tile.width; ++x) {
            const glm::vec3 a = glm::vec3(pixel(whole, tile.x + x, tile.y + y)) - glm::vec3(pixel(without, tile.x + x, tile.y + y));
            const glm::vec3 b = glm::vec3(pixel(part, x, y)) - glm::vec3(pixel(part_without, x, y));
            streaks += static_cast<double>(glm::length(a));
            apart += static_cast<double>(glm::length(a - b));
        }
    }
    EXPECT_GT(streaks, 0.0);
    EXPECT_LT(apart, 0.02 * streaks);
}

// A floor like a mirror below a wall, a box and something that glows: what stands in it is above the window.
TEST_F(PictureTileTest, MirrorsSeeBeyondTheirWindow)
{
    Scene scene = room();
    scene.materials[0].roughness = 0.05f;
    scene.materials[0].metallic = 1.0f;
    renderer->load(scene, {});
    Frame frame = frame_of(false);
    frame.settings.reflections = true;
    const RenderResult whole = renderer->render(frame);
    const auto around = renderer->look_around(frame);
    ASSERT_NE(around, nullptr);
    for (const PictureTile& tile : {PictureTile{0, 64, 96, 64}, PictureTile{96, 96, 96, 32}, PictureTile{64, 64, 64, 64}}) {
        std::size_t apart[2] = {};
        for (const bool sees : {false, true}) {
            const RenderResult part = renderer->render(frame, tile, sees ? around : nullptr);
            for (int y = 0; y < tile.height; ++y) {
                for (int x = 0; x < tile.width; ++x) {
                    const glm::vec3 a(pixel(whole, tile.x + x, tile.y + y)), b(pixel(part, x, y));
                    apart[sees] += glm::length(a - b) > 0.02f * std::max(glm::length(a), 1.0f) ? 1 : 0;
                }
            }
        }
        // Edges of what is mirrored are those of pixels' middles there.
        EXPECT_LT(apart[1], static_cast<std::size_t>(tile.width * tile.height / 50)) << tile.x << " " << tile.y;
        EXPECT_GT(apart[0], 8 * apart[1]) << tile.x << " " << tile.y;
    }
    frame.settings.reflections = false;
    EXPECT_EQ(renderer->look_around(frame), nullptr);
}

TEST_F(PictureTileTest, AWindowThatBeginsElsewhereIsRefused)
{
    renderer->load(room(), {});
    EXPECT_THROW(renderer->render(frame_of(false), PictureTile{7, 0, 64, 64}), Error);
}

}  // namespace
}  // namespace petrichor::gpu
