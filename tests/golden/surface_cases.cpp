// The dry surface: maps, coordinates, factors, transparency.
#include <glm/gtc/matrix_transform.hpp>

#include "formulas/geometry/shapes.h"
#include "tests/golden/stage.h"

namespace petrichor::golden {
namespace {

using gpu::AlphaMode;
using gpu::look;
using gpu::Material;
using gpu::plain_material;
using gpu::quad;
using gpu::TexelFormat;

constexpr glm::vec3 kGrey(0.4f);

// Five upright plates in a row, numbered from the left, over a dark floor.
Shot five_plates(const Material (&materials)[5])
{
    Shot shot = plain_day(look({0, 1.2f, 6.2f}, {0, 0.85f, 0}, 0.48f));
    for (int i = 0; i < 5; ++i) {
        const std::uint32_t id = shot.add(materials[i]);
        shot.add(quad({-2.45f + static_cast<float>(i), 0.2f, 0}, {0.9f, 0, 0}, {0, 1.5f, 0}, id));
    }
    shot.add(ground(8.0f, shot.add(plain_material(glm::vec3(0.15f), 0.9f))));
    return shot;
}

Shot surface_dry()
{
    Shot maps;  // only for its textures
    Material m[5];
    for (Material& material : m) material = plain_material(kGrey, 0.6f);
    m[0].base_color = glm::vec4(1.0f, 0.9f, 0.7f, 1.0f);
    m[0].base_color_texture = maps.add(chequers({0.9f, 0.35f, 0.2f}, {0.2f, 0.4f, 0.8f}));
    m[1].normal_texture = maps.add(stone_normals());
    m[1].normal_scale = 0.8f;
    m[2].base_color = glm::vec4(0.9f, 0.7f, 0.4f, 1.0f);
    m[2].metallic = 0.9f;
    m[2].roughness = 0.8f;
    m[2].metallic_roughness_texture =
        maps.add(make_texture("surface", TexelFormat::Rgba8Unorm, 64, [](float u, float v) {
            return glm::vec4(0.0f, 0.1f + 0.9f * v, u < 0.5f ? 0.0f : 1.0f, 0.0f);
        }));
    m[3].base_color = glm::vec4(0.8f, 0.8f, 0.8f, 1.0f);
    m[3].occlusion_texture = maps.add(blot());
    m[3].occlusion_strength = 0.9f;
    m[4].emissive = glm::vec3(24000.0f, 12000.0f, 3000.0f);
    m[4].emissive_texture = maps.add(chequers(glm::vec3(1.0f), glm::vec3(0.0f), 4));
    Shot shot = five_plates(m);
    shot.textures = maps.textures;
    return shot;
}

Shot texture_coordinates()
{
    Shot maps;
    Material m[5];
    for (Material& material : m) material = plain_material(glm::vec3(1.0f), 0.7f);
    // Neither the picture nor its halves look the same turned or mirrored.
    const auto arrow = [](float u, float v) {
        const bool head = v < 0.5f && std::abs(u - 0.5f) < v;
        const bool shaft = v >= 0.5f && std::abs(u - 0.5f) < 0.12f;
        const glm::vec3 back(0.2f + 0.6f * u, 0.75f, 0.9f - 0.6f * v);
        return glm::vec4(head || shaft ? glm::vec3(0.75f, 0.1f, 0.1f) : back, 1.0f);
    };
    gpu::Texture texture = make_texture("arrow", TexelFormat::Rgba8Srgb, 64, arrow);
    for (int i = 0; i < 5; ++i) {
        gpu::Texture wrapped = texture;
        if (i == 2) wrapped.wrap_u = wrapped.wrap_v = gpu::Wrap::Clamp;
        if (i == 3) wrapped.wrap_u = wrapped.wrap_v = gpu::Wrap::Mirror;
        wrapped.nearest = i == 4;
        m[i].base_color_texture = maps.add(wrapped);
    }
    gpu::TextureUse& turned = m[0].base_color_texture;
    turned.scale = {2.0f, 3.0f};
    turned.offset = {0.25f, 0.1f};
    turned.rotation_rad = 0.5f;
    m[1].base_color_texture.texcoord = 1;
    for (const int i : {2, 3}) {
        m[i].base_color_texture.scale = {2.0f, 2.0f};
        m[i].base_color_texture.offset = {-0.5f, -0.5f};
    }
    m[4].base_color_texture.scale = {0.15f, 0.15f};
    m[4].base_color_texture.offset = {0.56f, 0.1f};
    Shot shot = five_plates(m);
    shot.textures = maps.textures;
    for (gpu::Mesh& mesh : shot.scene.meshes) {
        gpu::Primitive& p = mesh.primitives[0];
        for (const glm::vec2& uv : p.uv0) p.uv1.emplace_back(1.0f - uv.y, 2.0f * uv.x);
    }
    return shot;
}

// One mesh, four placements: as it is, mirrored, stretched, turned; a normal map shows the
// tangents.
Shot instances()
{
    Shot shot = plain_day(look({0, 1.6f, 6.0f}, {0, 0.75f, 0}, 0.5f));
    Material stone = plain_material(glm::vec3(1.0f), 0.5f);
    stone.base_color_texture = shot.add(chequers({0.8f, 0.75f, 0.7f}, {0.5f, 0.45f, 0.4f}, 2));
    stone.normal_texture = shot.add(stone_normals(3));
    const std::uint32_t id = shot.add(stone);
    gpu::Primitive cube = box({-0.4f, 0.0f, -0.4f}, {0.4f, 0.8f, 0.4f}, id);
    for (std::size_t i = 0; i < cube.positions.size(); ++i) {
        cube.colors.emplace_back(1.0f, 1.0f - 0.8f * cube.uv0[i].x, 1.0f - 0.8f * cube.uv0[i].y,
                                 1.0f);
    }
    const glm::mat4 one(1.0f);
    shot.add(cube, glm::translate(one, {-1.8f, 0, 0}));
    const auto place = [&](const glm::mat4& to_world) {
        shot.scene.instances.push_back({"again", 0, to_world});
    };
    place(glm::scale(glm::translate(one, {-0.6f, 0, 0}), {-1, 1, 1}));
    place(glm::scale(glm::translate(one, {0.6f, 0, 0}), {0.6f, 1.8f, 1.0f}));
    place(glm::rotate(glm::translate(one, {1.8f, 0.4f, 0}), 0.8f, glm::vec3(0.6f, 0.8f, 0)));
    shot.add(ground(6.0f, shot.add(plain_material(glm::vec3(0.2f), 0.9f))));
    return shot;
}

// Spheres: roughness from left to right; dielectric above, of a high index in the middle, metal
// below.
Shot material_factors()
{
    Shot shot = plain_day(look({0, 0, 9}, {0, 0, 0}, 0.4f));
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 6; ++column) {
            const float roughness = 0.05f + 0.19f * static_cast<float>(column);
            Material m = plain_material({0.8f, 0.35f, 0.2f}, roughness, row == 2 ? 1.0f : 0.0f);
            if (row == 1) {
                m.ior = 2.2f;
                m.specular = 0.8f;
            }
            shot.add(sphere({static_cast<float>(column) - 2.5f, 1.0f - static_cast<float>(row), 0},
                            0.45f, shot.add(m)));
        }
    }
    return shot;
}

