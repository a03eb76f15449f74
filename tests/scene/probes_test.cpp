// Reflection probes: what they see, where they stand, and the light that they hold.
#include "scene/probes/probes.h"

#include <gtest/gtest.h>

#include <random>

#include "formulas/codec/octahedral.h"
#include "formulas/light/reflection_probe.h"
#include "tests/scene/patch_scenes.h"

namespace petrichor::scene {
namespace {

using namespace patch_scenes;
constexpr float kPi = 3.14159265f;

struct Traced {
    explicit Traced(Scene s) : scene(std::move(s)), triangles(scene, {}), tracer(triangles)
    {
        PatchOptions options;
        options.cell_m = 0.5f;
        patches = build_patches(tracer, options);
        surfaces = patch_surfaces(patches, triangles, {});
    }
    TracedProbe probe(const ProbePlace& place, int threads = 0) const
    {
        return trace_probe(patches, tracer, surfaces, {}, place, threads);
    }
    Scene scene;
    Triangles triangles;
    Tracer tracer;
    Patches patches;
    std::vector<PatchSurface> surfaces;
};

ProbePlace at(glm::vec3 position)
{
    ProbePlace place;
    place.position_m = position;
    return place;
}

// As the shader looks it up.
glm::vec4 seen(const std::vector<glm::vec4>& light, int level, glm::vec3 way)
{
    const int side = shared::reflection_probe_side(level), wide = side + 2;
    const glm::vec2 p = (shared::octahedral_encode(way) * 0.5f + 0.5f) * static_cast<float>(side) + 0.5f;
    const glm::ivec2 low(glm::floor(p));
    const glm::vec2 f = p - glm::vec2(low);
    const auto texel = [&](int x, int y) {
        return light[static_cast<std::size_t>(shared::reflection_probe_offset(level) +
                                              (low.y + y) * wide + low.x + x)];
    };
    return glm::mix(glm::mix(texel(0, 0), texel(1, 0), f.x), glm::mix(texel(0, 1), texel(1, 1), f.x),
                    f.y);
}

glm::vec3 random_way(std::mt19937& random)
{
    std::normal_distribution<float> normal;
    return glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
}

TEST(Probes, InAClosedRoomAllLightIsThatOfTheWalls)
{
    const Traced room_of(room());
    const TracedProbe probe = room_of.probe(at({1.0f, 1.6f, 2.5f}));
    const std::vector<glm::vec3> radiosity(room_of.patches.count, glm::vec3(2.0f, 1.0f, 0.5f) * kPi);
    const auto light = lit_probe(probe, radiosity);
    ASSERT_EQ(light.size(),
              static_cast<std::size_t>(shared::reflection_probe_offset(shared::kProbeLevels)));
    for (const glm::vec4& texel : light) {
        ASSERT_NEAR(texel.r, 2.0f, 1e-4f);
        ASSERT_NEAR(texel.g, 1.0f, 1e-4f);
        ASSERT_NEAR(texel.b, 0.5f, 1e-4f);
        ASSERT_NEAR(texel.a, 0.0f, 1e-6f);
    }
}

// Six walls, six colours: any direction finds its own, over the seams of the map too.
TEST(Probes, EveryDirectionFindsItsWall)
{
    const Traced room_of(room());
    const TracedProbe probe = room_of.probe(at(glm::vec3(2.0f)));
    const auto color_of = [](glm::vec3 inward) {
        return glm::vec3(2.0f) + glm::vec3(1.0f, 0.5f, 0.25f) * inward;
    };
    std::vector<glm::vec3> radiosity;
    for (std::uint32_t i = 0; i < room_of.patches.count; ++i)
        radiosity.push_back(color_of(room_of.patches.normal[i]) * kPi);
    const auto light = lit_probe(probe, radiosity);
    std::mt19937 random(5);
    int asked = 0;
    for (int i = 0; i < 4000; ++i) {
        const glm::vec3 way = random_way(random), size = glm::abs(way);
        const int axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
        glm::vec3 inward(0.0f);
        inward[axis] = way[axis] > 0.0f ? -1.0f : 1.0f;
        // Away from the edges of the room by more than a texel.
        glm::vec3 rest = size;
        rest[axis] = 0.0f;
        if (std::max({rest.x, rest.y, rest.z}) > 0.9f * size[axis]) continue;
        ++asked;
        const glm::vec3 found(seen(light, 0, way));
        EXPECT_LT(glm::distance(found, color_of(inward)), 1e-3f)
            << way.x << " " << way.y << " " << way.z;
    }
    EXPECT_GT(asked, 2000);
}

// A wall of polished copper shows the wall across the room in its own colour; between two of them a ray ends.
TEST(Probes, MirrorsShowWhatTheyMirror)
{
    for (const bool two : {false, true}) {
        Scene scene = empty_scene();
        scene.materials.resize(2);
        scene.materials[1].base_color = glm::vec4(1.0f, 0.5f, 0.25f, 1.0f);
        scene.materials[1].metallic = 1.0f;
        scene.materials[1].roughness = 0.1f;
        scene.meshes[0].primitives.resize(2);
        scene.meshes[0].primitives[1].material = 1;
        add_box(scene, glm::vec3(0.0f), glm::vec3(4.0f), true);
        add_face(scene, {3.8f, 0, 0}, {0, 0, 4}, {0, 4, 0}, 1);
        if (two) add_face(scene, {0.2f, 0, 0}, {0, 4, 0}, {0, 0, 4}, 1);
        const Traced room_of(scene);
        std::vector<glm::vec3> radiosity;
        for (std::uint32_t i = 0; i < room_of.patches.count; ++i) {
            const bool copper = room_of.patches.material[i] == 1;
            radiosity.push_back((copper ? glm::vec3(9.0f) : glm::vec3(room_of.patches.normal[i].x > 0.5f ? 2.0f : 1.0f)) * kPi);
        }
        const auto light = lit_probe(room_of.probe(at(glm::vec3(2.0f))), radiosity);
        const glm::vec3 ahead(seen(light, 0, glm::normalize(glm::vec3(1.0f, 0.04f, 0.05f))));
        if (two) {
            EXPECT_NEAR(ahead.g, 9.0f, 0.1f) << "as matt as its patch";
            continue;
        }
        EXPECT_NEAR(ahead.r, 2.0f, 0.05f);
        EXPECT_NEAR(ahead.g, 1.0f, 0.05f);
        EXPECT_NEAR(ahead.b, 0.5f, 0.05f);
        const glm::vec3 behind(seen(light, 0, glm::normalize(glm::vec3(-1.0f, 0.1f, 0.13f))));
        EXPECT_NEAR(behind.g, 2.0f, 0.05f) << "no mirror there";
    }
}

TEST(Probes, OverOpenGroundTheSkyIsLeftToTheSky)
{
    Scene scene = empty_scene();
    add_face(scene, {-50, 0, 50}, {100, 0, 0}, {0, 0, -100});
    const Traced open(scene);
    const auto light = lit_probe(open.probe(at({0, 1.6f, 0})),
                                 std::vector<glm::vec3>(open.patches.count, glm::vec3(kPi)));
    for (int level = 0; level < shared::kProbeLevels; ++level) {
        EXPECT_NEAR(seen(light, level, {0, 1, 0}).a, 1.0f, 0.01f) << level;
        EXPECT_NEAR(seen(light, level, {0, 1, 0}).r, 0.0f, 0.01f) << level;
        EXPECT_NEAR(seen(light, level, {0.1f, -1, 0.2f}).a, 0.0f, 0.01f) << level;
        EXPECT_NEAR(seen(light, level, {0.1f, -1, 0.2f}).r, 1.0f, 0.01f) << level;
    }
    // The rougher, the softer the horizon.
    const glm::vec3 above = glm::normalize(glm::vec3(1.0f, 0.12f, 0.3f));
    EXPECT_GT(seen(light, 0, above).a, 0.99f);
    EXPECT_LT(seen(light, 2, above).a, seen(light, 0, above).a - 0.02f);
}

TEST(Probes, AnyNumberOfThreadsSeesTheSame)
{
    const Traced room_of(room());
    const TracedProbe one = room_of.probe(at({1, 2, 3}), 1), four = room_of.probe(at({1, 2, 3}), 4);
    ASSERT_EQ(one.texels.size(), four.texels.size());
    for (std::size_t i = 0; i < one.texels.size(); ++i)
        ASSERT_EQ(one.texels[i].patch, four.texels[i].patch);
}

TEST(Probes, AutomaticOnesStandInTheOpenAndApart)
{
    Scene scene = empty_scene();
    add_face(scene, {-10, 0, 10}, {20, 0, 0}, {0, 0, -20});
    add_box(scene, {-4, 0, -4}, {4, 5, 4}, false);
    const Traced yard(scene);
    const auto places = place_probes(yard.patches, yard.tracer, 4);
    ASSERT_GE(places.size(), 2u);
    ASSERT_LE(places.size(), 4u);
    for (const ProbePlace& place : places) {
        const glm::vec3 p = place.position_m;
        const bool within = std::abs(p.x) < 4 && std::abs(p.z) < 4 && p.y < 5;
        EXPECT_FALSE(within) << p.x << " " << p.y << " " << p.z;
        for (int i = 0; i < 3; ++i) {
            EXPECT_LT(place.low_m[i], p[i]);
            EXPECT_GT(place.high_m[i], p[i]);
        }
        for (const ProbePlace& other : places) {
            if (&other != &place) { EXPECT_GT(glm::distance(other.position_m, p), 3.0f); }
        }
    }
    // .. and so they do where the ground reaches out to the horizon.
    Scene wide = empty_scene();
    add_face(wide, {-1000, -0.01f, 1000}, {2000, 0, 0}, {0, 0, -2000});
    for (int x = -2; x <= 2; ++x) {
        for (int z = -2; z <= 2; ++z)
            add_box(wide, {8 * x - 2, 0, 8 * z - 2}, {8 * x + 2, 5, 8 * z + 2}, false);
    }
    const Traced town(wide);
    for (const ProbePlace& place : place_probes(town.patches, town.tracer, 4)) {
        EXPECT_LT(std::abs(place.position_m.x), 40.0f);
        EXPECT_LT(std::abs(place.position_m.z), 40.0f);
        EXPECT_LT(place.blend_m, 60.0f);
    }
    Scene crumb = empty_scene();
    add_box(crumb, glm::vec3(0.0f), glm::vec3(0.2f), false);
    const Traced small(crumb);
    EXPECT_TRUE(place_probes(small.patches, small.tracer, 4).empty());
}

// What the harmonics of a probe say of a lobe of a roughness about a direction.
glm::vec4 in_lobe(const std::array<glm::vec4, shared::kHarmonics>& bands, glm::vec3 way, float roughness)
{
    glm::vec4 sum(0.0f);
    for (int i = 0; i < shared::kHarmonics; ++i)
        sum += bands[static_cast<std::size_t>(i)] *
               (shared::harmonic(i, way) * shared::ggx_band(i, roughness * roughness));
    return sum;
}

TEST(ProbeBands, AFurnaceIsOneInEveryLobe)
{
    const Traced room_of(room());
    const TracedProbe probe = room_of.probe(at({1.0f, 1.6f, 2.5f}));
    const std::vector<glm::vec3> radiosity(room_of.patches.count, glm::vec3(2.0f, 1.0f, 0.5f) * kPi);
    const auto bands = probe_bands(lit_probe(probe, radiosity));
    std::mt19937 random(3);
    for (int i = 0; i < 200; ++i) {
        const glm::vec4 found = in_lobe(bands, random_way(random), 0.32f + 0.68f * static_cast<float>(i) / 200.0f);
        ASSERT_NEAR(found.r, 2.0f, 0.01f);
        ASSERT_NEAR(found.b, 0.5f, 0.0025f);
        ASSERT_NEAR(found.a, 0.0f, 1e-6f);
    }
}

TEST(ProbeBands, TwoNumbersShareAWord)
{
    for (int i = -64; i <= 64; ++i) {
        for (int k = -64; k <= 64; ++k) {
            const glm::vec2 numbers = glm::vec2(i, k) / 64.0f;
            const glm::vec2 found = shared::probe_bands_of_word(shared::probe_band_word(numbers)) / shared::kProbeBandOne;
            ASSERT_NEAR(found.x, numbers.x, 0.51f / 32767.0f);
            ASSERT_NEAR(found.y, numbers.y, 0.51f / 32767.0f);
        }
    }
}

// A wall of another colour on each side: the sum over the lobe, ray by ray.
TEST(ProbeBands, LobesGatherWhatTheyLookAt)
{
    const Traced room_of(room());
    const TracedProbe probe = room_of.probe(at(glm::vec3(2.0f)));
    std::vector<glm::vec3> radiosity;
    for (std::uint32_t i = 0; i < room_of.patches.count; ++i)
        radiosity.push_back(kPi * (glm::vec3(2.0f) + glm::vec3(1.0f, 0.5f, 0.25f) * room_of.patches.normal[i]));
    const auto light = lit_probe(probe, radiosity);
    const auto bands = probe_bands(light);
    std::mt19937 random(4);
    for (const float roughness : {0.4f, 0.6f, 0.8f, 1.0f}) {
        const float a2 = roughness * roughness * roughness * roughness;
        for (int i = 0; i < 12; ++i) {
            const glm::vec3 way = random_way(random);
            glm::vec3 sum(0.0f);
            float weights = 0.0f;
            for (int k = 0; k < 20000; ++k) {
                const glm::vec3 l = random_way(random);
                const float nl = glm::dot(l, way);
                if (nl <= 0.0f) continue;
                const float d = (0.5f + 0.5f * nl) * (a2 - 1.0f) + 1.0f;
                sum += glm::vec3(seen(light, 0, l)) * (nl / (d * d));
                weights += nl / (d * d);
            }
            // Of walls of 1 to 3; nine functions round their edges off in the sharpest lobe.
            EXPECT_NEAR(in_lobe(bands, way, roughness).r, sum.r / weights, roughness < 0.5f ? 0.25f : 0.12f)
                << roughness << " " << way.x << " " << way.y << " " << way.z;
        }
    }
}

TEST(ProbeBands, TheFitIsThatOfTheLobes)
{
    for (const float alpha : {0.02f, 0.1f, 0.2f, 0.4f, 0.6f, 0.8f, 1.0f}) {
        double all = 0.0, first = 0.0, second = 0.0;
        for (int k = 0; k < 200000; ++k) {
            const double t = (k + 0.5) / 200000.0, x = 1.0 - t * t * t;
            const double a2 = static_cast<double>(alpha) * static_cast<double>(alpha);
            const double d = (0.5 + 0.5 * x) * (a2 - 1.0) + 1.0;
            const double w = x / (d * d) * t * t;
            all += w;
            first += w * x;
            second += w * (1.5 * x * x - 0.5);
        }
        EXPECT_NEAR(static_cast<double>(shared::ggx_band(1, alpha)), first / all, 0.004) << alpha;
        EXPECT_NEAR(static_cast<double>(shared::ggx_band(4, alpha)), second / all, 0.008) << alpha;
    }
    for (int i = 0; i < shared::kHarmonics; ++i)
        EXPECT_NEAR(shared::ggx_band(i, 1.0f), shared::cosine_band(i), 1e-3f);
}

TEST(ReflectionProbe, RaysMeetTheWallsWhereTheyAre)
{
    const glm::vec3 low{-3, 0, -2}, high{5, 4, 2}, centre{1, 1.6f, 0.5f};
    std::mt19937 random(9);
    std::uniform_real_distribution<float> unit;
    for (int i = 0; i < 1000; ++i) {
        const glm::vec3 from = glm::mix(low, high, glm::vec3(unit(random), unit(random), unit(random)));
        const glm::vec3 ray = random_way(random);
        const glm::vec3 met = centre + shared::box_projected(from, ray, low, high, centre);
        // On a wall, and on the ray.
        const glm::vec3 to_wall = glm::min(glm::abs(met - low), glm::abs(high - met));
        EXPECT_LT(std::min({to_wall.x, to_wall.y, to_wall.z}), 1e-3f);
        EXPECT_LT(glm::length(glm::cross(glm::normalize(met - from), ray)), 1e-3f);
    }
}

// Beyond the walls, where a probe fades out, nothing jumps from a ray to the next, nor on the way out.
TEST(ReflectionProbe, NothingJumpsBeyondTheWalls)
{
    const glm::vec3 low{-3, 0, -2}, high{5, 4, 2}, centre{1, 1.6f, 0.5f};
    const auto way = [&](glm::vec3 from, glm::vec3 ray) {
        return glm::normalize(shared::box_projected(from, glm::normalize(ray), low, high, centre));
    };
    std::mt19937 random(11);
    std::uniform_real_distribution<float> unit;
    for (int i = 0; i < 1000; ++i) {
        const glm::vec3 from(5.2f + 6.0f * unit(random), 4.0f * unit(random), 4.0f * unit(random) - 2.0f);
        const glm::vec3 ray(0.0f, unit(random) - 0.5f, unit(random) - 0.5f);
        if (glm::length(ray) < 0.05f) continue;
        const glm::vec3 step(1e-4f, 0.0f, 0.0f);
        EXPECT_GT(glm::dot(way(from, ray + step), way(from, ray - step)), 0.999f);
    }
    EXPECT_GT(glm::dot(way({4.9999f, 1, 0}, {0.3f, 0.2f, 1}), way({5.0001f, 1, 0}, {0.3f, 0.2f, 1})), 0.999f);
}

TEST(ReflectionProbe, WeightsAddUpToOneAndDoNotJump)
{
    for (const float third : {0.0f, 0.3f, 0.999f}) {
        const glm::vec2 w = shared::reflection_probe_blend({1.0f, std::max(third, 0.4f), third});
        EXPECT_NEAR(w.x + w.y, 1.0f, 1e-5f);
        EXPECT_GE(w.y, 0.0f);
    }
    // Where the second and the third change places the second counts next to nothing.
    EXPECT_LT(shared::reflection_probe_blend({1.0f, 0.5f, 0.5f}).y, 0.02f);
    const glm::vec3 low(-1.0f), high(1.0f);
    EXPECT_EQ(shared::reflection_probe_share({0.9f, 0, 0}, low, high, 2.0f), 1.0f);
    EXPECT_NEAR(shared::reflection_probe_share({2.0f, 0, 0}, low, high, 2.0f), 0.5f, 1e-6f);
    EXPECT_EQ(shared::reflection_probe_share({3.1f, 0, 0}, low, high, 2.0f), 0.0f);
}

}  // namespace
}  // namespace petrichor::scene
