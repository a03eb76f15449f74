#include "scene/patches/light_map.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <mutex>

#include "base/error.h"
#include "base/parallel.h"
#include "formulas/light/weak_shadow.h"
#include "scene/patches/detail/cells.h"
#include "scene/patches/detail/sampling.h"
#include "scene/patches/lamps.h"

namespace petrichor::scene {
namespace {

constexpr int kPoints = 4;          // of a texel: a turned square
constexpr std::size_t kMostLayers = 4;  // of surfaces over a texel in the mean
constexpr glm::vec2 kPlaces[kPoints] = {
    {0.125f, 0.375f}, {0.625f, 0.125f}, {0.375f, 0.875f}, {0.875f, 0.625f}};

// A point of a triangle that lies on a texel.
struct Site {
    std::uint32_t texel;
    std::uint32_t triangle;
    Barycentric at;
};

int wrapped(int i, int size)
{
    return ((i % size) + size) % size;
}

// Adds the sites of a triangle; false when there are too many of them.
bool add_sites(const Triangles& triangles, std::uint32_t t, const TextureUse& use, int size,
               std::size_t most, std::vector<Site>& sites)
{
    std::array<glm::vec2, 3> uv{triangles.uv(t, {0.0f, 0.0f}, use), triangles.uv(t, {1.0f, 0.0f}, use),
                                triangles.uv(t, {0.0f, 1.0f}, use)};
    for (glm::vec2& c : uv) {
        c *= static_cast<float>(size);
        if (!(std::abs(c.x) < 1e6f && std::abs(c.y) < 1e6f)) return true;
    }
    const glm::vec2 low = glm::floor(glm::min(uv[0], glm::min(uv[1], uv[2])));
    const glm::vec2 high = glm::max(uv[0], glm::max(uv[1], uv[2]));
    const glm::vec2 e1 = uv[1] - uv[0], e2 = uv[2] - uv[0];
    const float area = e1.x * e2.y - e1.y * e2.x;
    if (!(std::abs(area) > 1e-6f)) return true;
    if (0.5 * std::abs(static_cast<double>(area)) > static_cast<double>(most)) return false;
    for (int y = static_cast<int>(low.y); y <= static_cast<int>(high.y); ++y) {
        for (int x = static_cast<int>(low.x); x <= static_cast<int>(high.x); ++x) {
            for (const glm::vec2& place : kPlaces) {
                const glm::vec2 d = glm::vec2(x, y) + place - uv[0];
                const float b = (d.x * e2.y - d.y * e2.x) / area;
                const float c = (e1.x * d.y - e1.y * d.x) / area;
                if (!(b >= 0.0f && c >= 0.0f && b + c <= 1.0f)) continue;
                if (sites.size() >= most) return false;
                sites.push_back({static_cast<std::uint32_t>(wrapped(y, size) * size + wrapped(x, size)),
                                 t,
                                 {b, c}});
            }
        }
    }
    return true;
}

// Light at one point; weight 0 inside a body.
struct Gathered {
    glm::vec3 lux{0.0f};
    glm::vec4 seen{0.0f};
    bool inside = false;
};

class Gatherer {
public:
    Gatherer(const Tracer& tracer, const Patches& patches, const BakeLight& light, std::uint32_t seed)
        : tracer_(tracer), patches_(patches), light_(light), seed_(seed), regular_m_(patches.level_cell_m(1))
    {
    }

