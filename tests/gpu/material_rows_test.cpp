// Every row of the material table changes the picture: a property without effect cannot exist.
#include <cmath>

#include "scene/material_table.h"
#include "tests/gpu/chequered_textures.h"
#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

using scene::MaterialProperty;
using scene::PropertyKind;

class MaterialRows : public GpuTest {};

// A material to which everything can happen: it is rough and grey, glows a little, and has all
// textures but the height map.
Material rich_material()
{
    Material m = plain_material(glm::vec3(0.5f, 0.4f, 0.3f), 0.6f, 0.3f);
    m.base_color.a = 0.9f;
    m.emissive = glm::vec3(0.3f);
    m.emissive_strength = 1.0f;
    for (const char* name :
         {"base_color_texture", "normal_texture", "metallic_roughness_texture", "occlusion_texture",
          "emissive_texture", "puddle_mask_texture", "snow_mask_texture", "light_map_texture"}) {
        for (const scene::MaterialTexture& row : scene::material_textures()) {
            if (row.name == name) row.edit(m) = use_of(name);
        }
    }
    m.weather.water_color = {0.3f, 0.2f, 0.1f, 0.4f};
    return m;
}

// What a row needs of the others to be seen.
void make_visible(std::string_view row, Material& m)
{
    if (row.starts_with("clearcoat_") && row != "clearcoat_factor") {
        m.clearcoat = 1.0f;
        m.clearcoat_roughness = 0.5f;
    }
    if (row == "clearcoat_normal_scale") m.maps.clearcoat_normal = use_of("clearcoat_normal_texture");
    if (row.starts_with("sheen_") && row != "sheen_color_factor") m.sheen_color = glm::vec3(0.8f);
    if (row == "sheen_roughness_texture") m.sheen_roughness = 1.0f;
    if (row == "anisotropy_rotation" || row == "anisotropy_texture") m.anisotropy = 0.9f;
    if (row.starts_with("diffuse_transmission_") && row != "diffuse_transmission_factor") m.diffuse_transmission = 0.8f;
    if (row == "transmission_texture") m.transmission = 0.9f;
    if (row == "thickness_texture" || row == "dispersion") {
        m.transmission = 0.9f;
        m.thickness = 0.5f;
    }
    if (row == "dispersion") {
        m.name = "before stripes";
        m.roughness = 0.02f;
        m.ior = 2.0f;
    }
    if (row == "thickness_texture") {
        m.attenuation_distance_m = 0.2f;
        m.attenuation_color = glm::vec3(0.3f, 0.6f, 0.9f);
    }
    if (row.starts_with("workflow_") || row == "glossiness_factor" ||
        row == "specular_glossiness_texture") {
        m.specular_workflow = true;
        m.workflow_specular = glm::vec3(0.2f);
    }
    if (row.starts_with("iridescence_") && row != "iridescence_factor") m.iridescence = 1.0f;
    if (row == "iridescence_thickness_minimum")
        m.maps.iridescence_thickness = use_of("iridescence_thickness_texture");
    if (row.starts_with("translucency_")) m.translucency = 0.6f;
    if (row == "translucency_channel") m.maps.translucency = use_of("translucency_texture");
    if (row == "skin_curvature_channel") m.maps.skin_curvature = use_of("skin_curvature_texture");
    if (row == "skin_curvature_channel" || row == "skin_curvature_texture") m.skin_curvature = 1.0f;
    if (row.starts_with("scatter_")) m.scatter_color = glm::vec3(0.3f);
    if (row.starts_with("skin_")) m.lighting_model = "skin";
    if (row.starts_with("hair_")) m.lighting_model = "hair";
    if (row == "vertex_occlusion") m.name = "coloured";
    if (row == "alpha_cutoff") m.alpha_mode = AlphaMode::Mask;
    if (row.starts_with("flow_")) m.weather.flow_speed = 1.0f;
    if (row == "water_slope_damp") m.weather.porosity = 1.0f;  // what a film darkens
    if (row == "flow_refraction") m.weather.flow_normal_strength = 2.0f;
    if (row == "height_scale_m") m.weather.height_scale_m = 0.1f;
    if (row.starts_with("parallax") || row == "height_scale_m") {
        m.weather.height = use_of("height_texture");
        m.weather.parallax = scene::Parallax::Occlusion;
    }
    if (row == "premultiplied_alpha") {
        m.alpha_mode = AlphaMode::Blend;
        m.base_color.a = 0.4f;
    }
    if (row == "thickness_factor" || row.starts_with("attenuation")) m.transmission = 0.9f;
    if (row == "thickness_factor") {  // it bends what lies behind, a smooth sky alone shows little of it
        m.name = "before stripes";
        m.roughness = 0.02f;
    }
    if (row.starts_with("attenuation")) {
        m.thickness = 0.5f;
        m.attenuation_distance_m = 0.2f;
        m.attenuation_color = glm::vec3(0.3f, 0.6f, 0.9f);
    }
    if (row.starts_with("second_") || row.starts_with("mix_")) {
        m.second.use = scene::SecondSetUse::Mix;
        m.second.mix_factor = 0.5f;
        m.second.mix_mask = use_of("mix_mask_texture");
        m.second.base_color_texture = use_of("second_base_color_texture");
        m.second.normal_texture = use_of("second_normal_texture");
        m.second.height = use_of("second_height_texture");
        m.second.metallic = 0.2f;
        m.second.own_water = row.starts_with("second_water");
        m.second.water_color = {0.1f, 0.1f, 0.5f, 0.5f};
        m.second.water_accumulation = {0.5f, 1.0f, 0.5f, 1.0f};
    }
    if (row.starts_with("third_") || row.starts_with("fourth_") || row.starts_with("layers_") || row.starts_with("far_")) {
        m.second.use = scene::SecondSetUse::Layers;
        m.second.mix_mask = use_of("mix_mask_texture");
        m.second.base_color_texture = use_of("second_base_color_texture");
        m.second.third.base_color_texture = use_of("third_base_color_texture");
        m.second.third.color = glm::vec3(0.2f, 0.6f, 0.4f);
        m.second.fourth.base_color_texture = use_of("fourth_base_color_texture");
        m.second.fourth.color = glm::vec3(0.7f, 0.3f, 0.2f);
        if (row.starts_with("far_")) m.second.far_texture = use_of("far_texture");
        if (row != "far_start_m") m.second.far_start_m = 0.0f;
    }
    if (row.starts_with("second_scatter_")) m.second.scatter_color = glm::vec3(0.3f);
    if (row == "second_specular_factor") m.specular = 0.0f;  // which the second has too
    if (row == "snow_local_tiling") m.weather.snow_mapping = scene::SnowMapping::Local;
    if (row == "snow_mask_normal_scale")
        m.weather.snow_mask_normal = use_of("snow_mask_normal_texture");
    if (row.starts_with("wind_") && row != "wind_bend") m.wind.bend = 0.6f;
    if (row.starts_with("decal_")) {
        m.decal.on = true;
        m.decal.weights.w = row == "decal_weights" ? 0.0f : 1.0f;
    }
    if (row == "parallax_steps") m.weather.parallax_steps = 4;
    if (row == "height_channel") m.weather.height = use_of("height_texture");
}

