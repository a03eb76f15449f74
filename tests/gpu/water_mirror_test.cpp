// Standing water is level and mirrors what a camera below its surface sees the other way up.
#include <algorithm>
#include <cmath>

#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

class WaterMirror : public GpuTest {};

constexpr int kWidth = 160;
constexpr int kHeight = 90;

Camera reflected(Camera camera)
{
    // Mirrored at y = 0 twice over: the picture is upside down and turned, and is a camera's again.
    const glm::vec3 eye(camera.to_world[3]);
    const glm::vec3 forward = -glm::vec3(camera.to_world[2]);
    const glm::vec3 below(eye.x, -eye.y, eye.z);
    return look(below, below + glm::vec3(forward.x, -forward.y, forward.z),
                camera.vertical_fov_rad);
}

// A black floor whose normals lean every way, walls of several colours around it.
Scene court()
{
    Primitive floor = quad({-6, 0, 3}, {12, 0, 0}, {0, 0, -12}, 0);
    const glm::vec3 leaning[] = {{0.2f, 1, 0.1f}, {-0.25f, 1, 0.15f}, {0.1f, 1, -0.3f}, {-0.1f, 1, 0.2f}};
    for (std::size_t i = 0; i < 4; ++i) floor.normals[i] = glm::normalize(leaning[i]);
    Material wet = plain_material(glm::vec3(0.0f), 0.9f);
    wet.weather.water_accumulation = {1.5f, 0.0f, 2.0f, 0.0f};
    wet.weather.default_height = 0.0f;
    Scene scene = scene_of({floor, quad({-6, 0, -8}, {5, 0, 0}, {0, 4, 0}, 1),
                            quad({-1, 0, -9}, {4, 0, 0}, {0, 3, 0}, 2),
                            quad({3, 0, -7}, {3, 0, 0}, {0, 5, 0}, 3),
                            quad({-2.2f, 0, -4}, {0.5f, 0, 0}, {0, 2, 0}, 3)},
                           {wet, plain_material({0.7f, 0.2f, 0.1f}), plain_material({0.6f, 0.6f, 0.5f}),
                            plain_material({0.1f, 0.3f, 0.6f})});
    for (std::size_t i = 1; i < 4; ++i) scene.materials[i].weather.sheltered = true;
    return scene;
}

// Down on a floor, one sample, no fog.
Frame over_the_floor()
{
    Frame frame;
    frame.camera = look({0, 1.5f, 4.0f}, {0, 0, -2.0f}, 0.7f);
    frame.settings.width = kWidth;
    frame.settings.height = kHeight;
    frame.settings.samples = 1;
    frame.settings.exposure = 1.0f;
    frame.fog.mode = FogMode::Off;
    return frame;
}

