// Highlights of balls that glow, whichever way lamps with a size are lit.
#include <gtest/gtest.h>

#include "tests/gpu/ball.h"
#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

class GlowHighlights : public GpuTest {
protected:
    void SetUp() override
    {
        GpuTest::SetUp();
        if (!renderer) GTEST_SKIP() << "no device";
        Material glow = plain_material(glm::vec3(0.0f));
        glow.emissive = glm::vec3(50.0f);
        renderer->load(scene_of({quad({-4, 0, 4}, {8, 0, 0}, {0, 0, -8}), ball(1, {0.0f, 0.6f, -1.0f}, 0.25f)},
                                {plain_material(glm::vec3(0.8f), 0.45f, 1.0f), glow}),
                       {});
        frame.camera = look({0, 1, 3}, {0, 0, 0}, 0.9f);
        frame.settings.width = 96;
        frame.settings.height = 64;
        frame.settings.samples = 1;
        frame.settings.exposure = 1.0f;
        frame.settings.draw_sky = false;
        frame.settings.lamp_shadows = 0;
        frame.settings.least_lux = 1.0e-4f;
        frame.sky.sun_illuminance = 0.0f;
    }

    // On the metal floor before it, which scatters nothing.
    float on_the_floor(AreaLights area)
    {
        frame.settings.area_lights = area;
        const RenderResult r = renderer->render(frame);
        float sum = 0.0f;
        for (int y = 38; y < 64; ++y)
            for (int x = 0; x < 96; ++x) sum += luminance(pixel(r, x, y));
        return sum;
    }

    Frame frame;
};

TEST_F(GlowHighlights, AreTheSameBesideALampThatHasLessOfItsOwn)
{
    for (const AreaLights area : {AreaLights::Off, AreaLights::Nearest, AreaLights::Ltc}) {
        frame.extra_lights.clear();
        const float alone = on_the_floor(area);
        Light faint;
        faint.kind = LightKind::Point;
        faint.position_m = {0.0f, 1.0f, 0.0f};
        faint.intensity = 0.002f;
        faint.specular = 0.5f;
        frame.extra_lights = {faint};
        EXPECT_NEAR(on_the_floor(area) / alone, 1.0f, 0.01f) << static_cast<int>(area);
    }
}

TEST_F(GlowHighlights, AreAboutAsStrongHoweverSizesAreLit)
{
    const float exact = on_the_floor(AreaLights::Ltc);
    ASSERT_GT(exact, 10.0f);
    for (const AreaLights area : {AreaLights::Off, AreaLights::Nearest})
        EXPECT_NEAR(on_the_floor(area) / exact, 1.0f, 0.4f) << static_cast<int>(area);
}

}  // namespace
}  // namespace petrichor::gpu
