// The bridge between C++ and GLSL: a header that includes this one and keeps to the common subset
// compiles as both. Common subset: no swizzles (vec3(v.x, v.y, v.z)), float literals with f,
// results returned as a struct, no bool in buffers, `SHARED_CONST float NAME = 1.0f;` for
// constants.
#ifndef PETRICHOR_BASE_INTEROP_H
#define PETRICHOR_BASE_INTEROP_H

#ifdef __cplusplus

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

#define SHARED_BEGIN              \
    namespace petrichor::shared { \
    using namespace petrichor::shared_names;
#define SHARED_END }
#define SHARED_FN inline
#define SHARED_CONST inline constexpr

namespace petrichor::shared_names {
using glm::ivec2;
using glm::ivec3;
using glm::ivec4;
using glm::mat3;
using glm::mat4;
using glm::uvec2;
using glm::uvec3;
using glm::uvec4;
using glm::vec2;
using glm::vec3;
using glm::vec4;
using uint = std::uint32_t;

using glm::abs;
using glm::acos;
using glm::atan;
using glm::clamp;
using glm::cos;
using glm::cross;
using glm::dot;
using glm::exp;
using glm::exp2;
using glm::floatBitsToUint;
using glm::floor;
using glm::fract;
using glm::inversesqrt;
using glm::length;
using glm::log;
using glm::log2;
using glm::max;
using glm::min;
using glm::mix;
using glm::mod;
using glm::normalize;
using glm::pow;
using glm::reflect;
using glm::sin;
using glm::smoothstep;
using glm::sqrt;
using glm::step;
using glm::uintBitsToFloat;
}  // namespace petrichor::shared_names

#else

#define SHARED_BEGIN
#define SHARED_END
#define SHARED_FN
#define SHARED_CONST const

#endif

#endif
