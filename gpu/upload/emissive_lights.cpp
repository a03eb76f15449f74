#include "gpu/upload/emissive_lights.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <glm/gtc/packing.hpp>
#include <map>
#include <numeric>
#include <span>
#include <tuple>

#include "formulas/color/srgb.h"

namespace petrichor::gpu {

namespace {

constexpr float kDark = 0.02f;  // of the brightest radiance of a material
constexpr float kFilled = 0.6f;  // of their common rectangle, by panes of one window
constexpr float kFlat = 0.6f;  // |sum of area vectors| over the area: of a pane with thin edges more, of a dome half
constexpr std::size_t kMost = 256;
constexpr float kFaint = 1e-3f;  // of the flux of all
constexpr float kPi = 3.14159265f;
const glm::vec3 kWeights(0.2126f, 0.7152f, 0.0722f);

struct Facet {
    glm::vec3 corners[3];
    glm::vec3 area;      // half the cross product
    glm::vec3 radiance;  // by channel, for an emission of 1
};

// Facets that belong together.
struct Patch {
    std::vector<const Facet*> facets;
    float area = 0.0f;
    glm::vec3 vector{0.0f};    // sum of area vectors
    glm::vec3 centre{0.0f};    // by area
    glm::vec3 radiance{0.0f};  // mean by area
    glm::vec3 low{1e30f}, high{-1e30f};

