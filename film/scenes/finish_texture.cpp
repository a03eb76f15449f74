#include "film/scenes/finish_texture.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/error.h"
#include "texproc/codecs/files/io.h"
#include "texproc/image/raw_image.h"
#include "texproc/image/zero_rows.h"
#include "texproc/material/base_share.h"

namespace petrichor::film {
namespace {

using Kind = TextureRecipe::Kind;
using texproc::PixelType;
using texproc::RawImage;

constexpr float kRgbmRange = 8.0f;  // of colour times alpha in light maps of 8 bits

// The first `channels` channels; grey becomes red, green and blue alike, missing alpha is 1.
Image with_channels(const Image& image, int channels)
{
    if (image.channels == channels) return image;
    Image result(image.width, image.height, channels, image.space);
    const bool grey = image.channels <= 2;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            for (int c = 0; c < channels; ++c) {
                float value = 1.0f;
                if (c < 3) {
                    value = image.at(x, y, grey ? 0 : c);
                } else if (grey ? image.channels == 2 : image.channels > 3) {
                    value = image.at(x, y, grey ? 1 : 3);
                }
                result.at(x, y, c) = value;
            }
        }
    }
    return result;
}

const scene::EncodedImage& image_at(const scene::Scene& scene, int index)
{
    return scene.textures[static_cast<std::size_t>(index)];
}

Image decode(const scene::EncodedImage& encoded, ColorSpace space, int channels,
             const TextureOptions& options)
{
    return with_channels(
        texproc::decode_image(encoded.bytes, encoded.name,
                              {.space = space, .max_side = options.max_size, .stop = options.stop}),
        channels);
}

// Weights of four layers; a picture without alpha says nothing of the fourth.
Image decode_weights(const scene::EncodedImage& encoded, const TextureOptions& options)
{
    const Image image = texproc::decode_image(
        encoded.bytes, encoded.name, {.space = ColorSpace::Data, .max_side = options.max_size, .stop = options.stop});
    Image weights = with_channels(image, 4);
    for (std::size_t i = 3; image.channels < 4 && i < weights.pixels.size(); i += 4) weights.pixels[i] = 0.0f;
    return weights;
}

Image first_channels(const Image& image, int channels)
{
    if (image.channels == channels) return image;
    Image result(image.width, image.height, channels, image.space);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            for (int c = 0; c < channels; ++c) result.at(x, y, c) = image.at(x, y, c);
        }
    }
    return result;
}

Image channel_of(const Image& image, int channel)
{
    Image result(image.width, image.height, 1, ColorSpace::Data);
    for (std::size_t i = 0; i < result.pixels.size(); ++i) {
        const std::size_t at = i * static_cast<std::size_t>(image.channels);
        result.pixels[i] = image.pixels[at + static_cast<std::size_t>(channel)];
    }
    return result;
}

// glTF scales x and y of the decoded normal, then normalises.
void scale_normals(Image& normals, float scale)
{
    if (scale == 1.0f) return;
    for (std::size_t i = 0; i < normals.pixels.size(); i += 3) {
        const float x = (2.0f * normals.pixels[i] - 1.0f) * scale;
        const float y = (2.0f * normals.pixels[i + 1] - 1.0f) * scale;
        const float z = 2.0f * normals.pixels[i + 2] - 1.0f;
        const float length = std::sqrt(x * x + y * y + z * z);
        if (!(length > 0.0f)) continue;
        normals.pixels[i] = 0.5f + 0.5f * x / length;
        normals.pixels[i + 1] = 0.5f + 0.5f * y / length;
        normals.pixels[i + 2] = 0.5f + 0.5f * z / length;
    }
}

