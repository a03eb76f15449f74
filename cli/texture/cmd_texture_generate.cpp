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
#include "texproc/codecs/files/io.h"
#include "texproc/filter/area.h"
#include "texproc/filter/bake.h"
#include "texproc/generate/generate.h"
#include "texproc/study/compare/shading.h"

namespace petrichor::cli {

namespace {

namespace fs = std::filesystem;

struct Arguments {
    std::vector<std::string> kinds;
    std::string out, sheet;
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

std::vector<std::string> all_names()
{
    std::vector<std::string> names;
    for (const texproc::MaterialKindInfo& kind : texproc::material_kinds())
        names.push_back(kind.name);
    for (const WeatherTexture& weather : kWeather) names.push_back(weather.name);
    return names;
}

void list_kinds()
{
    const auto line = [](const std::string& name, const std::string& meaning) {
        std::cout << "  " << name << std::string(name.size() < 18 ? 18 - name.size() : 1, ' ')
                  << meaning << "\n";
    };
    std::cout << "Materials (albedo, normal, height, roughness, occlusion, metallic, puddle):\n";
    for (const texproc::MaterialKindInfo& kind : texproc::material_kinds())
        line(kind.name, kind.meaning);
    std::cout << "Textures of weather and skin:\n";
    for (const WeatherTexture& weather : kWeather) line(weather.name, weather.meaning);
}

std::vector<std::string> wanted_kinds(const Arguments& a)
{
    const std::vector<std::string> known = all_names();
    std::vector<std::string> wanted;
    for (const std::string& kind : a.kinds) {
        if (kind == "all") return known;
        if (std::find(known.begin(), known.end(), kind) == known.end()) {
            throw Error(
                "texture generate: there is no kind '" + kind + "'." + did_you_mean(kind, known),
                "Use all, or one of: " + join_words(known) + ".");
        }
        wanted.push_back(kind);
    }
    if (wanted.empty()) {
        throw Error("texture generate: no kind was named",
                    "Use all, or one of: " + join_words(known) + ".");
    }
    return wanted;
}

void write_material(const Arguments& a, const std::string& name, const texproc::MaterialMaps& maps)
{
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
    const nlohmann::ordered_json facts{{"kind", name},
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
        list_kinds();
        return;
    }
    const std::vector<std::string> kinds = wanted_kinds(a);
    if (a.out.empty() && a.sheet.empty()) {
        throw Error("texture generate: nowhere to write", "Give -o FOLDER, or --sheet FILE.png.");
    }
    constexpr int kCell = 256, kColumns = 3, kStepX = 2 * kCell + 30, kStepY = kCell + 40;
    const int rows = (static_cast<int>(kinds.size()) + kColumns - 1) / kColumns;
    ContactSheet sheet(kColumns * kStepX + 20, rows * kStepY + 10);
    Progress progress("texture generate", static_cast<int>(kinds.size()));
    for (std::size_t k = 0; k < kinds.size(); ++k) {
        const int x = 20 + static_cast<int>(k) % kColumns * kStepX,
                  y = 32 + static_cast<int>(k) / kColumns * kStepY;
        if (const auto kind = texproc::find_material_kind(kinds[k])) {
            const texproc::MaterialMaps maps =
                texproc::generate_material(*kind, a.size, a.seed, a.threads);
            if (!a.out.empty()) write_material(a, kinds[k], maps);
            if (!a.sheet.empty()) draw(sheet, maps, kinds[k], x, y, kCell);
        } else {
            const auto weather =
                std::find_if(std::begin(kWeather), std::end(kWeather),
                             [&](const WeatherTexture& w) { return w.name == kinds[k]; });
            const Image texture = weather->make(a.size, a.seed);
            if (!a.out.empty()) {
                texproc::write_image(fs::path(a.out) / (kinds[k] + ".png"), texture,
                                     {.bits = a.bits, .threads = a.threads});
            }
            if (!a.sheet.empty()) draw(sheet, texture, kinds[k], x, y, kCell);
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
    app->add_option("kinds", a->kinds, "which, or all; --list shows them");
    app->add_option("-o,--out", a->out,
                    "folder: KIND_albedo.png, KIND_normal.png, ..., KIND.json (size in metres)");
    app->add_option("--seed", a->seed, "another one, another stone")->capture_default_str();
    app->add_option("--size", a->size, "texels of a side")
        ->check(CLI::Range(16, 8192))
        ->capture_default_str();
    app->add_option("--bits", a->bits, "8 or 16 (height always has 16)")
        ->check(CLI::IsMember({8, 16}))
        ->capture_default_str();
    app->add_option("--sheet", a->sheet, "PNG with all of them, lit");
    app->add_flag("--list", a->list, "show the kinds");
    app->add_option("--threads", a->threads, "0: all cores; the bytes do not depend on it");
    app->footer(
        "Examples:\n  petrichor texture generate cobble brick --seed 7 --size 2048 -o materials\n"
        "  petrichor texture generate all --sheet kinds.png");
    app->callback([a] { run(*a); });
}

}  // namespace petrichor::cli
