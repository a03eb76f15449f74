#include "texproc/gltf/image_levels.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/parallel.h"
#include "texproc/filter/area.h"
#include "texproc/filter/resample.h"
#include "texproc/material/base_share.h"
#include "texproc/material/surface_class.h"

namespace petrichor::texproc {

namespace {

std::string name_of_image(const GltfFile& file, std::size_t image)
{
    return file.path.string() + ", image " + std::to_string(image);
}

const JsonText& image_json(const GltfFile& file, std::size_t image)
{
    return file.json.find("images")->at(image);
}

Image with_channels(const Image& image, int channels)
{
    if (image.channels == channels) return image;
    Image to(image.width, image.height, channels, image.space);
    const bool grey = image.channels < 3;
    const std::size_t from_step = static_cast<std::size_t>(image.channels);
    const std::size_t to_step = static_cast<std::size_t>(channels);
    for (std::size_t p = 0; p * from_step < image.pixels.size(); ++p) {
        const float* from = &image.pixels[p * from_step];
        for (std::size_t c = 0; c < to_step; ++c) {
            float value = 1.0f;
            if (c < 3) {
                value = from[grey ? 0 : c];
            } else if (grey ? from_step == 2 : from_step > 3) {
                value = from[grey ? 1 : 3];
            }
            to.pixels[p * to_step + c] = value;
        }
    }
    return to;
}

// A side that blocks fill: the next smaller multiple of four; the smallest sides are repeated.
int whole_blocks(int side)
{
    if (side >= 4) return side / 4 * 4;
    return side == 3 ? 12 : 4;
}

Image repeated(const Image& image, int times_x, int times_y)
{
    Image to(image.width * times_x, image.height * times_y, image.channels, image.space);
    for (int y = 0; y < to.height; ++y) {
        for (int x = 0; x < to.width; ++x) {
            for (int c = 0; c < to.channels; ++c)
                to.at(x, y, c) = image.at(x / times_x, y / times_y, c);
        }
    }
    return to;
}

Image in_whole_blocks(Image image, int threads)
{
    const int width = whole_blocks(image.width), height = whole_blocks(image.height);
    const int times_x = width > image.width ? width / image.width : 1;
    const int times_y = height > image.height ? height / image.height : 1;
    if (times_x > 1 || times_y > 1) image = repeated(image, times_x, times_y);
    if (image.width == width && image.height == height) return image;
    return area_reduced(image, width, height, threads);
}

// x and y times a scale, then of unit length, as glTF defines it.
Image scaled_normals(Image normals, float scale)
{
    for (std::size_t i = 0; i < normals.pixels.size(); i += 3) {
        float n[3];
        for (std::size_t c = 0; c < 3; ++c) n[c] = 2.0f * normals.pixels[i + c] - 1.0f;
        n[0] *= scale;
        n[1] *= scale;
        const float length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        if (!(length > 0.0f)) continue;
        for (std::size_t c = 0; c < 3; ++c) normals.pixels[i + c] = 0.5f + 0.5f * n[c] / length;
    }
    return normals;
}

Image channel_of(const Image& image, std::size_t channel)
{
    Image to(image.width, image.height, 1, ColorSpace::Data);
    const std::size_t step = static_cast<std::size_t>(image.channels);
    for (std::size_t i = 0; i < to.pixels.size(); ++i)
        to.pixels[i] = image.pixels[step * i + channel];
    return to;
}

// How often the sides of a surface go into those of its normals, as a number of levels; 0: not so.
int levels_between(const Image& normals, const Image& surface)
{
    for (int k = 1; k < 6; ++k) {
        if (normals.width == surface.width << k && normals.height == surface.height << k) return k;
    }
    return 0;
}

}  // namespace

// A surface with the normals that belong to it, in one size, before any filter.
struct ImageMaker::Pair {
    Image normals;    // scaled
    Image roughness;  // one channel, times its factor
    int skipped = 0;  // levels that the surface does not have
    SurfaceClass is = SurfaceClass::Both;
};

struct ImageMaker::Chains {
    RawImage normals, roughness;
    int bits = -1;
    SurfaceClass is = SurfaceClass::Both;
    Prefiltered made;
};

std::vector<std::byte> image_bytes(const GltfFile& file, std::size_t image)
{
    const JsonText& json = image_json(file, image);
    if (const JsonText* uri = json.find("uri"))
        return resource_bytes(file, uri->as_string().value_or(""));
    const JsonText* view = json.find("bufferView");
    if (!view || !view->as_index()) {
        throw Error("glTF " + name_of_image(file, image) + ": has neither uri nor bufferView",
                    "Export the scene again.");
    }
    return view_bytes(file, *view->as_index());
}

ImageMaker::ImageMaker(const GltfFile& file, const ImagePlan& plan, ImageMakingOptions options)
    : file_(file), plan_(plan), options_(std::move(options)), last_(new Chains[2])
{
}
ImageMaker::~ImageMaker() = default;

Image ImageMaker::decode(std::size_t image, ColorSpace space, int channels) const
{
    const Image decoded = decode_image(image_bytes(file_, image), name_of_image(file_, image),
                                       {.space = space, .max_side = options_.size});
    const int count = channels ? channels : decoded.channels % 2 ? 3 : 4;
    return in_whole_blocks(with_channels(decoded, count), options_.threads);
}

bool ImageMaker::is_resampled(std::size_t recipe) const
{
    const std::size_t image = plan_.recipes[recipe].image;
    const RawImage shape = image_shape(image_bytes(file_, image), name_of_image(file_, image),
                                       {.max_side = options_.size});
    return whole_blocks(shape.width) != shape.width || whole_blocks(shape.height) != shape.height;
}

MipOptions ImageMaker::mip_options(const ImageRecipe& recipe) const
{
    return {.wrap_u = recipe.edge_u == Edge::Wrap,
            .wrap_v = recipe.edge_v == Edge::Wrap,
            .alpha_cutoff = recipe.alpha_cutoff,
            .mirror_u = recipe.edge_u == Edge::Mirror,
            .mirror_v = recipe.edge_v == Edge::Mirror,
            .alpha_weighted = recipe.alpha_covers,
            .threads = options_.threads};
}

std::vector<Image> ImageMaker::color_levels(const ImageRecipe& recipe) const
{
    const MipOptions mips = mip_options(recipe);
    std::vector<Image> levels =
        plain_levels(decode(recipe.image, ColorSpace::Linear, 0), "albedo", mips);
    if (recipe.normal < 0 || options_.prefilter.rule != "picture") return levels;
    const Image normals = scaled_normals(
        decode(static_cast<std::size_t>(recipe.normal), ColorSpace::Data, 3), recipe.normal_scale);
    std::vector<Image> metallic;
    if (recipe.surface >= 0) {
        Image metal = channel_of(
            resized(decode(static_cast<std::size_t>(recipe.surface), ColorSpace::Data, 3),
                    levels[0].width, levels[0].height, options_.threads),
            2);
        for (float& value : metal.pixels) value *= recipe.metallic_factor;
        metallic = plain_levels(metal, "scalar", mips);
    } else if (recipe.metallic_factor > 0.0f) {
        for (const Image& level : levels)
            metallic.emplace_back(level.width, level.height, 1, ColorSpace::Data,
                                  recipe.metallic_factor);
    }
    apply_base_shares(levels, pixel_base_shares(normals, options_.threads), metallic);
    return levels;
}

namespace {

// The surface and its normals brought to one size: that of the normals where they are finer by
// whole levels, so that what the surface cannot show of them counts too.
template <class Pair>
Pair to_pair(Image normals, const Image& surface, const ImageRecipe& recipe, const ImageMakingOptions& options)
{
    const int threads = options.threads;
    Pair pair;
    pair.roughness = channel_of(surface, 1);
    for (float& value : pair.roughness.pixels) value *= recipe.roughness_factor;
    if (fits_by_class(options.prefilter)) {
        Image metallic = channel_of(surface, 2);
        for (float& value : metallic.pixels) value *= recipe.metallic_factor;
        pair.is = surface_class(metallic);
    }
    pair.skipped = levels_between(normals, surface);
    if (pair.skipped) {
        pair.roughness = resized(pair.roughness, normals.width, normals.height, threads);
    } else {
        normals = resized(normals, surface.width, surface.height, threads);
    }
    pair.normals = scaled_normals(std::move(normals), recipe.normal_scale);
    return pair;
}

PrefilterOptions pair_options(const ImageMakingOptions& options, const ImageRecipe& recipe, SurfaceClass is)
{
    PrefilterOptions to = prefilter_options(options.prefilter,
                                            {.joint = true, .bits = 8, .threads = options.threads});
    to.rebuild_z = true;
    to.lobes = recipe.lobes;
    to.surface = is;
    to.base_colors = false;  // the base colour of a scene is made without the roughness
    if (recipe.normal_scale != 1.0f) to.bits = 0;  // the codes would be those of other normals
    return to;
}

}  // namespace

const Prefiltered& ImageMaker::chains(const ImageRecipe& recipe, const Pair& pair) const
{
    Chains& last = last_[recipe.lobes == 2 ? 1 : 0];
    RawImage normals = to_raw(pair.normals, PixelType::U16), roughness = to_raw(pair.roughness, PixelType::U16);
    const PrefilterOptions options = pair_options(options_, recipe, pair.is);
    if (last.bits == options.bits && last.is == pair.is && last.normals.width == normals.width && last.normals.height == normals.height &&
        last.normals.bytes == normals.bytes && last.roughness.bytes == roughness.bytes)
        return last.made;
    last.made = {};
    last.made = prefilter_raw(normals, roughness, options);
    last.normals = std::move(normals);
    last.roughness = std::move(roughness);
    last.bits = options.bits;
    last.is = pair.is;
    return last.made;
}

// A surface; of two lobes in the size of its normals, since all three images are fitted together.
Image ImageMaker::surface_of(const ImageRecipe& recipe) const
{
    Image surface = decode(recipe.image, ColorSpace::Data, 3);
    if (recipe.lobes != 2) return surface;
    const Image normals = decode(static_cast<std::size_t>(recipe.normal), ColorSpace::Data, 3);
    return resized(surface, normals.width, normals.height, options_.threads);
}

std::vector<Image> ImageMaker::surface_levels(const ImageRecipe& recipe, bool plain) const
{
    Image surface = surface_of(recipe);
    const float factor = recipe.roughness_factor;
    std::vector<Image> levels = plain_levels(surface, "surface", mip_options(recipe));
    const float stored = options_.bake_roughness ? 1.0f : factor;
    const auto put = [&](Image& level, const Image& rough) {
        for (std::size_t i = 0; i < rough.pixels.size(); ++i)
            level.pixels[3 * i + 1] = std::min(rough.pixels[i] / stored, 1.0f);
    };
    for (Image& level : levels) {
        Image rough = channel_of(level, 1);
        for (float& value : rough.pixels) value *= factor;
        put(level, rough);
    }
    if (plain || recipe.normal < 0 || options_.prefilter.rule == "none") return levels;
    const Pair pair =
        to_pair<Pair>(decode(static_cast<std::size_t>(recipe.normal), ColorSpace::Data, 3), surface, recipe, options_);
    const Prefiltered& made = chains(recipe, pair);
    const std::size_t skipped = static_cast<std::size_t>(pair.skipped);
    for (std::size_t k = skipped ? 0 : 1; k < levels.size(); ++k)
        put(levels[k], made.roughness[k + skipped]);
    return levels;
}

std::vector<Image> ImageMaker::normal_levels(const ImageRecipe& recipe) const
{
    const Image normals = decode(recipe.image, ColorSpace::Data, 3);
    std::vector<Image> levels = plain_levels(normals, "normal", mip_options(recipe));
    // Only rules that re-aim normals need the roughness here.
    const PrefilterChoice& choice = options_.prefilter;
    const bool aims = choice.rule == "overlap" || choice.rule == "student-t" ||
                      (choice.rule == "picture" && !choice.quick);
    if (recipe.surface < 0 || !aims) return levels;
    const Image surface =
        resized(decode(static_cast<std::size_t>(recipe.surface), ColorSpace::Data, 3),
                normals.width, normals.height, options_.threads);
    const Pair pair = to_pair<Pair>(normals, surface, recipe, options_);
    const Prefiltered& made = chains(recipe, pair);
    for (std::size_t k = 1; k < levels.size(); ++k)
        levels[k] = scaled_normals(made.normal[k], 1.0f / recipe.normal_scale);
    return levels;
}

// plain: both lobes are the first one's normals with the roughness of plain mips.
std::vector<Image> ImageMaker::second_levels(const ImageRecipe& recipe, bool plain) const
{
    const Image normals = decode(recipe.image, ColorSpace::Data, 3);
    const Image surface = resized(decode(static_cast<std::size_t>(recipe.surface), ColorSpace::Data, 3),
                                  normals.width, normals.height, options_.threads);
    const Pair pair = to_pair<Pair>(normals, surface, recipe, options_);
    const Prefiltered& made = chains(recipe, pair);
    const std::vector<Image> plain_roughness = plain_levels(pair.roughness, "scalar", mip_options(recipe));
    const float stored = options_.bake_roughness ? 1.0f : recipe.roughness_factor;
    std::vector<Image> levels;
    for (std::size_t k = 0; k < plain_roughness.size(); ++k) {
        const bool two = k > 0 && !plain;
        const Image& roughness = two ? made.second.roughness[k] : plain_roughness[k];
        const Image normal =
            k == 0 ? normals
                   : scaled_normals(two ? made.second.normal[k] : made.normal[k], 1.0f / recipe.normal_scale);
        Image& level = levels.emplace_back(roughness.width, roughness.height, 4, ColorSpace::Data, 0.5f);
        for (std::size_t i = 0; i < roughness.pixels.size(); ++i) {
            std::copy_n(&normal.pixels[3 * i], 2, &level.pixels[4 * i]);
            level.pixels[4 * i + 2] = std::min(roughness.pixels[i] / stored, 1.0f);
            if (two) level.pixels[4 * i + 3] = made.second.share[k].pixels[i];
        }
    }
    return levels;
}

MipTexture ImageMaker::make(std::size_t number, bool plain) const
{
    const ImageRecipe& recipe = plan_.recipes[number];
    std::vector<Image> levels;
    switch (recipe.meaning) {
        case ImageMeaning::Color:
            levels = color_levels(recipe);
            break;
        case ImageMeaning::Surface:
            levels = surface_levels(recipe, plain);
            break;
        case ImageMeaning::Normal:
            levels = normal_levels(recipe);
            break;
        case ImageMeaning::SecondLobe:
            levels = second_levels(recipe, plain);
            break;
        case ImageMeaning::Data:
            levels = plain_levels(decode(recipe.image, ColorSpace::Data, 0), "scalar",
                                  mip_options(recipe));
            break;
    }
    std::vector<RawImage> raw;
    for (Image& level : levels) {
        raw.push_back(to_raw(level, PixelType::U8));
        level = {};
    }
    bool opaque = raw[0].channels < 4;
    if (!opaque) {
        opaque = true;
        for (std::size_t i = 3; i < raw[0].bytes.size(); i += 4)
            opaque = opaque && raw[0].bytes[i] == std::byte{255};
    }
    std::string format = options_.format;
    if (format == "uastc" && !opaque) format = "uastca";
    return make_texture(raw, {.format = format,
                              .srgb = recipe.meaning == ImageMeaning::Color,
                              .quality = options_.quality,
                              .repeat = options_.rdo.value_or(
                                  recipe.meaning == ImageMeaning::Normal || recipe.meaning == ImageMeaning::SecondLobe
                                      ? 0.0f
                                      : kRdo),
                              .repeat_most = options_.rdo_most,
                              .threads = options_.threads});
}

std::size_t PairPictures::level_of(int width, int height) const
{
    return static_cast<std::size_t>(
        std::find(sizes.begin(), sizes.end(), LevelSize{width, height}) - sizes.begin());
}

std::optional<PairPictures> ImageMaker::pictures(std::size_t number) const
{
    const ImageRecipe& recipe = plan_.recipes[number];
    if (recipe.normal < 0 || options_.prefilter.rule == "none") return {};
    const Image surface = surface_of(recipe);
    const Pair pair =
        to_pair<Pair>(decode(static_cast<std::size_t>(recipe.normal), ColorSpace::Data, 3), surface, recipe, options_);
    return PairPictures{
        {to_raw(pair.normals, PixelType::U16), to_raw(pair.roughness, PixelType::U16),
         pair_options(options_, recipe, pair.is), build_pictures(options_.threads, pair.is)},
        level_sizes(pair.normals.width, pair.normals.height),
        pixel_base_shares(pair.normals, options_.threads)};
}

// A second lobe as it was made; level 0 is that of the maps.
SecondLobe ImageMaker::second_as_read(const MipTexture& made, const PairPictures& pictures,
                                      const ImageRecipe& recipe, std::size_t count) const
{
    SecondLobe read;
    for (auto* part : {&read.normal, &read.roughness, &read.share}) part->resize(count);
    const float stored = options_.bake_roughness ? 1.0f : recipe.roughness_factor;
    for (std::size_t k = 1; k < made.levels.size(); ++k) {
        const Image codes = to_image(decode_level(made, static_cast<int>(k), options_.threads), ColorSpace::Data);
        const std::size_t at = pictures.level_of(codes.width, codes.height);
        if (at == count) continue;
        Image normal(codes.width, codes.height, 3, ColorSpace::Data);
        for (std::size_t i = 0; 4 * i < codes.pixels.size(); ++i) {
            const float x = 2.0f * codes.pixels[4 * i] - 1.0f, y = 2.0f * codes.pixels[4 * i + 1] - 1.0f;
            normal.pixels[3 * i] = codes.pixels[4 * i];
            normal.pixels[3 * i + 1] = codes.pixels[4 * i + 1];
            normal.pixels[3 * i + 2] = 0.5f + 0.5f * std::sqrt(std::max(1.0f - x * x - y * y, 0.0f));
        }
        read.normal[at] = scaled_normals(std::move(normal), recipe.normal_scale);
        read.roughness[at] = channel_of(codes, 2);
        for (float& value : read.roughness[at].pixels) value *= stored;
        read.share[at] = channel_of(codes, 3);
    }
    return read;
}

// Levels that one of the two images does not have are left to the maps.
Prefiltered ImageMaker::as_read(std::size_t number, const PairPictures& pictures,
                                const MipTexture& surface_made, const MipTexture& normals_made,
                                bool darkened, const MipTexture* second_made) const
{
    const ImageRecipe& recipe = plan_.recipes[number];
    Prefiltered read;
    read.normal.resize(pictures.sizes.size());
    read.roughness.resize(pictures.sizes.size());
    const auto fill = [&](const MipTexture& made, std::vector<Image>& to, bool normals) {
        for (std::size_t k = 0; k < made.levels.size(); ++k) {
            Image level =
                with_channels(to_image(decode_level(made, static_cast<int>(k), options_.threads),
                                       ColorSpace::Data),
                              3);
            const std::size_t at = pictures.level_of(level.width, level.height);
            if (at == to.size()) continue;
            if (normals) {
                to[at] = scaled_normals(std::move(level), recipe.normal_scale);
                continue;
            }
            to[at] = channel_of(level, 1);
            const float stored = options_.bake_roughness ? 1.0f : recipe.roughness_factor;
            for (float& value : to[at].pixels) value *= stored;
        }
    };
    fill(surface_made, read.roughness, false);
    fill(normals_made, read.normal, true);
    if (second_made) read.second = second_as_read(*second_made, pictures, recipe, read.normal.size());
    if (darkened) read.base_share = pictures.base_share;
    return read;
}

}  // namespace petrichor::texproc
