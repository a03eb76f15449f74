// Materials of a scene on the device: their constants, what passes ask of them, and changes of a frame.
#include <algorithm>
#include <cstddef>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "gpu/upload/gpu_scene.h"
#include "gpu/upload/material_constants.h"
#include "gpu/upload/parallax_ends_io.h"
#include "gpu/upload/wide_ground.h"

namespace petrichor::gpu {

namespace {

VkCullModeFlags cull_mode(const Material& material)
{
    if (material.cull_front) return VK_CULL_MODE_FRONT_BIT;
    return material.double_sided ? VK_CULL_MODE_NONE : VK_CULL_MODE_BACK_BIT;
}

std::uint32_t water_bits(scene::Wetness wetness)
{
    switch (wetness) {
        case scene::Wetness::None:
            return 0;
        case scene::Wetness::Simple:
            return WATER_STANDS;
        case scene::Wetness::Ripples:
            return WATER_STANDS | WATER_RIPPLES;
        case scene::Wetness::Flow:
            return WATER_STANDS | WATER_FLOWS;
        case scene::Wetness::Full:
            break;
    }
    return WATER_STANDS | WATER_RIPPLES | WATER_FLOWS;
}

std::uint32_t snow_bits(const scene::MaterialWeather& weather)
{
    return SNOW_LIES | (weather.snow_rule == scene::SnowRule::Grass ? SNOW_GRASS : 0u) |
           (weather.snow_rule == scene::SnowRule::Vertex ? SNOW_VERTEX : 0u) |
           (weather.snow_mapping == scene::SnowMapping::Local ? SNOW_LOCAL : 0u);
}

bool mixes(const Material& m)
{
    return m.second.use == scene::SecondSetUse::Mix;
}

bool scatters(const Material& m)
{
    return m.scatter_color != glm::vec3(0.0f) ||
           (mixes(m) && m.second.scatter_color != glm::vec3(0.0f));
}

// LAYERS_... of a material. A roughness or a direction alone shows nothing.
bool has_role(const std::array<std::uint32_t, LAYER_ROLE_WORDS>& roles, std::uint32_t role)
{
    return (roles[role / LAYER_ROLES_A_WORD] >> 4 * (role % LAYER_ROLES_A_WORD) & 15u) != 0;
}

// What the shares of its pixels have room for, as the surface resolve has it.
std::uint32_t kind_of_shares(const std::array<std::uint32_t, LAYER_ROLE_WORDS>& roles)
{
    if (has_role(roles, LAYER_TEXTURE_SECOND_LOBE)) return SHARES_LOBES;
    return has_role(roles, LAYER_TEXTURE_THROUGH) ? SHARES_THROUGH : SHARES_SHEEN;
}

// Whether its light lies along a tangent.
bool has_grain(const Material& m)
{
    return m.anisotropy > 0.0f || m.lighting_model == "hair";
}

// Its thickness is told in place of a tangent, and beside one by shares that layers of glass have not, and a second lobe needs.
bool tells_film(const Material& m)
{
    const bool by_shares = has_grain(m) && m.maps.iridescence_thickness.present();
    return m.iridescence > 0.0f && !(by_shares && (is_blended(m) || m.maps.second_lobe.present()));
}

// Layers of glass have no shares: where it lies is told in place of their metal.
bool places_film(const Material& m)
{
    return tells_film(m) && is_blended(m) && m.maps.iridescence.present();
}

std::uint32_t layers_of(const Material& m)
{
    return (m.clearcoat > 0.0f ? LAYERS_COAT : 0u) |
           (m.sheen_color != glm::vec3(0.0f) ? LAYERS_SHEEN : 0u) |
           (m.anisotropy > 0.0f ? LAYERS_ANISOTROPY : 0u) |
           (m.diffuse_transmission > 0.0f ? LAYERS_TRANSMISSION : 0u) |
           (m.translucency > 0.0f && m.translucency_scale > 0.0f ? LAYERS_TRANSLUCENT : 0u) |
           (scatters(m) ? LAYERS_SCATTER : 0u) |
           (m.maps.second_lobe.present() ? LAYERS_SECOND_LOBE : 0u) |
           (tells_film(m) ? LAYERS_IRIDESCENT : 0u);
}

// Occlusion, roughness and metal in channels of one texture, at one place of it: read once.
bool one_read(const Material& m, const shared::MaterialConstants& c)
{
    const shared::TextureSlot& a = c.slots[TEXTURE_METALLIC_ROUGHNESS];
    const shared::TextureSlot& b = c.slots[TEXTURE_OCCLUSION];
    return m.metallic_roughness_texture.texture == m.occlusion_texture.texture && a.present != 0 &&
           b.present != 0 && a.row0 == b.row0 && a.row1 == b.row1 && a.texcoord == b.texcoord;
}

// Skin whose diffuse light has a normal of its own.
bool softens(const Material& m)
{
    const bool micro = m.second.use == scene::SecondSetUse::Detail && m.second.normal_texture.present();
    return m.lighting_model == "skin" && m.skin_blur > 0.0f && (m.normal_texture.present() || micro);
}

std::string lighting_model_of(const Material& material)
{
    if (!material.lighting_model.empty()) return material.lighting_model;
    if (material.unlit) return "unlit";
    return (layers_of(material) & ~LAYERS_IRIDESCENT) != 0 ? "layered" : "standard";
}

// Who names one of the other built-in models gets it as it is; light that comes through, and fibres at
// the rim, go with any that is lit.
std::uint32_t layers_of(const Material& m, const std::string& model)
{
    const auto& built_in = built_in_lighting_models();
    const bool own = std::find(built_in.begin(), built_in.end(), model) == built_in.end();
    const std::uint32_t all = layers_of(m);
    if (own) return all & ~LAYERS_SECOND_LOBE;
    if (model == "layered") return all;
    if (model == "unlit" || model == "unlit_shadowed") return 0;
    return (all & (LAYERS_TRANSLUCENT | LAYERS_SCATTER | LAYERS_IRIDESCENT)) | (model == "skin" ? LAYERS_SKIN : 0u) |
           (model == "hair" ? LAYERS_HAIR : 0u);
}

}  // namespace

void GpuScene::make_materials(const Device& device, const Scene& scene)
{
    // The G-buffer counts them in 16 bits.
    if (scene.materials.size() > 65536) {
        throw Error("scene: " + std::to_string(scene.materials.size()) +
                        " materials; at most 65536 can be told apart",
                    "Merge materials that are alike.");
    }
    std::vector<std::string> models;
    for (const Material& material : scene.materials) models.push_back(lighting_model_of(material));
    lighting_models_ = LightingModels(models);
    std::vector<std::string> surfaces;
    for (const Material& material : scene.materials) surfaces.push_back(material.surface);
    own_surfaces_ = OwnSurfaces(surfaces);
    for (const auto& image : images_) loaded_.push_back(image != nullptr);
    const VkDeviceSize alignment = device.limits().minUniformBufferOffsetAlignment;
    constants_stride_ =
        (sizeof(shared::MaterialConstants) + alignment - 1) / alignment * alignment;
    constants_ = arena_.buffer({.name = "material_constants",
                                .size = constants_stride_ * scene.materials.size(),
                                .usage = VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT,
                                .host = true});
    looks_ = arena_.buffer({.name = "material_looks",
                            .size = scene.materials.size() * MATERIAL_LOOK_TEXELS * sizeof(glm::vec4),
                            .usage = VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT,
                            .texel_format = VK_FORMAT_R32G32B32A32_SFLOAT,
                            .host = true});
    layers_ = arena_.buffer({.name = "layers",
                             .size = 256 * LAYERS_TEXELS * sizeof(glm::vec4),
                             .usage = VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT,
                             .texel_format = VK_FORMAT_R32G32B32A32_SFLOAT,
                             .host = true});
    sources_ = current_ = scene.materials;
    wide_ground_ = wide_ground(scene);
    const SamplerHandle& plain = sampler(device, Wrap::Repeat, Wrap::Repeat, false);
    // Where the height map of a material does not go on, PARALLAX_ENDS_...
    const auto relief_ends = [this](std::size_t texture) {
        for (const auto& [key, handle] : samplers_) {
            if (&handle != image_samplers_[texture]) continue;
            const auto clamps = [](int wrap) { return wrap == static_cast<int>(Wrap::Clamp); };
            return (clamps(key / 8) ? PARALLAX_ENDS_U : 0u) | (clamps(key % 8 / 2) ? PARALLAX_ENDS_V : 0u);
        }
        return 0u;
    };
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const Material& source = scene.materials[i];
        GpuMaterial material;
        material.cull = cull_mode(source);
        material.water = water_bits(source.weather.wetness);
        material.snow = snow_bits(source.weather);
        material.second = static_cast<std::uint32_t>(source.second.use);
        material.own_surface = own_surfaces_.number_of(source.surface);
        material.bindings.push_back(uniform(*constants_, i * constants_stride_,
                                            sizeof(shared::MaterialConstants)));
        const auto slots = slots_of(source);
        for (std::uint32_t slot = 0; slot < TEXTURE_SLOTS; ++slot) {
            const auto t = static_cast<std::size_t>(slots[slot]->texture);
            if (slots[slot]->present() && t < loaded_.size() && loaded_[t]) {
                material.slots |= 1u << slot;
                material.bindings.push_back(sampled(*images_[t], *image_samplers_[t]));
            } else {
                material.bindings.push_back(sampled(*white_, plain));
            }
        }
        const LayerSlots layers = layer_slots_of(source, loaded_);
        for (std::size_t slot = 0; slot < LAYER_TEXTURE_SLOTS; ++slot) {
            if (slot < layers.uses.size()) {
                const auto t = static_cast<std::size_t>(layers.uses[slot]->texture);
                material.bindings.push_back(sampled(*images_[t], *image_samplers_[t]));
            } else {
                material.bindings.push_back(sampled(*white_, plain));
            }
        }
        material.layer_roles = layers.roles;
        // Without its texture there is none.
        if (!has_role(layers.roles, LAYER_TEXTURE_SECOND_LOBE))
            sources_[i].maps.second_lobe = current_[i].maps.second_lobe = {};
        material.light_textures = layers.of_light;
        body_shares_ = body_shares_ || source.maps.thickness.present();
        if ((material.slots & 1u << TEXTURE_HEIGHT) != 0u)
            material.parallax = static_cast<std::uint32_t>(source.weather.parallax);
        if (material.parallax != PARALLAX_NONE && source.weather.parallax_level >= 0.0f)
            material.parallax |= PARALLAX_LEVEL;
        if (material.parallax != PARALLAX_NONE && source.alpha_mode == AlphaMode::Mask)
            material.parallax |= relief_ends(static_cast<std::size_t>(source.weather.height.texture));
        materials_.push_back(std::move(material));
        set_material(i, sources_[i]);
    }
}

