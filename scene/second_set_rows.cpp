#include "scene/detail/material_row.h"

namespace petrichor::scene::detail {

using S = SecondSet;

// Lux 2.02, "mix mapping" and "detail".
void add_second_set_rows(std::vector<Row>& t)
{
    const auto place = [](std::string_view member) { return GltfPlace{kWeather, "", member}; };
    t.push_back(choice<&M::second, &S::use>(
        "second_set", {"none", "mix", "detail", "layers"}, place("secondSet"),
        "second textures: unused, another material mixed with the first, or fine detail on it: its "
        "colour doubled in sRGB codes (128 leaves the first as it is), within detail_distance_m; layers: "
        "first, second, third and fourth are the grounds of a terrain, red, green, blue and alpha of "
        "mix_mask_texture their weights"));
    t.push_back(number<&M::second, &S::mix_factor>(
        "mix_factor", 0, 1, place("mixFactor"),
        "1 the first set .. 0 the second, times red of _WEATHER and the mask; with heights the higher "
        "set wins. Of detail: its strength, times the mask"));
    t.push_back(number<&M::second, &S::mix_mask_tiling>(
        "mix_mask_tiling", 0, 1000, place("mixMaskTiling"), "repeats of the mask, times its own"));
    t.push_back(channel<&M::second, &S::mix_mask, &TextureUse::channel>(
        "mix_mask_channel", "mixMaskTexture", "channel of the mask that is read"));
    t.push_back(number<&M::second, &S::tiling>("second_tiling", 0, 1000, place("secondTiling"),
                                               "repeats of the second set's textures, times their own"));
    t.push_back(number<&M::second, &S::color>("second_color_factor", 0, 1, place("secondColorFactor"),
                                              "linear red, green and blue, times the second texture"));
    t.push_back(number<&M::second, &S::metallic>(
        "second_metallic_factor", 0, 1, place("secondMetallicFactor"),
        "0 dielectric .. 1 metal, times the second texture; of mix alone"));
    t.push_back(number<&M::second, &S::roughness>(
        "second_roughness_factor", 0, 1, place("secondRoughnessFactor"),
        "perceptual: 0 mirror .. 1 matt, times the second texture; of mix alone"));
    t.push_back(or_also(
        number<&M::second, &S::specular>("second_specular_factor", 0, 1, place("secondSpecularFactor"),
                                         "as specular_factor, of the second set; -1: as the first"),
        -1.0f));
    t.push_back(number<&M::second, &S::normal_scale>(
        "second_normal_scale", -kLargest, kLargest, {kWeather, "secondNormalTexture", "scale"},
        "of the second normal map's x and y; 0 flat"));
    t.push_back(flag<&M::second, &S::occlusion_in_alpha>(
        "second_occlusion_in_alpha", place("secondOcclusionInAlpha"),
        "alpha of the second base colour texture is its occlusion, as in Lux; false: red of the second "
        "packed texture is; of mix alone"));
    t.push_back(number<&M::second, &S::scatter_color>(
        "second_scatter_color", 0, 1, place("secondScatterColor"),
        "as scatter_color, of the second set; of mix alone"));
    t.push_back(number<&M::second, &S::scatter_bias>("second_scatter_bias", 0, 0.5f,
                                                     place("secondScatterBias"),
                                                     "as scatter_bias, of the second set"));
    t.push_back(number<&M::second, &S::scatter_power>("second_scatter_power", 1, 10,
                                                      place("secondScatterPower"),
                                                      "as scatter_power, of the second set"));
    t.push_back(channel<&M::second, &S::height, &TextureUse::channel>(
        "second_height_channel", "secondHeightTexture", "channel of the second height map"));
    t.push_back(flag<&M::second, &S::own_water>(
        "second_own_water", place("secondOwnWater"),
        "water on the second set follows the two keys below, not those of the first"));
    t.push_back(number<&M::second, &S::water_accumulation>(
        "second_water_accumulation", glm::vec4(0.0f), {2.0f, 4.0f, 2.0f, 4.0f},
        place("secondWaterAccumulation"), "as water_accumulation, of the second set"));
    t.push_back(number<&M::second, &S::water_color>("second_water_color", 0, 1,
                                                    place("secondWaterColor"),
                                                    "as water_color, of the second set"));
}

// Lux 2.02, "terrain": what the first two layers have is said above.
void add_ground_layer_rows(std::vector<Row>& t)
{
    using G = GroundLayer;
    const auto place = [](std::string_view member) { return GltfPlace{kWeather, "", member}; };
    t.push_back(number<&M::second, &S::third, &G::tiling>(
        "third_tiling", 0, 10000, place("thirdTiling"), "of layers: repeats of the third's textures, times their own"));
    t.push_back(number<&M::second, &S::third, &G::color>(
        "third_color_factor", 0, 1, place("thirdColorFactor"), "of layers: linear, times the third's texture"));
    t.push_back(number<&M::second, &S::third, &G::roughness>(
        "third_roughness_factor", 0, 1, place("thirdRoughnessFactor"), "of layers: times green of the third's packed texture"));
    t.push_back(number<&M::second, &S::fourth, &G::tiling>(
        "fourth_tiling", 0, 10000, place("fourthTiling"), "of layers: repeats of the fourth's textures, times their own"));
    t.push_back(number<&M::second, &S::fourth, &G::color>(
        "fourth_color_factor", 0, 1, place("fourthColorFactor"), "of layers: linear, times the fourth's texture"));
    t.push_back(number<&M::second, &S::fourth, &G::roughness>(
        "fourth_roughness_factor", 0, 1, place("fourthRoughnessFactor"), "of layers: times green of the fourth's packed texture"));
    t.push_back(number<&M::second, &S::by_height>(
        "layers_by_height", 0, 1, place("layersByHeight"),
        "of layers: 0 blended by weight, as in Lux .. 1 what stands higher (blue of its colour texture) wins"));
    t.push_back(number<&M::second, &S::far_start_m>(
        "far_start_m", 0, 1.0e6f, place("farStart"), "of layers: from here on they fade to far_texture"));
    t.push_back(number<&M::second, &S::far_fade_m>(
        "far_fade_m", 0, 1.0e6f, place("farFade"), "of layers: metres that the fade takes"));
}

void add_second_set_textures(std::vector<MaterialTexture>& t)
{
    const auto place = [](std::string_view member) { return GltfPlace{kWeather, "", member}; };
    t.push_back(texture<&M::second, &S::third, &GroundLayer::base_color_texture>(
        "third_base_color_texture", place("thirdBaseColorTexture"), "of layers: sRGB colour; blue: height"));
    t.push_back(texture<&M::second, &S::third, &GroundLayer::normal_texture>(
        "third_normal_texture", place("thirdNormalTexture"), "of layers: tangent space, green up"));
    t.push_back(texture<&M::second, &S::third, &GroundLayer::metallic_roughness_texture>(
        "third_metallic_roughness_texture", place("thirdMetallicRoughnessTexture"),
        "of layers: red occlusion, green roughness, blue metallic"));
    t.push_back(texture<&M::second, &S::fourth, &GroundLayer::base_color_texture>(
        "fourth_base_color_texture", place("fourthBaseColorTexture"), "of layers: sRGB colour; blue: height"));
    t.push_back(texture<&M::second, &S::fourth, &GroundLayer::normal_texture>(
        "fourth_normal_texture", place("fourthNormalTexture"), "of layers: tangent space, green up"));
    t.push_back(texture<&M::second, &S::fourth, &GroundLayer::metallic_roughness_texture>(
        "fourth_metallic_roughness_texture", place("fourthMetallicRoughnessTexture"),
        "of layers: red occlusion, green roughness, blue metallic"));
    t.push_back(texture<&M::second, &S::far_texture>(
        "far_texture", place("farTexture"), "of layers: sRGB colour of all of it, as it is seen from afar"));
    t.push_back(texture<&M::second, &S::mix_mask>(
        "mix_mask_texture", place("mixMaskTexture"),
        "1 the first set, 0 the second; of detail 1 all of it; mix_mask_channel"));
    t.push_back(texture<&M::second, &S::base_color_texture>(
        "second_base_color_texture", place("secondBaseColorTexture"),
        "sRGB colour; what is cut out or shines is the first set's; alpha: second_occlusion_in_alpha"));
    t.push_back(texture<&M::second, &S::normal_texture>(
        "second_normal_texture", place("secondNormalTexture"), "tangent space, green up"));
    t.push_back(texture<&M::second, &S::metallic_roughness_texture>(
        "second_metallic_roughness_texture", place("secondMetallicRoughnessTexture"),
        "red occlusion, green roughness, blue metallic; of mix alone"));
    t.push_back(texture<&M::second, &S::height>("second_height_texture", place("secondHeightTexture"),
                                                "0 low .. 1 high; second_height_channel; of mix alone"));
}

}  // namespace petrichor::scene::detail
