#include "texproc/pack.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "base/error.h"

namespace petrichor::texproc {

namespace {

std::string trimmed(const std::string& s)
{
    const std::size_t a = s.find_first_not_of(" \t");
    const std::size_t b = s.find_last_not_of(" \t");
    return a == std::string::npos ? "" : s.substr(a, b - a + 1);
}

[[noreturn]] void bad_source(const std::string& text)
{
    throw Error("pack: '" + text + "' is not a channel source",
                "Write a role (roughness, albedo.g), '1 - role', a number in 0..1, or several "
                "separated by '|'.");
}

std::uint32_t code_at(const RawImage& image, std::size_t value)
{
    if (image.type == PixelType::U8) return static_cast<std::uint32_t>(image.bytes[value]);
    std::uint16_t code;
    std::memcpy(&code, image.bytes.data() + 2 * value, 2);
    return code;
}

std::uint32_t top_of(PixelType type) { return type == PixelType::U8 ? 255u : 65535u; }

// Integers of one depth in the other: exact upwards (x 257), nearest downwards.
std::uint32_t recoded(std::uint32_t code, PixelType from, PixelType to)
{
    if (from == to) return code;
    return from == PixelType::U8 ? code * 257u : (code * 255u + 32767u) / 65535u;
}

RawImage as_integers(const RawImage& image)
{
    if (image.type == PixelType::U8 || image.type == PixelType::U16) return {};
    return to_raw(to_image(image, ColorSpace::Data), PixelType::U16);
}

}  // namespace

PackChannel parse_pack_channel(const std::string& text)
{
    PackChannel channel;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t bar = std::min(text.find('|', at), text.size());
        std::string part = trimmed(text.substr(at, bar - at));
        at = bar + 1;
        PackSource source;
        if (part.empty()) bad_source(text);
        char* end = nullptr;
        const double number = std::strtod(part.c_str(), &end);
        const std::string rest = trimmed(end);
        if (end != part.c_str() && rest.empty()) {
            if (!(number >= 0.0 && number <= 1.0)) bad_source(text);
            source.constant = number;
        } else {
            if (end != part.c_str()) {
                if (number != 1.0 || rest[0] != '-') bad_source(text);
                source.invert = true;
                part = trimmed(rest.substr(1));
            }
            const std::size_t dot = part.rfind('.');
            if (dot != std::string::npos) {
                const std::size_t c = std::string("rgba").find(part.substr(dot + 1));
                if (part.size() != dot + 2 || c == std::string::npos) bad_source(text);
                source.channel = static_cast<int>(c);
                part.resize(dot);
            }
            const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || c == '_' || c == '-'; };
            if (part.empty() || !std::all_of(part.begin(), part.end(), letter)) bad_source(text);
            source.role = part;
        }
        channel.push_back(source);
    }
    return channel;
}

const std::vector<PackPreset>& pack_presets()
{
    static const char* const kSmooth = "smoothness | 1 - roughness | 0.5";
    static const char* const kRough = "roughness | 1 - smoothness | 1";
    static const std::vector<PackPreset> presets{
        {"unity-standard-metallic", "R metallic, A smoothness; import as linear",
         {"metallic | 0", "0", "0", kSmooth}, {}},
        {"urp-lit", "R metallic, A smoothness; import as linear",
         {"metallic | 0", "0", "0", kSmooth}, {}},
        {"unity-standard-specular", "RGB specular colour (sRGB), A smoothness",
         {"specular.r | 0.22", "specular.g | 0.22", "specular.b | 0.22", kSmooth}, {"r", "g", "b"}},
        {"unity-hdrp-mask", "R metallic, G occlusion, B detail mask, A smoothness; linear",
         {"metallic | 0", "occlusion | 1", "detail | 1", kSmooth}, {}},
        {"unity-hdrp-detail", "R albedo detail, G normal y, B smoothness detail, A normal x; linear",
         {"albedo | 0.5", "normal.g | 0.5", "smoothness | 1 - roughness | 0.5", "normal.r | 0.5"},
         {}},
        {"unreal-orm", "R occlusion, G roughness, B metallic; linear",
         {"occlusion | 1", kRough, "metallic | 0"}, {}},
        {"gltf-orm", "R occlusion, G roughness, B metallic; linear",
         {"occlusion | 1", kRough, "metallic | 0"}, {}},
        {"godot-orm", "R occlusion, G roughness, B metallic; linear",
         {"occlusion | 1", kRough, "metallic | 0"}, {}},
        {"unreal-arm", "R occlusion, G roughness, B metallic; linear",
         {"occlusion | 1", kRough, "metallic | 0"}, {}},
        {"rma", "R roughness, G metallic, B occlusion; linear",
         {kRough, "metallic | 0", "occlusion | 1"}, {}},
        {"mra", "R metallic, G roughness, B occlusion; linear",
         {"metallic | 0", kRough, "occlusion | 1"}, {}},
        {"terrain-layer-mask", "R metallic, G occlusion, B height, A smoothness; linear",
         {"metallic | 0", "occlusion | 1", "height | 0.5", kSmooth}, {}},
        {"weather-mask", "R porosity, G puddle height, B flow or cavity, A smoothness; linear",
         {"porosity | 0.5", "puddle | height | 1", "flow | cavity | 0.5", kSmooth}, {}},
        {"normal-ag", "R 1, G y, B 1, A x (two-channel normals of older engines)",
         {"1", "normal.g", "1", "normal.r"}, {}},
        {"normal-rg", "R x, G y", {"normal.r", "normal.g", "0"}, {}},
    };
    return presets;
}

