#include "scene/material_table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <type_traits>
#include <utility>

#include "scene/detail/material_row.h"

namespace petrichor::scene {
namespace {

using namespace detail;

// glTF 2.0 and its KHR extensions. Ranges are those of their specifications.
void add_gltf_rows(std::vector<Row>& t)
{
    t.push_back(number<&M::base_color>("base_color_factor", 0, 1, {"", kPbr, "baseColorFactor"},
                                       "linear red, green, blue and alpha, times the texture"));
    t.push_back(number<&M::metallic>("metallic_factor", 0, 1, {"", kPbr, "metallicFactor"},
                                     "0 dielectric .. 1 metal, times the texture"));
    t.push_back(number<&M::roughness>("roughness_factor", 0, 1, {"", kPbr, "roughnessFactor"},
                                      "perceptual: 0 mirror .. 1 matt, times the texture"));
    t.push_back(number<&M::normal_scale>("normal_scale", -kLargest, kLargest,
                                         {"", "normalTexture", "scale"},
                                         "of the normal map's x and y; 0 flat"));
    t.push_back(number<&M::occlusion_strength>("occlusion_strength", 0, 1,
                                               {"", "occlusionTexture", "strength"},
                                               "of the occlusion map; 0 none"));
    t.push_back(choice<&M::occlusion_texture, &TextureUse::channel>(
        "occlusion_channel", {"r", "g", "b", "a"}, {kWeather, "", "occlusionChannel"},
        "channel of the occlusion map that is read: of Lux's combined map g, with translucency in b"));
    t.push_back(number<&M::emissive>("emissive_factor", 0, 1, {"", "", "emissiveFactor"},
                                     "linear red, green, blue, times the texture"));
    t.push_back(
        number<&M::emissive_strength>("emissive_strength", 0, kLargest,
                                      {"KHR_materials_emissive_strength", "", "emissiveStrength"},
                                      "radiance of emissive_factor 1; the sun gives 100000 lux"));
    t.push_back(choice<&M::alpha_mode>("alpha_mode", {"OPAQUE", "MASK", "BLEND"},
                                       {"", "", "alphaMode"},
                                       "what alpha does: nothing, cut out, let through"));
    t.push_back(number<&M::alpha_cutoff>("alpha_cutoff", 0, kLargest, {"", "", "alphaCutoff"},
                                         "MASK: less alpha than this is a hole"));
    t.push_back(flag<&M::premultiplied_alpha>(
        "premultiplied_alpha", {"", "extras", "premultipliedAlpha"},
        "BLEND: only the matt part fades with alpha, as of glass; false: reflections fade too"));
    t.push_back(flag<&M::area_lights>("area_lights", {"", "extras", "areaLights"},
                                      "lamps light it by their size; false: as points, which is cheaper"));
    t.push_back(flag<&M::casts_shadows>("casts_shadows", {"", "extras", "castShadows"},
                                        "of sun, sky and lamps; what lets light through casts in part"));
    t.push_back(flag<&M::receives_shadows>("receives_shadows", {"", "extras", "receiveShadows"},
                                           "of sun and lamps; false: they light it as if nothing stood before them"));
    t.push_back(
        flag<&M::double_sided>("double_sided", {"", "", "doubleSided"}, "back faces are seen too"));
    t.push_back(flag<&M::cull_front>("cull_front", {"", "extras", "cullFront"},
                                     "front faces are not seen: a shell from within"));
    t.push_back(or_also(
        number<&M::ior>("ior", 1, 100, {"KHR_materials_ior", "", "ior"},
                        "index of refraction; 0: as if infinite, specular_factor alone counts"),
        0.0f));
    t.push_back(number<&M::specular>("specular_factor", 0, 1,
                                     {"KHR_materials_specular", "", "specularFactor"},
                                     "times the reflectance of a dielectric"));
    t.push_back(number<&M::specular_color>("specular_color_factor", 0, kLargest,
                                           {"KHR_materials_specular", "", "specularColorFactor"},
                                           "linear tint of a dielectric's reflectance"));
    t.push_back(number<&M::diffuse_transmission>(
        "diffuse_transmission_factor", 0, 1,
        {"KHR_materials_diffuse_transmission", "", "diffuseTransmissionFactor"},
        "share of the diffuse light that thin things such as leaves let through"));
    t.push_back(number<&M::diffuse_transmission_color>(
        "diffuse_transmission_color_factor", 0, 1,
        {"KHR_materials_diffuse_transmission", "", "diffuseTransmissionColorFactor"},
        "linear colour of that light in place of the base colour, times its texture"));
    t.push_back(flag<&M::diffuse_transmission_of_base>(
        "diffuse_transmission_of_base", {kWeather, "", "diffuseTransmissionOfBase"},
        "it has the base colour, with those of the vertices and the weather on it, whatever its own is"));
    t.push_back(number<&M::transmission>(
        "transmission_factor", 0, 1, {"KHR_materials_transmission", "", "transmissionFactor"},
        "light that passes: what is behind shows, tinted, blurred by the roughness"));
    t.push_back(number<&M::thickness>(
        "thickness_factor", 0, kLargest, {"KHR_materials_volume", "", "thicknessFactor"},
        "of the body below the surface, metres: bends what is seen through it; 0: a thin pane"));
    t.push_back(number<&M::attenuation_distance_m>(
        "attenuation_distance", 0, kLargest, {"KHR_materials_volume", "", "attenuationDistance"},
        "metres in the body after which attenuation_color is left of white light; 0: it is clear"));
    t.push_back(number<&M::attenuation_color>(
        "attenuation_color", 0, 1, {"KHR_materials_volume", "", "attenuationColor"},
        "linear; see attenuation_distance"));
    t.push_back(number<&M::dispersion>(
        "dispersion", 0, kLargest, {"KHR_materials_dispersion", "", "dispersion"},
        "of a body: 20 / Abbe number; colours are bent apart"));
    t.push_back(flag<&M::specular_workflow>(
        "specular_workflow", {kWeather, "", "specularWorkflow"},
        "workflow_specular_factor and glossiness_factor instead of metallic and roughness; the base "
        "colour is that of the diffuse light; KHR_materials_pbrSpecularGlossiness"));
    t.push_back(number<&M::workflow_specular>("workflow_specular_factor", 0, 1,
                                              {kSpecularGlossiness, "", "specularFactor"},
                                              "linear reflectance at normal incidence"));
    t.push_back(number<&M::glossiness>("glossiness_factor", 0, 1,
                                       {kSpecularGlossiness, "", "glossinessFactor"},
                                       "0 matt .. 1 mirror"));
    t.push_back(number<&M::iridescence>("iridescence_factor", 0, 1,
                                        {kIridescence, "", "iridescenceFactor"},
                                        "how strongly a thin film colours what is mirrored"));
    t.push_back(number<&M::iridescence_ior>("iridescence_ior", 1, 10,
                                            {kIridescence, "", "iridescenceIor"},
                                            "index of refraction of the film"));
    t.push_back(number<&M::iridescence_thickness_min_nm>(
        "iridescence_thickness_minimum", 0, kLargest,
        {kIridescence, "", "iridescenceThicknessMinimum"}, "nanometres where its texture is 0"));
    t.push_back(number<&M::iridescence_thickness_max_nm>(
        "iridescence_thickness_maximum", 0, kLargest,
        {kIridescence, "", "iridescenceThicknessMaximum"},
        "nanometres where its texture is 1, or is none"));
    t.push_back(number<&M::clearcoat_normal_scale>(
        "clearcoat_normal_scale", -kLargest, kLargest,
        {"KHR_materials_clearcoat", "clearcoatNormalTexture", "scale"},
        "of the x and y of the coat's normal map; 0 flat"));
    t.push_back(number<&M::clearcoat>("clearcoat_factor", 0, 1,
                                                 {"KHR_materials_clearcoat", "", "clearcoatFactor"},
                                                 "strength of a clear coat"));
    t.push_back(
        number<&M::clearcoat_roughness>("clearcoat_roughness_factor", 0, 1,
                                        {"KHR_materials_clearcoat", "", "clearcoatRoughnessFactor"},
                                        "perceptual roughness of the clear coat"));
    t.push_back(number<&M::sheen_color>(
        "sheen_color_factor", 0, 1, {"KHR_materials_sheen", "", "sheenColorFactor"},
        "linear colour of cloth fibres at grazing angles"));
    t.push_back(number<&M::sheen_roughness>(
        "sheen_roughness_factor", 0, 1, {"KHR_materials_sheen", "", "sheenRoughnessFactor"},
        "perceptual roughness of the sheen"));
    t.push_back(number<&M::anisotropy>(
        "anisotropy_strength", 0, 1, {"KHR_materials_anisotropy", "", "anisotropyStrength"},
        "0 round highlight .. 1 stretched along the tangent"));
    t.push_back(number<&M::anisotropy_rotation_rad>(
        "anisotropy_rotation", -kLargest, kLargest,
        {"KHR_materials_anisotropy", "", "anisotropyRotation"},
        "radians, of the stretch from the tangent towards the bitangent"));
    t.push_back(flag<&M::unlit>("unlit", {"KHR_materials_unlit", "", ""},
                                "shows its base colour whatever the light"));
}

// Light that comes through, fibres at the rim, skin and hair: Lux 2.02's, with its ranges.
void add_light_rows(std::vector<Row>& t)
{
    const auto place = [](std::string_view member) { return GltfPlace{kWeather, "", member}; };
    t.push_back(number<&M::translucency>(
        "translucency", 0, 1, place("translucency"),
        "light that comes through thick and thin things towards the eye: leaves, wax, ears"));
    t.push_back(number<&M::translucency_power>(
        "translucency_power", 0, 8, place("translucencyPower"),
        "how narrow its glow around the lamp is; 0: wrapped around, for leaves"));
    t.push_back(number<&M::translucency_distortion>("translucency_distortion", 0, 1,
                                                    place("translucencyDistortion"),
                                                    "how far normals bend what comes through"));
    t.push_back(number<&M::translucency_scale>("translucency_scale", 0, 8, place("translucencyScale"),
                                               "times what comes through; 8 adds light, 1 does not"));
    t.push_back(number<&M::translucency_shadow>(
        "translucency_shadow", 0, 1, place("translucencyShadow"),
        "how dark shadows on it are for what comes through; 1: as for all else"));
    t.push_back(number<&M::translucency_color>(
        "translucency_color", 0, 1, place("translucencyColor"),
        "linear tint of what comes through, times the surface's colour; alone of skin"));
    t.push_back(number<&M::scatter_color>("scatter_color", 0, 1, place("scatterColor"),
                                          "linear colour of fibres at the rim (velvet, peach, moss)"));
    t.push_back(number<&M::scatter_bias>("scatter_bias", 0, 0.5f, place("scatterBias"),
                                         "how much of it is everywhere"));
    t.push_back(number<&M::scatter_power>("scatter_power", 1, 10, place("scatterPower"),
                                          "how narrow the rim is"));
    t.push_back(number<&M::skin_curvature>(
        "skin_curvature", 0, 1, place("skinCurvature"),
        "of lighting_model \"skin\": 0 flat, red does not bleed .. 1 as round as a finger"));
    t.push_back(number<&M::skin_curvature_scale>(
        "skin_curvature_scale", 0, 1, place("skinCurvatureScale"),
        "of \"skin\": metres times the bend of the normals a metre, added to it; Lux has 0.02"));
    t.push_back(number<&M::skin_blur>(
        "skin_blur", 0, 1, place("skinBlur"),
        "of \"skin\": how far its normal map is blurred for diffuse light; Lux has 1"));
    t.back().keyed = false;
    t.push_back(channel<&M::maps, &Maps::translucency, &TextureUse::channel>(
        "translucency_channel", "translucencyTexture", "channel of the translucency map that is read"));
    t.push_back(channel<&M::maps, &Maps::skin_curvature, &TextureUse::channel>(
        "skin_curvature_channel", "skinCurvatureTexture", "channel of the curvature map that is read"));
    t.push_back(number<&M::vertex_occlusion>(
        "vertex_occlusion", 0, 1, place("vertexOcclusion"),
        "how far green of COLOR_0 darkens light from all around too: roots of hair, feet of grass"));
    t.push_back(number<&M::hair_shift>(
        "hair_shift", 0, 0.3f, place("hairShift"),
        "of lighting_model \"hair\": radians by which its highlights are tilted apart"));
}

// Lux 2.02, "per material": symbols, ranges and defaults.
void add_weather_rows(std::vector<Row>& t)
{
    const auto place = [](std::string_view member) { return GltfPlace{kWeather, "", member}; };
    t.push_back(number<&M::light_map_scale>("light_map_scale", 0, kLargest, place("lightMapScale"),
                                            "lux that a texel of 1 of the light map brings"));
    t.push_back(number<&M::light_map_sky>(
        "light_map_sky", 0, 1, place("lightMapSky"),
        "share of the sky's diffuse light on top of the light map: 1 it holds lamps alone .. 0 it "
        "holds the sky too"));
    t.push_back(number<&M::weather, &W::porosity>(
        "porosity", 0, 1, place("porosity"),
        "0 dense (metal, glaze) .. 1 porous (brick, soil): how much darker when wet; -1: from the "
        "roughness"));
    t.back().also = -1.0f;
    t.push_back(or_also(
        number<&M::weather, &W::film>(
            "film", 0, 1, place("film"),
            "how far a film of water shows: 1 on stone .. 0 never; -1: by the name, 0.35 on grass, lawn, "
            "meadow, leaves, needles, foliage and hedge, which look every way, 1 on all else"),
        -1.0f));
    t.push_back(or_also(
        number<&M::weather, &W::beads>(
            "beads", 0, 1, place("beads"),
            "how far water stands in beads and runs down in drops, in place of a film: 1 on glass, paint and "
            "polish .. 0 on stone; what is porous has none; -1: 1 on clear glass, on what has a clear coat, and on a "
            "model that is small enough to be seen from near, 0 on all else"),
        -1.0f));
    t.push_back(choice<&M::weather, &W::wetness>(
        "wetness", {"none", "simple", "ripples", "flow", "full"}, place("wetness"),
        "standing water: none, flat, with rings of drops, with flowing waves, with both"));
    t.push_back(channel<&M::weather, &W::height, &TextureUse::channel>(
        "height_channel", "heightTexture", "channel of the height map that is read"));
    t.push_back(channel<&M::weather, &W::puddle_mask, &TextureUse::channel>(
        "puddle_mask_channel", "puddleMaskTexture", "channel of the puddle mask that is read"));
    t.push_back(channel<&M::weather, &W::snow_mask, &TextureUse::channel>(
        "snow_mask_channel", "snowMaskTexture", "channel of the snow mask that is read"));
    t.push_back(number<&M::weather, &W::height_scale_m>(
        "height_scale_m", 0, 10, place("heightScale"),
        "height 1 of the height map above height 0, metres; seen by parallax"));
    t.push_back(choice<&M::weather, &W::parallax>(
        "parallax", {"none", "simple", "occlusion"}, place("parallax"),
        "the height map's relief as seen: none, by two look-ups, by a ray through it"));
    t.push_back(number<&M::weather, &W::parallax_steps>(
        "parallax_steps", 4, 64, place("parallaxSteps"), "of the ray of parallax = \"occlusion\""));
    t.push_back(or_also(
        number<&M::weather, &W::parallax_level>(
            "parallax_level", 0, 16, place("parallaxLevel"),
            "level of the height map that parallax reads; -1: by how large a pixel is there"),
        -1.0f));
    t.back().keyed = false;
    t.push_back(number<&M::weather, &W::default_height>(
        "default_height", 0, 1, place("defaultHeight"),
        "height where the material has no height map: 0 low .. 1 high; low places fill first"));
    t.push_back(number<&M::weather, &W::hollow_tiling>(
        "hollow_tiling", 0.05f, 50, place("hollowTiling"),
        "how many times narrower than a step the hollows are that water stands in, where the material has no height map"));
    t.push_back(number<&M::weather, &W::water_slope_damp>(
        "water_slope_damp", 0, 1, place("waterSlopeDamp"),
        "0 water stays on any slope .. 1 the less the steeper, none on walls"));
    t.push_back(number<&M::weather, &W::water_accumulation>(
        "water_accumulation", glm::vec4(0.0f), {2.0f, 4.0f, 2.0f, 4.0f}, place("waterAccumulation"),
        "cracks: constant, influence of the weather; puddles: constant, influence"));
    t.push_back(number<&M::weather, &W::water_color>(
        "water_color", 0, 1, place("waterColor"),
        "linear red, green, blue and opacity of standing water (mud, leaves)"));
    t.push_back(number<&M::weather, &W::ripple_refraction>(
        "ripple_refraction", 0, 1, place("rippleRefraction"),
        "how far ripples shift what lies below, times the weather's own; 0: not at all"));
    t.push_back(number<&M::weather, &W::flow_tiling>("flow_tiling", 0, 1000, place("flowTiling"),
                                                     "repeats of the flowing water per metre"));
    t.push_back(number<&M::weather, &W::flow_speed>("flow_speed", 0, 2, place("flowSpeed"),
                                                    "speed of water that runs down"));
    t.push_back(
        number<&M::weather, &W::flow_interval_s>("flow_interval_s", 0, 8, place("flowInterval"),
                                                 "seconds between two waves of flow; 0: still"));
    t.push_back(number<&M::weather, &W::flow_refraction>(
        "flow_refraction", 0, 0.1f, place("flowRefraction"),
        "how far flowing water shifts what lies below, in texture coordinates a slope"));
    t.push_back(number<&M::weather, &W::flow_normal_strength>(
        "flow_normal_strength", 0, 2, place("flowNormalStrength"), "bumpiness of flowing water"));
    t.push_back(number<&M::weather, &W::snow_slope_damp>(
        "snow_slope_damp", 0, 8, place("snowSlopeDamp"), "how fast snow thins out on slopes"));
    t.push_back(number<&M::weather, &W::snow_accumulation>(
        "snow_accumulation", glm::vec4(0.0f), {2.0f, 4.0f, 0.0f, 0.0f}, place("snowAccumulation"),
        "snow: constant, influence of the weather"));
    t.push_back(number<&M::weather, &W::snow_normal_strength>(
        "snow_normal_strength", 0, 2, place("snowNormalStrength"), "bumpiness of the snow"));
    t.push_back(number<&M::weather, &W::snow_detail_strength>(
        "snow_detail_strength", 0, 1, place("snowDetailStrength"),
        "bumpiness of the snow's fine detail, near the camera"));
    t.push_back(number<&M::weather, &W::snow_opacity>(
        "snow_opacity", 0, 1, place("snowOpacity"),
        "how much of the light that glows below the snow swallows"));
    t.push_back(choice<&M::weather, &W::snow_rule>(
        "snow_rule", {"surface", "grass", "vertex"}, place("snowRule"),
        "how snow lies: by slope, height and masks; on blades, the lighter COLOR_0 the more; by slope "
        "alone"));
    t.push_back(choice<&M::weather, &W::snow_mapping>(
        "snow_mapping", {"world", "local"}, place("snowMapping"),
        "the maps of the snow are laid over the world from above, or along the texture coordinates"));
    t.push_back(number<&M::weather, &W::snow_local_tiling>(
        "snow_local_tiling", 0, 1000, place("snowLocalTiling"),
        "of snow_mapping = \"local\": repeats a texture coordinate of relief, detail, where it lies, "
        "detail of that"));
    t.push_back(number<&M::weather, &W::snow_mask_normal_scale>(
        "snow_mask_normal_scale", -kLargest, kLargest, {kWeather, "snowMaskNormalTexture", "scale"},
        "of the x and y of what is trodden into the snow"));
    t.push_back(flag<&M::weather, &W::sheltered>("sheltered", place("sheltered"),
                                                 "an interior: never gets rain or snow"));
}

// The shortest decimal that reads back as the same float.
std::string float_text(float value)
{
    char text[32];
    const auto end = std::to_chars(std::begin(text), std::end(text), value).ptr;
    return {text, end};
}

// "clearcoat_factor is set by 3 materials (paint, ...)".
std::string counted(std::size_t count, const std::string& thing, const std::string& first)
{
    std::string text = std::to_string(count) + " " + thing + (count == 1 ? " (" : "s (") + first;
    return text + (count == 1 ? ")" : ", ...)");
}

void add_mesh_masks(const Scene& scene, std::vector<std::string>& lines)
{
    std::size_t count = 0;
    std::string first;
    for (const Mesh& mesh : scene.meshes) {
        const bool mixes = std::any_of(
            mesh.primitives.begin(), mesh.primitives.end(), [&](const Primitive& primitive) {
                if (scene.materials[primitive.material].second.use == SecondSetUse::Mix) return false;
                return std::any_of(primitive.weather.begin(), primitive.weather.end(),
                                   [](const glm::vec4& mask) { return mask.x < 1.0f; });
            });
        if (mixes && count++ == 0) first = mesh.name;
    }
    if (count == 0) return;
    lines.push_back("red of _WEATHER, which mixes two sets of textures, is below 1 in " +
                    counted(count, "mesh", first) + ": shown where second_set = \"mix\"");
}

}  // namespace

bool MaterialProperty::accepts(int component, float value) const
{
    // Written so that NaN fails.
    return value == also || (value >= low[component] && value <= high[component]);
}

std::string MaterialProperty::range_text(int component) const
{
    std::string text = "any number";
    if (high[component] < kLargest) {
        text = float_text(low[component]) + " to " + float_text(high[component]);
    } else if (low[component] > -kLargest) {
        text = float_text(low[component]) + " or more";
    }
    return std::isnan(also) ? text : text + ", or " + float_text(also);
}

const std::vector<MaterialProperty>& material_table()
{
    static const std::vector<MaterialProperty> table = [] {
        std::vector<MaterialProperty> rows;
        add_gltf_rows(rows);
        add_light_rows(rows);
        add_weather_rows(rows);
        add_second_set_rows(rows);
        add_ground_layer_rows(rows);
        add_decal_rows(rows);
        add_wind_rows(rows);
        add_displacement_rows(rows);
        return rows;
    }();
    return table;
}

std::string MaterialProperty::value_text(const glm::vec4& value) const
{
    if (kind == PropertyKind::Flag) return value.x != 0.0f ? "true" : "false";
    if (kind == PropertyKind::Choice) {
        return '"' + std::string(words[static_cast<std::size_t>(value.x)]) + '"';
    }
    if (count == 1) return float_text(value.x);
    std::string text = "[";
    for (int i = 0; i < count; ++i) text += (i == 0 ? "" : ", ") + float_text(value[i]);
    return text + "]";
}

const MaterialProperty* find_property(std::string_view name)
{
    const auto& table = material_table();
    const auto found = std::find_if(table.begin(), table.end(),
                                    [&](const MaterialProperty& p) { return p.name == name; });
    return found == table.end() ? nullptr : &*found;
}

glm::vec4 default_value(const MaterialProperty& property)
{
    return property.get(Material{});
}

const std::vector<MaterialTexture>& material_textures()
{
    static const std::vector<MaterialTexture> table = [] {
        std::vector<MaterialTexture> rows{
        texture<&M::base_color_texture>("base_color_texture", {"", kPbr, "baseColorTexture"},
                                        "sRGB colour, alpha"),
        texture<&M::metallic_roughness_texture>("metallic_roughness_texture",
                                                {"", kPbr, "metallicRoughnessTexture"},
                                                "green roughness, blue metallic"),
        texture<&M::normal_texture>("normal_texture", {"", "", "normalTexture"},
                                    "tangent space, green up"),
        texture<&M::occlusion_texture>("occlusion_texture", {"", "", "occlusionTexture"},
                                       "1 open .. 0 hidden from the sky; occlusion_channel"),
        texture<&M::emissive_texture>("emissive_texture", {"", "", "emissiveTexture"},
                                      "sRGB colour"),
        texture<&M::light_map>("light_map_texture", {kWeather, "", "lightMapTexture"},
                               "baked light over the second coordinates: EXR and HDR as they are, "
                               "8 bits with alpha as RGBM (times alpha times 8), else sRGB"),
        texture<&M::weather, &W::height>("height_texture", {kWeather, "", "heightTexture"},
                                         "0 low .. 1 high; height_channel"),
        texture<&M::weather, &W::puddle_mask>("puddle_mask_texture",
                                              {kWeather, "", "puddleMaskTexture"},
                                              "1 puddles may stand, 0 never; puddle_mask_channel"),
        texture<&M::weather, &W::snow_mask>("snow_mask_texture", {kWeather, "", "snowMaskTexture"},
                                            "1 snow may lie, 0 never; snow_mask_channel"),
        texture<&M::weather, &W::snow_mask_normal>(
            "snow_mask_normal_texture", {kWeather, "", "snowMaskNormalTexture"},
            "tangent space, green up: footprints and tyre tracks, seen where the snow mask is below 1"),
        };
        add_layer_textures(rows);
        add_second_set_textures(rows);
        return rows;
    }();
    return table;
}

GltfPlace lighting_model_place()
{
    return {kWeather, "", "lightingModel"};
}

GltfPlace surface_place()
{
    return {kWeather, "", "surface"};
}

GltfPlace diffuse_color_place()
{
    return {kSpecularGlossiness, "", "diffuseFactor"};
}

GltfPlace diffuse_texture_place()
{
    return {kSpecularGlossiness, "", "diffuseTexture"};
}

GltfPlace first_lobe_normal_place()
{
    return {kTwoLobes, "", "normalTexture"};
}

GltfPlace first_lobe_roughness_place()
{
    return {kTwoLobes, "", "metallicRoughnessTexture"};
}

std::vector<std::string_view> extension_members(std::string_view extension)
{
    std::vector<std::string_view> members;
    if (extension == kTwoLobes) {
        members.push_back(first_lobe_normal_place().member);
        members.push_back(first_lobe_roughness_place().member);
    }
    if (extension == kSpecularGlossiness) {
        members.push_back(diffuse_color_place().member);
        members.push_back(diffuse_texture_place().member);
    }
    if (extension == kWeather) {
        members.push_back(lighting_model_place().member);
        members.push_back(surface_place().member);
    }
    for (const MaterialTexture& t : material_textures()) {
        if (t.gltf.extension == extension) members.push_back(t.gltf.member);
    }
    for (const MaterialProperty& p : material_table()) {
        // What lies inside a texture's object is not a member of the extension.
        if (p.gltf.extension == extension && p.gltf.parent.empty()) {
            members.push_back(p.gltf.member);
        }
    }
    return members;
}

std::vector<std::string> unshaded_properties(const Scene& scene)
{
    std::vector<std::string> lines;
    for (const MaterialProperty& property : material_table()) {
        if (property.shaded) continue;
        std::size_t count = 0;
        std::string first;
        for (const Material& material : scene.materials) {
            if (property.get(material) == default_value(property)) continue;
            if (count++ == 0) first = material.name;
        }
        if (count == 0) continue;
        lines.push_back(std::string(property.name) + " is set by " +
                        counted(count, "material", first) + ": not shaded yet");
    }
    add_layer_limits(scene, lines);
    add_mesh_masks(scene, lines);
    return lines;
}

}  // namespace petrichor::scene
