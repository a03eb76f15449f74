// petrichor texture workflow: specular and gloss into metallic and roughness, and back.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>

#include "base/error.h"
#include "cli/texture/cmd_texture.h"
#include "cli/texture/maps/files.h"
#include "texproc/material/pack.h"
#include "texproc/material/spec_gloss.h"

namespace petrichor::cli {

namespace {

namespace fs = std::filesystem;

struct Arguments {
    std::string to, color, specular, gloss, metallic, roughness, out;
    int bits = 8, threads = 0;
    texproc::ReadOptions reading;
};

// A colour as linear light, without the alpha.
Image color_of(const Arguments& a, const std::string& file)
{
    const Image read = texproc::to_image(read_map(file, a.reading), ColorSpace::Linear);
    if (read.channels == 3) return read;
    Image color(read.width, read.height, 3, ColorSpace::Linear);
    const std::size_t step = static_cast<std::size_t>(read.channels);
    for (std::size_t i = 0; 3 * i < color.pixels.size(); ++i) {
        for (std::size_t c = 0; c < 3; ++c)
            color.pixels[3 * i + c] = read.pixels[step * i + (step < 3 ? 0 : c)];
    }
    return color;
}

Image first_channel(const Arguments& a, const std::string& file)
{
    const texproc::RawImage read = read_map(file, a.reading);
    return texproc::to_image(read.channels == 1 ? read : texproc::channel_of(read, 0),
                             ColorSpace::Data);
}

void turn(Image& image)
{
    for (float& v : image.pixels) v = 1.0f - v;
}

void write(const Arguments& a, const char* role, const Image& image)
{
    const std::string file = a.out + "_" + role + ".png";
    texproc::write_image(file, image, {.bits = a.bits, .threads = a.threads});
    std::cout << file << "\n";
}

void require(const std::string& file, const char* option, const std::string& to)
{
    if (!file.empty()) return;
    throw Error("texture workflow: --to " + to + " needs " + option,
                "Name the file; --help shows an example.");
}

void refuse(const std::string& file, const char* option, const std::string& to)
{
    if (file.empty()) return;
    throw Error("texture workflow: --to " + to + " has no use for " + option + " " + file,
                "Leave it out.");
}

void run(const Arguments& a)
{
    const bool metallic = a.to == "metallic";
    require(metallic ? a.specular : a.metallic, metallic ? "--specular" : "--metallic", a.to);
    refuse(metallic ? a.metallic : a.specular, metallic ? "--metallic" : "--specular", a.to);
    refuse(metallic ? a.roughness : a.gloss, metallic ? "--roughness" : "--gloss", a.to);
    if (metallic) {
        const texproc::MetallicColor made =
            texproc::to_metallic(color_of(a, a.color), color_of(a, a.specular));
        write(a, "albedo", made.base);
        write(a, "metallic", made.metallic);
    } else {
        const texproc::SpecularColor made =
            texproc::to_specular(color_of(a, a.color), first_channel(a, a.metallic));
        write(a, "diffuse", made.diffuse);
        write(a, "specular", made.specular);
    }
    const std::string& gloss = metallic ? a.gloss : a.roughness;
    if (gloss.empty()) return;
    Image turned = first_channel(a, gloss);
    turn(turned);
    write(a, metallic ? "roughness" : "gloss", turned);
}

}  // namespace

void add_texture_workflow(CLI::App& texture)
{
    auto a = std::make_shared<Arguments>();
    CLI::App* app = texture.add_subcommand(
        "workflow", "specular and gloss maps into metallic and roughness maps, and back");
    app->add_option("--to", a->to, "metallic or specular")
        ->required()
        ->check(CLI::IsMember({"metallic", "specular"}));
    app->add_option("--color", a->color, "diffuse colour; --to specular: base colour")->required();
    app->add_option("--specular", a->specular, "specular colour");
    app->add_option("--gloss", a->gloss, "gloss or smoothness; FILE:a for one channel");
    app->add_option("--metallic", a->metallic, "metallic");
    app->add_option("--roughness", a->roughness, "roughness");
    app->add_option("-o,--out", a->out, "start of the names: OUT_albedo.png, OUT_metallic.png, ...")
        ->required();
    app->add_option("--bits", a->bits, "8 or 16")
        ->check(CLI::IsMember({8, 16}))
        ->capture_default_str();
    app->add_option("--threads", a->threads, "0: all cores; the bytes do not depend on it");
    app->footer(
        "By the reference conversion of KHR_materials_pbrSpecularGlossiness: exact where a texel "
        "is\n"
        "either metal or none. Dielectrics of another reflectance than 4 % come back as those.\n"
        "\n"
        "Examples:\n"
        "  petrichor texture workflow --to metallic --color wall_diffuse.png \\\n"
        "      --specular wall_specular.png --gloss wall_specular.png:a -o wall\n"
        "  petrichor texture workflow --to specular --color wall_albedo.png \\\n"
        "      --metallic wall_orm.png:b --roughness wall_orm.png:g -o wall");
    app->callback([a] { run(*a); });
}

}  // namespace petrichor::cli
