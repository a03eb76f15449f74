// Grained surfaces: what they mirror of the surroundings, and light that comes through them.
#include <cmath>

#include "formulas/light/grain.h"
#include "formulas/noise/noise.h"
#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

constexpr int kSize = 32;
constexpr int kMiddle = kSize / 2;
constexpr float kRough = 0.5f;  // no mirror of its own pass: the sky's maps alone
constexpr float kStrength = 0.9f;
constexpr float kAlong = 1.5707963f;  // the grain up the plate, in the plane of the eye

// Brighter above: linear in the height of the direction.
EnvironmentMap bright_above()
{
    EnvironmentMap map;
    map.width = 64;
    map.height = 32;
    for (int y = 0; y < map.height; ++y) {
        const float up = std::cos(3.14159265f * (static_cast<float>(y) + 0.5f) / 32.0f);
        map.rgb.insert(map.rgb.end(), 3 * 64, 1.0f + 0.9f * up);
    }
    return map;
}

Frame straight_on()
{
    Frame frame;
    frame.camera = look({0, 0, 5}, {0, 0, 0});
    frame.camera.orthographic_height_m = 1.0f;
    frame.settings.width = frame.settings.height = kSize;
    frame.settings.samples = 1;
    frame.settings.shadows = false;
    frame.settings.ambient_occlusion = false;
    frame.settings.exposure = 1.0f;
    frame.settings.aovs = {"specular_indirect"};
    frame.sky.analytic_sun = false;
    frame.sky.sun_illuminance = 0.0f;
    frame.weather.visibility_m = 1e9f;
    return frame;
}

Material metal(float strength, float rotation = 0.0f)
{
    Material m = plain_material(glm::vec3(1.0f), kRough, 1.0f);
    m.anisotropy = strength;
    m.anisotropy_rotation_rad = rotation;
    return m;
}

class Anisotropy : public GpuTest {
protected:
    void TearDown() override
    {
        if (renderer) renderer->set_environment({});
        GpuTest::TearDown();
    }

    // A plate whose normal leans up from the eye by an angle.
    RenderResult leaning(const Material& material, float angle)
    {
        const glm::vec3 u(4, 0, 0), v(0, 4.0f * std::cos(angle), -4.0f * std::sin(angle));
        renderer->load(scene_of({quad(-0.5f * (u + v), u, v)}, {material}), {});
        return renderer->render(frame);
    }

    static float mirrored(const RenderResult& r)
    {
        double sum = 0.0;
        for (int y = 8; y < kSize - 8; ++y) {
            for (int x = 8; x < kSize - 8; ++x)
                sum += static_cast<double>(aov(r, "specular_indirect", x, y, 1));
        }
        return static_cast<float>(sum / 256.0);
    }

    // Of the gradient, as a share of what an even sky would give.
    float brightness(const Material& material, float angle)
    {
        renderer->set_environment(constant_environment(1.0f));
        const float even = mirrored(leaning(material, angle));
        renderer->set_environment(bright_above());
        return mirrored(leaning(material, angle)) / even;
    }

    Frame frame = straight_on();
};

// Across the grain nothing is bent; along it the mirrored direction is that of a normal which leans to the eye, as an even
// plate of that lean shows it.
TEST_F(Anisotropy, SurroundingsAreMirroredAsOfANormalBentAlongTheGrain)
{
    const float angle = 0.5f;
    const float even = brightness(metal(0.0f), angle);
    EXPECT_NEAR(brightness(metal(kStrength), angle), even, 0.01f) << "the grain lies across";
    const glm::vec3 n(0, std::sin(angle), std::cos(angle)), v(0, 0, 1);
    const glm::vec3 bent = shared::grain_middle(n, glm::vec3(0, std::cos(angle), -std::sin(angle)), v, kStrength);
    const float along = brightness(metal(kStrength, kAlong), angle);
    EXPECT_NEAR(along, brightness(metal(0.0f), std::asin(bent.y)), 0.02f);
    EXPECT_GT(std::abs(along - even), 0.2f) << "and that is another";
}

// An even sky stays as it is, however it is smeared.
TEST_F(Anisotropy, DitherKeepsAFurnace)
{
    renderer->set_environment(constant_environment(1.0f));
    for (const float rotation : {0.0f, kAlong}) {
        frame.settings.anisotropic_dither = 0.0f;
        const float off = mirrored(leaning(metal(kStrength, rotation), 0.6f));
        frame.settings.anisotropic_dither = 1.0f;
        EXPECT_NEAR(mirrored(leaning(metal(kStrength, rotation), 0.6f)), off, 0.005f * off);
    }
}

