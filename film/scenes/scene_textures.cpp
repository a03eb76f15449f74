#include "film/scenes/scene_textures.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

#include "texproc/codecs/files/io.h"
#include "texproc/filter/mips.h"
#include "texproc/image/raw_image.h"
#include "texproc/prefilter/prefilter.h"

namespace petrichor::film {
namespace {

using Kind = TextureRecipe::Kind;

// Gives every use of an image a recipe; the first keeps the image's index, others are appended.
class Planner {
public:
    explicit Planner(scene::Scene& scene)
        : scene_(scene), recipes_(scene.textures.size()), taken_(scene.textures.size(), false)
    {
        for (std::size_t i = 0; i < recipes_.size(); ++i) recipes_[i].image = static_cast<int>(i);
    }

    void use(scene::TextureUse& texture, TextureRecipe recipe)
    {
        if (!texture.present()) return;
        recipe.image = texture.texture;
        texture.texture = index_of(recipe);
    }
    std::vector<TextureRecipe> take() { return std::move(recipes_); }

private:
    scene::TextureIndex index_of(const TextureRecipe& recipe)
    {
        for (std::size_t i = 0; i < recipes_.size(); ++i) {
            if (taken_[i] && recipes_[i] == recipe) return static_cast<scene::TextureIndex>(i);
        }
        const auto own = static_cast<std::size_t>(recipe.image);
        if (!taken_[own]) {
            recipes_[own] = recipe;
            taken_[own] = true;
            return recipe.image;
        }
        scene::EncodedImage again = scene_.textures[own];
        again.bytes.clear();
        scene_.textures.push_back(std::move(again));
        recipes_.push_back(recipe);
        taken_.push_back(true);
        return static_cast<scene::TextureIndex>(recipes_.size() - 1);
    }

    scene::Scene& scene_;
    std::vector<TextureRecipe> recipes_;
    std::vector<bool> taken_;
};

bool same_coordinates(const scene::TextureUse& a, const scene::TextureUse& b)
{
    return a.texcoord == b.texcoord && a.offset == b.offset && a.scale == b.scale &&
           a.rotation_rad == b.rotation_rad;
}

bool same_wrapping(const scene::EncodedImage& a, const scene::EncodedImage& b)
{
    return a.wrap_u == b.wrap_u && a.wrap_v == b.wrap_v;
}

void plan_material(scene::Material& material, const scene::Scene& scene, Planner& planner)
{
    // What lies under holes must not show at their edges; an opaque material shows all of it.
    TextureRecipe color{.kind = Kind::Color,
                        .alpha_covers = material.alpha_mode != scene::AlphaMode::Opaque};
    if (material.alpha_mode == scene::AlphaMode::Mask && material.base_color.a > 0.0f) {
        color.alpha_cutoff = material.alpha_cutoff / material.base_color.a;
    }
    planner.use(material.base_color_texture, color);
    planner.use(material.emissive_texture, {.kind = Kind::Color});

    scene::TextureUse& surface = material.metallic_roughness_texture;
    const scene::TextureUse& normal = material.normal_texture;
    TextureRecipe recipe{.kind = Kind::Surface};
    if (surface.present() && normal.present() && same_coordinates(surface, normal) &&
        same_wrapping(scene.textures[static_cast<std::size_t>(surface.texture)],
                      scene.textures[static_cast<std::size_t>(normal.texture)])) {
        recipe.normal_image = normal.texture;
        recipe.normal_scale = material.normal_scale;
        recipe.roughness_factor = material.roughness;
        material.roughness = 1.0f;
    }
    const scene::TextureIndex surface_image = surface.texture;
    const scene::TextureIndex occlusion_image = material.occlusion_texture.texture;
    planner.use(surface, recipe);
    if (surface.present() && occlusion_image == surface_image) {
        material.occlusion_texture.texture = surface.texture;  // one packed image, one read
    } else {
        planner.use(material.occlusion_texture, {.kind = Kind::Scalar});
    }
    planner.use(material.normal_texture, {.kind = Kind::Normal});
    planner.use(material.weather.height, {.kind = Kind::Scalar});
    planner.use(material.weather.puddle_mask, {.kind = Kind::Scalar});
    planner.use(material.weather.snow_mask, {.kind = Kind::Scalar});
}

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

Image decode(const scene::EncodedImage& encoded, ColorSpace space, int channels)
{
    return with_channels(texproc::decode_image(encoded.bytes, encoded.name, {.space = space}),
                         channels);
}

Image first_channels(const Image& image, int channels)
{
    Image result(image.width, image.height, channels, image.space);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            for (int c = 0; c < channels; ++c) result.at(x, y, c) = image.at(x, y, c);
        }
    }
    return result;
}

