#include "cli/texture/build/material.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/error.h"
#include "cli/texture/build/shipped.h"
#include "cli/texture/build/write_levels.h"
#include "cli/texture/files.h"
#include "texproc/area.h"
#include "texproc/bake.h"
#include "texproc/files/io.h"
#include "texproc/mips.h"
#include "texproc/normal.h"
#include "texproc/prefilter/prefilter.h"
#include "texproc/prefilter/stored.h"

namespace petrichor::cli {

namespace {

using texproc::PixelType;
using texproc::RawImage;

bool is_color(const std::string& role)
{
    return role == "albedo" || role == "specular" || role == "emission";
}

int bits_of(const RawImage& image)
{
    return image.type == PixelType::U8 ? 8 : image.type == PixelType::U16 ? 16 : 32;
}

// Grey paint is colour too.
RawImage widened(const RawImage& image)
{
    const texproc::PackPreset grey{"grey", "", {"m.r", "m.r", "m.r"}, {}};
    return texproc::pack(grey, {{"m", image}}, bits_of(image), 1);
}

// Some channels of an image, in its own numbers.
RawImage channels_of(const RawImage& image, const InputMap& map)
{
    if (map.channels.empty()) return image;
    texproc::PackPreset preset{"channels", "", {}, {}};
    for (const char letter : map.channels) {
        const int channel = static_cast<int>(std::string("rgba").find(letter));
        if (channel >= image.channels) {
            throw Error("texture build: " + map.path.string() + " has " +
                            std::to_string(image.channels) + " channels, '" + letter +
                            "' is not one of them",
                        "Choose a channel that is there.");
        }
        preset.channels.push_back(std::string("map.") + letter);
    }
    if (preset.channels.size() == 1) {
        return texproc::channel_of(image,
                                   static_cast<int>(std::string("rgba").find(map.channels[0])));
    }
    return texproc::pack(preset, {{"map", image}}, bits_of(image), 1);
}

void check_numbers(const RawImage& image, const InputMap& map)
{
    if (image.type != PixelType::F16 && image.type != PixelType::F32) return;
    for (const float v : texproc::to_image(image, ColorSpace::Data).pixels) {
        if (std::isfinite(v)) continue;
        throw Error("texture build: " + map.path.string() + " holds values that are not numbers",
                    "Repair the NaN or infinite pixels first.");
    }
}

// Turns green in place: codes are subtracted from the largest, which is exact.
void turn_green(RawImage& normal)
{
    texproc::PackPreset turned{"turned", "", {"n.r", "1 - n.g", "n.b"}, {}};
    normal = texproc::pack(turned, {{"n", normal}}, bits_of(normal));
}

// These blocks hold numbers between 8-bit codes.
bool between_codes(const OutputRule& rule)
{
    return rule.compression == "bc4" || rule.compression == "bc5";
}

Image with_alpha(const Image& color, const Image& alpha)
{
    Image to(color.width, color.height, 4, color.space);
    for (std::size_t i = 0; i < alpha.pixels.size(); ++i) {
        std::copy_n(&color.pixels[3 * i], 3, &to.pixels[4 * i]);
        to.pixels[4 * i + 3] = alpha.pixels[i];
    }
    return to;
}

// What with_alpha() joined: the colour (from channel 0) or the alpha (3).
Image part_of(const Image& joined, int first)
{
    const int channels = first == 0 ? 3 : 1;
    Image to(joined.width, joined.height, channels, first == 0 ? joined.space : ColorSpace::Data);
    const std::size_t step = static_cast<std::size_t>(channels);
    for (std::size_t i = 0; 4 * i < joined.pixels.size(); ++i) {
        std::copy_n(&joined.pixels[4 * i + static_cast<std::size_t>(first)], step,
                    &to.pixels[step * i]);
    }
    return to;
}

std::string percent(double share)
{
    return std::to_string(std::lround(100.0 * share)) + " %";
}

// Everything that the outputs of one material draw from.
class Maps {
public:
    Maps(const PlannedMaterial& plan, int threads)
        : plan_(plan), recipe_(*plan.recipe), threads_(threads)
    {
        read();
        orient_normal();
        bake();
        prefilter();
    }

