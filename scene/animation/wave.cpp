#include "scene/animation/wave.h"

#include <algorithm>
#include <cmath>

#include "base/portable_math.h"
#include "formulas/noise/noise.h"

namespace petrichor::scene {

namespace {

constexpr float kHalfWind_m_s = 6.0f;  // so fast, half of the lean is reached
constexpr float kGust_m = 14.0f;       // from one gust to the next
constexpr float kSwayPhase_m = 3.0f;   // neighbours so far apart sway out of step
constexpr float kSwayShare = 0.35f;    // of the lean
constexpr int kPeriod = 1024;
constexpr double kTau = 6.283185307179586;
constexpr float kLargestLean = 0.95f;  // of the length

glm::vec2 wrapped_m(const glm::dvec2& p, double size_m)
{
    const double span = size_m * kPeriod;
    return glm::vec2((p - glm::floor(p / span) * span) / size_m);
}

float height_in_world(const Bounds& box, const glm::mat4& to_world)
{
    float sum = 0.0f;
    for (int axis = 0; axis < 3; ++axis)
        sum += std::abs(to_world[axis].y) * (box.high[axis] - box.low[axis]);
    return sum;
}

float low_in_world(const Bounds& box, const glm::mat4& to_world)
{
    const glm::vec3 centre = 0.5f * (box.low + box.high);
    return (to_world * glm::vec4(centre, 1.0f)).y - 0.5f * height_in_world(box, to_world);
}

float length_of(const Bounds& box, const glm::mat4& to_world, const WindLook& look)
{
    return look.height_m > 0.0f ? look.height_m : height_in_world(box, to_world);
}

// Turned about a level axis, from up towards `along`.
glm::vec3 leaned(const glm::vec3& v, const glm::vec2& along, float sine, float cosine)
{
    const float forward = v.x * along.x + v.z * along.y;
    const float turned = forward * cosine + v.y * sine;
    const float up = v.y * cosine - forward * sine;
    return {v.x + (turned - forward) * along.x, up, v.z + (turned - forward) * along.y};
}

}  // namespace

float wave_reach_m(const Bounds& box, const glm::mat4& to_world, const WindLook& look)
{
    return length_of(box, to_world, look) * kLargestLean * 1.42f + look.flutter_m;
}

Shape waved(const Primitive& primitive, const Bounds& box, const glm::mat4& to_world,
            const WindLook& look, const Wind& wind)
{
    Shape shape{primitive.positions, primitive.normals, primitive.tangents};
    const float speed = glm::length(wind.velocity_m_s);
    const float length_m = length_of(box, to_world, look);
    if (!(speed > 0.0f) || !(length_m > 0.0f)) return shape;
    const glm::vec2 along = wind.velocity_m_s / speed;
    const float force = speed / (speed + kHalfWind_m_s);
    const glm::mat3 linear(to_world);
    const glm::mat3 back = glm::inverse(linear);
    if (!std::isfinite(back[0].x)) return shape;
    const float low = low_in_world(box, to_world);
    const double hz = static_cast<double>(look.sway_hz);
    const auto turns = [&](double each_s) {
        const double t = wind.time_s * each_s;
        return (t - std::floor(t)) * kTau;
    };
    const double sway_turn = turns(hz);
    const double flutter_turn = turns(5.0 * hz);
    for (std::size_t i = 0; i < shape.positions.size(); ++i) {
        const glm::vec3 world(to_world * glm::vec4(primitive.positions[i], 1.0f));
        float weight = (world.y - low) / length_m;
        if (look.weight == WindWeight::Uv)
            weight = primitive.uv0.empty() ? 0.0f : 1.0f - primitive.uv0[i].y;
        if (look.weight == WindWeight::Mask)
            weight = primitive.weather.empty() ? 1.0f : primitive.weather[i].w;
        weight = std::clamp(weight, 0.0f, 1.0f);
        if (weight < 1.0e-5f) continue;  // a root, but for rounding
        const glm::dvec2 ground(static_cast<double>(world.x), static_cast<double>(world.z));
        const float gust = 0.3f + 1.4f * shared::tileable_noise(
                                             wrapped_m(ground - wind.air_m, static_cast<double>(kGust_m)),
                                             kPeriod, 71u);
        const float step = shared::tileable_noise(
            wrapped_m(ground, static_cast<double>(kSwayPhase_m)), kPeriod, 72u);
        const float sway = static_cast<float>(
            portable_sin_cos(sway_turn + kTau * static_cast<double>(step)).sine);
        // Stiff at the root: the slope grows with the height, its end with the square.
        const float lean = std::clamp(look.bend * force * (gust + kSwayShare * sway), -0.9f,
                                      kLargestLean);
        const float arm_m = length_m * weight;
        const float away_m = arm_m * weight * lean;
        glm::vec3 moved(along.x * away_m, 0.0f, along.y * away_m);
        moved.y = std::sqrt(std::max(arm_m * arm_m - away_m * away_m, 0.0f)) - arm_m;
        if (look.flutter_m > 0.0f) {
            const double phase = flutter_turn + 7.1 * static_cast<double>(world.x) +
                                 5.3 * static_cast<double>(world.y) +
                                 6.7 * static_cast<double>(world.z);
            const auto beat = portable_sin_cos(phase);
            const float size_m = look.flutter_m * force * weight;
            moved += size_m * glm::vec3(-along.y * static_cast<float>(beat.sine),
                                        static_cast<float>(beat.cosine),
                                        along.x * static_cast<float>(beat.sine));
        }
        shape.positions[i] += back * moved;
        const float slope = 2.0f * weight * lean;
        const float cosine = 1.0f / std::sqrt(1.0f + slope * slope);
        const auto turned = [&](const glm::vec3& v) {
            const glm::vec3 out = back * leaned(linear * v, along, slope * cosine, cosine);
            const float size = glm::length(out);
            return size > 0.0f ? out / size : v;
        };
        shape.normals[i] = turned(primitive.normals[i]);
        if (!shape.tangents.empty())
            shape.tangents[i] = glm::vec4(turned(glm::vec3(primitive.tangents[i])),
                                          primitive.tangents[i].w);
    }
    return shape;
}

}  // namespace petrichor::scene