gpu::Texture leaf()
{
    return make_texture("leaf", TexelFormat::Rgba8Srgb, 64, [](float u, float v) {
        const glm::vec2 p(u - 0.5f, v - 0.5f);
        const float r = glm::length(p) * 2.0f;
        const float angle = std::atan2(p.y, p.x);
        const float edge = 0.65f + 0.25f * std::cos(5.0f * angle);
        return glm::vec4(0.3f + 0.3f * u, 0.7f, 0.2f,
                         glm::clamp((edge - r) * 4.0f + 0.5f, 0.0f, 1.0f));
    });
}

// Cut-out leaves with their shadows on wall and floor; the right one is seen from behind.
Shot alpha_mask()
{
    Shot shot = plain_day(look({0, 1.3f, 5}, {0, 0.8f, 0}, 0.6f));
    Material m = plain_material(glm::vec3(1.0f), 0.7f);
    m.base_color_texture = shot.add(leaf());
    m.base_color_texture.texcoord = 1;  // the shadow must be cut in the same way
    m.base_color_texture.scale = glm::vec2(1.2f);
    m.base_color_texture.offset = glm::vec2(-0.1f);
    m.alpha_mode = AlphaMode::Mask;
    m.alpha_cutoff = 0.4f;
    const std::uint32_t one_sided = shot.add(m);
    m.double_sided = true;
    const std::uint32_t two_sided = shot.add(m);
    shot.add(quad({-2.1f, 0.2f, 0}, {1.3f, 0, 0}, {0, 1.3f, 0}, one_sided));
    shot.add(quad({-0.65f, 0.2f, 0}, {1.3f, 0, 0}, {0, 1.3f, 0}, two_sided));
    shot.add(quad({2.1f, 0.2f, 0}, {-1.3f, 0, 0}, {0, 1.3f, 0}, two_sided));
    for (gpu::Mesh& mesh : shot.scene.meshes) {
        gpu::Primitive& p = mesh.primitives[0];
        for (const glm::vec2& uv : p.uv0) p.uv1.emplace_back(uv.y, uv.x);
    }
    const std::uint32_t grey = shot.add(plain_material(kGrey, 0.9f));
    shot.add(ground(6.0f, grey));
    shot.add(quad({-6, 0, -1.2f}, {12, 0, 0}, {0, 4, 0}, grey));
    shot.frame.settings.samples = 4;
    return shot;
}