// Level 0 of a normal map: three channels. Prepared ones may hold two, from which z follows.
Image decode_normals(const scene::EncodedImage& encoded, const TextureOptions& options)
{
    if (!has_own_levels(encoded.bytes)) return decode(encoded, ColorSpace::Data, 3, options);
    const Image image = texproc::decode_image(encoded.bytes, encoded.name,
                                              {.max_side = options.max_size, .stop = options.stop});
    if (image.channels != 2) return with_channels(image, 3);
    Image normals(image.width, image.height, 3, ColorSpace::Data);
    for (std::size_t i = 0; 2 * i < image.pixels.size(); ++i) {
        const float x = image.pixels[2 * i];
        const float y = image.pixels[2 * i + 1];
        const float nx = 2.0f * x - 1.0f, ny = 2.0f * y - 1.0f;
        normals.pixels[3 * i] = x;
        normals.pixels[3 * i + 1] = y;
        normals.pixels[3 * i + 2] =
            0.5f + 0.5f * std::sqrt(std::max(0.0f, 1.0f - nx * nx - ny * ny));
    }
    return normals;
}

texproc::MipOptions mip_options(const scene::EncodedImage& encoded, const TextureRecipe& recipe)
{
    return {.wrap_u = encoded.wrap_u == scene::Wrap::Repeat,
            .wrap_v = encoded.wrap_v == scene::Wrap::Repeat,
            .alpha_cutoff = recipe.alpha_cutoff,
            .mirror_u = encoded.wrap_u == scene::Wrap::Mirror,
            .mirror_v = encoded.wrap_v == scene::Wrap::Mirror,
            .alpha_weighted = recipe.alpha_covers,
            .threads = 1};
}

// Light as linear numbers: halves and floats as they are, 8 bits with alpha as RGBM, 8 bits without
// as sRGB. Finite and not negative.
Image decode_light(const scene::EncodedImage& encoded, const TextureOptions& options)
{
    const RawImage shape = texproc::image_shape(encoded.bytes, encoded.name);
    const bool rgbm = shape.channels == 4 && shape.type == PixelType::U8;
    Image light = decode(encoded, rgbm ? ColorSpace::Data : ColorSpace::Linear, 4, options);
    light.space = ColorSpace::Linear;
    for (std::size_t i = 0; i < light.pixels.size(); i += 4) {
        const float scale = rgbm ? kRgbmRange * light.pixels[i + 3] : 1.0f;
        for (std::size_t c = i; c < i + 3; ++c) {
            const float value = light.pixels[c] * scale;
            light.pixels[c] = value > 0.0f ? std::min(value, 65504.0f) : 0.0f;
        }
        // A float map may hold a fourth number, 0..1: of shadow masks.
        const float fourth = light.pixels[i + 3];
        light.pixels[i + 3] = rgbm || shape.channels < 4 ? 1.0f : fourth > 0.0f ? std::min(fourth, 1.0f) : 0.0f;
    }
    return light;
}

// Numbers of the levels that fit into options.max_size; the levels are used up.
gpu::Texture rounded(std::vector<Image> levels, gpu::TexelFormat format,
                     const TextureOptions& options)
{
    std::size_t first = 0;
    while (first + 1 < levels.size() &&
           std::max(levels[first].width, levels[first].height) > options.max_size) {
        ++first;
    }
    gpu::Texture texture;
    texture.format = format;
    texture.width = levels[first].width;
    texture.height = levels[first].height;
    for (std::size_t level = first; level < levels.size(); ++level) {
        const bool halves = format == gpu::TexelFormat::Rgba16Float;
        texture.mips.push_back(
            texproc::to_raw(levels[level], halves ? PixelType::F16 : PixelType::U8).bytes);
        levels[level] = {};
    }
    return texture;
}

gpu::Texture rounded_normals(std::vector<Image> levels, const TextureOptions& options)
{
    for (Image& level : levels) level = first_channels(level, 2);  // z follows: unit length
    return rounded(std::move(levels), gpu::TexelFormat::Rg8Unorm, options);
}