    Gathered operator()(const Site& site, std::uint64_t number, int rays) const
    {
        const Triangles& triangles = tracer_.triangles();
        const glm::vec3 face = triangles.normal(site.triangle);
        glm::vec3 n = triangles.shading_normal(site.triangle, site.at);
        if (glm::dot(n, face) < 0.05f) n = face;
        const glm::vec3 x = triangles.point(site.triangle, site.at);
        const glm::vec3 from = x + face * ray_lift_m(x, regular_m_);
        const std::uint64_t hash = mixed(seed_, number);
        glm::vec3 sum(0.0f);
        int found = 0;
        for (int r = 0; r < rays; ++r) {
            Ray ray{from, row_direction(n, r, rays, hash)};
            // Below the face, above the bent normal: as a mirror at the face has it.
            const float below = glm::dot(ray.direction, face);
            if (below < 0.0f) ray.direction -= face * (2.0f * below);
            const RayHit hit = tracer_.nearest(ray);
            if (!hit.hit()) {
                sum += light_.sky[static_cast<std::size_t>(shared::sky_bin(ray.direction))];
                ++found;
                continue;
            }
            if (hit.back && !triangles.double_sided(hit.triangle)) continue;
            ++found;
            const glm::vec3 there = triangles.normal(hit.triangle);
            const auto patch = patch_at(patches_, ray.origin + ray.direction * hit.distance_m,
                                        hit.back ? -there : there);
            if (patch) sum += light_.radiosity[*patch];
        }
        Gathered gathered;
        gathered.inside = 2 * found < rays;
        if (gathered.inside) return gathered;
        if (!light_.masked.empty()) gathered.seen = seen(x, n, from);
        gathered.lux = sum / static_cast<float>(found);
        for (const Light& lamp : light_.lamps) {
            const glm::vec3 lux = lamp_irradiance(lamp, light_.profiles, x, n);
            if (!(lux.x + lux.y + lux.z > 0.0f)) continue;
            gathered.lux += lux * shared::weak_shadow(lamp_seen(tracer_, lamp, from) ? 1.0f : 0.0f, lamp.shadow_strength);
        }
        return gathered;
    }

private:
    glm::vec4 seen(glm::vec3 x, glm::vec3 n, glm::vec3 from) const
    {
        std::array<const Light*, 4> strongest{};
        std::array<float, 4> most{};
        glm::vec4 mask(1.0f);
        for (const Light& lamp : light_.masked) {
            const glm::vec3 lux = lamp_irradiance(lamp, light_.profiles, x, n);
            const float sum = lux.x + lux.y + lux.z;
            const auto channel = static_cast<std::size_t>(lamp.mask_channel);
            mask[lamp.mask_channel] = 0.0f;
            if (!(sum > most[channel])) continue;
            most[channel] = sum;
            strongest[channel] = &lamp;
        }
        for (std::size_t c = 0; c < 4; ++c) {
            if (strongest[c] && lamp_seen(tracer_, *strongest[c], from)) mask[static_cast<int>(c)] = 1.0f;
        }
        return mask;
    }

