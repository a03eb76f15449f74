// Which part of the sky's cube a picture reads.
#include "gpu/passes/sky/seen_sky.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <random>
#include <set>

#include "gpu/frame/view.h"

namespace petrichor::gpu {
namespace {

using Tiles = std::set<std::uint32_t>;

shared::FrameConstants looking(const glm::vec3& toward, float fov_rad, int width, int height,
                               const glm::vec2& jitter = glm::vec2(0.0f), const glm::vec2& lens_m = glm::vec2(0.0f))
{
    Camera camera;
    const glm::vec3 eye(3.0f, 1.7f, -2.0f);
    camera.to_world = glm::inverse(glm::lookAt(eye, eye + toward, glm::vec3(0.0f, 1.0f, 0.0f)));
    camera.vertical_fov_rad = fov_rad;
    shared::FrameConstants c{};
    set_camera(c, camera, width, height, jitter, {}, lens_m, 2.0f);
    c.size = {width, height};
    return c;
}

glm::vec3 ray_of(const shared::FrameConstants& c, const glm::vec2& pixel)
{
    return glm::normalize(c.ray_corner + c.ray_dx * pixel.x + c.ray_dy * pixel.y);
}

// Faces as Vulkan's specification has them, 16.5.3: largest part, then s and t.
struct Place {
    int face;
    glm::vec2 texel;
};
Place place_of(const glm::vec3& d)
{
    const glm::vec3 a = glm::abs(d);
    int face = 0;
    glm::vec2 st;
    if (a.z >= a.x && a.z >= a.y) {
        face = d.z >= 0.0f ? 4 : 5;
        st = glm::vec2(d.z >= 0.0f ? d.x : -d.x, -d.y) / a.z;
    } else if (a.y >= a.x) {
        face = d.y >= 0.0f ? 2 : 3;
        st = glm::vec2(d.x, d.y >= 0.0f ? d.z : -d.z) / a.y;
    } else {
        face = d.x >= 0.0f ? 0 : 1;
        st = glm::vec2(d.x >= 0.0f ? -d.z : d.z, -d.y) / a.x;
    }
    return {face, (st * 0.5f + 0.5f) * static_cast<float>(kSkyCubeSide)};
}

std::uint32_t tile_of(const glm::vec3& d)
{
    const Place p = place_of(d);
    const auto tile = [](float x) {
        return std::clamp(static_cast<int>(std::floor(x / static_cast<float>(kSkyTile))), 0, kSkyTilesAcross - 1);
    };
    return sky_tile(p.face, tile(p.texel.y), tile(p.texel.x));
}

// What lies between texels reads those around it, over edges of the cube too: two texels' width to each side.
void expect_read(const Tiles& tiles, const glm::vec3& d)
{
    const glm::vec3 side = glm::normalize(glm::cross(d, std::abs(d.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0)));
    const glm::vec3 other = glm::cross(d, side);
    // A quarter turn has 384 texels; in the middle of a face they are the widest.
    const float width = 4.0f / static_cast<float>(kSkyCubeSide);
    for (int i = 0; i < 8; ++i) {
        const float turn = 0.785398f * static_cast<float>(i);
        const glm::vec3 around = glm::normalize(d + width * (side * std::cos(turn) + other * std::sin(turn)));
        ASSERT_EQ(tiles.count(tile_of(around)), 1u) << d.x << " " << d.y << " " << d.z;
    }
}

Tiles tiles_of(const std::vector<shared::FrameConstants>& views, bool horizon = false)
{
    const auto seen = seen_sky(views, horizon);
    Tiles tiles(seen.begin(), seen.end());
    EXPECT_EQ(tiles.size(), seen.size());
    return tiles;
}

TEST(SeenSky, HasAllThatAnyPixelReads)
{
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    for (int n = 0; n < 60; ++n) {
        const glm::vec3 toward = glm::normalize(glm::vec3(unit(random), unit(random), unit(random)) - 0.5f);
        if (std::abs(toward.y) > 0.99f) continue;
        const int width = 2 + static_cast<int>(unit(random) * 1300.0f);
        const int height = 2 + static_cast<int>(unit(random) * 800.0f);
        const auto view = looking(toward, 0.1f + 2.0f * unit(random), width, height,
                                  {unit(random) - 0.5f, unit(random) - 0.5f});
        const Tiles tiles = tiles_of({view});
        for (int k = 0; k < 300; ++k) {
            // Edges and corners most of all.
            glm::vec2 share = glm::clamp(glm::vec2(unit(random), unit(random)) * 1.6f - 0.3f, 0.0f, 1.0f);
            expect_read(tiles, ray_of(view, share * glm::vec2(width, height)));
        }
    }
}

TEST(SeenSky, HasWhatAnySampleOfALensReads)
{
    std::vector<shared::FrameConstants> views;
    for (const float x : {-0.2f, 0.0f, 0.2f}) views.push_back(looking({0.3f, 0.4f, 1.0f}, 0.6f, 320, 180, {}, {x, 0.1f}));
    const Tiles tiles = tiles_of(views);
    for (const auto& view : views)
        for (const glm::vec2 share : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(0, 1), glm::vec2(1, 1)})
            expect_read(tiles, ray_of(view, share * glm::vec2(320, 180)));
}

TEST(SeenSky, IsASmallPartOfIt)
{
    constexpr double kAll = 6.0 * kSkyTilesAcross * kSkyTilesAcross;
    std::size_t most = 0;
    for (int i = 0; i < 32; ++i) {
        const float turn = 0.19635f * static_cast<float>(i);
        const float up = 0.15f * static_cast<float>(i % 7) - 0.4f;
        // 36 degrees high, 60 wide: 0.058 of all directions.
        most = std::max(most, tiles_of({looking({std::sin(turn), up, std::cos(turn)}, 0.628f, 1280, 720)}).size());
    }
    EXPECT_LT(static_cast<double>(most), 0.1 * kAll);
}

// Land takes the air of the horizon above it.
TEST(SeenSky, HasTheHorizonOverAllLandThatIsSeen)
{
    std::mt19937 random(9);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    for (const float down : {-0.2f, -0.7f, -3.0f}) {
        const auto view = looking({1.0f, down, 0.6f}, 0.8f, 640, 360);
        const Tiles tiles = tiles_of({view}, true);
        for (int k = 0; k < 500; ++k) {
            const glm::vec3 ray = ray_of(view, glm::vec2(unit(random) * 640.0f, unit(random) * 360.0f));
            if (ray.y < 0.0f) expect_read(tiles, glm::normalize(glm::vec3(ray.x, 0.0f, ray.z)));
        }
    }
}

TEST(SeenSky, IsAllOfItForParallelRays)
{
    Camera camera;
    camera.orthographic_height_m = 4.0f;
    shared::FrameConstants c{};
    set_camera(c, camera, 64, 48, {}, {});
    c.size = {64, 48};
    EXPECT_EQ(tiles_of({c}).count(tile_of(c.forward)), 1u);
}

}  // namespace
}  // namespace petrichor::gpu