// Flat ground, a slope, a wall seen from both sides; of rows about decals what lies below or above too.
Scene stage(const Material& material, std::string_view row = "")
{
    if (row.starts_with("decal_") || row == "receives_decals") {
        Material other = plain_material(glm::vec3(0.2f, 0.3f, 0.2f), 0.9f);
        Material paint = plain_material(glm::vec3(0.7f, 0.1f, 0.1f), 0.2f);
        paint.decal.on = true;
        paint.decal.order = 0.5f;
        const auto ground = [](float y, std::uint32_t m) {
            return quad({-2, y, 2}, {4, 0, 0}, {0, 0, -4}, m);
        };
        if (row == "receives_decals")
            return scene_of({ground(0, 0), ground(0, 2)}, {material, other, paint});
        // In reach of one value of decal_reach_m and not of the other.
        const float height_m = row == "decal_reach_m" ? 0.5f : 0.0f;
        return scene_of({ground(0, 1), ground(height_m, 0), quad({-2, 0, 0}, {2, 0, 0}, {0, 0, -2}, 2)},
                        {material, other, paint});
    }
    Scene scene = scene_of(
        {quad({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}), quad({-2, 0, 0}, {2, 0, 0}, {0, 1, -1}),
         quad({0.5f, 0, -1}, {1, 0, 0}, {0, 1.2f, 0}),
         quad({2.0f, 0, 0}, {-0.8f, 0, -0.3f}, {0, 1, 0})},
        {material});
    if (row == "area_lights") {
        Light lamp;
        lamp.position_m = {0.3f, 1.0f, 0.8f};
        lamp.intensity = 40.0f;
        lamp.radius_m = 0.3f;
        scene.lights.push_back(lamp);
    }
    if (material.name == "coloured") {
        for (Primitive& p : scene.meshes[0].primitives) p.colors.assign(4, {1.0f, 0.5f, 1.0f, 1.0f});
    }
    if (material.name == "before stripes") {
        scene.materials.push_back(plain_material(glm::vec3(0.9f)));
        for (int k = 0; k < 8; ++k) {
            scene.meshes[0].primitives.push_back(
                quad({-2.0f + 0.5f * static_cast<float>(k), -0.4f, 2}, {0.25f, 0, 0}, {0, 0, -4}, 1));
        }
    }
    return scene;
}

