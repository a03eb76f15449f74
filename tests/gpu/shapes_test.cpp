// Marched shapes look, shade and shelter as the meshes of the same form.
#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <limits>

#include "formulas/geometry/shapes.h"
#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

constexpr int kSize = 96;

class MarchedShapes : public GpuTest {
protected:
    RenderResult shot(const Scene& scene, const Frame& frame)
    {
        renderer->load(scene, std::vector<Texture>(scene.textures.size()));
        return renderer->render(frame);
    }
};

glm::mat4 placed(const glm::vec3& at, float scale, float turn_rad = 0.0f)
{
    return glm::translate(glm::mat4(1.0f), at) * glm::rotate(glm::mat4(1.0f), turn_rad, glm::vec3(0, 1, 0)) *
           glm::scale(glm::mat4(1.0f), glm::vec3(scale));
}

MarchedShape shape_of(int kind, const glm::mat4& to_world, std::uint32_t material = 1)
{
    MarchedShape shape;
    shape.name = "thing";
    shape.kind = kind;
    shape.material = material;
    shape.iterations = kind == SHAPE_MENGER ? 3 : kind <= SHAPE_SIERPINSKI ? 6 : 0;
    shape.rest.to_world = to_world;
    return shape;
}

// The cube of -1 to 1.
std::vector<Primitive> cube_mesh(std::uint32_t material)
{
    return {quad({-1, -1, 1}, {2, 0, 0}, {0, 2, 0}, material),  quad({1, -1, -1}, {-2, 0, 0}, {0, 2, 0}, material),
            quad({1, -1, 1}, {0, 0, -2}, {0, 2, 0}, material),  quad({-1, -1, -1}, {0, 0, 2}, {0, 2, 0}, material),
            quad({-1, 1, 1}, {2, 0, 0}, {0, 0, -2}, material),  quad({-1, -1, -1}, {2, 0, 0}, {0, 0, 2}, material)};
}

Scene floor_alone()
{
    Scene scene = scene_of({quad({-6, 0, 6}, {12, 0, 0}, {0, 0, -12})},
                           {plain_material(glm::vec3(0.5f)), plain_material(glm::vec3(0.6f, 0.3f, 0.2f), 0.6f)});
    return scene;
}

Scene with_shape(const MarchedShape& shape)
{
    Scene scene = floor_alone();
    scene.shapes.push_back(shape);
    return scene;
}

Scene with_mesh(std::vector<Primitive> primitives, const glm::mat4& to_world)
{
    Scene scene = floor_alone();
    scene.meshes.push_back({"body", std::move(primitives)});
    scene.instances.push_back({"body", 1, to_world});
    return scene;
}

Frame seen()
{
    Frame frame;
    frame.camera = look({3.0f, 3.2f, 5.0f}, {0, 0.6f, 0}, 0.7f);
    frame.settings.width = frame.settings.height = kSize;
    frame.settings.samples = 1;
    frame.settings.surface_path = SurfacePath::Visibility;
    frame.settings.aovs = {"depth", "normal", "base_color", "film", "snow", "material"};
    frame.settings.exposure = 1.0e-4f;
    frame.sky.analytic_sun = true;
    frame.sky.sun_elevation_rad = 0.7f;
    frame.sky.sun_azimuth_rad = 2.4f;
    return frame;
}

Frame raining()
{
    Frame frame = seen();
    frame.weather.rain = 1.0f;
    frame.weather.film_smoothness = 0.8f;
    frame.weather.film_albedo = 0.6f;
    return frame;
}

// Share of the pixels where a value differs by more.
double differing(const RenderResult& a, const RenderResult& b, const std::function<float(const RenderResult&, int, int)>& of,
                 float relative, float absolute)
{
    int different = 0;
    for (int y = 0; y < a.height; ++y) {
        for (int x = 0; x < a.width; ++x) {
            const float u = of(a, x, y), v = of(b, x, y);
            if (std::isinf(u) && std::isinf(v)) continue;
            different += !(std::abs(u - v) <= absolute + relative * std::abs(v));
        }
    }
    return static_cast<double>(different) / (a.width * a.height);
}

