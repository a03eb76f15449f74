// Bent normals of the screen's occlusion, beside sums over all directions: on the floor beside a wall and under an awning.
#include <algorithm>
#include <cmath>
#include <functional>

#include "formulas/light/brdf.h"
#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

constexpr int kSize = 64;
constexpr float kView_m = 1.6f;
constexpr float kTurn = 6.2831853f;
constexpr float kSlope = 0.9f;

// How much of a ray is left: what is farther than the radius hides nothing.
float left_at(float distance_m, float radius_m)
{
    return 1.0f - std::clamp(5.0f - 5.0f * distance_m * distance_m / (radius_m * radius_m), 0.0f, 1.0f);
}

using Left = std::function<float(const glm::vec3&)>;

// Brighter towards one side of the world.
EnvironmentMap bright_to(float side)
{
    EnvironmentMap map;
    map.width = 128;
    map.height = 64;
    for (int y = 0; y < map.height; ++y) {
        for (int x = 0; x < map.width; ++x) {
            const float down = 0.5f * kTurn * (static_cast<float>(y) + 0.5f) / static_cast<float>(map.height);
            const float turn = kTurn * (static_cast<float>(x) + 0.5f) / static_cast<float>(map.width);
            map.rgb.insert(map.rgb.end(), 3, 1.0f + kSlope * side * std::sin(down) * -std::sin(turn));
        }
    }
    return map;
}

// Light from a sky that is brighter towards x over one that is brighter the other way.
float ratio_of(const Left& left)
{
    double one = 0.0, other = 0.0;
    const int rows = 200, columns = 400;
    for (int i = 0; i < rows; ++i) {
        for (int j = 0; j < columns; ++j) {
            const float up = std::sqrt((static_cast<float>(i) + 0.5f) / rows), turn = kTurn * (static_cast<float>(j) + 0.5f) / columns;
            const float level = std::sqrt(1.0f - up * up);
            const glm::vec3 d(level * std::cos(turn), up, level * std::sin(turn));
            one += static_cast<double>(left(d) * (1.0f + kSlope * d.x));
            other += static_cast<double>(left(d) * (1.0f - kSlope * d.x));
        }
    }
    return static_cast<float>(one / other);
}

class BentNormals : public GpuTest {
protected:
    void SetUp() override
    {
        GpuTest::SetUp();
        frame.settings.width = frame.settings.height = kSize;
        frame.settings.samples = 32;
        frame.settings.shadows = false;
        frame.settings.exposure = 1.0f;
        frame.settings.aovs = {"diffuse_indirect", "specular_indirect"};
        frame.sky.analytic_sun = false;
        frame.sky.sun_illuminance = 0.0f;
        frame.weather.visibility_m = 1e9f;
    }
    void TearDown() override
    {
        if (renderer) renderer->set_environment({});
        GpuTest::TearDown();
    }

    void see(const glm::vec3& eye, const glm::vec3& target)
    {
        frame.camera = look(eye, target);
        frame.camera.orthographic_height_m = kView_m;
    }

    // The mean of what is seen at a place, over three by three pixels.
    float at(const RenderResult& r, const std::string& layer, const glm::vec3& place) const
    {
        const glm::vec3 c(glm::inverse(frame.camera.to_world) * glm::vec4(place, 1.0f));
        const bool parallel = frame.camera.orthographic_height_m > 0.0f;
        const float view_m = parallel ? kView_m : -2.0f * c.z * std::tan(0.5f * frame.camera.vertical_fov_rad);
        const int x = static_cast<int>((c.x / view_m + 0.5f) * kSize), y = static_cast<int>((0.5f - c.y / view_m) * kSize);
        float sum = 0.0f;
        for (int dy = -1; dy <= 1; ++dy) {
            for (int dx = -1; dx <= 1; ++dx) sum += aov(r, layer, x + dx, y + dy, 1);
        }
        return sum / 9.0f;
    }

    // Of scattered light, as ratio_of().
    float ratio(const glm::vec3& place)
    {
        float of[2] = {};
        for (int i = 0; i < 2; ++i) {
            renderer->set_environment(bright_to(i == 0 ? 1.0f : -1.0f));
            of[i] = at(renderer->render(frame), "diffuse_indirect", place);
        }
        return of[0] / of[1];
    }

    static Scene beside_wall(const Material& material)
    {
        // As wide as occlusion reaches 0.7 m.
        return scene_of({quad({-20, 0, 20}, {40, 0, 0}, {0, 0, -40}), quad({0, 0, -20}, {0, 0, 40}, {0, 3, 0})}, {material});
    }

    Frame frame;
};

constexpr float kRadius_m = 0.7f;

TEST_F(BentNormals, OnTheFloorBesideAWallLightComesFromTheOpenSide)
{
    if (!renderer) return;
    renderer->load(beside_wall(plain_material(glm::vec3(0.5f), 1.0f)), {});
    see({-4, 4, 0}, {-0.2f, 0.2f, 0});
    for (const float away : {0.08f, 0.12f, 0.2f}) {
        const glm::vec3 place(-away, 0, 0);
        const float truth = ratio_of([&](const glm::vec3& d) { return d.x > 0.0f ? left_at(away / d.x, kRadius_m) : 1.0f; });
        frame.settings.bent_normals = true;
        // The picture's few depths find three quarters of what is hidden.
        const float found = ratio(place);
        EXPECT_NEAR(found, truth, 0.4f * (1.0f - truth)) << away;
        RecordProperty("away" + std::to_string(away), std::to_string(found) + " " + std::to_string(truth));
        frame.settings.bent_normals = false;
        EXPECT_NEAR(ratio(place), 1.0f, 0.02f) << away << ": without, the sky is even on both sides";
    }
}

