// Water in beads on what it does not spread on, and the picture through those on a pane.
#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

class BeadsTest : public GpuTest {};

constexpr int kSide = 96;

// A hand's breadth of a surface from above, in rain.
Frame from_near()
{
    Frame frame;
    frame.camera = look({0, 0.3f, 0}, {0, 0, 0});
    frame.camera.orthographic_height_m = 0.1f;
    FrameSettings& s = frame.settings;
    s.width = s.height = kSide;
    s.samples = 1;
    s.shelter = false;
    s.shadows = false;
    s.image_based_light = false;
    s.draw_sky = false;
    s.dither = false;
    s.exposure = 1.0f;
    frame.sky.sun_elevation_rad = -1.0f;
    frame.emissive_lights = false;
    frame.fog.mode = FogMode::Off;
    frame.weather.film_albedo = 1.0f;
    frame.weather.film_smoothness = 0.5f;
    return frame;
}

Primitive plate(float y, std::uint32_t material)
{
    return quad({-1, y, 1}, {2, 0, 0}, {0, 0, -2}, material);
}

// Share of the picture where an output is more than that.
float share_above(const RenderResult& r, const std::string& name, float least)
{
    int count = 0;
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) count += aov(r, name, x, y) > least;
    }
    return static_cast<float>(count) / (kSide * kSide);
}

TEST_F(BeadsTest, StandOnGlossAndBendWhatIsSeenThroughAPane)
{
    Frame frame = from_near();
    frame.settings.aovs = {"water", "film"};
    const auto covered = [&](float beads, float porosity) {
        Material m = plain_material(glm::vec3(0.2f), 0.3f);
        m.weather.beads = beads;
        m.weather.porosity = porosity;
        renderer->load(scene_of({plate(0, 0)}, {m}), {});
        const RenderResult r = renderer->render(frame);
        return std::pair(share_above(r, "water", 0.3f), share_above(r, "film", 0.5f));
    };
    for (const SurfacePath path : {SurfacePath::Fragment, SurfacePath::Visibility}) {
        frame.settings.surface_path = path;
        const auto [water, film] = covered(1.0f, 0.0f);
        EXPECT_GT(water, 0.1f);
        EXPECT_LT(water, 0.7f);
        EXPECT_EQ(film, 0.0f) << "the film has gone into the beads";
        EXPECT_EQ(covered(0.0f, 0.0f).first, 0.0f);
        EXPECT_EQ(covered(1.0f, 1.0f).first, 0.0f) << "pores drink it";
    }
    // Half of what lies below a pane glows: drops over the dark half show it.
    Material dark = plain_material(glm::vec3(0.0f), 1.0f), glow = dark,
             pane = plain_material(glm::vec3(1.0f), 0.0f);
    glow.emissive = glm::vec3(1.0f);
    pane.transmission = 1.0f;
    const auto bright = [&](float beads) {
        pane.weather.beads = beads;
        renderer->load(scene_of({quad({-1, -0.1f, 1}, {1, 0, 0}, {0, 0, -2}, 0),
                                 quad({0, -0.1f, 1}, {1, 0, 0}, {0, 0, -2}, 1), plate(0, 2)},
                                {dark, glow, pane}),
                       {});
        const RenderResult r = renderer->render(frame);
        int count = 0;
        for (int y = 0; y < kSide; ++y) {
            for (int x = 0; x < kSide / 2 - 2; ++x)
                count += r.display[static_cast<std::size_t>(4 * (y * kSide + x))] > 150;
        }
        return count;
    };
    EXPECT_EQ(bright(0.0f), 0);
    EXPECT_GT(bright(1.0f), 10);
}

}  // namespace
}  // namespace petrichor::gpu
