#include "scene/patches/tracer.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "scene/patches/detail/sampling.h"
#include "tests/scene/patch_scenes.h"

namespace petrichor::scene {
namespace {

using namespace patch_scenes;

// Every triangle, one after the other, by the same arithmetic told in doubles.
RayHit by_hand(const Triangles& triangles, const Ray& ray)
{
    RayHit best;
    double least = static_cast<double>(ray.longest_m);
    const glm::dvec3 o(ray.origin), d(ray.direction);
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        const glm::dvec3 a(triangles.corner(t)), e1(triangles.edge1(t)), e2(triangles.edge2(t));
        const glm::dvec3 p = glm::cross(d, e2);
        const double det = glm::dot(e1, p);
        if (det == 0.0) continue;
        const glm::dvec3 s = o - a;
        const double u = glm::dot(s, p) / det;
        const glm::dvec3 q = glm::cross(s, e1);
        const double v = glm::dot(d, q) / det, distance = glm::dot(e2, q) / det;
        if (u < 0 || v < 0 || u + v > 1 || !(distance > 0) || distance >= least) continue;
        least = distance;
        best.triangle = t;
        best.distance_m = static_cast<float>(distance);
        best.back = det < 0;
    }
    return best;
}

Scene heap(int count)
{
    Scene scene = empty_scene();
    for (int i = 0; i < count; ++i) {
        const auto hash = [&](int k) {
            return 2.0f * unit_float(mixed(static_cast<std::uint64_t>(i), static_cast<std::uint64_t>(k))) - 1.0f;
        };
        add_face(scene, {8 * hash(0), 8 * hash(1), 8 * hash(2)}, {hash(3), hash(4), hash(5)},
                 {hash(6), hash(7), hash(8)});
    }
    return scene;
}

TEST(Tracer, FindsWhatTryingAllTrianglesFinds)
{
    const Scene scene = heap(600);
    const Triangles triangles(scene, {});
    const Tracer tracer(triangles);
    int hits = 0, different = 0;
    Tracer::Blocker last;
    for (std::uint64_t i = 0; i < 4000; ++i) {
        const auto u = [&](std::uint64_t k) { return unit_float(mixed(i, 100 + k)); };
        const Ray ray{glm::vec3(12 * u(0) - 6, 12 * u(1) - 6, 12 * u(2) - 6),
                      cosine_direction(glm::normalize(glm::vec3(u(3) - 0.5f, u(4) - 0.5f, u(5) - 0.4f)),
                                       u(6), u(7)),
                      i % 3 == 0 ? 4.0f : std::numeric_limits<float>::max()};
        const RayHit found = tracer.nearest(ray), known = by_hand(triangles, ray);
        hits += known.hit() ? 1 : 0;
        ASSERT_EQ(tracer.blocked(ray, &last), found.hit()) << "whatever the ray before met";
        // An edge that rounding decides.
        if (found.triangle != known.triangle) {
            ++different;
            continue;
        }
        if (!known.hit()) continue;
        EXPECT_NEAR(found.distance_m, known.distance_m, 1e-4f * (1.0f + known.distance_m));
        EXPECT_EQ(found.back, known.back);
        EXPECT_EQ(tracer.blocked(ray), true);
    }
    EXPECT_GT(hits, 1000);
    EXPECT_LE(different, 2);
}

// As a patch asks: from a small place, towards everywhere, some of them short; more than go down together at once, and few.
TEST(Tracer, ManyRaysMeetWhatEachMeetsAlone)
{
    const Scene scene = heap(3000);
    const Triangles triangles(scene, {});
    const Tracer tracer(triangles);
    int hits = 0, free = 0;
    for (std::uint64_t place = 0; place < 40; ++place) {
        const auto v = [&](std::uint64_t k) { return unit_float(mixed(place, 900 + k)); };
        const glm::vec3 middle(12 * v(0) - 6, 12 * v(1) - 6, 12 * v(2) - 6);
        const std::size_t many = std::array<std::size_t, 5>{1, 2, 7, 128, 300}[place % 5];
        std::vector<Ray> rays;
        for (std::uint64_t i = 0; i < many; ++i) {
            const auto u = [&](std::uint64_t k) { return unit_float(mixed(place * 1000 + i, k)); };
            glm::vec3 d = cosine_direction(glm::normalize(glm::vec3(u(3) - 0.5f, u(4) - 0.5f, u(5) - 0.4f)), u(6), u(7));
            if (i % 17 == 0) d = glm::vec3(i % 2 == 0 ? 1.0f : 0.0f, i % 2 == 0 ? 0.0f : -1.0f, 0.0f);
            rays.push_back({middle + 0.3f * glm::vec3(u(0), u(1), u(2)), d,
                            i % 3 == 0 ? 3.0f : std::numeric_limits<float>::max()});
        }
        std::vector<RayHit> found(many);
        std::array<bool, 300> blocked;
        tracer.nearest(rays, found);
        tracer.blocked(rays, blocked);
        for (std::size_t i = 0; i < many; ++i) {
            const RayHit alone = tracer.nearest(rays[i]);
            ASSERT_EQ(found[i].triangle, alone.triangle) << place << " " << i;
            ASSERT_EQ(found[i].distance_m, alone.distance_m) << "to the bit";
            ASSERT_EQ(found[i].at.b1, alone.at.b1);
            ASSERT_EQ(found[i].at.b2, alone.at.b2);
            ASSERT_EQ(found[i].back, alone.back);
            ASSERT_EQ(blocked[i], alone.hit());
            (alone.hit() ? hits : free) += 1;
        }
    }
    EXPECT_GT(hits, 1000);
    EXPECT_GT(free, 300);
    const Scene nothing = empty_scene();
    const Triangles none(nothing, {});
    std::array<RayHit, 2> met;
    Tracer(none).nearest(std::array<Ray, 2>{}, met);
    EXPECT_FALSE(met[0].hit() || met[1].hit());
}

// Rays along an axis through a face that lies in its box's side.
TEST(Tracer, RaysAlongAnAxisHitFlatFaces)
{
    const Scene scene = room();
    const Triangles triangles(scene, {});
    const Tracer tracer(triangles);
    for (int axis = 0; axis < 3; ++axis) {
        for (const float sign : {-1.0f, 1.0f}) {
            glm::vec3 d(0.0f);
            d[axis] = sign;
            const RayHit hit = tracer.nearest({glm::vec3(1.7f), d});
            ASSERT_TRUE(hit.hit());
            EXPECT_FLOAT_EQ(hit.distance_m, sign > 0 ? 2.3f : 1.7f);
            EXPECT_FALSE(hit.back) << "the room is seen from within";
        }
    }
    EXPECT_FALSE(tracer.blocked({glm::vec3(9.0f), {0, 1, 0}}));
    EXPECT_TRUE(tracer.blocked_between(glm::vec3(1.0f), glm::vec3(1.0f, 9.0f, 1.0f)));
    EXPECT_FALSE(tracer.blocked_between(glm::vec3(1.0f), glm::vec3(3.0f)));
}

TEST(Tracer, OfTwoFacesInOnePlaneTheFirstCounts)
{
    Scene scene = empty_scene();
    for (int i = 0; i < 40; ++i) add_face(scene, {0, 0, 0}, {0, 0, 1}, {1, 0, 0});
    const Triangles triangles(scene, {});
    const Tracer tracer(triangles);
    const RayHit hit = tracer.nearest({{0.25f, 2.0f, 0.75f}, {0, -1, 0}});
    ASSERT_TRUE(hit.hit());
    EXPECT_LT(hit.triangle, 2u);
}

TEST(Tracer, NothingIsHitInAnEmptyScene)
{
    const Scene scene = empty_scene();
    const Triangles triangles(scene, {});
    const Tracer tracer(triangles);
    EXPECT_FALSE(tracer.nearest({{0, 0, 0}, {0, 1, 0}}).hit());
}

TEST(Triangles, SidesFollowMirroringAndCulling)
{
    Scene scene = empty_scene();
    add_face(scene, {0, 0, 0}, {0, 0, 1}, {1, 0, 0});  // normal up
    const auto normal = [&] { return Triangles(scene, {}).normal(0); };
    EXPECT_GT(normal().y, 0.99f);
    scene.instances[0].to_world[0][0] = -1.0f;  // mirrored: still seen from above
    EXPECT_GT(normal().y, 0.99f);
    EXPECT_GT(Triangles(scene, {}).shading_normal(0, {0.2f, 0.2f}).y, 0.99f);
    scene.materials[0].cull_front = true;
    EXPECT_LT(normal().y, -0.99f);
    EXPECT_LT(Triangles(scene, {}).shading_normal(0, {0.2f, 0.2f}).y, -0.99f);
}

TEST(Triangles, BlendedAndTransmissiveOnesAreLeftOut)
{
    Scene scene = room();
    Material glass;
    glass.alpha_mode = AlphaMode::Blend;
    add_face(scene, {1, 1, 1}, {0, 0, 1}, {1, 0, 0}, add_material(scene, glass));
    Material pane;
    pane.transmission = 1.0f;
    add_face(scene, {1, 1, 1}, {0, 0, 1}, {1, 0, 0}, add_material(scene, pane));
    const Triangles triangles(scene, {});
    EXPECT_EQ(triangles.size(), 12u);
    EXPECT_EQ(triangles.left_out_blended(), 4u);
}

TEST(Triangles, TheFingerprintIsOfWhatRaysSee)
{
    Scene scene = room();
    const std::string first = Triangles(scene, {}).fingerprint();
    scene.materials[0].base_color = {0.2f, 0.3f, 0.4f, 1.0f};
    scene.materials[0].emissive = glm::vec3(1.0f);
    EXPECT_EQ(Triangles(scene, {}).fingerprint(), first) << "albedo and light are no geometry";
    scene.materials[0].double_sided = true;
    EXPECT_NE(Triangles(scene, {}).fingerprint(), first);
    scene.materials[0].double_sided = false;
    scene.meshes[0].primitives[0].positions[3].y += 1e-3f;
    EXPECT_NE(Triangles(scene, {}).fingerprint(), first);
}

}  // namespace
}  // namespace petrichor::scene