    const std::map<std::string, RawImage>& base() const { return base_; }
    const std::string& green() const { return green_; }
    std::vector<MadeSource> sources() const { return sources_; }
    /// For TextureWriteOptions::texel_weights of an output whose first level is `first`:
    /// prefiltered normals alone in BC5; empty for others.
    std::vector<Image> texel_weights(const PlannedOutput& output, std::size_t first) const;

    /// The lobe error of what engines read from the outputs.
    std::optional<texproc::Score> lobe_error(const std::vector<MadeOutput>& made,
                                             const std::filesystem::path& folder) const;

    /// All levels of one role in the numbers of a file, from `first` to `last`.
    std::vector<RawImage> levels(const std::string& role, const PlannedOutput& output,
                                 PixelType type, std::size_t first, std::size_t last) const;

    /// Throws Error that names two files of different sizes among the maps of an output.
    void check_sizes(const PlannedOutput& output) const;

private:
    void read();
    void orient_normal();
    void bake();
    void prefilter();
    const RawImage* find(const std::string& role) const
    {
        const auto at = base_.find(role);
        return at == base_.end() ? nullptr : &at->second;
    }
    Image data(const std::string& role) const
    {
        return texproc::to_image(base_.at(role), ColorSpace::Data);
    }
    std::string file_of(const std::string& role) const
    {
        const auto at = plan_.files.inputs.find(role);
        return at == plan_.files.inputs.end() ? "the baked " + role : at->second.path.string();
    }
    bool wanted(const std::string& role) const;
    bool has_cutout() const;
    std::vector<Image> plain_chain(const std::string& role, ColorSpace space) const;

