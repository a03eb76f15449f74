#include "gpu/upload/gpu_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <map>
#include <tuple>
#include <utility>

#include "base/error.h"
#include "gpu/upload/detail/texel_format.h"
#include "gpu/upload/draw.h"
#include "gpu/upload/emissive_lights.h"
#include "gpu/upload/material_constants.h"
#include "gpu/upload/wide_ground.h"
#include "scene/shapes.h"

namespace petrichor::gpu {

namespace {

VkSamplerAddressMode address_mode(Wrap wrap)
{
    switch (wrap) {
        case Wrap::Repeat:
            return VK_SAMPLER_ADDRESS_MODE_REPEAT;
        case Wrap::Clamp:
            return VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
        case Wrap::Mirror:
            return VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT;
    }
    return VK_SAMPLER_ADDRESS_MODE_REPEAT;
}

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
std::uint32_t layers_of(const Material& m)
{
    return (m.clearcoat > 0.0f ? LAYERS_COAT : 0u) |
           (m.sheen_color != glm::vec3(0.0f) ? LAYERS_SHEEN : 0u) |
           (m.anisotropy > 0.0f ? LAYERS_ANISOTROPY : 0u) |
           (m.diffuse_transmission > 0.0f ? LAYERS_TRANSMISSION : 0u) |
           (m.translucency > 0.0f && m.translucency_scale > 0.0f ? LAYERS_TRANSLUCENT : 0u) |
           (scatters(m) ? LAYERS_SCATTER : 0u);
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
    return layers_of(material) != 0 ? "layered" : "standard";
}

// Who names one of the other built-in models gets it as it is; light that comes through, and fibres at
// the rim, go with any that is lit.
std::uint32_t layers_of(const Material& m, const std::string& model)
{
    const auto& built_in = built_in_lighting_models();
    const bool own = std::find(built_in.begin(), built_in.end(), model) == built_in.end();
    const std::uint32_t all = layers_of(m);
    if (model == "layered" || own) return all;
    if (model == "unlit" || model == "unlit_shadowed") return 0;
    return (all & (LAYERS_TRANSLUCENT | LAYERS_SCATTER)) | (model == "skin" ? LAYERS_SKIN : 0u) |
           (model == "hair" ? LAYERS_HAIR : 0u);
}

}  // namespace

const std::vector<VertexAttribute>& vertex_attributes()
{
    static const std::vector<VertexAttribute> attributes{
        {0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(Vertex, position)},
        {1, VK_FORMAT_R32G32B32_SFLOAT, offsetof(Vertex, normal)},
        {2, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(Vertex, tangent)},
        {3, VK_FORMAT_R32G32_SFLOAT, offsetof(Vertex, uv0)},
        {4, VK_FORMAT_R32G32_SFLOAT, offsetof(Vertex, uv1)},
        {5, VK_FORMAT_R8G8B8A8_UNORM, offsetof(Vertex, color)},
        {6, VK_FORMAT_R8G8B8A8_UNORM, offsetof(Vertex, weather)},
    };
    return attributes;
}

GpuScene::GpuScene(const Device& device, const Scene& scene, const std::vector<Texture>& textures,
                   const Overlay& overlay)
    : arena_(device),
      lights_(scene.lights),
      glow_sources_(glow_sources(scene, textures)),
      bounds_(scene_bounds(scene))
{
    rig_ = scene.rig && scene.rig->settled ? scene.rig : nullptr;
    rest_lights_ = lights_;
    rest_glow_sources_ = glow_sources_;
    rest_bounds_ = bounds_;
    upload_textures(device, textures);
    make_materials(device, scene);
    upload_geometry(device, scene, overlay);
    upload_looks(device, scene);
    sum_up_materials();
}

void place_sphere(Draw& draw, const Bounds& box)
{
    const glm::vec3 centre = 0.5f * (box.low + box.high);
    const glm::vec3 half = 0.5f * (box.high - box.low);
    draw.centre_m = glm::vec3(draw.to_world * glm::vec4(centre, 1.0f));
    const glm::mat3 linear(draw.to_world);
    draw.radius_m = glm::length(glm::abs(linear[0]) * half.x + glm::abs(linear[1]) * half.y +
                                glm::abs(linear[2]) * half.z);
}

namespace {

void place_shape(Draw& draw, const MarchedShape& shape)
{
    const glm::vec3 half = half_of(shape, shape.rest);
    draw.to_world = shape.rest.to_world;
    place_sphere(draw, {-half, half});
}

}  // namespace

bool GpuScene::set_shapes(const std::vector<ShapeMoment>& moments)
{
    bool changed = false;
    for (std::size_t i = 0; i < shapes_.size(); ++i) {
        const ShapeMoment& now = i < moments.size() ? moments[i] : rest_shapes_[i];
        if (now == shapes_[i].rest) continue;
        check_moment(shapes_[i], now);
        shapes_[i].rest = now;
        changed = true;
    }
    if (!changed) return false;
    for (Draw& draw : draws_) {
        if (draw.shape >= 0) place_shape(draw, shapes_[static_cast<std::size_t>(draw.shape)]);
    }
    ++poses_;
    return true;
}

void GpuScene::upload_geometry(const Device& device, const Scene& scene, const Overlay& overlay)
{
    struct Range {
        std::uint32_t first_index, index_count;
        std::int32_t vertex_offset;
        glm::vec3 low, high;
        std::uint32_t vertex_count;
    };
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> indices;
    std::vector<std::vector<Range>> ranges(scene.meshes.size());
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        for (const Primitive& p : scene.meshes[m].primitives) {
            Range range{static_cast<std::uint32_t>(indices.size()),
                        static_cast<std::uint32_t>(p.indices.size()),
                        static_cast<std::int32_t>(vertices.size()), glm::vec3(1e30f),
                        glm::vec3(-1e30f), static_cast<std::uint32_t>(p.positions.size())};
            for (std::size_t i = 0; i < p.positions.size(); ++i) {
                const Vertex v = vertex_of(p, i);
                vertices.push_back(v);
                range.low = glm::min(range.low, v.position);
                range.high = glm::max(range.high, v.position);
            }
            indices.insert(indices.end(), p.indices.begin(), p.indices.end());
            ranges[m].push_back(range);
        }
    }
    first_bending_ = vertices.size();
    std::map<const Primitive*, std::shared_ptr<const Primitive>> shapes;
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        const auto& primitives = scene.meshes[instance.mesh].primitives;
        for (std::size_t p = 0; p < primitives.size(); ++p) {
            const Range& range = ranges[instance.mesh][p];
            if (range.index_count == 0) continue;
            Draw draw;
            draw.first_index = range.first_index;
            draw.index_count = range.index_count;
            draw.vertex_offset = range.vertex_offset;
            draw.vertex_count = range.vertex_count;
            draw.material = primitives[p].material;
            draw.instance_id = static_cast<std::uint32_t>(i);
            draw.primitive = static_cast<std::uint32_t>(p);
            draw.to_world = instance.to_world;
            draw.detail = instance.detail;
            levels_ = levels_ || draw.detail.radius_m > 0.0f;
            place_sphere(draw, {range.low, range.high});
            draw.mirrored = glm::determinant(glm::mat3(instance.to_world)) < 0.0f;
            if (rig_ && instance.moves) {
                draw.moving = static_cast<std::int32_t>(moving_.size());
                MovingDraw moving{instance, {range.low, range.high}, draw.index_count, 0, nullptr};
                if (primitives[p].deforms()) {
                    auto& shape = shapes[&primitives[p]];
                    if (!shape) shape = std::make_shared<const Primitive>(primitives[p]);
                    moving.shape = shape;
                    moving.first_vertex = bending_.size();
                    draw.vertex_offset =
                        static_cast<std::int32_t>(first_bending_ + bending_.size());
                    for (std::size_t v = 0; v < shape->positions.size(); ++v)
                        bending_.push_back(vertex_of(*shape, v));
                }
                moving_.push_back(std::move(moving));
            }
            const Material& material = scene.materials[draw.material];
            if (material.wind.moves() && !primitives[p].deforms() && !instance.backdrop) {
                auto& shape = shapes[&primitives[p]];
                if (!shape) shape = std::make_shared<const Primitive>(primitives[p]);
                draw.waving = static_cast<std::int32_t>(waving_.size());
                draw.vertex_offset = static_cast<std::int32_t>(first_bending_ + bending_.size());
                waving_.push_back({shape, {range.low, range.high}, material.wind, bending_.size()});
                for (std::size_t v = 0; v < shape->positions.size(); ++v)
                    bending_.push_back(vertex_of(*shape, v));
                if (bending_.size() > kMostWaving) {
                    throw Error("scene: wind bends more than " + std::to_string(kMostWaving) +
                                    " vertices, those of every instance counted",
                                "Give wind_bend and wind_flutter_m to fewer materials, or thin the "
                                "plants out.");
                }
            }
            if (material.decal.on) {
                decals_.push_back({material.decal.order, draw, {}});
            } else {
                draws_.push_back(draw);
            }
        }
    }
    for (const ProjectedDecal& box : scene.decals) {
        Decal decal{scene.materials[box.material].decal.order, {}, box};
        decal.draw.material = box.material;
        decal.draw.to_world = box.to_world;
        place_sphere(decal.draw, kDecalBox);
        decals_.push_back(std::move(decal));
    }
    std::stable_sort(decals_.begin(), decals_.end(),
                     [](const Decal& a, const Decal& b) { return a.order < b.order; });
    vertices.insert(vertices.end(), bending_.begin(), bending_.end());
    first_overlay_ = vertices.size();
    for (const Overlay::Part& part : overlay.parts) {
        Draw draw;
        draw.first_index = static_cast<std::uint32_t>(indices.size()) + part.first_index;
        draw.index_count = part.index_count;
        draw.vertex_offset = static_cast<std::int32_t>(first_overlay_);
        draw.material = part.material;
        draw.instance_id = part.instance_id;
        draw.overlay = true;
        const auto own = std::span(overlay.indices).subspan(part.first_index, part.index_count);
        if (!own.empty()) {
            const auto [least, most] = std::minmax_element(own.begin(), own.end());
            draw.first_vertex = *least;
            draw.vertex_count = *most - *least + 1;
        }
        place_sphere(draw, part.box);
        draws_.push_back(draw);
    }
    for (const MarchedShape& shape : scene.shapes) {
        check_shape(shape, scene);
        Draw draw;
        draw.material = shape.material;
        draw.instance_id = static_cast<std::uint32_t>(scene.instances.size() + shapes_.size());
        draw.shape = static_cast<std::int32_t>(shapes_.size());
        place_shape(draw, shape);
        draws_.push_back(draw);
        materials_[shape.material].on_shapes = true;
        shapes_.push_back(shape);
        rest_shapes_.push_back(shape.rest);
    }
    vertices.insert(vertices.end(), overlay.vertices.begin(), overlay.vertices.end());
    indices.insert(indices.end(), overlay.indices.begin(), overlay.indices.end());
    sort_draws(draws_, materials_);
    covered_.resize(draws_.size());
    for (Draw& draw : draws_) {
        draw.most_indices = draw.index_count;
        if (draw.overlay) overlay_counts_.push_back(std::exchange(draw.index_count, 0));
    }
    // Compute shaders fetch corners through texel views; a scene beyond their size has none.
    const std::size_t texels = std::max(vertices.size() * (sizeof(Vertex) / 16), indices.size());
    as_texels_ = texels > 0 && texels <= device.limits().maxTexelBufferElements;
    const VkBufferUsageFlags texel_usage =
        as_texels_ ? VkBufferUsageFlags{VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT} : 0;
    const bool on_cpu = device.info().kind == "cpu";  // SeenTriangles reads both
    vertices_ = arena_.buffer(
        {.name = "scene_vertices",
         .size = vertices.size() * sizeof(Vertex),
         .usage =
             VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT | texel_usage,
         .texel_format = as_texels_ ? VK_FORMAT_R32G32B32A32_UINT : VK_FORMAT_UNDEFINED,
         .host = on_cpu});
    indices_ = arena_.buffer(
        {.name = "scene_indices",
         .size = indices.size() * 4,
         .usage = VK_BUFFER_USAGE_INDEX_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT | texel_usage,
         .texel_format = as_texels_ ? VK_FORMAT_R32_UINT : VK_FORMAT_UNDEFINED,
         .host = on_cpu});
    upload_buffer(device, *vertices_, std::as_bytes(std::span(vertices)));
    upload_buffer(device, *indices_, std::as_bytes(std::span(indices)));
}