// Its reflectance is 0.04 wherever it is asked, whatever its textures say, and it has no tangent.
bool GpuScene::mirrors_as_glass(const GpuMaterial& material, const shared::MaterialConstants& c)
{
    const std::uint32_t other = BESIDES_SPECULAR_WORKFLOW | BESIDES_IRIDESCENT | BESIDES_FILM_TOLD | BESIDES_ALONG;
    const bool layers = std::any_of(material.layer_roles.begin(), material.layer_roles.end(),
                                    [](std::uint32_t role) { return role != 0; });
    return (material.besides & other) == 0 && !layers && material.own_surface == 0 &&
           material.second == SECOND_NONE && c.ior == 1.5f && c.specular_factor == 1.0f &&
           c.specular_color_factor == glm::vec3(1.0f);
}

// What of a material is not a matter of pipelines, textures and lists.
void GpuScene::set_material(std::size_t index, const Material& source)
{
    shared::MaterialConstants c = material_constants(source, loaded_);
    GpuMaterial& material = materials_[index];
    material.lighting_model = lighting_models_.number_of(lighting_model_of(source));
    c.lighting_model = material.lighting_model;
    material.layers = layers_of(source, lighting_model_of(source));
    // Its strands lie along the tangent.
    if ((material.layers & LAYERS_HAIR) != 0u) c.anisotropy_strength = 1.0f;
    material.besides = (source.specular_workflow ? BESIDES_SPECULAR_WORKFLOW : 0u) |
                       (source.iridescence <= 0.0f ? 0u : (material.layers & LAYERS_IRIDESCENT) != 0u ? BESIDES_FILM_TOLD : BESIDES_IRIDESCENT) |
                       ((material.layers & LAYERS_IRIDESCENT) != 0u && places_film(source) ? BESIDES_FILM_PLACED : 0u) |
                       (softens(source) ? BESIDES_SOFT_NORMAL : 0u) |
                       (c.anisotropy_strength > 0.0f ? BESIDES_ALONG : 0u) |
                       (one_read(source, c) ? BESIDES_ONE_READ : 0u) |
                       (wide_ground_[index] ? BESIDES_WIDE_GROUND : 0u);
    if (mirrors_as_glass(material, c)) material.besides |= BESIDES_AS_CLEARED;
    const glm::vec4& holds = c.water_accumulation;
    const glm::vec4& other = c.second_water_accumulation;
    material.sheds = std::max(holds.x, holds.z) <= 0.0f && std::max(other.x, other.z) <= 0.0f;
    material.water &= ~WATER_BEADS;
    if (material.water != 0 && source.weather.beads > 0.0f) material.water |= WATER_BEADS;
    if (material.layers != 0) c.lighting_model = set_layers(material, source);
    std::memcpy(constants_->mapped + index * constants_stride_, &c, sizeof(c));
    const glm::vec4 look[MATERIAL_LOOK_TEXELS] = {c.water_color,
                                                  {c.snow_opacity, c.transmission_factor, c.ior,
                                                   c.thickness_factor},
                                                  c.second_water_color,
                                                  {c.roughness_factor,
                                                   source.decal.received ? 1.0f : 0.0f, c.dispersion,
                                                   static_cast<float>((source.area_lights ? 0u : LOOK_POINT_LAMPS) |
                                                                      (source.receives_shadows ? 0u : LOOK_UNSHADOWED))}};
    std::memcpy(looks_->mapped + index * sizeof(look), look, sizeof(look));
    materials_[index].masked = source.alpha_mode == AlphaMode::Mask;
    materials_[index].blended = is_blended(source) && !source.decal.on;
    materials_[index].bends = materials_[index].blended && ((c.transmission_factor > 0.0f && (c.thickness_factor > 0.0f || c.roughness_factor > 0.08f)) ||
                                                            (materials_[index].water & WATER_BEADS) != 0);
    materials_[index].decal_weather = source.decal.weights.w > 0.0f;
    materials_[index].casts_shadows = source.casts_shadows;
    materials_[index].glows = source.emissive * source.emissive_strength != glm::vec3(0.0f);
}

