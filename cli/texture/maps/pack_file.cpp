#include "cli/texture/maps/pack_file.h"

#include <algorithm>

#include "base/error.h"
#include "base/words.h"
#include "cli/rooms.h"
#include "film/toml/toml_value.h"

namespace petrichor::cli {

namespace {

namespace fs = std::filesystem;

}  // namespace

texproc::PackPreset read_pack_file(const fs::path& file)
{
    const toml::table table = parse_toml(read_toml_text(file, "pack preset"), file.string());
    texproc::PackPreset preset;
    preset.name = file.stem().string();
    for (const auto& [key, value] :
         TomlValue(table, file.string(), "preset").entries({"name", "note", "channels", "srgb"})) {
        if (key == "name") preset.name = value.text();
        if (key == "note") preset.note = value.text();
        if (key == "channels") {
            preset.channels = value.texts();
            if (preset.channels.empty() || preset.channels.size() > 4) {
                value.refuse("an array of 1 to 4 channels");
            }
            for (const std::string& channel : preset.channels) texproc::parse_pack_channel(channel);
        }
        if (key == "srgb" && value.boolean()) preset.srgb_channels = {"r", "g", "b"};
    }
    if (preset.channels.empty()) {
        throw Error(file.string() + ": no channels",
                    "Write a line such as: channels = [\"metallic | 0\", \"occlusion | 1\"]");
    }
    return preset;
}

texproc::PackPreset pack_preset_or_file(const std::string& text, const fs::path& relative_to)
{
    if (fs::path(text).extension() == ".toml") return read_pack_file(relative_to / text);
    return texproc::pack_preset(text);
}

std::vector<std::string> preset_roles(const texproc::PackPreset& preset)
{
    std::vector<std::string> roles;
    for (const std::string& channel : preset.channels) {
        for (const texproc::PackSource& source : texproc::parse_pack_channel(channel)) {
            if (source.role.empty()) continue;
            if (std::find(roles.begin(), roles.end(), source.role) == roles.end()) {
                roles.push_back(source.role);
            }
        }
    }
    return roles;
}

}  // namespace petrichor::cli
