#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>
#include <utility>

#include "base/error.h"
#include "base/words.h"
#include "cli/texture/cmd_texture.h"
#include "cli/texture/maps/files.h"
#include "cli/texture/maps/pack_file.h"
#include "texproc/codecs/files/texture.h"
#include "texproc/filter/mips.h"
#include "texproc/material/material_names.h"
#include "texproc/material/pack.h"

namespace petrichor::cli {

namespace {

namespace fs = std::filesystem;

constexpr const char* kRoles[] = {"albedo",   "normal",    "height",   "roughness", "smoothness",
                                  "metallic", "occlusion", "specular", "detail",    "porosity",
                                  "puddle",   "flow",      "cavity",   "emission",  "opacity"};

struct Arguments {
    std::map<std::string, std::string> files;
    std::vector<std::string> others;  // ROLE=FILE
    std::string preset, out, format;
    int bits = 0;
    bool list = false, mips = false;
    texproc::ReadOptions reading;
};

void show(const texproc::PackPreset& preset)
{
    std::cout << preset.name << ": " << preset.note << "\n";
    for (std::size_t c = 0; c < preset.channels.size(); ++c) {
        std::cout << "    "
                  << "RGBA"[c] << " = " << preset.channels[c] << "\n";
    }
}

void list_presets(const Arguments& a)
{
    if (!a.preset.empty()) {
        show(pack_preset_or_file(a.preset));
        return;
    }
    for (const texproc::PackPreset& preset : texproc::pack_presets()) show(preset);
}

// Where each role of the preset comes from. A map that the preset has no use for is a mistake.
std::map<std::string, std::string> files_by_role(const Arguments& a,
                                                 const texproc::PackPreset& preset)
{
    std::map<std::string, std::string> files;
    for (const auto& [role, file] : a.files) {
        if (!file.empty()) files[role] = file;
    }
    for (const std::string& text : a.others) {
        const std::size_t equals = text.find('=');
        if (equals == std::string::npos || equals == 0) {
            throw Error("texture pack: --map '" + text + "' is not ROLE=FILE",
                        "Write for example --map wetness=wet.png.");
        }
        files[text.substr(0, equals)] = text.substr(equals + 1);
    }
    const std::vector<std::string> roles = preset_roles(preset);
    for (const auto& [role, file] : files) {
        if (std::find(roles.begin(), roles.end(), role) != roles.end()) continue;
        throw Error("texture pack: preset " + preset.name + " has no channel for '" + role + "' (" +
                        file + ")",
                    "Leave it out; the preset takes: " + join_words(roles) + ".");
    }
    return files;
}

// Containers for GPUs may hold blocks and levels; other files hold the numbers as they are.
void write_packed(const Arguments& a, const texproc::PackPreset& preset, texproc::RawImage packed)
{
    if (!texproc::holds_mip_chain(a.out) || (!a.mips && fs::path(a.out).extension() == ".exr")) {
        if (a.mips || !a.format.empty()) {
            throw Error("texture pack: " + a.out + " holds no levels and no blocks",
                        "Write .dds or .ktx2, or leave --mips and --format out.");
        }
        texproc::write_raw(a.out, packed);
        return;
    }
    texproc::TextureWriteOptions options;
    options.format = a.format;
    options.srgb = !preset.srgb_channels.empty();
    const ColorSpace space = options.srgb ? ColorSpace::Linear : ColorSpace::Data;
    const texproc::PixelType type = packed.type;
    std::vector<texproc::RawImage> levels;
    levels.push_back(std::move(packed));
    if (a.mips) {
        const std::vector<Image> chain = texproc::mip_chain(texproc::to_image(levels[0], space));
        for (std::size_t k = 1; k < chain.size(); ++k)
            levels.push_back(texproc::to_raw(chain[k], type));
    }
    texproc::write_mip_chain(a.out, levels, options);
}

// Of `wall_arm.png` the roughness is green; -1 where a channel was chosen or the name tells none.
int channel_by_name(const std::string& text, const std::string& role)
{
    const MapFile file = parse_map_file(text);
    if (file.channel >= 0) return -1;
    const auto roles = texproc::maps_named(file.path.stem().string()).roles;
    const auto named = roles.find(role);
    if (named == roles.end() || named->second.size() != 1) return -1;
    return static_cast<int>(std::string("rgba").find(named->second));
}

void run(const Arguments& a)
{
    if (a.list) {
        list_presets(a);
        return;
    }
    if (a.preset.empty() || a.out.empty()) {
        throw Error("texture pack: --preset and --out are needed",
                    "See the presets with: petrichor texture pack --list");
    }
    const texproc::PackPreset preset = pack_preset_or_file(a.preset);
    const std::map<std::string, std::string> files = files_by_role(a, preset);
    std::vector<std::string> texts;
    for (const auto& [role, file] : files) texts.push_back(file);
    std::vector<texproc::RawImage> images = read_maps(texts, a.reading);
    std::map<std::string, texproc::RawImage> maps;
    std::size_t next = 0;
    for (const auto& [role, file] : files) {
        // Where a preset takes one number of a role it takes the first.
        const bool color = role == "albedo" || role == "specular" || role == "emission" || role == "normal" ||
                           role == "detail" || role == "flow";
        texproc::RawImage& image = images[next];
        if (const int named = channel_by_name(file, role); !color && named >= 0 && named < image.channels && image.channels > 2) {
            std::cerr << "note: " << role << " is " << file << ":" << "rgba"[named] << ", as the name says\n";
            image = texproc::channel_of(image, named);
        } else if (!color && a.files.contains(role)) {
            tell_red_taken(file, image, role);
        }
        maps.emplace(role, std::move(images[next++]));
    }
    texproc::RawImage packed = texproc::pack(preset, maps, a.bits);
    maps.clear();  // writing needs memory of its own
    write_packed(a, preset, std::move(packed));
}

}  // namespace

void add_texture_pack(CLI::App& texture)
{
    auto a = std::make_shared<Arguments>();
    CLI::App* app = texture.add_subcommand("pack", "several maps into the channels of one");
    app->add_option("--preset", a->preset,
                    "what goes where: a name of --list, or a file of yours (.toml)");
    for (const char* role : kRoles) {
        app->add_option(std::string("--") + role, a->files[role], "FILE or FILE:g (one channel)");
    }
    app->add_option("--map", a->others, "ROLE=FILE, for a role of a preset of yours");
    app->add_option("-o,--out", a->out, "the packed image");
    app->add_option("--bits", a->bits, "8 or 16; default: the deepest input")
        ->check(CLI::IsMember({8, 16}));
    app->add_option(
        "--format", a->format,
        "dds, ktx2: rgba8, bc7, ... (see convert --help); default: the numbers as they are");
    app->add_flag("--mips", a->mips,
                  "dds, ktx2: all levels, plain means (build makes prefiltered ones)");
    app->add_flag("--list", a->list, "show the presets, or the one of --preset");
    app->add_option("--max-pixels", a->reading.max_pixels, "refuse larger inputs")
        ->capture_default_str();
    app->footer(
        "Example:\n  petrichor texture pack --preset unity-hdrp-mask --metallic m.png "
        "--occlusion ao.png --roughness r.png -o mask.png\n\n"
        "A preset of yours, mine.toml:\n"
        "  note = \"R wetness, G occlusion, B 1 - roughness\"\n"
        "  channels = [\"wetness | 0\", \"occlusion | 1\", \"smoothness | 1 - roughness\"]\n"
        "  petrichor texture pack --preset mine.toml --map wetness=w.png --roughness r.png -o "
        "m.png");
    app->callback([a] { run(*a); });
}

}  // namespace petrichor::cli