// Layers have a row a material; the G-buffer numbers the rows behind the models.
std::uint32_t GpuScene::set_layers(GpuMaterial& material, const Material& m)
{
    // Of those that have a second lobe and nothing else one row tells all.
    const bool plain = material.layers == LAYERS_SECOND_LOBE;
    if (plain && second_lobe_row_ != 0) material.layers_row = second_lobe_row_;
    if (!plain && material.layers_row == second_lobe_row_) material.layers_row = 0;
    if (material.layers_row == 0) {
        if (lighting_models_.count() + layers_used_ > 255) {
            throw Error("scene: " + std::to_string(layers_used_ + 1) +
                            " materials with a coat, sheen, anisotropy, skin, hair or light that passes; at "
                            "most " +
                            std::to_string(256 - lighting_models_.count()) + " are possible",
                        "Merge materials that are alike.");
        }
        material.layers_row = ++layers_used_;
        if (plain) second_lobe_row_ = material.layers_row;
    }
    const std::size_t row = material.layers_row - 1;
    const glm::vec4 texels[LAYERS_TEXELS] = {
        {static_cast<float>(material.lighting_model), m.diffuse_transmission, m.clearcoat,
         m.clearcoat_roughness},
        glm::vec4(m.sheen_color, m.sheen_roughness),
        {m.anisotropy, m.scatter_bias, m.scatter_power, m.hair_shift},
        {m.translucency, m.translucency_power, m.translucency_distortion, m.translucency_scale},
        glm::vec4(m.translucency_color, m.translucency_shadow),
        glm::vec4(m.scatter_color, m.skin_curvature),
        {m.skin_curvature_scale, m.second.scatter_bias, m.second.scatter_power, mixes(m) ? 1.0f : 0.0f},
        glm::vec4(m.second.scatter_color, static_cast<float>(kind_of_shares(material.layer_roles))),
        {m.iridescence, m.iridescence_ior, has_grain(m) && !m.maps.iridescence_thickness.present() ? m.iridescence_thickness_max_nm : m.iridescence_thickness_min_nm,
         m.iridescence_thickness_max_nm},
        glm::vec4(m.diffuse_transmission_color, static_cast<float>((m.diffuse_transmission_of_base ? ROW_THROUGH_OF_BASE : 0u) |
                                                                (places_film(m) ? ROW_FILM_PLACED : 0u)))};
    std::memcpy(layers_->mapped + row * sizeof(texels), texels, sizeof(texels));
    return lighting_models_.count() + static_cast<std::uint32_t>(row);
}

