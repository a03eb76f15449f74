#include "scene/patches/triangles.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/hash.h"
#include "base/portable_math.h"

namespace petrichor::scene {
namespace {

bool finite(const glm::vec3& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// Corners beyond this are no place in a scene; their products would overflow.
constexpr float kFarthest_m = 1e7f;

bool usable(const glm::vec3& v)
{
    return finite(v) && std::abs(v.x) < kFarthest_m && std::abs(v.y) < kFarthest_m &&
           std::abs(v.z) < kFarthest_m;
}

bool stops_light(const Material& material)
{
    return material.alpha_mode != AlphaMode::Blend && material.transmission < 0.5f &&
           !material.decal.on;
}

float wrapped(float x, Wrap wrap)
{
    if (wrap == Wrap::Clamp) return std::clamp(x, 0.0f, 1.0f);
    const float whole = std::floor(x);
    const float part = x - whole;
    if (wrap == Wrap::Repeat) return part;
    return static_cast<std::int64_t>(whole) % 2 == 0 ? part : 1.0f - part;
}

}  // namespace

Triangles::Triangles(const Scene& scene, std::span<const AlphaImage> alpha)
    : scene_(&scene), alpha_(alpha.begin(), alpha.end())
{
    std::size_t expected = 0;
    for (const Instance& instance : scene.instances) {
        if (!instance.stands()) continue;
        for (const Primitive& primitive : scene.meshes[instance.mesh].primitives)
            expected += primitive.indices.size() / 3;
    }
    if (expected >= std::numeric_limits<std::uint32_t>::max() / 2) {
        throw Error("scene: " + std::to_string(expected) + " triangles, at most 2147483646",
                    "Split the scene into several files.");
    }
    for (auto* list : {&corners_, &edges1_, &edges2_}) list->reserve(expected);
    source_.reserve(expected);
    run_.reserve(expected);
    flags_.reserve(expected);
    low_ = glm::vec3(std::numeric_limits<float>::max());
    high_ = glm::vec3(std::numeric_limits<float>::lowest());
    Hasher hasher;
    const Bounds content = scene_bounds(scene);
    const glm::vec3 middle = 0.5f * (content.low + content.high);
    const glm::vec3 across = content.high - content.low;
    const float reach = kBackdropReach * 0.5f * std::sqrt(glm::dot(across, across));
    for (const Instance& instance : scene.instances) {
        if (!instance.stands()) continue;
        for (const Primitive& primitive : scene.meshes[instance.mesh].primitives) {
            const Material& material = scene.materials[primitive.material];
            if (!stops_light(material)) {
                blended_ += primitive.indices.size() / 3;
                continue;
            }
            const bool mirrored = glm::determinant(glm::mat3(instance.to_world)) < 0.0f;
            const bool turned = mirrored != material.cull_front;
            const TextureUse& use = material.base_color_texture;
            const bool masked = material.alpha_mode == AlphaMode::Mask;
            std::uint8_t flags = 0;
            if (material.double_sided && !material.cull_front) flags |= kTriangleDoubleSided;
            if (masked) flags |= kTriangleMasked;
            if (material.weather.sheltered) flags |= kTriangleSheltered;
            if (instance.backdrop) flags |= kTriangleBackdrop;
            runs_.push_back({size(), &primitive, &instance.to_world, turned});
            hasher.add(flags);
            hasher.add(turned);
            if (masked) {
                for (const float value :
                     {material.alpha_cutoff, material.base_color.a, use.offset.x, use.offset.y,
                      use.scale.x, use.scale.y, use.rotation_rad})
                    hasher.add(value);
                hasher.add(use.texcoord);
                hasher.add(use.texture);
            }
            std::vector<glm::vec3> world;
            world.reserve(primitive.positions.size());
            for (const glm::vec3& p : primitive.positions)
                world.push_back(glm::vec3(instance.to_world * glm::vec4(p, 1.0f)));
            for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
                const glm::vec3 a = world[primitive.indices[i]];
                glm::vec3 b = world[primitive.indices[i + 1]];
                glm::vec3 c = world[primitive.indices[i + 2]];
                if (turned) std::swap(b, c);
                if (instance.backdrop) {
                    const auto near = [&](const glm::vec3& p) {
                        const glm::vec3 d = p - middle;
                        return glm::dot(d, d) <= reach * reach;
                    };
                    if (!near(a) || !near(b) || !near(c)) continue;
                }
                const glm::vec3 cross = glm::cross(b - a, c - a);
                const float twice = std::sqrt(glm::dot(cross, cross));
                if (!usable(a) || !usable(b) || !usable(c) || !(twice > 1e-20f)) {
                    ++degenerate_;
                    continue;
                }
                corners_.push_back(a);
                edges1_.push_back(b - a);
                edges2_.push_back(c - a);
                source_.push_back(static_cast<std::uint32_t>(i / 3));
                run_.push_back(static_cast<std::uint32_t>(runs_.size() - 1));
                flags_.push_back(flags);
                if (!instance.backdrop) area_ += 0.5 * static_cast<double>(twice);
                backdrop_ = backdrop_ || instance.backdrop;
                for (const glm::vec3& p : {a, b, c}) {
                    farthest_m_ = std::max({farthest_m_, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
                    if (!instance.backdrop) {
                        low_ = glm::min(low_, p);
                        high_ = glm::max(high_, p);
                    }
                    hasher.add_numbers(std::span<const float>(&p.x, 3));
                }
                if (masked) {
                    for (int k = 0; k < 3; ++k) {
                        const std::uint32_t v = primitive.indices[i + static_cast<std::size_t>(k)];
                        const auto& uvs = use.texcoord == 1 ? primitive.uv1 : primitive.uv0;
                        if (v < uvs.size())
                            hasher.add_numbers(std::span<const float>(&uvs[v].x, 2));
                        if (v < primitive.colors.size()) hasher.add(primitive.colors[v].a);
                    }
                }
            }
        }
    }
    if (low_.x > high_.x) low_ = high_ = glm::vec3(0.0f);
    for (const AlphaImage& image : alpha_) {
        hasher.add(image.width);
        hasher.add(image.height);
        hasher.add_bytes(std::as_bytes(std::span(image.alpha)));
    }
    fingerprint_ = hasher.text();
}

const Triangles::Run& Triangles::run_of(std::uint32_t t) const
{
    return runs_[run_[t]];
}

glm::vec3 Triangles::normal(std::uint32_t t) const
{
    const glm::vec3 cross = glm::cross(edges1_[t], edges2_[t]);
    return cross / std::sqrt(glm::dot(cross, cross));
}

float Triangles::area_m2(std::uint32_t t) const
{
    const glm::vec3 cross = glm::cross(edges1_[t], edges2_[t]);
    return 0.5f * std::sqrt(glm::dot(cross, cross));
}

std::uint32_t Triangles::material(std::uint32_t t) const
{
    return run_of(t).primitive->material;
}

namespace {

// The three corners of a triangle of a primitive, in the order of Triangles.
struct CornerNumbers {
    std::uint32_t v[3];
};
CornerNumbers corners_in(const Primitive& primitive, std::uint32_t source, bool turned)
{
    const std::uint32_t* i = primitive.indices.data() + std::size_t{source} * 3;
    return turned ? CornerNumbers{{i[0], i[2], i[1]}} : CornerNumbers{{i[0], i[1], i[2]}};
}

template <class T>
T between(const std::vector<T>& values, const CornerNumbers& c, Barycentric at)
{
    return values[c.v[0]] * (1.0f - at.b1 - at.b2) + values[c.v[1]] * at.b1 +
           values[c.v[2]] * at.b2;
}

}  // namespace

glm::vec2 Triangles::uv(std::uint32_t t, Barycentric at, const TextureUse& use) const
{
    const Run& run = run_of(t);
    const auto& uvs = use.texcoord == 1 ? run.primitive->uv1 : run.primitive->uv0;
    if (uvs.empty()) return glm::vec2(0.0f);
    const glm::vec2 raw = between(uvs, corners_in(*run.primitive, source_[t], run.turned), at);
    const glm::vec2 scaled = raw * use.scale;
    if (use.rotation_rad == 0.0f) return scaled + use.offset;
    const float s = portable_sin(use.rotation_rad), c = portable_cos(use.rotation_rad);
    return glm::vec2(c * scaled.x + s * scaled.y, c * scaled.y - s * scaled.x) + use.offset;
}

glm::vec4 Triangles::color(std::uint32_t t, Barycentric at) const
{
    const Run& run = run_of(t);
    if (run.primitive->colors.empty()) return glm::vec4(1.0f);
    return between(run.primitive->colors, corners_in(*run.primitive, source_[t], run.turned), at);
}

glm::vec4 Triangles::weather(std::uint32_t t, Barycentric at) const
{
    const Run& run = run_of(t);
    if (run.primitive->weather.empty()) return glm::vec4(1.0f);
    return between(run.primitive->weather, corners_in(*run.primitive, source_[t], run.turned), at);
}

glm::vec3 Triangles::shading_normal(std::uint32_t t, Barycentric at) const
{
    const Run& run = run_of(t);
    if (run.primitive->normals.empty()) return normal(t);
    const glm::vec3 local =
        between(run.primitive->normals, corners_in(*run.primitive, source_[t], run.turned), at);
    const glm::mat3 m(*run.to_world);
    // Of the inverse transpose, up to a factor: the cofactors.
    const glm::vec3 world = glm::cross(m[1], m[2]) * local.x + glm::cross(m[2], m[0]) * local.y +
                            glm::cross(m[0], m[1]) * local.z;
    const float sign = run.turned ? -1.0f : 1.0f;
    const float length = std::sqrt(glm::dot(world, world));
    return length > 0.0f && std::isfinite(length) ? world * (sign / length) : normal(t);
}

bool Triangles::is_hole(std::uint32_t t, Barycentric at) const
{
    if ((flags_[t] & kTriangleMasked) == 0) return false;
    const Material& surface = scene_->materials[material(t)];
    float alpha = surface.base_color.a * color(t, at).a;
    const TextureUse& use = surface.base_color_texture;
    if (use.present() && static_cast<std::size_t>(use.texture) < alpha_.size()) {
        const AlphaImage& image = alpha_[static_cast<std::size_t>(use.texture)];
        if (!image.alpha.empty()) {
            const glm::vec2 where = uv(t, at, use);
            const EncodedImage& source = scene_->textures[static_cast<std::size_t>(use.texture)];
            const auto texel = [](float x, Wrap wrap, int size) {
                const float place = wrapped(std::isfinite(x) ? x : 0.0f, wrap);
                return std::clamp(static_cast<int>(place * static_cast<float>(size)), 0, size - 1);
            };
            const int x = texel(where.x, source.wrap_u, image.width);
            const int y = texel(where.y, source.wrap_v, image.height);
            alpha *= static_cast<float>(image.alpha[static_cast<std::size_t>(y) *
                                                        static_cast<std::size_t>(image.width) +
                                                    static_cast<std::size_t>(x)]) /
                     255.0f;
        }
    }
    return alpha < surface.alpha_cutoff;
}

}  // namespace petrichor::scene