void expect_alike(const RenderResult& marched, const RenderResult& meshed, double outline)
{
    const auto value = [](const char* name, int channel) {
        return [=](const RenderResult& r, int x, int y) { return aov(r, name, x, y, channel); };
    };
    EXPECT_LE(differing(marched, meshed, value("depth", 0), 2e-3f, 1e-3f), outline) << "depth";
    EXPECT_LE(differing(marched, meshed, value("material", 0), 0.0f, 0.5f), outline) << "material";
    for (int c = 0; c < 3; ++c) {
        EXPECT_LE(differing(marched, meshed, value("normal", c), 0.0f, 0.02f), 2.0 * outline) << "normal";
        EXPECT_LE(differing(marched, meshed, value("base_color", c), 0.0f, 0.01f), outline) << "colour";
    }
    EXPECT_LE(differing(marched, meshed, value("film", 0), 0.0f, 0.05f), 2.0 * outline) << "film";
    EXPECT_LE(differing(marched, meshed, value("snow", 0), 0.0f, 0.05f), 2.0 * outline) << "snow";
    EXPECT_LE(differing(marched, meshed, [](const RenderResult& r, int x, int y) { return luminance(pixel(r, x, y)); },
                        0.05f, 20.0f),
              3.0 * outline)
        << "light";
}

TEST_F(MarchedShapes, ABoxIsItsMeshInSunRainAndSnow)
{
    const glm::mat4 to_world = placed({0, 1.0f, 0}, 0.8f, 0.5f);
    Frame white = seen();
    white.weather.snow_amount = 0.8f;
    white.weather.water_to_snow = 1.0f;
    for (const Frame& frame : {seen(), raining(), white}) {
        const RenderResult marched = shot(with_shape(shape_of(SHAPE_BOX, to_world)), frame);
        const RenderResult meshed = shot(with_mesh(cube_mesh(1), to_world), frame);
        expect_alike(marched, meshed, 0.012);
    }
}

TEST_F(MarchedShapes, ABoxIsItsMeshBeforeAnOrthographicCamera)
{
    Frame frame = seen();
    frame.camera.orthographic_height_m = 4.0f;
    const glm::mat4 to_world = placed({0.3f, 1.0f, 0}, 0.8f, 0.5f);
    expect_alike(shot(with_shape(shape_of(SHAPE_BOX, to_world)), frame), shot(with_mesh(cube_mesh(1), to_world), frame),
                 0.012);
}

TEST_F(MarchedShapes, ALampThrowsItsShadow)
{
    Frame frame = seen();
    frame.sky.sun_elevation_rad = -0.5f;
    Light lamp;
    lamp.kind = LightKind::Point;
    lamp.intensity = 2000.0f;
    lamp.position_m = {-1.5f, 3.0f, 1.0f};
    frame.extra_lights.push_back(lamp);
    frame.settings.lamp_shadows = 1;
    const glm::mat4 to_world = placed({0, 1.0f, 0}, 0.8f, 0.5f);
    const RenderResult marched = shot(with_shape(shape_of(SHAPE_BOX, to_world)), frame);
    const RenderResult meshed = shot(with_mesh(cube_mesh(1), to_world), frame);
    expect_alike(marched, meshed, 0.012);
    frame.settings.lamp_shadows = 0;
    const RenderResult without = shot(with_shape(shape_of(SHAPE_BOX, to_world)), frame);
    EXPECT_GT(differing(marched, without, [](const RenderResult& r, int x, int y) { return luminance(pixel(r, x, y)); },
                        0.05f, 1.0f),
              0.03)
        << "there is a shadow";
}

TEST_F(MarchedShapes, WhatIsNearerHides)
{
    const Frame frame = seen();
    Scene scene = with_shape(shape_of(SHAPE_SPHERE, placed({0, 1.0f, 0}, 0.8f)));
    // A board before the lower half of it.
    scene.meshes.push_back({"board", {quad({-0.4f, 0.0f, 1.2f}, {2.4f, 0, 0}, {0, 1.0f, 0}, 0)}});
    scene.instances.push_back({"board", 1, glm::mat4(1.0f)});
    const RenderResult r = shot(scene, frame);
    int ball = 0, board = 0;
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            const float depth = aov(r, "depth", x, y);
            const bool is_ball = aov(r, "material", x, y) == 1.0f;
            ball += is_ball;
            board += !is_ball && aov(r, "normal", x, y, 2) > 0.9f;
            if (is_ball) {
                EXPECT_GT(depth, 4.0f);
            }
        }
    }
    EXPECT_GT(ball, 100);
    EXPECT_GT(board, 100);
    renderer->load(with_shape(shape_of(SHAPE_SPHERE, placed({0, 1.0f, 0}, 0.8f))), {});
    const RenderResult alone = renderer->render(frame);
    int more = 0;
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) more += aov(alone, "material", x, y) == 1.0f;
    EXPECT_GT(more, ball + 50);
}