// Three coloured panes of different opacity and a clear sphere in front of chequers.
Shot alpha_blend()
{
    Shot shot = plain_day(look({0, 1.2f, 5}, {0, 0.9f, 0}, 0.6f));
    const glm::vec3 colors[] = {{0.9f, 0.2f, 0.2f}, {0.2f, 0.8f, 0.3f}, {0.2f, 0.3f, 0.9f}};
    for (int i = 0; i < 3; ++i) {
        Material m = plain_material(colors[i], 0.2f);
        m.alpha_mode = AlphaMode::Blend;
        m.base_color.a = 0.25f + 0.25f * static_cast<float>(i);
        const auto at = static_cast<float>(i);
        shot.add(
            quad({-2.0f + 0.8f * at, 0.3f, 0.3f * at}, {1.2f, 0, 0}, {0, 1.3f, 0}, shot.add(m)));
    }
    Material glass = plain_material(glm::vec3(1.0f), 0.1f);
    glass.transmission = 0.9f;
    shot.add(sphere({1.6f, 0.7f, 0.3f}, 0.55f, shot.add(glass)));
    Material back = plain_material(glm::vec3(1.0f), 0.8f);
    back.base_color_texture = shot.add(chequers(glm::vec3(0.85f), glm::vec3(0.3f)));
    const std::uint32_t chequered = shot.add(back);
    shot.add(ground(6.0f, chequered, 3.0f));
    shot.add(quad({-6, 0, -2}, {12, 0, 0}, {0, 12, 0}, chequered));
    shot.frame.settings.samples = 8;
    return shot;
}

// A row of unlit plates beside lit ones, at night under one lamp.
Shot unlit()
{
    Material m[5];
    for (int i = 0; i < 5; ++i) {
        m[i] = plain_material({0.9f, 0.6f, 0.2f + 0.15f * static_cast<float>(i)}, 0.6f);
        m[i].unlit = i % 2 == 0;
    }
    Shot shot = five_plates(m);
    shot.frame.sky.sun_elevation_rad = -0.3f;
    gpu::Light lamp;
    lamp.intensity = 2.0f;
    lamp.position_m = {0.0f, 1.6f, 1.2f};
    shot.add(lamp);
    return shot;
}

