#include "gpu/upload/gpu_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

#include "base/error.h"
#include "gpu/upload/detail/texel_format.h"
#include "gpu/upload/draw.h"
#include "scene/light_shape.h"
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

VertexAttribute position_attribute()
{
    return {0, VK_FORMAT_R32G32B32_SFLOAT, 0};
}

GpuScene::GpuScene(const Device& device, const Scene& scene, const std::vector<Texture>& textures,
                   const Overlay& overlay)
    : arena_(device),
      texture_stretch_(device.texture_anisotropy()),
      lights_(scene.lights),
      glow_sources_(glow_sources(scene, textures)),
      bounds_(scene_bounds(scene))
{
    rig_ = scene.rig && scene.rig->settled ? scene.rig : nullptr;
    rest_lights_ = lights_;
    rest_glow_sources_ = glow_sources_;
    rest_bounds_ = posed_bounds_ = bounds_;
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
            const bool own = own_surfaces_.moves(materials_[draw.material].own_surface) && !material.decal.on;
            if ((material.wind.moves() || own) && !primitives[p].deforms() && !instance.backdrop) {
                auto& shape = shapes[&primitives[p]];
                if (!shape) shape = std::make_shared<const Primitive>(primitives[p]);
                draw.waving = static_cast<std::int32_t>(waving_.size());
                draw.vertex_offset = static_cast<std::int32_t>(first_bending_ + bending_.size());
                waving_.push_back({shape, {range.low, range.high}, material.wind, bending_.size(),
                                   own ? static_cast<std::int32_t>(movers_.size()) : -1});
                if (own) movers_.push_back({shape, bending_.size(), draw.material, draw.to_world});
                for (std::size_t v = 0; v < shape->positions.size(); ++v)
                    bending_.push_back(vertex_of(*shape, v));
                if (bending_.size() > kMostWaving) {
                    throw Error("scene: wind and surfaces of your own move more than " + std::to_string(kMostWaving) +
                                    " vertices, those of every instance counted",
                                "Give wind_bend, wind_flutter_m and such surfaces to fewer materials, or thin "
                                "the meshes out.");
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
    first_overlay_index_ = indices.size();
    std::map<std::uint32_t, std::uint32_t> overlay_parts;  // by their first index
    for (const Overlay::Part& part : overlay.parts) {
        Draw draw;
        draw.first_index = static_cast<std::uint32_t>(indices.size()) + part.first_index;
        draw.index_count = part.index_count;
        draw.vertex_offset = static_cast<std::int32_t>(first_overlay_);
        draw.material = part.material;
        draw.instance_id = part.instance_id;
        draw.overlay = true;
        draw.ice = part.ice;
        overlay_parts[draw.first_index] = static_cast<std::uint32_t>(&part - overlay.parts.data());
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
    for (const Draw& draw : draws_) {
        const bool laid_out = draw.moving < 0 && draw.shape < 0 && draw.to_world == glm::mat4(1.0f);
        materials_[draw.material].in_world = materials_[draw.material].in_world && laid_out;
    }
    covered_.resize(draws_.size());
    for (Draw& draw : draws_) {
        draw.most_indices = draw.index_count;
        if (!draw.overlay) continue;
        overlay_parts_.push_back(overlay_parts.at(draw.first_index));
        draw.index_count = 0;
    }
    steep_ = steep_triangles(draws_, materials_, vertices, indices);
    // Compute shaders fetch corners through texel views; a scene beyond their size has none.
    const std::size_t texels = std::max(vertices.size() * (sizeof(Vertex) / 16), indices.size());
    as_texels_ = texels > 0 && texels <= device.limits().maxTexelBufferElements;
    vertex_lamps_ = as_texels_ && std::any_of(scene.lights.begin(), scene.lights.end(), scene::lit_by_vertex);
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
    positions_ = arena_.buffer({.name = "scene_positions",
                                .size = vertices.size() * sizeof(glm::vec3),
                                .usage = VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                .host = on_cpu});
    upload_vertices(device, vertices, 0);
    upload_buffer(device, *indices_, std::as_bytes(std::span(indices)));
}

void GpuScene::upload_vertices(const Device& device, std::span<const Vertex> vertices, std::size_t first)
{
    upload_buffer(device, *vertices_, std::as_bytes(vertices), first * sizeof(Vertex));
    if (positions_->mapped) {
        auto* to = reinterpret_cast<glm::vec3*>(positions_->mapped) + first;
        for (const Vertex& v : vertices) *to++ = v.position;
        return;
    }
    std::vector<glm::vec3> positions;
    positions.reserve(vertices.size());
    for (const Vertex& v : vertices) positions.push_back(v.position);
    upload_buffer(device, *positions_, std::as_bytes(std::span(positions)), first * sizeof(glm::vec3));
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

void GpuScene::lay(const Device& device, const LaidOverlay& overlay)
{
    for (auto& triangles : covered_) triangles.clear();
    std::map<std::pair<std::uint32_t, std::uint32_t>, const Covered*> below;
    for (const Covered& one : overlay.covered) below[{one.instance_id, one.primitive}] = &one;
    for (std::size_t i = 0; i < draws_.size() && !below.empty(); ++i) {
        const Draw& draw = draws_[i];
        const auto found = draw.overlay ? below.end() : below.find({draw.instance_id, draw.primitive});
        if (found != below.end()) covered_[i] = found->second->triangles;
    }
    overlaid_ = !overlay.vertices.empty();
    snow_lies_ = overlaid_ && overlay.snow;
    std::size_t next = 0;
    for (std::size_t i = 0; i < draws_.size(); ++i) {
        Draw& draw = draws_[i];
        if (!draw.overlay) continue;
        draw.index_count = overlaid_ ? overlay.counts[overlay_parts_[next++]] : 0;
        const auto hidden = overlay.hidden.subspan(overlaid_ ? (draw.first_index - first_overlay_index_) / 3 : 0, draw.index_count / 3);
        covered_[i].assign(hidden.begin(), hidden.end());
    }
    ++lays_;
    if (!overlaid_) return;
    upload_vertices(device, overlay.vertices, first_overlay_);
    upload_buffer(device, *indices_, std::as_bytes(overlay.indices), first_overlay_index_ * 4);
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
                            address_mode(v), false, 0.0f, false, nearest ? 1 : texture_stretch_);
    }
    return slot;
}

}  // namespace petrichor::gpu