std::vector<Image> normal_levels(const Image& normals, const texproc::MipOptions& mips)
{
    return texproc::plain_levels(normals, "normal", mips);
}

// The surface map of a job, and its normal map where it is to be written too.
std::vector<gpu::Texture> finish_surface(const scene::Scene& scene,
                                         const std::vector<TextureRecipe>& recipes,
                                         const TextureJob& job, const TextureOptions& options)
{
    const TextureRecipe& recipe = recipes[static_cast<std::size_t>(job.texture)];
    const scene::EncodedImage& encoded = image_at(scene, recipe.image);
    const texproc::MipOptions mips = mip_options(encoded, recipe);
    std::vector<Image> levels;
    {
        Image surface = decode(encoded, ColorSpace::Data, 4, options);
        for (std::size_t i = 1; i < surface.pixels.size(); i += 4)
            surface.pixels[i] *= recipe.roughness_factor;
        levels = texproc::plain_levels(surface, "surface", mips);
    }
    std::vector<Image> normal_chain;
    const bool joint = job.normal_texture >= 0;
    Image normals;
    if (recipe.normal_image >= 0)
        normals = decode_normals(image_at(scene, recipe.normal_image), options);
    const bool filtered = normals.width == levels[0].width && normals.height == levels[0].height &&
                          options.prefilter.rule != "none";
    if (joint) normal_chain = normal_levels(normals, mips);
    if (filtered) {
        scale_normals(normals, recipe.normal_scale);
        texproc::PrefilterOptions prefilter = texproc::prefilter_options(
            options.prefilter, {.joint = joint, .bits = 8, .threads = 1});
        prefilter.rebuild_z = true;  // as the shader does
        const bool same_scale = recipe.normal_scale == 1.0f;
        if (!same_scale) prefilter.bits = 0;  // the codes would be those of other normals
        const RawImage scaled =
            texproc::to_raw(normals, same_scale ? PixelType::U8 : PixelType::U16);
        normals = {};
        texproc::Prefiltered chains = texproc::prefilter_raw(
            scaled, texproc::to_raw(channel_of(levels[0], 1), PixelType::U8), prefilter);
        for (std::size_t level = 1; level < levels.size(); ++level) {
            const Image& rough = chains.roughness[level];
            for (std::size_t i = 0; i < rough.pixels.size(); ++i)
                levels[level].pixels[i * 4 + 1] = rough.pixels[i];
            if (!joint) continue;
            normal_chain[level] = std::move(chains.normal[level]);
            scale_normals(normal_chain[level], 1.0f / recipe.normal_scale);  // the shader scales
        }
    }
    std::vector<gpu::Texture> made;
    made.push_back(rounded(std::move(levels), gpu::TexelFormat::Rgba8Unorm, options));
    if (joint) made.push_back(rounded_normals(std::move(normal_chain), options));
    return made;
}

// Small levels of a detail colour leave what lies below as it is: level by level it goes to sRGB 0.5,
// which it is where 8 texels are left.
void fade_to_grey(std::vector<Image>& levels)
{
    constexpr float kGrey = 0.21404114f;
    const auto whole = static_cast<float>(std::max<std::size_t>(levels.size(), 4) - 4);
    for (std::size_t level = 1; level < levels.size(); ++level) {
        const float share = whole > 0.0f ? std::min(static_cast<float>(level) / whole, 1.0f) : 1.0f;
        std::vector<float>& pixels = levels[level].pixels;
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            if (i % 4 != 3) pixels[i] += (kGrey - pixels[i]) * share;
        }
    }
}

// What slopes with a mean normal of this length reflect of light from everywhere above, to what a flat
// ground does: a sky gives each (1 + n.y) / 2. Under a sun it is the mean over where the sun may stand:
// less when it is high (the length itself), more when it is low, since what turns away from it is black
// and not less than that. (docs/textures.md, 9.)
float lit_from_everywhere(float length)
{
    return 0.5f + 0.5f * length;
}

