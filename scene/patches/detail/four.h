// Vectors of the world, four at a time.
#ifndef PETRICHOR_SCENE_PATCHES_DETAIL_FOUR_H
#define PETRICHOR_SCENE_PATCHES_DETAIL_FOUR_H

#include <glm/glm.hpp>

#include "base/four.h"

namespace petrichor::scene {

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
