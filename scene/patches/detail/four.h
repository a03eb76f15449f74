// Four floats that one instruction works on: the compiler's own vectors, on any machine. Each lane has the bits that a
// float alone would have.
#ifndef PETRICHOR_SCENE_PATCHES_DETAIL_FOUR_H
#define PETRICHOR_SCENE_PATCHES_DETAIL_FOUR_H

#include <cstdint>
#include <cstring>
#include <glm/glm.hpp>

namespace petrichor::scene {

using Four = float __attribute__((vector_size(16)));
using Signs = std::int32_t __attribute__((vector_size(16)));  // -1: the lane's comparison holds

inline Four four(const float* from)
{
    Four lanes;
    std::memcpy(&lanes, from, sizeof lanes);
    return lanes;
}
inline Four all(float x)
{
    return Four{x, x, x, x};
}
inline Four larger(Four a, Four b)
{
    return a > b ? a : b;
}
inline Four smaller(Four a, Four b)
{
    return a < b ? a : b;
}
inline bool none(Signs mask)
{
    std::uint64_t halves[2];
    std::memcpy(halves, &mask, sizeof halves);
    return (halves[0] | halves[1]) == 0;
}

struct Four3 {
    Four x, y, z;
};
inline Four3 four3(const float from[3][4])
{
    return {four(from[0]), four(from[1]), four(from[2])};
}
inline Four3 all3(glm::vec3 v)
{
    return {all(v.x), all(v.y), all(v.z)};
}
inline Four3 operator+(const Four3& a, const Four3& b)
{
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Four3 operator-(const Four3& a, const Four3& b)
{
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Four3 operator*(const Four3& a, Four s)
{
    return {a.x * s, a.y * s, a.z * s};
}
inline Four dot(const Four3& a, const Four3& b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Four3 cross(const Four3& a, const Four3& b)
{
    return {a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y};
}

}  // namespace petrichor::scene

#endif