// Instances that look alike share a row; row 0 is nobody's.
void GpuScene::upload_looks(const Device& device, const Scene& scene)
{
    std::vector<glm::vec4> texels(INSTANCE_LOOK_TEXELS, glm::vec4(-1.0f));
    std::map<std::array<float, 6>, std::uint32_t> rows;
    const auto row_of = [&](const InstanceLook& look) -> std::uint32_t {
        if (look == InstanceLook{}) return 0;
        const glm::vec3 color = look.color.value_or(glm::vec3(-1.0f));
        const std::array<float, 6> key{color.r,
                                       color.g,
                                       color.b,
                                       look.metallic.value_or(-1.0f),
                                       look.roughness.value_or(-1.0f),
                                       look.emission.value_or(-1.0f)};
        const auto [row, is_new] = rows.try_emplace(key, static_cast<std::uint32_t>(rows.size() + 1));
        if (is_new) {
            texels.emplace_back(key[0], key[1], key[2], key[3]);
            texels.emplace_back(key[4], key[5], 0.0f, 0.0f);
        }
        return row->second;
    };
    const auto give = [&](Draw& draw) {
        draw.look = row_of(scene.instances[draw.instance_id].look);
        materials_[draw.material].looks = materials_[draw.material].looks || draw.look != 0;
    };
    for (Draw& draw : draws_) {
        if (draw.shape < 0) give(draw);
    }
    for (Decal& decal : decals_) {
        if (!decal.box) give(decal.draw);
    }
    instance_looks_ = arena_.buffer(
        {.name = "instance_looks",
         .size = texels.size() * sizeof(glm::vec4),
         .usage = VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
         .texel_format = VK_FORMAT_R32G32B32A32_SFLOAT});
    upload_buffer(device, *instance_looks_, std::as_bytes(std::span(texels)));
}