TEST_F(BentNormals, UnderAnAwningLightComesFromTheFront)
{
    if (!renderer) return;
    const float high = 0.35f;
    // It ends at x = 0; the eye looks in below it.
    renderer->load(scene_of({quad({-20, 0, 20}, {40, 0, 0}, {0, 0, -40}), quad({-3, high, -20}, {3, 0, 0}, {0, 0, 40})},
                            {plain_material(glm::vec3(0.5f), 1.0f)}), {});
    frame.camera = look({1.4f, 0.2f, 0}, {-0.1f, 0.17f, 0}, 0.7f);
    const glm::vec3 place(-0.4f, 0, 0);
    const float truth = ratio_of([&](const glm::vec3& d) {
        const float way = high / std::max(d.y, 1e-4f);
        return place.x + d.x * way < 0.0f ? left_at(way, kRadius_m) : 1.0f;
    });
    frame.settings.bent_normals = true;
    EXPECT_GT(truth, 1.1f);
    const float found = ratio(place);
    EXPECT_NEAR(found, truth, 0.5f * (truth - 1.0f));
    RecordProperty("ratio", std::to_string(found) + " " + std::to_string(truth));
    frame.settings.bent_normals = false;
    EXPECT_NEAR(ratio(place), 1.0f, 0.03f);
}

TEST_F(BentNormals, AMirrorSeesMoreOfTheWallTowardsIt)
{
    if (!renderer) return;
    const float roughness = 0.5f, away = 0.08f, alpha = roughness * roughness;
    renderer->load(beside_wall(plain_material(glm::vec3(0.9f), roughness, 1.0f)), {});
    renderer->set_environment(constant_environment(1.0f));
    const glm::vec3 place(-away, 0, 0);
    // From before the wall, and along it.
    const glm::vec3 eyes[] = {{-4, 4, 0}, {-0.8f, 4, 4}};
    const auto truth = [&](const glm::vec3& eye) {
        const glm::vec3 v = glm::normalize(eye - place);
        double whole = 0.0, left = 0.0;
        for (int i = 0; i < 300; ++i) {
            for (int j = 0; j < 300; ++j) {
                const float u = (static_cast<float>(i) + 0.5f) / 300.0f, turn = kTurn * (static_cast<float>(j) + 0.5f) / 300.0f;
                const float up = std::sqrt((1.0f - u) / (1.0f + (alpha * alpha - 1.0f) * u)), level = std::sqrt(1.0f - up * up);
                const glm::vec3 h(level * std::cos(turn), up, level * std::sin(turn));
                const float vh = glm::dot(v, h);
                const glm::vec3 l = 2.0f * vh * h - v;
                if (l.y <= 0.0f || vh <= 0.0f) continue;
                const double weight = static_cast<double>(shared::ggx_visibility(l.y, v.y, alpha) * 4.0f * l.y * vh / up);
                whole += weight;
                left += weight * static_cast<double>(l.x > 0.0f ? left_at(away / l.x, kRadius_m) : 1.0f);
            }
        }
        return static_cast<float>(left / whole);
    };
    // The rest that is mirrored, and the sky's own visibility, are the same on both.
    const auto seen = [&](bool bent) {
        frame.settings.bent_normals = bent;
        float of[2] = {};
        for (int i = 0; i < 2; ++i) {
            see(eyes[i], place);
            of[i] = at(renderer->render(frame), "specular_indirect", place);
        }
        return of[0] / of[1];
    };
    const float wanted = truth(eyes[0]) / truth(eyes[1]);
    const float by_cones = seen(true), by_angle = seen(false);
    RecordProperty("ratio", std::to_string(by_cones) + " " + std::to_string(by_angle) + " " + std::to_string(wanted));
    EXPECT_LT(wanted, 0.5f);
    EXPECT_LT(by_cones, 0.85f * by_angle) << "of which both views have another share of the wall";
}

// Samples that look for their own pixels keep them, too.
TEST_F(BentNormals, AreThoseOfThePictureWhereSamplesAreListed)
{
    if (!renderer) return;
    renderer->load(beside_wall(plain_material(glm::vec3(0.5f), 1.0f)), {});
    renderer->set_environment(bright_to(1.0f));
    see({-4, 4, 0}, {-0.2f, 0.2f, 0});
    frame.settings.bent_normals = true;
    const RenderResult all = renderer->render(frame);
    frame.settings.adaptive = 1.0e-6f;
    const RenderResult listed = renderer->render(frame);
    const glm::vec3 place(-0.2f, 0, 0);
    EXPECT_NEAR(at(listed, "diffuse_indirect", place) / at(all, "diffuse_indirect", place), 1.0f, 0.04f);
}

}  // namespace
}  // namespace petrichor::gpu
