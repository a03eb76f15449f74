#include "film/scenes/texture_plan.h"

#include <cstddef>
#include <utility>

#include "film/scenes/prepared_texture.h"

namespace petrichor::film {
namespace {

using Kind = TextureRecipe::Kind;

// Gives every use of an image a recipe; the first keeps the image's index, others are appended.
class Planner {
public:
    explicit Planner(scene::Scene& scene)
        : scene_(scene), recipes_(scene.textures.size()), taken_(scene.textures.size(), false)
    {
        for (std::size_t i = 0; i < recipes_.size(); ++i) {
            recipes_[i].image = static_cast<int>(i);
            prepared_.push_back(has_own_levels(scene.textures[i].bytes));
        }
    }

    bool prepared(const scene::TextureUse& texture) const
    {
        return texture.present() && prepared_[static_cast<std::size_t>(texture.texture)];
    }
    void use(scene::TextureUse& texture, TextureRecipe recipe)
    {
        if (!texture.present()) return;
        recipe.image = texture.texture;
        recipe.prepared = prepared(texture);
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
        scene::EncodedImage again;
        again.name = scene_.textures[own].name;
        again.wrap_u = scene_.textures[own].wrap_u;
        again.wrap_v = scene_.textures[own].wrap_v;
        again.nearest = scene_.textures[own].nearest;
        scene_.textures.push_back(std::move(again));
        recipes_.push_back(recipe);
        taken_.push_back(true);
        return static_cast<scene::TextureIndex>(recipes_.size() - 1);
    }

