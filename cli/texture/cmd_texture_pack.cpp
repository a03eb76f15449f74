#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <thread>

#include "base/error.h"
#include "cli/texture/cmd_texture.h"
#include "cli/texture/files.h"
#include "texproc/pack.h"

namespace petrichor::cli {

namespace {

constexpr const char* kRoles[] = {"albedo",    "normal",     "height",   "roughness", "smoothness",
                                  "metallic",  "occlusion",  "specular", "detail",    "porosity",
                                  "puddle",    "flow",       "cavity",   "emission",  "opacity"};

struct Arguments {
    std::map<std::string, std::string> files;
    std::string preset, out;
    int bits = 0;
    bool list = false;
    texproc::ReadOptions reading;
};

void list_presets()
{
    for (const texproc::PackPreset& preset : texproc::pack_presets()) {
        std::cout << preset.name << ": " << preset.note << "\n";
        for (std::size_t c = 0; c < preset.channels.size(); ++c) {
            std::cout << "    " << "RGBA"[c] << " = " << preset.channels[c] << "\n";
        }
    }
}

void run(const Arguments& a)
{
    if (a.list) {
        list_presets();
        return;
    }
    if (a.preset.empty() || a.out.empty()) {
        throw Error("texture pack: --preset and --out are needed",
                    "See the presets with: petrichor texture pack --list");
    }
    const texproc::PackPreset& preset = texproc::pack_preset(a.preset);
    std::map<std::string, texproc::RawImage> maps;
    for (const auto& [role, file] : a.files) {
        if (!file.empty()) maps.emplace(role, read_map(file, a.reading));
    }
    texproc::write_raw(a.out, texproc::pack(preset, maps, a.bits));
}

}  // namespace

void add_texture_pack(CLI::App& texture)
{
    auto a = std::make_shared<Arguments>();
    CLI::App* app = texture.add_subcommand("pack", "several maps into the channels of one");
    app->add_option("--preset", a->preset, "what goes where; --list shows all");
    for (const char* role : kRoles) {
        app->add_option(std::string("--") + role, a->files[role], "FILE or FILE:g (one channel)");
    }
    app->add_option("-o,--out", a->out, "the packed image");
    app->add_option("--bits", a->bits, "8 or 16; default: the deepest input")
        ->check(CLI::IsMember({8, 16}));
    app->add_flag("--list", a->list, "show the presets");
    app->add_option("--max-pixels", a->reading.max_pixels, "refuse larger inputs")
        ->capture_default_str();
    app->footer(
        "Example:\n  petrichor texture pack --preset unity-hdrp-mask --metallic m.png "
        "--occlusion ao.png --roughness r.png -o mask.png");
    app->callback([a] { run(*a); });
}

}  // namespace petrichor::cli