// One- and two-sided plates, seen from in front (left) and behind (right).
Shot double_sided()
{
    Material m[5];
    for (int i = 0; i < 5; ++i) {
        m[i] = plain_material({0.2f + 0.15f * static_cast<float>(i), 0.5f, 0.7f}, 0.5f);
        m[i].double_sided = i >= 2;
        m[i].normal_texture.texture = 0;
    }
    Shot shot = five_plates(m);
    shot.add(stone_normals());
    for (const std::size_t behind : {1u, 3u, 4u}) {
        const auto left = static_cast<float>(behind) - 2.45f;
        shot.scene.meshes[behind].primitives[0] =
            quad({left + 0.9f, 0.2f, 0}, {-0.9f, 0, 0}, {0, 1.5f, 0},
                 static_cast<std::uint32_t>(behind));
    }
    return shot;
}

// All eight textures on one floor, each with a transform of its own, every second one by uv1.
Shot every_slot()
{
    Shot shot = plain_day(look({0, 2.2f, 3.6f}, {0, 0, 0.1f}, 0.62f));
    Material m = plain_material(glm::vec3(1.0f), 0.9f, 1.0f);
    m.emissive = glm::vec3(5000.0f, 3000.0f, 0.0f);
    m.base_color_texture = shot.add(chequers({0.8f, 0.7f, 0.5f}, {0.3f, 0.35f, 0.5f}, 4));
    m.normal_texture = shot.add(stone_normals(4));
    const auto bands = [](float u, float v) {
        return glm::vec4(0.5f + 0.5f * v, 0.3f + 0.6f * u, v < 0.3f ? 1.0f : 0.0f, 1.0f);
    };
    m.metallic_roughness_texture =
        shot.add(make_texture("bands", TexelFormat::Rgba8Unorm, 32, bands));
    m.occlusion_texture = shot.add(stone_heights(3));
    const auto sparks = [](float u, float v) {
        const float r = glm::length(glm::vec2(u - 0.3f, v - 0.6f));
        return glm::vec4(r < 0.12f ? 3.0f : 0.0f, r < 0.08f ? 2.0f : 0.0f, 0.0f, 1.0f);
    };
    m.emissive_texture = shot.add(make_texture("sparks", TexelFormat::Rgba16Float, 32, sparks));
    m.weather.height = shot.add(stone_heights(4));
    m.weather.puddle_mask = shot.add(blot());
    m.weather.snow_mask = shot.add(blot());
    int slot = 0;
    for (gpu::TextureUse* use :
         {&m.base_color_texture, &m.normal_texture, &m.metallic_roughness_texture,
          &m.occlusion_texture, &m.emissive_texture, &m.weather.height, &m.weather.puddle_mask,
          &m.weather.snow_mask}) {
        const auto at = static_cast<float>(slot);
        use->texcoord = slot % 2;
        use->scale = {1.1f + 0.1f * at, 1.9f - 0.1f * at};
        use->offset = {0.07f * at, 0.5f - 0.05f * at};
        use->rotation_rad = 0.15f * at - 0.4f;
        ++slot;
    }
    m.weather.water_accumulation.w = 1.5f;
    gpu::Primitive floor = ground(1.6f, shot.add(m));
    for (const glm::vec2& uv : floor.uv0) floor.uv1.emplace_back(1.0f - uv.y, uv.x);
    shot.add(floor);
    shared::WeatherMoment& w = shot.frame.weather;
    w.film_albedo = 0.4f;
    w.film_smoothness = 0.3f;
    w.flood_puddles = 0.9f;
    w.snow_amount = 0.55f;
    return shot;
}

