#include "texproc/material/pack.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <type_traits>
#include <vector>

#include "base/error.h"
#include "base/parallel.h"

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

template <class Code>
Code value_at(const std::byte* bytes, std::size_t value)
{
    Code code;
    std::memcpy(&code, bytes + value * sizeof(Code), sizeof(Code));
    return code;
}

template <class Code>
void put_at(std::byte* bytes, std::size_t value, Code code)
{
    std::memcpy(bytes + value * sizeof(Code), &code, sizeof(Code));
}

// One number in the type of another: exact upwards (x 257), nearest downwards; floats are 0..1.
template <class From, class To>
To recoded(From value)
{
    if constexpr (std::is_same_v<From, To>) {
        return value;
    } else if constexpr (std::is_same_v<To, float>) {
        return static_cast<float>(value) / static_cast<float>(std::numeric_limits<From>::max());
    } else if constexpr (std::is_same_v<To, std::uint16_t>) {
        return static_cast<To>(value * 257u);
    } else {
        return static_cast<To>((value * 255u + 32767u) / 65535u);
    }
}

template <class From>
From inverted(From value)
{
    if constexpr (std::is_same_v<From, float>) {
        return 1.0f - value;
    } else {
        return static_cast<From>(std::numeric_limits<From>::max() - value);
    }
}

// Copies one channel into its place among `width` others, for the pixels first .. last - 1.
struct ChannelCopy {
    const std::byte* from = nullptr;  ///< null: a constant
    std::size_t step = 1, channel = 0;
    bool invert = false;
    double constant = 0.0;
    PixelType type = PixelType::U8;
};

template <class From, class To>
void copy_values(const ChannelCopy& source, std::size_t first, std::size_t last, std::byte* to,
                 std::size_t width, std::size_t at)
{
    for (std::size_t i = first; i < last; ++i) {
        From value = value_at<From>(source.from, i * source.step + source.channel);
        if (source.invert) value = inverted(value);
        put_at(to, i * width + at, recoded<From, To>(value));
    }
}

template <class To>
To code_of(double constant)
{
    if constexpr (std::is_same_v<To, float>) {
        return static_cast<float>(constant);
    } else {
        return static_cast<To>(std::lround(constant * std::numeric_limits<To>::max()));
    }
}

template <class To>
void copy_channel(const ChannelCopy& source, std::size_t first, std::size_t last, std::byte* to,
                  std::size_t width, std::size_t at)
{
    if (!source.from) {
        const To value = code_of<To>(source.constant);
        for (std::size_t i = first; i < last; ++i) put_at(to, i * width + at, value);
    } else if (source.type == PixelType::U8) {
        copy_values<std::uint8_t, To>(source, first, last, to, width, at);
    } else if constexpr (std::is_same_v<To, float>) {
        source.type == PixelType::U16
            ? copy_values<std::uint16_t, To>(source, first, last, to, width, at)
            : copy_values<float, To>(source, first, last, to, width, at);
    } else {
        copy_values<std::uint16_t, To>(source, first, last, to, width, at);
    }
}

// Rows of four channels in one sweep, where every map is grey and holds the codes that are written:
// four times as fast as channel after channel.
template <class To>
class FourGreys {
public:
    FourGreys(const std::vector<ChannelCopy>& copies, PixelType type, std::size_t row) : row_(row)
    {
        if (copies.size() != kGreys) return;
        fit_ = true;
        for (std::size_t c = 0; c < kGreys; ++c) {
            const ChannelCopy& copy = copies[c];
            if (!copy.from) constants_[c].assign(row, code_of<To>(copy.constant));
            fit_ = fit_ && (!copy.from || (copy.type == type && copy.step == 1));
            from_[c] = copy.from;
            flip_[c] = copy.from && copy.invert ? std::numeric_limits<To>::max() : To{0};
        }
    }
    bool fit() const { return fit_; }
    void write(std::size_t y, std::byte* to) const
    {
        const To *r = at(0, y), *g = at(1, y), *b = at(2, y), *a = at(3, y);
        To* __restrict out = reinterpret_cast<To*>(to) + y * row_ * kGreys;
        const To fr = flip_[0], fg = flip_[1], fb = flip_[2], fa = flip_[3];
        for (std::size_t x = 0; x < row_; ++x) {
            out[4 * x] = static_cast<To>(r[x] ^ fr);
            out[4 * x + 1] = static_cast<To>(g[x] ^ fg);
            out[4 * x + 2] = static_cast<To>(b[x] ^ fb);
            out[4 * x + 3] = static_cast<To>(a[x] ^ fa);
        }
    }

private:
    static constexpr std::size_t kGreys = 4;
    const To* at(std::size_t c, std::size_t y) const
    {
        return from_[c] ? reinterpret_cast<const To*>(from_[c]) + y * row_ : constants_[c].data();
    }

