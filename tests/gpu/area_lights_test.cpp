// Lamps that have a size: their formulas against sums over directions, their pictures against closed forms.
#include <cmath>
#include <random>

#include "formulas/light/brdf.h"
#include "formulas/light/ltc.h"
#include "gpu/passes/lighting/light_tables.h"
#include "scene/light_shape.h"
#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

using glm::vec3;
using namespace shared;

// As the lighting pass reads it.
glm::vec4 matrix(float roughness, float nv)
{
    const float last = static_cast<float>(LTC_TABLE_SIDE - 1);
    const glm::vec2 at = ltc_place(roughness, nv) * last;
    const glm::vec2 low = glm::min(glm::floor(at), glm::vec2(last - 1.0f));
    const glm::vec2 part = at - low;
    const auto first = static_cast<std::size_t>(low.x) * LTC_TABLE_SIDE + static_cast<std::size_t>(low.y);
    const auto table = ltc_table();
    const glm::vec4 a = glm::mix(table[first], table[first + 1], part.y);
    const glm::vec4 b = glm::mix(table[first + LTC_TABLE_SIDE], table[first + LTC_TABLE_SIDE + 1], part.y);
    return glm::mix(a, b, part.x);
}

vec3 direction(float up, float turn)
{
    const float level = std::sqrt(std::max(1.0f - up * up, 0.0f));
    return {level * std::cos(turn), level * std::sin(turn), up};
}

// Whether a ray from the origin meets the lamp.
struct Lamp {
    const char* name;
    Outline outline;
    bool (*hit)(const vec3& d);
};

const vec3 kSphereAt(0.4f, 0.3f, 1.5f);
const vec3 kTubeFrom(-0.9f, 0.6f, 1.2f), kTubeTo(0.9f, 0.3f, 1.6f);
const vec3 kFlatAt(0.5f, -0.2f, 1.6f);

bool near_segment(const vec3& d, const vec3& a, const vec3& b, float radius)
{
    // Distance of the ray to the segment, by its closest points.
    const vec3 e = b - a;
    const float de = glm::dot(d, e), ee = glm::dot(e, e);
    const float across = ee - de * de;
    float t = across > 1e-9f ? (glm::dot(d, a) * de - glm::dot(a, e)) / across : 0.5f;
    t = std::clamp(t, 0.0f, 1.0f);
    const vec3 q = a + e * t;
    return glm::dot(q, d) > 0.0f && glm::length(q - d * glm::dot(q, d)) < radius;
}

std::vector<Lamp> lamps()
{
    return {{"sphere", tube_outline(kSphereAt, kSphereAt, 0.5f),
             [](const vec3& d) { return near_segment(d, kSphereAt, kSphereAt, 0.5f); }},
            {"tube", tube_outline(kTubeFrom, kTubeTo, 0.2f),
             [](const vec3& d) { return near_segment(d, kTubeFrom, kTubeTo, 0.2f); }},
            {"disc", disc_outline(kFlatAt, {0.7f, 0, 0}, {0, -0.7f, 0}),
             [](const vec3& d) {
                 const vec3 at = d * (kFlatAt.z / std::max(d.z, 1e-4f)) - kFlatAt;
                 return d.z > 1e-3f && glm::length(at) < 0.7f;
             }},
            {"rectangle", rectangle_outline(kFlatAt, {0.8f, 0, 0}, {0, -0.4f, 0}), [](const vec3& d) {
                 const vec3 at = d * (kFlatAt.z / std::max(d.z, 1e-4f)) - kFlatAt;
                 return d.z > 1e-3f && std::abs(at.x) < 0.8f && std::abs(at.y) < 0.4f;
             }}};
}

