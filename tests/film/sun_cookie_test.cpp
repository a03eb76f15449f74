// A picture before the sun, from its file to the ground: where it lets light through, its colours, and its
// mean where it is finer than pixels.
#include <filesystem>
#include <unistd.h>

#include "film/scenes/lamps.h"
#include "formulas/light/sun_cookie.h"
#include "tests/gpu/gpu_fixture.h"
#include "texproc/codecs/files/io.h"

namespace petrichor::film {
namespace {

namespace fs = std::filesystem;

class SunCookieTest : public gpu::GpuTest {
protected:
    void SetUp() override
    {
        GpuTest::SetUp();
        if (!renderer) GTEST_SKIP() << "needs a Vulkan device";
        folder = fs::path(testing::TempDir()) / ("petrichor_cookie_" + std::to_string(::getpid()));
        fs::create_directories(folder);
        // Above: black, red. Below: green, white.
        Image image(4, 4, 3, ColorSpace::Linear);
        for (int y = 0; y < 4; ++y)
            for (int x = 0; x < 4; ++x) {
                image.at(x, y, 0) = x >= 2 ? 1.0f : 0.0f;
                image.at(x, y, 1) = y >= 2 ? 1.0f : 0.0f;
                image.at(x, y, 2) = x >= 2 && y >= 2 ? 1.0f : 0.0f;
            }
        texproc::write_image(folder / "four.exr", image);
        scene = gpu::scene_of({gpu::quad({-50, 0, 50}, {100, 0, 0}, {0, 0, -100})},
                              {gpu::plain_material(glm::vec3(0.5f), 1.0f)});
        cookies = read_sun_cookies({"four.exr", "", "four.exr"}, folder, scene);
        renderer->load(scene, {});
        frame.settings.width = 64;
        frame.settings.height = 64;
        frame.settings.samples = 1;
        frame.settings.image_based_light = false;
        frame.settings.ambient_occlusion = false;
        frame.settings.falling = false;
        frame.sky.sun_azimuth_rad = 3.14159265f;  // in the south, +z
        from_above(6.4f);
    }
    void TearDown() override
    {
        fs::remove_all(folder);
        GpuTest::TearDown();
    }
    void from_above(float height_m)
    {
        frame.camera = gpu::look({0, 20, 0}, {0, 0, 0});
        frame.camera.orthographic_height_m = height_m;
    }
    // What the cookie lets through at x and z of the ground.
    glm::vec3 share(const gpu::RenderResult& with, const gpu::RenderResult& plain, float x, float z) const
    {
        const float m = frame.camera.orthographic_height_m;
        const int px = static_cast<int>(32.0f + 64.0f * x / m), py = static_cast<int>(32.0f + 64.0f * z / m);
        const glm::vec3 a = gpu::pixel(with, px, py), b = gpu::pixel(plain, px, py);
        EXPECT_GT(b.g, 1.0f) << "the sun shines";
        return a / b;
    }
    static void expect_near(const glm::vec3& is, const glm::vec3& expected, const char* where)
    {
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(is[c], expected[c], 0.01f) << where << " " << c;
    }

    fs::path folder;
    scene::Scene scene;
    SunCookies cookies;
    gpu::Frame frame;
};

TEST_F(SunCookieTest, APictureIsReadOnceWithItsMeanAndItsSmallerOnes)
{
    ASSERT_EQ(cookies.of_file.size(), 1u);
    const gpu::SunCookie& cookie = cookies.of_file.at("four.exr");
    EXPECT_EQ(cookie.first_texel, 0);
    expect_near(cookie.mean, {0.5f, 0.5f, 0.25f}, "mean");
    EXPECT_EQ(scene.light_profiles.at(0).texels.size(), std::size_t{(4 * 128 * 128 - 1) / 3});
    EXPECT_FALSE(cookies.content.empty());
    EXPECT_THROW(read_sun_cookies({"none.png"}, folder, scene), Error);
}

TEST_F(SunCookieTest, LiesOnTheGroundAsItIsSeenAlongTheLight)
{
    for (const float elevation : {1.5707963f, 0.7853982f}) {
        frame.sky.sun_elevation_rad = elevation;
        frame.sun_cookie = {};
        const gpu::RenderResult plain = renderer->render(frame);
        frame.sun_cookie = cookies.of_file.at("four.exr");
        frame.sun_cookie.size_m = 4.0f;
        const gpu::RenderResult with = renderer->render(frame);
        // Who looks along the light has the east on the right, and what is nearer to the sun below.
        expect_near(share(with, plain, -1, -1), {0, 0, 0}, "black");
        expect_near(share(with, plain, 1, -1), {1, 0, 0}, "red");
        expect_near(share(with, plain, -1, 1), {0, 1, 0}, "green");
        expect_near(share(with, plain, 1, 1), {1, 1, 1}, "white");
        // Repeated; a lower sun draws it out.
        expect_near(share(with, plain, 3, 1), {0, 1, 0}, "the next to the east");
        const bool low = elevation < 1.0f;
        expect_near(share(with, plain, 1, 2.5f), low ? glm::vec3(1) : glm::vec3(1, 0, 0), "the next");
        expect_near(share(with, plain, 1, 3.1f), {1, 0, 0}, "the next one");
    }
}

TEST_F(SunCookieTest, IsItsMeanWhereItIsFinerThanPixels)
{
    frame.sky.sun_elevation_rad = 0.9f;
    frame.camera = gpu::look({0, 8, 0}, {0, 0, 0});
    const gpu::RenderResult plain = renderer->render(frame);
    frame.sun_cookie = cookies.of_file.at("four.exr");
    frame.sun_cookie.size_m = 0.02f;
    const gpu::RenderResult with = renderer->render(frame);
    for (const int x : {8, 31, 50}) {
        const glm::vec3 a = gpu::pixel(with, x, 20), b = gpu::pixel(plain, x, 20);
        expect_near(a / b, {0.5f, 0.5f, 0.25f}, "mean");
    }
}

TEST(SunCookieFormula, AxesFaceTheLight)
{
    for (const glm::vec3 sun : {glm::vec3(0, 1, 0), glm::normalize(glm::vec3(1, 1, 0)),
                                glm::normalize(glm::vec3(-0.3f, 0.2f, 0.9f))}) {
        const glm::vec3 right = shared::sun_cookie_right(sun);
        EXPECT_NEAR(glm::dot(right, sun), 0.0f, 1e-6f);
        EXPECT_NEAR(glm::length(right), 1.0f, 1e-6f);
        EXPECT_EQ(right.y, 0.0f);
        EXPECT_LE(glm::cross(right, sun).y, 0.0f) << "its lower edge is towards the ground";
    }
    EXPECT_EQ(shared::sun_cookie_level(0.01f, 0.05f, 7.0f), 0.0f);
    EXPECT_FLOAT_EQ(shared::sun_cookie_level(0.2f, 0.05f, 7.0f), 2.0f);
    EXPECT_EQ(shared::sun_cookie_level(1e6f, 0.05f, 7.0f), 7.0f);
}

}  // namespace
}  // namespace petrichor::film
