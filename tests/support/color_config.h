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

/// A table that scales 0..1 by `top`, "0.5".
inline std::string half_table(const std::string& top = "0.5")
{
    return "Version 1\nFrom 0.0 1.0\nLength 2\nComponents 1\n{\n0.0\n" + top + "\n}\n";
}

}  // namespace petrichor::testing_program

#endif