Image channel_of(const Image& image, int channel, float factor)
{
    Image result(image.width, image.height, 1, ColorSpace::Data);
    for (std::size_t i = 0; i < result.pixels.size(); ++i) {
        const std::size_t at = i * static_cast<std::size_t>(image.channels);
        result.pixels[i] = image.pixels[at + static_cast<std::size_t>(channel)] * factor;
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

// All levels of a surface map: roughness from the prefilter where it has a normal map of its size.
std::vector<Image> surface_levels(const Image& surface, const scene::Scene& scene,
                                  const TextureRecipe& recipe, const texproc::MipOptions& mips)
{
    Image factored = surface;
    for (std::size_t i = 1; i < factored.pixels.size(); i += 4)
        factored.pixels[i] *= recipe.roughness_factor;
    std::vector<Image> levels = texproc::mip_chain(factored, mips);
    if (recipe.normal_image < 0) return levels;
    Image normals =
        decode(scene.textures[static_cast<std::size_t>(recipe.normal_image)], ColorSpace::Data, 3);
    if (normals.width != surface.width || normals.height != surface.height) return levels;
    scale_normals(normals, recipe.normal_scale);
    const auto filtered =
        texproc::prefilter(normals, channel_of(factored, 1, 1.0f), {.threads = 1});
    for (std::size_t level = 1; level < levels.size(); ++level) {
        const Image& roughness = filtered.roughness[level];
        for (std::size_t i = 0; i < roughness.pixels.size(); ++i) {
            levels[level].pixels[i * 4 + 1] = roughness.pixels[i];
        }
    }
    return levels;
}

gpu::Texture prepare(const scene::Scene& scene, const TextureRecipe& recipe,
                     const TextureOptions& options)
{
    const scene::EncodedImage& encoded = scene.textures[static_cast<std::size_t>(recipe.image)];
    gpu::Texture texture;
    texture.name = encoded.name;
    texture.wrap_u = encoded.wrap_u;
    texture.wrap_v = encoded.wrap_v;
    texture.nearest = encoded.nearest;
    texproc::MipOptions mips{.wrap_u = encoded.wrap_u != scene::Wrap::Clamp,
                             .wrap_v = encoded.wrap_v != scene::Wrap::Clamp,
                             .alpha_cutoff = recipe.alpha_cutoff,
                             .alpha_weighted = recipe.alpha_covers};
    std::vector<Image> levels;
    switch (recipe.kind) {
        case Kind::Color:
            texture.format = gpu::TexelFormat::Rgba8Srgb;
            levels = texproc::mip_chain(decode(encoded, ColorSpace::Linear, 4), mips);
            break;
        case Kind::Normal:
            texture.format =
                gpu::TexelFormat::Rg8Unorm;  // the third component follows: unit length
            mips.normals = true;
            levels = texproc::mip_chain(decode(encoded, ColorSpace::Data, 3), mips);
            for (Image& level : levels) level = first_channels(level, 2);
            break;
        case Kind::Surface:
            texture.format = gpu::TexelFormat::Rgba8Unorm;
            levels = surface_levels(decode(encoded, ColorSpace::Data, 4), scene, recipe, mips);
            break;
        case Kind::Scalar:
            texture.format = gpu::TexelFormat::R8Unorm;
            levels =
                texproc::mip_chain(channel_of(decode(encoded, ColorSpace::Data, 4), 0, 1.0f), mips);
            break;
    }
    std::size_t first = 0;
    while (first + 1 < levels.size() &&
           std::max(levels[first].width, levels[first].height) > options.max_size) {
        ++first;
    }
    texture.width = levels[first].width;
    texture.height = levels[first].height;
    for (std::size_t level = first; level < levels.size(); ++level) {
        texture.mips.push_back(texproc::to_raw(levels[level], texproc::PixelType::U8).bytes);
        levels[level] = {};
    }
    return texture;
}

}  // namespace

std::vector<TextureRecipe> plan_textures(scene::Scene& scene)
{
    Planner planner(scene);
    for (scene::Material& material : scene.materials) plan_material(material, scene, planner);
    return planner.take();
}

std::vector<gpu::Texture> prepare_textures(scene::Scene& scene, const TextureOptions& options)
{
    const auto recipes = plan_textures(scene);
    // An image that no material uses stays white and costs nothing.
    std::vector<bool> used(scene.textures.size(), false);
    for (const scene::Material& material : scene.materials) {
        for (const scene::TextureUse* use :
             {&material.base_color_texture, &material.metallic_roughness_texture,
              &material.normal_texture, &material.occlusion_texture, &material.emissive_texture,
              &material.weather.height, &material.weather.puddle_mask,
              &material.weather.snow_mask}) {
            if (use->present()) used[static_cast<std::size_t>(use->texture)] = true;
        }
    }
    std::vector<gpu::Texture> textures(recipes.size());
    std::atomic<std::size_t> next{0};
    std::mutex guard;
    std::exception_ptr first_problem;
    std::size_t first_problem_at = recipes.size();
    const auto work = [&] {
        for (std::size_t i = next++; i < recipes.size(); i = next++) {
            if (!used[i]) continue;
            try {
                if (options.stop && options.stop())
                    throw Interrupted("interrupted while reading textures");
                textures[i] = prepare(scene, recipes[i], options);
            } catch (...) {
                const std::lock_guard lock(guard);
                if (i < first_problem_at) {  // report the same one whatever the timing
                    first_problem_at = i;
                    first_problem = std::current_exception();
                }
            }
        }
    };
    int threads = options.threads;
    if (threads <= 0) threads = static_cast<int>(std::thread::hardware_concurrency());
    std::vector<std::thread> workers;
    for (int i = 1; i < std::min(threads, 4); ++i) workers.emplace_back(work);
    work();
    for (std::thread& worker : workers) worker.join();
    if (first_problem) std::rethrow_exception(first_problem);
    for (scene::EncodedImage& image : scene.textures) {
        image.bytes.clear();
        image.bytes.shrink_to_fit();
    }
    return textures;
}

}  // namespace petrichor::film