// A base colour; with a normal map its small levels are as dark as the slopes make them.
std::vector<Image> color_levels(const scene::Scene& scene, const TextureRecipe& recipe,
                                const texproc::MipOptions& mips, const TextureOptions& options)
{
    std::vector<Image> levels = texproc::plain_levels(
        decode(image_at(scene, recipe.image), ColorSpace::Linear, 4, options), "albedo", mips);
    if (recipe.fades_to_grey) fade_to_grey(levels);
    if (recipe.normal_image < 0 || options.prefilter.rule != "picture") return levels;
    Image normals = decode_normals(image_at(scene, recipe.normal_image), options);
    scale_normals(normals, recipe.normal_scale);
    std::vector<Image> metallic;
    if (recipe.surface_image >= 0) {
        const Image surface =
            decode(image_at(scene, recipe.surface_image), ColorSpace::Data, 4, options);
        Image metal = channel_of(surface, 2);
        for (float& value : metal.pixels) value *= recipe.metallic_factor;
        metallic = texproc::plain_levels(metal, "scalar", mips);
    } else if (recipe.metallic_factor > 0.0f) {
        for (const Image& level : levels)
            metallic.emplace_back(level.width, level.height, 1, ColorSpace::Data,
                                  recipe.metallic_factor);
    }
    std::vector<Image> shares = texproc::base_shares(normals, 1);
    for (Image& share : shares)
        for (float& value : share.pixels) value = lit_from_everywhere(value);
    texproc::apply_base_shares(levels, shares, metallic);
    return levels;
}

gpu::Texture finish_plain(const scene::Scene& scene, const TextureRecipe& recipe,
                          const TextureOptions& options)
{
    const scene::EncodedImage& encoded = image_at(scene, recipe.image);
    const texproc::MipOptions mips = mip_options(encoded, recipe);
    switch (recipe.kind) {
        case Kind::Color:
            return rounded(color_levels(scene, recipe, mips, options), gpu::TexelFormat::Rgba8Srgb,
                           options);
        case Kind::Normal:
            return rounded_normals(normal_levels(decode_normals(encoded, options), mips), options);
        case Kind::Light:
            return rounded(texproc::plain_levels(decode_light(encoded, options), "albedo", mips),
                           gpu::TexelFormat::Rgba16Float, options);
        case Kind::Weights:
            return rounded(texproc::plain_levels(decode_weights(encoded, options), "mask", mips),
                           gpu::TexelFormat::Rgba8Unorm, options);
        case Kind::Surface:
        case Kind::Scalar:
            break;
    }
    const Image one = channel_of(decode(encoded, ColorSpace::Data, 4, options), recipe.channel);
    return rounded(texproc::plain_levels(one, "scalar", mips), gpu::TexelFormat::R8Unorm, options);
}

FinishedTextures finish_prepared(const scene::EncodedImage& encoded, const TextureRecipe& recipe,
                                 const TextureOptions& options)
{
    const TextureMeaning meaning = recipe.kind == Kind::Color    ? TextureMeaning::Color
                                   : recipe.kind == Kind::Normal ? TextureMeaning::Normal
                                                                 : TextureMeaning::Data;
    texproc::MipTexture file = texproc::decode_texture(encoded.bytes, encoded.name);
    while (file.levels.size() > 1 && std::max(file.width, file.height) > options.max_size) {
        file.levels.erase(file.levels.begin());
        file.width = texproc::level_extent(file.width, 1);
        file.height = texproc::level_extent(file.height, 1);
    }
    FinishedTextures finished;
    try {
        LoadedTexture loaded =
            load_prepared(file, meaning, options.blocks, says_color_space(encoded.bytes), 1);
        finished.as_stored = loaded.as_stored;
        for (const std::string& note : loaded.notes)
            finished.notes.push_back("texture " + encoded.name + " " + note);
        finished.textures.push_back(std::move(loaded.texture));
    } catch (const Error& error) {
        throw Error("texture " + encoded.name + ": " + error.what(), error.fix());
    }
    return finished;
}

