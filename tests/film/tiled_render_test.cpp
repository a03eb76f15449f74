// A picture in tiles is the picture in one piece, and what the lens does reaches over all of it.
#include <algorithm>
#include <cstring>
#include <glm/gtc/packing.hpp>
#include <span>

#include "base/hash.h"
#include "film/tiles/tiled_picture.h"
#include "tests/gpu/gpu_fixture.h"
#include "texproc/codecs/files/io.h"

namespace petrichor::film {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 400, kHeight = 300;  // windows of 256 x 256

scene::Scene street()
{
    scene::Material lamp = gpu::plain_material(glm::vec3(0.1f));
    lamp.emissive = glm::vec3(40000.0f, 20000.0f, 6000.0f);
    return gpu::scene_of({gpu::quad({-8, 0, 4}, {16, 0, 0}, {0, 0, -16}, 0),
                          gpu::quad({-2, 0, -3}, {1.4f, 0, 0.4f}, {0, 2.3f, 0}, 1),
                          gpu::quad({0.9f, 1.5f, -2}, {0.2f, 0, 0}, {0, 0.2f, 0}, 2)},
                         {gpu::plain_material({0.5f, 0.4f, 0.3f}), gpu::plain_material({0.2f, 0.5f, 0.7f}), lamp});
}

// What looks for things across the picture is off.
gpu::Frame frame_of()
{
    gpu::Frame frame;
    frame.camera = gpu::look({0.4f, 1.5f, 3.0f}, {0.0f, 1.0f, -2.0f}, 0.9f);
    frame.settings.width = kWidth;
    frame.settings.height = kHeight;
    frame.settings.samples = 2;
    frame.settings.ambient_occlusion = false;
    frame.settings.reflections = false;
    frame.settings.exposure = 5e-5f;
    frame.settings.bloom = 0.3f;
    frame.settings.wet_lens = 1.0f;
    frame.settings.white_balance_k = 5000.0f;
    frame.settings.time_s = 2.0;
    frame.settings.aovs = {"depth"};
    frame.weather.rain = 1.0f;
    frame.weather.rain_kg_m2_s = 10.0f / 3600.0f;
    frame.weather.film_albedo = 1.0f;
    return frame;
}

class TiledRender : public gpu::GpuTest {
protected:
    TiledRender()
        : folder_(fs::path(testing::TempDir()) /
                  (std::string("petrichor_") + testing::UnitTest::GetInstance()->current_test_info()->name()))
    {
        fs::create_directories(folder_);
    }
    ~TiledRender() override { fs::remove_all(folder_); }
    TiledPicture tiled(const gpu::Frame& frame, const StopRequest& stop = {}, int side = 64)
    {
        TiledOptions options;
        options.stop = stop;
        const TilePlan plan = plan_tiles(frame.settings.width, frame.settings.height, side);
        return render_tiled(*renderer, frame, plan, {folder_, "a.exr", "a.png", {}}, options);
    }
    fs::path folder_;
};

TEST_F(TiledRender, IsThePictureInOnePiece)
{
    renderer->load(street(), {});
    const gpu::Frame frame = frame_of();
    const gpu::RenderResult whole = renderer->render(frame);
    const TiledPicture made = tiled(frame);
    EXPECT_EQ(made.exposure, whole.exposure);
    EXPECT_EQ(made.falling.drawn, whole.falling.drawn);
    const texproc::RawImage png = texproc::read_raw(folder_ / "a.png");
    ASSERT_EQ(png.width, kWidth);
    ASSERT_EQ(png.height, kHeight);
    ASSERT_EQ(png.channels, 3);
    gpu::Frame plain = frame;
    plain.settings.bloom = 0.0f;
    plain.settings.wet_lens = 0.0f;
    const gpu::RenderResult bare = renderer->render(plain);
    // A sample at an edge of a thing may fall on the other side.
    std::size_t others = 0, by_the_lens = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(kWidth * kHeight); ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            const int code = static_cast<int>(png.bytes[3 * i + c]);
            others += std::abs(code - whole.display[4 * i + c]) > 1 ? 1 : 0;
            by_the_lens += std::abs(bare.display[4 * i + c] - whole.display[4 * i + c]) > 1 ? 1 : 0;
        }
    }
    EXPECT_LT(others, 60u);
    EXPECT_GT(by_the_lens, 30000u);

    const texproc::RawImage exr = texproc::read_raw(folder_ / "a.exr");
    ASSERT_EQ(exr.channels, 5);
    std::vector<std::uint16_t> beauty;
    std::size_t apart = 0;
    std::size_t at[4];
    for (std::size_t c = 0; c < 4; ++c)
        at[c] = static_cast<std::size_t>(std::find(exr.channel_names.begin(), exr.channel_names.end(), std::string(1, "RGBA"[c])) -
                                         exr.channel_names.begin());
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            const std::size_t i = static_cast<std::size_t>(y * kWidth + x);
            for (std::size_t c = 0; c < 4; ++c) {
                float value = 0.0f;  // floats, for the depth beside it
                std::memcpy(&value, &exr.bytes[4 * (5 * i + at[c])], 4);
                const float there = gpu::half_to_float(whole.beauty[4 * i + c]);
                apart += std::abs(value - there) > 0.005f * std::max(std::abs(value), 1.0f) ? 1 : 0;
                beauty.push_back(glm::packHalf1x16(value));
            }
        }
    }
    EXPECT_LT(apart, 60u);
    Hasher hasher;
    hasher.add_numbers(std::span<const std::uint16_t>(beauty));
    EXPECT_EQ(hasher.text(), made.beauty_hash);
}

// What looks across the picture, too: mirrors in a wet floor, the screen's occlusion.
TEST_F(TiledRender, HasTheMirrorsOfThePictureInOnePiece)
{
    renderer->load(street(), {});
    gpu::Frame frame = frame_of();
    frame.settings.width = 640;
    frame.settings.height = 480;
    frame.settings.samples = 1;
    frame.settings.bloom = 0.0f;
    frame.settings.wet_lens = 0.0f;
    frame.settings.falling = false;
    frame.settings.ambient_occlusion = true;
    frame.weather.film_smoothness = 1.0f;
    const gpu::RenderResult without = renderer->render(frame);
    frame.settings.reflections = true;
    const gpu::RenderResult whole = renderer->render(frame);
    tiled(frame, {}, 160);
    const texproc::RawImage png = texproc::read_raw(folder_ / "a.png");
    std::size_t others = 0, mirror = 0;
    for (std::size_t i = 0; i < whole.display.size() / 4; ++i) {
        int apart = 0, of_mirrors = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            apart = std::max(apart, std::abs(static_cast<int>(png.bytes[3 * i + c]) - whole.display[4 * i + c]));
            of_mirrors = std::max(of_mirrors, std::abs(static_cast<int>(without.display[4 * i + c]) - whole.display[4 * i + c]));
        }
        others += apart > 2 ? 1 : 0;
        mirror += of_mirrors > 2 ? 1 : 0;
    }
    EXPECT_GT(mirror, 5000u);
    EXPECT_LT(others, 20u);
}

TEST_F(TiledRender, LeavesNothingBehindAfterAStop)
{
    renderer->load(street(), {});
    int asked = 0;
    EXPECT_THROW(tiled(frame_of(), [&] { return ++asked > 4; }), Interrupted);
    EXPECT_TRUE(fs::is_empty(folder_));
    tiled(frame_of());
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 2);
}

}  // namespace
}  // namespace petrichor::film