const PackPreset& pack_preset(const std::string& name)
{
    std::string known;
    for (const PackPreset& preset : pack_presets()) {
        if (preset.name == name) return preset;
        known += (known.empty() ? "" : ", ") + preset.name;
    }
    throw Error("pack: there is no preset '" + name + "'", "Use one of: " + known + ".");
}

RawImage channel_of(const RawImage& image, int channel)
{
    if (channel < 0 || channel >= image.channels) {
        throw Error("pack: channel " + std::to_string(channel) + " of an image with " +
                        std::to_string(image.channels),
                    "Choose one of its channels.");
    }
    RawImage one{image.width, image.height, 1, image.type, {}, {}};
    const std::size_t size = size_of(image.type);
    const std::size_t step = static_cast<std::size_t>(image.channels) * size;
    one.bytes.resize(one.values() * size);
    const std::byte* from = image.bytes.data() + static_cast<std::size_t>(channel) * size;
    for (std::size_t i = 0; i < one.values(); ++i) {
        std::memcpy(&one.bytes[i * size], from + i * step, size);
    }
    return one;
}

RawImage pack(const PackPreset& preset, const std::map<std::string, RawImage>& maps, int bits)
{
    if (preset.channels.empty() || preset.channels.size() > 4) {
        throw Error("pack: preset " + preset.name + " has " +
                        std::to_string(preset.channels.size()) + " channels",
                    "Give it 1 to 4.");
    }
    const RawImage* first = nullptr;
    std::string first_role;
    bool deep = false;
    for (const auto& [role, map] : maps) {
        if (!first) {
            first = &map;
            first_role = role;
        }
        if (map.width != first->width || map.height != first->height) {
            throw Error("pack: " + first_role + " is " + std::to_string(first->width) + " x " +
                            std::to_string(first->height) + ", " + role + " is " +
                            std::to_string(map.width) + " x " + std::to_string(map.height),
                        "Resample one of them: all maps must have the same size.");
        }
        deep |= map.type != PixelType::U8;
    }
    if (!first) throw Error("pack: no map was given", "Name at least one, such as --roughness R.png.");
    if (bits != 0 && bits != 8 && bits != 16) {
        throw Error("pack: bits must be 8 or 16, got " + std::to_string(bits), "Use 8 or 16.");
    }
    const PixelType type = bits == 16 || (bits == 0 && deep) ? PixelType::U16 : PixelType::U8;
    RawImage out{first->width, first->height, static_cast<int>(preset.channels.size()), type, {}, {}};
    const std::size_t pixels = static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height);
    out.bytes.resize(out.values() * size_of(type));
    const std::size_t width = preset.channels.size();
    for (std::size_t c = 0; c < width; ++c) {
        const PackChannel alternatives = parse_pack_channel(preset.channels[c]);
        const auto found = std::find_if(alternatives.begin(), alternatives.end(), [&](const auto& s) {
            return s.role.empty() || maps.count(s.role);
        });
        if (found == alternatives.end()) {
            throw Error("pack: nothing for channel " + std::to_string(c) + " of " + preset.name +
                            " ('" + preset.channels[c] + "')",
                        "Give one of these maps.");
        }
        const auto put = [&](std::size_t i, std::uint32_t code) {
            if (type == PixelType::U8) {
                out.bytes[i * width + c] = static_cast<std::byte>(code);
            } else {
                const std::uint16_t code16 = static_cast<std::uint16_t>(code);
                std::memcpy(&out.bytes[2 * (i * width + c)], &code16, 2);
            }
        };
        if (found->role.empty()) {
            const auto code = static_cast<std::uint32_t>(
                std::lround(found->constant * static_cast<double>(top_of(type))));
            for (std::size_t i = 0; i < pixels; ++i) put(i, code);
            continue;
        }
        const RawImage& given = maps.at(found->role);
        const RawImage converted = as_integers(given);
        const RawImage& map = converted.bytes.empty() ? given : converted;
        if (found->channel >= map.channels) {
            throw Error("pack: " + preset.name + " needs channel " +
                            std::to_string(found->channel) + " of " + found->role +
                            ", which has " + std::to_string(map.channels),
                        "Give a map with more channels.");
        }
        const std::size_t step = static_cast<std::size_t>(map.channels);
        const std::uint32_t top = top_of(map.type);
        const auto at = static_cast<std::size_t>(found->channel);
        for (std::size_t i = 0; i < pixels; ++i) {
            std::uint32_t code = code_at(map, i * step + at);
            if (found->invert) code = top - code;
            put(i, recoded(code, map.type, type));
        }
    }
    return out;
}

std::map<std::string, RawImage> unpack(const PackPreset& preset, const RawImage& packed)
{
    std::map<std::string, RawImage> maps;
    for (std::size_t c = 0; c < preset.channels.size(); ++c) {
        const PackSource source = parse_pack_channel(preset.channels[c]).front();
        if (source.role.empty()) continue;
        if (packed.type != PixelType::U8 && packed.type != PixelType::U16) {
            throw Error("unpack: the image holds floats", "Unpack 8- or 16-bit images.");
        }
        RawImage one = channel_of(packed, static_cast<int>(c));
        if (source.invert) {
            const std::uint32_t top = top_of(one.type);
            for (std::size_t i = 0; i < one.values(); ++i) {
                const std::uint32_t code = top - code_at(one, i);
                if (one.type == PixelType::U8) {
                    one.bytes[i] = static_cast<std::byte>(code);
                } else {
                    const std::uint16_t code16 = static_cast<std::uint16_t>(code);
                    std::memcpy(&one.bytes[2 * i], &code16, 2);
                }
            }
        }
        const std::string suffix = source.channel ? std::string(".") + "rgba"[source.channel] : "";
        maps.emplace(source.role + suffix, std::move(one));
    }
    return maps;
}

}  // namespace petrichor::texproc