TEST(Outlines, OfAMattSurfaceAreTheSumOverTheirDirections)
{
    const Frame3 level{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (const Lamp& lamp : lamps()) {
        double sum = 0.0;
        const int rows = 700, columns = 700;
        for (int i = 0; i < rows; ++i) {
            for (int j = 0; j < columns; ++j) {
                const float up2 = (static_cast<float>(i) + 0.5f) / rows;
                const float turn = (static_cast<float>(j) + 0.5f) / columns * 6.2831853f;
                if (lamp.hit(direction(std::sqrt(up2), turn))) sum += 1.0;
            }
        }
        sum /= rows * columns;
        EXPECT_NEAR(cosine_share(outline_irradiance(lamp.outline, level)), sum, 0.012 * sum) << lamp.name;
    }
    // A sphere above the horizon: the square of its sine, times the cosine.
    const float share = cosine_share(outline_irradiance(tube_outline(kSphereAt, kSphereAt, 0.5f), level));
    const float far2 = glm::dot(kSphereAt, kSphereAt);
    EXPECT_NEAR(share, 0.25f / far2 * kSphereAt.z / std::sqrt(far2), 0.003f * share);
}

// Share of a GGX lobe, by its own normals (Walter et al. 2007).
double lobe_share(const Lamp& lamp, const vec3& v, float alpha)
{
    double inside = 0.0, all = 0.0;
    const int side = 400;
    for (int i = 0; i < side; ++i) {
        for (int j = 0; j < side; ++j) {
            const float u = (static_cast<float>(i) + 0.5f) / side;
            const float turn = (static_cast<float>(j) + 0.5f) / side * 6.2831853f;
            const vec3 h = direction(1.0f / std::sqrt(1.0f + alpha * alpha * u / (1.0f - u)), turn);
            const vec3 l = 2.0f * glm::dot(v, h) * h - v;
            if (l.z <= 0.0f || glm::dot(v, h) <= 0.0f) continue;
            const double weight = static_cast<double>(ggx_visibility(l.z, v.z, alpha) * l.z * 4.0f *
                                                      glm::dot(v, h) / h.z);
            all += weight;
            if (lamp.hit(l)) inside += weight;
        }
    }
    return inside / all;
}

TEST(Ltc, IsTheSumOverTheLobe)
{
    double worst = 0.0, mean = 0.0;
    int count = 0;
    for (const Lamp& lamp : lamps()) {
        for (const float roughness : {0.15f, 0.3f, 0.5f, 0.75f, 1.0f}) {
            for (const float nv : {0.95f, 0.7f, 0.4f, 0.2f}) {
                // Mirrored at the light, past it, away from it.
                for (const float turn : {3.7f, 3.0f, 0.7f}) {
                    const vec3 v = direction(nv, turn);
                    const Frame3 f = lobe_frame(surface_frame({0, 0, 1}, v), matrix(roughness, nv));
                    const double share =
                        static_cast<double>(cosine_share(outline_irradiance(lamp.outline, f)));
                    const double sum = lobe_share(lamp, v, roughness * roughness);
                    worst = std::max(worst, std::abs(share - sum));
                    mean += std::abs(share - sum);
                    ++count;
                    EXPECT_NEAR(share, sum, 0.06) << lamp.name << " " << roughness << " " << nv << " " << turn;
                }
            }
        }
    }
    EXPECT_LT(mean / count, 0.012) << "worst " << worst;
    std::printf("ltc: mean error %.4f, worst %.4f of the lobe\n", mean / count, worst);
}

TEST(NearestLight, FollowsLuxInItsLimits)
{
    const vec3 centre(0, 0, 2);
    // The ray meets the sphere: towards the ray. It passes by: to the sphere's edge.
    const vec3 meets = glm::normalize(vec3(0.1f, 0, 1));
    EXPECT_NEAR(glm::dot(nearest_light(centre, vec3(0.0f), 0.5f, meets, 0.3f).direction, meets), 1.0f, 1e-6f);
    const vec3 by = glm::normalize(vec3(1, 0, 1));
    const NearestLight edge = nearest_light(centre, vec3(0.0f), 0.5f, by, 0.3f);
    const vec3 expected = glm::normalize(centre + 0.5f * glm::normalize(by * glm::dot(by, centre) - centre));
    EXPECT_NEAR(glm::dot(edge.direction, expected), 1.0f, 1e-6f);
    // Z = (a / sat(a + s / 2))^2 with s = radius over distance; the length takes nothing.
    EXPECT_NEAR(edge.energy, std::pow(0.3f / (0.3f + 0.125f), 2.0f), 1e-6f);
    EXPECT_NEAR(nearest_light(centre, {0.7f, 0, 0}, 0.5f, by, 0.3f).energy, edge.energy, 1e-6f);
    EXPECT_NEAR(nearest_light(centre, vec3(0.0f), 0.5f, by, 0.01f).energy,
                std::pow(0.05f / (0.05f + 0.125f), 2.0f), 1e-6f)
        << "no smoother than 0.05";
    // A tube that the ray runs along: no division by zero.
    const NearestLight along = nearest_light(centre, {0, 0, 0.5f}, 0.1f, {0, 0, 1}, 0.3f);
    EXPECT_NEAR(along.direction.z, 1.0f, 1e-6f);
    // The nearest point along the axis lights matt surfaces.
    EXPECT_NEAR(nearest_on_axis({1.0f, 0, 1}, {2, 0, 0}).z, 1.0f, 1e-6f);
    EXPECT_NEAR(nearest_on_axis({3.0f, 0, 1}, {1, 0, 0}).x, 2.0f / std::sqrt(5.0f), 1e-6f);
}

TEST(LightShapes, KeepTheirCandelaAndRefuseWhatCannotBe)
{
    Light light;
    light.intensity = 12.0f;
    EXPECT_EQ(scene::shape_light(light, {.width_m = 2.0f, .height_m = 0.5f}), "");
    EXPECT_EQ(light.kind, LightKind::Rectangle);
    EXPECT_NEAR(light.intensity, 12.0f, 1e-5f) << "cd/m2 over a square metre";
    EXPECT_NEAR(scene::light_candela(light), 12.0f, 1e-5f);
    light.direction = {1, 0, 0};
    scene::turn_shape(light);
    EXPECT_NEAR(glm::dot(glm::normalize(glm::cross(light.half_u_m, light.half_v_m)), light.direction), 1.0f,
                1e-6f);
    EXPECT_EQ(scene::shape_of_light(light).width_m, 2.0f);
    EXPECT_NE(scene::shape_light(light, {.radius_m = 1.0f}), "");
    Light sun;
    sun.kind = LightKind::Directional;
    EXPECT_NE(scene::shape_light(sun, {.radius_m = 1.0f}), "");
    Light spot;
    spot.kind = LightKind::Spot;
    EXPECT_NE(scene::shape_light(spot, {.radius_m = 1.0f, .length_m = 1.0f}), "");
    EXPECT_NE(scene::shape_light(spot, {.width_m = 1.0f}), "");
    EXPECT_EQ(spot.radius_m, 0.0f) << "as before";
}

using AreaLightTest = GpuTest;

// A floor seen from above, without sun and sky: one pixel is 0.1 m.
Frame from_above()
{
    Frame frame;
    frame.camera = look({0, 8, 0}, {0, 0, 0});
    frame.camera.orthographic_height_m = 6.4f;
    frame.sky.analytic_sun = false;
    frame.settings.width = frame.settings.height = 64;
    frame.settings.samples = 1;
    frame.settings.image_based_light = false;
    frame.settings.draw_sky = false;
    frame.settings.shadows = false;
    frame.settings.exposure = 1.0f;
    return frame;
}

Scene floor_of(const Material& material)
{
    return scene_of({quad({-4, 0, 4}, {8, 0, 0}, {0, 0, -8})}, {material});
}

Material matt()
{
    Material material = plain_material(glm::vec3(0.5f), 1.0f);
    material.lighting_model = "lambert";
    return material;
}

Light ball(float radius)
{
    Light light;
    light.position_m = {0, 1.5f, 0};
    light.intensity = 50.0f;
    light.range_m = 100.0f;
    light.radius_m = radius;
    return light;
}

float at(const RenderResult& r, float x, float z)
{
    return luminance(pixel(r, static_cast<int>(32.0f + 10.0f * x), static_cast<int>(32.0f + 10.0f * z)));
}

TEST_F(AreaLightTest, ASphereLightsAMattFloorAsItsClosedForm)
{
    renderer->load(floor_of(matt()), {});
    Frame frame = from_above();
    frame.extra_lights = {ball(0.6f)};
    const RenderResult r = renderer->render(frame);
    for (const float x : {0.05f, 0.95f, 2.05f}) {
        // A sphere sends to a matt surface what its middle would: 50 cd over the squared distance.
        const float d2 = 1.5f * 1.5f + x * x + 0.0025f;
        const float expected = 0.5f / 3.14159265f * 50.0f / d2 * 1.5f / std::sqrt(d2);
        EXPECT_NEAR(at(r, x, 0.05f), expected, 0.02f * expected) << x;
    }
}

TEST_F(AreaLightTest, ARectangleLightsAMattFloorByItsFormFactor)
{
    renderer->load(floor_of(matt()), {});
    Frame frame = from_above();
    Light light;
    light.position_m = {0, 1, 0};
    light.direction = {0, -1, 0};
    light.up = {0, 0, -1};
    light.range_m = 100.0f;
    light.intensity = 30.0f;
    ASSERT_EQ(scene::shape_light(light, {.width_m = 1.0f, .height_m = 1.0f}), "");
    frame.extra_lights = {light};
    const RenderResult r = renderer->render(frame);
    EXPECT_NEAR(at(r, 0.05f, 0.05f), 0.5f * 30.0f * 0.23946f, 0.02f * 3.6f);
    frame.extra_lights[0].direction = {0, 1, 0};
    scene::turn_shape(frame.extra_lights[0]);
    EXPECT_EQ(at(renderer->render(frame), 0, 0), 0.0f) << "it shines away";
    frame.extra_lights[0].both_sides = true;
    EXPECT_NEAR(at(renderer->render(frame), 0.05f, 0.05f), at(r, 0.05f, 0.05f), 1e-2f);
}

TEST_F(AreaLightTest, ShapesWidenHighlightsAndKeepTheLightOfAPoint)
{
    renderer->load(floor_of(plain_material(glm::vec3(0.2f), 0.25f)), {});
    for (const AreaLights way : {AreaLights::Ltc, AreaLights::Nearest}) {
        Frame frame = from_above();
        frame.settings.area_lights = way;
        frame.extra_lights = {ball(0.0f)};
        const RenderResult point = renderer->render(frame);
        frame.extra_lights = {ball(0.5f)};
        const RenderResult sphere = renderer->render(frame);
        EXPECT_LT(at(sphere, 0, 0), 0.7f * at(point, 0, 0)) << "the light of a point, spread";
        EXPECT_GT(at(sphere, 0.4f, 0), 1.2f * at(point, 0.4f, 0));
        EXPECT_NEAR(at(sphere, 2.9f, 0.0f), at(point, 2.9f, 0.0f), 0.15f * at(point, 2.9f, 0.0f));
        Light tube = ball(0.1f);
        tube.length_m = 2.0f;
        tube.up = {1, 0, 0};
        frame.extra_lights = {tube};
        const RenderResult long_one = renderer->render(frame);
        EXPECT_GT(at(long_one, 0.6f, 0), 1.5f * at(long_one, 0, 0.6f)) << "along its axis";
        frame.settings.area_lights = AreaLights::Off;
        frame.extra_lights = {ball(0.5f)};
        frame.extra_lights[0].range_m = 100.0f;
        EXPECT_EQ(renderer->render(frame).beauty, point.beauty) << "off, it is a point";
    }
}

// One floor sees the sizes of lamps, another in the same picture does not: there it is as with all sizes off.
TEST_F(AreaLightTest, AMaterialMaySeeLampsAsPoints)
{
    const Material by_size = plain_material(glm::vec3(0.2f), 0.25f);
    Material by_point = by_size;
    by_point.area_lights = false;
    Light tube = ball(0.3f);
    tube.length_m = 1.0f;
    tube.up = {1, 0, 0};
    tube.range_m = 100.0f;
    for (const AreaLights way : {AreaLights::Ltc, AreaLights::Nearest}) {
        for (const bool shadowed : {false, true}) {
            Frame frame = from_above();
            frame.settings.area_lights = way;
            frame.settings.lamp_shadows = shadowed ? 1 : 0;
            frame.extra_lights = {tube};
            renderer->load(floor_of(by_size), {});
            const RenderResult sized = renderer->render(frame);
            frame.settings.area_lights = AreaLights::Off;
            const RenderResult off = renderer->render(frame);
            frame.settings.area_lights = way;
            renderer->load(floor_of(by_point), {});
            const RenderResult points = renderer->render(frame);
            for (const float x : {0.0f, 0.4f, 1.5f})
                EXPECT_NEAR(at(points, x, 0), at(off, x, 0), 0.01f * at(off, x, 0)) << x;
            EXPECT_LT(at(sized, 0, 0), 0.8f * at(points, 0, 0));
            // Both in one picture: the left half by size.
            Scene both = scene_of({quad({-4, 0, 4}, {4, 0, 0}, {0, 0, -8}, 0), quad({0, 0, 4}, {4, 0, 0}, {0, 0, -8}, 1)},
                                  {by_size, by_point});
            renderer->load(both, {});
            const RenderResult halves = renderer->render(frame);
            EXPECT_NEAR(at(halves, -0.4f, 0), at(sized, -0.4f, 0), 0.01f * at(sized, -0.4f, 0));
            EXPECT_NEAR(at(halves, 0.4f, 0), at(points, 0.4f, 0), 0.01f * at(points, 0.4f, 0));
        }
    }
}

TEST_F(AreaLightTest, ADiscShinesFromItsFrontWithinItsCone)
{
    renderer->load(floor_of(matt()), {});
    Frame frame = from_above();
    Light disc = ball(0.4f);
    disc.kind = LightKind::Spot;
    disc.direction = {0, -1, 0};
    disc.outer_cone_rad = 0.8f;
    frame.extra_lights = {disc};
    const RenderResult r = renderer->render(frame);
    const float expected = 0.5f / 3.14159265f * 50.0f / (1.5f * 1.5f + 0.16f);
    EXPECT_NEAR(at(r, 0.0f, 0.0f), expected, 0.03f * expected) << "of a disc: r2 / (r2 + h2)";
    EXPECT_EQ(at(r, 2.5f, 0.0f), 0.0f) << "out of the cone";
    frame.extra_lights[0].direction = {0, 1, 0};
    EXPECT_EQ(at(renderer->render(frame), 0, 0), 0.0f);
}

TEST_F(AreaLightTest, AFillLightIsMirroredNowhere)
{
    const Scene shiny = floor_of(plain_material(glm::vec3(0.2f), 0.25f));
    Scene rough = shiny;
    rough.materials[0].ior = 1.0f;  // nothing is mirrored
    Frame frame = from_above();
    for (const float radius : {0.0f, 0.3f}) {
        renderer->load(shiny, {});
        frame.extra_lights = {ball(radius)};
        const float all = at(renderer->render(frame), 0, 0);
        frame.extra_lights[0].specular = 0.5f;
        const float half = at(renderer->render(frame), 0, 0);
        frame.extra_lights[0].specular = 0.0f;
        const float fill = at(renderer->render(frame), 0, 0);
        EXPECT_LT(fill, 0.5f * all);
        EXPECT_NEAR(half, 0.5f * (all + fill), 0.01f * all);
        renderer->load(rough, {});
        const float none = at(renderer->render(frame), 0, 0);
        EXPECT_NEAR(fill, none, 0.06f * none) << "what is not mirrored stays";
    }
}

// Nor in a coat, which takes its share on the way in all the same.
TEST_F(AreaLightTest, AFillLightIsNotMirroredByACoat)
{
    Scene matt = floor_of(plain_material(glm::vec3(0.2f), 0.9f));
    matt.materials[0].ior = 1.0f;
    Scene coated = matt;
    coated.materials[0].clearcoat = 1.0f;
    coated.materials[0].clearcoat_roughness = 0.25f;
    Frame frame = from_above();
    for (const AreaLights area : {AreaLights::Ltc, AreaLights::Nearest}) {
        frame.settings.area_lights = area;
        for (const float radius : {0.0f, 0.3f}) {
            renderer->load(coated, {});
            frame.extra_lights = {ball(radius)};
            const float all = at(renderer->render(frame), 0, 0);
            frame.extra_lights[0].specular = 0.0f;
            const float fill = at(renderer->render(frame), 0, 0);
            renderer->load(matt, {});
            const float none = at(renderer->render(frame), 0, 0);
            EXPECT_GT(all, 1.2f * none) << radius;
            EXPECT_NEAR(fill, 0.96f * none, 0.02f * none) << radius;
        }
    }
}

TEST_F(AreaLightTest, ListsAreWhatAllLightsGive)
{
    std::mt19937 random(5);
    const auto unit = [&random] { return static_cast<float>(random() >> 8) / 16777216.0f; };
    renderer->load(floor_of(plain_material(glm::vec3(0.5f), 0.4f)), {});
    Frame frame = from_above();
    for (int i = 0; i < 60; ++i) {
        Light light;
        light.kind = i % 4 == 1 ? LightKind::Spot : LightKind::Point;
        light.position_m = {6.0f * unit() - 3.0f, 0.3f + unit(), 6.0f * unit() - 3.0f};
        light.direction = glm::normalize(glm::vec3(unit() - 0.5f, -1.0f, unit() - 0.5f));
        light.up = glm::normalize(glm::vec3(unit(), 0.3f * unit(), unit() - 0.5f));
        light.intensity = 2.0f * unit();
        light.range_m = i % 3 == 0 ? 0.0f : 1.0f + unit();
        if (i % 4 == 3) {
            ASSERT_EQ(scene::shape_light(light, {.width_m = unit() + 0.1f, .height_m = 0.2f}), "");
        } else if (i % 4 != 0) {
            light.radius_m = 0.02f + 0.2f * unit();
            if (i % 4 == 2) light.length_m = unit();
        }
        frame.extra_lights.push_back(light);
    }
    for (const AreaLights way : {AreaLights::Ltc, AreaLights::Nearest}) {
        frame.settings.area_lights = way;
        frame.settings.all_lights = false;
        const RenderResult lists = renderer->render(frame);
        frame.settings.all_lights = true;
        EXPECT_EQ(lists.beauty, renderer->render(frame).beauty);
    }
}

}  // namespace
}  // namespace petrichor::gpu