std::uint32_t GpuScene::layered_model(std::uint32_t material) const
{
    const GpuMaterial& m = materials_[material];
    if (m.layers == 0 || m.layers_row == 0 || m.layers_row == second_lobe_row_) return 0;
    return lighting_models_.count() + m.layers_row - 1;
}

void GpuScene::sum_up_materials()
{
    const auto any = [this](auto&& is) {
        return std::any_of(current_.begin(), current_.end(), is);
    };
    // What a surface of a user's own sends out only its text knows.
    emissive_ = any([](const Material& m) {
        return m.emissive * m.emissive_strength != glm::vec3(0.0f) || !m.surface.empty();
    });
    layer_shares_ = false;
    for (std::size_t i = 0; i < current_.size(); ++i) {
        // A coat is as smooth as the mesh unless it has a normal map of its own.
        const Material& m = current_[i];
        const bool smooth_coat = m.clearcoat > 0.0f && m.normal_texture.present();
        const bool shown = materials_[i].layers != 0 && (materials_[i].light_textures || smooth_coat);
        const bool thick = tells_film(m) && has_grain(m) && m.maps.iridescence_thickness.present();
        layer_shares_ = layer_shares_ || shown || thick || softens(m);
    }
    light_maps_ = any([](const Material& m) { return m.light_map.present(); });
    decals_refused_ = !decals_.empty() && any([](const Material& m) { return !m.decal.received; });
    glows_ = glowing(glow_sources_, current_);
    point_lamps_ = any([](const Material& m) { return !m.area_lights; });
    unshadowed_ = any([](const Material& m) { return !m.receives_shadows; });
    two_sets_ = any([](const Material& m) {
        return m.second.use == scene::SecondSetUse::Mix &&
               (m.second.own_water || m.diffuse_transmission > 0.0f || m.translucency > 0.0f || scatters(m));
    });
    beads_ = any([](const Material& m) { return m.weather.beads > 0.0f; });
    constant_weather_ = any([](const Material& m) {
        const MaterialWeather& w = m.weather;
        const bool own = m.second.use == scene::SecondSetUse::Mix && m.second.own_water;
        const glm::vec4& other = m.second.water_accumulation;
        return (own && (other.x > 0.0f || other.z > 0.0f)) || w.water_accumulation.x > 0.0f || w.water_accumulation.z > 0.0f ||
               w.snow_accumulation.x > 0.0f;
    });
}