void GpuScene::lay(const Device& device, std::span<const Vertex> overlay, std::span<const Covered> covered)
{
    for (auto& triangles : covered_) triangles.clear();
    std::map<std::pair<std::uint32_t, std::uint32_t>, const Covered*> below;
    for (const Covered& one : covered) below[{one.instance_id, one.primitive}] = &one;
    for (std::size_t i = 0; i < draws_.size() && !below.empty(); ++i) {
        const Draw& draw = draws_[i];
        const auto found = draw.overlay ? below.end() : below.find({draw.instance_id, draw.primitive});
        if (found != below.end()) covered_[i] = found->second->triangles;
    }
    overlaid_ = !overlay.empty();
    std::size_t next = 0;
    for (Draw& draw : draws_) {
        if (draw.overlay) draw.index_count = overlaid_ ? overlay_counts_[next++] : 0;
    }
    if (overlaid_)
        upload_buffer(device, *vertices_, std::as_bytes(overlay), first_overlay_ * sizeof(Vertex));
}

void GpuScene::upload_textures(const Device& device, const std::vector<Texture>& textures)
{
    const VkImageUsageFlags usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    white_ = arena_.image({.name = "white", .usage = usage});
    upload_image(device, *white_, {std::vector<std::byte>(4, std::byte{255})});
    Staging staging(device);
    for (const Texture& texture : textures) {
        const auto levels = texture.levels();
        if (levels.empty()) {
            images_.push_back(nullptr);
            image_samplers_.push_back(nullptr);
            continue;
        }
        check_levels(texture);
        auto image = arena_.image({.name = texture.name,
                                   .format = vk_format(texture.format),
                                   .width = texture.width,
                                   .height = texture.height,
                                   .mips = static_cast<int>(levels.size()),
                                   .usage = usage});
        upload_image(device, *image, levels, staging);
        images_.push_back(std::move(image));
        image_samplers_.push_back(
            &sampler(device, texture.wrap_u, texture.wrap_v, texture.nearest));
    }
}

