// Random numbers without a stream: hashes of what they are for. Directions about a normal.
#ifndef PETRICHOR_SCENE_PATCHES_DETAIL_SAMPLING_H
#define PETRICHOR_SCENE_PATCHES_DETAIL_SAMPLING_H

#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

#include "base/portable_math.h"
#include "formulas/light/patch_cells.h"

namespace petrichor::scene {

inline constexpr float kGoldenRatio = 0.61803399f;

/// Bijective mix of 64 bits (Stafford's variant 13 of the finaliser of MurmurHash3).
inline std::uint64_t mixed(std::uint64_t x)
{
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
    return x ^ (x >> 31);
}
inline std::uint64_t mixed(std::uint64_t seed, std::uint64_t value)
{
    return mixed(seed ^ mixed(value + 0x9e3779b97f4a7c15ull));
}
inline std::uint64_t whole_key(shared::PatchKey key)
{
    return (std::uint64_t{key.high} << 32) | key.low;
}
/// What all draws of a cell are made from.
inline std::uint64_t cell_hash(std::uint32_t seed, shared::PatchKey key)
{
    return mixed(seed, whole_key(key));
}
/// 0 <= x < 1, from the upper bits.
inline float unit_float(std::uint64_t bits)
{
    return static_cast<float>(bits >> 40) * 0x1.0p-24f;
}
inline float fraction(float x)
{
    return x - std::floor(x);
}

/// Two unit vectors that stand on n and on each other (Duff et al. 2017).
struct Tangents {
    glm::vec3 t, b;
};
inline Tangents tangents_of(glm::vec3 n)
{
    const float sign = n.z >= 0.0f ? 1.0f : -1.0f;
    const float a = -1.0f / (sign + n.z);
    const float c = n.x * n.y * a;
    return {{1.0f + sign * n.x * n.x * a, sign * c, -sign * n.x},
            {c, sign + n.y * n.y * a, -n.y}};
}

/// Cosine-distributed about z (shading reference, section 9): u and v of 0..1.
inline glm::vec3 local_direction(float u, float v)
{
    const auto turn = portable_sin_cos(6.283185307179586 * static_cast<double>(v));
    const float r = std::sqrt(u);
    return {r * static_cast<float>(turn.cosine), r * static_cast<float>(turn.sine),
            std::sqrt(std::max(1.0f - u, 0.0f))};
}
/// The same about n. f: tangents_of(n).
inline glm::vec3 turned(const Tangents& f, glm::vec3 n, glm::vec3 local)
{
    const glm::vec3 d = f.t * local.x + f.b * local.y + n * local.z;
    return d / std::sqrt(glm::dot(d, d));
}
inline glm::vec3 cosine_direction(glm::vec3 n, float u, float v)
{
    return turned(tangents_of(n), n, local_direction(u, v));
}

/// By how much of a turn the directions of a row are turned about the normal.
inline float row_turn(std::uint64_t hash)
{
    return unit_float(mixed(hash, 7));
}

/// The r-th of n directions that cover the hemisphere evenly, turned and shifted by a hash; about z.
inline glm::vec3 local_row_direction(int r, int count, std::uint64_t hash)
{
    const float u = (static_cast<float>(r) + unit_float(hash)) / static_cast<float>(count);
    const float v = fraction(kGoldenRatio * static_cast<float>(r) + row_turn(hash));
    return local_direction(u, v);
}
inline glm::vec3 row_direction(glm::vec3 n, int r, int count, std::uint64_t hash)
{
    return turned(tangents_of(n), n, local_row_direction(r, count, hash));
}

}  // namespace petrichor::scene

#endif