bool GpuScene::set_materials(const std::vector<MaterialChange>& changes)
{
    if (changes == changes_) return false;
    std::vector<std::size_t> touched;
    for (const MaterialChange& old : changes_) touched.push_back(old.material);
    for (const MaterialChange& change : changes) {
        const scene::MaterialProperty* row = scene::find_property(change.property);
        if (!row || !row->keyed || change.material >= sources_.size()) {
            throw Error("render: material " + std::to_string(change.material) + " of " +
                            std::to_string(sources_.size()) + " has no property \"" +
                            std::string(change.property) + "\" that a frame may change",
                        "Name a keyed row of the material table and a material of the scene.");
        }
        touched.push_back(change.material);
    }
    std::sort(touched.begin(), touched.end());
    touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
    std::vector<Material> before;
    for (const std::size_t index : touched)
        before.push_back(std::exchange(current_[index], sources_[index]));
    for (const MaterialChange& change : changes)
        scene::find_property(change.property)->set(current_[change.material], change.value);
    bool holes = false;
    for (std::size_t i = 0; i < touched.size(); ++i) {
        const Material& was = before[i];
        const Material& is = current_[touched[i]];
        set_material(touched[i], is);
        holes = holes || was.base_color.a != is.base_color.a ||
                was.alpha_cutoff != is.alpha_cutoff || was.transmission != is.transmission;
    }
    sum_up_materials();
    changes_ = changes;
    return holes;
}

}  // namespace petrichor::gpu
