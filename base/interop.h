// The bridge between C++, GLSL and HLSL: a header that includes this one and keeps to the common
// subset compiles as all three. Common subset: no swizzles (vec3(v.x, v.y, v.z)), float literals
// with f, results returned as a struct, no bool in buffers, `SHARED_CONST float NAME = 1.0f;` for
// constants; splat3(x) for the vector of one number, atan2(y, x) for the angle of two, no
// constructors of structs, no arrays but members, no names that a language keeps for itself (linear,
// point, sample ...). No formula takes a matrix: their rows and columns are told apart nowhere alike.
//
// As HLSL where PETRICHOR_HLSL is defined or the compiler says __HLSL_VERSION.
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

constexpr vec2 splat2(float x)
{
    return vec2(x);
}
constexpr vec3 splat3(float x)
{
    return vec3(x);
}
constexpr vec4 splat4(float x)
{
    return vec4(x);
}
inline float atan2(float y, float x)
{
    return glm::atan(y, x);
}
}  // namespace petrichor::shared_names

#elif defined(PETRICHOR_HLSL) || defined(__HLSL_VERSION)

#define SHARED_BEGIN
#define SHARED_END
#define SHARED_FN
#define SHARED_CONST static const
#define SHARED_HAS_SATURATE

#define vec2 float2
#define vec3 float3
#define vec4 float4
#define ivec2 int2
#define ivec3 int3
#define ivec4 int4
#define uvec2 uint2
#define uvec3 uint3
#define uvec4 uint4
#define floatBitsToUint asuint
#define fract frac
#define inversesqrt rsqrt
#define mix lerp
#define uintBitsToFloat asfloat

float2 splat2(float x)
{
    return float2(x, x);
}
float3 splat3(float x)
{
    return float3(x, x, x);
}
float4 splat4(float x)
{
    return float4(x, x, x, x);
}

#else

#define SHARED_BEGIN
#define SHARED_END
#define SHARED_FN
#define SHARED_CONST const

#define splat2(x) vec2(x)
#define splat3(x) vec3(x)
#define splat4(x) vec4(x)
#define atan2(y, x) atan(y, x)

#endif

#endif