    std::size_t row_;
    bool fit_ = false;
    std::array<const std::byte*, kGreys> from_{};
    std::array<std::vector<To>, kGreys> constants_;
    std::array<To, kGreys> flip_{};
};

// All channels of a row are written while it lies in the cache.
template <class To>
void pack_rows(const std::vector<ChannelCopy>& copies, RawImage& out, int threads)
{
    const std::size_t row = static_cast<std::size_t>(out.width), width = copies.size();
    const auto each_row = [&](auto write) {
        parallel_for(static_cast<std::size_t>(out.height), threads, write);
    };
    if constexpr (!std::is_same_v<To, float>) {
        const FourGreys<To> greys(copies, out.type, row);
        if (greys.fit()) {
            each_row([&](std::size_t y) { greys.write(y, out.bytes.data()); });
            return;
        }
    }
    each_row([&](std::size_t y) {
        for (std::size_t c = 0; c < width; ++c)
            copy_channel<To>(copies[c], y * row, (y + 1) * row, out.bytes.data(), width, c);
    });
}

// Floats in the type that can be packed into `type`: codes for integers, singles for floats.
RawImage converted(const RawImage& image, PixelType type)
{
    if (image.type == PixelType::U8 || image.type == PixelType::U16) return {};
    if (type == PixelType::F32 && image.type == PixelType::F32) return {};
    return to_raw(to_image(image, ColorSpace::Data),
                  type == PixelType::F32 ? PixelType::F32 : PixelType::U16);
}

std::string size_text(const RawImage& image)
{
    return std::to_string(image.width) + " x " + std::to_string(image.height);
}

// The maps all have one size; the first of them.
const RawImage& check_sizes(const std::map<std::string, RawImage>& maps)
{
    if (maps.empty()) {
        throw Error("pack: no map was given", "Name at least one, such as --roughness R.png.");
    }
    const auto& [first_role, first] = *maps.begin();
    for (const auto& [role, map] : maps) {
        if (map.width == first.width && map.height == first.height) continue;
        throw Error("pack: " + first_role + " is " + size_text(first) + ", " + role + " is " +
                        size_text(map),
                    "Resample one of them: all maps must have the same size.");
    }
    return first;
}

PixelType packed_type(const std::map<std::string, RawImage>& maps, int bits)
{
    if (bits == 8) return PixelType::U8;
    if (bits == 16) return PixelType::U16;
    if (bits == 32) return PixelType::F32;
    if (bits != 0) {
        throw Error("pack: bits must be 8, 16 or 32, got " + std::to_string(bits),
                    "Use 8 or 16 for integers, 32 for floats.");
    }
    const bool deep = std::any_of(maps.begin(), maps.end(),
                                  [](const auto& m) { return m.second.type != PixelType::U8; });
    return deep ? PixelType::U16 : PixelType::U8;
}

