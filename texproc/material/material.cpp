#include "texproc/material/material.h"

#include <algorithm>
#include <map>
#include <utility>

#include "base/error.h"
#include "texproc/filter/area.h"
#include "texproc/filter/mips.h"
#include "texproc/material/base_share.h"
#include "texproc/material/import_settings.h"
#include "texproc/material/normal_channels.h"
#include "texproc/material/prefiltered_maps.h"
#include "texproc/material/write_levels.h"

namespace petrichor::texproc {

namespace {

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

// Colour and an opacity map of its own are filtered as the one image that they are.
bool has_cutout(const SourceMaps& maps)
{
    const RawImage *albedo = maps.find("albedo"), *opacity = maps.find("opacity");
    return albedo && opacity && albedo->channels == 3 && opacity->channels == 1 &&
           albedo->width == opacity->width && albedo->height == opacity->height;
}

// The level to start with: the largest whose sides are at most `size`.
std::size_t first_level(const std::vector<LevelSize>& sizes, int size)
{
    std::size_t k = 0;
    while (size > 0 && k + 1 < sizes.size() && std::max(sizes[k].width, sizes[k].height) > size)
        ++k;
    return k;
}

PixelType working_type(const OutputRule& rule)
{
    if (rule.format == "exr") return PixelType::F32;
    // BC4 and BC5 hold numbers between 8-bit codes.
    const bool fine = rule.compression == "bc4" || rule.compression == "bc5";
    return rule.bits == 16 || fine ? PixelType::U16 : PixelType::U8;
}

// Readers make z from x and y.
bool leaves_out_z(const OutputRule& rule)
{
    for (const std::string& text : rule.channels.channels) {
        for (const PackSource& source : parse_pack_channel(text)) {
            if (source.role == "normal" && source.channel == 2) return false;
        }
    }
    return true;
}

// Makes the outputs of one material, one after the other.
class Maker {
public:
    Maker(const PlannedMaterial& plan, const std::filesystem::path& folder, int threads)
        : plan_(plan),
          folder_(folder),
          threads_(threads),
          maps_(read_source_maps(plan, threads)),
          prefiltered_(plan, maps_, threads)
    {
        if (prefiltered_.has_second_lobe()) maps_.images[kSecondLobe] = prefiltered_.second_lobe_of_maps();
    }

    MadeMaterial make()
    {
        MadeMaterial made{maps_.sources, {}, maps_.green, {}, {}, maps_.notes};
        made.outputs.resize(plan_.outputs.size());
        for (const std::size_t number : prefiltered_.order()) {
            prefiltered_.aim(number, made.outputs, folder_);
            made.outputs[number] = make_output(number);
            prefiltered_.guard(number, made.outputs, folder_, [&] { return make_output(number); });
        }
        if (const auto shipped = prefiltered_.shipped(made.outputs, folder_)) {
            made.lobe_error = prefiltered_.lobe_error(*shipped);
            made.picture_error = prefiltered_.picture_error(*shipped, made.outputs);
        }
        return made;
    }

private:
    MadeOutput make_output(std::size_t number) const;
    std::vector<RawImage> levels(std::size_t number, const std::string& role, std::size_t first,
                                 std::size_t last) const;
    std::vector<Image> levels_without_prefilter(const std::string& role, ColorSpace space) const;
    void darken_small_levels(std::vector<Image>& albedo) const;