TEST_F(WaterMirror, APuddleShowsWhatACameraBelowItsSurfaceSees)
{
    renderer->load(court(), {});
    Frame frame;
    frame.camera = look({0.4f, 1.2f, 4.5f}, {0.2f, 0.25f, -4.0f}, 0.7f);
    frame.settings.width = kWidth;
    frame.settings.height = kHeight;
    frame.settings.samples = 1;
    frame.settings.exposure = 1.0f;
    frame.settings.shelter = false;
    frame.sky.sun_elevation_rad = 0.6f;
    frame.sky.sun_azimuth_rad = 0.3f;
    frame.fog.mode = FogMode::Off;
    frame.weather.film_albedo = 0.85f;
    frame.settings.aovs = {"water", "position", "cover_normal"};
    const RenderResult above = renderer->render(frame);
    const Camera camera = frame.camera;
    frame.camera = reflected(camera);
    frame.settings.aovs = {"position"};
    const RenderResult below = renderer->render(frame);

    const glm::vec3 eye(camera.to_world[3]);
    double difference = 0.0;
    double sum = 0.0;
    int puddle = 0;
    int right = 0;
    float least_up = 1.0f;
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            if (aov(above, "position", x, y, 1) > 0.01f || aov(above, "water", x, y) < 0.95f) continue;
            least_up = std::min(least_up, aov(above, "cover_normal", x, y, 1));
            // Only where the mirror shows a wall that the picture shows too.
            const glm::vec3 met(aov(below, "position", x, kHeight - 1 - y, 0),
                                aov(below, "position", x, kHeight - 1 - y, 1),
                                aov(below, "position", x, kHeight - 1 - y, 2));
            if (!std::isfinite(met.x) || met.y < 0.05f || met.y > 1.6f) continue;
            const glm::vec3 at(aov(above, "position", x, y, 0), 0.0f, aov(above, "position", x, y, 2));
            const float cosine = glm::normalize(eye - at).y;
            const float fresnel = 0.02f + 0.98f * std::pow(1.0f - cosine, 5.0f);
            const float seen = luminance(pixel(above, x, y));
            const float wanted = fresnel * luminance(pixel(below, x, kHeight - 1 - y));
            ++puddle;
            right += std::abs(seen - wanted) < 0.25f * wanted ? 1 : 0;
            difference += static_cast<double>(std::abs(seen - wanted));
            sum += static_cast<double>(wanted);
        }
    }
    ASSERT_GT(puddle, 1000);
    EXPECT_GT(least_up, 0.9995f) << "water is level whatever the normals of its ground";
    RecordProperty("difference", std::to_string(difference / sum));
    EXPECT_LT(difference / sum, 0.2) << "of " << puddle << " pixels";
    EXPECT_GT(right, puddle * 8 / 10);
}

TEST_F(WaterMirror, ShallowWaterOnASlopeFollowsIt)
{
    Scene scene = court();
    scene.meshes[0].primitives[0] = quad({-6, 0, 3}, {12, 0, 0}, {0, 14, -8}, 0);
    renderer->load(scene, {});
    Frame frame;
    frame.camera = look({0, 2.0f, 6.0f}, {0, 1.0f, 0});
    frame.settings.width = 32;
    frame.settings.height = 18;
    frame.settings.samples = 1;
    frame.settings.shelter = false;
    frame.settings.aovs = {"cover_normal", "normal"};
    frame.weather.film_albedo = 0.85f;
    const RenderResult result = renderer->render(frame);
    EXPECT_NEAR(aov(result, "cover_normal", 16, 12, 1), aov(result, "normal", 16, 12, 1), 0.03f);
}

// A polished floor before posts, one sample: what it mirrors goes on from row to row, as the posts do.
TEST_F(WaterMirror, APolishedFloorHasNoGrainAtOneSample)
{
    std::vector<Primitive> faces{quad({-6, 0, 3}, {12, 0, 0}, {0, 0, -12}, 0)};
    for (int i = 0; i < 16; ++i) {
        faces.push_back(quad({-4.0f + 0.5f * static_cast<float>(i), 0, -6}, {0.5f, 0, 0}, {0, 6, 0},
                             1 + static_cast<std::uint32_t>(i % 2)));
    }
    renderer->load(scene_of(faces, {plain_material(glm::vec3(0.9f), 0.1f, 1.0f), plain_material(glm::vec3(0.03f)),
                                    plain_material(glm::vec3(0.8f))}),
                   {});
    Frame frame = over_the_floor();
    const RenderResult r = renderer->render(frame);
    double steps = 0.0, sum = 0.0;
    for (int y = kHeight / 2; y < kHeight * 3 / 4; ++y) {
        for (int x = kWidth / 4; x < kWidth * 3 / 4; ++x) {
            steps += static_cast<double>(std::abs(luminance(pixel(r, x, y)) - luminance(pixel(r, x, y + 1))));
            sum += static_cast<double>(luminance(pixel(r, x, y)));
        }
    }
    RecordProperty("grain", std::to_string(steps / sum));
    EXPECT_LT(steps / sum, 0.1) << "0.16 where pixels draw their facets";
}

