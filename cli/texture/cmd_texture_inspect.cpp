// petrichor texture inspect: what a file holds, and how a material behaves at a distance.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/error.h"
#include "cli/exit.h"
#include "cli/progress.h"
#include "cli/signals.h"
#include "cli/texture/cmd_texture.h"
#include "cli/texture/maps/files.h"
#include "cli/texture/sparkle_film.h"
#include "cli/texture/sparkle_sheet.h"
#include "texproc/codecs/files/texture.h"
#include "texproc/filter/normal.h"
#include "texproc/material/material_names.h"
#include "texproc/study/compare/inspect.h"

namespace petrichor::cli {

namespace {

namespace fs = std::filesystem;
using texproc::ImageFacts;
using texproc::RawImage;

struct Arguments {
    std::vector<std::string> files;
    std::string sheet, film, normal, roughness, smoothness, albedo;
    SparkleSheet drawing;
    std::string quality = "quick";
    bool green_down = false, green_known = false, json = false;
    texproc::ReadOptions reading;
};

const char* name_of(texproc::PixelType type)
{
    switch (type) {
        case texproc::PixelType::U8:
            return "8 bits";
        case texproc::PixelType::U16:
            return "16 bits";
        case texproc::PixelType::F16:
            return "half";
        case texproc::PixelType::F32:
            return "float";
    }
    return "";
}

// Levels and format of a GPU container; none for other files.
std::optional<texproc::MipTexture> container(const std::string& file,
                                             const texproc::ReadOptions& reading)
{
    const std::string extension = fs::path(file).extension().string();
    if (extension != ".dds" && extension != ".ktx2") return std::nullopt;
    return texproc::read_texture(file, reading);
}

// Sixteen bars of a histogram as letters.
std::string bars(const texproc::ChannelFacts& channel)
{
    static constexpr char kSteps[] = " .:-=+*#%@";
    std::string text;
    for (const double share : channel.histogram) {
        const int step = share <= 0.0 ? 0 : 1 + std::min(8, static_cast<int>(share * 32.0));
        text += kSteps[step];
    }
    return text;
}

// What the words of the name say, which numbers alone cannot tell: a grey colour is no height.
texproc::NamedMaps named_maps(const std::string& file)
{
    return texproc::maps_named(fs::path(texproc::parse_input_map(file).path).stem().string());
}

// "albedo (sRGB)", "occlusion r, roughness g, metallic b".
std::string roles_text(const texproc::NamedMaps& named)
{
    std::string text;
    for (const auto& [role, channels] : named.roles) {
        const bool color = role == "albedo" || role == "specular" || role == "emission";
        text += (text.empty() ? "" : ", ") + role + (channels.empty() ? "" : " " + channels) +
                (color ? " (sRGB)" : "");
    }
    return text;
}

nlohmann::ordered_json to_json(const std::string& file, const RawImage& raw,
                               const ImageFacts& facts,
                               const std::optional<texproc::MipTexture>& texture)
{
    nlohmann::ordered_json json{{"file", file},
                                {"width", raw.width},
                                {"height", raw.height},
                                {"channels", raw.channels},
                                {"type", name_of(raw.type)},
                                {"meaning", to_text(facts.meaning)},
                                {"confidence", facts.meaning_confidence},
                                {"named", named_maps(file).roles},
                                {"seam_u", facts.seam_u},
                                {"seam_v", facts.seam_v},
                                {"tiles_u", facts.tiles_u},
                                {"tiles_v", facts.tiles_v}};
    if (texture) {
        json["levels"] = texture->levels.size();
        json["format"] = name_of(texture->format);
        json["srgb"] = texture->srgb;
        json["images"] = texproc::images_of_texture(file);
    }
    if (facts.green) {
        json["green"] = {{"direction", facts.green->down ? "down" : "up"},
                         {"confidence", facts.green->confidence}};
    }
    for (const texproc::ChannelFacts& c : facts.channels) {
        json["statistics"].push_back({{"channel", c.name},
                                      {"low", c.low},
                                      {"p5", c.p5},
                                      {"median", c.median},
                                      {"p95", c.p95},
                                      {"high", c.high},
                                      {"mean", c.mean},
                                      {"deviation", c.deviation},
                                      {"codes", c.codes},
                                      {"not_finite", c.not_finite},
                                      {"histogram", c.histogram}});
    }
    return json;
}

void print(const std::string& file, const RawImage& raw, const ImageFacts& facts,
           const std::optional<texproc::MipTexture>& texture)
{
    const auto ending = [](int count) { return count == 1 ? "" : "s"; };
    std::printf("%s: %d x %d, %d channel%s, %s", file.c_str(), raw.width, raw.height, raw.channels,
                ending(raw.channels), name_of(raw.type));
    if (texture) {
        std::printf(", %s%s, %zu levels", name_of(texture->format).c_str(),
                    texture->srgb ? " sRGB" : "", texture->levels.size());
        const std::uint64_t images = texproc::images_of_texture(file);
        if (images > 1) std::printf(", the first of %llu images", static_cast<unsigned long long>(images));
    }
    std::printf("\n  looks like  %s (%.0f %%)", to_text(facts.meaning).c_str(),
                100.0 * facts.meaning_confidence);
    if (facts.green) {
        std::printf(", green %s (%.0f %%)", facts.green->down ? "down, DirectX" : "up, OpenGL",
                    100.0 * facts.green->confidence);
        std::printf(", mean length %.3f", facts.mean_length);
    }
    const std::string roles = roles_text(named_maps(file));
    if (!roles.empty()) std::printf("\n  named as    %s", roles.c_str());
    const auto axis = [](double seam, bool tiles) {
        return seam == 0.0 ? "?" : tiles ? "yes" : "no";
    };
    std::printf("\n  tiles       along u %s (seam %.2f), along v %s (seam %.2f)\n",
                axis(facts.seam_u, facts.tiles_u), facts.seam_u, axis(facts.seam_v, facts.tiles_v),
                facts.seam_v);
    std::printf(
        "  channel     low      p5       median   p95      high     mean     deviation  0 to 1\n");
    for (const texproc::ChannelFacts& c : facts.channels) {
        std::printf("  %-11s %-8.4f %-8.4f %-8.4f %-8.4f %-8.4f %-8.4f %-9.4f |%s|", c.name.c_str(),
                    c.low, c.p5, c.median, c.p95, c.high, c.mean, c.deviation, bars(c).c_str());
        if (c.codes > 0) std::printf(" %d code%s", c.codes, ending(c.codes));
        if (c.not_finite > 0) std::printf(" %zu NOT NUMBERS", c.not_finite);
        std::printf("\n");
    }
}

Image first_channel(const RawImage& raw, bool inverted)
{
    const Image all = texproc::to_image(raw, ColorSpace::Data);
    Image one(all.width, all.height, 1, ColorSpace::Data);
    for (std::size_t i = 0; i < one.pixels.size(); ++i) {
        const float v = all.pixels[i * static_cast<std::size_t>(all.channels)];
        one.pixels[i] = inverted ? 1.0f - v : v;
    }
    return one;
}

// Fills the roles of the sheet that no option named from the names of the files.
void find_roles(Arguments& a)
{
    for (const std::string& file : a.files) {
        const texproc::NamedMaps named = texproc::maps_named(fs::path(file).stem().string());
        for (const auto& [role, channels] : named.roles) {
            const std::string map = channels.size() == 1 ? file + ":" + channels : file;
            if (role == "normal" && a.normal.empty()) {
                a.normal = file;
                a.green_down = a.green_down || named.green == texproc::Green::Down;
                a.green_known = named.green != texproc::Green::Auto;
            }
            if (role == "roughness" && a.roughness.empty()) a.roughness = map;
            if (role == "smoothness" && a.smoothness.empty()) a.smoothness = map;
        }
        if (a.drawing.title.empty()) a.drawing.title = named.short_name;
    }
}

void draw_pictures(Arguments& a)
{
    find_roles(a);
    if (a.normal.empty() || (a.roughness.empty() && a.smoothness.empty())) {
        throw Error("texture inspect: --sheet and --film need a normal map and a roughness or smoothness map",
                    "Name them with --normal and --roughness, or give files whose names say what "
                    "they are.");
    }
    const RawImage normal = texproc::read_raw(a.normal, a.reading);
    a.drawing.normal = texproc::from_layout(texproc::to_image(normal, ColorSpace::Data),
                                            texproc::NormalLayout::Rgb);
    if (!a.green_down && !a.green_known) {
        const texproc::GreenDirection found = texproc::detect_green(a.drawing.normal);
        a.green_down = found.down && found.confidence > 0.25;
    }
    if (a.green_down) texproc::flip_green(a.drawing.normal);
    const bool smooth = a.roughness.empty();
    a.drawing.roughness =
        first_channel(read_map(smooth ? a.smoothness : a.roughness, a.reading), smooth);
    if (!a.albedo.empty()) {
        texproc::ReadOptions color = a.reading;
        color.space = ColorSpace::Linear;
        const Image albedo = texproc::read_image(a.albedo, color);
        Image rgb(albedo.width, albedo.height, 3, ColorSpace::Linear);
        for (std::size_t i = 0; i < rgb.pixels.size(); ++i) {
            rgb.pixels[i] = albedo.pixels[i / 3 * static_cast<std::size_t>(albedo.channels) +
                                          (albedo.channels >= 3 ? i % 3 : 0)];
        }
        a.drawing.albedo = std::move(rgb);
    }
    const auto same = [&](const Image& image) {
        return image.empty() ||
               (image.width == a.drawing.normal.width && image.height == a.drawing.normal.height);
    };
    if (!same(a.drawing.roughness) || !same(a.drawing.albedo)) {
        throw Error("texture inspect: the maps of the sheet have different sizes",
                    "Resample them to the size of " + a.normal + ".");
    }
    if (a.drawing.title.empty()) a.drawing.title = fs::path(a.normal).stem().string();
    a.drawing.quick = a.quality == "quick";
    if (!a.sheet.empty()) write_sparkle_sheet(a.drawing, a.sheet);
    if (a.film.empty()) return;
    Progress progress("texture inspect", 100);
    write_sparkle_film(
        a.drawing, a.film, [&](double share) { progress.update(static_cast<int>(100.0 * share)); }, interrupted);
}

void run(Arguments& a)
{
    if (a.files.empty() && a.sheet.empty() && a.film.empty()) {
        throw Error("texture inspect: no file", "Name at least one image.");
    }
    nlohmann::ordered_json all = nlohmann::ordered_json::array();
    int bad = 0;
    for (const std::string& file : a.files) {
        try {
            const RawImage raw = read_map(file, a.reading);
            const ImageFacts facts = texproc::inspect(raw);
            const auto texture = container(file, a.reading);
            if (a.json) {
                all.push_back(to_json(file, raw, facts, texture));
            } else {
                print(file, raw, facts, texture);
            }
        } catch (const Error& error) {
            std::fflush(stdout);
            std::cerr << "error " << error.what() << "\n  " << error.fix() << "\n";
            ++bad;
        }
    }
    if (a.json)
        std::printf("%s\n",
                    all.dump(1, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
    if (!a.sheet.empty() || !a.film.empty()) draw_pictures(a);
    if (bad > 0) throw ExitCode{kExitUser};
}

}  // namespace

void add_texture_inspect(CLI::App& texture)
{
    auto a = std::make_shared<Arguments>();
    CLI::App* app = texture.add_subcommand(
        "inspect", "what images hold; a sheet and a film of a material's mips under a light");
    app->add_option("files", a->files, "images");
    app->add_flag("--json", a->json, "for machines");
    app->add_option("--sheet", a->sheet,
                    "PNG: plain and prefiltered mips on balls and a floor, beside the truth");
    app->add_option("--film", a->film,
                    "MP4: the same floor under a moving camera in four lights; a .png: its first frame, a strip");
    app->add_option("--normal", a->normal, "default: the file whose name says so");
    auto* rough = app->add_option("--roughness", a->roughness, "FILE or FILE:g");
    app->add_option("--smoothness", a->smoothness, "FILE or FILE:a")->excludes(rough);
    app->add_option("--albedo", a->albedo,
                    "--sheet: colour; default: dark grey, where gloss shows best");
    app->add_flag("--green-down", a->green_down,
                  "of the normal map: +Y is down (DirectX); default: what the name or else the map says");
    app->add_option("--frames", a->drawing.frames,
                    "of the film, 24 a second; the camera goes on by one repeat of the material in all of them")
        ->check(CLI::Range(2, 2400))
        ->capture_default_str();
    app->add_option("--rule", a->drawing.rule, "prefilter rule of sheet and film")->capture_default_str();
    app->add_option("--quality", a->quality, "of sheet and film: full or quick")
        ->check(CLI::IsMember({"full", "quick"}))
        ->capture_default_str();
    app->add_option("--light", a->drawing.light,
                    "--sheet: alpha of the light: 0 the sun, 0.1 a window")
        ->capture_default_str();
    app->add_option("--title", a->drawing.title, "heading of sheet and film");
    app->add_option("--threads", a->drawing.threads, "0: all cores; the bytes do not depend on it");
    app->add_option("--max-pixels", a->reading.max_pixels, "refuse larger inputs")
        ->capture_default_str();
    app->footer(
        "Exit code 2 when a file cannot be read; the others are shown. Files from anywhere may be "
        "given:\n"
        "each is decoded apart, with limits on memory, time and pixels.\n\n"
        "Example:\n  petrichor texture inspect wall_diff.png wall_nor_gl.png wall_rough.png "
        "--sheet wall.png --film wall.mp4");
    app->callback([a] { run(*a); });
}

}  // namespace petrichor::cli
