#include <algorithm>

#include "scene/detail/material_row.h"

namespace petrichor::scene::detail {

void add_layer_textures(std::vector<MaterialTexture>& t)
{
    constexpr std::string_view kCoat = "KHR_materials_clearcoat";
    constexpr std::string_view kSheen = "KHR_materials_sheen";
    constexpr std::string_view kSpecular = "KHR_materials_specular";
    t.push_back(texture<&M::maps, &Maps::clearcoat>(
        "clearcoat_texture", {kCoat, "", "clearcoatTexture"}, "red: times clearcoat_factor"));
    t.push_back(texture<&M::maps, &Maps::clearcoat_roughness>(
        "clearcoat_roughness_texture", {kCoat, "", "clearcoatRoughnessTexture"},
        "green: times clearcoat_roughness_factor"));
    t.push_back(texture<&M::maps, &Maps::clearcoat_normal>(
        "clearcoat_normal_texture", {kCoat, "", "clearcoatNormalTexture"},
        "tangent space, green up: of the coat alone; without one it is as the mesh"));
    t.push_back(texture<&M::maps, &Maps::sheen_color>("sheen_color_texture",
                                                   {kSheen, "", "sheenColorTexture"}, "sRGB colour"));
    t.push_back(texture<&M::maps, &Maps::sheen_roughness>(
        "sheen_roughness_texture", {kSheen, "", "sheenRoughnessTexture"},
        "alpha: times sheen_roughness_factor"));
    t.push_back(texture<&M::maps, &Maps::anisotropy>(
        "anisotropy_texture", {"KHR_materials_anisotropy", "", "anisotropyTexture"},
        "red and green: direction in the tangent frame, before anisotropy_rotation; blue: times "
        "anisotropy_strength"));
    t.push_back(texture<&M::maps, &Maps::diffuse_transmission>(
        "diffuse_transmission_texture",
        {"KHR_materials_diffuse_transmission", "", "diffuseTransmissionTexture"},
        "alpha: times diffuse_transmission_factor"));
    t.push_back(texture<&M::maps, &Maps::diffuse_transmission_color>(
        "diffuse_transmission_color_texture",
        {"KHR_materials_diffuse_transmission", "", "diffuseTransmissionColorTexture"},
        "sRGB colour of what comes through"));
    t.push_back(texture<&M::maps, &Maps::transmission>(
        "transmission_texture", {"KHR_materials_transmission", "", "transmissionTexture"},
        "red: times transmission_factor"));
    t.push_back(texture<&M::maps, &Maps::thickness>(
        "thickness_texture", {"KHR_materials_volume", "", "thicknessTexture"},
        "green: times thickness_factor"));
    t.push_back(texture<&M::maps, &Maps::specular>("specular_texture",
                                                {kSpecular, "", "specularTexture"},
                                                "alpha: times specular_factor"));
    t.push_back(texture<&M::maps, &Maps::specular_color>(
        "specular_color_texture", {kSpecular, "", "specularColorTexture"}, "sRGB colour"));
    t.push_back(texture<&M::maps, &Maps::iridescence>(
        "iridescence_texture", {kIridescence, "", "iridescenceTexture"},
        "red: times iridescence_factor"));
    t.push_back(texture<&M::maps, &Maps::iridescence_thickness>(
        "iridescence_thickness_texture", {kIridescence, "", "iridescenceThicknessTexture"},
        "green: 0 the least thickness .. 1 the most"));
    t.push_back(texture<&M::maps, &Maps::specular_glossiness>(
        "specular_glossiness_texture", {kSpecularGlossiness, "", "specularGlossinessTexture"},
        "of specular_workflow: sRGB reflectance, alpha smoothness"));
    t.push_back(texture<&M::maps, &Maps::translucency>(
        "translucency_texture", {kWeather, "", "translucencyTexture"},
        "times translucency; translucency_channel"));
    t.push_back(texture<&M::maps, &Maps::skin_curvature>(
        "skin_curvature_texture", {kWeather, "", "skinCurvatureTexture"},
        "times skin_curvature; skin_curvature_channel"));
    t.push_back(texture<&M::maps, &Maps::second_lobe>(
        "second_lobe_texture", {kTwoLobes, "", "secondLobeTexture"},
        "red and green normal, blue roughness, alpha share of what shines: a second lobe of each texel, written by "
        "texture build --lobes 2"));
}

namespace {

std::size_t layer_textures(const Material& material)
{
    std::vector<MaterialTexture> rows;
    add_layer_textures(rows);
    const GroundLayer& third = material.second.third;
    const GroundLayer& fourth = material.second.fourth;
    const TextureUse* of_ground[] = {&third.base_color_texture,  &third.normal_texture,
                                     &third.metallic_roughness_texture, &fourth.base_color_texture,
                                     &fourth.normal_texture,     &fourth.metallic_roughness_texture};
    return static_cast<std::size_t>(
        std::count_if(rows.begin(), rows.end(),
                      [&](const MaterialTexture& t) { return t.get(material).present(); }) +
        std::count_if(std::begin(of_ground), std::end(of_ground),
                      [](const TextureUse* use) { return use->present(); }));
}

}  // namespace

void add_layer_limits(const Scene& scene, std::vector<std::string>& lines)
{
    for (const Material& material : scene.materials) {
        const std::size_t count = layer_textures(material);
        if (count > kMostLayerTextures) {
            lines.push_back("material " + material.name + " has " + std::to_string(count) +
                            " textures of layers; " + std::to_string(kMostLayerTextures) +
                            " are shown, in the order of the table");
        }
        if (material.second.use == SecondSetUse::Layers && !material.second.mix_mask.present()) {
            lines.push_back("material " + material.name +
                            " is ground of layers without weights (mix_mask_texture): the first is seen alone");
        }
        const LayerTextures& m = material.maps;
        const bool lets_through = material.alpha_mode == AlphaMode::Blend || material.transmission > 0;
        const TextureUse* of_solids[] = {&m.clearcoat,       &m.clearcoat_roughness, &m.clearcoat_normal,
                                         &m.sheen_color,     &m.sheen_roughness,
                                         &m.diffuse_transmission, &m.diffuse_transmission_color, &m.translucency, &m.skin_curvature,
                                         &m.second_lobe};
        if (lets_through && std::any_of(std::begin(of_solids), std::end(of_solids),
                                        [](const TextureUse* use) { return use->present(); })) {
            lines.push_back("material " + material.name +
                            " lets light through: of its coat, sheen and so on the factors are shown, "
                            "not their textures");
        }
        // One of these three has room beside the rest.
        const bool through = m.diffuse_transmission_color.present() && !material.diffuse_transmission_of_base;
        const bool sheen = m.sheen_color.present() || m.sheen_roughness.present();
        if (through && m.second_lobe.present())
            lines.push_back("material " + material.name + " has a second lobe: diffuse_transmission_color_texture is left out");
        else if (through && sheen)
            lines.push_back("material " + material.name + " has diffuse_transmission_color_texture: the textures of its sheen are left out");
    }
}

}  // namespace petrichor::scene::detail
