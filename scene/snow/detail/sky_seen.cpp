#include "scene/snow/detail/sky_seen.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "base/portable_math.h"

namespace petrichor::scene::detail {
namespace {

using glm::vec3;

constexpr int kRays = 64;
constexpr float kCone = 0.6f;       // cosine from the zenith of the farthest ray
constexpr float kBuried_m = 0.06f;  // what stands so high over level ground hides nothing from the sky
constexpr float kSkin_m = 0.002f;   // rays start so far over a surface
constexpr float kRests_m = 0.02f;   // what lies so near the ground rests on it
constexpr int kInto = 2;            // edges that snow goes on into what stands in it
constexpr float kLevel = 0.85f;     // a gutter still is

std::array<vec3, kRays> sky_rays()
{
    std::array<vec3, kRays> rays;
    for (int k = 0; k < kRays; ++k) {
        const double up = 1.0 - (1.0 - static_cast<double>(kCone)) * (k + 0.5) / kRays;
        const double side = std::sqrt(1.0 - up * up);
        const SinCos turn = portable_sin_cos(2.399963229728653 * k);
        rays[static_cast<std::size_t>(k)] =
            vec3(glm::dvec3(side * turn.cosine, up, side * turn.sine));
    }
    return rays;
}

// Ground goes on below what stands on it.
bool inside_solid(const Tracer& tracer, const vec3& at)
{
    vec3 from = at + vec3(0.0f, kSkin_m, 0.0f);
    RayHit up = tracer.nearest({from, vec3(0.0f, 1.0f, 0.0f)});
    if (up.hit() && !up.back && up.distance_m < kRests_m) {  // on its own underside
        from.y += up.distance_m + kSkin_m;
        up = tracer.nearest({from, vec3(0.0f, 1.0f, 0.0f)});
    }
    if (!up.hit() || !up.back) return false;
    if (!tracer.triangles().double_sided(up.triangle)) return true;
    // What has two sides may be a leaf: one is not within it.
    for (const vec3& way : {vec3(1, 0, 0), vec3(-1, 0, 0), vec3(0, 0, 1), vec3(0, 0, -1)}) {
        const RayHit side = tracer.nearest({from + vec3(0.0f, std::min(kSkin_m, 0.5f * up.distance_m), 0.0f), way});
        if (!side.hit() || !side.back) return false;
    }
    return true;
}

}  // namespace

void look_up(CutMesh& mesh, const Tracer& tracer, SkySeen& seen)
{
    const auto rays = sky_rays();
    const std::size_t points = mesh.normals.size();
    std::vector<float> sum(points, 0.0f), count(points, 0.0f);
    std::vector<bool> known(points, false), buried(points, false);
    for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
        const Primitive& p = mesh.primitives[i];
        for (std::size_t v = 0; v < mesh.points[i].size(); ++v) {
            const auto found = seen.find(p.positions[v]);
            if (found == seen.end()) continue;
            const std::uint32_t point = mesh.points[i][v];
            known[point] = true;
            sum[point] = found->second;
            count[point] = 1.0f;
        }
    }
    for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
        const Primitive& p = mesh.primitives[i];
        for (std::size_t k = 0; k + 2 < p.indices.size(); k += 3) {
            const vec3 middle = (p.positions[p.indices[k]] + p.positions[p.indices[k + 1]] +
                                 p.positions[p.indices[k + 2]]) / 3.0f;
            const bool level = p.normals[p.indices[k]].y > kLevel;
            for (std::size_t c = 0; c < 3; ++c) {
                const std::uint32_t v = p.indices[k + c];
                const std::uint32_t point = mesh.points[i][v];
                if (known[point] || count[point] >= 3.0f) continue;
                const vec3 way = middle - p.positions[v];
                const float length = glm::length(way);
                const vec3 at = p.positions[v] + way * std::min(0.08f / std::max(length, 1.0e-6f), 0.3f);
                if (inside_solid(tracer, at)) {
                    buried[point] = true;
                    continue;
                }
                const vec3 from = at + vec3(0.0f, level ? kBuried_m : 0.015f, 0.0f);
                int open = 0;
                for (const vec3& ray : rays) open += tracer.blocked({from, ray}) ? 0 : 1;
                sum[point] += static_cast<float>(open) / kRays;
                count[point] += 1.0f;
            }
        }
    }
    std::vector<float> sky(points, 0.0f);
    for (std::size_t i = 0; i < points; ++i) {
        sky[i] = sum[i] / std::max(count[i], 1.0f);
        if (count[i] > 0.0f) buried[i] = false;
    }
    // Snow goes on into what stands in it.
    for (int pass = 0; pass < kInto; ++pass) {
        std::vector<float> most(sky);
        for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
            const Primitive& p = mesh.primitives[i];
            for (std::size_t k = 0; k < p.indices.size(); ++k) {
                const std::uint32_t a = mesh.points[i][p.indices[k]], b = mesh.points[i][p.indices[k % 3 == 2 ? k - 2 : k + 1]];
                if (buried[a]) most[a] = std::max(most[a], sky[b]);
                if (buried[b]) most[b] = std::max(most[b], sky[a]);
            }
        }
        sky = std::move(most);
    }
    for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
        Primitive& p = mesh.primitives[i];
        for (std::size_t v = 0; v < mesh.points[i].size(); ++v) {
            p.weather[v].w = sky[mesh.points[i][v]];
            seen[p.positions[v]] = p.weather[v].w;
        }
    }
}

}  // namespace petrichor::scene::detail
