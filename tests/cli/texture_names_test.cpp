// What the names of maps say.
#include <gtest/gtest.h>

#include <string>

#include "texproc/material/material_names.h"

namespace petrichor::cli {
namespace {

struct NameCase {
    const char* stem;
    const char* material;
    const char* roles;  // "role=channels "
    texproc::Green green = texproc::Green::Auto;
};
void PrintTo(const NameCase& c, std::ostream* out)
{
    *out << c.stem;
}

class MapNames : public testing::TestWithParam<NameCase> {};
TEST_P(MapNames, SayWhatTheyAre)
{
    const texproc::NamedMaps named = texproc::maps_named(GetParam().stem);
    EXPECT_EQ(named.short_name, GetParam().material);
    std::string roles;
    for (const auto& [role, channels] : named.roles) roles += role + "=" + channels + " ";
    EXPECT_EQ(roles, GetParam().roles);
    EXPECT_EQ(named.green, GetParam().green);
}
INSTANTIATE_TEST_SUITE_P(
    Table, MapNames,
    testing::Values(NameCase{"Bricks102_1K-JPG_NormalDX", "Bricks102",
                             "normal= ", texproc::Green::Down},
                    NameCase{"Bricks102_1K-JPG_AmbientOcclusion", "Bricks102", "occlusion= "},
                    NameCase{"cobblestone_pavement_nor_gl_2k", "cobblestone_pavement",
                             "normal= ", texproc::Green::Up},
                    NameCase{"cobblestone_pavement_arm_2k", "cobblestone_pavement",
                             "metallic=b occlusion=r roughness=g "},
                    NameCase{"Old_Wall_LuxSPEC", "Old_Wall", "smoothness=a specular=rgb "},
                    NameCase{"Old_Wall_LuxNRM", "Old_Wall", "normal= "},
                    NameCase{"metal_plate_02_rough_4k", "metal_plate_02", "roughness= "},
                    NameCase{"ground037_nrm_rgh", "ground037", "normal=rgb roughness=a "},
                    NameCase{"WallBaseColor", "Wall", "albedo= "},
                    NameCase{"albedo", "", "albedo= "}, NameCase{"preview", "", ""},
                    NameCase{"T_Old_Wall_BC", "Old_Wall", "albedo= "},
                    NameCase{"T_Wall_N", "Wall", "normal= "}, NameCase{"Plan_N", "", ""},
                    NameCase{"Mauer_grün_normal", "Mauer_grün", "normal= "},
                    NameCase{"snow_water_Color", "snow_water", "albedo= "}));

}  // namespace
}  // namespace petrichor::cli