// The first alternative that is there. A map with too few channels counts only when it is the last.
const PackSource* chosen_source(const PackChannel& alternatives,
                                const std::map<std::string, RawImage>& maps)
{
    const PackSource* fallback = nullptr;
    for (const PackSource& source : alternatives) {
        if (source.role.empty()) return &source;
        const auto map = maps.find(source.role);
        if (map == maps.end()) continue;
        if (source.channel < map->second.channels) return &source;
        if (!fallback) fallback = &source;
    }
    return fallback;
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
            const auto letter = [](char c) {
                return (c >= 'a' && c <= 'z') || c == '_' || c == '-';
            };
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
        {"unity-standard-metallic",
         "R metallic, A smoothness; import as linear",
         {"metallic | 0", "0", "0", kSmooth},
         {}},
        {"urp-lit",
         "R metallic, A smoothness; import as linear",
         {"metallic | 0", "0", "0", kSmooth},
         {}},
        {"unity-standard-specular",
         "RGB specular colour (sRGB), A smoothness",
         {"specular.r | 0.22", "specular.g | 0.22", "specular.b | 0.22", kSmooth},
         {"r", "g", "b"}},
        {"unity-hdrp-mask",
         "R metallic, G occlusion, B detail mask, A smoothness; linear",
         {"metallic | 0", "occlusion | 1", "detail | 1", kSmooth},
         {}},
        {"unity-hdrp-detail",
         "R albedo detail, G normal y, B smoothness detail, A normal x; linear",
         {"albedo | 0.5", "normal.g | 0.5", "smoothness | 1 - roughness | 0.5", "normal.r | 0.5"},
         {}},
        {"unreal-orm",
         "R occlusion, G roughness, B metallic; linear",
         {"occlusion | 1", kRough, "metallic | 0"},
         {}},
        {"gltf-orm",
         "R occlusion, G roughness, B metallic; linear",
         {"occlusion | 1", kRough, "metallic | 0"},
         {}},
        {"godot-orm",
         "R occlusion, G roughness, B metallic; linear",
         {"occlusion | 1", kRough, "metallic | 0"},
         {}},
        {"unreal-arm",
         "R occlusion, G roughness, B metallic; linear",
         {"occlusion | 1", kRough, "metallic | 0"},
         {}},
        {"rma",
         "R roughness, G metallic, B occlusion; linear",
         {kRough, "metallic | 0", "occlusion | 1"},
         {}},
        {"mra",
         "R metallic, G roughness, B occlusion; linear",
         {"metallic | 0", kRough, "occlusion | 1"},
         {}},
        {"terrain-layer-mask",
         "R metallic, G occlusion, B height, A smoothness; linear",
         {"metallic | 0", "occlusion | 1", "height | 0.5", kSmooth},
         {}},
        {"weather-mask",
         "R porosity, G where puddles stand, B flow or cavity, A smoothness; linear",
         {"porosity | 0.5", "puddle | 1 - height | 1", "flow | cavity | 0.5", kSmooth},
         {}},
        {"normal-ag",
         "R 1, G y, B 1, A x (two-channel normals of older engines)",
         {"1", "normal.g", "1", "normal.r"},
         {}},
        // The layouts of Lux (alpha of albedo and specular as the Unity presets above).
        {"lux-height",
         "R puddle mask, G height, B mix mask, A height of the second set; linear",
         {"puddle | 0", "height | 0.5", "mix | 0", "secondheight | 0.5"},
         {}},
        {"lux-combined",
         "G occlusion, B translucency; linear",
         {"0", "occlusion | 1", "translucency | 0"},
         {}},
        {"lux-skin",
         "G translucency, B curvature, A occlusion; linear",
         {"0", "translucency | 0", "curvature | 0.5", "occlusion | 1"},
         {}},
        {"lux-tangent",
         "G y, A x of the tangent direction; linear, imported as a normal map",
         {"1", "tangent.g | 0.5", "1", "tangent.r | 1"},
         {}},
        {"lux-occlusion", "G occlusion; linear", {"0", "occlusion | 1", "0"}, {}},
        {"lux-detail-mask",
         "G mix mask, A detail mask; linear",
         {"0", "mix | 0", "0", "detail | 1"},
         {}},
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

RawImage pack(const PackPreset& preset, const std::map<std::string, RawImage>& maps, int bits,
              int threads)
{
    if (preset.channels.empty() || preset.channels.size() > 4) {
        throw Error("pack: preset " + preset.name + " has " +
                        std::to_string(preset.channels.size()) + " channels",
                    "Give it 1 to 4.");
    }
    const RawImage& first = check_sizes(maps);
    const PixelType type = packed_type(maps, bits);
    const std::size_t width = preset.channels.size();
    std::vector<ChannelCopy> copies;
    std::vector<RawImage> kept(width);  // floats as codes
    for (std::size_t c = 0; c < width; ++c) {
        const PackChannel alternatives = parse_pack_channel(preset.channels[c]);
        const PackSource* source = chosen_source(alternatives, maps);
        if (!source) {
            throw Error("pack: nothing for channel " + std::to_string(c) + " of " + preset.name +
                            " ('" + preset.channels[c] + "')",
                        "Give one of these maps.");
        }
        ChannelCopy copy;
        copy.constant = source->constant;
        copy.invert = source->invert;
        copy.channel = static_cast<std::size_t>(source->channel);
        if (!source->role.empty()) {
            const RawImage& given = maps.at(source->role);
            if (source->channel >= given.channels) {
                throw Error("pack: " + preset.name + " needs channel " +
                                std::to_string(source->channel) + " of " + source->role +
                                ", which has " + std::to_string(given.channels),
                            "Give a map with more channels.");
            }
            kept[c] = converted(given, type);
            const RawImage& map = kept[c].bytes.empty() ? given : kept[c];
            copy.from = map.bytes.data();
            copy.type = map.type;
            copy.step = static_cast<std::size_t>(map.channels);
        }
        copies.push_back(copy);
    }
    RawImage out{first.width, first.height, static_cast<int>(width), type, {}, {}};
    out.bytes.resize(out.values() * size_of(type));
    if (type == PixelType::U8)
        pack_rows<std::uint8_t>(copies, out, threads);
    else if (type == PixelType::U16)
        pack_rows<std::uint16_t>(copies, out, threads);
    else
        pack_rows<float>(copies, out, threads);
    return out;
}

// Every code subtracted from the largest.
static void invert(RawImage& image)
{
    for (std::size_t i = 0; i < image.values(); ++i) {
        if (image.type == PixelType::U8) {
            put_at(image.bytes.data(), i, inverted(value_at<std::uint8_t>(image.bytes.data(), i)));
        } else {
            put_at(image.bytes.data(), i, inverted(value_at<std::uint16_t>(image.bytes.data(), i)));
        }
    }
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
        if (source.invert) invert(one);
        const std::string suffix = source.channel ? std::string(".") + "rgba"[source.channel] : "";
        maps.emplace(source.role + suffix, std::move(one));
    }
    return maps;
}

}  // namespace petrichor::texproc