// The least and the most of the green that a floor shows to a level look, from the first to the last column.
struct Range {
    float least = 1e9f, most = 0.0f;
};
Range greens(const RenderResult& r, int x0, int x1)
{
    Range range;
    for (int y = kHeight * 3 / 4; y < kHeight * 7 / 8; ++y) {
        for (int x = x0; x < x1; ++x) {
            range.least = std::min(range.least, pixel(r, x, y).g);
            range.most = std::max(range.most, pixel(r, x, y).g);
        }
    }
    return range;
}

// Posts before a wall far behind them, all black, and a polished floor: between the posts it mirrors the wall, and nowhere the sky.
TEST_F(WaterMirror, BesideThinThingsThereIsWhatLiesBehindThem)
{
    std::vector<Primitive> faces{quad({-6, 0, 3}, {12, 0, 0}, {0, 0, -12}, 0), quad({-60, -5, -40}, {120, 0, 0}, {0, 60, 0}, 1)};
    for (int i = 0; i < 24; ++i)
        faces.push_back(quad({-6.0f + 0.5f * static_cast<float>(i), 0, -6}, {0.06f, 0, 0}, {0, 3, 0}, 1));
    renderer->load(scene_of(faces, {plain_material(glm::vec3(0.9f), 0.1f, 1.0f), plain_material(glm::vec3(0.0f), 0.9f, 1.0f)}), {});
    Frame frame = over_the_floor();
    frame.camera = look({0, 1.5f, 4.0f}, {0, 1.45f, -2.0f}, 0.7f);
    const float seen = greens(renderer->render(frame), kWidth / 4, kWidth * 3 / 4).most;
    frame.settings.reflections = false;
    const float sky = greens(renderer->render(frame), kWidth / 4, kWidth * 3 / 4).least;
    EXPECT_LT(seen, 0.1f * sky);
}

// A black wall that goes on beyond the picture: so does its mirror image, up to the picture's sides.
TEST_F(WaterMirror, GoesOnToTheSidesOfThePicture)
{
    renderer->load(scene_of({quad({-60, 0, 3}, {120, 0, 0}, {0, 0, -12}, 0), quad({-60, 0, -6}, {120, 0, 0}, {0, 30, 0}, 1)},
                            {plain_material(glm::vec3(0.9f), 0.1f, 1.0f), plain_material(glm::vec3(0.0f), 0.9f, 1.0f)}),
                   {});
    Frame frame = over_the_floor();
    frame.camera = look({0, 1.5f, 4.0f}, {0, 1.45f, -2.0f}, 0.7f);
    const RenderResult on = renderer->render(frame);
    frame.settings.reflections = false;
    const RenderResult off = renderer->render(frame);
    EXPECT_LT(greens(on, 0, 8).most, 0.1f * greens(off, 0, 8).least);
    EXPECT_LT(greens(on, kWidth - 8, kWidth).most, 0.1f * greens(off, kWidth - 8, kWidth).least);
}

// A chrome floor before a red wall under a blue sky: without the picture it mirrors the sky alone.
TEST_F(WaterMirror, WithoutThePictureFloorsMirrorTheSky)
{
    renderer->load(scene_of({quad({-6, 0, 3}, {12, 0, 0}, {0, 0, -12}, 0),
                             quad({-6, 0, -4}, {12, 0, 0}, {0, 6, 0}, 1)},
                            {plain_material(glm::vec3(0.9f), 0.05f, 1.0f), plain_material({0.8f, 0.02f, 0.02f})}),
                   {});
    Frame frame = over_the_floor();
    const RenderResult on = renderer->render(frame);
    frame.settings.reflections = false;
    const RenderResult off = renderer->render(frame);
    // The floor in front of the wall, then the wall itself.
    const glm::vec3 with = pixel(on, kWidth / 2, kHeight / 2), without = pixel(off, kWidth / 2, kHeight / 2);
    EXPECT_GT(with.r, 3.0f * with.b);
    EXPECT_GT(without.b, without.r);
    EXPECT_EQ(pixel(on, kWidth / 2, 4), pixel(off, kWidth / 2, 4));
}

}  // namespace
}  // namespace petrichor::gpu