// The mean over samples is the sum over the wide side of the lobe.
TEST_F(Anisotropy, DitherDrawsOutWhatIsMirroredAlongTheGrain)
{
    const float angle = 0.5f;
    // What is seen in a direction, from two plates: linear in its height.
    const float flat = brightness(metal(0.0f), 0.0f), high = brightness(metal(0.0f), angle);
    const auto seen = [&](float up) { return flat + (high - flat) * up / std::sin(2.0f * angle); };
    const glm::vec3 n(0, std::sin(angle), std::cos(angle)), v(0, 0, 1);
    for (const float spread : {0.4f, 1.0f}) {
        frame.settings.anisotropic_dither = spread;
        for (const float rotation : {0.0f, kAlong}) {
            const glm::vec3 t = rotation > 0.0f ? glm::vec3(0, std::cos(angle), -std::sin(angle))
                                                : glm::vec3(1, 0, 0);
            const float wide = spread * shared::grain_alpha(kRough * kRough, kStrength);
            double sum = 0.0;
            for (int i = 0; i < 4096; ++i) {
                const glm::vec2 u((static_cast<float>(i) + 0.5f) / 4096.0f, std::fmod(static_cast<float>(i) * 0.61803399f, 1.0f));
                const float slope = shared::seen_slope(u, wide, {glm::dot(v, t), glm::dot(v, n)});
                const glm::vec3 h = shared::grain_normal(n, t, v, slope);
                sum += static_cast<double>(seen((2.0f * glm::dot(h, v) * h - v).y)) / 4096.0;
            }
            frame.settings.samples = 16;
            const float got = brightness(metal(kStrength, rotation), angle);
            EXPECT_NEAR(got, sum, 0.03f) << spread << " " << rotation;
        }
    }
    // One sample is grainy, all of them are not.
    const auto rough = [&](int samples) {
        frame.settings.samples = samples;
        const RenderResult r = leaning(metal(kStrength, kAlong), angle);
        float most = 0.0f;
        for (int x = 8; x < kSize - 8; ++x)
            most = std::max(most, std::abs(aov(r, "specular_indirect", x, 16, 1) -
                                           aov(r, "specular_indirect", x + 1, 16, 1)));
        return most;
    };
    const float one = rough(1);
    EXPECT_GT(one, 0.1f);
    EXPECT_LT(rough(32), 0.25f * one);
}

TEST_F(Anisotropy, DitherEndsAtItsDistance)
{
    renderer->set_environment(bright_above());
    const Material m = metal(kStrength, kAlong);
    const RenderResult off = leaning(m, 0.5f);
    frame.settings.anisotropic_dither = 1.0f;
    const float near = mirrored(leaning(m, 0.5f));
    frame.settings.anisotropic_dither_distance_m = 4.0f;  // the plate is 5 m away
    frame.settings.anisotropic_dither_fade_m = 1.0f;
    EXPECT_EQ(leaning(m, 0.5f).beauty, off.beauty);
    frame.settings.anisotropic_dither_distance_m = 6.0f;
    frame.settings.anisotropic_dither_fade_m = 2.0f;
    const float half = mirrored(leaning(m, 0.5f));
    EXPECT_GT((half - mirrored(off)) * (near - mirrored(off)), 0.0f);
    EXPECT_LT(std::abs(half - mirrored(off)), std::abs(near - mirrored(off)));
    // Surfaces without a grain know nothing of it.
    frame.settings.anisotropic_dither = 0.0f;
    const RenderResult plain = leaning(metal(0.0f), 0.5f);
    frame.settings.anisotropic_dither = 1.0f;
    EXPECT_EQ(leaning(metal(0.0f), 0.5f).beauty, plain.beauty);
}

// A brushed leaf of horn: the highlight has its grain, what comes through has none; metals let nothing through.
TEST_F(Anisotropy, LightComesThroughBesideTheHighlight)
{
    Light front, behind;
    front.kind = behind.kind = LightKind::Directional;
    front.intensity = behind.intensity = 1000.0f;
    front.direction = -glm::normalize(glm::vec3(0.6f, 0.0f, 1.0f));
    behind.direction = glm::vec3(0, 0, 1);
    frame.settings.image_based_light = false;
    frame.settings.aovs.clear();
    frame.extra_lights = {front, behind};
    const auto light = [&](float strength, float translucency, float metallic) {
        Material m = plain_material(glm::vec3(0.6f), 0.4f, metallic);
        m.anisotropy = strength;
        m.translucency = translucency;
        return pixel(leaning(m, 0.0f), kMiddle, kMiddle).g;
    };
    const float plain = light(0.0f, 0.0f, 0.0f), through = light(0.0f, 0.5f, 0.0f) - plain;
    const float grain = light(kStrength, 0.0f, 0.0f);
    EXPECT_GT(through, 0.1f * plain);
    EXPECT_GT(std::abs(grain - plain), 0.02f * plain) << "the grain shows";
    EXPECT_NEAR(light(kStrength, 0.5f, 0.0f), grain + through, 0.005f * grain);
    EXPECT_NEAR(light(kStrength, 0.5f, 1.0f), light(kStrength, 0.0f, 1.0f), 0.001f * plain);
    const float half = light(kStrength, 0.5f, 0.5f) - light(kStrength, 0.0f, 0.5f);
    // As much as is neither metal nor mirrored.
    EXPECT_NEAR(half, 0.5f * through * (1.0f - 0.32f) / (1.0f - 0.04f), 0.02f * through);
}

}  // namespace
}  // namespace petrichor::gpu
