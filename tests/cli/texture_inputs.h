// What the tests of `petrichor texture` work on: small generated materials.
#ifndef PETRICHOR_TESTS_CLI_TEXTURE_INPUTS_H
#define PETRICHOR_TESTS_CLI_TEXTURE_INPUTS_H

#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tests/support/program.h"
#include "texproc/generate/generate.h"
#include "texproc/material/pack.h"

namespace petrichor::testing_texture {

using namespace testing_program;
namespace fs = std::filesystem;

// brick and soil, 64 x 64, with the names of two different tools.
inline void write_materials(const fs::path& folder)
{
    const texproc::MaterialMaps brick =
        texproc::generate_material(texproc::MaterialKind::Brick, 64, 1, 1);
    texproc::write_image(folder / "Brick01_1K-PNG_Color.png", brick.albedo);
    texproc::write_image(folder / "Brick01_1K-PNG_NormalGL.png", brick.normal);
    texproc::write_image(folder / "Brick01_1K-PNG_Roughness.png", brick.roughness);
    texproc::write_image(folder / "Brick01_1K-PNG_Displacement.png", brick.height, {.bits = 16});
    const texproc::MaterialMaps soil =
        texproc::generate_material(texproc::MaterialKind::Soil, 64, 1, 1);
    texproc::write_image(folder / "wet/soil_diff_2k.png", soil.albedo);
    texproc::write_image(folder / "wet/soil_nor_gl_2k.png", soil.normal);
    texproc::write_raw(
        folder / "wet/soil_arm_2k.png",
        texproc::pack(texproc::pack_preset("gltf-orm"),
                      {{"roughness", texproc::to_raw(soil.roughness, texproc::PixelType::U8)},
                       {"occlusion", texproc::to_raw(soil.occlusion, texproc::PixelType::U8)}}));
}

// For what does not depend on how levels are filtered, nor on what they score.
inline std::vector<std::string> quickly(std::vector<std::string> command)
{
    command.insert(command.end(), {"--rule", "median", "--no-score"});
    return command;
}

// Every file below a folder but the build's own memory, with its content.
inline std::map<std::string, std::string> contents(const fs::path& folder)
{
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        const std::string name = fs::relative(entry.path(), folder).string();
        if (entry.is_regular_file() && name != ".petrichor-build.json")
            all[name] = read_file(entry.path());
    }
    return all;
}

// Good and bad maps of one small material, and an old output.
inline void write_maps(const Workplace& place)
{
    const texproc::MaterialMaps soil =
        texproc::generate_material(texproc::MaterialKind::Soil, 32, 1, 1);
    texproc::write_image(place / "normal.png", soil.normal);
    texproc::write_image(place / "rough.png", soil.roughness);
    texproc::write_image(place / "height.png", soil.height, {.bits = 16});
    texproc::write_image(place / "color.png", soil.albedo);
    texproc::write_image(place / "other.png", Image(16, 32, 1, ColorSpace::Data, 0.5f));
    texproc::write_image(place / "line.png", Image(1, 32, 1, ColorSpace::Data, 0.5f));
    texproc::write_image(place / "zero.png", Image(32, 32, 3, ColorSpace::Data, 0.5f));
    Image nan(32, 32, 1, ColorSpace::Data, 0.5f);
    nan.pixels[7] = std::nanf("");
    texproc::write_image(place / "nan.exr", nan, {.bits = 32});
    write_file(place / "text.png", "this is no picture");
    write_file(place / "file", "x");
    write_file(place / "bad.toml", "channels = [\"a\", \"b\", \"c\", \"d\", \"e\"]\n");
    for (const char* name : {"out.png", "out_0.png", "out_1.png", "out_occlusion.png"})
        write_file(place / name, "old");
}

}  // namespace petrichor::testing_texture

#endif