// PNG and zlib, JPEG and WebP tell damage themselves.
bool has_no_checksum(std::span<const std::byte> bytes)
{
    const auto starts = [&](std::initializer_list<int> head) {
        return bytes.size() >= head.size() &&
               std::equal(head.begin(), head.end(), bytes.begin(),
                          [](int a, std::byte b) { return a == std::to_integer<int>(b); });
    };
    return !starts({0x89, 'P', 'N', 'G'}) && !starts({0xff, 0xd8}) && !starts({'R', 'I', 'F', 'F'});
}

// What a file that was cut and filled up looks like, of a colour or a normal map.
void tell_zero_rows(const scene::EncodedImage& encoded, const gpu::Texture& made, std::vector<std::string>& notes)
{
    constexpr int kFewRows = 16;
    if (made.mips.empty() || made.height < kFewRows || !has_no_checksum(encoded.bytes)) return;
    const std::size_t texels = static_cast<std::size_t>(made.width) * static_cast<std::size_t>(made.height);
    const texproc::RawImage level{made.width, made.height, static_cast<int>(made.mips[0].size() / texels),
                                  texproc::PixelType::U8, {}, made.mips[0]};
    const std::string zero = texproc::zero_rows(level);
    if (!zero.empty())
        notes.push_back("texture " + encoded.name + ": " + zero + "; look whether the file is damaged");
}

}  // namespace

std::vector<TextureJob> texture_jobs(const std::vector<TextureRecipe>& recipes,
                                     const std::vector<bool>& used)
{
    const auto mate_of = [&](const TextureRecipe& surface) {
        for (std::size_t i = 0; i < recipes.size(); ++i) {
            const TextureRecipe& normal = recipes[i];
            if (used[i] && normal.kind == Kind::Normal && normal.surface_image == surface.image &&
                normal.image == surface.normal_image &&
                normal.normal_scale == surface.normal_scale &&
                normal.roughness_factor == surface.roughness_factor) {
                return static_cast<int>(i);
            }
        }
        return -1;
    };
    std::vector<TextureJob> jobs;
    for (std::size_t i = 0; i < recipes.size(); ++i) {
        if (!used[i]) continue;
        TextureJob job{static_cast<int>(i), -1};
        if (recipes[i].kind == Kind::Normal && recipes[i].surface_image >= 0) continue;  // a mate
        if (recipes[i].kind == Kind::Surface && recipes[i].normal_image >= 0)
            job.normal_texture = mate_of(recipes[i]);
        jobs.push_back(job);
    }
    return jobs;
}

FinishedTextures finish_textures(const scene::Scene& scene,
                                 const std::vector<TextureRecipe>& recipes, const TextureJob& job,
                                 const TextureOptions& options)
{
    const TextureRecipe& recipe = recipes[static_cast<std::size_t>(job.texture)];
    const scene::EncodedImage& encoded = image_at(scene, recipe.image);
    if (recipe.prepared) return finish_prepared(encoded, recipe, options);
    FinishedTextures finished;
    if (recipe.kind == Kind::Surface) {
        finished.textures = finish_surface(scene, recipes, job, options);
        if (job.normal_texture >= 0 && finished.textures.size() > 1) {
            const TextureRecipe& normal = recipes[static_cast<std::size_t>(job.normal_texture)];
            tell_zero_rows(image_at(scene, normal.image), finished.textures[1], finished.notes);
        }
        return finished;
    }
    finished.textures.push_back(finish_plain(scene, recipe, options));
    if (recipe.kind == Kind::Color || recipe.kind == Kind::Normal)
        tell_zero_rows(encoded, finished.textures[0], finished.notes);
    return finished;
}

}  // namespace petrichor::film
