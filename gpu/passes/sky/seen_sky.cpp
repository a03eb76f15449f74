#include "gpu/passes/sky/seen_sky.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "formulas/light/cube_map.h"

namespace petrichor::gpu {
namespace {

constexpr int kFaces = 6;
constexpr int kFaceBelow = 3;
// Tiles are asked in blocks first.
constexpr int kBlock = 8;
constexpr int kBlocksAcross = kSkyTilesAcross / kBlock;
static_assert(kBlock * kBlocksAcross == kSkyTilesAcross);

// The sides of what a picture sees, their normals inwards.
using Cone = std::array<glm::vec3, 4>;

Cone cone_of(const shared::FrameConstants& c)
{
    const auto ray = [&](float x, float y) { return c.ray_corner + c.ray_dx * x + c.ray_dy * y; };
    const auto w = static_cast<float>(c.size.x);
    const auto h = static_cast<float>(c.size.y);
    // A pixel more on each side.
    const std::array<glm::vec3, 4> corners{ray(-1.0f, -1.0f), ray(w + 1.0f, -1.0f), ray(w + 1.0f, h + 1.0f),
                                           ray(-1.0f, h + 1.0f)};
    const glm::vec3 middle = ray(0.5f * w, 0.5f * h);
    Cone cone;
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::vec3 side = glm::cross(corners[i], corners[(i + 1) % 4]);
        cone[i] = glm::normalize(glm::dot(side, middle) < 0.0f ? -side : side);
    }
    return cone;
}

// A square of texels as a disc of directions. Three texels around it count, since a spline between texels reads two on each
// side (gpu/passes/background), over edges of the cube too.
struct Disc {
    glm::vec3 middle;
    float sine;  // of half its width
};

Disc disc_around(int face, int row, int at, int tiles)
{
    const auto st = [](float x, float y) {
        return glm::vec2(x, y) * (2.0f / static_cast<float>(kSkyCubeSide)) - 1.0f;
    };
    const float half = 0.5f * static_cast<float>(tiles * kSkyTile);
    const float x = static_cast<float>(at * kSkyTile) + half;
    const float y = static_cast<float>(row * kSkyTile) + half;
    const float reach = half + 3.0f;
    const glm::vec3 middle = glm::normalize(shared::cube_direction(face, st(x, y)));
    float cosine = 1.0f;
    for (const float u : {-reach, reach}) {
        for (const float v : {-reach, reach}) {
            const glm::vec3 corner = shared::cube_direction(face, st(x + u, y + v));
            cosine = std::min(cosine, glm::dot(middle, glm::normalize(corner)));
        }
    }
    return {middle, std::sqrt(std::max(1.0f - cosine * cosine, 0.0f))};
}

bool may_see(const std::vector<Cone>& cones, const Disc& disc)
{
    // Not a number, of parallel rays, is no reason to leave a tile out.
    return std::any_of(cones.begin(), cones.end(), [&](const Cone& cone) {
        return std::none_of(cone.begin(), cone.end(),
                            [&](const glm::vec3& side) { return glm::dot(side, disc.middle) < -disc.sine; });
    });
}

}  // namespace

std::vector<std::uint32_t> seen_sky(std::span<const shared::FrameConstants> views, bool horizon)
{
    std::vector<Cone> cones;
    for (const shared::FrameConstants& view : views) cones.push_back(cone_of(view));
    std::vector<std::uint32_t> seen;
    std::array<bool, kFaces> faces{};
    for (int face = 0; face < kFaces; ++face) {
        for (int block = 0; block < kBlocksAcross * kBlocksAcross; ++block) {
            const int first_row = block / kBlocksAcross * kBlock;
            const int first_at = block % kBlocksAcross * kBlock;
            if (!may_see(cones, disc_around(face, first_row, first_at, kBlock))) continue;
            for (int tile = 0; tile < kBlock * kBlock; ++tile) {
                const int row = first_row + tile / kBlock;
                const int at = first_at + tile % kBlock;
                if (!may_see(cones, disc_around(face, row, at, 1))) continue;
                seen.push_back(sky_tile(face, row, at));
                faces[static_cast<std::size_t>(face)] = true;
            }
        }
    }
    if (!horizon) return seen;
    // Directions to the land take the air of the horizon above them: on their own side, below on any.
    for (const int face : {0, 1, 4, 5}) {
        if (!faces[static_cast<std::size_t>(face)] && !faces[kFaceBelow]) continue;
        for (const int row : {kSkyTilesAcross / 2 - 1, kSkyTilesAcross / 2})
            for (int at = 0; at < kSkyTilesAcross; ++at) seen.push_back(sky_tile(face, row, at));
    }
    std::sort(seen.begin(), seen.end());
    seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
    return seen;
}

}  // namespace petrichor::gpu