const SamplerHandle& GpuScene::sampler(const Device& device, Wrap u, Wrap v, bool nearest)
{
    const int key = static_cast<int>(u) * 8 + static_cast<int>(v) * 2 + (nearest ? 1 : 0);
    auto& slot = samplers_[key];
    if (!slot) {
        slot = make_sampler(device, nearest ? VK_FILTER_NEAREST : VK_FILTER_LINEAR, address_mode(u),
                            address_mode(v));
    }
    return slot;
}

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
        material.light_textures = layers.of_light;
        body_shares_ = body_shares_ || source.maps.thickness.present();
        if ((material.slots & 1u << TEXTURE_HEIGHT) != 0u)
            material.parallax = static_cast<std::uint32_t>(source.weather.parallax);
        if (material.parallax != PARALLAX_NONE && source.weather.parallax_level >= 0.0f)
            material.parallax |= PARALLAX_LEVEL;
        materials_.push_back(std::move(material));
        set_material(i, source);
    }
}

// Its reflectance is 0.04 wherever it is asked, whatever its textures say, and it has no tangent.
bool GpuScene::mirrors_as_glass(const GpuMaterial& material, const shared::MaterialConstants& c)
{
    const std::uint32_t other = BESIDES_SPECULAR_WORKFLOW | BESIDES_IRIDESCENT | BESIDES_ALONG;
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
                       (source.iridescence > 0.0f ? BESIDES_IRIDESCENT : 0u) |
                       (softens(source) ? BESIDES_SOFT_NORMAL : 0u) |
                       (c.anisotropy_strength > 0.0f ? BESIDES_ALONG : 0u) |
                       (one_read(source, c) ? BESIDES_ONE_READ : 0u) |
                       (wide_ground_[index] ? BESIDES_WIDE_GROUND : 0u);
    if (mirrors_as_glass(material, c)) material.besides |= BESIDES_AS_CLEARED;
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
                                                   source.area_lights ? 0.0f : 1.0f}};
    std::memcpy(looks_->mapped + index * sizeof(look), look, sizeof(look));
    materials_[index].masked = source.alpha_mode == AlphaMode::Mask;
    materials_[index].blended = is_blended(source) && !source.decal.on;
    materials_[index].decal_weather = source.decal.weights.w > 0.0f;
    materials_[index].casts_shadows = source.casts_shadows;
    materials_[index].glows = source.emissive * source.emissive_strength != glm::vec3(0.0f);
}

// Layers have a row a material; the G-buffer numbers the rows behind the models.
std::uint32_t GpuScene::set_layers(GpuMaterial& material, const Material& m)
{
    if (material.layers_row == 0) {
        if (lighting_models_.count() + layers_used_ > 255) {
            throw Error("scene: " + std::to_string(layers_used_ + 1) +
                            " materials with a coat, sheen, anisotropy, skin, hair or light that passes; at "
                            "most " +
                            std::to_string(256 - lighting_models_.count()) + " are possible",
                        "Merge materials that are alike.");
        }
        material.layers_row = ++layers_used_;
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
        glm::vec4(m.second.scatter_color, 0.0f)};
    std::memcpy(layers_->mapped + row * sizeof(texels), texels, sizeof(texels));
    return lighting_models_.count() + static_cast<std::uint32_t>(row);
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
        layer_shares_ = layer_shares_ || shown || softens(m);
    }
    baked_ = any([](const Material& m) { return m.light_map.present(); });
    decals_refused_ = !decals_.empty() && any([](const Material& m) { return !m.decal.received; });
    glows_ = glowing(glow_sources_, current_);
    point_lamps_ = any([](const Material& m) { return !m.area_lights; });
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