// Rain falls beside, not below: the fractals shelter as boxes do.
TEST_F(MarchedShapes, ShelterTheGroundBelow)
{
    Frame frame = raining();
    frame.camera = look({0, 0.6f, 4.0f}, {0, 0.2f, 0}, 0.7f);
    for (const int kind : {SHAPE_MANDELBULB, SHAPE_SIERPINSKI, SHAPE_MENGER, SHAPE_SPHERE, SHAPE_TORUS}) {
        MarchedShape shape = shape_of(kind, placed({0, 2.6f, 0}, 1.5f));
        if (kind == SHAPE_TORUS) shape.half = {1.0f, 0.45f, 1.0f};
        const RenderResult r = shot(with_shape(shape), frame);
        const RenderResult open = shot(floor_alone(), frame);
        int dry = 0;
        for (int y = kSize / 2; y < kSize; ++y)
            for (int x = kSize / 3; x < 2 * kSize / 3; ++x)
                dry += aov(open, "film", x, y) > 0.8f && aov(r, "film", x, y) < 0.4f;
        EXPECT_GT(dry, 40) << kind;
        EXPECT_GT(aov(r, "film", 2, kSize - 3), 0.8f) << "rain falls beside it";
    }
}

// Labels against the formulas: what the picture has met lies on the shape, and its normal is that of the distance.
TEST_F(MarchedShapes, DepthAndNormalAreThoseOfTheDistance)
{
    Frame frame = seen();
    frame.settings.aovs.push_back("position");
    for (const int kind : {SHAPE_MANDELBULB, SHAPE_SIERPINSKI, SHAPE_MENGER, SHAPE_SPHERE, SHAPE_TORUS}) {
        MarchedShape shape = shape_of(kind, placed({0, 1.2f, 0}, 1.0f, 0.3f));
        if (kind == SHAPE_TORUS) shape.half = {1.0f, 0.25f, 1.0f};
        const RenderResult r = shot(with_shape(shape), frame);
        const glm::mat4 to_own = glm::inverse(shape.rest.to_world);
        const shared::MarchedShape own{kind, shape.iterations, shape.rest.power,
                                       kind == SHAPE_TORUS ? shape.half : shared::shape_half(kind, 8.0f)};
        int met = 0, off = 0, turned = 0;
        for (int y = 0; y < kSize; ++y) {
            for (int x = 0; x < kSize; ++x) {
                if (aov(r, "material", x, y) != 1.0f) continue;
                ++met;
                glm::vec3 p, n;
                for (int c = 0; c < 3; ++c) {
                    p[c] = aov(r, "position", x, y, c);
                    n[c] = aov(r, "normal", x, y, c);
                }
                const float pixel_m = 2.0f * std::tan(0.35f) / static_cast<float>(kSize) * aov(r, "depth", x, y);
                const glm::vec3 q(to_own * glm::vec4(p, 1.0f));
                off += !(std::abs(shared::shape_distance(own, q, pixel_m)) < 0.6f * pixel_m);
                if (kind == SHAPE_SPHERE || kind == SHAPE_TORUS) {
                    const glm::vec3 is = glm::mat3(shape.rest.to_world) * shared::shape_normal(own, q, pixel_m);
                    turned += glm::dot(n, is) < 0.99f;
                }
            }
        }
        EXPECT_GT(met, 400) << kind;
        EXPECT_LE(off, met / 50) << kind << " of " << met;
        EXPECT_LE(turned, met / 50) << kind << " of " << met;
    }
}