    const PlannedMaterial& plan_;
    const Recipe& recipe_;
    int threads_;
    std::map<std::string, RawImage> base_;  // level 0
    std::vector<MadeSource> sources_;
    std::string green_;
    texproc::Prefiltered chains_;  // levels 1.. of normal and of roughness or smoothness
    std::string rough_role_;       // "roughness" or "smoothness" where there is a chain
    texproc::PrefilterOptions filtering_;
    bool scored_ = false;
    int bits_ = 8;
};

// Whether an output, a baked map or the prefilter looks at this input.
bool Maps::wanted(const std::string& role) const
{
    const auto baked = [&](const char* name) {
        return std::find(plan_.baked.begin(), plan_.baked.end(), name) != plan_.baked.end();
    };
    for (const PlannedOutput& output : plan_.outputs) {
        if (std::find(output.roles.begin(), output.roles.end(), role) != output.roles.end())
            return true;
        if (output.prefiltered && (role == "normal" || role == "roughness" || role == "smoothness"))
            return true;
    }
    if (role == "roughness" || role == "smoothness" || role == "metallic") return baked("porosity");
    if (role == "normal") return baked("height");
    if (role == "height") {
        return baked("puddle") || baked("crack") || baked("cavity") || baked("occlusion") ||
               baked("normal");
    }
    return false;
}

void Maps::read()
{
    std::vector<std::string> names;  // a packed file is read once
    for (const auto& [role, map] : plan_.files.inputs) {
        const std::string name = map.path.string();
        if (wanted(role) && std::find(names.begin(), names.end(), name) == names.end())
            names.push_back(name);
    }
    const std::vector<RawImage> images = read_maps(names, {}, threads_);
    for (const auto& [role, map] : plan_.files.inputs) {
        if (!wanted(role)) continue;
        const auto at = std::find(names.begin(), names.end(), map.path.string());
        const RawImage& whole = images[static_cast<std::size_t>(at - names.begin())];
        sources_.push_back({role, whole.width, whole.height, whole.channels,
                            static_cast<int>(8 * texproc::size_of(whole.type))});
        RawImage& image = base_[role] = channels_of(whole, map);
        if (is_color(role) && image.channels < 3) image = widened(image);
        check_numbers(image, map);
    }
}

void Maps::orient_normal()
{
    const auto at = base_.find("normal");
    if (at == base_.end()) return;
    RawImage& normal = at->second;
    const texproc::NormalLayout layout = texproc::normal_layout(recipe_.layout);
    if (layout != texproc::NormalLayout::Rgb) {
        normal = texproc::to_raw(
            texproc::from_layout(texproc::to_image(normal, ColorSpace::Data), layout),
            normal.type == PixelType::U8 ? PixelType::U16 : normal.type);
    }
    if (normal.channels < 3) {
        throw Error("texture build: the normal map " + file_of("normal") + " has " +
                        std::to_string(normal.channels) + " channels, 3 are needed",
                    "Give a three-channel normal map, or name its layout in [normal].");
    }
    Green green = recipe_.green == Green::Auto ? plan_.files.green : recipe_.green;
    green_ = green == Green::Down ? "down, turned" : "up";
    if (green == Green::Auto) {
        const RawImage* height = find("height");
        const bool same =
            height && height->width == normal.width && height->height == normal.height;
        Image rgb = texproc::to_image(normal, ColorSpace::Data);
        if (rgb.channels > 3) {
            rgb = texproc::from_layout(rgb, texproc::NormalLayout::Rgb);
        }
        const texproc::GreenDirection found =
            same ? texproc::detect_green(rgb, data("height")) : texproc::detect_green(rgb);
        // A map that says little is left as it is: up is what most tools write.
        const bool down = found.down && found.confidence > 0.25;
        green = down ? Green::Down : Green::Up;
        green_ = std::string(down ? "down, turned" : "up") + ", found from the map (" +
                 percent(found.confidence) + " " + (found.down ? "down" : "up") + ")";
    }
    if (green == Green::Down) turn_green(normal);
}

void Maps::bake()
{
    const auto missing = [&](const char* role) {
        return std::find(plan_.baked.begin(), plan_.baked.end(), role) != plan_.baked.end();
    };
    const auto put = [&](const char* role, const Image& image) {
        base_[role] = texproc::to_raw(image, PixelType::U16);
    };
    texproc::BakeOptions options = recipe_.baking;
    options.threads = threads_;
    if (missing("height")) {
        Image normal = data("normal");
        if (normal.channels > 3) normal = texproc::from_layout(normal, texproc::NormalLayout::Rgb);
        put("height", texproc::height_from_normal(normal).height);
    }
    if (missing("normal"))
        put("normal", texproc::normal_from_height(data("height"), {.depth = options.depth}));
    if (missing("occlusion")) put("occlusion", texproc::ambient_occlusion(data("height"), options));
    if (missing("cavity")) put("cavity", texproc::cavity(data("height"), options));
    if (missing("puddle")) put("puddle", texproc::puddles(data("height"), options).depth);
    if (missing("crack")) put("crack", texproc::cracks(data("height"), options).depth);
    if (missing("porosity")) {
        Image rough = find("roughness") ? data("roughness") : data("smoothness");
        if (!find("roughness")) {
            for (float& v : rough.pixels) v = 1.0f - v;
        }
        put("porosity", texproc::porosity(rough, find("metallic") ? data("metallic") : Image()));
    }
}

void Maps::prefilter()
{
    bool needed = false, joint = false, all_eight = true;
    int bits = 0;
    for (const PlannedOutput& output : plan_.outputs) {
        needed = needed || output.prefiltered;
        if (!output.prefiltered) continue;
        // Re-aimed normals are of use only where they are written with the roughness.
        joint = joint || std::count(output.roles.begin(), output.roles.end(), "normal") > 0;
        bits = std::max(bits, output.rule.bits);
        all_eight = all_eight && output.rule.bits == 8 && !between_codes(output.rule);
    }
    if (!needed) return;
    const std::string role = find("roughness") ? "roughness" : "smoothness";
    const RawImage& normal = base_.at("normal");
    const RawImage& rough = base_.at(role);
    if (normal.width != rough.width || normal.height != rough.height) {
        throw Error("texture build: " + file_of("normal") + " is " + std::to_string(normal.width) +
                        " x " + std::to_string(normal.height) + ", " + file_of(role) + " is " +
                        std::to_string(rough.width) + " x " + std::to_string(rough.height),
                    "Resample one of them: both must have the same size.");
    }
    texproc::PrefilterOptions options;
    options.rule = recipe_.rule;
    options.smoothness = role == "smoothness";
    options.design_light = recipe_.design_light;
    options.quick = recipe_.quick;
    options.joint = joint;
    options.bits = all_eight ? 8 : 0;  // codes chosen for the files that ship
    options.wrap_u = recipe_.mips.wrap_u;
    options.wrap_v = recipe_.mips.wrap_v;
    options.threads = threads_;
    chains_ = texproc::prefilter_raw(normal, rough, options);
    rough_role_ = role;
    filtering_ = options;
    scored_ = recipe_.score;
    bits_ = std::min(bits, 16);
}

std::optional<texproc::Score> Maps::lobe_error(const std::vector<MadeOutput>& made,
                                               const std::filesystem::path& folder) const
{
    if (!scored_) return {};
    const RawImage &normal = base_.at("normal"), &rough = base_.at(rough_role_);
    const auto has = [&](const std::string& role) { return find(role) != nullptr; };
    // The first outputs that hold them speak for all.
    const auto shipped = [&](const std::string& role, int channels) {
        for (std::size_t i = 0; i < made.size(); ++i) {
            const PlannedOutput& output = plan_.outputs[i];
            if (!output.prefiltered) continue;
            std::vector<Image> levels =
                shipped_levels(folder, output, made[i], role, channels, normal.width, has);
            if (levels.size() > 1) return levels;
        }
        return std::vector<Image>();
    };
    texproc::Prefiltered read{shipped("normal", 3), shipped(rough_role_, 1), {}};
    if (read.roughness.empty()) {  // files that are not read back: as their numbers are rounded
        read = chains_;
        texproc::quantize(read, bits_);
    }
    if (!filtering_.joint) read.normal.clear();
    return texproc::score(normal, rough, read, filtering_,
                          {.light = recipe_.design_light, .texels = 16, .threads = threads_});
}

std::vector<Image> Maps::texel_weights(const PlannedOutput& output, std::size_t first) const
{
    const bool normals = output.prefiltered && output.rule.compression == "bc5" &&
                         output.roles == std::vector<std::string>{"normal"};
    if (!normals || recipe_.rule != "overlap") return {};
    std::vector<Image> weights = texproc::lobe_weights(chains_, filtering_).normal;
    weights.erase(weights.begin(), weights.begin() + static_cast<std::ptrdiff_t>(first));
    return weights;
}

void Maps::check_sizes(const PlannedOutput& output) const
{
    const std::string& first = output.roles.front();
    for (const std::string& role : output.roles) {
        const RawImage &a = base_.at(first), &b = base_.at(role);
        if (a.width == b.width && a.height == b.height) continue;
        throw Error(
            "texture build: " + output.file() + " needs maps of one size: " + file_of(first) +
                " is " + std::to_string(a.width) + " x " + std::to_string(a.height) + ", " +
                file_of(role) + " is " + std::to_string(b.width) + " x " + std::to_string(b.height),
            "Resample one of them.");
    }
}

std::vector<RawImage> Maps::levels(const std::string& role, const PlannedOutput& output,
                                   PixelType type, std::size_t first, std::size_t last) const
{
    const RawImage& raw = base_.at(role);
    const bool color = is_color(role) && output.rule.srgb();
    const ColorSpace space = color ? ColorSpace::Linear : ColorSpace::Data;
    const bool integers = raw.type == PixelType::U8 || raw.type == PixelType::U16;
    const auto coded = [&](const Image& image) { return texproc::to_raw(image, type); };
    std::vector<RawImage> levels;
    if (first == 0) {
        // Codes stay codes; only floats, and colour on its way to floats, are computed.
        const bool keep = integers && (type != PixelType::F32 || !color);
        levels.push_back(keep ? raw : coded(texproc::to_image(raw, space)));
    }
    if (last == 0) return levels;
    const bool rough = role == rough_role_, normal = role == "normal" && !rough_role_.empty();
    if (output.prefiltered && (rough || normal)) {
        for (std::size_t k = std::max<std::size_t>(first, 1); k <= last; ++k) {
            levels.push_back(coded((rough ? chains_.roughness : chains_.normal)[k]));
        }
        return levels;
    }
    const std::vector<Image> chain = plain_chain(role, space);
    for (std::size_t k = std::max<std::size_t>(first, 1); k <= last; ++k)
        levels.push_back(coded(chain[k]));
    return levels;
}

// Colour and an opacity map of its own are filtered as the one image that they are.
bool Maps::has_cutout() const
{
    const RawImage *albedo = find("albedo"), *opacity = find("opacity");
    return albedo && opacity && albedo->channels == 3 && opacity->channels == 1 &&
           albedo->width == opacity->width && albedo->height == opacity->height;
}

std::vector<Image> Maps::plain_chain(const std::string& role, ColorSpace space) const
{
    texproc::MipOptions options = recipe_.mips;
    options.normals = role == "normal";
    options.threads = threads_;
    if (has_cutout() && (role == "opacity" || (role == "albedo" && space == ColorSpace::Linear))) {
        const Image joined =
            with_alpha(texproc::to_image(base_.at("albedo"), ColorSpace::Linear), data("opacity"));
        std::vector<Image> chain = texproc::mip_chain(joined, options);
        for (Image& level : chain) level = part_of(level, role == "opacity" ? 3 : 0);
        return chain;
    }
    const RawImage& raw = base_.at(role);
    if (raw.channels != 4 || role != "albedo") options.alpha_cutoff = -1.0f;
    return texproc::mip_chain(texproc::to_image(raw, space), options);
}

// The level to start with: the largest whose sides are at most `size`.
std::size_t first_level(const std::vector<texproc::LevelSize>& sizes, int size)
{
    std::size_t k = 0;
    while (size > 0 && k + 1 < sizes.size() && std::max(sizes[k].width, sizes[k].height) > size)
        ++k;
    return k;
}

PixelType working_type(const OutputRule& rule)
{
    if (rule.format == "exr") return PixelType::F32;
    return rule.bits == 16 || between_codes(rule) ? PixelType::U16 : PixelType::U8;
}

MadeOutput make_output(const Maps& maps, const PlannedOutput& output,
                       const std::filesystem::path& folder, int threads)
{
    maps.check_sizes(output);
    const RawImage& like = maps.base().at(output.roles.front());
    const std::vector<texproc::LevelSize> sizes = texproc::level_sizes(like.width, like.height);
    const std::size_t first = first_level(sizes, output.rule.size);
    const std::size_t last = output.rule.has_levels() ? sizes.size() - 1 : first;
    const PixelType type = working_type(output.rule);
    std::map<std::string, std::vector<RawImage>> by_role;
    for (const std::string& role : output.roles) {
        by_role[role] = maps.levels(role, output, type, first, last);
    }
    const int bits = type == PixelType::F32 ? 32 : type == PixelType::U16 ? 16 : 8;
    std::vector<RawImage> packed;
    for (std::size_t k = 0; k <= last - first; ++k) {
        std::map<std::string, RawImage> level;
        for (auto& [role, images] : by_role) level.emplace(role, std::move(images[k]));
        packed.push_back(texproc::pack(output.rule.channels, level, bits, threads));
    }
    MadeOutput made;
    made.width = packed.front().width;
    made.height = packed.front().height;
    made.levels = static_cast<int>(packed.size());
    made.files = write_levels(folder, output.stem, output.rule, std::move(packed),
                              maps.texel_weights(output, first), threads);
    return made;
}

}  // namespace

MadeMaterial make_material(const PlannedMaterial& material, const std::filesystem::path& folder,
                           int threads)
{
    const Maps maps(material, threads);
    MadeMaterial made;
    made.sources = maps.sources();
    made.green = maps.green();
    for (const PlannedOutput& output : material.outputs) {
        made.outputs.push_back(make_output(maps, output, folder, threads));
    }
    made.lobe_error = maps.lobe_error(made.outputs, folder);
    return made;
}

}  // namespace petrichor::cli
