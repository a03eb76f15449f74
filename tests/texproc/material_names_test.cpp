#include "texproc/material/material_names.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>

#include "tests/texproc/textures.h"

namespace petrichor::texproc {
namespace {

struct RealName {
    const char* stem;
    const char* material;  // without marks of resolution and format
    const char* roles;     // "role=channels "
    Green green = Green::Auto;
};

// Names as the libraries and tools write them.
constexpr RealName kRealNames[] = {
    // ambientCG
    {"Metal032_4K-PNG_Color", "Metal032", "albedo= "},
    {"Metal032_4K-PNG_NormalGL", "Metal032", "normal= ", Green::Up},
    {"Metal032_4K-PNG_NormalDX", "Metal032", "normal= ", Green::Down},
    {"Metal032_4K-PNG_Roughness", "Metal032", "roughness= "},
    {"Metal032_4K-PNG_Displacement", "Metal032", "height= "},
    {"Metal032_4K-PNG_AmbientOcclusion", "Metal032", "occlusion= "},
    {"Metal032_4K-PNG_Metalness", "Metal032", "metallic= "},
    {"Metal032_4K-PNG_Opacity", "Metal032", "opacity= "},
    {"Metal032_4K-PNG_Emission", "Metal032", "emission= "},
    {"PavingStones070_1K_Color", "PavingStones070", "albedo= "},
    {"Bricks102", "", ""},
    {"Bricks102_PREVIEW", "", ""},
    // Poly Haven
    {"rusty_metal_02_diff_2k", "rusty_metal_02", "albedo= "},
    {"rusty_metal_02_nor_gl_2k", "rusty_metal_02", "normal= ", Green::Up},
    {"rusty_metal_02_nor_dx_2k", "rusty_metal_02", "normal= ", Green::Down},
    {"rusty_metal_02_rough_2k", "rusty_metal_02", "roughness= "},
    {"rusty_metal_02_disp_2k", "rusty_metal_02", "height= "},
    {"rusty_metal_02_ao_2k", "rusty_metal_02", "occlusion= "},
    {"rusty_metal_02_arm_2k", "rusty_metal_02", "metallic=b occlusion=r roughness=g "},
    {"rusty_metal_02_spec_2k", "rusty_metal_02", "specular= "},
    {"rusty_metal_02_metal_2k", "rusty_metal_02", "metallic= "},
    {"rusty_metal_02_bump_2k", "rusty_metal_02", "height= "},
    {"rusty_metal_02_opacity_2k", "rusty_metal_02", "opacity= "},
    {"forrest_ground_01_diff_4k", "forrest_ground_01", "albedo= "},
    {"dutch_ship_medium_hull_nor_gl_1k", "dutch_ship_medium_hull", "normal= ", Green::Up},
    // Poliigon
    {"BricksFlemishRed001_COL_2K_METALNESS", "BricksFlemishRed001", "albedo= "},
    {"BricksFlemishRed001_NRM_2K_METALNESS", "BricksFlemishRed001", "normal= "},
    {"BricksFlemishRed001_ROUGHNESS_2K_METALNESS", "BricksFlemishRed001", "roughness= "},
    {"BricksFlemishRed001_METALNESS_2K_METALNESS", "BricksFlemishRed001", "metallic= "},
    {"BricksFlemishRed001_AO_2K_METALNESS", "BricksFlemishRed001", "occlusion= "},
    {"BricksFlemishRed001_DISP_2K_METALNESS", "BricksFlemishRed001", "height= "},
    {"BricksFlemishRed001_DISP16_2K_METALNESS", "BricksFlemishRed001", "height= "},
    {"BricksFlemishRed001_NRM16_2K_METALNESS", "BricksFlemishRed001", "normal= "},
    {"PlasterPlain002_GLOSS_3K_SPECULAR", "PlasterPlain002", "smoothness= "},
    {"PlasterPlain002_REFL_3K_SPECULAR", "PlasterPlain002", "specular= "},
    {"PlasterPlain002_COL_3K_SPECULAR", "PlasterPlain002", "albedo= "},
    {"PlasterPlain002_NRM_3K_SPECULAR", "PlasterPlain002", "normal= "},
    {"Poliigon_BrickWallReclaimed_8320_BaseColor", "Poliigon_BrickWallReclaimed_8320", "albedo= "},
    {"Poliigon_BrickWallReclaimed_8320_Normal", "Poliigon_BrickWallReclaimed_8320", "normal= "},
    {"Poliigon_BrickWallReclaimed_8320_ORM", "Poliigon_BrickWallReclaimed_8320",
     "metallic=b occlusion=r roughness=g "},
    {"Poliigon_BrickWallReclaimed_8320_Roughness", "Poliigon_BrickWallReclaimed_8320",
     "roughness= "},
    {"Poliigon_BrickWallReclaimed_8320_Metallic", "Poliigon_BrickWallReclaimed_8320", "metallic= "},
    {"Poliigon_BrickWallReclaimed_8320_AmbientOcclusion", "Poliigon_BrickWallReclaimed_8320",
     "occlusion= "},
    {"Poliigon_BrickWallReclaimed_8320_Displacement", "Poliigon_BrickWallReclaimed_8320",
     "height= "},
    // Quixel
    {"vdbobcm_2K_Albedo", "vdbobcm", "albedo= "},
    {"vdbobcm_2K_Normal", "vdbobcm", "normal= "},
    {"vdbobcm_2K_Roughness", "vdbobcm", "roughness= "},
    {"vdbobcm_2K_Displacement", "vdbobcm", "height= "},
    {"vdbobcm_2K_AO", "vdbobcm", "occlusion= "},
    {"vdbobcm_2K_Cavity", "vdbobcm", "cavity= "},
    {"vdbobcm_2K_Gloss", "vdbobcm", "smoothness= "},
    {"vdbobcm_2K_Specular", "vdbobcm", "specular= "},
    {"vdbobcm_2K_Bump", "vdbobcm", "height= "},
    {"vdbobcm_2K_Opacity", "vdbobcm", "opacity= "},
    {"vdbobcm_2K_Metalness", "vdbobcm", "metallic= "},
    {"T_Rock_Cliff_vdbobcm_2K_D", "Rock_Cliff_vdbobcm", "albedo= "},
    {"T_Rock_Cliff_vdbobcm_2K_N", "Rock_Cliff_vdbobcm", "normal= "},
    {"T_Rock_Cliff_vdbobcm_2K_ORDp", "Rock_Cliff_vdbobcm", "height=b occlusion=r roughness=g "},
    // Substance
    {"crate_DefaultMaterial_BaseColor", "crate_DefaultMaterial", "albedo= "},
    {"crate_DefaultMaterial_Base_Color", "crate_DefaultMaterial", "albedo= "},
    {"crate_DefaultMaterial_Normal", "crate_DefaultMaterial", "normal= "},
    {"crate_DefaultMaterial_Normal_OpenGL", "crate_DefaultMaterial", "normal= ", Green::Up},
    {"crate_DefaultMaterial_Normal_DirectX", "crate_DefaultMaterial", "normal= ", Green::Down},
    {"crate_DefaultMaterial_OcclusionRoughnessMetallic", "crate_DefaultMaterial",
     "metallic=b occlusion=r roughness=g "},
    {"crate_DefaultMaterial_AlbedoTransparency", "crate_DefaultMaterial", "albedo=rgb opacity=a "},
    {"crate_DefaultMaterial_MetallicSmoothness", "crate_DefaultMaterial",
     "metallic=r smoothness=a "},
    {"crate_DefaultMaterial_SpecularSmoothness", "crate_DefaultMaterial",
     "smoothness=a specular=rgb "},
    {"crate_DefaultMaterial_SpecularGlossiness", "crate_DefaultMaterial",
     "smoothness=a specular=rgb "},
    {"crate_DefaultMaterial_Ambient_Occlusion", "crate_DefaultMaterial", "occlusion= "},
    {"crate_DefaultMaterial_Mixed_AO", "crate_DefaultMaterial", "occlusion= "},
    {"crate_DefaultMaterial_Height", "crate_DefaultMaterial", "height= "},
    {"crate_DefaultMaterial_Emissive", "crate_DefaultMaterial", "emission= "},
    {"crate_DefaultMaterial_Glossiness", "crate_DefaultMaterial", "smoothness= "},
    {"crate_DefaultMaterial_Diffuse", "crate_DefaultMaterial", "albedo= "},
    {"crate_DefaultMaterial_MaskMap", "crate_DefaultMaterial",
     "detail=b metallic=r occlusion=g smoothness=a "},
    {"crate_DefaultMaterial_BaseMap", "crate_DefaultMaterial", "albedo= "},
    // Unreal
    {"T_Metal_Wall_D", "Metal_Wall", "albedo= "},
    {"T_Metal_Wall_BC", "Metal_Wall", "albedo= "},
    {"T_Metal_Wall_N", "Metal_Wall", "normal= "},
    {"T_Metal_Wall_ORM", "Metal_Wall", "metallic=b occlusion=r roughness=g "},
    {"T_Metal_Wall_R", "Metal_Wall", "roughness= "},
    {"T_Metal_Wall_M", "Metal_Wall", "metallic= "},
    {"T_Metal_Wall_H", "Metal_Wall", "height= "},
    {"T_Metal_Wall_E", "Metal_Wall", "emission= "},
    // Lux
    {"Old Wall [Albedo] [Smoothness]", "Old Wall", "albedo=rgb smoothness=a "},
    {"Old Wall [Normal]", "Old Wall", "normal= "},
    {"Old Wall [Specular] [Smoothness]", "Old Wall", "smoothness=a specular=rgb "},
    {"Old_Wall_LuxSPEC", "Old_Wall", "smoothness=a specular=rgb "},
    // others
    {"Brick_wall_02_2K_Base_Color", "Brick_wall_02", "albedo= "},
    {"Brick_wall_02_2K_Roughness", "Brick_wall_02", "roughness= "},
    {"Stone_Wall_014_basecolor", "Stone_Wall_014", "albedo= "},
    {"Stone_Wall_014_ambientOcclusion", "Stone_Wall_014", "occlusion= "},
    {"Stone_Wall_014_height", "Stone_Wall_014", "height= "},
    {"TexturesCom_Brick_Rustic2_1K_albedo", "TexturesCom_Brick_Rustic2", "albedo= "},
    {"TexturesCom_Brick_Rustic2_1K_ao", "TexturesCom_Brick_Rustic2", "occlusion= "},
    {"rustediron2_metallic", "rustediron2", "metallic= "},
    {"rustediron2_basecolor", "rustediron2", "albedo= "},
    {"worn-planks_roughness", "worn-planks", "roughness= "},
    {"worn-planks_Normal-ogl", "worn-planks", "normal= ", Green::Up},
    // no maps, and glTF exporters
    {"matcap_chrome_normal", "", ""},
    {"wall_preview_diffuse", "", ""},
    {"gltf_metallicRoughness", "gltf", "metallic=b roughness=g "},
    {"Default_metalRoughness", "Default", "metallic=b roughness=g "},
};

TEST(MapNamesOfLibraries, SayWhatTheyAre)
{
    for (const RealName& name : kRealNames) {
        const NamedMaps named = maps_named(name.stem);
        std::string roles;
        for (const auto& [role, channels] : named.roles) roles += role + "=" + channels + " ";
        EXPECT_EQ(roles, name.roles) << name.stem;
        EXPECT_EQ(named.short_name, name.material) << name.stem;
        EXPECT_EQ(named.green, name.green) << name.stem;
    }
    EXPECT_GE(std::size(kRealNames), 100u);
}

class FoldersOfMaps : public TextureFiles {
protected:
    std::vector<MaterialFiles> found(const std::vector<std::string>& names)
    {
        for (const std::string& name : names) std::ofstream(folder / name) << "x";
        return find_materials(folder);
    }
};

// The maps of one material come together, whatever their marks.
TEST_F(FoldersOfMaps, UnrealsMasksBelongToItsColours)
{
    const auto materials =
        found({"T_Metal_Wall_D.png", "T_Metal_Wall_N.png", "T_Metal_Wall_ORM.png"});
    ASSERT_EQ(materials.size(), 1u);
    EXPECT_EQ(materials[0].name, "Metal_Wall");
    EXPECT_EQ(materials[0].inputs.size(), 5u);
    EXPECT_EQ(materials[0].inputs.at("roughness").channels, "g");
}

TEST_F(FoldersOfMaps, PoliigonsWorkflowIsNoMap)
{
    const auto materials = found({"Wall001_COL_2K_SPECULAR.jpg", "Wall001_GLOSS_2K_SPECULAR.jpg",
                                  "Wall001_NRM_2K_SPECULAR.jpg", "Wall001_REFL_2K_SPECULAR.jpg"});
    ASSERT_EQ(materials.size(), 1u);
    const auto& inputs = materials[0].inputs;
    EXPECT_TRUE(inputs.count("albedo") && inputs.count("smoothness") && inputs.count("normal") &&
                inputs.count("specular"));
}

}  // namespace
}  // namespace petrichor::texproc