// Rain on standing water, and snow that melts: a bit of each.
Frame weathered(std::string_view row = "")
{
    Frame frame;
    frame.camera = look({0, 1.6f, 3.2f}, {0, 0.3f, -0.3f});
    frame.settings.width = 96;
    frame.settings.height = 64;
    frame.settings.samples = 1;
    frame.settings.time_s = 0.3;
    frame.settings.exposure = 1.0f;
    frame.sky.sun_illuminance = 20.0f;  // so dim that what glows is seen
    frame.weather.wind_m_s = {6.0f, 0.0f};
    frame.weather.rain = 0.8f;
    frame.weather.flood_cracks = 0.5f;
    frame.weather.flood_puddles = 1.4f;
    frame.weather.film_albedo = 0.6f;
    frame.weather.film_smoothness = 0.4f;
    frame.weather.snow_amount = 0.45f;
    frame.weather.water_to_snow = 0.2f;
    frame.weather.melt = 0.5f;
    frame.weather.melt_exp = 0.8f;
    frame.sky.sun_elevation_rad = 0.8f;
    frame.sky.sun_azimuth_rad = 2.5f;
    if (row == "beads") {  // of millimetres, on what is wet and no puddle
        frame.camera = look({0.6f, 0.12f, 1.0f}, {0.6f, 0.0f, 0.9f});
        frame.weather.flood_cracks = frame.weather.flood_puddles = frame.weather.snow_amount = 0.0f;
        frame.weather.melt = 0.0f;
    }
    if (row == "skin_blur") {  // shares of layers ask for this path: another path would be a change, too
        frame.settings.surface_path = SurfacePath::Visibility;
        frame.weather.flood_puddles = frame.weather.snow_amount = frame.weather.melt = 0.0f;
    }
    if (row == "parallax_steps") frame.camera = look({0.3f, 0.5f, 1.8f}, {0.3f, 0.0f, 0.3f});
    if (row == "translucency_distortion") {  // bends what comes from behind
        frame.sky.sun_azimuth_rad = -0.3f;
        frame.sky.sun_elevation_rad = 0.3f;
    }
    return frame;
}

glm::vec4 another_value(const MaterialProperty& property, const Material& material)
{
    glm::vec4 value = property.get(material);
    if (property.kind == PropertyKind::Flag) return glm::vec4(1.0f - value.x);
    if (property.kind == PropertyKind::Choice) {
        value.x = value.x == property.low.x ? property.low.x + 1.0f : property.low.x;
        return value;
    }
    for (int i = 0; i < property.count; ++i) {
        const float low = std::max(property.low[i], 0.0f);
        const float high = std::min(property.high[i], 3.0f);
        value[i] =
            value[i] > 0.5f * (low + high) ? low + 0.1f * (high - low) : low + 0.9f * (high - low);
    }
    return value;
}