    bool flat() const { return glm::length(vector) > kFlat * area; }
};

float wrapped(float t, Wrap wrap)
{
    if (wrap == Wrap::Clamp) return std::clamp(t, 0.0f, 1.0f);
    if (wrap == Wrap::Mirror) {
        const float u = t - 2.0f * std::floor(0.5f * t);
        return u > 1.0f ? 2.0f - u : u;
    }
    return t - std::floor(t);
}

// Linear colour of a texture at a place, from a level of at most 64 texels a side.
glm::vec3 texel_at(const Texture& stored, glm::vec2 uv)
{
    const Texture& texture = stored.plain ? *stored.plain : stored;
    std::size_t level = 0;
    int width = texture.width;
    int height = texture.height;
    const std::vector<std::span<const std::byte>> levels = texture.levels();
    while (level + 1 < levels.size() && std::max(width, height) > 64) {
        ++level;
        width = std::max(1, width / 2);
        height = std::max(1, height / 2);
    }
    const auto pick = [](float t, int size) {
        return std::clamp(static_cast<int>(t * static_cast<float>(size)), 0, size - 1);
    };
    const int x = pick(wrapped(uv.x, stored.wrap_u), width);
    const int y = pick(wrapped(uv.y, stored.wrap_v), height);
    const auto at = static_cast<std::size_t>(y * width + x);
    const std::byte* bytes = levels[level].data();
    glm::vec3 color(0.0f);
    for (int c = 0; c < 3; ++c) {
        const auto i = 4 * at + static_cast<std::size_t>(c);
        if (texture.format == TexelFormat::Rgba8Srgb) {
            color[c] = shared::linear_from_srgb(static_cast<float>(bytes[i]) / 255.0f);
        } else if (texture.format == TexelFormat::Rgba8Unorm) {
            color[c] = static_cast<float>(bytes[i]) / 255.0f;
        } else if (texture.format == TexelFormat::Rgba16Float) {
            std::uint16_t half;
            std::memcpy(&half, bytes + 2 * i, 2);
            color[c] = glm::unpackHalf1x16(half);
        }
    }
    return color;
}

std::vector<Facet> facets_of(const Primitive& p, const Material& material,
                             const glm::mat4& to_world, const std::vector<Texture>& textures)
{
    const TextureUse& use = material.emissive_texture;
    const auto t = static_cast<std::size_t>(use.texture);
    const bool textured =
        use.texture != kNoTexture && t < textures.size() && !textures[t].levels().empty();
    const auto& uvs = use.texcoord == 0 ? p.uv0 : p.uv1;
    std::vector<Facet> facets;
    float brightest = 0.0f;
    for (std::size_t i = 0; i + 2 < p.indices.size(); i += 3) {
        Facet f;
        glm::vec2 uv(0.0f);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t v = p.indices[i + k];
            f.corners[k] = glm::vec3(to_world * glm::vec4(p.positions[v], 1.0f));
            if (!uvs.empty()) uv += uvs[v] / 3.0f;
        }
        f.area = 0.5f * glm::cross(f.corners[1] - f.corners[0], f.corners[2] - f.corners[0]);
        if (!(glm::length(f.area) > 0.0f)) continue;
        f.radiance = glm::vec3(1.0f);
        if (textured) {
            const float c = std::cos(use.rotation_rad);
            const float s = std::sin(use.rotation_rad);
            const glm::vec2 at = uv * use.scale;
            f.radiance *= texel_at(
                textures[t], glm::vec2(c * at.x + s * at.y, c * at.y - s * at.x) + use.offset);
        }
        brightest = std::max(brightest, glm::dot(f.radiance, kWeights));
        facets.push_back(f);
    }
    std::erase_if(facets, [&](const Facet& f) {
        return !(glm::dot(f.radiance, kWeights) > kDark * brightest);
    });
    return facets;
}

std::size_t root_of(std::vector<std::size_t>& parents, std::size_t i)
{
    while (parents[i] != i) i = parents[i] = parents[parents[i]];
    return i;
}

// Groups by the roots; in the order of their first members.
template <class Item>
std::vector<std::vector<Item>> grouped(const std::vector<Item>& items,
                                       std::vector<std::size_t>& parents)
{
    std::map<std::size_t, std::size_t> numbers;
    std::vector<std::vector<Item>> groups;
    for (std::size_t i = 0; i < items.size(); ++i) {
        const auto [at, added] = numbers.emplace(root_of(parents, i), groups.size());
        if (added) groups.emplace_back();
        groups[at->second].push_back(items[i]);
    }
    return groups;
}

Patch patch_of(const std::vector<const Facet*>& facets)
{
    Patch patch;
    patch.facets = facets;
    for (const Facet* f : facets) {
        const float area = glm::length(f->area);
        patch.area += area;
        patch.vector += f->area;
        patch.centre += area * (f->corners[0] + f->corners[1] + f->corners[2]) / 3.0f;
        patch.radiance += area * f->radiance;
        for (const glm::vec3& corner : f->corners) {
            patch.low = glm::min(patch.low, corner);
            patch.high = glm::max(patch.high, corner);
        }
    }
    patch.centre /= patch.area;
    patch.radiance /= patch.area;
    return patch;
}

// Facets that share a corner, to a tenth of a millimetre.
std::vector<Patch> connected(const std::vector<Facet>& facets)
{
    std::vector<const Facet*> all;
    std::vector<std::size_t> parents(facets.size());
    std::iota(parents.begin(), parents.end(), std::size_t{0});
    std::map<std::tuple<long, long, long>, std::size_t> corners;
    for (std::size_t i = 0; i < facets.size(); ++i) {
        all.push_back(&facets[i]);
        for (const glm::vec3& c : facets[i].corners) {
            const std::tuple key(std::lround(c.x * 1e4f), std::lround(c.y * 1e4f),
                                 std::lround(c.z * 1e4f));
            const auto [at, added] = corners.emplace(key, i);
            if (!added) parents[root_of(parents, i)] = root_of(parents, at->second);
        }
    }
    std::vector<Patch> patches;
    for (const auto& group : grouped(all, parents)) patches.push_back(patch_of(group));
    return patches;
}

// Where a flat patch lies in its plane: unit axes along its longest extent and across, and how far it reaches.
struct InPlane {
    glm::vec3 a{0.0f}, b{0.0f};
    glm::vec2 reach_m{0.0f};
};

InPlane in_plane(const Patch& patch)
{
    const glm::vec3 n = glm::normalize(patch.vector);
    const glm::vec3 helper = std::abs(n.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    const glm::vec3 u = glm::normalize(glm::cross(helper, n));
    const glm::vec3 v = glm::cross(n, u);
    // Second moments of the area turn the axes the way the patch lies: of a triangle a twelfth of
    // the sum over its corners and their sum.
    float uu = 0.0f, uv = 0.0f, vv = 0.0f;
    for (const Facet* f : patch.facets) {
        const float weight = glm::length(f->area);
        glm::vec2 sum(0.0f);
        for (int k = 0; k < 4; ++k) {
            glm::vec2 p = sum;
            if (k < 3) {
                const glm::vec3 offset = f->corners[k] - patch.centre;
                p = {glm::dot(offset, u), glm::dot(offset, v)};
                sum += p;
            }
            uu += weight * p.x * p.x;
            uv += weight * p.x * p.y;
            vv += weight * p.y * p.y;
        }
    }
    const float turn = 0.5f * std::atan2(2.0f * uv, uu - vv);
    InPlane lies;
    lies.a = std::cos(turn) * u + std::sin(turn) * v;
    lies.b = glm::cross(n, lies.a);
    for (const Facet* f : patch.facets) {
        for (const glm::vec3& corner : f->corners) {
            lies.reach_m = glm::max(lies.reach_m, glm::abs(glm::vec2(glm::dot(corner - patch.centre, lies.a),
                                                                     glm::dot(corner - patch.centre, lies.b))));
        }
    }
    return lies;
}

// Panes of one window: flat, in one plane, not farther apart than half of the smaller one's size, with so little
// between them that both are one rectangle.
bool belong_together(const Patch& a, const Patch& b)
{
    if (!a.flat() || !b.flat()) return false;
    const glm::vec3 n = glm::normalize(a.vector);
    if (glm::dot(n, glm::normalize(b.vector)) < 0.98f) return false;
    const float size = std::min(glm::length(a.high - a.low), glm::length(b.high - b.low));
    if (std::abs(glm::dot(n, b.centre - a.centre)) > 0.1f * size) return false;
    const glm::vec3 gap = glm::max(glm::max(a.low - b.high, b.low - a.high), glm::vec3(0.0f));
    if (!(glm::length(gap) < 0.5f * size)) return false;
    std::vector<const Facet*> both = a.facets;
    both.insert(both.end(), b.facets.begin(), b.facets.end());
    const Patch joined = patch_of(both);
    const InPlane lies = in_plane(joined);
    return glm::length(joined.vector) > kFilled * 4.0f * lies.reach_m.x * lies.reach_m.y;
}

std::vector<Patch> merged(const std::vector<Patch>& patches)
{
    if (patches.size() > 4096) return patches;
    std::vector<std::size_t> parents(patches.size());
    std::iota(parents.begin(), parents.end(), std::size_t{0});
    for (std::size_t i = 0; i < patches.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            if (belong_together(patches[k], patches[i]))
                parents[root_of(parents, i)] = root_of(parents, k);
        }
    }
    std::vector<Patch> result;
    for (const auto& group : grouped(patches, parents)) {
        std::vector<const Facet*> facets;
        for (const Patch& patch : group)
            facets.insert(facets.end(), patch.facets.begin(), patch.facets.end());
        result.push_back(patch_of(facets));
    }
    return result;
}

// A rectangle in the patch's plane, in the shape of its extents, with its area.
Light rectangle_of(const Patch& patch, bool both_sides)
{
    Light light;
    light.kind = LightKind::Rectangle;
    light.direction = glm::normalize(patch.vector);
    light.both_sides = both_sides;
    const InPlane lies = in_plane(patch);
    const glm::vec2 reach = lies.reach_m;
    const float scale = std::sqrt(glm::length(patch.vector) / std::max(4.0f * reach.x * reach.y, 1e-12f));
    light.half_u_m = lies.a * (reach.x * scale);
    light.half_v_m = lies.b * (reach.y * scale);
    return light;
}

Light light_of(const Patch& patch, bool both_sides)
{
    Light light;
    if (patch.flat()) {
        light = rectangle_of(patch, both_sides);
        light.intensity = 1.0f;
    } else {
        // Seen from all around, a convex body shows a quarter of its surface.
        light.intensity = patch.area / 4.0f;
        light.radius_m = std::sqrt(patch.area / (4.0f * kPi));
    }
    light.glows = true;
    light.name = "glow";
    light.position_m = patch.centre;
    return light;
}

bool encloses(const Patch& patch, const Light& light)
{
    if (light.kind == LightKind::Directional) return false;
    return glm::all(glm::greaterThanEqual(light.position_m, patch.low)) &&
           glm::all(glm::lessThanEqual(light.position_m, patch.high));
}

}  // namespace

