#include "film/scenario/lamp_keys.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "base/error.h"
#include "film/scenes/lamps.h"
#include "scene/gltf/glb_writer.h"
#include "scene/gltf/gltf.h"
#include "scene/light_shape.h"
#include "tests/support/program.h"

namespace petrichor::film {
namespace {

using testing::HasSubstr;
using testing_program::Workplace;

scene::Scene three_lamps()
{
    scene::Scene scene;
    scene.lights.resize(3);
    scene.lights[0].name = "lantern a";
    scene.lights[1].name = "lantern b";
    scene.lights[2].name = "spot";
    scene.lights[2].kind = scene::LightKind::Spot;
    return scene;
}

std::string said(const std::string& toml, const std::filesystem::path& folder = {})
{
    try {
        scene::Scene scene = three_lamps();
        const Scenario scenario = parse_scenario(toml, "s.toml");
        apply_lamp_overrides(scenario.lamps, folder, scene);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(LampOverrides, GiveLampsSizeColourAndIntensityByName)
{
    const Scenario scenario = parse_scenario(
        "[lamps.\"lantern*\"]\nradius_m = 0.2\nlength_m = 1\nintensity = 40\ncolor = [1, 0.5, 0]\n"
        "[lamps.\"*b\"]\nspecular = 0\nrange_m = 3\n"
        "[lamps.\"spot\"]\nwidth_m = 2\nheight_m = 0.5\nboth_sides = true\nintensity = 10\n"
        "[lamps.\"none\"]\nradius_m = 1\n",
        "s.toml");
    scene::Scene scene = three_lamps();
    const AppliedLamps applied = apply_lamp_overrides(scenario.lamps, {}, scene);
    EXPECT_FLOAT_EQ(scene.lights[0].radius_m, 0.2f);
    EXPECT_FLOAT_EQ(scene.lights[1].length_m, 1.0f);
    EXPECT_FLOAT_EQ(scene.lights[0].intensity, 40.0f);
    EXPECT_EQ(scene.lights[0].color, glm::vec3(1, 0.5f, 0));
    EXPECT_EQ(scene.lights[0].specular, 1.0f);
    EXPECT_EQ(scene.lights[1].specular, 0.0f);
    EXPECT_EQ(scene.lights[1].range_m, 3.0f);
    EXPECT_EQ(scene.lights[2].kind, scene::LightKind::Rectangle);
    EXPECT_FLOAT_EQ(scene::light_candela(scene.lights[2]), 10.0f);
    EXPECT_TRUE(scene.lights[2].both_sides);
    ASSERT_EQ(applied.unmatched.size(), 1u);
    EXPECT_THAT(applied.unmatched[0], HasSubstr("lantern a, lantern b, spot"));
    EXPECT_EQ(applied.content, "");
}

TEST(LampOverrides, RefuseShapesThatCannotBe)
{
    EXPECT_THAT(said("[lamps.\"spot\"]\nradius_m = 1\nlength_m = 2\n"), HasSubstr("no length"));
    EXPECT_THAT(said("[lamps.\"spot\"]\nradius_m = 1\nwidth_m = 2\nheight_m = 1\n"), HasSubstr("either round"));
    EXPECT_THAT(said("[lamps.\"spot\"]\nwidth_m = 2\n"), HasSubstr("go together"));
    EXPECT_THAT(said("[lamps.\"lantern a\"]\nlength_m = 2\n"), HasSubstr("needs a radius"));
    EXPECT_THAT(said("[lamps.\"spot\"]\nradius_m = -1\n"), HasSubstr("0 to 40"));
    EXPECT_THAT(said("[lamps.\"spot\"]\nradius = 1\n"), HasSubstr("radius_m"));
    for (const std::string wrong : {"1.5", "-0.1", "nan"}) {
        EXPECT_THAT(said("[lamps.\"spot\"]\nshadow_strength = " + wrong + "\n"), HasSubstr("0 to 1")) << wrong;
        EXPECT_THAT(said("[sun]\nshadow_strength = " + wrong + "\n"), HasSubstr("0 to 1")) << wrong;
    }
}

// Later tables win, a size and the share of highlights do not bring a lamp back to pixels.
TEST(LampOverrides, SayWhichLampsLightByVertex)
{
    const Scenario scenario = parse_scenario(
        "[lamps.\"*\"]\nper_vertex = true\n[lamps.\"lantern b\"]\nper_vertex = false\n"
        "[lamps.\"lantern a\"]\nradius_m = 0.1\nspecular = 0.5\n",
        "s.toml");
    scene::Scene scene = three_lamps();
    apply_lamp_overrides(scenario.lamps, {}, scene);
    EXPECT_TRUE(scene::lit_by_vertex(scene.lights[0]));
    EXPECT_FALSE(scene::lit_by_vertex(scene.lights[1]));
    EXPECT_EQ(scene.lights[1].specular, 1.0f);
    EXPECT_TRUE(scene::lit_by_vertex(scene.lights[2]));
    const scene::Scene again = scene::load_gltf(scene::write_glb(scene), "lamps.glb", {});
    ASSERT_EQ(again.lights.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(scene::lit_by_vertex(again.lights[i]), i != 1) << i;

    EXPECT_THAT(said("[lamps.\"spot\"]\nper_vertex = true\nwidth_m = 2\nheight_m = 1\n"), HasSubstr("rectangle does not light by vertex"));
    EXPECT_THAT(said("[lamps.\"spot\"]\nper_vertex = 1\n"), HasSubstr("per_vertex"));
    scene.lights[0].kind = scene::LightKind::Directional;
    scene::LightShape shape;
    shape.per_vertex = 1.0f;
    EXPECT_THAT(scene::shape_light(scene.lights[0], shape), HasSubstr("directional"));
}

TEST(LampOverrides, TakePhotometryAndPictures)
{
    const Workplace place("lamps");
    std::ofstream(place / "cone.ies") << "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 2 1 1 2 0 0 0\n1 1 60\n"
                                         "0 90\n0\n120 60\n";
    std::ofstream(place / "bad.ies") << "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 2\n";
    const auto text = [](const std::string& lamp, const std::string& file, const std::string& more = "") {
        return "[lamps.\"" + lamp + "\"]\nprofile = \"" + file + "\"\n" + more;
    };
    scene::Scene scene = three_lamps();
    const AppliedLamps applied = apply_lamp_overrides(
        parse_scenario(text("*", "cone.ies") + text("spot*", "cone.ies", "intensity = 7\n"), "s").lamps,
        place.path(), scene);
    ASSERT_EQ(scene.light_profiles.size(), 1u) << "read once";
    EXPECT_EQ(scene.lights[0].profile, 0);
    EXPECT_FLOAT_EQ(scene.lights[0].intensity, 120.0f);
    EXPECT_FLOAT_EQ(scene.lights[2].intensity, 7.0f);
    EXPECT_NE(applied.content, "");
    EXPECT_THAT(said(text("spot", "bad.ies"), place.path()), HasSubstr("bad.ies"));
    EXPECT_THAT(said(text("spot", "none.ies"), place.path()), HasSubstr("none.ies"));
    EXPECT_THAT(said(text("spot", "none.png"), place.path()), HasSubstr("none.png"));
    EXPECT_THAT(said(text("lantern a", "cone.ies", "radius_m = 0.1\nlength_m = 1\n"), place.path()),
                HasSubstr("cannot stand"));
}

// glTF keeps what the keys give.
TEST(LampShapes, GoThroughGltf)
{
    scene::Scene scene = three_lamps();
    scene.materials.resize(1);
    const Scenario scenario = parse_scenario(
        "[lamps.\"lantern a\"]\nradius_m = 0.2\nlength_m = 1\nspecular = 0.5\n"
        "[lamps.\"lantern b\"]\nwidth_m = 2\nheight_m = 0.5\nboth_sides = true\n"
        "[lamps.\"spot\"]\nradius_m = 0.3\nshadow_strength = 0.25\n",
        "s.toml");
    scene.lights[1].direction = {1, 0, 0};
    scene.lights[1].up = {0, 0, 1};
    apply_lamp_overrides(scenario.lamps, {}, scene);
    const auto bytes = scene::write_glb(scene);
    const scene::Scene read = scene::load_gltf(bytes, "lamps.glb", {});
    ASSERT_EQ(read.lights.size(), 3u);
    EXPECT_FLOAT_EQ(read.lights[0].radius_m, 0.2f);
    EXPECT_FLOAT_EQ(read.lights[0].length_m, 1.0f);
    EXPECT_FLOAT_EQ(read.lights[0].specular, 0.5f);
    EXPECT_EQ(read.lights[1].kind, scene::LightKind::Rectangle);
    EXPECT_TRUE(read.lights[1].both_sides);
    EXPECT_NEAR(glm::length(read.lights[1].half_u_m), 1.0f, 1e-5f);
    EXPECT_NEAR(scene::light_candela(read.lights[1]), 1.0f, 1e-5f);
    EXPECT_NEAR(glm::dot(glm::normalize(glm::cross(read.lights[1].half_u_m, read.lights[1].half_v_m)),
                         glm::vec3(1, 0, 0)),
                1.0f, 1e-5f);
    EXPECT_FLOAT_EQ(read.lights[2].radius_m, 0.3f);
    EXPECT_FLOAT_EQ(read.lights[2].shadow_strength, 0.25f);
    EXPECT_EQ(read.lights[0].shadow_strength, 1.0f);
    EXPECT_TRUE(read.warnings.empty());
}

}  // namespace
}  // namespace petrichor::film