// Largest change of a pixel, relative to the brighter of the two.
float difference(const RenderResult& a, const RenderResult& b)
{
    float largest = 0.0f;
    for (std::size_t i = 0; i < a.beauty.size(); ++i) {
        const float x = half_to_float(a.beauty[i]);
        const float y = half_to_float(b.beauty[i]);
        largest = std::max(largest, std::abs(x - y) / std::max({x, y, 1e-3f}));
    }
    return largest;
}

TEST_F(MaterialRows, EachChangesThePictureIfItIsShaded)
{
    const std::vector<Texture> pixels = chequered_textures();
    for (const MaterialProperty& property : scene::material_table()) {
        if (property.at_load) continue;  // the mesh is another: tests/film/displacement_test.cpp
        const Frame frame = weathered(property.name);
        Material material = rich_material();
        make_visible(property.name, material);
        renderer->load(stage(material, property.name), pixels);
        const RenderResult before = renderer->render(frame);
        property.set(material, another_value(property, material));
        renderer->load(stage(material, property.name), pixels);
        const float change = difference(before, renderer->render(frame));
        if (property.shaded) {
            EXPECT_GT(change, 0.005f) << property.name << " has no effect";
        } else {
            EXPECT_EQ(change, 0.0f) << property.name << " is shaded: say so in its row";
        }
    }
}

// A row that is keyed may change from frame to frame: the picture is that of a scene which was
// loaded so, and without the change that of the scene as it is.
TEST_F(MaterialRows, KeyedOnesChangeWithTheFrame)
{
    const std::vector<Texture> pixels = chequered_textures();
    int keyed = 0;
    for (const MaterialProperty& property : scene::material_table()) {
        if (!property.keyed) continue;
        ++keyed;
        Material material = rich_material();
        make_visible(property.name, material);
        renderer->load(stage(material, property.name), pixels);
        const RenderResult as_loaded = renderer->render(weathered(property.name));
        Frame frame = weathered(property.name);
        frame.materials = {{0, property.name, another_value(property, material)}};
        const RenderResult changed = renderer->render(frame);
        const RenderResult again = renderer->render(weathered(property.name));
        EXPECT_EQ(as_loaded.beauty, again.beauty) << property.name << " stays changed";
        property.set(material, frame.materials[0].value);
        renderer->load(stage(material, property.name), pixels);
        EXPECT_EQ(renderer->render(weathered(property.name)).beauty, changed.beauty) << property.name;
        EXPECT_NE(changed.beauty, as_loaded.beauty) << property.name << " has no effect";
    }
    EXPECT_GT(keyed, 25);
}

TEST_F(MaterialRows, WhatAFrameMayNotChangeIsRefused)
{
    renderer->load(stage(rich_material()), chequered_textures());
    const MaterialChange wrong[] = {{0, "unlit", glm::vec4(1.0f)},
                                    {0, "roughness", glm::vec4(0.5f)},
                                    {7, "roughness_factor", glm::vec4(0.5f)}};
    for (const MaterialChange& change : wrong) {
        Frame frame = weathered();
        frame.materials = {change};
        EXPECT_THROW(renderer->render(frame), Error) << change.property;
    }
}

TEST_F(MaterialRows, EveryTextureChangesThePicture)
{
    const std::vector<Texture> pixels = chequered_textures();
    const Frame frame = weathered();
    for (const scene::MaterialTexture& row : scene::material_textures()) {
        Material material = rich_material();
        make_visible(row.name, material);
        row.edit(material) = {};
        renderer->load(stage(material), pixels);
        const RenderResult without = renderer->render(frame);
        row.edit(material) = use_of(row.name);
        renderer->load(stage(material), pixels);
        EXPECT_GT(difference(without, renderer->render(frame)), 0.005f) << row.name;
    }
}

}  // namespace
}  // namespace petrichor::gpu
