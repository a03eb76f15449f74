#include "texproc/material/shipped.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "texproc/codecs/files/texture.h"

namespace petrichor::texproc {

namespace {

// Where a packed image keeps a channel of a role.
struct Place {
    int channel;
    bool inverted;
};

using Has = std::function<bool(const std::string&)>;

std::optional<Place> place_of(const PackPreset& preset, const std::string& role, int channel,
                              const Has& has)
{
    for (std::size_t c = 0; c < preset.channels.size(); ++c) {
        const PackChannel sources = parse_pack_channel(preset.channels[c]);
        const auto used = std::find_if(sources.begin(), sources.end(), [&](const PackSource& s) {
            return s.role.empty() || has(s.role);
        });
        if (used != sources.end() && used->role == role && used->channel == channel) {
            return Place{static_cast<int>(c), used->invert};
        }
    }
    return std::nullopt;
}

Image role_of(const Image& packed, const std::vector<std::optional<Place>>& places)
{
    const int channels = static_cast<int>(places.size());
    Image to(packed.width, packed.height, channels, ColorSpace::Data);
    for (int y = 0; y < to.height; ++y) {
        for (int x = 0; x < to.width; ++x) {
            for (int c = 0; c < channels; ++c) {
                const auto& place = places[static_cast<std::size_t>(c)];
                if (place) {
                    const float v = packed.at(x, y, place->channel);
                    to.at(x, y, c) = place->inverted ? 1.0f - v : v;
                } else {
                    const float nx = 2.0f * to.at(x, y, 0) - 1.0f,
                                ny = 2.0f * to.at(x, y, 1) - 1.0f;
                    to.at(x, y, c) =
                        0.5f + 0.5f * std::sqrt(std::max(0.0f, 1.0f - nx * nx - ny * ny));
                }
            }
        }
    }
    return to;
}

std::vector<Image> packed_levels(const std::filesystem::path& folder, const PlannedOutput& output,
                                 const MadeOutput& made)
{
    std::vector<Image> levels;
    if (output.rule.format == "dds" || output.rule.format == "ktx2") {
        const MipTexture texture = read_texture(folder / made.files.front());
        for (std::size_t k = 0; k < texture.levels.size(); ++k) {
            levels.push_back(
                to_image(decode_level(texture, static_cast<int>(k), 0, true), ColorSpace::Data));
        }
    } else if (output.rule.level_files && output.rule.format != "exr") {
        for (const std::string& file : made.files) {
            levels.push_back(read_image(folder / file));
        }
    }
    return levels;
}

}  // namespace

std::vector<Image> shipped_levels(const std::filesystem::path& folder, const PlannedOutput& output,
                                  const MadeOutput& made, const std::string& role, int channels,
                                  int width, const Has& has)
{
    std::vector<std::optional<Place>> places;
    for (int c = 0; c < channels; ++c) {
        places.push_back(place_of(output.rule.channels, role, c, has));
        if (!places.back() && c < 2) return {};
    }
    std::size_t first = 0;  // outputs may start at a smaller level
    while ((width >> first) > made.width) ++first;
    std::vector<Image> levels;
    for (const Image& packed : packed_levels(folder, output, made)) {
        levels.resize(std::max(levels.size(), first));
        levels.push_back(levels.empty() ? Image() : role_of(packed, places));
    }
    return levels;
}

}  // namespace petrichor::texproc