// Every AOV of a frame that has everything: maps, metal, glow, half-molten snow, puddles, frost.
Shot aovs()
{
    Shot shot = plain_day(look({0.4f, 1.7f, 5}, {0, 0.5f, 0}, 0.6f));
    Material stone = plain_material(glm::vec3(1.0f), 0.8f);
    stone.base_color_texture = shot.add(chequers({0.7f, 0.6f, 0.5f}, {0.45f, 0.4f, 0.4f}, 4));
    stone.normal_texture = shot.add(stone_normals());
    stone.occlusion_texture = shot.add(stone_heights());
    stone.weather.height = shot.add(stone_heights());
    stone.weather.puddle_mask = shot.add(blot());
    shot.add(ground(3.0f, shot.add(stone)));
    Material brass = plain_material({0.9f, 0.7f, 0.3f}, 0.3f, 1.0f);
    shot.add(sphere({-1.0f, 0.6f, 0}, 0.6f, shot.add(brass)));
    Material lamp = plain_material(glm::vec3(0.1f), 0.4f);
    lamp.emissive = {4000.0f, 2500.0f, 900.0f};
    shot.add(box({0.6f, 0, -0.6f}, {1.6f, 1.0f, 0.4f}, shot.add(lamp)));
    shared::WeatherMoment& w = shot.frame.weather;
    w.rain = 0.6f;
    w.flood_cracks = 0.5f;
    w.flood_puddles = 0.9f;
    w.film_albedo = 0.7f;
    w.film_smoothness = 0.5f;
    w.snow_amount = 0.45f;
    w.water_to_snow = 0.4f;
    w.freeze_exp = 0.9f;
    w.melt = 0.4f;
    w.melt_exp = 0.9f;
    w.frost = 0.6f;
    shot.frame.settings.time_s = 1.7;
    shot.frame.settings.width = 96;
    shot.frame.settings.height = 54;
    shot.frame.settings.samples = 1;
    for (const gpu::AovInfo& info : gpu::aov_table()) {
        shot.frame.settings.aovs.push_back(info.name);
    }
    return shot;
}

Shot marched_shapes()
{
    Shot shot = plain_day(look({0.6f, 1.9f, 5.2f}, {0, 0.75f, 0}, 0.62f));
    shot.add(ground(8.0f, shot.add(plain_material(glm::vec3(0.35f), 0.9f))));
    const auto put = [&](int kind, int iterations, const glm::vec3& at, float scale, float turn, const glm::vec3& color) {
        scene::MarchedShape shape;
        shape.kind = kind;
        shape.iterations = iterations;
        shape.material = shot.add(plain_material(color, 0.5f));
        shape.rest.to_world = glm::scale(glm::rotate(glm::translate(glm::mat4(1.0f), at), turn, glm::vec3(0, 1, 0)),
                                         glm::vec3(scale));
        if (kind == SHAPE_TORUS) shape.half = {1.0f, 0.25f, 1.0f};
        shot.scene.shapes.push_back(shape);
    };
    put(SHAPE_MANDELBULB, 6, {0, 0.9f, 0}, 0.75f, 0.0f, {0.6f, 0.3f, 0.2f});
    put(SHAPE_MENGER, 3, {-1.6f, 0.55f, 0.2f}, 0.55f, 0.5f, {0.3f, 0.4f, 0.5f});
    put(SHAPE_SIERPINSKI, 5, {1.55f, 0.6f, 0.3f}, 0.6f, 0.9f, {0.3f, 0.5f, 0.2f});
    put(SHAPE_TORUS, 0, {0.5f, 0.12f, 1.5f}, 0.45f, 0.0f, {0.7f, 0.6f, 0.2f});
    shot.frame.weather.snow_amount = 0.4f;
    shot.frame.weather.water_to_snow = 1.0f;
    return shot;
}

}  // namespace

std::vector<Case> surface_cases()
{
    return {
        {"surface_dry", "maps: base colour, normal, roughness and metallic, occlusion, emission",
         surface_dry},
        {"texture_coordinates", "transform, second coordinates, clamp, mirror, nearest",
         texture_coordinates},
        {"instances", "one mesh: plain, mirrored, stretched, turned; vertex colours", instances},
        {"material_factors", "roughness by metallic and index of refraction", material_factors},
        {"alpha_mask", "cut-out leaves, one- and two-sided, and their shadows", alpha_mask},
        {"alpha_blend", "panes of 25, 50 and 75 % and a clear sphere", alpha_blend},
        {"unlit", "unlit plates between lit ones, at night", unlit},
        {"double_sided", "what is seen from behind", double_sided},
        {"every_slot", "all textures of a material, each with its own coordinates", every_slot},
        {"aovs", "every AOV of one rich frame", aovs},
        {"marched_shapes", "fractals and a ring that rays are marched to, in a little snow", marched_shapes},
    };
}

}  // namespace petrichor::golden