TEST_F(MarchedShapes, AFrameMovesThemAndTheNextOneForgets)
{
    Frame frame = seen();
    const MarchedShape low = shape_of(SHAPE_MANDELBULB, placed({0, 1.0f, 0}, 0.8f));
    MarchedShape high = low;
    high.rest.to_world = placed({0.5f, 1.2f, 0}, 0.6f, 1.0f);
    high.rest.power = 5.0f;
    const RenderResult at_rest = shot(with_shape(low), frame);
    frame.shapes = {high.rest};
    const RenderResult moved = renderer->render(frame);
    frame.shapes.clear();
    const RenderResult again = renderer->render(frame);
    EXPECT_EQ(again.beauty, at_rest.beauty) << "nothing stays of the frame before";
    Scene elsewhere = with_shape(high);
    elsewhere.shapes[0].reach = scene::Bounds{{-1.0f, 0.0f, -1.0f}, {1.0f, 2.0f, 1.0f}};
    Scene rests = with_shape(low);
    rests.shapes[0].reach = elsewhere.shapes[0].reach;
    renderer->load(rests, {});
    frame.shapes = {high.rest};
    const RenderResult carried = renderer->render(frame);
    frame.shapes.clear();
    EXPECT_EQ(carried.beauty, shot(elsewhere, frame).beauty) << "as if it had been loaded there";
    EXPECT_NE(moved.beauty, at_rest.beauty);
}

// Samples that are left out lose no more of a shape than of a mesh.
TEST_F(MarchedShapes, AdaptiveSamplesSeeThem)
{
    Frame frame = seen();
    frame.settings.samples = 8;
    const glm::mat4 to_world = placed({0, 1.0f, 0}, 0.8f, 0.5f);
    const auto lost = [&](const Scene& scene) {
        frame.settings.adaptive = 0.0f;
        const RenderResult all = shot(scene, frame);
        frame.settings.adaptive = 0.02f;
        return differing(shot(scene, frame), all,
                         [](const RenderResult& r, int x, int y) { return luminance(pixel(r, x, y)); }, 0.05f, 1.0f);
    };
    const double of_mesh = lost(with_mesh(cube_mesh(1), to_world));
    EXPECT_NEAR(lost(with_shape(shape_of(SHAPE_BOX, to_world))), of_mesh, 0.005);
    EXPECT_LT(of_mesh, 0.05);
}

std::string said_of(Renderer& renderer, const Scene& scene)
{
    try {
        renderer.load(scene, {});
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST_F(MarchedShapes, RefuseWhatNoRayCanMarchTo)
{
    using testing::HasSubstr;
    const MarchedShape fits = shape_of(SHAPE_MANDELBULB, placed({0, 1, 0}, 1.0f));
    const auto said = [&](const std::function<void(MarchedShape&)>& change) {
        MarchedShape shape = fits;
        change(shape);
        return said_of(*renderer, with_shape(shape));
    };
    EXPECT_EQ(said([](MarchedShape&) {}), "");
    EXPECT_THAT(said([](MarchedShape& s) { s.rest.to_world = placed({0, 1, 0}, 0.0f); }), HasSubstr("one scale above 0"));
    EXPECT_THAT(said([](MarchedShape& s) { s.rest.to_world[0] *= 2.0f; }), HasSubstr("one scale"));
    EXPECT_THAT(said([](MarchedShape& s) { s.rest.to_world[0] *= -1.0f; }), HasSubstr("a turn"));
    EXPECT_THAT(said([](MarchedShape& s) { s.rest.to_world[3].x = std::numeric_limits<float>::quiet_NaN(); }),
                HasSubstr("a shift"));
    EXPECT_THAT(said([](MarchedShape& s) { s.rest.power = std::numeric_limits<float>::quiet_NaN(); }), HasSubstr("power"));
    EXPECT_THAT(said([](MarchedShape& s) { s.rest.power = 1.0f; }), HasSubstr("2 to 12"));
    EXPECT_THAT(said([](MarchedShape& s) { s.iterations = 1000000; }), HasSubstr("1 to 16"));
    EXPECT_THAT(said([](MarchedShape& s) { s.iterations = 0; }), HasSubstr("1 to 16"));
    EXPECT_THAT(said([](MarchedShape& s) { s.kind = 77; }), HasSubstr("kind 77"));
    EXPECT_THAT(said([](MarchedShape& s) { s.half.x = 0.0f; }), HasSubstr("no inside"));
    EXPECT_THAT(said([](MarchedShape& s) { s.material = 9; }), HasSubstr("lacks"));
    Scene glass = with_shape(fits);
    glass.materials[1].alpha_mode = AlphaMode::Blend;
    EXPECT_THAT(said_of(*renderer, glass), HasSubstr("solid"));
    renderer->load(with_shape(fits), {});
    Frame frame = seen();
    frame.shapes = {fits.rest};
    frame.shapes[0].power = 40.0f;
    EXPECT_THROW(renderer->render(frame), Error);
}

}  // namespace
}  // namespace petrichor::gpu