    scene::Scene& scene_;
    std::vector<TextureRecipe> recipes_;
    std::vector<bool> taken_;
    std::vector<bool> prepared_;  // of the images as loaded
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

// The base colour and what shines.
void plan_color(scene::Material& material, const scene::Scene& scene, Planner& planner, bool moves)
{
    // What lies under holes must not show at their edges; an opaque material shows all of it.
    TextureRecipe color{.kind = Kind::Color,
                        .alpha_covers = material.alpha_mode != scene::AlphaMode::Opaque};
    if (material.alpha_mode == scene::AlphaMode::Mask && material.base_color.a > 0.0f) {
        color.alpha_cutoff = material.alpha_cutoff / material.base_color.a;
    }
    const scene::TextureUse& base = material.base_color_texture;
    const auto fits = [&](const scene::TextureUse& other) {
        return other.present() && same_coordinates(base, other) &&
               same_wrapping(scene.textures[static_cast<std::size_t>(base.texture)],
                             scene.textures[static_cast<std::size_t>(other.texture)]);
    };
    if (!moves && base.present() && !planner.prepared(base) && !material.unlit &&
        fits(material.normal_texture) && !planner.prepared(material.normal_texture)) {
        color.normal_image = material.normal_texture.texture;
        color.normal_scale = material.normal_scale;
        color.metallic_factor = material.specular_workflow ? 0.0f : material.metallic;
        if (color.metallic_factor > 0.0f && fits(material.metallic_roughness_texture))
            color.surface_image = material.metallic_roughness_texture.texture;
    }
    planner.use(material.base_color_texture, color);
    planner.use(material.emissive_texture, {.kind = Kind::Color});
    planner.use(material.light_map, {.kind = Kind::Light});
}

// Normals and roughness of a set of textures, together where they can be. roughness: the factor, which
// moves into the texture; null: it stays.
void plan_pair(scene::TextureUse& surface, scene::TextureUse& normal, float normal_scale,
               float* roughness, const scene::Scene& scene, Planner& planner)
{
    TextureRecipe surface_recipe{.kind = Kind::Surface};
    TextureRecipe normal_recipe{.kind = Kind::Normal};
    const bool paired = surface.present() && normal.present() && !planner.prepared(surface) &&
                        same_coordinates(surface, normal) &&
                        same_wrapping(scene.textures[static_cast<std::size_t>(surface.texture)],
                                      scene.textures[static_cast<std::size_t>(normal.texture)]);
    if (paired) {
        surface_recipe.normal_image = normal.texture;
        surface_recipe.normal_scale = normal_scale;
        if (roughness) surface_recipe.roughness_factor = std::exchange(*roughness, 1.0f);
        // Normals that bring their own levels keep them; those of a scale of 0 have no directions.
        if (!planner.prepared(normal) && normal_scale != 0.0f) {
            normal_recipe.surface_image = surface.texture;
            normal_recipe.normal_scale = surface_recipe.normal_scale;
            normal_recipe.roughness_factor = surface_recipe.roughness_factor;
        }
    }
    planner.use(surface, surface_recipe);
    planner.use(normal, normal_recipe);
}

// One channel, which then is the only one; a file with its own levels keeps all it has.
void plan_scalar(scene::TextureUse& use, Planner& planner)
{
    TextureRecipe recipe{.kind = Kind::Scalar};
    if (use.present() && !planner.prepared(use)) {
        recipe.channel = static_cast<int>(use.channel);
        use.channel = scene::Channel::R;
    }
    planner.use(use, recipe);
}

void plan_surface(scene::Material& material, const scene::Scene& scene, Planner& planner,
                  bool roughness_moves)
{
    scene::TextureUse& surface = material.metallic_roughness_texture;
    const scene::TextureIndex surface_image = surface.texture;
    const scene::TextureIndex occlusion_image = material.occlusion_texture.texture;
    plan_pair(surface, material.normal_texture, material.normal_scale,
              roughness_moves ? nullptr : &material.roughness, scene, planner);
    if (surface.present() && occlusion_image == surface_image &&
        material.occlusion_texture.channel == scene::Channel::R) {
        material.occlusion_texture.texture = surface.texture;  // one packed image, one read
    } else {
        plan_scalar(material.occlusion_texture, planner);
    }
}

void plan_second(scene::SecondSet& second, const scene::Scene& scene, Planner& planner)
{
    const bool detail = second.use == scene::SecondSetUse::Detail;
    planner.use(second.base_color_texture, {.kind = Kind::Color, .fades_to_grey = detail});
    plan_pair(second.metallic_roughness_texture, second.normal_texture, second.normal_scale, nullptr,
              scene, planner);
    if (second.use == scene::SecondSetUse::Layers) {
        planner.use(second.mix_mask, {.kind = Kind::Weights});
        for (scene::GroundLayer* layer : {&second.third, &second.fourth}) {
            planner.use(layer->base_color_texture, {.kind = Kind::Color});
            plan_pair(layer->metallic_roughness_texture, layer->normal_texture, 1.0f, nullptr, scene, planner);
        }
        planner.use(second.far_texture, {.kind = Kind::Color});
    } else {
        plan_scalar(second.mix_mask, planner);
    }
    plan_scalar(second.height, planner);
}

void plan_layers(scene::LayerTextures& maps, Planner& planner)
{
    const auto scalar = [&](scene::TextureUse& use, scene::Channel channel) {
        use.channel = channel;  // as the extensions have it
        plan_scalar(use, planner);
    };
    scalar(maps.clearcoat, scene::Channel::R);
    scalar(maps.clearcoat_roughness, scene::Channel::G);
    scalar(maps.sheen_roughness, scene::Channel::A);
    scalar(maps.diffuse_transmission, scene::Channel::A);
    scalar(maps.transmission, scene::Channel::R);
    scalar(maps.thickness, scene::Channel::G);
    scalar(maps.specular, scene::Channel::A);
    scalar(maps.iridescence, scene::Channel::R);
    scalar(maps.iridescence_thickness, scene::Channel::G);
    plan_scalar(maps.translucency, planner);
    plan_scalar(maps.skin_curvature, planner);
    for (scene::TextureUse* color :
         {&maps.sheen_color, &maps.specular_color, &maps.specular_glossiness, &maps.diffuse_transmission_color})
        planner.use(*color, {.kind = Kind::Color});
    planner.use(maps.clearcoat_normal, {.kind = Kind::Normal});
    planner.use(maps.anisotropy, {.kind = Kind::Surface});
    planner.use(maps.second_lobe, {.kind = Kind::Weights});
}

}  // namespace

std::vector<TextureRecipe> plan_textures(scene::Scene& scene, const std::vector<bool>& moving)
{
    Planner planner(scene);
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        scene::Material& material = scene.materials[i];
        const bool moves = i < moving.size() && moving[i];
        plan_color(material, scene, planner, moves);
        plan_surface(material, scene, planner, moves);
        plan_scalar(material.weather.height, planner);
        plan_scalar(material.weather.puddle_mask, planner);
        plan_scalar(material.weather.snow_mask, planner);
        planner.use(material.weather.snow_mask_normal, {.kind = Kind::Normal});
        plan_second(material.second, scene, planner);
        plan_layers(material.maps, planner);
    }
    return planner.take();
}

}  // namespace petrichor::film
