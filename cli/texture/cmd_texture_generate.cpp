// petrichor texture generate: tileable materials and weather textures from a seed.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/error.h"
#include "base/output_file.h"
#include "base/words.h"
#include "cli/progress.h"
#include "cli/texture/cmd_texture.h"
#include "cli/texture/contact_sheet.h"
#include "cli/texture/maps/material_file.h"
#include "texproc/codecs/files/io.h"
#include "texproc/filter/area.h"
#include "texproc/filter/bake.h"
#include "texproc/generate/generate.h"
#include "texproc/study/compare/shading.h"

namespace petrichor::cli {

namespace {

namespace fs = std::filesystem;

struct Arguments {
    std::vector<std::string> kinds, set;
    std::string out, sheet, color;
    int size = 1024, bits = 8, threads = 0;
    std::uint32_t seed = 1;
    bool list = false;
};

struct WeatherTexture {
    const char* name;
    const char* meaning;
    Image (*make)(int size, std::uint32_t seed);
};

constexpr WeatherTexture kWeather[] = {
    {"ripple", "drops for rain ripples: R envelope, GB direction, A time offset",
     texproc::ripple_drops},
    {"snow_mask", "where snow lies first: B mask, AG detail normal", texproc::snow_mask},
    {"snow_water_bump", "surface of snow and water: B snow smoothness, AG normal",
     texproc::snow_water_bump},
    {"skin_ring", "lookup of skin: diffuse light by 0.5 + 0.5 n.l and, downwards, curvature",
     [](int size, std::uint32_t) { return texproc::skin_ring(size); }},
};

void list_line(const std::string& name, const std::string& meaning)
{
    std::cout << "  " << name << std::string(name.size() < 18 ? 18 - name.size() : 1, ' ') << meaning
              << "\n";
}

void list_all()
{
    std::cout << "Materials (albedo, normal, height, roughness, occlusion, metallic, puddle);\n"
                 "--list NAME shows what can be set:\n";
    for (const texproc::MaterialKindInfo& kind : texproc::material_kinds())
        list_line(kind.name, kind.meaning);
    std::cout << "Presets (data/materials; a file of yours does as well):\n";
    for (const std::string& name : material_presets())
        list_line(name, named_material(name).note);
    std::cout << "Textures of weather and skin:\n";
    for (const WeatherTexture& weather : kWeather) list_line(weather.name, weather.meaning);
}

void list_parameters(const NamedMaterial& material)
{
    const texproc::MaterialKindInfo& info =
        texproc::material_kinds()[static_cast<std::size_t>(material.recipe.kind)];
    std::cout << material.name << ": " << (material.note.empty() ? info.meaning : material.note) << "\n";
    for (const texproc::MaterialParameter& p : info.parameters) {
        const auto found = material.recipe.values.find(p.name);
        const float value = found == material.recipe.values.end() ? p.usual : found->second;
        list_line(p.name, number_text(value) + "  (" + number_text(p.low) + ".." +
                              number_text(p.high) + ", " + p.unit + ") " + p.meaning);
    }
}

const WeatherTexture* weather_texture(const std::string& name)
{
    const auto found = std::find_if(std::begin(kWeather), std::end(kWeather),
                                    [&](const WeatherTexture& w) { return w.name == name; });
    return found == std::end(kWeather) ? nullptr : &*found;
}

// What is to be made; a weather texture has a name alone.
std::vector<NamedMaterial> wanted(const Arguments& a)
{
    std::vector<std::string> names = a.kinds;
    if (std::find(names.begin(), names.end(), "all") != names.end()) {
        names.clear();
        for (const texproc::MaterialKindInfo& kind : texproc::material_kinds()) names.push_back(kind.name);
        for (const std::string& preset : material_presets()) names.push_back(preset);
        if (a.set.empty() && a.color.empty()) {
            for (const WeatherTexture& weather : kWeather) names.push_back(weather.name);
        }
    }
    if (names.empty()) {
        throw Error("texture generate: no material was named",
                    "Name some, for example cobble; --list shows them.");
    }
    std::vector<NamedMaterial> materials;
    for (const std::string& name : names) {
        const bool weather = weather_texture(name) != nullptr;
        if (weather && !(a.set.empty() && a.color.empty())) {
            throw Error("texture generate: " + name + " has no parameters and no colour",
                        "Leave out --set and --color, or make it in a command of its own.");
        }
        NamedMaterial material = weather ? NamedMaterial{name, {}, {}, {}} : named_material(name);
        for (const NamedMaterial& other : materials) {
            if (other.name == material.name) {
                throw Error("texture generate: two materials are named " + material.name,
                            "Their files would have the same names: make them in two folders.");
            }
        }
        material.recipe.size = a.size;
        material.recipe.seed = a.seed;
        material.recipe.threads = a.threads;
        if (!a.color.empty()) material.recipe.color = parse_color(a.color, "--color");
        for (const std::string& assignment : a.set) set_parameter(material.recipe, assignment);
        materials.push_back(std::move(material));
    }
    return materials;
}

void write_material(const Arguments& a, const NamedMaterial& material, const texproc::MaterialMaps& maps)
{
    const std::string& name = material.name;
    ScratchFolder scratch(a.out);  // half a material on a full disk helps nobody
    const fs::path folder = scratch.path();
    std::vector<std::string> files;
    const std::pair<const char*, const Image*> images[] = {
        {"albedo", &maps.albedo},       {"normal", &maps.normal},
        {"height", &maps.height},       {"roughness", &maps.roughness},
        {"occlusion", &maps.occlusion}, {"metallic", &maps.metallic},
        {"puddle", &maps.puddle_mask}};
    for (const auto& [role, image] : images) {
        // Heights of 8 bits are stairs.
        const int bits = std::string(role) == "height" ? 16 : a.bits;
        files.push_back(name + "_" + role + ".png");
        texproc::write_image(folder / files.back(), *image, {.bits = bits, .threads = a.threads});
    }
    const nlohmann::ordered_json facts{{"kind", material.kind},
                                       {"seed", a.seed},
                                       {"size", a.size},
                                       {"tile_m", maps.tile_m},
                                       {"height_scale_m", maps.height_scale_m},
                                       {"depth", maps.height_scale_m / maps.tile_m},
                                       {"normal_green", "up"},
                                       {"program", "petrichor " PETRICHOR_VERSION}};
    files.push_back(name + ".json");
    write_text_file(folder / files.back(),
                    facts.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
    files.push_back(name + ".toml");
    write_text_file(folder / files.back(),
                    "# petrichor texture generate " + name + ".toml --size " + std::to_string(a.size) +
                        " --seed " + std::to_string(a.seed) + "\n" + material_file_text(material));
    scratch.publish(files);
}

// A lit ball of a material, beside its colour tiled twice.
void draw(ContactSheet& sheet, const texproc::MaterialMaps& maps, const std::string& name, int x,
          int y, int cell)
{
    texproc::ShadedMaps shaded;
    const int tile = cell / 2;
    // Two tiles across: a seam would show as a cross.
    const Image small = texproc::area_reduced(maps.albedo, tile, tile);
    Image twice(cell, cell, 3, ColorSpace::Linear);
    for (int j = 0; j < cell; ++j) {
        for (int i = 0; i < cell; ++i) {
            for (int c = 0; c < 3; ++c) twice.at(i, j, c) = small.at(i % tile, j % tile, c);
        }
    }
    sheet.place(twice, x, y);
    const int ball = std::min(cell, maps.albedo.width);
    shaded.albedo = {texproc::area_reduced(maps.albedo, ball, ball)};
    shaded.normal = {texproc::area_reduced(maps.normal, ball, ball)};
    shaded.roughness = {texproc::area_reduced(maps.roughness, ball, ball)};
    shaded.metallic = {texproc::area_reduced(maps.metallic, ball, ball)};
    sheet.place(texproc::shaded_ball(shaded, 0, cell, false, {.light = 0.15f, .exposure = 1.0f}),
                x + cell + 6, y);
    sheet.text(x, y - 8, name, 15.0, true);
}

void draw(ContactSheet& sheet, const Image& texture, const std::string& name, int x, int y,
          int cell)
{
    const Image small = texture.width > cell ? texproc::area_reduced(texture, cell, cell) : texture;
    const int parts = small.channels > 3 ? 2 : 1;
    const std::size_t step = static_cast<std::size_t>(small.channels);
    for (int half = 0; half < parts; ++half) {  // RGB, and alpha as grey
        Image shown(small.width, small.height, half ? 1 : 3, ColorSpace::Data);
        for (std::size_t i = 0; i < small.pixels.size() / step; ++i) {
            if (half) {
                shown.pixels[i] = small.pixels[step * i + 3];
            } else {
                for (std::size_t c = 0; c < 3; ++c)
                    shown.pixels[3 * i + c] = small.pixels[step * i + c];
            }
        }
        sheet.place(shown, x + half * (cell + 6), y);
    }
    sheet.text(x, y - 8, parts > 1 ? name + ": RGB and alpha" : name, 15.0, true);
}

void run(const Arguments& a)
{
    if (a.list) {
        if (a.kinds.empty()) list_all();
        for (const std::string& name : a.kinds) list_parameters(named_material(name));
        return;
    }
    const std::vector<NamedMaterial> materials = wanted(a);
    if (a.out.empty() && a.sheet.empty()) {
        throw Error("texture generate: nowhere to write", "Give -o FOLDER, or --sheet FILE.png.");
    }
    constexpr int kCell = 256, kColumns = 3, kStepX = 2 * kCell + 30, kStepY = kCell + 40;
    const int rows = (static_cast<int>(materials.size()) + kColumns - 1) / kColumns;
    ContactSheet sheet(kColumns * kStepX + 20, rows * kStepY + 10);
    Progress progress("texture generate", static_cast<int>(materials.size()));
    for (std::size_t k = 0; k < materials.size(); ++k) {
        const int x = 20 + static_cast<int>(k) % kColumns * kStepX,
                  y = 32 + static_cast<int>(k) / kColumns * kStepY;
        const NamedMaterial& material = materials[k];
        if (const WeatherTexture* weather = weather_texture(material.name)) {
            const Image texture = weather->make(a.size, a.seed);
            if (!a.out.empty()) {
                texproc::write_image(fs::path(a.out) / (material.name + ".png"), texture,
                                     {.bits = a.bits, .threads = a.threads});
            }
            if (!a.sheet.empty()) draw(sheet, texture, material.name, x, y, kCell);
        } else {
            const texproc::MaterialMaps maps = texproc::generate_material(material.recipe);
            if (!a.out.empty()) write_material(a, material, maps);
            if (!a.sheet.empty()) draw(sheet, maps, material.name, x, y, kCell);
        }
        progress.update(static_cast<int>(k) + 1);
    }
    if (a.sheet.empty()) return;
    const Pixels pixels = sheet.pixels();
    texproc::write_png8(a.sheet, pixels.width, pixels.height, 3, pixels.rgb);
}

}  // namespace

void add_texture_generate(CLI::App& texture)
{
    auto a = std::make_shared<Arguments>();
    CLI::App* app =
        texture.add_subcommand("generate", "tileable materials and weather textures from a seed");
    app->add_option("materials", a->kinds,
                    "kinds, presets, files of yours (.toml), or all; --list shows them");
    app->add_option("-o,--out", a->out,
                    "folder: NAME_albedo.png, NAME_normal.png, ..., NAME.json (size in metres), NAME.toml "
                    "(the preset that makes it again)");
    app->add_option("--set", a->set, "NAME=NUMBER of a material; --list MATERIAL shows names and units")
        ->allow_extra_args(false);
    app->add_option("--color", a->color, "mean albedo as an sRGB colour, #rrggbb");
    app->add_option("--seed", a->seed, "another one, another stone")->capture_default_str();
    app->add_option("--size", a->size, "texels of a side")
        ->check(CLI::Range(16, 8192))
        ->capture_default_str();
    app->add_option("--bits", a->bits, "8 or 16 (height always has 16)")
        ->check(CLI::IsMember({8, 16}))
        ->capture_default_str();
    app->add_option("--sheet", a->sheet, "PNG with all of them, lit");
    app->add_flag("--list", a->list, "show the materials, or what can be set of those that are named");
    app->add_option("--threads", a->threads, "0: all cores; the bytes do not depend on it");
    app->footer(
        "Examples:\n  petrichor texture generate cobble brick --seed 7 --size 2048 -o materials\n"
        "  petrichor texture generate --list asphalt\n"
        "  petrichor texture generate asphalt --set tile_m=4 --set cracks=0.8 --set patches=3 --size 2048 -o road\n"
        "  petrichor texture generate all --sheet kinds.png\n\n"
        "A preset of yours, path.toml:\n"
        "  kind = \"gravel\"\n  color = \"#b9a888\"\n  [parameters]\n  stone_m = 0.012");
    app->callback([a] { run(*a); });
}

}  // namespace petrichor::cli
