#include "gpu/frame/falls.h"

#include <algorithm>
#include <cmath>

#include "formulas/weather/falling.h"

namespace petrichor::gpu {
namespace {

// Where people see it fall, in a suburb (Wieringa 1992), as of the drops that are drawn.
constexpr float kSeenAt_m = 2.0f;
constexpr float kRoughness_m = 0.5f;
constexpr float kSnowSpeed_m_s = 1.0f;
constexpr float kEddies = 0.5f;           // share of the snow
constexpr float kEddyCosine = 0.8660254f; // within 30 degrees of the vertical
// Width of the sky that a direction stands for, about 12 degrees.
constexpr float kConcentration = 22.0f;
constexpr float kLeastShare = 0.06f;

using Shares = std::array<float, SKY_DIRECTIONS>;
using Directions = std::array<glm::vec3, SKY_DIRECTIONS>;

// Spreads `weight` over the directions around `from`.
void add(Shares& shares, const Directions& sky, const glm::vec3& from, float weight)
{
    Shares near;
    float sum = 0.0f;
    for (std::size_t i = 0; i < sky.size(); ++i) {
        near[i] = std::exp(kConcentration * (glm::dot(sky[i], from) - 1.0f));
        sum += near[i];
    }
    for (std::size_t i = 0; i < sky.size(); ++i) shares[i] += weight * near[i] / sum;
}

glm::vec3 where_from(const glm::vec2& wind_m_s, float speed_m_s)
{
    return glm::normalize(glm::vec3(-wind_m_s.x, speed_m_s, -wind_m_s.y));
}

// What is too little to be looked up falls along the others.
Shares without_least(Shares shares)
{
    float sum = 0.0f;
    for (float& share : shares) {
        share = std::max(share - kLeastShare, 0.0f);
        sum += share;
    }
    for (float& share : shares) share /= sum;
    return shares;
}

}  // namespace

std::vector<Fall> falls(const shared::WeatherMoment& weather, const Directions& sky)
{
    const glm::vec2 wind = shared::wind_share_at(kSeenAt_m, kRoughness_m) * weather.wind_m_s;
    const float rain_mm_h = std::max(weather.rain_kg_m2_s * 3600.0f, 1.0f);
    const float median_mm = 1.10f * std::pow(rain_mm_h, 0.19f);
    Shares rain{};
    Shares snow{};
    // Ulbrich & Atlas: the sizes below which 10, 25, 50, 75 and 90 % of the water fall.
    for (const float size : {0.53f, 0.73f, 1.0f, 1.34f, 1.71f}) {
        const float speed = shared::drop_speed_m_s(size * median_mm);
        for (const int side : {-1, 0, 1}) {
            const float turn = static_cast<float>(side) * 0.34906585f;
            const glm::vec2 gust(wind.x * std::cos(turn) - wind.y * std::sin(turn),
                                 wind.x * std::sin(turn) + wind.y * std::cos(turn));
            add(rain, sky, where_from(gust, speed), 0.2f * (side == 0 ? 0.5f : 0.25f));
        }
    }
    add(snow, sky, where_from(wind, kSnowSpeed_m_s), 1.0f);
    rain = without_least(rain);
    snow = without_least(snow);
    float steep = 0.0f;
    for (const glm::vec3& direction : sky) steep += direction.y > kEddyCosine ? 1.0f : 0.0f;
    for (std::size_t i = 0; i < sky.size(); ++i) {
        snow[i] *= 1.0f - kEddies;
        if (sky[i].y > kEddyCosine) snow[i] += kEddies / steep;
    }
    std::vector<Fall> result;
    for (std::size_t i = 0; i < sky.size(); ++i) {
        if (rain[i] + snow[i] > 0.0f) {
            result.push_back({static_cast<int>(i), rain[i], snow[i]});
        }
    }
    return result;
}

}  // namespace petrichor::gpu
