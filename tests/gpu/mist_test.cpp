// Mist lies on ground that is wet, and nowhere else.
#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

class MistTest : public GpuTest {
protected:
    // Black ground under a bright sky.
    void load()
    {
        renderer->load(scene_of({quad({-10, 0, 10}, {20, 0, 0}, {0, 0, -20})}, {plain_material(glm::vec3(0.0f), 0.9f)}), {});
    }
    static Frame frame(float film, float mist_per_m)
    {
        Frame f;
        f.camera = look({0, 1.6f, 6}, {0, 0.0f, -4}, 0.5f);
        f.settings.width = f.settings.height = 48;
        f.weather.film_albedo = film;
        f.fog.mist_per_m = mist_per_m;
        return f;
    }
    static double light(const RenderResult& r)
    {
        double sum = 0.0;
        for (int y = 28; y < 48; ++y)
            for (int x = 0; x < 48; ++x) sum += static_cast<double>(luminance(pixel(r, x, y)));
        return sum;
    }
};

TEST_F(MistTest, VeilsGroundThatIsWet)
{
    load();
    const double wet = light(renderer->render(frame(1.0f, 0.0f)));
    const double misty = light(renderer->render(frame(1.0f, 1.0f)));
    const double thick = light(renderer->render(frame(1.0f, 3.0f)));
    EXPECT_GT(misty, 1.3 * wet);
    EXPECT_GT(thick, 1.2 * misty);
    const double half = light(renderer->render(frame(0.5f, 1.0f)));
    EXPECT_GT(half, 1.05 * light(renderer->render(frame(0.5f, 0.0f))));
    EXPECT_LT(half, misty);
}

TEST_F(MistTest, IsNotOnDryGround)
{
    load();
    EXPECT_EQ(renderer->render(frame(0.0f, 3.0f)).beauty, renderer->render(frame(0.0f, 0.0f)).beauty);
}

TEST_F(MistTest, DriftsWithTheAir)
{
    load();
    Frame f = frame(1.0f, 1.0f);
    const auto before = renderer->render(f).beauty;
    EXPECT_EQ(renderer->render(f).beauty, before);
    f.falling.air_m = {1.5, 0.0};
    EXPECT_NE(renderer->render(f).beauty, before);
}

}  // namespace
}  // namespace petrichor::gpu