std::vector<GlowSource> glow_sources(const Scene& scene, const std::vector<Texture>& textures)
{
    std::vector<GlowSource> sources;
    for (const Instance& instance : scene.instances) {
        if (instance.detail.level != 0) continue;
        const auto carrier = instance.moves ? std::make_shared<const Instance>(instance) : nullptr;
        for (const Primitive& p : scene.meshes[instance.mesh].primitives) {
            const Material& material = scene.materials[p.material];
            if (material.emissive * material.emissive_strength == glm::vec3(0.0f)) continue;
            if (instance.moves && p.deforms()) continue;
            const auto facets = facets_of(p, material, instance.to_world, textures);
            for (const Patch& patch : merged(connected(facets))) {
                if (std::any_of(scene.lights.begin(), scene.lights.end(),
                                [&](const Light& l) { return encloses(patch, l); })) {
                    continue;
                }
                sources.push_back({light_of(patch, material.double_sided), patch.radiance,
                                   patch.area, p.material, carrier});
            }
        }
    }
    return sources;
}

std::vector<Light> glowing(const std::vector<GlowSource>& sources,
                           const std::vector<Material>& materials)
{
    std::vector<std::pair<float, Light>> found;
    float total = 0.0f;
    for (const GlowSource& source : sources) {
        const Material& material = materials[source.material];
        const glm::vec3 radiance = material.emissive * material.emissive_strength * source.share;
        const float peak = std::max({radiance.r, radiance.g, radiance.b});
        if (!(peak > 0.0f)) continue;
        Light light = source.light;
        light.intensity *= peak;
        light.color = radiance / peak;
        const float flux = source.area_m2 * glm::dot(radiance, kWeights);
        found.emplace_back(flux, light);
        total += flux;
    }
    std::erase_if(found, [&](const auto& one) { return one.first < kFaint * total; });
    std::stable_sort(found.begin(), found.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<Light> lights;
    for (const auto& [flux, light] : found) {
        if (lights.size() < kMost) lights.push_back(light);
    }
    return lights;
}

std::vector<Light> emissive_lights(const Scene& scene, const std::vector<Texture>& textures)
{
    return glowing(glow_sources(scene, textures), scene.materials);
}

}  // namespace petrichor::gpu
