// Animations of glTF: nodes, skins, morph targets, lights and cameras, by closed forms; and what is
// refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "base/error.h"
#include "scene/animation/deform.h"
#include "scene/animation/rig.h"
#include "scene/animation/settle.h"
#include "scene/gltf/gltf.h"
#include "scene/patches/triangles.h"
#include "tests/scene/gltf_helpers.h"
#include "tests/support/gltf_builder.h"

namespace petrichor::scene {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing_gltf::GltfBuilder;
using testing_gltf::json;

Scene loaded(const GltfBuilder& b)
{
    Scene scene = load_gltf(b.glb(), "moving.glb", nullptr);
    scene_files::expect_sound(scene);
    return scene;
}

Scene settled(const GltfBuilder& b, const Playing& playing = {})
{
    Scene scene = loaded(b);
    settle_animation(scene, playing);
    return scene;
}

void expect_near(const glm::vec3& a, const glm::vec3& b, float tolerance = 1e-5f)
{
    EXPECT_LT(glm::length(a - b), tolerance)
        << a.x << " " << a.y << " " << a.z << " against " << b.x << " " << b.y << " " << b.z;
}

glm::vec3 moved(const Scene& scene, double time_s, const glm::vec3& point)
{
    const Posture posture = posture_at(*scene.rig, time_s);
    return glm::vec3(place_of(scene.instances[0], posture) * glm::vec4(point, 1.0f));
}

Shape shape_at(const Scene& scene, double time_s)
{
    const Posture posture = posture_at(*scene.rig, time_s);
    const Instance& instance = scene.instances[0];
    return deformed(scene.meshes[instance.mesh].primitives[0],
                    posture.weights[static_cast<std::size_t>(instance.node)],
                    joints_of(*scene.rig, instance, posture));
}

TEST(KeyTrack, BlendsAsTheSpecificationSays)
{
    KeyTrack track{.width = 1, .times_s = {1, 3}, .values = {10, 20}};
    EXPECT_THAT(value_at(track, 0.0), ElementsAre(10.0));
    EXPECT_THAT(value_at(track, 1.5), ElementsAre(12.5));
    EXPECT_THAT(value_at(track, 9.0), ElementsAre(20.0));
    track.blend = KeyBlend::Step;
    EXPECT_THAT(value_at(track, 2.999), ElementsAre(10.0));
    EXPECT_THAT(value_at(track, 3.0), ElementsAre(20.0));
    // Hermite, tangents times the length of the step: at the middle (a + b) / 2 + step (out - in) / 8.
    track.blend = KeyBlend::Cubic;
    track.values = {0, 10, 4, -2, 20, 0};
    EXPECT_THAT(value_at(track, 2.0), ElementsAre(15.0 + 2.0 * (4.0 + 2.0) / 8.0));
    EXPECT_THAT(value_at(track, 1.0), ElementsAre(10.0));
    EXPECT_THAT(value_at(track, 3.0), ElementsAre(20.0));
}

TEST(KeyTrack, TurnsTheShortWayAtASteadySpeed)
{
    const float s = std::sqrt(0.5f);
    for (const float sign : {1.0f, -1.0f}) {
        const KeyTrack track{.path = AnimatedPath::Rotation,
                             .width = 4,
                             .times_s = {0, 1},
                             .values = {0, 0, 0, 1, 0, sign * s, 0, sign * s}};
        for (const double t : {0.25, 0.5, 0.9}) {
            const auto q = value_at(track, t);
            EXPECT_NEAR(q[1], std::sin(t * std::atan(1.0)), 1e-7);
            EXPECT_NEAR(q[3], std::cos(t * std::atan(1.0)), 1e-7);
        }
    }
}

TEST(Animation, ANodeTurnsAndComesAround)
{
    const Scene scene = settled(testing_gltf::turning_quad());
    ASSERT_TRUE(scene.instances[0].moves);
    expect_near(moved(scene, 0.0, {1, 0, 0}), {3, 0, 0});
    expect_near(moved(scene, 0.5, {1, 0, 0}), {2 + std::sqrt(0.5f), 0, -std::sqrt(0.5f)});
    expect_near(moved(scene, 7.5, {1, 0, 0}), moved(scene, 0.5, {1, 0, 0}), 1e-6f);
    expect_near(moved(scene, -0.5, {1, 0, 0}), moved(scene, 0.5, {1, 0, 0}), 1e-6f);
    const Scene once =
        settled(testing_gltf::turning_quad(), {.animation = "turn", .loop = false});
    expect_near(moved(once, 5.0, {1, 0, 0}), {2, 0, -1});
}

TEST(Animation, BoundsHoldAllThatItPassesThrough)
{
    const Scene scene = settled(testing_gltf::turning_quad());
    const Bounds bounds = scene_bounds(scene);
    EXPECT_LE(bounds.low.z, -0.5f);
    EXPECT_GE(bounds.high.z, 0.5f);
    EXPECT_LE(bounds.low.x, 1.5f);
    EXPECT_LT(bounds.high.x, 2.6f);
    EXPECT_EQ(Triangles(scene, {}).size(), 0u) << "what moves is no patch";
}

TEST(Animation, ASkinBendsAsItsJointsDo)
{
    const Scene scene = settled(testing_gltf::bending_bar());
    const Shape rest = shape_at(scene, 0.0);
    expect_near(rest.positions[9], {0.1f, 2, 0});
    const Shape bent = shape_at(scene, 0.999999);
    // The upper half turns about (0, 1): up becomes -x.
    expect_near(bent.positions[9], {-1, 1.1f, 0}, 1e-4f);
    expect_near(bent.positions[8], {-1, 0.9f, 0}, 1e-4f);
    expect_near(bent.positions[1], {0.1f, 0, 0}, 1e-4f);
    // Half of either joint: the mean of both places.
    expect_near(bent.positions[5], 0.5f * (glm::vec3(0.1f, 1, 0) + glm::vec3(0, 1.1f, 0)), 1e-4f);
    for (const glm::vec3& normal : bent.normals) expect_near(normal, {0, 0, 1});
}

TEST(Animation, AStillSkinIsBakedAndSceneLikeAnyOther)
{
    const Scene scene = loaded(testing_gltf::bending_bar(false));
    EXPECT_EQ(scene.rig, nullptr);
    ASSERT_EQ(scene.instances.size(), 1u);
    EXPECT_FALSE(scene.instances[0].moves);
    const Primitive& primitive = scene.meshes[scene.instances[0].mesh].primitives[0];
    EXPECT_FALSE(primitive.deforms());
    expect_near(primitive.positions[9], {-1, 1.1f, 0}, 1e-4f);
    // The node of a skinned mesh does not count.
    EXPECT_LT(scene_bounds(scene).high.x, 1.0f);
    EXPECT_GT(Triangles(scene, {}).size(), 0u);
    EXPECT_EQ(settled(testing_gltf::bending_bar(), {.animation = "none"}).rig, nullptr);
}

TEST(Animation, MorphTargetsAddUpByTheirWeights)
{
    const Scene scene = settled(testing_gltf::morphing_quad());
    for (const double t : {0.0, 0.25, 0.5}) {
        const auto wide = static_cast<float>(3.0 * t * t - 2.0 * t * t * t);
        const Shape shape = shape_at(scene, t);
        expect_near(shape.positions[1], {0.5f + wide, -0.5f, 0.25f});
        expect_near(shape.positions[0], {-0.5f, -0.5f, 0});
    }
}

TEST(Animation, NormalsOfFlatMeshesFollowTheirTriangles)
{
    GltfBuilder b = testing_gltf::morphing_quad();
    b.document["meshes"][0]["primitives"][0]["attributes"].erase("NORMAL");
    b.document["meshes"][0]["weights"] = {0.0f, 1.0f};
    b.document.erase("animations");
    const Scene scene = loaded(b);
    for (const glm::vec3& normal : scene.meshes[0].primitives[0].normals)
        expect_near(normal, glm::normalize(glm::vec3(-1, 0, 1)));
}

TEST(Animation, CarriesCamerasAndLights)
{
    GltfBuilder b = testing_gltf::turning_quad();
    b.document["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}}};
    b.document["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "spot"}}};
    b.node({{"camera", 0}, {"translation", {0, 0, 3}},
            {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}}, false);
    b.document["nodes"][0]["children"] = {1};
    const Scene scene = settled(b);
    const Posture posture = posture_at(*scene.rig, 0.9999999);
    const Camera camera = carried(scene.cameras[0], posture);
    expect_near(glm::vec3(camera.to_world[3]), {5, 0, 0}, 1e-4f);
    expect_near(-glm::vec3(camera.to_world[2]), {-1, 0, 0}, 1e-4f);
    const Light light = carried(scene.lights[0], posture);
    expect_near(light.position_m, {5, 0, 0}, 1e-4f);
    expect_near(light.direction, {-1, 0, 0}, 1e-4f);
    // A lamp with a face turns it along.
    Light panel = scene.lights[0];
    panel.kind = LightKind::Rectangle;
    panel.shaped = true;
    panel.half_u_m = {0.5f, 0, 0};
    panel.half_v_m = {0, -0.25f, 0};
    panel = carried(panel, posture);
    expect_near(panel.half_u_m, {0, 0, -0.5f}, 1e-4f);
    expect_near(panel.half_v_m, {0, -0.25f, 0}, 1e-4f);
}

TEST(Animation, NodesCanBeHiddenByPointer)
{
    GltfBuilder b = testing_gltf::turning_quad();
    const int shown = b.floats("SCALAR", {1, 0, 0});
    const int times = b.floats("SCALAR", {0, 0.5f, 1});
    b.document["animations"].push_back(
        {{"samplers", {{{"input", times}, {"output", shown}, {"interpolation", "STEP"}}}},
         {"channels",
          {{{"sampler", 0},
            {"target",
             {{"path", "pointer"},
              {"extensions",
               {{"KHR_animation_pointer",
                 {{"pointer", "/nodes/0/extensions/KHR_node_visibility/visible"}}}}}}}}}}});
    const Scene scene = settled(b);
    EXPECT_TRUE(posture_at(*scene.rig, 0.4).visible[0]);
    EXPECT_FALSE(posture_at(*scene.rig, 0.6).visible[0]);
    b.document["animations"][1]["channels"][0]["target"]["extensions"]["KHR_animation_pointer"]
              ["pointer"] = "/materials/0/emissiveFactor";
    EXPECT_THAT(loaded(b).warnings, ElementsAre(HasSubstr("/materials/0/emissiveFactor")));
}

TEST(Animation, SaysWhatPlaysAndWhatDoesNot)
{
    GltfBuilder b = testing_gltf::turning_quad();
    b.animate("turn back", 0, "rotation", {0, 2}, "VEC4", {0, 0, 0, 1, 0, -1, 0, 0});
    b.animate("rise", 0, "translation", {0, 1}, "VEC3", {0, 0, 0, 0, 4, 0});
    Scene scene = loaded(b);
    EXPECT_THAT(settle_animation(scene, {}),
                ElementsAre(testing::AllOf(HasSubstr("\"turn\" (1 s)"), HasSubstr("\"rise\"")),
                            HasSubstr("\"turn back\"")));
    EXPECT_EQ(scene.rig->clips.size(), 2u);
    scene = loaded(b);
    EXPECT_THAT(settle_animation(scene, {.animation = "turn back"}).back(), HasSubstr("\"rise\""));
    expect_near(moved(scene, 1.0, {1, 0, 0}), {2, 0, 1});
    scene = loaded(b);
    try {
        settle_animation(scene, {.animation = "trun"});
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("Did you mean \"turn\"?"));
        EXPECT_THAT(error.fix(), HasSubstr("turn back"));
    }
    Scene still = load_gltf(
        [] {
            GltfBuilder none;
            const int mesh = none.mesh(testing_gltf::quad_of(none));
            none.node({{"mesh", mesh}});
            return none.glb();
        }(),
        "still.glb", nullptr);
    EXPECT_THAT(settle_animation(still, {}), IsEmpty());
    EXPECT_THROW(settle_animation(still, {.animation = "walk"}), Error);
}

TEST(Animation, AMillionKeysPlay)
{
    GltfBuilder b = testing_gltf::turning_quad();
    std::vector<float> times, values;
    for (int i = 0; i < 1000000; ++i) {
        times.push_back(static_cast<float>(i) * 0.25f);
        values.insert(values.end(), {static_cast<float>(i % 1000), 0, 0});
    }
    b.document.erase("animations");
    b.animate("long", 0, "translation", times, "VEC3", values);
    const Scene scene = settled(b);
    expect_near(moved(scene, 123.0 * 0.25 + 0.125, {0, 0, 0}), {123.5f, 0, 0});
}

struct BadCase {
    const char* name;
    std::function<void(GltfBuilder&)> damage;
    const char* says;
};
void PrintTo(const BadCase& c, std::ostream* out)
{
    *out << c.name;
}

class BadAnimation : public testing::TestWithParam<BadCase> {};

TEST_P(BadAnimation, IsRefusedByName)
{
    GltfBuilder b = testing_gltf::bending_bar();
    GetParam().damage(b);
    try {
        load_gltf(b.glb(), "bad.glb", nullptr);
        FAIL() << "loaded";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr(GetParam().says));
        EXPECT_FALSE(error.fix().empty());
    }
}

json& sampler(GltfBuilder& b)
{
    return b.document["animations"][0]["samplers"][0];
}

INSTANTIATE_TEST_SUITE_P(
    Table, BadAnimation,
    testing::Values(
        BadCase{"FallingTimes", [](GltfBuilder& b) { sampler(b)["input"] = b.floats("SCALAR", {1, 0}); },
                "samplers[0].input: key 1 is at 0 s, after one at 1 s"},
        BadCase{"NanTime",
                [](GltfBuilder& b) {
                    sampler(b)["input"] =
                        b.floats("SCALAR", {0, std::numeric_limits<float>::quiet_NaN()});
                },
                "element 1 is not a finite number"},
        BadCase{"NegativeTime",
                [](GltfBuilder& b) { sampler(b)["input"] = b.floats("SCALAR", {-1, 0}); },
                "key 0 is at -1 s"},
        BadCase{"InfiniteValue",
                [](GltfBuilder& b) {
                    sampler(b)["output"] = b.floats(
                        "VEC4", {0, 0, 0, 1, std::numeric_limits<float>::infinity(), 0, 0, 1});
                },
                "samplers[0].output: element 1"},
        BadCase{"TooFewValues",
                [](GltfBuilder& b) { sampler(b)["output"] = b.floats("VEC4", {0, 0, 0, 1}); },
                "has 4 numbers; the keys ask for 8"},
        BadCase{"UnknownBlend", [](GltfBuilder& b) { sampler(b)["interpolation"] = "WOBBLY"; },
                "must be LINEAR, STEP or CUBICSPLINE, got \"WOBBLY\""},
        BadCase{"NoSuchNode",
                [](GltfBuilder& b) {
                    b.document["animations"][0]["channels"][0]["target"]["node"] = 17;
                },
                "node 17 does not exist"},
        BadCase{"NoSuchSampler",
                [](GltfBuilder& b) { b.document["animations"][0]["channels"][0]["sampler"] = 3; },
                "sampler 3 does not exist"},
        BadCase{"JointOutOfRange",
                [](GltfBuilder& b) { b.document["skins"][0]["joints"] = {1}; },
                "has 1 joints, and mesh 0 asks for joint 1"},
        BadCase{"NoSuchJoint",
                [](GltfBuilder& b) { b.document["skins"][0]["joints"] = {1, 9}; },
                "skins[0].joints[1]"},
        BadCase{"NoJoints",
                [](GltfBuilder& b) { b.document["skins"][0]["joints"] = json::array(); },
                "must name at least one node"},
        BadCase{"CycleOfJoints", [](GltfBuilder& b) { b.document["nodes"][2]["children"] = {1}; },
                "part of a cycle"},
        BadCase{"FewMatrices",
                [](GltfBuilder& b) {
                    b.document["skins"][0]["inverseBindMatrices"] =
                        b.floats("MAT4", std::vector<float>(16, 0.0f));
                },
                "a matrix for each of the 2 joints"},
        BadCase{"JointsWithoutWeights",
                [](GltfBuilder& b) {
                    b.document["meshes"][0]["primitives"][0]["attributes"].erase("WEIGHTS_0");
                },
                "WEIGHTS_0: is missing"},
        BadCase{"ShortTarget",
                [](GltfBuilder& b) {
                    b.document["meshes"][0]["primitives"][0]["targets"] = {
                        {{"POSITION", b.floats("VEC3", {0, 0, 0})}}};
                },
                "targets[0].POSITION"}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(Animation, WithoutChannelsItIsNamedAndTheSceneStands)
{
    GltfBuilder b = testing_gltf::turning_quad();
    b.document["animations"][0]["channels"] = json::array();
    const Scene scene = loaded(b);
    EXPECT_THAT(scene.warnings, ElementsAre(HasSubstr("without channels")));
    EXPECT_EQ(scene.rig, nullptr);
}

}  // namespace
}  // namespace petrichor::scene