    const PlannedMaterial& plan_;
    const std::filesystem::path& folder_;
    int threads_;
    SourceMaps maps_;
    PrefilteredMaps prefiltered_;
};

MadeOutput Maker::make_output(std::size_t number) const
{
    const PlannedOutput& output = plan_.outputs[number];
    const RawImage& like = maps_.images.at(output.roles.front());
    const std::vector<LevelSize> sizes = level_sizes(like.width, like.height);
    const std::size_t first = first_level(sizes, output.rule.size);
    const std::size_t last = output.rule.has_levels() ? sizes.size() - 1 : first;
    std::map<std::string, std::vector<RawImage>> by_role;
    for (const std::string& role : output.roles) {
        by_role[role] = levels(number, role, first, last);
    }
    const PixelType type = working_type(output.rule);
    const int bits = type == PixelType::F32 ? 32 : type == PixelType::U16 ? 16 : 8;
    std::vector<RawImage> packed;
    for (std::size_t k = 0; k <= last - first; ++k) {
        std::map<std::string, RawImage> level;
        for (auto& [role, images] : by_role) level.emplace(role, std::move(images[k]));
        packed.push_back(pack(output.rule.channels, level, bits, threads_));
    }
    MadeOutput made;
    made.width = packed.front().width;
    made.height = packed.front().height;
    made.levels = static_cast<int>(packed.size());
    made.files = write_levels(folder_, output.stem, output.rule, std::move(packed),
                              prefiltered_.texel_weights(number, first), threads_);
    made.settings = write_import_settings(folder_, output, made.files, plan_.recipe->mips);
    return made;
}

// Levels `first` to `last` of one role in the numbers of the file.
std::vector<RawImage> Maker::levels(std::size_t number, const std::string& role, std::size_t first,
                                    std::size_t last) const
{
    const OutputRule& rule = plan_.outputs[number].rule;
    const RawImage* rounded = prefiltered_.level0(number, role);
    const RawImage& raw = rounded ? *rounded : maps_.images.at(role);
    const PixelType type = working_type(rule);
    const bool color = is_color(role) && rule.srgb();
    const ColorSpace space = color ? ColorSpace::Linear : ColorSpace::Data;
    const bool integers = raw.type == PixelType::U8 || raw.type == PixelType::U16;
    std::vector<RawImage> levels;
    if (first == 0) {
        // Codes stay codes; only floats, colour on its way to floats, and normals on their way to
        // two channels are computed.
        const bool keep = integers && (type != PixelType::F32 || !color);
        levels.push_back(role == "normal" && leaves_out_z(rule) ? unit_normals(raw, type)
                         : keep                                 ? raw
                                : to_raw(to_image(raw, space), type));
    }
    if (last == 0) return levels;
    std::vector<Image> plain;
    const std::vector<Image>* chain = prefiltered_.levels(number, role);
    if (!chain) {
        plain = levels_without_prefilter(role, space);
        if (role == "albedo") darken_small_levels(plain);
        chain = &plain;
    }
    // No code of 8 bits is straight up; of several texels the mean is, where they are dithered. (Blocks have errors
    // of their own, and codes that were chosen with the roughness stay.)
    const bool dither = role == "normal" && type == PixelType::U8 && rule.compression == "none";
    for (std::size_t k = std::max<std::size_t>(first, 1); k <= last; ++k)
        levels.push_back(to_raw((*chain)[k], type, dither ? Rounding::Ordered : Rounding::Nearest));
    return levels;
}

// Where the slopes of the normal map face away.
void Maker::darken_small_levels(std::vector<Image>& albedo) const
{
    if (prefiltered_.base_share().empty()) return;
    std::vector<Image> metallic;
    if (const RawImage* map = maps_.find("metallic")) {
        if (map->channels == 1) metallic = levels_without_prefilter("metallic", ColorSpace::Data);
    }
    apply_base_shares(albedo, prefiltered_.base_share(), metallic, prefiltered_.metal_share());
}

std::vector<Image> Maker::levels_without_prefilter(const std::string& role, ColorSpace space) const
{
    MipOptions options = plan_.recipe->mips;
    options.threads = threads_;
    if (has_cutout(maps_) &&
        (role == "opacity" || (role == "albedo" && space == ColorSpace::Linear))) {
        const Image joined = with_alpha(to_image(maps_.images.at("albedo"), ColorSpace::Linear),
                                        maps_.data("opacity"));
        std::vector<Image> chain = plain_levels(joined, "albedo", options);
        for (Image& level : chain) level = part_of(level, role == "opacity" ? 3 : 0);
        return chain;
    }
    return plain_levels(to_image(maps_.images.at(role), space), role, options);
}

}  // namespace

MadeMaterial make_material(const PlannedMaterial& material, const std::filesystem::path& folder,
                           int threads)
{
    return Maker(material, folder, threads).make();
}

}  // namespace petrichor::texproc