    const Tracer& tracer_;
    const Patches& patches_;
    const BakeLight& light_;
    std::uint32_t seed_;
    float regular_m_;
};

// Islands grow into gaps by the mean of what lies beside, a texel a round, so that filtering finds
// none. Maps repeat: over the edge lies the other side.
void spread(LightMap& map, std::vector<std::uint8_t>& filled, int rounds)
{
    const auto at = [&](int x, int y) {
        return static_cast<std::size_t>(wrapped(y, map.size) * map.size + wrapped(x, map.size));
    };
    for (int round = 0; round < rounds; ++round) {
        const std::vector<std::uint8_t> before = filled;
        bool grew = false;
        for (int y = 0; y < map.size; ++y) {
            for (int x = 0; x < map.size; ++x) {
                if (before[at(x, y)] != 0) continue;
                glm::vec3 sum(0.0f);
                glm::vec4 seen(0.0f);
                float count = 0.0f;
                for (int dy = -1; dy <= 1; ++dy) {
                    for (int dx = -1; dx <= 1; ++dx) {
                        if (before[at(x + dx, y + dy)] == 0) continue;
                        sum += map.lux[at(x + dx, y + dy)];
                        if (!map.seen.empty()) seen += map.seen[at(x + dx, y + dy)];
                        count += 1.0f;
                    }
                }
                if (count == 0.0f) continue;
                map.lux[at(x, y)] = sum / count;
                if (!map.seen.empty()) map.seen[at(x, y)] = seen / count;
                filled[at(x, y)] = 1;
                grew = true;
            }
        }
        if (!grew) return;
    }
}

void check(const BakeOptions& o)
{
    const auto range = [](const char* what, int value, int low, int high) {
        if (value < low || value > high) {
            throw Error("light map: " + std::string(what) + " must be in " + std::to_string(low) +
                            ".." + std::to_string(high) + ", got " + std::to_string(value),
                        "Choose one in that range.");
        }
    };
    range("size", o.size, 8, 8192);
    range("rays", o.rays, 16, 4096);
    range("spread", o.spread, 0, 8192);
}

// Coordinates that each material is baked over: the second where a mesh of it has them.
std::vector<TextureUse> coordinates_of(const Scene& scene)
{
    std::vector<TextureUse> uses;
    for (const Material& m : scene.materials) {
        TextureUse use = m.light_map;
        use.texcoord = 0;
        uses.push_back(use);
    }
    for (const Mesh& mesh : scene.meshes) {
        for (const Primitive& p : mesh.primitives) {
            if (!p.uv1.empty()) uses[p.material].texcoord = 1;
        }
    }
    return uses;
}

}  // namespace

LightMaps bake_light_maps(const Tracer& tracer, const Patches& patches, const BakeLight& light,
                          const BakeOptions& options)
{
    check(options);
    const Triangles& triangles = tracer.triangles();
    const std::vector<TextureUse> uses = coordinates_of(triangles.scene());
    const std::size_t texels = static_cast<std::size_t>(options.size) * static_cast<std::size_t>(options.size);
    std::vector<std::vector<std::uint32_t>> of_material(uses.size());
    for (std::uint32_t t = 0; t < triangles.size(); ++t) of_material[triangles.material(t)].push_back(t);
    const Gatherer gather(tracer, patches, light, options.seed);
    LightMaps result;
    const auto wanted = static_cast<double>(
        std::count_if(of_material.begin(), of_material.end(), [](const auto& list) { return !list.empty(); }));
    double done_maps = 0.0;
    for (std::uint32_t m = 0; m < uses.size(); ++m) {
        if (of_material[m].empty()) continue;
        std::vector<Site> sites;
        bool fits = true;
        for (const std::uint32_t t : of_material[m])
            fits = fits && add_sites(triangles, t, uses[m], options.size, kMostLayers * kPoints * texels, sites);
        if (!fits || sites.empty()) {
            result.left_out.push_back(m);
            done_maps += 1.0;
            continue;
        }
        std::stable_sort(sites.begin(), sites.end(),
                         [](const Site& a, const Site& b) { return a.texel < b.texel; });
        std::vector<std::uint32_t> first(texels + 1, 0);
        for (const Site& site : sites) ++first[site.texel + 1];
        for (std::size_t i = 0; i < texels; ++i) first[i + 1] += first[i];

        LightMap map;
        map.material = m;
        map.size = options.size;
        map.texcoord = uses[m].texcoord;
        map.lux.assign(texels, glm::vec3(0.0f));
        if (!light.masked.empty()) map.seen.assign(texels, glm::vec4(0.0f));
        std::vector<std::uint8_t> filled(texels, 0);
        const auto rows = static_cast<std::size_t>(options.size);
        const int rays = std::max(options.rays / kPoints, 4);
        std::atomic<std::size_t> done{0};
        std::mutex telling;
        parallel_for(rows, options.threads, [&](std::size_t row) {
            if (options.stop && options.stop())
                throw Interrupted("interrupted while light maps were baked");
            for (std::size_t i = row * rows; i < (row + 1) * rows; ++i) {
                glm::vec3 sum(0.0f);
                glm::vec4 seen(0.0f);
                float count = 0.0f;
                for (std::uint32_t s = first[i]; s < first[i + 1]; ++s) {
                    const Gathered g =
                        gather(sites[s], (std::uint64_t{m} << 40) + std::uint64_t{s}, rays);
                    if (g.inside) continue;
                    sum += g.lux;
                    seen += g.seen;
                    count += 1.0f;
                }
                if (count == 0.0f) continue;
                map.lux[i] = sum / count;
                if (!map.seen.empty()) map.seen[i] = seen / count;
                filled[i] = 1;
            }
            const std::size_t now = ++done;
            if (options.progress && now % 16 == 0) {
                const std::lock_guard lock(telling);
                options.progress("light maps",
                                 static_cast<float>((done_maps + static_cast<double>(now) /
                                                                     static_cast<double>(rows)) /
                                                    wanted));
            }
        });
        std::size_t lit = 0, several = 0;
        for (std::size_t i = 0; i < texels; ++i) {
            if (filled[i] == 0) continue;
            ++lit;
            several += first[i + 1] - first[i] > kPoints ? 1 : 0;
        }
        map.covered = static_cast<double>(lit) / static_cast<double>(texels);
        map.shared = lit > 0 ? static_cast<double>(several) / static_cast<double>(lit) : 0.0;
        spread(map, filled, options.spread);
        result.maps.push_back(std::move(map));
        done_maps += 1.0;
    }
    return result;
}

}  // namespace petrichor::scene
