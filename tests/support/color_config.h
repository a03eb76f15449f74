#ifndef PETRICHOR_TESTS_SUPPORT_COLOR_CONFIG_H
#define PETRICHOR_TESTS_SUPPORT_COLOR_CONFIG_H

#include <string>

namespace petrichor::testing_program {

/// A small OpenColorIO config: views of two displays, a look, a table half.spi1d (half_table()) beside it. `power`: of
/// the first view.
inline std::string color_config(const std::string& power = "2.2")
{
    return R"(ocio_profile_version: 2
search_path: .
strictparsing: true
roles:
  default: lin_srgb
  scene_linear: wide
displays:
  Monitor:
    - !<View> {name: Power, colorspace: power}
    - !<View> {name: Tinted, colorspace: tinted}
    - !<View> {name: Plain sRGB, colorspace: srgb}
  Projector:
    - !<View> {name: Table, colorspace: table}
looks:
  - !<Look> {name: dim, process_space: lin_srgb, transform: !<CDLTransform> {slope: [0.5, 0.5, 0.5]}}
colorspaces:
  - !<ColorSpace> {name: lin_srgb}
  - !<ColorSpace>
    name: wide
    to_scene_reference: !<MatrixTransform> {matrix: [2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1]}
  - !<ColorSpace>
    name: power
    from_scene_reference: !<ExponentTransform> {value: [)" +
           power + ", " + power + ", " + power + R"(, 1], direction: inverse}
  - !<ColorSpace>
    name: tinted
    from_scene_reference: !<GroupTransform>
      children:
        - !<MatrixTransform> {matrix: [0.5, 0.25, 0, 0, 0, 1, 0, 0, 0, 0, 0.25, 0, 0, 0, 0, 1]}
        - !<ExponentTransform> {value: [2, 2, 2, 1], direction: inverse}
  - !<ColorSpace>
    name: srgb
    from_scene_reference: !<ExponentWithLinearTransform> {gamma: 2.4, offset: 0.055, direction: inverse}
  - !<ColorSpace>
    name: table
    from_scene_reference: !<FileTransform> {src: half.spi1d, interpolation: linear}
)";
}

/// ACES 1.0 by transforms that the library brings along, with views of scene light and spaces of displays, as such
/// configs have them.
inline std::string aces_config()
{
    return R"(ocio_profile_version: 2
roles:
  default: raw
  scene_linear: ACEScg
  aces_interchange: ACES2065-1
  cie_xyz_d65_interchange: CIE-XYZ-D65
file_rules:
  - !<Rule> {name: Default, colorspace: default}
shared_views:
  - !<View> {name: ACES 1.0 SDR, view_transform: SDR, display_colorspace: <USE_DISPLAY_NAME>}
  - !<View> {name: Un-tone-mapped, view_transform: Plain, display_colorspace: <USE_DISPLAY_NAME>}
displays:
  sRGB:
    - !<Views> [ACES 1.0 SDR, Un-tone-mapped]
    - !<View> {name: Raw, colorspace: raw}
  Rec.1886:
    - !<Views> [ACES 1.0 SDR, Un-tone-mapped]
active_views: [ACES 1.0 SDR, Un-tone-mapped, Raw]
view_transforms:
  - !<ViewTransform>
    name: Plain
    from_scene_reference: !<BuiltinTransform> {style: UTILITY - ACES-AP0_to_CIE-XYZ-D65_BFD}
  - !<ViewTransform>
    name: SDR
    from_scene_reference: !<BuiltinTransform> {style: ACES-OUTPUT - ACES2065-1_to_CIE-XYZ-D65 - SDR-VIDEO_1.0}
display_colorspaces:
  - !<ColorSpace> {name: CIE-XYZ-D65}
  - !<ColorSpace>
    name: sRGB
    from_display_reference: !<BuiltinTransform> {style: DISPLAY - CIE-XYZ-D65_to_sRGB}
  - !<ColorSpace>
    name: Rec.1886
    from_display_reference: !<BuiltinTransform> {style: DISPLAY - CIE-XYZ-D65_to_REC.1886-REC.709}
colorspaces:
  - !<ColorSpace> {name: ACES2065-1}
  - !<ColorSpace>
    name: ACEScg
    to_scene_reference: !<BuiltinTransform> {style: ACEScg_to_ACES2065-1}
  - !<ColorSpace>
    name: Linear Rec.709 (sRGB)
    aliases: [lin_rec709_srgb]
    from_scene_reference: !<GroupTransform>
      children:
        - !<BuiltinTransform> {style: UTILITY - ACES-AP0_to_CIE-XYZ-D65_BFD}
        - !<MatrixTransform> {matrix: [3.2404542, -1.5371385, -0.4985314, 0, -0.9692660, 1.8760108, 0.0415560, 0, 0.0556434, -0.2040259, 1.0572252, 0, 0, 0, 0, 1]}
  - !<ColorSpace> {name: raw, isdata: true}
)";
}

/// A config as version 1 of the library wrote them: the view's space is scene light to the power 1 / 1.8.
inline std::string old_config()
{
    return R"(ocio_profile_version: 1
search_path: luts
strictparsing: true
luma: [0.2126, 0.7152, 0.0722]
roles:
  default: raw
  scene_linear: linear
displays:
  sRGB:
    - !<View> {name: Film, colorspace: film}
active_displays: [sRGB]
active_views: [Film]
colorspaces:
  - !<ColorSpace>
    name: linear
    family: ""
    equalitygroup: ""
    bitdepth: 32f
    isdata: false
    allocation: lg2
    allocationvars: [-15, 6]
  - !<ColorSpace>
    name: film
    bitdepth: 8ui
    from_reference: !<ExponentTransform> {value: [1.8, 1.8, 1.8, 1], direction: inverse}
  - !<ColorSpace> {name: raw, isdata: true}
)";
}

/// A table that scales 0..1 by `top`, "0.5".
inline std::string half_table(const std::string& top = "0.5")
{
    return "Version 1\nFrom 0.0 1.0\nLength 2\nComponents 1\n{\n0.0\n" + top + "\n}\n";
}

}  // namespace petrichor::testing_program

#endif
